/* The search for initial coordinates from other beginnings than the given one. */
#ifndef FROT_MULTISTART_H
#define FROT_MULTISTART_H

#include "assembly/start_equations.h"

/* As frot_solve_nearest. A posture in which nothing moves a gap, such as a dead centre, tells no
 * way to close it, and one beside it a way too far: then other beginnings are tried, the same in
 * every run, and the nearest place taken that is found. */
int frot_solve_widely(frot_opening *p);

/* p->q <- beginning k away from w->opening.begin, the same in every run: turns of up to half a
 * revolution. `alike`: of lengths that move as much mass, else in SI. The metric is known. */
void frot_begin_multistart(frot_opening *p, int k, int alike);

#endif
