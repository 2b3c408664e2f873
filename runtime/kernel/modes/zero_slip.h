/* Which motions are none at an instant: what they are measured against. */
#ifndef FROT_ZERO_SLIP_H
#define FROT_ZERO_SLIP_H

#include "modes/enumeration.h"

/* The speed that a row is measured against: the largest met so far. What has never moved has no
 * other than the one that the loads bring it in the next step; what has may never get that, as a
 * light body on a stiff damper. */
double frot_typical_speed(const frot_instant *in, int row);

/* The motion of an element that is none to rounding, against its terms, the sizes it had, the
 * motion as a whole and its usual motion, or that no instant resolves. */
double frot_zero_rate(const frot_instant *in, int element, const double *v);

/* Whether the motion of an element that had `friction` is zero: its guard fired at zero, as near as
 * events are located (what a landing next to a dead centre leaves of it is a motion: to hold it
 * would stop the mechanism), or before time can move on, or it is zero to rounding or in->slight.
 */
int frot_is_zero_rate(const frot_instant *in, int element, const double *v, int friction);

#endif
