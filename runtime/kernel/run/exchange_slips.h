/* Slips where another integrator steps the motion. */
#ifndef FROT_EXCHANGE_SLIPS_H
#define FROT_EXCHANGE_SLIPS_H

#include "model/workspace.h"

/* Put the slips in w->search.zero at zero exactly in the states x, but those that a posture takes
 * there: a mechanism would stop that moves through it. FROT_OK or a status that is not recorded as
 * a fault. */
int frot_stop_slips(const frot_model *m, frot_state *s, frot_work *w, double *x, int *moved);

/* Of the slips of several components in w->search.zero, which have fired, those go on that a
 * posture takes through zero, along their speeds. Returns whether there were any: the evaluation is
 * then that of another place. */
int frot_let_slips_pass(const frot_model *m, frot_state *s, frot_work *w, const double *x);

/* The directions of slips of several components are those of their speeds. */
void frot_follow_slips(const frot_model *m, frot_state *s, frot_work *w);

#endif
