/* On which side of its line a contact's point is meant to be. */
#ifndef FROT_CONTACT_SIDES_H
#define FROT_CONTACT_SIDES_H

#include "assembly/start_equations.h"

/* Values of `sides` of the part at the coordinates at which kinematics was evaluated last. */
void frot_look_at_sides(const frot_opening *p);

/* The sides of the contacts of the part, by the signs of the three numbers of
 * compiler/mechanics/geometry/sides.py: where the point is or, if `natural` or where that is on the
 * line, outside of matter or against gravity, else by G, else to the left. What can part and is an
 * equation keeps its side. Returns how many change.
 */
int frot_choose_sides(const frot_opening *p, double *side, int natural);

/* Solve for the coordinates of the part, with the sides as they are, such that it is inside of no
 * contact, by the least change: those that it would be inside of become equations, as few as will
 * do. Leaves w->core.gap there. FROT_OK or the status of the fault. */
int frot_keep_outside(frot_opening *p);

#endif
