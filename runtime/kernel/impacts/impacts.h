/* Impacts at an instant of the motion: which contacts take part, and what they do to the speeds. */
#ifndef FROT_IMPACTS_H
#define FROT_IMPACTS_H

#include "model/workspace.h"

/* Let the contacts that close with speed at the instant meet: v <- the speeds after their impacts,
 * which are recorded as events. Contacts that part, and elements at rest that slip, have these
 * modes then. `first`: at the start of a run. Does nothing where no contact closes with speed. */
int frot_make_impacts(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                      double *v, int first, frot_recorder *recorder);

/* The same where no motion is admissible: a contact of the component of `contact` is pressed by its
 * own friction, as its slip continues, until that ends (L. Lecornu 1905; F. Genot, B. Brogliato
 * 1999). *made: whether there is such a contact. */
int frot_make_tangential_impact(const frot_model *m, frot_state *s, frot_work *w, double t,
                                const double *q, double *v, int contact, frot_recorder *recorder,
                                int *made);

#endif
