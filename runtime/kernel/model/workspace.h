/* The scratch memory: one struct for each room, which fills it and says what the others may read.
 *
 * Nothing in it lives longer than a call from outside. What one function leaves for the next is
 * said in the contract of its room; arrays called scratch belong to the function that runs. */
#ifndef FROT_WORKSPACE_H
#define FROT_WORKSPACE_H

#include "contact/cone_point.h"
#include "contact/contact_newton.h"
#include "contact/impact_law.h"
#include "model/state.h"

/* Arguments and results of the generated function that is called, and its own scratch. `values`:
 * room for results that are looked at once. */
typedef struct {
  const double **arg;
  double **res;
  long long *iw;
  double *w, *values;
  double *inputs; /* nu: those of an instant, where they change with time */
} frot_call_work;

/* sleeping.h: places of awake islands and of what belongs to them, ascending; n states. */
typedef struct {
  int n, n_islands, n_groups, n_contacts, n_elements, n_located;
  int *place; /* of each state among those awake, or -1 */
  int *states, *islands, *groups, *contacts, *elements, *located;
} frot_awake_lists;

/* island_calls.h: what an island's groups have together, where their parts of packed arrays begin,
 * and the items of these. */
typedef struct {
  int unknowns, rows, contacts, elements, given;
  int matrix, entries, metric;
  int matrices, all_entries, metrics;
} frot_island_extent;

/* sleeping.h: the lists in use, of which n is the number of states; those of a step, filled where
 * `known` islands sleep (0: not), just now if `filled`; power by islands at the last evaluation.
 * Scratch: which are awake, arguments and results of an island's functions. */
typedef struct {
  const frot_awake_lists *now;
  frot_awake_lists all, some;
  int n, known, filled;
  double *power;
  frot_island_extent *extent;
  unsigned char *state, *group, *condition;
  double *values;
} frot_awake_work;

/* algebraic_loops.h: y is the guess before, the solution after; the block that failed last, or -1,
 * and whether it was singular. Solutions are `shaken` by that part of themselves, up or down by bit
 * `pattern` of their index: error_estimate.h. If `some` is not NULL, of those that are not late
 * only these are solved; `within` a step. The rest is the system of one block. */
typedef struct {
  double *y, shaken;
  int failed, singular, pattern, unwanted, within, n_some;
  const int *some;
  double *r, *j, *lu, *size, *step, *scale;
  int *pivot;
} frot_block_work;

/* evaluate.h: results of `dynamics`, `kinematics` and `spread` at t and at what was given last as
 * q, v, d (NULL before); the inertia, packed by groups (of a mass matrix the Cholesky factor L of
 * the metric, L^-1 h, L^-1 J'; of a general core LU of A, A^-1 h, A^-1 E); what it does to the rows
 * wanted, and of which groups what these do to each other is there (formed, n_groups); sizes of all
 * loads and of what they do, and of the terms of c (bias_size, n_rows); reactions lam (n_rows) and
 * the solution a (nw). Of each row where it is not zero in every posture (reach, 2 n_rows: from,
 * to). Scratch: what the functions give of the rows (given), rest and column (nw), the rows of a
 * group that are looked at (listed), four of them abreast and where these are not zero; of large
 * trees inertia, twist, motion and momenta (mass_matrix.h). */
typedef struct {
  double t;
  const double *q, *v, *d;
  double *qd, *mass, *h, *given, *rows, *c, *rate, *gap, *condition, *coefficient, *power;
  double *effect, *metric;
  double *factor, *unit, *share, *force, *half, *lu, *lu_scale;
  int *lu_pivot;
  unsigned char *wanted, *formed;
  int n_given, *listed, *support, *reach;
  double *free, *delassus;
  double *load, *load_size, *row_load, *bias_size;
  double *lam, *a;
  double *frame, *lam_of_text; /* slip_frames.h; NULL where no motion has several components */
  double *rest, *column, *abreast;
  double *inertia, *twist, *motion, *momenta;
} frot_core_work;

