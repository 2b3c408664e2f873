/* The scratch memory: one struct for each room, with what each field holds, its size and unit.
 *
 * Nothing in it lives longer than a call from outside. Arrays called scratch belong to the function
 * that runs; a pointer may be NULL where its comment says so. Sizes in items; n_x are counts of the
 * model, nw nz nx ng those of the layout (state.h). Units are those of SI. */
#ifndef FROT_WORKSPACE_H
#define FROT_WORKSPACE_H

#include "model/arena.h"
#include "model/model.h"
#include "model/search_workspace.h"
#include "model/start_workspace.h"
#include "model/state.h"

/* Sizes that several rooms share. */
typedef struct {
  int equations; /* relations at once: statements, contacts, held rows, invariants */
  int states;    /* unknowns of these relations */
  int square;    /* of the largest linear system: of a group, a part, or of all where equations of
                    the text bind them together */
  int across;    /* unknowns of the largest of these */
  int slopes;    /* items of the rows of the largest at the start, or of the invariants */
  int widest;    /* unknowns of the largest group */
  int block;     /* of the largest block */
} frot_extent;

static inline int frot_larger(int a, int b) { return a > b ? a : b; }

/* The numbers that functions of a part of the scene read. */
static inline int frot_count_reads(const frot_reads *r) {
  return r->nq + r->nv + r->nu + r->np + r->nd;
}

/* Whether a motion that a law opposes has several components. */
static inline int frot_has_vectors(const frot_model *m) {
  int several = 0;
  for (int e = 0; e < m->n_elements; e++) several |= m->elements[e].parts > 1;
  return several;
}

/* Generated functions: arguments, results, their own scratch. */
typedef struct {
  const double **arg; /* arguments of the function called */
  double **res;       /* its results, NULL: not wanted */
  long long *iw;      /* its integers */
  double *w;          /* its doubles */
  double *values;     /* results that are read at once */
  double *inputs;     /* nu: inputs of an instant, where they change with time */
} frot_call_work;

/* What of the model is awake, each list ascending: sleeping.h. */
typedef struct {
  int n; /* states */
  int n_islands, n_groups, n_contacts, n_elements, n_located;
  int *place;    /* nx: place of each state among those awake, or -1 */
  int *states;   /* n */
  int *islands;  /* n_islands */
  int *groups;   /* n_groups */
  int *contacts; /* n_contacts */
  int *elements; /* n_elements */
  int *located;  /* n_located: conditions */
} frot_awake_lists;

/* Sizes of an island and where its parts begin in packed arrays: island_calls.h. */
typedef struct {
  int unknowns, rows, contacts, elements, given; /* of its groups together */
  int matrix, entries, metric;                   /* first items */
  int matrices, all_entries, metrics;            /* numbers of items */
} frot_island_extent;

/* sleeping.h. */
typedef struct {
  const frot_awake_lists *now; /* the lists in use: `all` or `some` */
  frot_awake_lists all;        /* of the whole model */
  frot_awake_lists some;       /* of what is awake in a step */
  int n;                       /* states in `now` */
  int known;                   /* islands that sleep, as `some` was filled; 0: it is not filled */
  int filled;                  /* 1: `some` was filled just now */
  double *power;               /* n_islands: dissipated power, W */
  frot_island_extent *extent;  /* n_islands */
  unsigned char *state;        /* nq + nv: scratch, awake */
  unsigned char *group;        /* n_groups: scratch, awake */
  unsigned char *condition;    /* n_located: scratch, awake */
  double *values;              /* scratch: arguments and results of an island's function */
} frot_awake_work;

