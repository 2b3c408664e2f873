/* One accepted step of the integrator: a new segment.
 *
 * The rooms it uses, each of which knows only those after it: attempt (until its error is within
 * its bound), length, locate (events), falls (guards inside a step), error and noise (how long it
 * may be), ends, stages (evaluations). */
#ifndef FROT_STEP_H
#define FROT_STEP_H

#include "model/workspace.h"

/* Advance from the end of the current segment by one step in the current modes, to the next event
 * at most. Replaces the current segment, into the recorder too, if there is one that has room;
 * s->pending says that an event waits at its end (or, when no progress was possible, at its start:
 * then the segment is left as it is). Returns FROT_OK or the status of the fault recorded. */
int frot_step(const frot_model *m, frot_state *s, frot_work *w, frot_recorder *recorder);

#endif
