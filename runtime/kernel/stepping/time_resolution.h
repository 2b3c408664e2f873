/* The length of a step that passes over nothing that time alone brings.
 *
 * Claim: a load, bound or condition that is given by time, and whose change lasts a 1e-4 th of the
 * run or more, is met by a step that resolves it. The error control sees what happens at the stages
 * of a step; between them the rates of all that depends on time are sampled, SAMPLES times a run.
 * Limit: what is shorter than that between two samples is passed over; `max_step` of the experiment
 * is for it. The run is the one of the text's experiment, or what has been run if that is longer.
 */
#ifndef FROT_TIME_RESOLUTION_H
#define FROT_TIME_RESOLUTION_H

#include "model/workspace.h"

/* The longest step at t; `still`: nothing moves. It follows the run of the text and the time
 * already run, not the time at which the caller stops: values do not depend on when they are read.
 */
double frot_longest_step(const frot_model *m, const frot_state *s, const frot_work *w, double t,
                         int still);

/* The first step's length where the text does not tell how long the run is. */
double frot_finest_step(const frot_model *m, const frot_state *s, const frot_work *w, double h);

/* h, or the length of the step that ends before the rates grow beyond what its stages will see.
 * The states are in w->step.z0. */
double frot_resolve_time(const frot_model *m, frot_state *s, frot_work *w, double t, double h);

#endif
