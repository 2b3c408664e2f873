/* The records that the tables of a model are made of (model.h): what a liaison, a law of friction,
 * a group of unknowns, a block of equations or a condition of the text is to the kernel.
 */
#ifndef FROT_TABLES_H
#define FROT_TABLES_H

#include "numerics/extended_precision.h"
#include "numerics/sparse_pattern.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef int (*frot_function)(const double **arg, double **res, long long *iw, double *w, int mem);

/* A generated function and the scratch it needs, in items of its arrays. */
typedef struct {
  frot_function call;
  int n_arg, n_res, n_iw, n_w;
} frot_callable;

/* A generated function in extended precision: its arguments are of ordinary width. */
typedef int (*frot_wide_function)(const double **arg, frot_wide **res, long long *iw, frot_wide *w,
                                  int mem);
typedef struct {
  frot_wide_function call;
  int n_arg, n_res, n_iw, n_w;
} frot_wide_callable;

/* What is read of the mode of a contact: it, the sense of its slip, or 1 where it is closed. */
enum frot_mode_reading { FROT_READS_MODE = 0, FROT_READS_SENSE = 1, FROT_READS_CLOSED = 2 };

/* What bounds the friction of an element: the size of one normal reaction, a sum of lengths of
 * reactions of one to three components (a pin; a guide, which presses at both of its ends), or a
 * value of the text (a brake, a clutch). */
enum frot_bound { FROT_BY_NORMAL = 0, FROT_BY_PIN = 1, FROT_BY_VALUE = 2 };
/* Components of the reactions that bound friction, and their lengths that add up, at most. */
#define FROT_BOUNDING 5
#define FROT_NORMS 3

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
  int sliding;       /* the first element that its variable `mode` tells of: it slips where one
                        does; FROT_NEVER_SLIPS, or -1 */
  int power;         /* its variable `power`, zero where all its elements hold, or -1 */
  int mode;          /* its variable `mode`, or -1: one relation of many of a liaison */
  int kinematic;     /* 1: a relation between velocities alone, which has no gap */
  int followed;      /* the block that solves for the place where its figures are nearest, or -1 */
  int turns;         /* 1: it keeps from turning: its gap is an angle, of which the reach is 1 */
  int impact;        /* the rule of its impacts: frot_impact_rule */
} frot_contact;

/* A unit quaternion r among the coordinates, q[at .. at + 4): 2 r' = (0, w) r, or r (0, w) with
 * `own_axes`, where w are the speeds v[speed[k]], zero where that is -1 (the first alone may be).
 */
typedef struct {
  int at, speed[3], own_axes;
} frot_turn;

/* A motion of a joint: it turns, goes along a way, or both in one slip. */
enum frot_joint_motion { FROT_JOINT_TURNS = 0, FROT_JOINT_GOES = 1, FROT_JOINT_BOTH = 2 };

/* A law of friction on one relative motion: sliding, rolling, turning in a pin, slip of a clutch.
 * FROT_BY_NORMAL: the coefficients times |lam[bounded_by[0]]| bound lam[row]. FROT_BY_PIN: times
 * the sum of the lengths of reactions of norm[k] components each, lam[bounded_by[..]], all
 * readings. FROT_BY_VALUE: the coefficients are the bounds themselves. */
typedef struct {
  int contact;                   /* the liaison or item of the text it belongs to */
  int bound;                     /* frot_bound */
  int row;                       /* row of the relative motion */
  int bounded_by[FROT_BOUNDING]; /* rows of the reactions that bound, else -1 */
  int norm[FROT_NORMS];          /* of a pin: components of each of them, else 0 */
  int rolling;                   /* 1: reported as rolling, not as slip */
  int fixed;                     /* 1: its coefficients depend on parameters only */
  int prescribed;                /* 1: its motion depends on no speed: both sides are prescribed */
  int shown[2];                  /* variables that are its motion: zero while it holds; else -1 */
  int part, parts; /* of a motion of several components, elements that follow each other: which
                      of how many, else 0 and 1: slip_frames.h */
  int joint;       /* frot_joint_motion: what moves, where it does not roll */
} frot_element;

