/* Damped least squares: on from places where rows vanish or depend, and where equations contradict
 * each other (K. Levenberg 1944, D. Marquardt 1963). */
#ifndef FROT_LEVENBERG_MARQUARDT_H
#define FROT_LEVENBERG_MARQUARDT_H

#include "assembly/start_equations.h"

/* What residuals are measured by, in w->opening.row_weight: the sizes of the terms at p->q or, with
 * p->alike, the arms of the angles. */
void frot_weigh_equations(const frot_opening *p);

/* Sum of the squares of the residuals, weighed as they are. */
double frot_missed_square(const frot_opening *p);

/* Take p->q to a place near it where all equations hold as far as they can together. Returns 0
 * where something is no number. */
int frot_follow_damped(frot_opening *p);

#endif
