/* Polynomials: the first zero of one that is to stay positive; one through values at instants. */
#ifndef FROT_BERNSTEIN_H
#define FROT_BERNSTEIN_H

#define FROT_NO_ROOT 2.0

/* g: Bernstein coefficients of a polynomial of degree 6 on [0, 1]. Returns the first theta at which
 * it passes through zero to below -floor, 0 when it is below from the start, FROT_NO_ROOT when it
 * does not. No dip below -floor is missed: between two signs the coefficients bound the polynomial.
 */
double frot_first_fall(const double g[7], double floor);

/* Value of the polynomial at theta. */
double frot_bernstein(const double g[7], double theta);

/* J. Lagrange's weights of the values at n instants in that of the polynomial through them at t. */
void frot_weigh_values(const double *at, int n, double t, double *weight);

#endif