/* A step of a large tree of bodies: the step before it or -1, its speeds among the unknowns of its
 * group. `auxiliary`: they are zero in the motion. `faces_ground`: what is beyond keeps its
 * orientation whatever carries it. Its parts of the group's matrix, which are what articulated.h
 * says, and of its factor begin at `data` and `factor`. Steps stand after those before them. */
typedef struct {
  int above, first, count, auxiliary, faces_ground, data, factor;
} frot_link;

/* Unknowns of the core and rows that act on each other, in no posture on others: they share no
 * matrix. The unknowns are places in z: speeds first, then auxiliary ones, then algebraic ones.
 * `general`: the matrix is any matrix and `spread` gives E; else it is a mass matrix and E = J'.
 * `given`: where its rows (n_rows x n) are not zero in every posture, ascending.
 * Its parts of packed arrays begin at: vector (n items), matrix (n x n, by columns; of a mass
 * matrix those of the speeds, n x n_speeds, then the diagonal of the rest), metric (n_speeds x
 * n_speeds), entries (n_rows x n), square (n_rows x n_rows). Of a mass matrix given by `links`,
 * those of `width` components, the matrix and the metric are as long as these need. */
typedef struct {
  int general;
  int n, n_speeds, n_auxiliary;
  int n_rows, n_contacts, n_elements, n_given;
  const int *unknowns, *rows, *contacts, *elements, *given;
  int vector, matrix, metric, entries, square;
  int width, n_links;
  const frot_link *links;
} frot_group;

/* What functions of a part of the scene read: of q, v, u, p and d the places given here, and the
 * `numbers` by which its owner differs from others with the same functions. */
typedef struct {
  int nq, nv, nu, np, nd;
  const int *q, *v, *u, *p, *d;
  const double *numbers;
} frot_reads;

/* Groups and states that depend on each other: their functions read no state of others. They take
 * (t, q, v, u, p, d, y, numbers), what `reads` says and y whole; their results are those of the
 * whole model's functions of these names over what is the island's: coordinates and conditions in
 * the order given, what belongs to groups one group after the other. What has no group (states,
 * conditions, power) is one more island. Groups of an island follow each other.
 * `sleeps`: it depends neither on time nor on blocks. The first n_located conditions are located.
 */
typedef struct {
  int sleeps, first_group, n_groups, n_conditions, n_located;
  const int *conditions;
  frot_reads reads;
  frot_callable kinematics, dynamics, spread, sizes;
  frot_wide_callable wide;
} frot_island;

/* What is put together at the start without regard to the rest: places, or speeds, that no speed,
 * relation, statement or guess binds to others. The unknowns are the first n_unknowns of `reads.q`,
 * or of `reads.v`, ascending. Of it are these orientations, groups, contacts, scalar statements and
 * guesses (for each of the latter the first item here of the vector that it is an item of), and the
 * blocks of equations that anything here follows from; of `y`, their unknowns, the first n_own
 * follow from the unknowns of the part. The islands are those of its groups. The functions take (t,
 * q, v, u, p, d, y, numbers) as those of an island, but of y the places given here; x are the
 * unknowns. stating -> residual (n_stated), its transposed Jacobian in x (n_unknowns x n_stated),
 * size of its terms (n_stated), its transposed Jacobian in the first n_own of y (n_own x n_stated)
 * guessing -> of places by how much each guess is missed (n_guessed), its transposed Jacobian in x,
 * the size of its terms; of speeds by how much, the size that it is measured by, its slopes in the
 * speeds that may follow it (n_unknowns x n_guessed), those of all items of the vector that it is
 * an item of (three for each), 1 for each speed that may (n_unknowns) sides (of places) -> what
 * chooses the side of each contact at the start (3 x n_contacts): height of its point or rim's
 * centre over the line, then what tells where that is zero: the part of the normal that is against
 * gravity, and the height of the body's G; sizes of the lengths that each gap is made of beside the
 * coordinates (n_contacts) slopes -> of the equations of the own blocks the transposed Jacobians in
 * x (n_unknowns x n_own), in the first n_own of y (n_own x n_own). Each where there is anything to
 * give. */