/* Equations that no formula solves, of `n` unknowns in the largest block: algebraic_loops.h. */
typedef struct {
  double *y;       /* ny: the guess, then the solution */
  int failed;      /* block that has no solution, or -1 */
  int singular;    /* 1: its Jacobian is singular */
  double shaken;   /* relative change given to solutions to measure rounding, 0: none */
  int pattern;     /* bit of an unknown's index that says the sign of that change */
  int unwanted;    /* 1: the blocks are solved already and stay: guesses.c */
  int within;      /* 1: a step runs, and a solution may not change its branch */
  const int *some; /* blocks to be solved of those that are not late; NULL: all */
  int n_some;      /* their number */
  double *r;       /* 2 n: residuals; at the guess behind them */
  double *j;       /* n x n: Jacobian by columns */
  double *lu;      /* n x n: LU of it */
  double *size;    /* 2 n: sizes of the residuals' terms */
  double *step;    /* 4 n: Newton step, scratch, guess, solution kept */
  double *scale;   /* n x n + 5 n: scratch of the LU and of least squares */
  int *pivot;      /* n: rows of the LU */
} frot_block_work;

/* The core system A z = h + E lam and its rows J z + c at one place: evaluate.h. Packed arrays hold
 * one group after the other (frot_group). */
typedef struct {
  double t;                /* place evaluated last: time, s */
  const double *q, *v, *d; /* coordinates, speeds, discrete values; NULL: none yet */
  double *qd;              /* nq: rates of the coordinates */
  double *mass;            /* packed: A; of a mass matrix its lower triangle */
  double *h;               /* nw: loads */
  double *given;           /* entries of the rows that the model gives */
  double *rows;            /* packed: J, entries of rows over a group's unknowns */
  double *c;               /* n_rows: free term of each row's acceleration */
  double *rate;            /* n_rows: speed along each row */
  double *gap;             /* n_contacts: distance, m */
  double *condition;       /* n_conditions: positive where it holds */
  double *coefficient;     /* 2 n_elements: static and kinetic coefficient of friction */
  double *power;           /* 1: dissipated power, W */
  double *effect;          /* packed: E of a general core; NULL where there is none */
  double *metric;          /* packed: metric of the speeds of a general core */
  double *factor;          /* packed: Cholesky factor L of the metric */
  double *unit;            /* packed: columns of L over their diagonals: dense.h */
  double *share;           /* nw: the diagonals that they were divided by */
  double *force;           /* nw: L^-1 h, or A^-1 h of a general core */
  double *half;            /* packed: L^-1 J', or A^-1 E of a general core */
  double *lu;              /* packed: LU of a general A */
  double *lu_scale;        /* 2 nw: scales of its rows and columns */
  int *lu_pivot;           /* nw: its rows */
  unsigned char *wanted;   /* n_rows: rows to be formed */
  unsigned char *formed;   /* n_groups: frot_formed */
  int n_given;             /* items of `given` */
  int *listed;             /* n_rows: scratch, rows of a group that are formed */
  int *support;            /* 2 n_rows: from, to: where four rows abreast are not zero */
  int *reach;              /* 2 n_rows: from, to: where a row is not zero in every posture */
  double *free;            /* n_rows: accelerations (of readings: reactions) without reactions */
  double *delassus;        /* packed: what a unit reaction in one row does to another */
  double *load;            /* nw: size of all loads */
  double *load_size;       /* nw: size of the terms of accelerations */
  double *row_load;        /* n_rows: size of what all loads do to a row */
  double *bias_size;       /* n_rows: size of the terms of c */
  double *lam;             /* n_rows: reactions, N or N m */
  double *a;               /* nw: solution z: accelerations, and other unknowns of the core */
  double *frame;       /* 9 n_elements: axes of slips (slip_frames.h); NULL: one component each */
  double *lam_of_text; /* n_rows: reactions along the axes of the text; NULL as `frame` */
  double *rest;        /* nw: scratch */
  double *column;      /* nw: scratch */
  double *abreast;     /* scratch: four rows of L^-1 J' at a time */
  double *inertia, *twist, *motion, *momenta; /* scratch of articulated bodies: mass_matrix.h */
} frot_core_work;

/* Results in extended precision, as those of frot_core_work; NULL without such functions:
 * extended_inertia.h. */
