/* A model: the constant table that the compiler writes, with its generated functions, their
 * arguments and results.
 */
#ifndef FROT_MODEL_H
#define FROT_MODEL_H

#include "model/tables.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One scalar variable. */
enum frot_type { FROT_REAL = 0, FROT_INTEGER = 1, FROT_BOOLEAN = 2, FROT_MODE = 3 };

/* Statements on places. Those on accelerations may be true of any equilibrium; one that is optional
 * is left to speeds if no places meet it too. A counter is an angle within half a turn of the one
 * that it counts: the slopes speak of the counter alone. */
enum frot_statement_kind { FROT_PLAIN = 0, FROT_BALANCE = 1, FROT_OPTIONAL = 2, FROT_COUNTER = 3 };

/* Inputs of the generated functions, in this order:
 *   t, q (nq), v (nv), u (nu), p (np), d (nd: conditions 0/1, then the sides +1/-1 of the contacts,
 *   then the discrete variables), y (ny: unknowns of the blocks)
 *
 * The states are q and v. The speeds v are those whose rates are unknowns of the core system
 *   A z = h + E lam,   z (nw) = v' (nv), auxiliary accelerations (na, zero in the motion: in their
 * place stand the reactions of the liaisons that coordinates keep), algebraic unknowns of the core
 * (nc), where the rows accelerate by J z + c. The rates q' are explicit; q_speed[k] is the speed
 * that is the rate of q[k], or -1 where q[k] is another state. Matrices are dense within their
 * groups, packed one group after the other, by columns; every column of E has one entry for each
 * unknown of its group, every row of J those that its group tells (`given`). Every argument is
 * given and every result taken. */
