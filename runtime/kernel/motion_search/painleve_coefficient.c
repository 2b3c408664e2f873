/* The equations of a motion without loads. An acceleration of 1 along the normal takes the normal
 * reaction 1/p; where the normal is a reading, a friction of 1 by itself brings a reaction r, and
 * p = 1 + s mu r. */
#include <math.h>
#include <string.h>

#include "motion_search/motion_orders.h"
#include "numerics/dense.h"

/* Part of a reaction that others leave open up to which it is determined. */
#define DETERMINED 1e-9

/* Fill s->rows with the equations of a motion without loads. */
static void list_equations(frot_searcher *s, const frot_found_motion *motion) {
  static const double axes[2][2] = {{1, 0}, {0, 1}};
  const frot_motion_problem *p = s->p;
  for (int i = 0; i < p->n_items; i++) {
    double r[2] = {1, 0};
    for (int c = 0;
         c < 2 && p->items[i].kind == FROT_ITEM_LAW && p->items[i].bound == FROT_BOUND_LENGTH; c++)
      r[c] = frot_bound_value(p, &p->items[i], motion->b, motion->x, axes[c]);
    double length = hypot(r[0], r[1]);
    s->direction[2 * i] = length > 0 ? r[0] / length : 1;
    s->direction[2 * i + 1] = length > 0 ? r[1] / length : 0;
  }
  double *zero = s->size;
  memset(zero, 0, sizeof(double) * (size_t)p->places);
  memset(s->known, 0, sizeof(double) * 2 * (size_t)p->n_items);
  frot_order order = {0, zero, zero, 1, s->known, NULL};
  frot_reading reading = {motion->kinetic, s->direction, 1, 0, 0};
  frot_list_inequalities(p, motion->states, &order, &reading, &s->rows);
  s->rows.p.inequalities = 0;
  memset(s->rows.b, 0, sizeof(double) * (size_t)s->rows.p.equations);
}

/* The equation of s->rows that is this row, or -1. */
static int find_equation(const frot_searcher *s, const double *row) {
  size_t n = (size_t)s->p->n;
  for (int i = 0; i < s->rows.p.equations; i++)
    if (!memcmp(s->rows.a + (size_t)i * n, row, n * sizeof(double))) return i;
  return -1;
}

/* x <- the solution of the equations. Returns 1 where there is none, or the sum row x is open. */
static int solve(frot_searcher *s, const double *row, double *x) {
  int redundant, n = s->p->n;
  if (frot_polyhedron_point(&s->rows.p, x, &redundant, s->doubles, s->integers)) return 1;
  double *basis = s->turned + n;
  int count = frot_free_directions(&s->rows.p, basis, s->doubles);
  for (int k = 0; k < count; k++)
    if (fabs(frot_dot(row, basis + k * n, n)) > DETERMINED * frot_length(row, n)) return 1;
  return 0;
}

double frot_painleve_coefficient(const frot_motion_problem *p, const frot_found_motion *motion,
                                 int law, double *doubles, int *integers) {
  const frot_motion_item *item = &p->items[law];
  const frot_item_state *state = &motion->states[law];
  frot_searcher s;
  if (item->kind != FROT_ITEM_LAW || item->bound == FROT_BOUND_VALUE ||
      item->bound == FROT_BOUND_LENGTH)
    return NAN;
  long long list = frot_found_doubles(p->n, p->places, p->n_items) * (2 * FROT_MOST_FOUND + 1);
  frot_begin_search(p, &s, doubles + list, integers);
  int normal = item->reads[0], n = p->n;
  size_t size = sizeof(double) * (size_t)n;
  frot_motion_problem whole = *p; /* with permanent rows as they are */
  memcpy(s.whole, p->w, size * (size_t)p->places);
  memcpy(s.whole, p->gram, size * (size_t)n);
  whole.w = s.whole, s.p = &whole;
  list_equations(&s, motion);
  double *x = s.x, *row = s.span;
  const double *effects = whole.w + normal * n;
  if (normal < n) {
    int at = find_equation(&s, effects);
    if (at < 0) return NAN;
    s.rows.b[at] = 1;
    memset(row, 0, sizeof(double) * (size_t)n);
    row[normal] = 1;
    return solve(&s, row, x) ? NAN : 1 / x[normal];
  }
  int way = state->mode == FROT_ITEM_FORWARD ? 1 : -1;
  double mu = motion->kinetic[law] ? item->mu : item->mu_s;
  double factor = way * mu * (item->bound == FROT_BOUND_SIDED ? state->side : 1);
  for (int j = 0; j < n; j++) row[j] = 0 + factor * effects[j];
  row[item->row] += 1;
  int at = find_equation(&s, row);
  if (at < 0) return NAN;
  double *own = s.rows.a + at * n;
  memset(own, 0, sizeof(double) * (size_t)n);
  own[item->row] = 1, s.rows.b[at] = 1;
  return solve(&s, effects, x) ? NAN : 1 + factor * frot_dot(effects, x, n);
}
