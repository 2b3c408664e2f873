/* What happens at an instant: conditions change, the text's `when`s fire, modes follow. */
#ifndef FROT_EVENT_ITERATION_H
#define FROT_EVENT_ITERATION_H

#include "model/workspace.h"

/* Let everything happen that the guards fired bring about at time t, at coordinates q and speeds v
 * (both may change): conditions change, every `when` whose condition comes to hold fires, its new
 * values change conditions in turn, until none changes; then the modes are resolved.
 *
 * `first`: nothing was known before (start). FROT_OK, FROT_TERMINATED (recorded in s->phase) or the
 * status of the fault recorded. */
int frot_process_events(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                        double *v, int first, frot_recorder *recorder);

#endif
