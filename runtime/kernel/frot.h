/* The kernel's contract: a compiled model, the state of an instance, and what can be done with it.
 *
 * A model is a constant table written by the compiler (frot_model). All that changes in a run is in
 * one flat block without pointers (frot_state): copying the block saves an instance, copying it
 * back restores it. Scratch memory (frot_work) carries nothing from one call to the next. The
 * kernel allocates nothing, has no globals and is re-entrant: one state and one work block an
 * instance.
 *
 * The motion is a chain of segments. A segment is one accepted step of the integrator with its
 * dense output, in one mode of every liaison. A segment may end beyond the time asked for: values
 * in between are those of the dense output, so that results do not depend on the times they are
 * asked at. Only a change of a parameter or an input from outside cuts a segment.
 */
#ifndef FROT_H
#define FROT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FROT_STAGES 8 /* vectors of the dense output of a segment */

/* Status of every call that can fail. Positive: told in state->fault. */
enum frot_status {
  FROT_OK = 0,
  FROT_FULL = 1,         /* the recorder is full: drain it and call again */
  FROT_STOPPED = 2,      /* the monitor asked to stop */
  FROT_TERMINATED = 3,   /* the model's own `terminate`: the run is over and good */
  FROT_CHECK = 10,       /* a parameter has a value the model cannot have */
  FROT_INITIAL = 11,     /* contradictory initial values */
  FROT_IMPACT = 13,      /* two bodies meet: impacts are not computed */
  FROT_IMPASSE = 14,     /* no admissible motion */
  FROT_SEVERAL = 15,     /* several admissible motions and on_indeterminate = stop */
  FROT_CHATTER = 16,     /* events without end at one instant */
  FROT_NAN = 17,         /* a force or an equation gives no number */
  FROT_DIVERGE = 18,     /* the step went to zero: jamming or a singular point */
  FROT_SINGULAR = 19,    /* the mass matrix is singular */
  FROT_TOO_LARGE = 20,   /* too many coupled friction elements change at once */
  FROT_MISUSE = 21,      /* a call out of order or with bad arguments */
  FROT_ALGEBRAIC = 22,   /* a block of equations has no solution, or a singular one */
  FROT_ASSERT = 23,      /* an `assert` of the text does not hold */
  FROT_REFUSED = 24,     /* a change from outside cannot be made in a run; the old values stay */
  FROT_EVENT_FAULT = 30, /* an event of the text cannot do what it says */
  FROT_VANISHED = 32,    /* a curve or surface has no tangent or normal where a liaison needs it */
  FROT_POSTURE = 31,     /* relations of a loop do not tell how it goes on */
  FROT_JUMP = 25         /* a `reinit` or a switch moves a body against what holds it */
};

/* Why a change is refused: `other` of the fault. Of contacts, then of bodies that are carried
 * (item: which), last of relations of the text (item: its statement). */
enum frot_why {
  FROT_PARTS = 0,   /* a liaison that cannot part would be apart */
  FROT_ENTERS = 1,  /* a body would be inside a line */
  FROT_MEETS = 2,   /* bodies would meet with speed */
  FROT_JERKS = 3,   /* a liaison that cannot part would part with speed, or carry a body along */
  FROT_CARRIES = 4, /* a body would be carried along at once */
  FROT_TURNS = 5,   /* and turned */
  FROT_BREAKS = 6   /* a relation of the text would not hold any more */
};

/* Modes of the relative motion a law of friction bounds. */
enum frot_friction { FROT_NONE = 0, FROT_STICK = 1, FROT_SLIP_FORWARD = 2, FROT_SLIP_BACKWARD = 3 };

/* Values of a liaison's variable `mode` (FMU integers). */
enum frot_mode { FROT_MODE_OPEN = 0, FROT_MODE_STICK = 1, FROT_MODE_SLIP = 2 };

