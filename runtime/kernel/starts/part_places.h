/* The coordinates of one part of the scene at the start. */
#ifndef FROT_PART_PLACES_H
#define FROT_PART_PLACES_H

#include "assembly/start_equations.h"

/* p->x <- the coordinates of the part, with all statements or without those that are optional, and
 * the sides (n_contacts) of its contacts. The search begins where the text says, or to `stay` where
 * the part is. FROT_OK or the status of the fault that is recorded. */
int frot_place_part(frot_opening *p, double *side, int stay);

#endif
