#include "numerics/basis.h"

#include <math.h>

/* Part of its length that is left of a vector at least where what was taken from it need not be
 * taken again: it is then orthogonal to ten units of rounding (J. Daniel, W. Gragg, L. Kaufman,
 * G. Stewart, Math. Comp. 30, 1976, p. 772). */
#define KEPT 0.1

#define AT(a, ld, i, j) ((a)[(size_t)(j) * (size_t)(ld) + (size_t)(i)])

/* Whether none of four numbers is anything. */
static inline int nothing(const double *x) {
  return (fabs(x[0]) + fabs(x[1])) + (fabs(x[2]) + fabs(x[3])) == 0;
}

void frot_support(const double *x, int n, int *first, int *end) {
  int from = 0, to = n;
  while (from + 4 <= n && nothing(x + from)) from += 4;
  while (to - 4 >= from && nothing(x + to - 4)) to -= 4;
  while (from < n && x[from] == 0) from++;
  while (to > from && x[to - 1] == 0) to--;
  *first = from, *end = to;
}

void frot_find_places(const double *x, int n, frot_places *places) {
  int count = 0;
  frot_support(x, n, &places->first, &places->end);
  for (int k = places->first; k < places->end && count <= FROT_FEW; k++) {
    if (x[k] == 0) continue;
    if (count < FROT_FEW) places->place[count] = k;
    count++;
  }
  places->count = count <= FROT_FEW && 2 * count < places->end - places->first ? count : -1;
}

double frot_reject(double *x, const double *basis, int columns, int n, double *parts) {
  double own = frot_length(x, n), rest = own;
  frot_places places;
  for (int c = 0; c < columns; c++) parts[c] = 0;
  frot_find_places(x, n, &places);
  for (int pass = 0; pass < 2; pass++) {
    for (int c = 0; c < columns; c++) {
      const double *with = basis + n * c;
      double part = frot_dot_at(&places, x, with);
      if (part == 0) continue;
      for (int k = 0; k < n; k++) x[k] -= part * with[k];
      parts[c] += part, places = (frot_places){.first = 0, .end = n, .count = -1};
    }
    rest = frot_length(x, n);
    if (rest > KEPT * own) break;
  }
  return rest;
}

/* Householder vector of x (n), stored over x with its first entry beta apart: (I - 2 v v'/v'v) x
 * = (beta, 0, ...). Returns beta; `scale` is 2/v'v, 0 when nothing is to be done. */
static double reflect(double *x, int n, double *scale) {
  double norm = frot_length(x, n);
  if (norm == 0) {
    *scale = 0;
    return 0;
  }
  double beta = x[0] > 0 ? -norm : norm;
  x[0] -= beta;
  *scale = -1 / (beta * x[0]);
  return beta;
}

void frot_take_row(double *rows, int n, int size, int k, int best) {
  double *x = rows + size * k, *by = rows + size * best, length = frot_length(by, size);
  for (int j = 0; j < size; j++) {
    double own = by[j];
    by[j] = x[j], x[j] = length > 0 ? own / length : 0;
  }
  for (int i = k + 1; i < n; i++) {
    double *other = rows + size * i, part = frot_dot(other, x, size);
    for (int j = 0; j < size; j++) other[j] -= part * x[j];
  }
}

int frot_least_norm(double *a, double *b, int m, int n, double least, double *x, double *work,
                    int *pivot) {
  double *scale = work, *diagonal = work + n, *row_scale = work + 2 * n, *y = work + 3 * n;
  double *kept = work + 4 * n; /* b rotated */
  int steps = m < n ? m : n, rank = 0;
  for (int j = 0; j < n; j++) pivot[j] = j;
  double first = 0;
  for (int k = 0; k < steps; k++) {
    int best = k;
    double best_norm = -1;
    for (int j = k; j < n; j++) {
      double norm = 0;
      for (int i = k; i < m; i++) norm += AT(a, m, i, j) * AT(a, m, i, j);
      if (norm > best_norm) best_norm = norm, best = j;
    }
    if (k == 0) first = sqrt(best_norm);
    if (!(sqrt(best_norm) > least * first) || first == 0) break;
    if (best != k) {
      for (int i = 0; i < m; i++) {
        double t = AT(a, m, i, k);
        AT(a, m, i, k) = AT(a, m, i, best);
        AT(a, m, i, best) = t;
      }
      int t = pivot[k];
      pivot[k] = pivot[best];
      pivot[best] = t;
    }
    diagonal[k] = reflect(&AT(a, m, k, k), m - k, &scale[k]);
    for (int j = k + 1; j < n; j++) {
      double f = scale[k] * frot_dot(&AT(a, m, k, k), &AT(a, m, k, j), m - k);
      for (int i = k; i < m; i++) AT(a, m, i, j) -= f * AT(a, m, i, k);
    }
    double f = scale[k] * frot_dot(&AT(a, m, k, k), b + k, m - k);
    for (int i = k; i < m; i++) b[i] -= f * AT(a, m, i, k);
    rank++;
  }
  /* R = (T S): reduce the trapezoid rank x n to a triangle from the right, last row first. The row
   * k holds diagonal[k] at k and AT(a, k, j) right of it. */
  for (int i = 0; i < m; i++) kept[i] = b[i];
  if (rank < n) {
    double *t = kept + m; /* rank x n trapezoid, by rows */
    for (int k = 0; k < rank; k++)
      for (int j = 0; j < n; j++)
        t[k * n + j] = j < k ? 0 : (j == k ? diagonal[k] : AT(a, m, k, j));
    for (int k = rank - 1; k >= 0; k--) {
      /* reflector on entries k and rank..n-1 of row k */
      double norm2 = t[k * n + k] * t[k * n + k];
      for (int j = rank; j < n; j++) norm2 += t[k * n + j] * t[k * n + j];
      double norm = sqrt(norm2), beta = t[k * n + k] > 0 ? -norm : norm;
      double head = t[k * n + k] - beta;
      row_scale[k] = head == 0 ? 0 : -1 / (beta * head);
      for (int r = 0; r < k; r++) {
        double f = head * t[r * n + k];
        for (int j = rank; j < n; j++) f += t[k * n + j] * t[r * n + j];
        f *= row_scale[k];
        t[r * n + k] -= f * head;
        for (int j = rank; j < n; j++) t[r * n + j] -= f * t[k * n + j];
      }
      t[k * n + k] = beta;
      scale[k] = head;
    }
    for (int k = rank - 1; k >= 0; k--) {
      double sum = kept[k];
      for (int j = k + 1; j < rank; j++) sum -= t[k * n + j] * y[j];
      y[k] = sum / t[k * n + k];
    }
    for (int j = rank; j < n; j++) y[j] = 0;
    for (int k = 0; k < rank; k++) {
      double f = scale[k] * y[k];
      for (int j = rank; j < n; j++) f += t[k * n + j] * y[j];
      f *= row_scale[k];
      y[k] -= f * scale[k];
      for (int j = rank; j < n; j++) y[j] -= f * t[k * n + j];
    }
  } else {
    for (int k = rank - 1; k >= 0; k--) {
      double sum = kept[k];
      for (int j = k + 1; j < n; j++) sum -= AT(a, m, k, j) * y[j];
      y[k] = sum / diagonal[k];
    }
  }
  for (int j = 0; j < n; j++) x[pivot[j]] = y[j];
  return rank;
}