enum frot_event_kind {
  FROT_EVENT_STICK = 0,      /* slip ended: slip -> stick */
  FROT_EVENT_SLIP = 1,       /* the bound was reached: stick -> slip */
  FROT_EVENT_REVERSAL = 2,   /* slip -> slip the other way */
  FROT_EVENT_SEPARATION = 3, /* closed -> open */
  FROT_EVENT_CONTACT = 4,    /* open -> closed */
  FROT_EVENT_ROLL_STOP = 5,  /* rolling ended (rolling resistance holds) */
  FROT_EVENT_ROLL_START = 6,
  FROT_EVENT_ROLL_REVERSAL = 7,
  FROT_EVENT_REACTION = 8,  /* the reaction of a bilateral liaison changes sides */
  FROT_EVENT_CONDITION = 9, /* a condition of the text changes */
  FROT_EVENT_SEVERAL = 10,  /* several motions are admissible; count in `solutions` */
  FROT_EVENT_WARNING = 11,  /* a warning of the text; `contact` is its outcome */
  FROT_EVENT_TERMINATE = 12 /* the text ended the run; `contact` is its outcome */
};

typedef int (*frot_function)(const double **arg, double **res, long long *iw, double *w, int mem);

/* A generated function and the scratch it needs, in items of its arrays. */
typedef struct {
  frot_function call;
  int n_arg, n_res, n_iw, n_w;
} frot_callable;

/* What bounds the friction of an element: the size of one normal reaction, that of a reaction of
 * two components (a pin), or a value of the text (a brake, a clutch). */
enum frot_bound { FROT_BY_NORMAL = 0, FROT_BY_PIN = 1, FROT_BY_VALUE = 2 };

/* Rows are scalar relations between the unknowns z of the core. A row of a relation, or of the
 * motion that an element bounds, has the acceleration J z + c and a reaction lam that acts along
 * its column of E. A reading is a row without a motion: its lam is the reaction of a liaison that
 * coordinates keep (row_reads). */

/* Of a liaison that rolls, whatever acts on it: it has no law, and its mode is stick. */
enum { FROT_NEVER_SLIPS = -2 };

/* A liaison or an element of the text, as the user names it. */
typedef struct {
  const char *name;  /* the liaison, or the element */
  const char *place; /* file:line:column */
  int row_n;         /* row of the normal, -1 where it has none: it is never open */
  int reduced;       /* 1: the relation is built into the coordinates: row_n is a reading */
  int sliding;       /* the element that its variable `mode` tells of, FROT_NEVER_SLIPS, or -1 */
  int power;         /* its variable `power`, zero where all its elements hold, or -1 */
  int mode;          /* its variable `mode`, or -1: one relation of many of a liaison */
  int kinematic;     /* 1: a relation between velocities alone, which has no gap */
} frot_contact;

/* A unit quaternion r among the coordinates, q[at .. at + 4): 2 r' = (0, w) r, or r (0, w) with
 * `own_axes`, where w are the speeds v[speed[k]], zero where that is -1 (the first alone may be).
 */
typedef struct {
  int at, speed[3], own_axes;
} frot_turn;

/* A law of friction on one relative motion: sliding, rolling, turning in a pin, slip of a clutch.
 * FROT_BY_NORMAL: the coefficients times |lam[bounded_by[0]]| bound lam[row]. FROT_BY_PIN: times
 * sqrt(lam[bounded_by[0]]^2 + lam[bounded_by[1]]^2), both readings. FROT_BY_VALUE: the coefficients
 * are the bounds themselves. */
typedef struct {
  int contact;       /* the liaison or item of the text it belongs to */
  int bound;         /* frot_bound */
  int row;           /* row of the relative motion */
  int bounded_by[2]; /* rows of the reaction that bounds, else -1 */
  int rolling;       /* 1: told as rolling, not as slip */
  int fixed;         /* 1: its coefficients depend on parameters only */
  int prescribed;    /* 1: its motion depends on no speed: both sides are prescribed */
  int shown[2];      /* variables that are its motion: zero while it holds; else -1 */
} frot_element;

