#include "linear.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "tolerances.h"

/* Part of its length that is left of a vector at least where what was taken from it need not be
 * taken again: it is then orthogonal to ten units of rounding (J. Daniel, W. Gragg, L. Kaufman,
 * G. Stewart, Math. Comp. 30, 1976, p. 772). */
#define KEPT 0.1

#define AT(a, ld, i, j) ((a)[(size_t)(j) * (size_t)(ld) + (size_t)(i)])

double frot_dot(const double *a, const double *b, int n) {
  double w = 0, x = 0, y = 0, z = 0; /* so that not every addition waits for the one before */
  int i = 0;
  for (; i + 4 <= n; i += 4) {
    w += a[i] * b[i], x += a[i + 1] * b[i + 1];
    y += a[i + 2] * b[i + 2], z += a[i + 3] * b[i + 3];
  }
  for (; i < n; i++) w += a[i] * b[i];
  return (w + x) + (y + z);
}

/* x (n) less one column times p, then less the next one, which is `ld` on, times q: as much as
 * there is room for in a register. */
static inline void take_two(double *restrict x, const double *one, int ld, double p, double q,
                            int n) {
  const double *two = one + ld;
  int i = 0;
  for (; i + 2 <= n; i += 2) {
    x[i] = (x[i] - one[i] * p) - two[i] * q;
    x[i + 1] = (x[i + 1] - one[i + 1] * p) - two[i + 1] * q;
  }
  if (i < n) x[i] = (x[i] - one[i] * p) - two[i] * q;
}

int frot_cholesky(double *a, int n) {
  for (int j = 0; j < n; j++) {
    double *column = a + (size_t)j * (size_t)n, whole = column[j];
    const double *before = a + j;
    int k = 0;
    for (; k + 2 <= j; k += 2, before += 2 * n)
      if (before[0] != 0 || before[n] != 0)
        take_two(column + j, before, n, before[0], before[n], n - j);
    for (double factor = before[0]; k < j && factor != 0; k++)
      for (int i = 0; i < n - j; i++) column[j + i] -= before[i] * factor;
    if (!(column[j] > n * DBL_EPSILON * whole)) return 1;
    double share = 1 / (column[j] = sqrt(column[j]));
    for (int i = j + 1; i < n; i++) column[i] *= share;
  }
  return 0;
}

void frot_forward(const double *l, int n, int m, double *x) {
  for (int k = 0; k < m; k++, l += n) {
    double value = x[k] /= l[k];
    if (value == 0) continue;
    for (int i = k + 1; i < m; i++) x[i] -= l[i] * value;
  }
}

void frot_forward_four(const double *l, int n, double *x) {
  for (int k = 0; k < n; k++, l += n) {
    double *own = x + FROT_ABREAST * k, share = 1 / l[k];
    if (own[0] == 0 && own[1] == 0 && own[2] == 0 && own[3] == 0) continue;
    const double a = own[0] *= share, b = own[1] *= share, c = own[2] *= share, d = own[3] *= share;
    for (int i = k + 1; i < n; i++) {
      const double factor = l[i];
      double *other = x + FROT_ABREAST * i;
      other[0] -= factor * a, other[1] -= factor * b;
      other[2] -= factor * c, other[3] -= factor * d;
    }
  }
}

void frot_dot_four(const double *a, const double *four, int n, double product[FROT_ABREAST]) {
  double sum[FROT_ABREAST] = {0, 0, 0, 0};
  for (int i = 0; i < n; i++, four += FROT_ABREAST) {
    const double factor = a[i];
    sum[0] += factor * four[0], sum[1] += factor * four[1];
    sum[2] += factor * four[2], sum[3] += factor * four[3];
  }
  for (int c = 0; c < FROT_ABREAST; c++) product[c] = sum[c];
}

