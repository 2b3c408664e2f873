/* Impacts at an instant of the motion: which contacts take part, and what they do to the speeds. */
#ifndef FROT_IMPACTS_H
#define FROT_IMPACTS_H

#include "model/workspace.h"

/* Let the contacts that close with speed at the instant meet: v <- the speeds after their impacts,
 * which are told as events. Contacts that part, and elements at rest that slip, have these modes
 * then. `first`: at the start of a run. Does nothing where no contact closes with speed. */
int frot_make_impacts(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                      double *v, int first, frot_recorder *recorder);

#endif