/* A step of a large tree of bodies: the step before it or -1, its speeds among the unknowns of its
 * group. `auxiliary`: they are zero in the motion. `faces_ground`: what is beyond keeps its
 * orientation whatever carries it. Its parts of the group's matrix, which are what tree.h says, and
 * of its factor begin at `data` and `factor`. Steps stand after those before them. */
typedef struct {
  int above, first, count, auxiliary, faces_ground, data, factor;
} frot_link;

/* Unknowns of the core and rows that act on each other, in no posture on others: they share no
 * matrix. The unknowns are places in z: speeds first, then auxiliary ones, then algebraic ones.
 * `general`: the matrix is any matrix and `spread` gives E; else it is a mass matrix and E = J'.
 * Its parts of packed arrays begin at: vector (n items), matrix (n x n, by columns), metric
 * (n_speeds x n_speeds), entries (n_rows x n), square (n_rows x n_rows). Of a mass matrix given by
 * `links`, those of `width` components, the matrix and the metric are as long as these need. */
typedef struct {
  int general;
  int n, n_speeds, n_auxiliary;
  int n_rows, n_contacts, n_elements;
  const int *unknowns, *rows, *contacts, *elements;
  int vector, matrix, metric, entries, square;
  int width, n_links;
  const frot_link *links;
} frot_group;

/* Groups and states that depend on each other: their functions read no state of others. They take
 * (t, q, v, u, p, d, y, numbers), of q, v, u, p and d the places given here, y whole; their results
 * are those of the whole model's functions of these names over what is the island's: coordinates
 * and conditions in the order given, what belongs to groups one group after the other. `numbers`
 * are those by which it differs from others with the same functions. What has no group (states,
 * conditions, power) is one more island. Groups of an island follow each other.
 * `sleeps`: it depends neither on time nor on blocks. The first n_located conditions are located.
 */
typedef struct {
  int sleeps, first_group, n_groups;
  int nq, nv, nu, np, nd, n_conditions, n_located;
  const int *q, *v, *u, *p, *d, *conditions;
  const double *numbers;
  frot_callable kinematics, dynamics, spread, sizes;
} frot_island;

enum frot_rule {
  FROT_POSITIVE = 0,
  FROT_NOT_NEGATIVE = 1,
  FROT_FINITE = 2,
  FROT_NOT_BELOW_PREVIOUS = 3,
  FROT_NOT_ZERO = 4,      /* it is divided by */
  FROT_NOT_BELOW_MIN = 5, /* the value before it */
  FROT_NOT_ABOVE_MAX = 6
};

/* A value the model must have, with the sentence's subject: "mass of body 'hoop'". */
typedef struct {
  int rule;
  const char *subject, *place;
} frot_check;

/* A body whose place depends on parameters, inputs or unknowns of blocks at given states. `by`: the
 * liaison that carries it, or "" where the equations of the text prescribe its motion. */
#define FROT_WHERE 3 /* numbers that tell a place of a figure */
#define FROT_PLACE 9 /* place and turn of the body, velocity of what carries it: 3 each */
typedef struct {
  const char *body, *by, *place;
} frot_carried;

/* A statement of the section `initial`. */
typedef struct {
  const char *text, *place, *unit; /* unit of its two sides */
} frot_statement;

/* What the figures of a liaison may lose: words with the liaison, and those of the numbers that
 * tell where, " at u = %.6g"; place of the liaison. */
typedef struct {
  const char *text, *where, *place;
} frot_vanishing;

/* An applied force, or a state. */
typedef struct {
  const char *name, *place;
} frot_load;

/* A discrete value that is what another one was before. */
typedef struct {
  const char *of, *place;
} frot_held;

/* A strong component of the text's equations that no explicit formula solves. Its unknowns are
 * y[first .. first + count). residual(t, q, v, u, p, d, y [, z, lam]) -> r (count), dr/dy by
 * columns (count x count), size of the terms of r (count). `linear`: r is linear in its own
 * unknowns. `late`: it reads z, the accelerations, or the reactions, and is solved after them; it
 * then takes the two arguments more. Blocks are solved in order, the late ones last in the list;
 * their unknowns lie in y in the same order. */
