/* Guards that fall inside a step, by their dense output: its derivative follows each of them at no
 * cost in evaluations. */
#ifndef FROT_GUARD_CROSSING_H
#define FROT_GUARD_CROSSING_H

#include "model/workspace.h"

/* Bernstein coefficients of the listed guard k over the step h, after frot_make_dense. */
void frot_guard_polynomial(const frot_state *s, const frot_work *w, int k, double h, double g[7]);

/* Whether the polynomials of the guards meet their values at the stages of a step in which nothing
 * moves. There these are what time makes of the loads, exactly, and nothing else shows whether the
 * step has followed them: an estimate of its error is none where it passes over most of a load that
 * is much shorter. */
int frot_guards_fit_stages(const frot_state *s, const frot_work *w, double h);

/* Whether a listed guard may fall inside the step whose stages have run: not one that is far from
 * zero in all of them, beside what it changes there; where nothing moves in it (`rests`), not one
 * that time leaves alone. */
int frot_guard_may_cross(const frot_state *s, const frot_work *w, int rests);

/* The first listed guard to fall inside the step h from t, the part of the step after which it does
 * in *theta; -1 when none does. A guard that was zero at an event is known no better than its slope
 * times the resolution of time. */
int frot_first_crossing(const frot_model *m, const frot_state *s, const frot_work *w, double t,
                        double h, double *theta);

/* How far below zero the listed guard k, with these coefficients over h, goes before it has fallen.
 * A force that is zero at the start of the step, to rounding or beside what it is inside as near as
 * events are located, may have either sign there and shortly after: where all loads vanish with
 * it, only that it is clearly below says that it has come to be negative. So it is with what fell
 * to no effect: no instant is known better, and where loads follow a slip within moments (a damper
 * on a light body) it is only beyond it that rest can hold. */
double frot_crossing_tolerance(const frot_model *m, const frot_state *s, const frot_work *w, int k,
                               double h, const double g[7]);

/* The value below which the listed guard k, known with that slope in time, has fallen at t. */
double frot_crossing_level(const frot_model *m, const frot_state *s, const frot_work *w, int k,
                           double t, double slope);

/* Whether the gap of another contact than that of the listed guard has been crossed at the end of a
 * step, which the polynomial of a longer step has not shown; where the guard is a condition that is
 * no end of a figure, also whether such an end has been. */
int frot_crosses_other_gap_or_end(const frot_model *m, const frot_state *s, const frot_work *w,
                                  int guard);

/* Fire the listed guards that have come to zero together with the first one at the end of the step.
 */
void frot_fire_guards(const frot_model *m, frot_state *s, const frot_work *w, int first, double t,
                      double h);
/* Fire a listed guard at the start (FROT_AT_START), where no step is possible. */
void frot_fire_at_start(frot_state *s, const frot_work *w, int guard);

/* After a stage that gave no number (its argument in w->step.z1): a located condition may have
 * passed through zero before it, beyond which its branch has no value, as a root. The first such
 * one, -1 if none; *part is the part of the step h from t after which it seems to be zero. */
int frot_condition_passed(const frot_model *m, frot_state *s, frot_work *w, double t, double h,
                          double *part);

/* Where no step is possible: the listed guard of a condition that is zero there, so that the branch
 * may end before it, as that of a tank that runs empty: the one `passed`, else the one that moves
 * most beside its size in h, the shortest step. -1 if there is none. */
int frot_condition_at_zero(const frot_model *m, frot_state *s, frot_work *w, int passed, double t,
                           double h);

/* Whether the listed guard k, zero at the start t of the step, seems to fall there at theta, and to
 * rise again or, of a condition, to rise by the slope at the start. What departs with no
 * acceleration of its own grows so slowly at first that the polynomial of a long step, exact to a
 * part of its largest value, may seem to fall: a shorter step tells. */
int frot_may_be_dip(const frot_model *m, frot_state *s, frot_work *w, int k, double theta, double t,
                    double h);

#endif
