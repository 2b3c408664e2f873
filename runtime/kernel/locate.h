/* The end of a step moved to the instant at which a guard falls. */
#ifndef FROT_LOCATE_H
#define FROT_LOCATE_H

#include "work.h"

/* Shorten the step *h from t so that it ends where the listed guard is zero, first looked for after
 * the part theta of it: by the secant on steps made anew, so that the event is as exact as the
 * steps are. Its stages are those of the step *h, its end, next to theirs, comes after *end, and
 * its dense output serves up to there. *falls: whether the guard does fall there; a dip that never
 * reaches zero is no event. Returns FROT_OK or the status of a failed evaluation. */
int frot_locate(const frot_model *m, frot_state *s, frot_work *w, double t, int guard, double theta,
                double *h, double *end, int *falls);

#endif