typedef struct {
  frot_callable residual;
  int first, count, linear, late;
  const char *name, *place; /* the unknowns, and the place of its first equation */
} frot_block;

/* A condition of the text: its words and place, and whether a change of it is told as an event. */
enum frot_told { FROT_TOLD_NEVER = 0, FROT_TOLD_RISING = 1, FROT_TOLD_ALWAYS = 2 };
typedef struct {
  const char *text;
  int told; /* frot_told */
  const char *place;
} frot_condition;

/* What `update` may ask for beside new values. */
enum frot_outcome_kind {
  FROT_OUTCOME_TERMINATE = 0,
  FROT_OUTCOME_FAIL = 1,
  FROT_OUTCOME_WARN = 2,
  FROT_OUTCOME_FAULT = 3 /* the event cannot do what it says */
};
typedef struct {
  int kind;
  const char *text, *place;
} frot_outcome;

/* Which integrator a run takes; FROT_AUTO changes between the two. */
enum frot_method { FROT_AUTO = 0, FROT_EXPLICIT = 1, FROT_IMPLICIT = 2 };

/* Pattern of a Jacobian J (n x n) and of the factors L + U of shift I - J, whose row and column k
 * are those of state order[k]. Row k of the factors has the columns column[start[k]] .. up to
 * start[k + 1], ascending; its diagonal stands at diagonal[k]. Entry e of J is in row entry_row[e]
 * and column entry_column[e], and goes to place[e] of the factors. n = 0: the matrix is dense. */
typedef struct {
  int n, entries;
  const int *order, *start, *column, *diagonal;
  const int *entry_row, *entry_column, *place;
} frot_pattern;

/* What the function `jacobian` of a motion gives: derivatives of lines, in q, v and the unknowns y
 * of the early blocks. The lines are those of owners in order: q' (nq), then of each group A z - E
 * lam - h (n), J z + c (n_rows) and the coefficients of its elements (2 each), last the residuals
 * of the early blocks. Entry e is in line[e] and column[e]; those of owner k begin at first[k]
 * (n_groups + 3 items). Group k depends on the columns group_column[group_start[k]] .. up to
 * group_start[k + 1]. directions: 0, or the function gives all lines' derivatives in the direction
 * that is its last argument: it is called for each, with one in the columns of that direction, no
 * two of which meet in a line. With a `pattern` the Jacobian's entries are those of q', then group
 * after group, by the columns of the group, those of its speeds. */
typedef struct {
  int directions;
  const int *line, *column, *first, *direction, *group_start, *group_column;
} frot_lines;

/* One scalar variable. */
enum frot_type { FROT_REAL = 0, FROT_INTEGER = 1, FROT_BOOLEAN = 2, FROT_MODE = 3 };

/* Inputs of the generated functions, in this order:
 *   t, q (nq), v (nv), u (nu), p (np), d (nd: conditions 0/1, then the sides +1/-1 of the contacts,
 *   then the discrete variables), y (ny: unknowns of the blocks)
 *
 * The states are q and v. The speeds v are those whose rates are unknowns of the core system
 *   A z = h + E lam,   z (nw) = v' (nv), auxiliary accelerations (na, zero in the motion: in their
 * place stand the reactions of the liaisons that coordinates keep), algebraic unknowns of the core
 * (nc), where the rows accelerate by J z + c. The rates q' are explicit; q_speed[k] is the speed
 * that is the rate of q[k], or -1 where q[k] is another state. Matrices are dense within their
 * groups, packed one group after the other, by columns; every row of J and every column of E has
 * one entry for each unknown of its group. Every argument is given and every result taken. */