typedef struct {
  int island;                   /* the one that they are of, -1: the whole, FROT_NO_ISLAND */
  unsigned char *of;            /* n_groups: 1: of the last evaluation */
  frot_wide *mass, *h, *rows;   /* A, loads, entries of rows */
  frot_wide *factor, *force;    /* L, L^-1 h */
  frot_wide *half;              /* L^-1 J' */
  frot_wide *loads, *given, *w; /* scratch: results and doubles of the function */
  frot_wide *inertia, *twist;   /* scratch of articulated bodies */
} frot_wide_work;

/* No island, nor the whole (-1). */
enum { FROT_NO_ISLAND = -2 };

/* A friction that follows what bounds it: friction_fixed_point.c. */
typedef struct {
  double *friction;      /* its reaction, N or N m */
  const double *entries; /* of its row, not zero in from .. to */
  const int *norm;       /* components of each reaction of a pin, else NULL */
  int from, to;
  int at[FROT_BOUNDING];          /* readings that bound it, among the group's unknowns; -1 */
  double force[FROT_BOUNDING];    /* what loads make of these */
  double reaction[FROT_BOUNDING]; /* what a pass makes of these */
  double ratio;                   /* friction over the size of the reaction, with its sign */
  double size;                    /* of the reaction in this pass */
  double per_size;                /* one over the size of its terms */
  double next;                    /* friction of the next pass */
} frot_follower;

/* Instants of a step at which friction is noted: its stages, and where an event is searched. */
enum { FROT_INSTANTS = 16 };

/* Laws of friction that one normal bounds, at most: their rows go with its column. */
#define FROT_FOLDS 3

/* Reactions in given modes: reactions.h, force_problem.h. */
typedef struct {
  int *unknown; /* n_rows: rows whose reactions are unknowns */
  int *owner;   /* n_rows: the element of each unknown that is a friction */
  int *fold;    /* FROT_FOLDS n_rows: rows of friction that goes with an unknown, -1 */
  unsigned char
      *friction; /* n_rows: the unknown is no friction (0), one (1), bounded by a value (2) */
  unsigned char *carried;   /* n_rows: 1: the row depends on others: redundant_rows.c */
  double *fold_ratio;       /* FROT_FOLDS n_rows: friction over the normal reaction, with sign */
  double *ratio;            /* n_elements: friction over what bounds it, with sign */
  double *along;            /* FROT_BOUNDING n_elements: guessed directions of bounding reactions */
  double *unit_of;          /* n_rows: unit in which an unknown is small: minimum_norm.c */
  double *weight;           /* n_rows: weight of an unknown in the least norm; scratch */
  double *solution;         /* n_rows: scratch */
  double *known;            /* FROT_BOUNDING a friction: what loads do to what bounds it */
  double *effects;          /* the same by rows: what each unknown does to it */
  frot_follower *followers; /* frictions of a group that follow readings */
  double *rate;             /* n_groups: what a pass leaves of a change, in this step */
  double *spring_rows, *compatible; /* scratch and result of equal_springs.h, */
  int *springs;                     /* as it */
  frot_contact_mode
      *bearing; /* n_contacts + n_elements: modes in which stretched springs bear nothing */
  unsigned char *carried_before, *spare_before; /* n_rows: as before springs are unloaded */
  int sliding_spring; /* 1 + a redundant contact that slides, since the last step; 0: none */
  int stretched;      /* contact of shared reactions whose spring is stretched, or -1 */
  double *cone_rows;  /* scratch of cone_reactions.c; NULL: slips have one component each */
  frot_cone *cones;   /* n_contacts, as it */
  frot_ball *balls;   /* n_elements, as it */
  double *noted;      /* FROT_INSTANTS n_elements: frictions noted: friction_predictor.c */
  double *instant;    /* FROT_INSTANTS n_groups: their times, s */
  double *heading;    /* n_elements: components of the directions of slips: slip_frames.h */
  int *instants;      /* n_groups: how many are noted */
  int dependent;      /* 1: reactions are not unique */
  int *sign;          /* n_groups: sign of the determinant, 0: none */
  int jammed;         /* group that has no reactions in the last stages, or -1 */
  int follow;         /* 1: inside a step directions are guessed from the last stage's */
  int warm;           /* 1: reactions of the stage before are there: friction_fixed_point.c */
  int ahead;          /* 1: an event may be behind: slip_frames.h */
  int beyond;         /* with `ahead`, the group whose reactions are out of bounds, or -1 */
} frot_reaction_work;

