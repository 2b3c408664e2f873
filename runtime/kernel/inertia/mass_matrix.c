#include "inertia/mass_matrix.h"

#include <float.h>
#include <string.h>

#include "numerics/dense.h"
#include "inertia/articulated.h"
#include "inertia/extended_inertia.h"
#include "numerics/extended_precision.h"

int frot_factor(frot_work *w, const frot_group *g) {
  int n = g->n, ns = g->n_speeds;
  const double *mass = w->core.mass + g->matrix;
  double *factor = w->core.factor + g->metric, *force = w->core.force + g->vector;
  for (int k = 0; k < ns; k++) force[k] = w->core.h[g->unknowns[k]];
  if (g->n_links > 0) {
    int failed = frot_tree_factor(g, mass, factor, w->core.inertia, w->core.twist, force);
    return failed ? FROT_SINGULAR : FROT_OK;
  }
  for (int k = 0; k < ns; k++) memcpy(factor + k * ns, mass + k * n, sizeof(double) * (size_t)ns);
  if (frot_cholesky(factor, ns)) return FROT_SINGULAR;
  frot_forward(factor, ns, ns, force);
  return FROT_OK;
}

void frot_inwards(const frot_work *w, const frot_group *g, double *x) {
  const double *factor = w->core.factor + g->metric;
  if (g->n_links > 0)
    frot_tree_forward(g, w->core.mass + g->matrix, factor, w->core.twist, x);
  else
    frot_forward(factor, g->n_speeds, g->n_speeds, x);
}

void frot_outwards(const frot_work *w, const frot_group *g, double *x) {
  const double *factor = w->core.factor + g->metric;
  if (g->n_links > 0)
    frot_tree_backward(g, w->core.mass + g->matrix, factor, w->core.twist, x);
  else
    frot_backward(factor, g->n_speeds, g->n_speeds, x);
}

/* Behind the speeds x what auxiliary unknowns make of their momenta. */
static void read_momenta(const frot_work *w, const frot_group *g, double *x) {
  int ns = g->n_speeds;
  frot_add_columns(w->core.mass + g->matrix + ns, g->n, x, ns, g->n - ns, x + ns);
}

void frot_begin_responses(frot_work *w, const frot_group *g) {
  if (g->n_links > 0) return;
  frot_make_unit(w->core.factor + g->metric, g->n_speeds, w->core.unit + g->metric,
                 w->core.share + g->vector);
}

void frot_respond(const frot_work *w, const frot_group *g, double *x) {
  int ns = g->n_speeds;
  const double *factor = w->core.factor + g->metric, *force = w->core.force + g->vector;
  if (g->n_links > 0) {
    frot_tree_respond(g, w->core.mass + g->matrix, factor, w->core.twist, w->core.motion, force, x);
    return;
  }
  const double *unit = w->core.unit + g->metric, *share = w->core.share + g->vector;
  frot_forward_unit(unit, ns, x);
  for (int k = 0; k < ns; k++) x[k] = (x[k] * share[k] + force[k]) * share[k];
  frot_backward_unit(unit, ns, x);
  read_momenta(w, g, x);
}

/* Column k of a large tree's matrix (n). */
static void tree_column(const frot_work *w, const frot_group *g, int k, double *column) {
  memset(column, 0, sizeof(double) * (size_t)g->n);
  column[k] = 1;
  frot_tree_times(g, w->core.mass + g->matrix, w->core.twist, column);
}

/* That of an unknown, where only the columns of speeds are there and the diagonal of the rest. */
static double own_inertia(const frot_group *g, const double *mass, int k) {
  int ns = g->n_speeds;
  return k < ns ? mass[k * g->n + k] : mass[ns * g->n + k - ns];
}

double frot_mass_column(const frot_work *w, const frot_group *g, int k, double *column) {
  const double *mass = w->core.mass + g->matrix;
  if (g->n_links > 0) {
    double *whole = w->core.momenta;
    tree_column(w, g, k, whole);
    memcpy(column, whole, sizeof(double) * (size_t)g->n_speeds);
    return whole[k];
  }
  for (int i = 0; i < g->n_speeds; i++) column[i] = mass[i * g->n + k];
  return own_inertia(g, mass, k);
}

void frot_momenta(const frot_work *w, const frot_group *g, const double *x, double *y) {
  int ns = g->n_speeds;
  if (g->n_links > 0) {
    double *whole = w->core.momenta;
    memcpy(whole, x, sizeof(double) * (size_t)ns);
    memset(whole + ns, 0, sizeof(double) * (size_t)(g->n - ns));
    frot_tree_times(g, w->core.mass + g->matrix, w->core.twist, whole);
    memcpy(y, whole, sizeof(double) * (size_t)ns);
    return;
  }
  memset(y, 0, sizeof(double) * (size_t)ns);
  const double *column = w->core.mass + g->matrix;
  for (int k = 0; k < ns; k++, column += g->n)
    for (int i = 0; i < ns; i++) y[i] += x[k] * column[i];
}

void frot_own_inertias(const frot_work *w, const frot_group *g, double *own) {
  const double *mass = w->core.mass + g->matrix;
  if (g->n_links > 0)
    frot_tree_diagonal(g, mass, w->core.inertia, own);
  else
    for (int k = 0; k < g->n; k++) own[k] = own_inertia(g, mass, k);
}

double frot_masked_part(const frot_model *m, frot_work *w, const frot_group *g) {
  double most = 0, rounding = frot_in_wide(m, w, g) ? (double)FROT_WIDE_EPSILON : DBL_EPSILON,
         *x = w->core.rest, *own = w->core.column;
  frot_own_inertias(w, g, own);
  for (int k = 0; k < g->n_speeds; k++) {
    memset(x, 0, sizeof(double) * (size_t)g->n_speeds);
    x[k] = 1;
    frot_inwards(w, g, x);
    double loss = own[k] * frot_dot(x, x, g->n_speeds);
    if (loss > most) most = loss;
  }
  return rounding * most;
}

void frot_whole_column(const frot_work *w, const frot_group *g, int k, double *column) {
  if (g->n_links > 0)
    tree_column(w, g, k, column);
  else
    memcpy(column, w->core.mass + g->matrix + k * g->n, sizeof(double) * (size_t)g->n);
}

const double *frot_metric_column(frot_work *w, const frot_group *g, int k) {
  if (g->general) return w->core.metric + g->metric + k * g->n_speeds;
  if (g->n_links == 0) return w->core.mass + g->matrix + k * g->n;
  tree_column(w, g, k, w->core.momenta);
  return w->core.momenta;
}

double frot_square_of(const frot_work *w, const frot_group *g, const double *v) {
  if (g->n_links > 0) {
    double whole = frot_tree_square(g, w->core.mass + g->matrix, w->core.twist, v);
    return whole > 0 ? whole : 0;
  }
  int ns = g->n_speeds, order = g->general ? ns : g->n;
  const double *metric = g->general ? w->core.metric + g->metric : w->core.mass + g->matrix;
  double sum = 0;
  for (int i = 0; i < ns; i++)
    for (int k = 0; k < ns; k++)
      sum += v[g->unknowns[i]] * metric[k * order + i] * v[g->unknowns[k]];
  return sum > 0 ? sum : 0;
}
