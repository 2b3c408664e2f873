/* Sizes of states against which their errors are measured. Of the states that are no coordinates:
 * a coordinate's size is known from its speed.
 *
 * A state is worth what it is now, or was a moment ago: the memory fades with the steps, which are
 * as long as the motion allows, so that a state that swings through zero keeps its size and one
 * that had a spike loses it. What dies out fades faster than any memory of so much a step: it is
 * worth little more than what a step leaves of it, else steps at the limit of their stability would
 * seem good beside what has gone. What it had at most counts by thirty decades less, and `nominal`
 * by what its author says.
 *
 * A state that is small beside others of its dimension can be known no better than what the others
 * make of it: an error of state i, in units of its size, moves state j by |J_ji| min(tau_i, tau_j)
 * of that, with tau the time over which an error lives. So what has hardly left zero, the foot of
 * a front, is followed in units of what drives it, and a trace that matters by itself. */
#ifndef FROT_ERROR_SCALES_H
#define FROT_ERROR_SCALES_H

#include "model/workspace.h"

/* Sizes into w->sizes.own (nq) from what a step brings the states, w->sizes.change (nq), what it
 * leaves them, w->sizes.left (nq, INFINITY of an implicit step: what is stiff dies out in it by
 * any part, and its error with it), and what they are worth. Returns 1 when a size is zero. */
int frot_state_sizes(const frot_model *m, const frot_state *s, frot_work *w);

/* Sizes of the coordinates and speeds into w->sizes.own (nq + nv) for a step h to w->step.z1: the
 * largest they have had, or what the step brings by `slope` at its start and, of a `stiff` one, by
 * its end: what is stiff does not go where its slope points to. */
void frot_motion_sizes(const frot_model *m, const frot_state *s, frot_work *w, double h,
                       const double *slope, int stiff);

/* Whether state j is small beside another of its dimension, after frot_state_sizes. */
int frot_is_small(const frot_model *m, const frot_state *s, const frot_work *w, int j);

/* Raise the sizes of small states to what the others make of them in a step h. With the Jacobian at
 * the start of the step in place; without one (`by_slopes`) those that leave zero in the step count
 * as a hundredth of the largest of their dimension. */
void frot_raise_small(const frot_model *m, const frot_state *s, frot_work *w, double h,
                      int by_slopes);

/* What the states are worth after a step to z (nq). */
void frot_update_state_sizes(frot_state *s, const frot_work *w, const double *z);

/* A step that failed again and again shows by w->sizes.change what its states will soon be: they
 * are worth that, however much shorter it becomes. */
void frot_keep_state_sizes(frot_state *s, const frot_work *w);

/* What rounding does to a state's rate in a step h: a coordinate is no better than its speed. */
double frot_rate_rounding(const frot_model *m, const frot_state *s, const frot_work *w, int state,
                          double h);

/* What of a state is rounding whatever its size: of the items of a unit quaternion the last place
 * of 1, of other states nothing. */
double frot_rounding_of_turn(const frot_model *m, int state);

/* Scratch of scales from the arena. */
void frot_bind_sizes(const frot_model *m, frot_size_work *w, frot_arena *a);

#endif