/* Orthonormal rows of a group in the metric of its speeds: held_rows.c, projection.c. */
typedef struct {
  int rank;                 /* of the rows of a group */
  int follow;               /* 1: redundancy is decided, and followed: redundant_rows.h */
  unsigned char *spare;     /* n_rows: the row depends on others and is left out */
  unsigned char *kept;      /* n_rows: the row is one of the basis */
  const double *unilateral; /* n_contacts: 1: it may part; part of the state: row_order.h */
  int *along;               /* n_rows: number of basis vectors that a held row is made of */
  int *order;               /* n_rows: order in which rows were made orthonormal; marks of speeds */
  int *way;                 /* n_rows: rows of tangent_cone.h */
  double *left;             /* n_rows: length left over by the rows before it, 0: dependent */
  double *direction;        /* packed: its direction */
  double *basis;            /* rank x speeds: orthonormal vectors */
  double *parts;            /* parts of a row along them */
  double *bias;             /* n_rows: right sides along them */
  double *bias_size;        /* n_rows: sizes of the terms of these */
} frot_span_work;

/* The linear system being solved, of `big` equations in `across` unknowns at most: all scratch. */
typedef struct {
  double *matrix;  /* big x the larger of both */
  double *right;   /* 2 big */
  double *scratch; /* as factorisations and least squares need */
  int *pivot;      /* 2 of the largest size */
} frot_linear_work;

/* Relations that a projection or the start makes hold, `n` of them. */
typedef struct {
  double *jacobian; /* n x states: their slopes, by rows */
  double *residual; /* n: what they are missed by */
  double *size;     /* n: sizes of their terms */
  double *step;     /* states, nw and n: the change, scratch */
  double *unit;     /* states: unit in which a change of a state counts */
  int *rows;        /* n_rows, n_contacts, n_elements: rows of the core that they are */
  int *bounds;      /* 2 n: from, to: the states that a relation reads, at the start */
} frot_relation_work;

/* Other places where figures are nearest: closest_features.h. */
typedef struct {
  double *begin;        /* n_followed: where searches begin */
  double *y;            /* ny: places found */
  double *far;          /* n_contacts: gaps at the end of the step, m */
  double *flags;        /* n_conditions: conditions with the places found */
  double *kept;         /* n_conditions: conditions as they were */
  signed char *changed; /* n_contacts: 1: nearer elsewhere, -1: on the other side */
  int count;            /* how many have changed */
} frot_nearer_work;

/* Guards of the modes: switching_functions.h, vanishing_slips.c. */
typedef struct {
  int *list;             /* ng: guards that can become negative in the modes */
  int count;             /* their number */
  double *size;          /* ng: sizes of their terms */
  double *shown;         /* ng: sizes shown by steps that failed: error_estimate.h */
  double *motion;        /* n_groups: size of all that moves a group */
  double *end_reaction;  /* FROT_BOUNDING n_elements: bounding reactions at the end of the step */
  double *end_friction;  /* n_elements: friction there */
  double end_kinetic;    /* kinetic energy there, J */
  double *end_slip;      /* 4 n_elements: slips of several components there; NULL: none has them */
  double *end_direction; /* 2 n_elements: their directions there */
  double *passed_slip;   /* n_elements: those that are to stop from outside; NULL as `end_slip` */
} frot_guard_work;

