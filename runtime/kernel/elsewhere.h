/* The search for initial coordinates from other beginnings than the given one. */
#ifndef FROT_ELSEWHERE_H
#define FROT_ELSEWHERE_H

#include "statements.h"

/* As frot_solve_nearest. A posture in which nothing moves a gap, such as a dead centre, tells no
 * way to close it, and one beside it a way too far: then other beginnings are tried, the same in
 * every run, and the nearest place taken that is found. */
int frot_solve_widely(frot_opening *p);

#endif