/* extended_inertia.h: results of `wide`, the inertia as in evaluate.h, and the island that they are
 * of; which groups were found so in the last evaluation (of, n_groups). Scratch: loads and rows as
 * the function gives them, its own scratch, of large trees inertia and twist. All absent where no
 * function is. */
typedef struct {
  int island;
  unsigned char *of;
  frot_wide *mass, *h, *rows, *factor, *force, *half;
  frot_wide *loads, *given, *w, *inertia, *twist;
} frot_wide_work;

/* No island, nor the whole (-1). */
enum { FROT_NO_ISLAND = -2 };

/* friction_fixed_point.c: a friction, the entries of its row and where these are not zero (from,
 * to), its ratio to what bounds it. Of one that follows readings, where these stand among the
 * unknowns of the group (at: those of a pin, else one, then -1), the components of each reaction of
 * a pin (`norm`, else NULL), and what loads make of them; what a pass makes of them, of the size of
 * the reaction and of the friction; one over the size of its terms. */
typedef struct {
  double *friction;
  const double *entries;
  const int *norm;
  int from, to, at[FROT_BOUNDING];
  double force[FROT_BOUNDING], reaction[FROT_BOUNDING], ratio, size, per_size, next;
} frot_follower;

/* Instants of a step at which friction is noted: its stages, and where an event is looked for. */
enum { FROT_INSTANTS = 16 };

/* Laws of friction that one normal bounds, at most: their rows go with its column. */
#define FROT_FOLDS 3

/* reactions.h: the unknowns and what goes with them; whether reactions are not unique; held rows
 * that depend on those before them; where to begin to look for the pins' directions. Of each
 * unknown friction, twice: what is known of the readings that bound it, and what each unknown does
 * to them.
 */
typedef struct {
  int *unknown, *owner, *fold;
  unsigned char *friction, *carried;
  double *fold_ratio, *ratio, *along, *unit_of, *weight, *solution;
  double *known, *effects;
  frot_follower *followers;
  double
      *rate; /* n_groups: what a pass of friction_fixed_point.c leaves of a change, in the step */
  double *cone_rows; /* cone_reactions.c: equations and scratch, cones and balls */
  frot_cone *cones;
  frot_ball *balls;
  double *noted, *instant; /* friction_predictor.c: n_elements and n_groups times FROT_INSTANTS */
  double *heading;         /* n_elements: slip_frames.h */
  int *instants;           /* of each group, how many of them */
  int dependent, *sign;    /* sign (n_groups): of the determinant, 0 where there is none */
  int jammed;              /* the group that had no reactions in the last stages, or -1 */
  int follow;              /* 1: pins' directions are looked for from the last stage's on */
  int warm;                /* the reactions are those of a stage before: friction_fixed_point.c */
  int evenly;              /* 1: of those that are not unique others are found: minimum_norm.c */
  int ahead;               /* 1: where an event may be behind: slip_frames.h; then */
  int beyond;              /* the group whose reactions have left their bounds, or -1 */
} frot_reaction_work;

/* Orthonormal rows of one group, and what belongs to each, biases with the sizes of their terms:
 * held_rows.c, projection.c. `left` (n_rows): the length that those before it leave of each row
 * that was held last, 0 where it is dependent. */
typedef struct {
  int rank, follow; /* whether `spare` (n_rows) says what depends on others: redundant_rows.h */
  unsigned char *spare, *kept;
  const double *unilateral; /* n_contacts, of the state: which may part, row_order.h */
  int *along;               /* n_rows: how many of them each held row lies along at most */
  int *order; /* n_rows: in which rows were made orthonormal, by their places in the list */
  int *way;   /* n_rows: tangent_cone.h */
  double *left, *direction;
  double *basis, *parts, *bias, *bias_size;
} frot_span_work;

/* Scratch: the linear system that is being solved. */
typedef struct {
  double *matrix, *right, *scratch;
  int *pivot;
} frot_linear_work;

/* The relations that a projection or the search at the start makes hold: their residuals, rows and
 * sizes, the units of the states, the change, and which rows of the core they are. Of those of the
 * start, between which states they stand (bounds: from, to). */
