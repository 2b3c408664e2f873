/* The way on to where a size is least among the values that hold: Newton's method on the relations,
 * by conjugate gradients (T. Steihaug 1983). */
#ifndef FROT_DESCEND_H
#define FROT_DESCEND_H

#include "statements.h"

/* w->opening.way <- the way from p->q, where the equations hold, along them to where the change
 * from w->opening.begin or, with p->aim, what the guesses are missed by is least: the curvature of
 * the relations is taken into account. Measured as at the beginning (closest.h).
 * *slope: how steep that is there. FROT_OK, or the status of an evaluation without a fault. */
int frot_way_down(frot_opening *p, double *slope);

#endif
