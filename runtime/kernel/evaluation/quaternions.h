/* Orientations in space: unit quaternions among the coordinates, which turn by angular velocities
 * and are no sums of anything. Whoever moves coordinates along speeds does it here. */
#ifndef FROT_QUATERNIONS_H
#define FROT_QUATERNIONS_H

#include "frot.h"

/* out <- the quaternion r turned by the quaternion `by`: by r, or r by in its own axes. */
void frot_turned(const frot_turn *turn, const double *by, const double *r, double *out);

/* Move q by `part` of the displacement `step` (one item a speed of the group): coordinates by
 * addition, orientations by turning them. */
void frot_displace(const frot_model *m, const frot_group *g, double *q, const double *step,
                   double part);

/* The coordinates q of a group after the time dt, at the speeds v (nv) and accelerations a (nv,
 * NULL: none) of now: q is changed in place. `step` (n_speeds): scratch. */
void frot_coordinates_after(const frot_model *m, const frot_group *g, const double *v,
                            const double *a, double dt, double *step, double *q);

/* q += part times the rates (nq) of what no speed is the rate of: plain states, places of what
 * rolls. */
void frot_drift(const frot_model *m, double *q, const double *rates, double part);

/* row (nq) <- the row over coordinates, zero elsewhere, that gives every displacement of the group
 * what `entries`, over its speeds, give it. It is orthogonal to each quaternion itself. */
void frot_over_coordinates(const frot_model *m, const frot_group *g, const double *entries,
                           const double *q, double *row);

/* items (4) <- what entries over the speeds of its group make of a turn at the quaternion r. */
void frot_over_turn(const frot_model *m, const frot_turn *turn, const double *entries,
                    const double *r, double *items);

/* Give all quaternions the length 1 again. Returns whether one was off by more than rounding. */
int frot_normalise(const frot_model *m, double *q);

#endif
