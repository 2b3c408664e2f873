/* LU of a sparse matrix W = shift I - J of fixed pattern, without pivoting. */
#ifndef FROT_SPARSE_REAL_H
#define FROT_SPARSE_REAL_H

#include "numerics/sparse_pattern.h"

/* Factor W into `lu` (as many doubles as the pattern has columns); the diagonal holds reciprocal
 * pivots. `jacobian`: the entries of J in the order of the pattern's tables. `x` (n) is scratch.
 * Returns 0, or 1 when a pivot is lost by cancellation or no number. *growth is set to 1 when a
 * multiplier is above one: pivoting by size would have chosen otherwise, and a solution is to be
 * checked (frot_sparse_error). */
int frot_sparse_factor(const frot_pattern *pattern, const double *jacobian, double shift,
                       double *lu, double *x, int *growth);

/* x (n) <- W^-1 b. `y` (n) is scratch; b and x may be the same. */
void frot_sparse_solve(const frot_pattern *pattern, const double *lu, const double *b, double *y,
                       double *x);

/* Largest error |W x - b| of a solution, each row in units of the size of its terms. `y` and `size`
 * (n) are scratch. */
double frot_sparse_error(const frot_pattern *pattern, const double *jacobian, double shift,
                         const double *b, const double *x, double *y, double *size);

#endif
