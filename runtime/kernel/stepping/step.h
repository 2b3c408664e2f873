/* One accepted step of the integrator: a new segment.
 *
 * Uses attempt.h (until the error is within its bound), step_length.h, event_location.h,
 * guard_crossing.h, error_estimate.h, rounding_noise.h and step_ends.h. */
#ifndef FROT_STEP_H
#define FROT_STEP_H

#include "model/workspace.h"

/* Advance from the end of the current segment by one step in the current modes, to the next event
 * at most. Replaces the current segment, into the recorder too, if there is one that has room;
 * s->pending says that an event waits at its end (or, when no progress was possible, at its start:
 * then the segment is left as it is). Returns FROT_OK or the status of the fault recorded. */
int frot_step(const frot_model *m, frot_state *s, frot_work *w, frot_recorder *recorder);

#endif
