/* The end of a step moved to the instant at which a guard is crossed. */
#ifndef FROT_EVENT_LOCATION_H
#define FROT_EVENT_LOCATION_H

#include "stepping/attempt.h"

/* Shorten the step so that it ends where a->guard is zero, first looked for after the part a->theta
 * of it: by the secant on steps made anew, so that the event is as exact as the steps are. Its
 * stages are those of the step a->h, its end, next to theirs, comes a->beyond after theirs, and its
 * dense output, made if a->dense, serves up to there. *crosses: whether the guard is zero there; a
 * dip that never reaches zero is no event. Returns FROT_OK or the status of a failed evaluation. */
int frot_locate(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a, int *crosses);

/* Of a step that has been kept: its end is that of its stages again, from which its dense output is
 * made. */
void frot_return_to_stages(const frot_work *w, const frot_attempt *a);

#endif
