/* Dynamic relaxation: a part at rest moves along its accelerations until they vanish. */
#ifndef FROT_RELAXATION_H
#define FROT_RELAXATION_H

#include "statements.h"

/* Whether statements on accelerations find places of the part. */
int frot_has_balance(const frot_opening *p);

/* From p->x to a place where the liaisons and the other statements hold, then along them to one
 * near a stable equilibrium. Returns 0 where none is found. */
int frot_relax(frot_opening *p);

#endif
