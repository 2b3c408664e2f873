/* Coordinates at the start, from the posture in which stated angles are zero, in small turns. */
#ifndef FROT_HOMOTOPY_H
#define FROT_HOMOTOPY_H

#include "assembly/start_equations.h"

/* As frot_solve_nearest, from p->q with the angles that are stated at zero: what is missed there is
 * taken away part by part, and every part is solved for. A mechanism that its bodies lie in as they
 * are modelled is turned from there to what is stated, and stays in that way to be assembled.
 * FROT_INITIAL where no angle is stated. */
int frot_solve_by_homotopy(frot_opening *p);

#endif
