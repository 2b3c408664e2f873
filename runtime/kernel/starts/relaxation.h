/* Dynamic relaxation: a part at rest moves along its accelerations until they vanish. */
#ifndef FROT_RELAXATION_H
#define FROT_RELAXATION_H

#include "assembly/start_equations.h"

/* FROT_OPTIONAL where a statement of the part is that, FROT_BALANCE where one is on accelerations,
 * else FROT_PLAIN. */
int frot_balance_of(const frot_opening *p);

/* From p->x to a place where the liaisons and the other statements hold, then along them to one
 * near a stable equilibrium. Returns 0 where none is found. */
int frot_relax(frot_opening *p);

#endif
