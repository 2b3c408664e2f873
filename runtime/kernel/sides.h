/* On which side of its line a contact's point is meant to be. */
#ifndef FROT_SIDES_H
#define FROT_SIDES_H

#include "statements.h"

/* Values of `sides` of the part at the coordinates at which kinematics was evaluated last. */
void frot_look_at_sides(const frot_opening *p);

/* The sides of the contacts of the part: where the point is or, if `natural` or where that is on
 * the line, against gravity, else where the body's G is, else to the left. Returns how many change.
 */
int frot_choose_sides(const frot_opening *p, double *side, int natural);

#endif
