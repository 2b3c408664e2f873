/* Redundant reactions of a motion: those of equal springs (reactions/equal_springs.h). */
#ifndef FROT_SLIDING_SPRINGS_H
#define FROT_SLIDING_SPRINGS_H

#include "motion_search/motion_orders.h"

/* Doubles and integers of scratch, for n unknowns and rows of a width. */
int frot_sliding_springs_doubles(int n, int width);
int frot_sliding_springs_integers(int n);

/* x (n) <- the reactions of s->rows in which contacts that bear give like equal springs; contacts
 * whose spring would be stretched bear nothing. Returns 0 where there are none: x is as before. */
int frot_sliding_springs(frot_searcher *s, const frot_item_state *states, double *x);

#endif
