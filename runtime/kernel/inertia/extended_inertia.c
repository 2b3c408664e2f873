#include "inertia/extended_inertia.h"

#include <math.h>
#include <string.h>

#include "model/calls.h"
#include "model/island_calls.h"
#include "numerics/tolerances.h"
#include "inertia/articulated.h"
#include "inertia/articulated_extended.h"
#include "numerics/extended_precision.h"

#define TAKE(field, count) FROT_TAKE(a, field, count)

/* Part of its terms below which a sum is found in wide numbers. */
#define CANCELS 1e-2

/* The island of a group, or -1 where the model has none. */
static int island_of(const frot_model *m, const frot_group *g) {
  int group = (int)(g - m->groups);
  for (int i = 0; i < m->n_islands; i++) {
    const frot_island *island = &m->islands[i];
    if (group >= island->first_group && group < island->first_group + island->n_groups) return i;
  }
  return -1;
}

static const frot_wide_callable *function_of(const frot_model *m, const frot_group *g) {
  int island = island_of(m, g);
  return island < 0 ? &m->wide : &m->islands[island].wide;
}

int frot_is_masked(const frot_model *m, const frot_state *s, const frot_work *w,
                   const frot_group *g, int status) {
  if (!w->wide.mass || g->general) return 0;
  const double *mass = w->core.mass + g->matrix, *factor = w->core.factor + g->metric;
  int masked = status == FROT_SINGULAR || s->data[w->layout.carried + (g - m->groups)] > FROT_HEAVY;
  for (int k = 0; !masked && g->n_links == 0 && k < g->n_speeds; k++) {
    double pivot = factor[k * g->n_speeds + k];
    masked = !(pivot * pivot * FROT_HEAVY > mass[k * g->n + k]);
  }
  return masked && function_of(m, g)->call != NULL;
}

void frot_begin_wide(const frot_model *m, frot_work *w) {
  w->wide.island = FROT_NO_ISLAND;
  if (w->wide.mass) memset(w->wide.of, 0, (size_t)m->n_groups);
}

/* The values of `wide` of an island, or of the whole, each where it belongs. */
static void evaluate(const frot_model *m, frot_state *s, frot_work *w, int island, double t,
                     const double *q, const double *v, const double *d) {
  frot_wide_work *own = &w->wide;
  int first = 0, count = m->n_groups, matrix = 0;
  const frot_wide_callable *function = &m->wide;
  if (island >= 0) {
    function = &m->islands[island].wide, matrix = w->awake.extent[island].matrix;
    first = m->islands[island].first_group, count = m->islands[island].n_groups;
    frot_take_inputs(s, w, &m->islands[island], &t, q, v, d);
  } else {
    frot_inputs(s, w, &t, q, v, d);
  }
  frot_wide *res[] = {own->mass + matrix, island < 0 ? own->h : own->loads, own->given};
  function->call(w->call.arg, res, w->call.iw, own->w, 0);
  const frot_wide *loads = own->loads, *given = own->given;
  for (int k = first; k < first + count; k++) {
    const frot_group *g = &m->groups[k];
    for (int i = 0; island >= 0 && i < g->n; i++) own->h[g->unknowns[i]] = *loads++;
    for (int i = 0; i < g->n_given; i++) own->rows[g->entries + g->given[i]] = *given++;
  }
}

/* Rows that row_rounding.c found to be nothing but rounding are zero here too. */
static void clean_rows(frot_work *w, const frot_group *g) {
  for (int i = 0; i < g->n_given; i++) {
    int at = g->entries + g->given[i];
    if (w->core.rows[at] == 0) w->wide.rows[at] = 0;
  }
}

static int factorize(frot_wide *a, int n) {
  for (int j = 0; j < n; j++) {
    frot_wide *column = a + (size_t)j * (size_t)n, whole = column[j];
    for (int k = 0; k < j; k++) {
      const frot_wide *before = a + (size_t)k * (size_t)n;
      for (int i = j; i < n; i++) column[i] -= before[j] * before[i];
    }
    if (!(column[j] > n * FROT_WIDE_EPSILON * whole)) return 1;
    column[j] = frot_wide_root(column[j]);
    for (int i = j + 1; i < n; i++) column[i] /= column[j];
  }
  return 0;
}

/* x <- L^-1 x. */
static void go_inwards(frot_work *w, const frot_group *g, frot_wide *x) {
  const frot_wide *factor = w->wide.factor + g->metric;
  int n = g->n_speeds;
  if (g->n_links > 0) {
    frot_wide_tree_forward(g, w->wide.mass + g->matrix, factor, w->wide.twist, x);
    return;
  }
  for (int k = 0; k < n; k++, factor += n) {
    x[k] /= factor[k];
    for (int i = k + 1; i < n && x[k] != 0; i++) x[i] -= x[k] * factor[i];
  }
}

static void round_to(const frot_wide *from, int count, double *to) {
  for (int i = 0; i < count; i++) to[i] = (double)from[i];
}

static frot_wide product(const frot_wide *a, const frot_wide *b, int n) {
  frot_wide sum = 0;
  for (int i = 0; i < n; i++)
    if (a[i] != 0 && b[i] != 0) sum += a[i] * b[i];
  return sum;
}

/* Items of the factor of a group: those of a tree end with its last step. */
static int factor_size(const frot_model *m, const frot_group *g) {
  int after = (int)(g - m->groups) + 1;
  return (after < m->n_groups ? m->groups[after].metric : m->n_metric) - g->metric;
}

