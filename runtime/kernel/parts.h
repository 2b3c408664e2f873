/* The part of a scene that is being put together: nothing outside of it is moved or looked at. */
#ifndef FROT_PARTS_H
#define FROT_PARTS_H

#include "statements.h"

#define FROT_NO_PART (-2) /* of an equation that is left out */

/* Take the unknowns of a part, -1: all, for those to be found; first the ones that have a speed. */
void frot_take_part(frot_opening *p, int part);

/* Whether unknown k is one of them. */
static inline int frot_is_own(const frot_opening *p, int k) { return p->w->opening.is_own[k]; }

/* Whether what is of this part is looked at. */
static inline int frot_is_of_part(const frot_opening *p, int part) {
  return p->part < 0 || p->part == part;
}

/* After the slopes of `count` equations, whose parts stand in w->opening.row_part: the others say
 * nothing; lists those of the first p->n that are left. */
void frot_leave_others(frot_opening *p, int count);

#endif
