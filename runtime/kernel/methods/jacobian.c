#include "methods/jacobian.h"

#include <math.h>
#include <string.h>

#include "numerics/dense.h"
#include "methods/right_hand_side.h"
#include "methods/radau.h"
#include "numerics/sparse_real.h"
#include "numerics/tolerances.h"

/* Sizes tried for the bound of the eigenvalues. */
#define BOUND_PASSES 4

static int is_sparse(const frot_model *m) { return m->pattern.n > 0; }

static int early_unknowns(const frot_model *m) {
  int count = 0;
  for (int i = 0; i < m->n_blocks; i++)
    if (!m->blocks[i].late) count += m->blocks[i].count;
  return count;
}

/* The next `count` items of an array that may be NULL. */
static double *take(double *base, size_t *used, int count) {
  double *at = base ? base + *used : NULL;
  *used += (size_t)count;
  return at;
}

frot_jacobian frot_jacobian_of(const frot_model *m, const frot_work *w, size_t *doubles,
                               size_t *integers) {
  int n = frot_order(m), ny = early_unknowns(m), motion = frot_has_motion(m);
  int entries = is_sparse(m) ? m->pattern.entries : n * n;
  int factors = is_sparse(m) ? m->pattern.start[n] : n * n;
  double *base = doubles ? NULL : w->implicit.items;
  size_t used = motion ? frot_radau_doubles(m) : 0;
  int *integer = doubles ? NULL : w->implicit.pivot + (motion ? frot_radau_integers(m) : 0);
  frot_jacobian j;
  j.entries = take(base, &used, entries);
  j.slope_y = take(base, &used, n * ny); /* what follows the entries in frot_linearize */
  j.rate = take(base, &used, n);
  j.factors = take(base, &used, factors);
  j.scale = take(base, &used, 2 * n);
  j.scratch = take(base, &used, 2 * n);
  j.misfit = take(base, &used, frot_condition_guard(m) + m->n_located);
  j.block_q = take(base, &used, ny * n);
  j.block_y = take(base, &used, ny * ny); /* and so here */
  j.block_t = take(base, &used, ny);
  j.block_scale = take(base, &used, 2 * ny);
  j.growth = integer;
  j.pivot = doubles ? NULL : j.growth + 1;
  j.raised_by = doubles ? NULL : j.pivot + n;
  j.block_pivot = doubles ? NULL : j.raised_by + n;
  size_t own = 0, places = motion ? frot_radau_integers(m) : 0, more = 0;
  if (motion)
    j.linearize = frot_linearize_scratch(m, base ? base + used : NULL,
                                         doubles ? NULL : j.block_pivot + ny, &own, &more);
  j.linearize.rates = j.entries, j.linearize.residual = j.block_q;
  if (doubles) *doubles = used + own;
  if (integers) *integers = (size_t)(1 + 2 * n + ny) + places + more;
  return j;
}

/* The rates depend on the states and t through the unknowns y of the blocks too:
 * J <- f_x - f_y (r_y)^-1 r_x. */
static int condense(const frot_model *m, const frot_jacobian *j, int ny) {
  int n = frot_order(m);
  if (frot_lu(j->block_y, ny, 1, j->block_pivot, j->block_scale)) return FROT_SINGULAR;
  for (int c = 0; c <= n; c++) {
    double *x = c < n ? j->block_q + ny * c : j->block_t;
    double *into = c < n ? j->entries + n * c : j->rate;
    frot_lu_apply(j->block_y, ny, j->block_pivot, j->block_scale, x);
    for (int k = 0; k < ny; k++) {
      if (x[k] == 0) continue;
      for (int i = 0; i < n; i++) into[i] -= j->slope_y[n * k + i] * x[k];
    }
  }
  return FROT_OK;
}

int frot_jacobian_at(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
                     const double *d, double *slope) {
  frot_jacobian j = frot_jacobian_of(m, w, NULL, NULL);
  int ny = early_unknowns(m), n = frot_order(m), status;
  s->statistics.jacobians++;
  if (frot_has_motion(m)) {
    status = frot_linearize(m, s, w, t, z, d, &j.linearize, slope);
    if (status != FROT_OK) return status;
    memset(j.rate, 0, sizeof(double) * (size_t)n);
    memset(j.block_t, 0, sizeof(double) * (size_t)ny);
    if (ny > 0 && (status = condense(m, &j, ny)) != FROT_OK) return status;
    return frot_all_finite(j.entries, is_sparse(m) ? m->pattern.entries : n * n) ? FROT_OK
                                                                                 : FROT_NAN;
  }
  frot_inputs(s, w, &t, z, z + n, d);
  double *res[] = {j.entries, j.rate, j.slope_y, j.block_q, j.block_t, j.block_y};
  memcpy(w->call.res, res, sizeof res);
  frot_call(w, &m->jacobian);
  if (ny > 0) {
    if (!frot_all_finite(j.slope_y, n * ny) || !frot_all_finite(j.block_q, ny * n) ||
        !frot_all_finite(j.block_t, ny) || !frot_all_finite(j.block_y, ny * ny))
      return FROT_NAN;
    status = condense(m, &j, ny);
    if (status != FROT_OK) return status;
  }
  int entries = is_sparse(m) ? m->pattern.entries : n * n;
  return frot_all_finite(j.entries, entries) && frot_all_finite(j.rate, n) ? FROT_OK : FROT_NAN;
}

