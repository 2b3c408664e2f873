/* The way on to where a size is least among the values that hold: Newton's method on the relations,
 * by conjugate gradients (T. Steihaug 1983). */
#ifndef FROT_TANGENT_NEWTON_H
#define FROT_TANGENT_NEWTON_H

#include "assembly/start_equations.h"

/* w->opening.way <- the way from p->q, where the equations hold, along them to where the change
 * from w->opening.begin or, with p->aim, what the guesses are missed by is least: the curvature of
 * the relations is taken into account. Measured as at the beginning (nearest_solution.h).
 * *slope: how steep that is there. FROT_OK, or the status of an evaluation without a fault. */
int frot_way_down(frot_opening *p, double *slope);

#endif
