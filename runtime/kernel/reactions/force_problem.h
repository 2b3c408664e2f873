/* The reactions of one group in given modes, as unknowns of a system. */
#ifndef FROT_FORCE_PROBLEM_H
#define FROT_FORCE_PROBLEM_H

#include "evaluation/held_modes.h"
#include "model/indexing.h"
#include "model/workspace.h"

/* The unknown reactions are w->reactions.unknown[0 .. unknowns): first those of held rows, then
 * friction that follows readings. Friction that follows a held normal goes with its column:
 * w->reactions.fold, FROT_FOLDS places for each unknown, the rows, w->reactions.fold_ratio, the
 * ratios. */
typedef struct {
  const frot_model *m;
  frot_work *w;
  const frot_group *g;
  const frot_contact_mode *modes;
  int held, unknowns, equations; /* of these, those that hold rows: */
  int holding;
  int kept;      /* the last of those, of rows without a reaction of their own */
  int stretched; /* 1: springs may be stretched, beyond an event: equal_springs.h */
  int evenly;    /* 1: of reactions that are not unique all weigh alike: minimum_norm.c */
} frot_problem;

/* List the unknowns of p->g in p->modes and the friction that goes with each; at_rest as in
 * frot_group_reactions. */
void frot_list_unknowns(frot_problem *p, const unsigned char *at_rest);

/* What the reaction of unknown c, with the friction that goes with it, does to a row. */
double frot_unknown_effect(const frot_problem *p, int row, int c);

/* A row's value without the unknowns: with the friction that values bound. */
double frot_known_part(const frot_problem *p, int row);

/* x (n_speeds) <- what the unknown c does to u, or with c < 0 what is known of u. */
void frot_unknown_column(const frot_problem *p, int c, double *x);

/* The conditions that hold the held rows into the first lines of w->linear.matrix and
 * w->linear.right, the columns in units w->reactions.unit_of (held_rows.c). The leading dimension
 * is the number of unknowns. Returns 1 when they contradict each other. */
int frot_hold_rows(frot_problem *p);

/* Friction that follows readings (friction_rows.c). What is known of the readings that bound it,
 * and what each unknown does to them, once for all directions of pins' reactions. */
void frot_read_bounds(const frot_problem *p);

/* The conditions lam - ratio (its reading) = 0 in the directions w->reactions.along, after those of
 * the held rows. */
void frot_follow_readings(frot_problem *p);

/* Turn the directions of the pins whose friction follows to their reactions. Into `rest` what is
 * missing in each equation; returns the largest part of a friction that is, beyond rounding. */
double frot_update_pin_directions(const frot_problem *p, double *rest);

/* Its reactions w->core.lam by the inertia alone, after frot_list_unknowns. Returns 0 where they do
 * much to each other: they are to be found from what frot_effects forms. */
int frot_iterate_friction(const frot_problem *p);

/* Least reactions, in units w->reactions.unit_of, of the system that w->linear.matrix holds
 * (minimum_norm.c). Returns the number of equations of equal springs among them. */
int frot_solve_least(const frot_problem *p, double *x);

/* The reactions of a problem that is posed but for its unknowns, as frot_group_reactions; where a
 * spring of shared reactions is stretched, w->reactions.stretched says so. */
int frot_solve_reactions(const frot_problem *posed, const unsigned char *at_rest);

/* The same in p->modes of which contacts whose springs are stretched bear nothing, found in turn:
 * of such reactions no guard says which bear. p->modes are then those. Returns 1 where there are
 * none.
 */
int frot_find_bearing(frot_problem *p, const unsigned char *at_rest);

/* Where these are beyond what friction on slips of several components, at rest, is bounded by: the
 * least that are within the bounds (cone_reactions.c). Returns 1 where there are none. */
int frot_keep_within_bounds(const frot_problem *p, double *x);

#endif