typedef struct {
  double *jacobian, *residual, *size, *step, *unit;
  int *rows, *bounds;
} frot_relation_work;

/* Initial values: witness and reach (3 and 1 a contact) are results of `sides`; `use` says which
 * contacts are equations (start_equations.h). */
typedef struct {
  unsigned char *use;
  double *witness, *reach, *sides;
  double *residual_y, *slopes, *slopes_y;
  int *slopes_pivot;
  double *factor, *row_weight, *off_at_first, *begin, *nearest;
  int *behind;                              /* of each change its speed (unknowns.h) */
  double *here, *first_factor, *first_unit; /* where changes are counted from; metric at `begin` */
  double *found, *way, *next_way, *apart, *scratch; /* nearest_solution.c; scratch: 3 nq */
  double *left;                                     /* homotopy.h */
  double *near, *met, *guess_weight;                /* guesses.h; near: q, y; weights, squares */
  double *begin_y, *fresh, *other; /* unknowns of the blocks at `begin`; initial_values.c: q, y */
  double *x, *read;                /* start_parts.h: the unknowns; arguments of its functions */
  int *own, *rows, *number;        /* own: in order, start_parts.c; number: frot_number_here */
  frot_turn *turns;                /* of the part, among its unknowns */
  unsigned char *state, *chosen;   /* of unknowns, of equations: sequential_guesses.c */
  unsigned char *left_out, *kept; /* left_out: equations, start_equations.c; kept: gauss_newton.c */
  double *descent, *multiplier;   /* tangent_newton.c */
  int *contact_of;                /* of each equation that is a relation of a contact: which */
  double *start, *second;         /* start_branch.c: speeds */
  double *first; /* initial_values.c: q, y and the sides of the place found first, its `use` */
  unsigned char *first_use;
  double *outside; /* contact_sides.c: q, y twice */
} frot_opening_work;

/* closest_features.h: where searches begin, the places found; gaps at the end of the step; flags of
 * the conditions with the places found, and as they were; which contacts are nearer elsewhere (-1:
 * on the other side), how many. */
typedef struct {
  double *begin, *y, *far, *flags, *kept;
  signed char *changed;
  int count;
} frot_nearer_work;

/* switching_functions.h: those that can fall in the modes, the sizes of their terms, what a step
 * that failed again and again showed them to be (error_estimate.h), the size of all that moves each
 * group; pins' reactions (2 n_elements), friction (n_elements) and the kinetic energy at the end of
 * a step (step_ends.h). */
typedef struct {
  int *list, count;
  double *size, *shown, *motion, *end_reaction, *end_friction, end_kinetic;
  double *end_slip, *end_direction; /* vanishing_slips.c: 4 and 2 n_elements */
} frot_guard_work;

/* dormand_prince.h: slopes k (DP_ALL x nz), all states at the start and the end and the awake ones
 * at the stage that runs, unknowns of the blocks at the end, dense output f (DP_DENSE x nz); the
 * state whose error is the worst, or -1, and what part of that rounding may be, whether one passes
 * for rounding alone (error_estimate.h); posture_rounding.h. Between steps z1 and z are scratch.
 * singular_posture.h: what is left of each row in each stage ((DP_STAGES + 1) x n_rows) and its
 * first direction; the slope at the start, what is doubtful in slopes near postures, and excused in
 * errors; errors of speeds that are beyond their bounds, else 0 (nv), and whether one is; the
 * parameters while rounding_noise.c moves them. */
typedef struct {
  double *left, *direction, *first, *doubt, *excused, *beyond, *motion, *parameters;
  unsigned char *near;
  int little;           /* little is left of one in a stage, singular_posture.c */
  int *order, *ordered; /* singular_posture.h: rows of loops as they are measured, and how many a
                           group has */
  double *k, *z0, *z1, *z, *y_end, *f;
  int worst, rounded, pardoned;
  double noisy, turning;
  double looked; /* time from which on somebody looks inside the steps: advance.c */
} frot_step_work;

