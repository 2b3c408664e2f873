#include "numerics/dense.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "numerics/tolerances.h"

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

/* x (n) times a factor, and less a column times one: two items at a time, as a register holds. */
static inline void scale_by(double *x, double factor, int n) {
  int i = 0;
  for (; i + 2 <= n; i += 2) x[i] *= factor, x[i + 1] *= factor;
  if (i < n) x[i] *= factor;
}

static inline void take_one(double *restrict x, const double *column, double p, int n) {
  int i = 0;
  for (; i + 2 <= n; i += 2) x[i] -= column[i] * p, x[i + 1] -= column[i + 1] * p;
  if (i < n) x[i] -= column[i] * p;
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
    if (k < j && before[0] != 0) take_one(column + j, before, before[0], n - j);
    if (!(column[j] > n * DBL_EPSILON * whole)) return 1;
    column[j] = sqrt(column[j]);
    scale_by(column + j + 1, 1 / column[j], n - j - 1);
  }
  return 0;
}

void frot_forward(const double *l, int n, int m, double *x) {
  for (int k = 0; k < m; k++, l += n) {
    double value = x[k] *= 1 / l[k]; /* no division waits for another */
    if (value != 0) take_one(x + k + 1, l + k + 1, value, m - k - 1);
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
  for (; i + 8 <= n; i += 8) { /* as many sums as there is room for in registers */
    const double *x = columns + i;
    double a = 0, b = 0, c = 0, d = 0, e = 0, f = 0, g = 0, h = 0;
    for (int k = 0; k < count; k++, x += ld) {
      const double by = factor[k];
      a += by * x[0], b += by * x[1], c += by * x[2], d += by * x[3];
      e += by * x[4], f += by * x[5], g += by * x[6], h += by * x[7];
    }
    sum[i] = a, sum[i + 1] = b, sum[i + 2] = c, sum[i + 3] = d;
    sum[i + 4] = e, sum[i + 5] = f, sum[i + 6] = g, sum[i + 7] = h;
  }
  for (; i + 2 <= n; i += 2) {
    const double *x = columns + i;
    double a = 0, b = 0;
    for (int k = 0; k < count; k++, x += ld) a += factor[k] * x[0], b += factor[k] * x[1];
    sum[i] = a, sum[i + 1] = b;
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

void frot_make_unit(const double *l, int n, double *unit, double *share) {
  for (int k = 0; k < n; k++) share[k] = 1 / l[(size_t)k * (size_t)n + (size_t)k];
  for (int k = 0; k < n; k++, l += n, unit += n) {
    const double factor = share[k];
    int i = k + 1;
    for (; i + 2 <= n; i += 2) unit[i] = l[i] * factor, unit[i + 1] = l[i + 1] * factor;
    if (i < n) unit[i] = l[i] * factor;
  }
}

/* Two items at a time, each of which waits for the one before as late as can be. */
void frot_forward_unit(const double *unit, int n, double *x) {
  int i = 0;
  for (; i + 2 <= n; i += 2) {
    const double *entry = unit + i;
    double one = x[i], two = x[i + 1];
    for (int k = 0; k < i; k++, entry += n) one -= entry[0] * x[k], two -= entry[1] * x[k];
    x[i] = one;
    x[i + 1] = two - entry[1] * one;
  }
  if (i == n) return;
  double last = x[i];
  for (int k = 0; k < i; k++) last -= AT(unit, n, i, k) * x[k];
  x[i] = last;
}

void frot_backward_unit(const double *unit, int n, double *x) {
  int i = n - 1;
  for (; i >= 1; i -= 2) {
    const double *right = unit + (size_t)i * (size_t)n, *left = right - n;
    double two = x[i], one = x[i - 1];
    for (int k = n - 1; k > i; k--) two -= right[k] * x[k], one -= left[k] * x[k];
    x[i] = two;
    x[i - 1] = one - left[i] * two;
  }
  if (i < 0) return;
  double first = x[0];
  for (int k = n - 1; k > 0; k--) first -= unit[k] * x[k];
  x[0] = first;
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
      take_one(other + k + 1, column + k + 1, factor, end - k - 1);
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
    take_one(b + k + 1, column + k + 1, value, n - k - 1);
  }
  for (int k = n - 1; k >= 0; k--) {
    const double *column = a + (size_t)k * (size_t)n, value = b[k] /= column[k];
    take_one(b, column, value, k);
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

int frot_lu(double *a, int n, double enough, int *pivot, double *scale) {
  equilibrate(a, n, scale);
  for (int k = 0; k < n; k++) {
    int best = k;
    for (int i = k + 1; i < n; i++)
      if (fabs(AT(a, n, i, k)) > fabs(AT(a, n, best, k))) best = i;
    if (fabs(AT(a, n, k, k)) >= enough * fabs(AT(a, n, best, k))) best = k;
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
