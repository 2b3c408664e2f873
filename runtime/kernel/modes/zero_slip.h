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

/* Contacts that may be closed after the instant, into w->search.best: those that were, and open
 * ones whose gap has closed; `first`: at the start, those that are. */
void frot_list_closable(const frot_instant *in, int first);

/* How the gap of a contact of w->search.best changes, but for rounding. */
enum frot_approach { FROT_STAYS, FROT_LEAVES, FROT_CLOSES };

/* The same of contact i, after frot_dynamics and frot_row_loads; *rate: of its gap. What the motion
 * as a whole leaves of a speed by rounding is none: what only rounding ever moved is no measure of
 * it. Of what was closed no speed is left, unless its place is another one now. A gap that opens
 * again before it is none, as it is bent by the motion so far, leaves: that of a wheel to the edge
 * of a table that it rolls on to. */
enum frot_approach frot_approach_of(const frot_instant *in, int i, double *rate);

#endif
