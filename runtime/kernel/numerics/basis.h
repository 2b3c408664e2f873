/* Vectors and their parts along others, the remainders, bases, least squares. */
#ifndef FROT_BASIS_H
#define FROT_BASIS_H

#include <stddef.h>

#include "numerics/dense.h"

/* The items of x (n) that are not zero lie in first .. end. */
void frot_support(const double *x, int n, int *first, int *end);

/* Where x (n) is not zero: its items lie in first .. end; where they are few, at the `count`
 * places, else count is -1. */
#define FROT_FEW 16
typedef struct {
  int first, end, count, place[FROT_FEW];
} frot_places;

void frot_find_places(const double *x, int n, frot_places *places);

/* x'y, where these are the places of x. */
static inline double frot_dot_at(const frot_places *places, const double *x, const double *y) {
  if (places->count < 0)
    return frot_dot(x + places->first, y + places->first, places->end - places->first);
  double sum = 0;
  for (int k = 0; k < places->count; k++) sum += x[places->place[k]] * y[places->place[k]];
  return sum;
}

/* Takes from x (n) its parts along the orthonormal columns of `basis` (n x columns), which go to
 * `parts`; again where much is taken, so that the rest is orthogonal to rounding. Returns the
 * length of the rest. */
double frot_reject(double *x, const double *basis, int columns, int n, double *parts);

/* Take row `best` of n rows (each of `size`), which is not before k, for the next of an orthonormal
 * basis: it changes places with row k, has the length 1 there, and nothing of it is left in the
 * rows after. */
void frot_take_row(double *rows, int n, int size, int k, int best);

/* Least squares of least norm: x (n) for a x = b, a (m x n) by columns, overwritten with b.
 * Rank by Householder QR with column pivoting, then a triangle from the right (G. Golub, C. Van
 * Loan, Matrix Computations, 4th ed., sect. 5.5); columns below the part `least` of the longest are
 * none. `work` takes m + 4*n + min(m, n)*n doubles and `pivot` n integers. Returns the rank; a and
 * b are lost. */
int frot_least_norm(double *a, double *b, int m, int n, double least, double *x, double *work,
                    int *pivot);

#endif
