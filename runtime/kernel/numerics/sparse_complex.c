#include "numerics/sparse_complex.h"

#include <math.h>
#include <string.h>

#include "numerics/tolerances.h"

static double size_of(double re, double im) { return fabs(re) + fabs(im); }

/* Reciprocal of a pivot. 0, or 1 where it is nothing beside `size`. */
static int invert(double re, double im, double size, double *to) {
  double square = re * re + im * im;
  if (!(size_of(re, im) > FROT_LEAST_PIVOT * size) || !(square > 0)) return 1;
  to[0] = re / square, to[1] = -im / square;
  return 0;
}

int frot_sparse_complex_factor(const frot_pattern *p, const double *jacobian, double re, double im,
                               double *lu, double *x) {
  memset(lu, 0, 2 * sizeof(double) * (size_t)p->start[p->n]);
  for (int k = 0; k < p->n; k++) lu[2 * p->diagonal[k]] = re, lu[2 * p->diagonal[k] + 1] = im;
  for (int e = 0; e < p->entries; e++) lu[2 * p->place[e]] -= jacobian[e];
  for (int k = 0; k < p->n; k++) {
    int first = p->start[k], end = p->start[k + 1], diagonal = p->diagonal[k];
    for (int e = first; e < end; e++) memcpy(x + 2 * p->column[e], lu + 2 * e, 2 * sizeof(double));
    double size = size_of(x[2 * k], x[2 * k + 1]);
    for (int e = first; e < diagonal; e++) {
      int j = p->column[e];
      const double *pivot = lu + 2 * p->diagonal[j];
      double a = x[2 * j] * pivot[0] - x[2 * j + 1] * pivot[1];
      double b = x[2 * j] * pivot[1] + x[2 * j + 1] * pivot[0];
      double before = x[2 * k], beside = x[2 * k + 1];
      lu[2 * e] = a, lu[2 * e + 1] = b;
      for (int u = p->diagonal[j] + 1; u < p->start[j + 1]; u++) {
        double *to = x + 2 * p->column[u];
        to[0] -= a * lu[2 * u] - b * lu[2 * u + 1];
        to[1] -= a * lu[2 * u + 1] + b * lu[2 * u];
      }
      size += size_of(x[2 * k] - before, x[2 * k + 1] - beside);
    }
    if (invert(x[2 * k], x[2 * k + 1], size, lu + 2 * diagonal)) return 1;
    for (int e = diagonal + 1; e < end; e++)
      memcpy(lu + 2 * e, x + 2 * p->column[e], 2 * sizeof(double));
  }
  return 0;
}

void frot_sparse_complex_apply(const frot_pattern *p, const double *lu, double *z, double *x,
                               double *y) {
  for (int k = 0; k < p->n; k++) {
    double re = x[p->order[k]], im = y[p->order[k]];
    for (int e = p->start[k]; e < p->diagonal[k]; e++) {
      const double *by = lu + 2 * e, *of = z + 2 * p->column[e];
      re -= by[0] * of[0] - by[1] * of[1], im -= by[0] * of[1] + by[1] * of[0];
    }
    z[2 * k] = re, z[2 * k + 1] = im;
  }
  for (int k = p->n - 1; k >= 0; k--) {
    double re = z[2 * k], im = z[2 * k + 1];
    for (int e = p->diagonal[k] + 1; e < p->start[k + 1]; e++) {
      const double *by = lu + 2 * e, *of = z + 2 * p->column[e];
      re -= by[0] * of[0] - by[1] * of[1], im -= by[0] * of[1] + by[1] * of[0];
    }
    const double *pivot = lu + 2 * p->diagonal[k];
    x[p->order[k]] = z[2 * k] = re * pivot[0] - im * pivot[1];
    y[p->order[k]] = z[2 * k + 1] = re * pivot[1] + im * pivot[0];
  }
}
