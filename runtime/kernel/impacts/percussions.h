/* Percussions: forces without end in a time without length, the limit of a large force that acts
 * for a short time (E. J. Routh 1877). Positions stay; speeds change by the impulse and by those of
 * the reactions, whose laws hold at each instant within: contacts press or part, slips end or
 * begin.
 */
#ifndef FROT_PERCUSSIONS_H
#define FROT_PERCUSSIONS_H

#include "model/workspace.h"

/* Let the percussions act that are due at the instant: v <- the speeds after them, with events and
 * modes. *struck: whether any was. FROT_OK or the status of the fault recorded. */
int frot_strike(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                double *v, int *struck, frot_recorder *recorder);

#endif
