/* Slips of several components near zero: their error, their turning, and where they end. */
#ifndef FROT_VANISHING_SLIPS_H
#define FROT_VANISHING_SLIPS_H

#include "model/workspace.h"

/* Why the guard of a slip has fired: it has come to zero with the end of a step; it goes through
 * zero where the posture takes it there, and no law holds it. */
enum { FROT_SLIP_ENDED = 3, FROT_SLIP_PASSES = 4 };

/* The slip of each element of several components at the end of the step, and the rates of its
 * components along and across it, after the last stage: w->guards.end_slip. */
void frot_measure_slips(const frot_model *m, const frot_state *s, frot_work *w);

/* The largest error of such a slip in the step over its bound: the tolerance times the smaller of
 * |s| at both ends, and what rounding of its terms leaves. A slip that turns by more than 72
 * degrees in the step counts as an error far beyond it: its estimate cannot be trusted. After
 * frot_measure_slips; 0 where there is none. */
double frot_slip_error(const frot_model *m, const frot_state *s, const frot_work *w, double h,
                       double tolerance);

/* Keep the slips at the end of a step that was taken. Those that have come to zero, and with them
 * those that vanish at the same instant, fire their guards: the step ends with an event. A slip
 * that began with the step goes where its speed says from now on: returns whether there is one. */
int frot_end_slips(const frot_model *m, frot_state *s, frot_work *w);

/* After frot_measure_slips: the time after which the slip of e is zero, 0 where it does not shrink.
 */
double frot_time_to_vanish(const frot_work *w, int e);

/* After frot_measure_slips: whether the slip of e shrinks to zero and does not turn there. */
int frot_shrinks_to_zero(const frot_work *w, int e);

/* Fire the guards of the slips that vanish within about the time dt, which others take to vanish:
 * with these they do so at one instant. Only those below a `small` part of what they usually are.
 */
void frot_end_slips_with(const frot_model *m, frot_state *s, const frot_work *w, double dt,
                         double small);

/* Where slips begin: the length of a step in which they keep their direction, INFINITY where none
 * begins. What they move is measured by what their loads bring it in that step. */
double frot_begin_slips(const frot_model *m, frot_state *s, frot_work *w);

#endif