/* error_scales.h (nq each, own nq + nv); the states that are no coordinates, `count` of them. */
typedef struct {
  double *change, *left, *own, *alike;
  int *states, count;
} frot_size_work;

/* jacobian.h. */
typedef struct {
  double *items;
  int *pivot;
  double rate; /* at which Newton's method came near the stages of the last step: radau.h */
} frot_implicit_work;

/* Events of the text: conditions.h and event_iteration.c. */
typedef struct {
  double *was, *firing, *outcome, *before, *known, *timer;
  double *discrete, *discrete_before, *held, *normals;
} frot_event_work;

/* The search for modes (enumeration.h, admissible.c, slip_lookahead.c, box_qp.c, resolve.c): modes
 * tried, found and before, those that may be closed at the instant; of contacts: which are decided;
 * of elements: whose motion is zero or at rest, where it would go, and which slips no acceleration
 * starts; of both: what is left of their inequalities where that is little, the rates of
 * coordinates, and accelerations of a little later (persistence.c); of both twice: by how much they
 * do not hold (load_sharing_vertices.c); the states before they were settled. */
typedef struct {
  frot_contact_mode *trial, *best, *before, *guess, *guess_ahead, *corner, *idle, *found, *slack,
      *closable;
  unsigned char *certain, *zero, *at_rest, *departs;
  signed char *ahead;
  double *motions, *pivot_bound, *nothing_frozen, *margin, *rates, *set_out, *others, *beyond,
      *moved_from;
  double *along; /* directions of pins' reactions in `best`: there may be solutions in others */
  /* contact_search.c: the equations of a component, their rows, the element of each block or -1 */
  double *problem, *reactions_found;
  frot_contact_block *blocks;
  int *row_of, *block_of, *pivot;
  int *choice, *component, *chosen;
  double turn[2]; /* cosine and sine of where pins' reactions are looked for from: departures.h */
  int exact;      /* whether `best` needs no slack: frot_is_exact */
  int lasts;      /* and whether it lasts: frot_lasts */
  int falls;      /* 1 + what falls later by no more than slack admits, or what begins and does not
                     grow, in the motion looked at last, 0: persistence.c */
  int fades;      /* the same of `best` */
  int against; /* elements that a little later go against what was last found good: slip_lookahead.c
                */
  int corners; /* that may still be looked at in this search: load_sharing_vertices.c */
} frot_search_work;

/* load_sharing_lp.c: the tableau and its basic columns; the columns as they were, whose they are;
 * of contacts whether they are read; growth of the loads where all rests (nw); a normal reaction
 * with the friction that goes with it; the modes before. */
typedef struct {
  double *tableau, *columns, *growth, *normal;
  int *basic, *contact;
  signed char *edge;
  unsigned char *read;
  frot_contact_mode *before;
} frot_share_work;

/* impacts.h: the impact of a component: its rows, the elements or contacts of its blocks (~i of
 * contact i), its matrix, speeds before and after, impulses; the work that each block has taken;
 * what the impulses do to the speeds; which contacts meet. Of percussions: the changes of the rows
 * and of the speeds by them alone, and a frozen state of no speed. */
typedef struct {
  frot_impact_block *blocks;
  frot_contact_block *listed; /* the blocks as they are listed: reactions/contact_blocks.h */
  frot_contact_block *held;   /* of each row, where contacts that have settled are held */
  int *row_of, *block_of, *pivot;
  double *problem, *before, *after, *impulse, *lost, *changes, *scratch;
  double *struck_rows, *struck, *moving;
  unsigned char *meets;
} frot_impact_work;

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
  double *pace;  /* time_resolution.c */
  double *tape;  /* segment_store.h: a segment */
  double *stood; /* parameter_change.c */
};

/* Set the pointers of a scratch block into itself. */
void frot_bind_work(const frot_model *model, frot_work *work);

/* Call a generated function with the arguments and results that are set. */
static inline void frot_call(frot_work *w, const frot_callable *function) {
  function->call(w->call.arg, w->call.res, w->call.iw, w->call.w, 0);
}

#endif
