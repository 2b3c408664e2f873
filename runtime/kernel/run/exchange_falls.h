/* Guards that fall at an instant where another integrator steps the motion: it finds one that comes
 * to zero, and others come to zero with it. */
#ifndef FROT_EXCHANGE_FALLS_H
#define FROT_EXCHANGE_FALLS_H

#include "model/workspace.h"

/* Fire the located conditions that fall through zero within one instant of the states x, by the
 * slope noted. Leaves another evaluation. */
void frot_fire_falling(const frot_model *m, frot_state *s, frot_work *w, const double *x);

/* Whether an open contact with this gap, that of the last evaluation, meets at this instant:
 * the gap is zero, or comes there within one instant, and closes. */
int frot_meets_now(const frot_model *m, const frot_state *s, frot_work *w, int contact, double gap);

/* See whether reactions that are not unique leave their bounds shortly after the states of the run,
 * by the slope noted, into w->reactions.beyond: at the instant itself rounding decides. */
void frot_look_beyond(const frot_model *m, frot_state *s, frot_work *w);

#endif
