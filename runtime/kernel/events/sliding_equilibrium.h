/* What its law brings to rest at zero: the condition that this switches would be passed back at
 * once, whichever side it is on, and its rate vanishes there (a root, a power below one). */
#ifndef FROT_SLIDING_EQUILIBRIUM_H
#define FROT_SLIDING_EQUILIBRIUM_H

#include "model/workspace.h"

/* Put the states x of an event at time t where all located conditions that fire are exactly zero,
 * by no more than a few roundings of time along the slope there, or with all other states that come
 * to zero within them. 1 if they stay zero from there on, what they switch being on or off; 0 if
 * they do not, and then x stays what it was. */
int frot_find_sliding_equilibrium(const frot_model *m, frot_state *s, frot_work *w, double t,
                                  double *x);

#endif