int frot_wide_factor(const frot_model *m, frot_state *s, frot_work *w, const frot_group *g,
                     double t, const double *q, const double *v, const double *d) {
  int n = g->n, ns = g->n_speeds, island = island_of(m, g);
  if (w->wide.island != island) evaluate(m, s, w, island, t, q, v, d);
  w->wide.island = island, w->wide.of[g - m->groups] = 1;
  clean_rows(w, g);
  const frot_wide *mass = w->wide.mass + g->matrix;
  frot_wide *factor = w->wide.factor + g->metric, *force = w->wide.force + g->vector;
  for (int k = 0; k < ns; k++) force[k] = w->wide.h[g->unknowns[k]];
  if (g->n_links > 0) {
    if (frot_wide_tree_factor(g, mass, factor, w->wide.inertia, w->wide.twist, force))
      return FROT_SINGULAR;
  } else {
    for (int k = 0; k < ns; k++)
      memcpy(factor + k * ns, mass + k * n, sizeof(frot_wide) * (size_t)ns);
    if (factorize(factor, ns)) return FROT_SINGULAR;
    go_inwards(w, g, force);
  }
  round_to(factor, factor_size(m, g), w->core.factor + g->metric);
  round_to(force, ns, w->core.force + g->vector);
  return FROT_OK;
}

/* Entries of the speeds in the column (n) of an auxiliary unknown; returns its own. */
static frot_wide read_column(const frot_work *w, const frot_group *g, int k, frot_wide *column) {
  const frot_wide *mass = w->wide.mass + g->matrix;
  int ns = g->n_speeds;
  if (g->n_links > 0) {
    memset(column, 0, sizeof(frot_wide) * (size_t)g->n);
    column[k] = 1;
    frot_wide_tree_times(g, mass, w->wide.twist, column);
    return column[k];
  }
  for (int i = 0; i < ns; i++) column[i] = mass[i * g->n + k];
  return mass[ns * g->n + k - ns];
}

double frot_felt_inertia(const frot_model *m, frot_work *w, const frot_group *g, int row) {
  frot_wide *column = w->wide.loads, own = read_column(w, g, m->row_reads[row], column);
  go_inwards(w, g, column);
  return (double)(own - product(column, column, g->n_speeds));
}

/* a'b, plus `more`, of halves of a group that lie at `a` and `b`: from their roundings, which are
 * enough where it is not far less than its terms. */
static double sum_of(const frot_wide *wide_a, const frot_wide *wide_b, const double *a,
                     const double *b, frot_wide more, int n) {
  double sum = (double)more, size = fabs(sum);
  for (int i = 0; i < n; i++) {
    double term = a[i] * b[i];
    sum += term, size += fabs(term);
  }
  if (fabs(sum) >= CANCELS * size) return sum;
  return (double)(product(wide_a, wide_b, n) + more);
}

/* L^-1 of the row i of a group, and its value without reactions. */
static void form_row(const frot_model *m, frot_work *w, const frot_group *g, int i) {
  int ns = g->n_speeds, r = g->rows[i], reads = m->row_reads[r];
  frot_wide *half = w->wide.half + g->entries + i * g->n;
  if (reads >= 0)
    read_column(w, g, reads, half);
  else
    memcpy(half, w->wide.rows + g->entries + i * g->n, sizeof(frot_wide) * (size_t)ns);
  go_inwards(w, g, half);
  double *rounded = w->core.half + g->entries + i * g->n;
  round_to(half, ns, rounded);
  frot_wide own = reads >= 0 ? -w->wide.h[g->unknowns[reads]] : (frot_wide)w->core.c[r];
  w->core.free[r] =
      sum_of(half, w->wide.force + g->vector, rounded, w->core.force + g->vector, own, ns);
}

void frot_wide_rows(const frot_model *m, frot_work *w, const frot_group *g, int count, int acting) {
  const int *listed = w->core.listed;
  for (int a = 0; a < count; a++) form_row(m, w, g, listed[a]);
  for (int a = 0; a < count; a++)
    for (int b = 0; b < acting; b++) {
      int i = listed[a], j = listed[b], reads = m->row_reads[g->rows[i]];
      int one = g->entries + i * g->n, two = g->entries + j * g->n;
      const double *half = w->core.half;
      frot_wide own = reads >= 0 ? -w->wide.rows[two + reads] : 0;
      w->core.delassus[g->square + i * g->n_rows + j] =
          sum_of(w->wide.half + one, w->wide.half + two, half + one, half + two, own, g->n_speeds);
    }
}

/* What wide numbers take, where there are any. */
void frot_bind_wide(const frot_model *m, const frot_layout *l, frot_wide_work *w, frot_arena *a) {
  int scratch = m->wide.n_w, given = 0, steps = 0, some = m->wide.call != NULL;
  for (int i = 0; i < m->n_islands; i++) {
    some |= m->islands[i].wide.call != NULL, scratch = frot_larger(scratch, m->islands[i].wide.n_w);
  }
  if (!some) return;
  for (int k = 0; k < m->n_groups; k++)
    given += m->groups[k].n_given, steps = frot_larger(steps, m->groups[k].n_links);
  TAKE(w->mass, m->n_matrix), TAKE(w->h, l->nw), TAKE(w->rows, m->n_entries);
  TAKE(w->factor, m->n_metric), TAKE(w->force, l->nw), TAKE(w->half, m->n_entries);
  TAKE(w->loads, l->nw), TAKE(w->given, given), TAKE(w->w, scratch), TAKE(w->of, m->n_groups);
  TAKE(w->inertia, FROT_STEP_INERTIA * steps), TAKE(w->twist, FROT_STEP_TWIST * steps);
}
