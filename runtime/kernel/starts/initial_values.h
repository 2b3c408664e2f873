/* Initial coordinates and speeds from the statements of the section `initial`. */
#ifndef FROT_INITIAL_VALUES_H
#define FROT_INITIAL_VALUES_H

#include "model/workspace.h"

/* Coordinates q and speeds v at time t: those nearest to the guesses, in the metric of the mass,
 * that satisfy the statements and the liaisons. Chooses the sides of the contacts, sets the
 * conditions and closes the contacts that touch (s->modes, s->d). Returns FROT_OK or the status of
 * the fault. */
int frot_initial_values(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                        double *v);

#endif