typedef struct {
  int n_unknowns, n_turns, n_groups, n_islands, n_contacts, n_stated, n_guessed, n_blocks, n_own,
      ny;
  const int *turns, *groups, *islands, *contacts, *stated, *guessed, *vectors, *blocks, *y;
  frot_reads reads;
  frot_callable stating, guessing, sides, slopes;
} frot_part;

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

/* An equation of the text that may give no number. `lacks`: the unknown that it is solved for and
 * that a branch of it does not hold, or NULL: where that branch is taken its index is another. */
typedef struct {
  const char *name, *place, *lacks;
} frot_watched;

/* An applied force, or a state. */
typedef struct {
  const char *name, *place;
} frot_load;

/* A discrete value that is what another one was before: when the `when`s of lower ranks had acted.
 */
typedef struct {
  const char *of, *place;
  int rank;
} frot_held;

/* A strong component of the text's equations that no explicit formula solves. Its unknowns are
 * y[first .. first + count). residual(t, q, v, u, p, d, y [, z, lam]) -> r (count), dr/dy by
 * columns (count x count), size of the terms of r (count); `switching` the same where conditions on
 * these unknowns are as they are and not as d says, none where there are none. `linear`: r is
 * linear in its own unknowns. `late`: it reads z, the accelerations, or the reactions, and is
 * solved after them; it then takes the two arguments more. `followed`: the unknowns say where
 * figures touch; which of several places counts is decided by closest_features.c. Blocks are solved
 * in order, the late ones last in the list; their unknowns lie in y in the same order. */
typedef struct {
  frot_callable residual, switching;
  int first, count, linear, late, followed;
  const char *name, *place; /* the unknowns, and the place of its first equation */
} frot_block;

/* A condition of the text: its words and place, and whether a change of it is an event that is
 * recorded; or that the place where a contact touches goes beyond the end of a figure, in parts of
 * its length: the contact, else -1. */
enum frot_told { FROT_TOLD_NEVER = 0, FROT_TOLD_RISING = 1, FROT_TOLD_ALWAYS = 2 };
typedef struct {
  const char *text;
  int told; /* frot_told */
  const char *place;
  int contact;
} frot_condition;

/* What `update` may ask for beside new values. */
enum frot_outcome_kind {
  FROT_OUTCOME_TERMINATE = 0,
  FROT_OUTCOME_FAIL = 1,
  FROT_OUTCOME_WARN = 2,
  FROT_OUTCOME_FAULT = 3,  /* the event cannot do what it says */
  FROT_OUTCOME_STRIKE = 4, /* a percussion, an event when it acts */
  FROT_OUTCOME_MEET = 5    /* figures meet without a common normal */
};
typedef struct {
  int kind;
  const char *text, *place;
} frot_outcome;

/* Discrete values of a percussion: `due` is put to 1 once its time comes; the force of the text
 * acts with the factor `strike`, which is 1 while the kernel asks what the percussion does;
 * `outcome` has its name. */
typedef struct {
  int due, strike, outcome;
} frot_percussion;

/* Which integrator a run takes; FROT_AUTO changes between the two. */
enum frot_method { FROT_AUTO = 0, FROT_EXPLICIT = 1, FROT_IMPLICIT = 2 };

/* What the function `jacobian` of a motion gives: derivatives of lines, in q, v and the unknowns y
 * of the early blocks. The lines are those of owners in order: q' (nq), then of each group A z - E
 * lam - h (n), J z + c (n_rows), the coefficients of its elements (2 each) and the slips of those
 * that are parts of a motion of several components (1 each), last the residuals
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

#ifdef __cplusplus
}
#endif
#endif