typedef struct {
  const char *name;
  const char *key; /* identity of the compiled model; kept in saved states */
  int nq, nv, na, nc, nu, np, ny, n_rows, n_contacts, n_elements, n_conditions, n_discrete;
  int n_blocks, n_invariants, n_whens, n_outcomes, n_carried, n_paced;
  /* the first n_located conditions change by the motion; the n_timed after them are linear in time
   * and depend on nothing else that moves; the rest change at events only */
  int n_located, n_timed;
  int n_watched; /* equations of `watched` */
  int n_vanishing;
  int n_held;  /* the last n_held discrete values are what others were before: see `update` */
  int n_modes; /* the first n_modes discrete values are modes of contacts, which the text reads */
  int n_turns; /* orientations among the coordinates */
  int n_groups;
  int n_islands; /* 0: all is one, and the functions of the whole model are called */
  int n_matrix, n_metric, n_entries, n_square; /* items of the packed arrays of all groups */
  int general;                                 /* a group is general */
  int late_rates;     /* q' or the power depend on y of late blocks, z or lam: `rates` gives them */
  int time_dependent; /* forces, coefficients or located conditions depend on time */
  int method;         /* frot_method of the text */
  int has_jacobian;   /* 1: the implicit method can run: q' not late */
  double implicit_price; /* explicit steps that cost what an implicit one does */
  int n_guessed;         /* guesses of places */
  int n_checks, n_position, n_velocity, n_statements, n_variables, n_loads;
  /* the first variables are the modes of the contacts that have one, the others are real */

  /* parameters(p, set, u) -> p complete (np), checks (n_checks), unilateral (n_contacts),
   *   experiment (start stop tolerance interval max_step; NaN where the text is silent), nominal
   *   sizes of the states (nq, 0: not given) */
  frot_callable parameters;
  /* start(t, u, p) -> q guess, v guess, y guess, discrete variables at the start */
  frot_callable start;
  /* The functions of the state take (t, q, v, u, p, d, y).
   * initial_position -> residual (n_position), its transposed Jacobian in q (nq x n_position), size
   *   of its terms (n_position), its transposed Jacobian in y (ny x n_position) */
  frot_callable initial_position;
  /* guessed -> by how much each guess of a place is missed (n_guessed), its transposed Jacobian in
   * q (nq x n_guessed), the size that it is measured by; q where the search begins but for the
   * guesses that are no linear functions of q */
  frot_callable guessed;
  /* initial_velocity -> the same in v: (nv x n_velocity), (ny x n_velocity) */
  frot_callable initial_velocity;
  /* kinematics, dynamics, spread and sizes: islands have their own, and then only `sizes` is called
   * for the whole, for the second of its results.
   * kinematics -> gap (n_contacts), rows J (n_entries), rate (n_rows), conditions
   * (n_conditions) */
  frot_callable kinematics;
  /* sides -> what chooses the side of each contact at the start (3 x n_contacts): height of its
   * point or rim's centre over the line, then what tells where that is zero: the part of the normal
   * that is against gravity, and the height of the body's G. A side chosen once is kept.
   * -> sizes of the lengths that each gap is made of beside the coordinates (n_contacts) */
  frot_callable sides;
  /* places -> FROT_PLACE values of each carried body. Called where n_carried > 0. */
  frot_callable places;
  /* vanishing -> distance from where each has no tangent or normal (n_vanishing), no number where
   * it has none; numbers that tell where (FROT_WHERE x n_vanishing). Called after a failure, where
   * n_vanishing > 0. */
  frot_callable vanishing;
  /* pace -> what depends on time at given states (n_paced), and its rates by time alone (n_paced).
   * Called where n_paced > 0. */
  frot_callable pace;
  /* dynamics -> q' (nq), A (n_matrix), h (nw), J (n_entries), c (n_rows), rate (n_rows), gap
   *   (n_contacts), conditions (n_located), coefficients of motion and of rest (2 x n_elements),
   *   power of the forces that have no potential (1) */
  frot_callable dynamics;
  /* spread -> E (n_entries), metric (n_metric: symmetric positive definite, what `least change` of
   *   speeds means). Called where `general`. */
  frot_callable spread;
  /* rates(..., y, z (nw), lam (n_rows)) -> q' (nq), power (1). Called where `late_rates`. */
  frot_callable rates;
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
  /* block_slopes -> residual of the blocks that are not late (ny_early), its transposed Jacobians
   * in q (nq x ny_early), in v (nv x ny_early), in y (ny_early x ny_early): for initial values */
  frot_callable block_slopes;
  /* update(..., y, z (nw), lam (n_rows), fired (n_whens: 1 for each `when` that fires), before
   *   (n_discrete)) -> q (nq) and v (nv) after reinit, discrete values (n_discrete), outcomes
   *   (n_outcomes: 1 where asked). In d stand the discrete values after the event as far as they
   * are known, in `before` those before. The last n_held values follow another value: they are what
   *   it was before. */
  frot_callable update;
  /* timers(u, p, d) -> slopes of the timed conditions in time, their values at time zero (n_timed).
   *   Called where n_timed > 0. */
  frot_callable timers;
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
  /* energy -> kinetic, potential */
  frot_callable energy;

  const double *p_default; /* np */
  const double *u_default; /* nu */
  const frot_contact *contacts;
  const frot_turn *turns; /* n_turns */
  const frot_element *elements;
  const frot_group *groups;
  const frot_island *islands; /* n_islands */
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
  const frot_load *equations;       /* n_watched: their words and places */
  const int *position_statement;    /* n_position: statement of each scalar equation */
  const int *velocity_statement;    /* n_velocity */
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
  const frot_block *blocks;  /* n_blocks */
  const int *when_condition; /* n_whens: it fires when this condition comes to hold */
  const int *mode_contact;   /* n_modes: the contact whose mode it is */
  const unsigned char
      *when_at_start;           /* n_whens: 1 where it also fires if that holds at the start */
  const frot_outcome *outcomes; /* n_outcomes */
} frot_model;