void frot_dot_fours(const double *a, const double *b, int n,
                    double product[FROT_ABREAST * FROT_ABREAST]) {
  for (int pair = 0; pair < FROT_ABREAST; pair += 2) { /* as many sums as there are registers */
    double one[FROT_ABREAST] = {0, 0, 0, 0}, two[FROT_ABREAST] = {0, 0, 0, 0};
    const double *left = a + pair, *right = b;
    for (int i = 0; i < n; i++, left += FROT_ABREAST, right += FROT_ABREAST) {
      const double first = left[0], second = left[1];
      one[0] += first * right[0], one[1] += first * right[1];
      one[2] += first * right[2], one[3] += first * right[3];
      two[0] += second * right[0], two[1] += second * right[1];
      two[2] += second * right[2], two[3] += second * right[3];
    }
    for (int c = 0; c < FROT_ABREAST; c++) {
      product[FROT_ABREAST * pair + c] = one[c];
      product[FROT_ABREAST * (pair + 1) + c] = two[c];
    }
  }
}

void frot_add_columns(const double *columns, int ld, const double *factor, int count, int n,
                      double *sum) {
  int i = 0;
  for (; i + 4 <= n; i += 4) { /* as many sums as there is room for in registers */
    const double *x = columns + i;
    double a = 0, b = 0, c = 0, d = 0;
    for (int k = 0; k < count; k++, x += ld) {
      const double by = factor[k];
      a += by * x[0], b += by * x[1], c += by * x[2], d += by * x[3];
    }
    sum[i] = a, sum[i + 1] = b, sum[i + 2] = c, sum[i + 3] = d;
  }
  for (; i < n; i++) {
    const double *x = columns + i;
    double a = 0;
    for (int k = 0; k < count; k++, x += ld) a += factor[k] * x[0];
    sum[i] = a;
  }
}

void frot_backward(const double *l, int n, int m, double *x) {
  for (int i = m - 1; i >= 0; i--) {
    double sum = x[i];
    for (int k = i + 1; k < m; k++) sum -= AT(l, n, k, i) * x[k];
    x[i] = sum / AT(l, n, i, i);
  }
}

void frot_forward_by(const double *l, const double *share, int n, double *x) {
  int i = 0;
  for (; i + 2 <= n; i += 2) {
    const double *entry = l + i;
    double one = x[i], two = x[i + 1];
    for (int k = 0; k < i; k++, entry += n) one -= entry[0] * x[k], two -= entry[1] * x[k];
    x[i] = one *= share[i];
    x[i + 1] = (two - entry[1] * one) * share[i + 1];
  }
  if (i == n) return;
  double last = x[i];
  for (int k = 0; k < i; k++) last -= AT(l, n, i, k) * x[k];
  x[i] = last * share[i];
}

void frot_backward_by(const double *l, const double *share, int n, double *x) {
  int i = n - 1;
  for (; i >= 1; i -= 2) {
    const double *right = l + (size_t)i * (size_t)n, *left = right - n;
    double two = x[i], one = x[i - 1];
    for (int k = n - 1; k > i; k--) two -= right[k] * x[k], one -= left[k] * x[k];
    x[i] = two *= share[i];
    x[i - 1] = (one - left[i] * two) * share[i - 1];
  }
  if (i < 0) return;
  double first = x[0];
  for (int k = n - 1; k > 0; k--) first -= l[k] * x[k];
  x[0] = first * share[0];
}

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
  double own = sqrt(frot_dot(x, x, n)), rest = own;
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
    rest = sqrt(frot_dot(x, x, n));
    if (rest > KEPT * own) break;
  }
  return rest;
}

int frot_lu_solve(double *a, double *b, int n, int *pivot, int *sign) {
  double largest = 0;
  *sign = 1;
  for (int i = 0; i < n * n; i++)
    if (!(fabs(a[i]) <= largest)) largest = fabs(a[i]);
  for (int k = 0; k < n; k++) {
    double *column = a + (size_t)k * (size_t)n;
    int best = k;
    for (int i = k + 1; i < n; i++)
      if (fabs(column[i]) > fabs(column[best])) best = i;
    pivot[k] = best;
    if (!(fabs(column[best]) > FROT_SINGULAR_PIVOT * largest)) return 1;
    if (best != k) *sign = -*sign;
    if (column[best] < 0) *sign = -*sign;
    for (int j = 0; best != k && j < n; j++) {
      double t = AT(a, n, k, j);
      AT(a, n, k, j) = AT(a, n, best, j);
      AT(a, n, best, j) = t;
    }
    double share = 1 / column[k];
    int end = n;
    while (end > k + 1 && column[end - 1] == 0) end--;
    for (int i = k + 1; i < end; i++) column[i] *= share;
    for (int j = k + 1; j < n && end > k + 1; j++) {
      double *other = a + (size_t)j * (size_t)n, factor = other[k];
      if (factor == 0) continue;
      for (int i = k + 1; i < end; i++) other[i] -= column[i] * factor;
    }
  }
  frot_lu_again(a, b, n, pivot);
  return 0;
}

