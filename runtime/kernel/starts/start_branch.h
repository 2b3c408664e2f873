/* Which branch a loop follows that starts in a singular posture with speed. */
#ifndef FROT_START_BRANCH_H
#define FROT_START_BRANCH_H

#include "assembly/start_equations.h"

/* The speeds p->v are the least that statements and liaisons allow. Where that is in a posture from
 * which loops go on in several ways (tangent_cone.h), take them to the one that is the only one, or
 * misses the guesses of speeds by far less than the next. FROT_OK, or FROT_POSTURE with the fault
 * where there is none, or several: then `other` is the speed in which two of them differ most,
 * `where` its values. */
int frot_choose_branch(frot_opening *p);

#endif
