/* The values nearest to given ones, in the metric of the mass, at which the statements hold. */
#ifndef FROT_GAUSS_NEWTON_H
#define FROT_GAUSS_NEWTON_H

#include "assembly/start_equations.h"

/* Damped Gauss-Newton from the present values. What a statement says of one unknown alone holds to
 * the last digit. Leaves kinematics evaluated there. FROT_OK or the status of the fault recorded.
 */
int frot_solve_nearest(frot_opening *p);

/* The metric at the present values: that of the speeds for the unknowns that have one (their number
 * in p->attached, its factor in p->factor), for the others the size of their guess. Where guesses
 * are met, whatever the liaisons, and a figure has no place on another from here, so that what
 * rolls has no inertia, it is that of a place turned aside. */
int frot_opening_metric(frot_opening *p);

/* Units of the changes that no mass measures: the sizes of the present values, 1 of those that are
 * zero or rounding of the others. */
void frot_begin_units(const frot_opening *p);

/* y <- a change of the unknowns, in units in which its length is that of the metric. */
void frot_measure_change(const frot_opening *p, const double *apart, double *y);

/* y <- L^-1 row: a row in the units of the metric; the attached changes come first. */
void frot_row_in_metric(const frot_opening *p, const double *row, double *y);

/* The length of the row of equation i in the units of the metric. */
double frot_row_length(const frot_opening *p, int i);

/* w->opening.row_weight <- one over the length of each row in the metric, of the items of a vector
 * over that of the longest: one that is met with slope zero counts by what the others can do. */
void frot_weigh_rows(const frot_opening *p);

/* x <- x0 + part * L'^-1 y. Returns the largest change, and in *size the largest value. */
double frot_move_opening(const frot_opening *p, const double *y, const double *x0, double part,
                         double *x, double *size);

#endif