void frot_lu_again(const double *a, double *b, int n, const int *pivot) {
  for (int k = 0; k < n; k++) {
    double t = b[pivot[k]];
    b[pivot[k]] = b[k], b[k] = t;
  }
  for (int k = 0; k < n; k++) {
    const double *column = a + (size_t)k * (size_t)n, value = b[k];
    for (int i = k + 1; i < n; i++) b[i] -= column[i] * value;
  }
  for (int k = n - 1; k >= 0; k--) {
    const double *column = a + (size_t)k * (size_t)n, value = b[k] /= column[k];
    for (int i = 0; i < k; i++) b[i] -= column[i] * value;
  }
}

/* The power of two that brings a size to [1/2, 1); 1 for zero. */
static double power_below(double size) {
  int exponent = 0;
  if (size > 0 && isfinite(size)) frexp(size, &exponent);
  return ldexp(1, -exponent);
}

/* Scale rows and columns so that the largest entry of each is near 1. */
static void equilibrate(double *a, int n, double *scale) {
  double *row = scale, *column = scale + n;
  for (int i = 0; i < n; i++) row[i] = 0;
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) row[i] = fmax(row[i], fabs(AT(a, n, i, j)));
  for (int i = 0; i < n; i++) row[i] = power_below(row[i]);
  for (int j = 0; j < n; j++) {
    double largest = 0;
    for (int i = 0; i < n; i++) {
      AT(a, n, i, j) *= row[i];
      largest = fmax(largest, fabs(AT(a, n, i, j)));
    }
    column[j] = power_below(largest);
    for (int i = 0; i < n; i++) AT(a, n, i, j) *= column[j];
  }
}

int frot_lu(double *a, int n, int *pivot, double *scale) {
  equilibrate(a, n, scale);
  for (int k = 0; k < n; k++) {
    int best = k;
    for (int i = k + 1; i < n; i++)
      if (fabs(AT(a, n, i, k)) > fabs(AT(a, n, best, k))) best = i;
    pivot[k] = best;
    if (!(fabs(AT(a, n, best, k)) > 4 * n * DBL_EPSILON)) return 1;
    for (int j = k; best != k && j < n; j++) {
      double t = AT(a, n, k, j);
      AT(a, n, k, j) = AT(a, n, best, j);
      AT(a, n, best, j) = t;
    }
    double inverse = 1 / AT(a, n, k, k);
    for (int i = k + 1; i < n; i++) AT(a, n, i, k) *= inverse;
    for (int j = k + 1; j < n; j++) {
      double factor = AT(a, n, k, j);
      if (factor == 0) continue;
      for (int i = k + 1; i < n; i++) AT(a, n, i, j) -= AT(a, n, i, k) * factor;
    }
  }
  return 0;
}

void frot_lu_apply(const double *a, int n, const int *pivot, const double *scale, double *x) {
  for (int i = 0; i < n; i++) x[i] *= scale[i];
  for (int k = 0; k < n; k++) {
    double t = x[pivot[k]];
    x[pivot[k]] = x[k];
    x[k] = t;
    if (t == 0) continue;
    for (int i = k + 1; i < n; i++) x[i] -= AT(a, n, i, k) * t;
  }
  for (int k = n - 1; k >= 0; k--) {
    x[k] /= AT(a, n, k, k);
    for (int i = 0; i < k; i++) x[i] -= AT(a, n, i, k) * x[k];
  }
  for (int j = 0; j < n; j++) x[j] *= scale[n + j];
}

/* Householder vector of x (n), stored over x with its first entry beta apart: (I - 2 v v'/v'v) x
 * = (beta, 0, ...). Returns beta; `scale` is 2/v'v, 0 when nothing is to be done. */
static double reflect(double *x, int n, double *scale) {
  double norm = sqrt(frot_dot(x, x, n));
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
  double *x = rows + size * k, *by = rows + size * best, length = sqrt(frot_dot(by, by, size));
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
