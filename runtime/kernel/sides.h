/* On which side of its line a contact's point is meant to be. */
#ifndef FROT_SIDES_H
#define FROT_SIDES_H

#include "statements.h"

/* Values of `sides` of the part at the coordinates at which kinematics was evaluated last. */
void frot_look_at_sides(const frot_opening *p);

/* The sides of the contacts of the part, by the signs of the three numbers of
 * compiler/mechanics/geometry/sides.py: where the point is or, if `natural` or where that is on the
 * line, outside of matter or against gravity, else by G, else to the left. Returns how many change.
 */
int frot_choose_sides(const frot_opening *p, double *side, int natural);

#endif
