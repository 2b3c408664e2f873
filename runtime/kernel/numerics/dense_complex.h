/* LU of a matrix of complex numbers, real and imaginary parts apart, by columns. */
#ifndef FROT_DENSE_COMPLEX_H
#define FROT_DENSE_COMPLEX_H

/* Factor re + i im (n x n) with partial pivoting. Rows and columns are multiplied by scale[0 .. n)
 * and scale[n .. 2 n) first. Returns 0, or 1 when it is singular to rounding or no number. */
int frot_complex_lu(double *re, double *im, int n, int *pivot, const double *scale);

/* (x, y) <- the inverse times x + i y, by the factors. */
void frot_complex_apply(const double *re, const double *im, int n, const int *pivot,
                        const double *scale, double *x, double *y);

#endif
