/* A closed contact that parts at an event. */
#ifndef FROT_SEPARATION_H
#define FROT_SEPARATION_H

#include "model/state.h"

/* Record that contact i parts at t, open it, and note that its flight begins. What its guards have
 * measured of reactions is no size of its gap and slips. */
void frot_part_contact(const frot_model *m, frot_state *s, double t, int i,
                       frot_recorder *recorder);

#endif