/* A step of a method: dormand_prince.h; postures of loops: singular_posture.h. */
typedef struct {
  double *k;           /* DP_ALL x nz: slopes of the stages, of what is awake */
  double *z0;          /* nz: all states at the start */
  double *z1;          /* nz: all states at the end; between steps scratch */
  double *z;           /* nz: the states awake at the stage that runs; between steps scratch */
  double *y_end;       /* ny: unknowns of the blocks at the end */
  double *f;           /* DP_DENSE x nz: dense output */
  double *first;       /* nz: slope at the start */
  double *doubt;       /* nz: error of slopes by a posture nearby */
  double *excused;     /* 2 nv: error of speeds by it: posture_rounding.c */
  double *beyond;      /* nv: error of a speed above its bound, else 0 */
  double *parameters;  /* np: the parameters while rounding_noise.c changes them */
  double *left;        /* (DP_STAGES + 1) x n_rows: length left of each row in each stage */
  double *direction;   /* packed: direction of a row in the first stage */
  double *motion;      /* packed: rates of rows along the motion */
  unsigned char *near; /* DP_STAGES + 1: the stage is near a posture */
  int little;          /* 1: a row is short in a stage */
  int *order;          /* n_contacts: rows of loops in the order in which they are measured */
  int *ordered;        /* n_groups: how many a group has */
  int worst;           /* state with the largest error, or -1 */
  int rounded;         /* 1: an error beyond its bound passes for rounding */
  int pardoned;        /* 1: an error of an implicit step does */
  double noisy;        /* part of the worst error that rounding may be */
  double turning;      /* turn of weak rows over the largest admitted: posture_rounding.h */
  double looked;       /* time from which values inside the step are read, s: advance.c */
} frot_step_work;

/* Scales of errors, in the units of the coordinates: error_scales.h. */
typedef struct {
  double *change; /* nq: change in a step */
  double *left;   /* nq: what a step leaves of a size */
  double *own;    /* nq + nv: the scale of each */
  double *alike;  /* nq: the largest of coordinates that are alike */
  int *states;    /* the coordinates that are states of equations, no places */
  int count;      /* their number */
} frot_size_work;

/* Implicit methods: jacobian.h cuts the two arrays into parts. */
typedef struct {
  double *items;
  int *pivot;
  double rate; /* convergence of Newton's method in the stages of the last step: radau.h */
} frot_implicit_work;

/* Events of the text: conditions.h, event_iteration.c. */
typedef struct {
  double *was;             /* n_conditions: as they were when `when`s were last evaluated */
  double *firing;          /* n_whens: 1: it fires */
  double *outcome;         /* n_outcomes: 1: it is required */
  double *before;          /* n_conditions: as they were before the event */
  double *known;           /* n_conditions: values before, NaN: none */
  double *timer;           /* 2 n_timed: slopes of conditions on time, values */
  double *discrete;        /* n_discrete: values after the round */
  double *discrete_before; /* n_discrete: values before the event */
  double *held;            /* n_held: values of `pre` that have been taken */
  double *normals;         /* packed: rows before the sides are chosen; NULL without edges */
} frot_event_work;

struct frot_work {
  frot_layout layout;
  frot_call_work call;
  frot_awake_work awake;
  frot_block_work blocks;
  frot_core_work core;
  frot_wide_work wide;
  frot_reaction_work reactions;
  frot_span_work span;
  frot_linear_work linear;
  frot_relation_work relations;
  frot_opening_work opening;
  frot_nearer_work nearer;
  frot_guard_work guards;
  frot_step_work step;
  frot_size_work sizes;
  frot_implicit_work implicit;
  frot_event_work events;
  frot_search_work search;
  frot_share_work share;
  frot_impact_work impacts;
  double *pace;  /* 4 n_paced: sizes and rates of what time moves: time_resolution.c */
  double *tape;  /* ns: a segment: segment_store.h */
  double *stood; /* bodies, contacts, rows before a change from outside: parameter_change.c */
};

/* Set the pointers of a scratch block into itself. */
void frot_bind_work(const frot_model *model, frot_work *work);

/* Call a generated function with the arguments and results that are set. */
static inline void frot_call(frot_work *w, const frot_callable *function) {
  function->call(w->call.arg, w->call.res, w->call.iw, w->call.w, 0);
}

#endif
