/* The estimate of a step's local error, and the sizes it is measured against. */
#ifndef FROT_ERROR_ESTIMATE_H
#define FROT_ERROR_ESTIMATE_H

#include "model/workspace.h"

/* Estimate of the local error of the step h just run, over its bound: at most 1 for a good step,
 * NaN for no number. In w->step.worst the state it is of, or -1. The Jacobian is evaluated only
 * where a small state is what limits the step. */
double frot_error_ratio(const frot_model *m, frot_state *s, frot_work *w, double t, double h);

/* A step that failed again and again shows by its stages what its guards will soon be: they are
 * followed to that, however much shorter it becomes. */
void frot_keep_guard_sizes(const frot_state *s, const frot_work *w);

/* What rounding does to the derivatives at time t, into the state: that of the values and of the
 * time, by their influence, and that of the evaluation, by what a second difference leaves where
 * nothing bends so fast. A value whose derivative is nothing but rounding would shrink the step
 * without end. `deep`: also what the rounding of rates does by the speeds that it makes. The stages
 * of an explicit step stay, those of its dense output are lost. Returns whether the last evaluation
 * was at the end of the step, as its own was. */
int frot_measure_rounding(const frot_model *m, frot_state *s, frot_work *w, double t, int deep);

/* Bound of the relative error of an explicit step. */
double frot_step_tolerance(const frot_state *s);

#endif
