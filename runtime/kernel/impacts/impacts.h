/* Impacts at an instant of the motion: which contacts take part, and what they do to the speeds. */
#ifndef FROT_IMPACTS_H
#define FROT_IMPACTS_H

#include "model/workspace.h"

/* Let the contacts that close with speed at the instant meet, then find the modes (frot_resolve). v
 * <- the speeds after the impacts, which are recorded as events. Contacts that part, and elements
 * at rest that slip, have these modes then. Where no motion is admissible a contact is pressed by
 * its own friction, and the modes are searched again. `first`: at the start of a run. */
int frot_meet_and_resolve(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                          double *v, int first, frot_recorder *recorder);

#endif