typedef struct {
  int status; /* frot_status */
  /* contact; check, statement, or of FROT_CHATTER a condition or, counted on, a held value; second
   * statement or condition: -1 where none; of FROT_INITIAL without statement -2 for speeds; of
   * FROT_DIVERGE the item is 0 where time takes the contact apart */
  int contact, item, other;
  double t, value;
  double where[FROT_WHERE]; /* of FROT_VANISHED */
} frot_fault;

typedef struct {
  double t;
  int kind, contact;
  int before, after; /* frot_mode, or frot_friction for rolling */
  int solutions;
  int reserved;
} frot_event;

typedef struct {
  long long steps, rejected, evaluations, events;
  long long implicit_steps, jacobians; /* steps of the implicit method among `steps` */
  long long unsearched; /* instants at which other motions were not looked for: too many modes */
  double blurred; /* largest error of a step, relative, that rounding made there beyond its bound */
  long long crossings; /* steps through postures in which rows that hold depend on each other */
  long long free;      /* speeds at the start that no permanent row holds */
} frot_statistics;

/* The model compiled together with the kernel. */
extern const frot_model frot_the_model;

/* Options of a run, fixed at frot_start. */
enum frot_indeterminate { FROT_REST = 0, FROT_CONTINUE = 1, FROT_HALT = 2 };
typedef struct {
  double tolerance; /* <= 0: the model's own */
  int on_indeterminate;
  int reserved;
} frot_options;

/* Head of the flat block of an instance; its arrays follow it (see layout.h). */
typedef struct frot_state frot_state;
typedef struct frot_work frot_work;

/* Where segments and events go, in memory of the caller. A segment takes frot_segment_size doubles
 * at most: one in which islands sleep refers to one before it for what stands still. Its first item
 * is its length, its third the time at which it begins. The first of each memory stands by itself.
 * With segments NULL only events are recorded. The events need room for frot_events_at_once. */
typedef struct {
  double *segments;
  long long segment_capacity, segment_used; /* doubles */
  frot_event *events;
  long long event_capacity, event_count;
  long long last;        /* where the last segment begins */
  long long whole, naps; /* the kernel's own: the last that stands by itself, and what slept */
} frot_recorder;

