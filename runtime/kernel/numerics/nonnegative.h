/* Linear least squares with unknowns that are not negative. */
#ifndef FROT_NONNEGATIVE_H
#define FROT_NONNEGATIVE_H

/* Doubles and integers of scratch that a problem takes. */
int frot_nonnegative_doubles(int rows, int columns);
int frot_nonnegative_integers(int columns);

/* u (columns) >= 0 <- the point of least |e u - f|, e rows x columns by columns; rest (rows) <-
 * f - e u. Active sets (C. Lawson, R. Hanson, Solving Least Squares Problems, 1974, chapter 23).
 * Returns 0, or 1 where the passes end before the sets settle. */
int frot_nonnegative(const double *e, const double *f, int rows, int columns, double *u,
                     double *rest, double *doubles, int *integers);

#endif
