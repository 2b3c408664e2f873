/* LU of a sparse matrix of complex numbers W = (re + i im) I - J of fixed pattern, with J real,
 * without pivoting: frot_sparse_factor of sparse_real.h for a complex shift. */
#ifndef FROT_SPARSE_COMPLEX_H
#define FROT_SPARSE_COMPLEX_H

#include "numerics/sparse_pattern.h"

/* Factor W into `lu`: real and imaginary part of each item of the pattern; the diagonal holds
 * reciprocal pivots. `x` (2 n) is scratch. Returns 0, or 1 when a pivot is lost by cancellation or
 * no number. */
int frot_sparse_complex_factor(const frot_pattern *pattern, const double *jacobian, double re,
                               double im, double *lu, double *x);

/* (x, y) <- the inverse times x + i y, by the factors. `z` (2 n) is scratch. */
void frot_sparse_complex_apply(const frot_pattern *pattern, const double *lu, double *z, double *x,
                               double *y);

#endif