int frot_jacobian_factor(const frot_model *m, frot_work *w, double shift) {
  frot_jacobian j = frot_jacobian_of(m, w, NULL, NULL);
  int n = frot_order(m);
  if (is_sparse(m))
    return frot_sparse_factor(&m->pattern, j.entries, shift, j.factors, j.scratch, j.growth);
  for (int i = 0; i < n * n; i++) j.factors[i] = -j.entries[i];
  for (int i = 0; i < n; i++) j.factors[n * i + i] += shift;
  return frot_lu(j.factors, n, FROT_ENOUGH_PIVOT, j.pivot, j.scale);
}

void frot_jacobian_solve(const frot_model *m, const frot_work *w, const double *b, double *x) {
  frot_jacobian j = frot_jacobian_of(m, w, NULL, NULL);
  if (is_sparse(m)) {
    frot_sparse_solve(&m->pattern, j.factors, b, j.scratch, x);
    return;
  }
  int n = frot_order(m);
  memcpy(x, b, sizeof(double) * (size_t)n);
  frot_lu_apply(j.factors, n, j.pivot, j.scale, x);
}

double frot_jacobian_error(const frot_model *m, const frot_work *w, double shift, const double *b,
                           const double *x) {
  frot_jacobian j = frot_jacobian_of(m, w, NULL, NULL);
  if (!is_sparse(m) || !*j.growth) return 0;
  return frot_sparse_error(&m->pattern, j.entries, shift, b, x, j.scratch,
                           j.scratch + frot_order(m));
}

const double *frot_jacobian_damping(const frot_model *m, const frot_work *w, double h) {
  frot_jacobian j = frot_jacobian_of(m, w, NULL, NULL);
  const frot_pattern *p = &m->pattern;
  int n = frot_order(m);
  double *damping = j.scratch;
  for (int k = 0; k < n; k++) damping[k] = 1;
  for (int k = 0; k < n && !is_sparse(m); k++) {
    int own = k < m->nq ? -1 : m->speed_coordinate[k - m->nq];
    damping[k] += h * fabs(j.entries[(n + 1) * k]);
    if (own >= 0) damping[k] += h * h * fabs(j.entries[n * own + k]);
  }
  for (int e = 0; e < p->entries && is_sparse(m); e++) {
    int row = p->entry_row[e], column = p->entry_column[e];
    if (column == row) damping[row] += h * fabs(j.entries[e]);
    if (row >= m->nq && column == m->speed_coordinate[row - m->nq])
      damping[row] += h * h * fabs(j.entries[e]);
  }
  return damping;
}

void frot_jacobian_spread(const frot_model *m, const frot_work *w, const double *x, double *y) {
  frot_jacobian own = frot_jacobian_of(m, w, NULL, NULL), *j = &own;
  const frot_pattern *p = &m->pattern;
  int n = frot_order(m);
  memset(y, 0, sizeof(double) * (size_t)n);
  if (is_sparse(m)) {
    for (int e = 0; e < p->entries; e++)
      y[p->entry_row[e]] += fabs(j->entries[e]) * x[p->entry_column[e]];
    return;
  }
  for (int c = 0; c < n; c++)
    for (int i = 0; i < n; i++) y[i] += fabs(j->entries[n * c + i]) * x[c];
}

double frot_jacobian_bound(const frot_model *m, const frot_work *w, const double *size) {
  frot_jacobian j = frot_jacobian_of(m, w, NULL, NULL);
  int n = frot_order(m);
  double *x = j.scratch, *y = j.scratch + n, bound = INFINITY;
  memcpy(x, size, sizeof(double) * (size_t)n);
  for (int pass = 0; pass < BOUND_PASSES; pass++) {
    double norm = 0;
    frot_jacobian_spread(m, w, x, y);
    for (int i = 0; i < n; i++)
      if (y[i] > 0) norm = fmax(norm, x[i] > 0 ? y[i] / x[i] : INFINITY);
    bound = fmin(bound, norm);
    for (int i = 0; i < n; i++) x[i] += norm > 0 && norm < INFINITY ? y[i] / norm : y[i];
  }
  return bound;
}
