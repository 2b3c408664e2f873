#include "numerics/dense_complex.h"

#include <float.h>
#include <math.h>

#include "numerics/tolerances.h"

static void swap(double *a, double *b) {
  double t = *a;
  *a = *b, *b = t;
}

static void equilibrate(double *re, double *im, int n, const double *scale) {
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) {
      double factor = scale[i] * scale[n + j];
      re[n * j + i] *= factor, im[n * j + i] *= factor;
    }
}

/* Column j below row k takes its part of column k away. */
static void reduce(double *re, double *im, int n, int k, int j) {
  double a = re[n * j + k], b = im[n * j + k];
  const double *p = re + n * k, *q = im + n * k;
  double *x = re + n * j, *y = im + n * j;
  if (a == 0 && b == 0) return;
  for (int i = k + 1; i < n; i++) {
    x[i] -= p[i] * a - q[i] * b;
    y[i] -= p[i] * b + q[i] * a;
  }
}

int frot_complex_lu(double *re, double *im, int n, int *pivot, const double *scale) {
  equilibrate(re, im, n, scale);
  for (int k = 0; k < n; k++) {
    int best = k;
    double most = -1;
    for (int i = k; i < n; i++) {
      double size = fabs(re[n * k + i]) + fabs(im[n * k + i]);
      if (size > most) most = size, best = i;
    }
    if (fabs(re[(n + 1) * k]) + fabs(im[(n + 1) * k]) >= FROT_ENOUGH_PIVOT * most) best = k;
    pivot[k] = best;
    if (!(most > 4 * n * DBL_EPSILON) || isinf(most)) return 1;
    for (int j = k; best != k && j < n; j++)
      swap(&re[n * j + k], &re[n * j + best]), swap(&im[n * j + k], &im[n * j + best]);
    double a = re[n * k + k], b = im[n * k + k], square = a * a + b * b;
    for (int i = k + 1; i < n; i++) {
      double x = re[n * k + i], y = im[n * k + i];
      re[n * k + i] = (x * a + y * b) / square, im[n * k + i] = (y * a - x * b) / square;
    }
    for (int j = k + 1; j < n; j++) reduce(re, im, n, k, j);
  }
  return 0;
}

void frot_complex_apply(const double *re, const double *im, int n, const int *pivot,
                        const double *scale, double *x, double *y) {
  for (int i = 0; i < n; i++) x[i] *= scale[i], y[i] *= scale[i];
  for (int k = 0; k < n; k++) {
    swap(&x[k], &x[pivot[k]]), swap(&y[k], &y[pivot[k]]);
    for (int i = k + 1; i < n; i++) {
      double p = re[n * k + i], q = im[n * k + i];
      x[i] -= p * x[k] - q * y[k], y[i] -= p * y[k] + q * x[k];
    }
  }
  for (int k = n - 1; k >= 0; k--) {
    double a = re[n * k + k], b = im[n * k + k], square = a * a + b * b, u = x[k], v = y[k];
    x[k] = (u * a + v * b) / square, y[k] = (v * a - u * b) / square;
    for (int i = 0; i < k; i++) {
      double p = re[n * k + i], q = im[n * k + i];
      x[i] -= p * x[k] - q * y[k], y[i] -= p * y[k] + q * x[k];
    }
  }
  for (int j = 0; j < n; j++) x[j] *= scale[n + j], y[j] *= scale[n + j];
}
