/* The ends of a step: the slope at its start, and how large values and guards are there. */
#ifndef FROT_STEP_ENDS_H
#define FROT_STEP_ENDS_H

#include "model/workspace.h"

/* Derivative at the start of the step from t into stage 0, the values there into w->step.z0; lists
 * the guards. FROT_OK or a status that is not recorded as a fault. */
int frot_start_slope(const frot_model *m, frot_state *s, frot_work *w, double t);

/* Sizes of the guards' terms at (t, z) into w->guards.size, the pins' reactions and
 * friction into w->guards.end_reaction and end_friction, the kinetic energy; the last evaluation
 * was there. */
void frot_measure_end(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z);

/* The friction measured there is that at the start of the next step. */
void frot_keep_friction(frot_state *s, const frot_work *w);

/* Note how large values and guards have been, forces a moment ago, after frot_measure_end at z;
 * `guards`: the values of those listed. One that is at zero keeps its size until it is not. */
void frot_update_sizes(const frot_model *m, frot_state *s, const frot_work *w, const double *z,
                       const double *guards);

/* Turn the pins' references to their reactions at the end of the step, and with them the guards in
 * its slope. */
void frot_turn_references_at_end(const frot_model *m, frot_state *s, frot_work *w, double *slope);

#endif