typedef struct {
  const char *name;
  const char *key; /* identity of the compiled model; kept in saved states */
  int nq, nv, na, nc, nu, np, ny, n_rows, n_contacts, n_elements, n_conditions, n_discrete;
  int n_blocks, n_invariants, n_whens, n_outcomes, n_carried, n_paced;
  /* the first n_located conditions change by the motion; the n_timed after them are linear in time
   * and depend on nothing else that moves; the rest change at events only */
  int n_located, n_timed;
  int n_sensed; /* the last n_sensed of the located ones read z, lam or late blocks: see `sensed` */
  int n_watched; /* equations of `watched` */
  int n_vanishing;
  int n_held;  /* the last n_held discrete values are what others were before: see `update` */
  int n_ranks; /* of `when`s and held values; those of one rank act together */
  int n_percussions;
  int lists_motions; /* 1: a run lists all motions at an event, by `orders` */
  int n_modes; /* the first n_modes discrete values are modes of contacts, which the text reads */
  int n_felt;  /* of these the first, that act on anything; the others are only reported */
  int n_turns; /* orientations among the coordinates */
  int n_groups;
  int n_islands; /* 0: all is one, and the functions of the whole model are called */
  int n_matrix, n_metric, n_entries, n_square; /* items of the packed arrays of all groups */
  int general;                                 /* a group is general */
  int late_rates;     /* q' or the power depend on y of late blocks, z or lam: `rates` gives them */
  int time_dependent; /* forces, coefficients or located conditions depend on time */
  int method;         /* frot_method of the text */
  int has_jacobian;   /* 1: the implicit method can run: q' not late */
  double implicit_price;           /* explicit steps that cost what an implicit one does */
  int n_guessed, n_guessed_speeds; /* guesses of places, and of speeds */
  int n_parts, n_speed_parts;
  int n_followed; /* unknowns of places that are followed, where a contact of them may be open */
  int n_checks, n_position, n_velocity, n_statements, n_variables, n_loads;
  /* the first variables are the modes of the contacts that have one, the others are real */

  /* parameters(p, set, u) -> p complete (np), checks (n_checks), unilateral (n_contacts),
   *   experiment (start stop tolerance interval max_step; NaN where the text is silent), nominal
   *   sizes of the states (nq, 0: not given), the most that a step of the trees of each group
   *   carries, over its own mass (n_groups), coefficients of restitution (n_contacts) */
  frot_callable parameters;
  /* start(t, u, p) -> q where the search begins, whatever is guessed, discrete variables there */
  frot_callable start;
  /* beginning(t, q, v, u, p, d, y) -> v and y where the search for them begins, at these places;
   * the conditions (n_conditions) where it does, d and y being those there */
  frot_callable beginning;
  /* The functions of the state take (t, q, v, u, p, d, y). */

  /* kinematics, dynamics, wide, spread and sizes: islands have their own, and then only `sizes` is
   * called for the whole, for the second of its results. kinematics -> gap (n_contacts), rows J (as
   * given), rate (n_rows), conditions (n_conditions; -1 for those that `sensed` gives) */
  frot_callable kinematics;
  /* beginnings -> where the search for each place that is followed begins (n_followed, the first of
   * y): at the nearest of some places all along the figures. Called where n_followed > 0. */
  frot_callable beginnings;
  /* places -> FROT_PLACE values of each carried body. Called where n_carried > 0. */
  frot_callable places;
  /* vanishing -> distance from where each has no tangent or normal (n_vanishing), no number where
   * it has none; numbers that tell where (FROT_WHERE x n_vanishing). Called after a failure, where
   * n_vanishing > 0. */
  frot_callable vanishing;
  /* pace -> sizes of what depends on time at given states (n_paced), and its rates by time alone
   * (n_paced). Called where n_paced > 0. */
  frot_callable pace;
  /* terms -> sizes of the terms of q' (nq), which may cancel; 0 of coordinates, and where q' is no
   * sum. Called where a state is no coordinate. */
  frot_callable terms;
  /* dynamics -> q' (nq), A (n_matrix), h (nw), J (as given), c (n_rows), rate (n_rows), gap
   *   (n_contacts), conditions (n_located), coefficients of motion and of rest (2 x n_elements),
   *   power of the forces that have no potential (1) */
  frot_callable dynamics;
  /* wide -> A, h, J of `dynamics` in wide numbers. There where inertias of several bodies add up in
   * entries of A. */
  frot_wide_callable wide;
  /* drives -> sizes of the terms of c (n_rows) by which time alone moves what loops hold together.
   * Called where time moves a place, a figure or a liaison. */
  frot_callable drives;
  /* spread -> E (n_entries), metric (n_metric: symmetric positive definite, what `least change` of
   *   speeds means). Called where `general`. */
  frot_callable spread;
  /* rates(..., y, z (nw), lam (n_rows)) -> q' (nq), power (1). Called where `late_rates`. */
  frot_callable rates;
  /* orders(..., y, z (nw), lam (n_rows), z', lam', z'', lam'') -> of each order k = 1, 2, 3 the
   *   k-th derivatives along the motion of A z - E lam - h (nw), J z + c (n_rows) and the
   * coefficients (2 x n_elements), without the k-th derivatives of z and lam. Only in programs that
   * list motions: motions/taylor.h. */
  frot_callable orders;
  /* jacobian -> where there are no speeds and no rows dq'/dq, dq'/dt (nq), at fixed y. The first
   *   holds the entries of `pattern`, or is dense (nq x nq). With early blocks r = 0 of the
   * unknowns y (ny), which take a dense one, also dq'/dy (nq x ny), dr/dq (ny x nq), dr/dt (ny),
   * dr/dy (ny x ny). jacobian(..., y, z (nw), lam (n_rows)) -> else the entries of `lines`, at
   *   fixed y, z and lam, or jacobian(..., lam, direction) -> their values in a direction.
   * Where `has_jacobian`. */
  frot_callable jacobian;
  frot_pattern pattern;
  frot_lines lines;
  /* invariants -> residual (n_invariants), its transposed Jacobian in (q, v) ((nq + nv) x
   *   n_invariants), size of its terms (n_invariants): relations between states that index
   *   reduction brought to light and that every accepted step is projected onto */
  frot_callable invariants;
  /* update(..., y, z (nw), lam (n_rows), fired (n_whens: 1 for each `when` that fires), before
   *   (n_discrete)) -> q (nq) and v (nv) after reinit, discrete values (n_discrete), outcomes
   *   (n_outcomes: 1 where required). In d stand the discrete values after the event as far as they
   * are known, in `before` those before. The last n_held values follow another value: they are what
   *   it was before. */
  frot_callable update;
  /* timers(u, p, d) -> slopes of the timed conditions in time, their values at time zero (n_timed).
   *   Called where n_timed > 0. */
  frot_callable timers;
  /* sensed(..., y, z (nw), lam (n_rows)) -> values of the located conditions that follow from the
   *   solution (n_sensed). Called where n_sensed > 0. */
  frot_callable sensed;
  /* impulses -> of each percussion in ground axes (3 n_percussions). Called where there is one. */
  frot_callable impulses;
  /* sizes -> sum of the sizes of the terms of h (nw), which may cancel in h; size of each applied
   *   force (n_loads) */
  frot_callable sizes;
  /* variables(..., y, z (nw), lam (n_rows), energy (dissipated, work)) -> values (n_variables)
   *   without the modes, which the kernel fills */
  frot_callable variables;
  /* watched(..., y, z (nw), lam (n_rows)) -> a number for each of the equations that may give none,
   *   not finite where that equation by itself gives none (n_watched). Called after a failure,
   * where n_watched > 0. */
  frot_callable watched;
  /* energy -> kinetic, potential, sizes of the forces times those of the places they act at */
  frot_callable energy;

  const double *p_default; /* np */
  const double *u_default; /* nu */
  const frot_contact *contacts;
  const frot_turn *turns; /* n_turns */
  const frot_element *elements;
  const frot_group *groups;
  const frot_island *islands;           /* n_islands */
  const frot_part *parts, *speed_parts; /* of places, of speeds */
  const int *row_reads;  /* n_rows: the auxiliary unknown whose place a reading takes, else -1 */
  const int *row_beside; /* n_rows: the row of the normal where this is the slip on it, else -1 */
  /* n_rows, nv: the group of a row, of a speed, and its number among the rows, the unknowns there
   */
  const int *row_group, *row_local, *contact_group, *speed_group, *speed_local;
  const int *speed_coordinate; /* nv: the coordinate whose rate is this speed, or -1 */
  const int *speed_turns;      /* nv: 1 where it is an angular velocity */
  const frot_check *checks;
  const frot_carried *carried;
  const frot_statement *statements; /* those of the invariants are the last */
  const frot_load *loads;
  const frot_load *states;          /* nq + nv: names and places of q and v; may be NULL */
  const frot_held *held;            /* n_held */
  const frot_vanishing *vanishings; /* n_vanishing */
  const frot_watched *equations;    /* n_watched */
  /* n_position, n_velocity: statement of each scalar equation; ~s of one that is none of the text
   */
  const int *position_statement;
  const int *velocity_statement;
  /* n_position: 1 where a statement holds where the search begins, whatever is guessed */
  const unsigned char *position_direct;
  const unsigned char *position_kind; /* n_position: frot_statement_kind */
  const int *p_dependent; /* np: 1 where the value follows from other parameters unless set */
  const int *p_type;      /* np: frot_type */
  /* n_rows x (nq + 1), by rows: 1 where the row's Jacobian depends on that coordinate; last: on t,
   * an input, a discrete variable or y */
  const unsigned char *row_depends;
  const frot_condition *conditions;      /* n_conditions */
  const unsigned char *condition_strict; /* n_conditions: 1 for < and >, 0 for <= and >= */
  const int *q_speed;                    /* nq: the speed that is the rate of q[k], or -1 */
  /* nq: the first state that is no coordinate and has the dimension of q[k]; k for coordinates */
  const int *q_alike;
  const frot_block *blocks;        /* n_blocks */
  const int *when_condition;       /* n_whens: it fires when this condition comes to hold */
  const int *when_rank;            /* n_whens: those of lower ranks act before, at one instant */
  const int *mode_contact;         /* n_modes: the contact whose mode it is */
  const unsigned char *mode_reads; /* n_modes: what is read of it, a frot_mode_reading */
  const unsigned char
      *when_at_start;           /* n_whens: 1 where it also fires if that holds at the start */
  const frot_outcome *outcomes; /* n_outcomes */
  const frot_percussion *percussions; /* n_percussions */
} frot_model;

#ifdef __cplusplus
}
#endif
#endif