/* Called now and then with the time reached; a nonzero answer stops the run. May be NULL. */
typedef int (*frot_monitor)(void *context, double t);

size_t frot_state_size(const frot_model *model);      /* bytes */
size_t frot_work_size(const frot_model *model);       /* bytes */
long long frot_segment_size(const frot_model *model); /* doubles of the longest segment */

/* Events that one instant may bring. */
long long frot_events_at_once(const frot_model *model);

/* Fill a new state with the defaults of the model. */
void frot_state_clear(const frot_model *model, frot_state *state);

/* Parameters and inputs, in SI. A value that differs from the one held is noted, and takes effect
 * at frot_start or, in a run, at the time reached (frot_settle). */
void frot_set_parameter(const frot_model *model, frot_state *state, int index, double value);
void frot_set_input(const frot_model *model, frot_state *state, int index, double value);
double frot_get_parameter(const frot_model *model, const frot_state *state, int index);
double frot_get_input(const frot_model *model, const frot_state *state, int index);

/* Evaluate the parameters: dependent values, checks, and experiment[4] = start stop tolerance
 * interval (NaN where the text is silent). */
int frot_settle_parameters(const frot_model *model, frot_state *state, frot_work *work,
                           double experiment[4]);

/* Solve the initial values at time t and the first modes. `options` NULL: defaults. */
int frot_start(const frot_model *model, frot_state *state, frot_work *work, double t,
               const frot_options *options);

/* Let values set since the last call take effect at the time reached. Does nothing if none differs.
 * FROT_CHECK and FROT_REFUSED: the old values stay, and the run can go on with them. */
int frot_settle(const frot_model *model, frot_state *state, frot_work *work);

/* Run until time t is inside the current segment: an instant that differs from t by rounding is t.
 * The recorder may be NULL. On FROT_FULL call again. */
int frot_advance(const frot_model *model, frot_state *state, frot_work *work, double t,
                 frot_recorder *recorder, frot_monitor monitor, void *context);

/* Values of all variables at the time reached by frot_start or frot_advance. */
int frot_values(const frot_model *model, frot_state *state, frot_work *work, double *values);

/* Values at any time inside a recorded segment (parameters and inputs are those of `state`). */
int frot_segment_values(const frot_model *model, frot_state *state, frot_work *work,
                        const double *segment, double t, double *values);
/* The same at many times in order, over recorded segments in order, which take `size` doubles
 * together; values: count rows. A time belongs to the last segment that begins at or before it, or
 * after it by rounding. */
int frot_sample(const frot_model *model, frot_state *state, frot_work *work, const double *segments,
                long long size, const double *times, long long count, double *values);

/* Residual kinetic + potential + dissipated - work in since the start, and the energy scale:
 * balance[0..4] = residual, scale, kinetic + potential, dissipated, work. */
int frot_energy(const frot_model *model, frot_state *state, frot_work *work, double balance[5]);

double frot_time(const frot_state *state);
/* The next instant at which time by itself changes something, INFINITY if there is none. */
double frot_next_instant(const frot_state *state);
const frot_fault *frot_last_fault(const frot_state *state);
const frot_statistics *frot_run_statistics(const frot_state *state);

/* The sentence that tells a fault, with names, values in SI and the remedy, ended by NUL. */
void frot_fault_text(const frot_model *model, const frot_state *state, char *text, size_t size);
/* Places (file:line:column, one a line) of what the fault is about; empty if none is to blame. */
void frot_fault_places(const frot_model *model, const frot_state *state, char *text, size_t size);
/* The sentence that tells an event: "floor: slip -> stick at t = 1.86884131838260". */
void frot_event_text(const frot_model *model, const frot_event *event, char *text, size_t size);

/* Whether a block of `size` bytes is a state of this model (key, size, version). */
int frot_state_valid(const frot_model *model, const void *block, size_t size);

#ifdef __cplusplus
}
#endif
#endif
