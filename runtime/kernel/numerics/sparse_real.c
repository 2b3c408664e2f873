#include "numerics/sparse_real.h"

#include <math.h>
#include <string.h>

#include "numerics/tolerances.h"

int frot_sparse_factor(const frot_pattern *p, const double *jacobian, double shift, double *lu,
                       double *x, int *growth) {
  *growth = 0;
  memset(lu, 0, sizeof(double) * (size_t)p->start[p->n]);
  for (int k = 0; k < p->n; k++) lu[p->diagonal[k]] = shift;
  for (int e = 0; e < p->entries; e++) lu[p->place[e]] -= jacobian[e];
  for (int k = 0; k < p->n; k++) {
    int first = p->start[k], end = p->start[k + 1], diagonal = p->diagonal[k];
    if (first == diagonal) { /* nothing to eliminate */
      if (!(fabs(lu[diagonal]) > 0)) return 1;
      lu[diagonal] = 1 / lu[diagonal];
      continue;
    }
    for (int e = first; e < end; e++) x[p->column[e]] = lu[e];
    double size = fabs(lu[diagonal]);
    for (int e = first; e < diagonal; e++) {
      int j = p->column[e];
      double factor = x[j] * lu[p->diagonal[j]], before = x[k];
      lu[e] = factor;
      if (fabs(factor) > 1) *growth = 1;
      for (int u = p->diagonal[j] + 1; u < p->start[j + 1]; u++) x[p->column[u]] -= factor * lu[u];
      size += fabs(x[k] - before);
    }
    if (!(fabs(x[k]) > FROT_LEAST_PIVOT * size)) return 1;
    lu[diagonal] = 1 / x[k];
    for (int e = diagonal + 1; e < end; e++) lu[e] = x[p->column[e]];
  }
  return 0;
}

void frot_sparse_solve(const frot_pattern *p, const double *lu, const double *b, double *y,
                       double *x) {
  const int *column = p->column, *start = p->start, *diagonal = p->diagonal;
  for (int k = 0; k < p->n; k++) {
    double sum = b[p->order[k]];
    for (int e = start[k]; e < diagonal[k]; e++) sum -= lu[e] * y[column[e]];
    y[k] = sum;
  }
  for (int k = p->n - 1; k >= 0; k--) {
    double sum = y[k];
    for (int e = diagonal[k] + 1; e < start[k + 1]; e++) sum -= lu[e] * y[column[e]];
    y[k] = x[p->order[k]] = sum * lu[diagonal[k]];
  }
}

double frot_sparse_error(const frot_pattern *p, const double *jacobian, double shift,
                         const double *b, const double *x, double *y, double *size) {
  for (int i = 0; i < p->n; i++) {
    y[i] = shift * x[i] - b[i];
    size[i] = fabs(shift * x[i]) + fabs(b[i]);
  }
  for (int e = 0; e < p->entries; e++) {
    double term = jacobian[e] * x[p->entry_column[e]];
    y[p->entry_row[e]] -= term;
    size[p->entry_row[e]] += fabs(term);
  }
  double worst = 0;
  for (int i = 0; i < p->n; i++) {
    double error = fabs(y[i]);
    if (error < FROT_LEAST_TERM) continue;
    if (!(error <= worst * size[i])) worst = error / size[i];
    if (isnan(worst)) break;
  }
  return worst;
}
