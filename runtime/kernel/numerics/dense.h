/* Dense linear algebra on small systems. Matrices are by columns with leading dimension n. */
#ifndef FROT_DENSE_H
#define FROT_DENSE_H

#include <math.h>

/* Cholesky factor of the symmetric positive definite a (n x n) in its lower triangle.
 * Returns 0, or 1 when a is not positive definite to rounding. */
int frot_cholesky(double *a, int n);
/* x <- L^-1 x and x <- L'^-1 x, for the leading m x m block of the factor l (n x n). */
void frot_forward(const double *l, int n, int m, double *x);
void frot_backward(const double *l, int n, int m, double *x);

/* The factor's columns with ones on the diagonal (`unit`, n x n, below it), L = unit / share, by
 * which one system after the other is solved sooner: x <- unit^-1 x and x <- unit'^-1 x. */
void frot_make_unit(const double *l, int n, double *unit, double *share);
void frot_forward_unit(const double *unit, int n, double *x);
void frot_backward_unit(const double *unit, int n, double *x);

/* Of four vectors abreast, x[4 i + c]: L^-1 of each; the products of a with each; those of each of
 * `a` with each of `b`, product[4 a + b]. */
#define FROT_ABREAST 4
void frot_forward_four(const double *l, int n, double *x);
void frot_dot_four(const double *a, const double *four, int n, double product[FROT_ABREAST]);
void frot_dot_fours(const double *a, const double *b, int n,
                    double product[FROT_ABREAST * FROT_ABREAST]);

/* sum (n) <- `count` columns, each times its factor; the next one is `ld` on. */
void frot_add_columns(const double *columns, int ld, const double *factor, int count, int n,
                      double *sum);

/* Solve a x = b by LU with partial pivoting (a gets the factors, b becomes x; `pivot` takes n
 * integers). Returns 0 with the sign of the determinant, or 1 when a is singular to rounding.
 * frot_lu_again: the same by the factors, for another b. */
int frot_lu_solve(double *a, double *b, int n, int *pivot, int *sign);
void frot_lu_again(const double *a, double *b, int n, const int *pivot);

/* LU of a (n x n) with partial pivoting, rows and columns scaled by powers of two first, so that
 * units do not matter. A row stays where its pivot is `enough` times the largest: 1 for the largest
 * alone. `pivot` takes n integers, `scale` 2 n doubles. Returns 0, or 1 when a is singular to
 * rounding or no number. frot_lu_apply: x <- a^-1 x by the factors. */
int frot_lu(double *a, int n, double enough, int *pivot, double *scale);
void frot_lu_apply(const double *a, int n, const int *pivot, const double *scale, double *x);

/* a'b. */
double frot_dot(const double *a, const double *b, int n);
/* Length of x (n). */
static inline double frot_length(const double *x, int n) { return sqrt(frot_dot(x, x, n)); }

#endif
