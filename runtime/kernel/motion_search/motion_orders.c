#include "motion_search/motion_orders.h"

#include <math.h>
#include <string.h>

#include "motion_search/sliding_springs.h"
#include "numerics/dense.h"

/* Part of the largest by which a row acts on itself, in units of reactions, below which no load is
 * read as a reaction there. */
#define FREE 1e-12
/* Part of the rows up to which reactions that are free move nothing. */
#define MOVES_NOTHING 1e-9
/* Part of the loads up to which an acceleration is none. */
#define RESTS 1e-10

/* The usual size of a reaction over its unit, by a right side. */
static double typical(const frot_motion_problem *p, const double *b) {
  double most = 0, found = 0;
  for (int i = 0; i < p->n; i++) most = fmax(most, p->w[i * p->n + i] * p->unit[i] * p->unit[i]);
  for (int i = 0; i < p->n; i++) {
    double own = p->w[i * p->n + i] * p->unit[i];
    if (own * p->unit[i] > FREE * most) found = fmax(found, fabs(b[i]) / own);
  }
  for (int i = 0; i < p->n_items; i++) { /* readings bound friction too */
    const frot_motion_item *item = &p->items[i];
    int count = item->kind != FROT_ITEM_LAW || item->bound == FROT_BOUND_VALUE ? 0
                : item->bound == FROT_BOUND_LENGTH                             ? 2
                                                                               : 1;
    for (int c = 0; c < count; c++)
      if (item->reads[c] >= p->n)
        found = fmax(found, item->mu_s * fabs(b[item->reads[c]]) / p->unit[item->row]);
  }
  return found;
}

static double scale_of(const frot_searcher *s, int k) {
  const frot_motion_problem *p = s->p;
  double scale = typical(p, s->b + k * p->places);
  if (k == 0) return s->force > 0 ? s->force : 1;
  for (int i = 0; i < p->n_items; i++)
    if (p->items[i].kind == FROT_ITEM_LAW && p->items[i].bound == FROT_BOUND_VALUE)
      scale =
          fmax(scale, fabs(s->coefficient[2 * (k * p->n_items + i)]) / p->unit[p->items[i].row]);
  scale = fmax(scale, s->force * pow(p->rate, k));
  return scale > 0 ? scale : 1;
}

static int binomial(int k, int j) {
  static const int rows[FROT_ORDERS][FROT_ORDERS] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}};
  return rows[k][j];
}

/* The derivative of order k of what bounds a law, over its coefficient, after that order's x. */
static double bound_at(const frot_searcher *s, const frot_item_state *state, int i, int k) {
  const frot_motion_problem *p = s->p;
  const frot_motion_item *item = &p->items[i];
  if (item->bound == FROT_BOUND_LENGTH) return s->length[k * p->n_items + i];
  double value = frot_bound_value(p, item, s->b + k * p->places, s->x + k * p->n, NULL);
  return item->bound == FROT_BOUND_SIDED ? state->side * value : value;
}

/* The derivative of order k of |R| but for its linear part d.R_k. */
static double curved(const frot_searcher *s, int i, int k) {
  const frot_motion_problem *p = s->p;
  const frot_motion_item *item = &p->items[i];
  double r[FROT_ORDERS][2], length = s->length[i];
  if (k < 2 || !(length > 0)) return 0;
  for (int j = 0; j < k; j++)
    for (int c = 0; c < 2; c++) {
      int place = item->reads[c];
      const double *x = s->x + j * p->n;
      r[j][c] = place < p->n ? x[place]
                             : s->b[j * p->places + place] + frot_dot(p->w + place * p->n, x, p->n);
    }
  double first = s->length[p->n_items + i];
  if (k == 2) return (r[1][0] * r[1][0] + r[1][1] * r[1][1] - first * first) / length;
  double second = s->length[2 * p->n_items + i];
  return 3 * (r[1][0] * r[2][0] + r[1][1] * r[2][1] - first * second) / length;
}

/* What lower orders and values give of the bounds at order k, into s->known. */
static void find_known(frot_searcher *s, const frot_item_state *states, int k) {
  const frot_motion_problem *p = s->p;
  for (int i = 0; i < p->n_items; i++)
    for (int c = 0; c < 2; c++) {
      double *known = &s->known[2 * i + c];
      *known = 0;
      if (p->items[i].kind != FROT_ITEM_LAW) continue;
      if (p->items[i].bound == FROT_BOUND_VALUE) {
        *known = s->coefficient[2 * (k * p->n_items + i) + c];
        continue;
      }
      double mu = c == 0 ? p->items[i].mu : p->items[i].mu_s;
      if (p->items[i].bound == FROT_BOUND_LENGTH) *known = mu * curved(s, i, k);
      for (int j = 1; j <= k; j++)
        *known += binomial(k, j) * s->coefficient[2 * (j * p->n_items + i) + c] *
                  bound_at(s, &states[i], i, k - j);
    }
}

/* The lengths of reactions of two components at order k, after its x. */
static void find_lengths(frot_searcher *s, int k) {
  const frot_motion_problem *p = s->p;
  for (int i = 0; i < p->n_items; i++) {
    if (p->items[i].kind != FROT_ITEM_LAW || p->items[i].bound != FROT_BOUND_LENGTH) continue;
    double part = frot_bound_value(p, &p->items[i], s->b + k * p->places, s->x + k * p->n,
                                   s->direction + 2 * i);
    s->length[k * p->n_items + i] = part + curved(s, i, k);
  }
}

/* Note which inequalities are zero at the point. Returns whether any is. */
static int note_zeros(frot_searcher *s, const double *x, double scale) {
  const frot_mode_rows *r = &s->rows;
  int n = s->p->n, any = 0;
  for (int i = 0; i < r->p.inequalities; i++) {
    double value = frot_dot(r->g_rows + i * n, x, n) - r->g[i];
    double size = r->own_size[i] + fabs(r->g[i]);
    for (int j = 0; j < n; j++)
      size += fabs(r->g_rows[i * n + j]) * (fabs(x[j]) + s->p->unit[j] * scale);
    s->zero[i] = fabs(value) <= frot_apart(s->p) * FROT_MISSED * size;
    any |= s->zero[i];
  }
  return any;
}

/* Where inequalities are zero at every point the set is flat: the point again with these as
 * equations. */
static void flatten(frot_searcher *s, double *x) {
  frot_mode_rows *r = &s->rows;
  int n = s->p->n, at = 0, redundant;
  size_t row = sizeof(double) * (size_t)n;
  for (int i = 0; i < r->p.inequalities; i++) {
    if (s->zero[i]) {
      memcpy(r->a + r->p.equations * n, r->g_rows + i * n, row);
      r->b[r->p.equations++] = r->g[i];
      continue;
    }
    memmove(r->g_rows + at * n, r->g_rows + i * n, row);
    r->g[at] = r->g[i], r->slack[at] = r->slack[i], at++;
  }
  r->p.inequalities = at;
  double *found = s->turned; /* n */
  if (!frot_polyhedron_point(&r->p, found, &redundant, s->doubles, s->integers))
    memcpy(x, found, row);
}

/* Whether reactions that the equations of s->rows leave free move anything. */
static int moves_anything(frot_searcher *s) {
  const frot_motion_problem *p = s->p;
  double *basis = s->turned + p->n, largest = 0, moved = 0;
  int count = frot_free_directions(&s->rows.p, basis, s->doubles);
  for (int i = 0; i < p->n; i++)
    largest = fmax(largest, sqrt(fabs(p->w[i * p->n + i])) * p->unit[i]);
  for (int k = 0; k < count; k++) {
    const double *z = basis + k * p->n;
    double square = 0;
    for (int j = 0; j < p->width; j++) {
      double sum = 0;
      for (int i = 0; i < p->n; i++) sum += z[i] * p->rows[i * p->width + j];
      square += sum * sum;
    }
    for (int i = 0; i < p->n && p->width == 0; i++)
      square += fabs(z[i] * frot_dot(p->w + i * p->n, z, p->n));
    moved = fmax(moved, sqrt(square));
  }
  return moved > (p->width > 0 ? MOVES_NOTHING : sqrt(MOVES_NOTHING)) * largest;
}

/* Of a family the reactions that friction follows are least. What the weights leave of
 * the equations is taken away without them. */
static void take_least_bounds(frot_searcher *s, const frot_item_state *states, double *x) {
  frot_mode_rows *r = &s->rows;
  int n = s->p->n, redundant;
  frot_weigh_followers(s->p, states, r);
  if (frot_polyhedron_point(&r->p, s->turned, &redundant, s->doubles, s->integers)) return;
  memcpy(x, s->turned, sizeof(double) * (size_t)n);
  memcpy(r->unit, s->p->unit, sizeof(double) * (size_t)n);
  r->p.inequalities = 0;
  for (int i = 0; i < r->p.equations; i++) r->b[i] -= frot_dot(r->a + i * n, x, n);
  if (frot_polyhedron_point(&r->p, s->turned, &redundant, s->doubles, s->integers)) return;
  for (int j = 0; j < n; j++) x[j] += s->turned[j];
}

/* Where contacts slide: those of equal springs, if they are admissible. Returns whether they are.
 */
static int take_springs(frot_searcher *s, const frot_item_state *states, int k, double *x) {
  int found = (k == 0 || s->family == FROT_FAMILY_OF_SPRINGS) && frot_sliding_springs(s, states, x);
  if (k == 0 && found) s->family = FROT_FAMILY_OF_SPRINGS;
  return found;
}

/* Whether the row of an item rests at order k, though its reaction follows another law. */
static int rests_until_later(const frot_item_state *state, int k) {
  int begins = state->mode == FROT_ITEM_FORWARD || state->mode == FROT_ITEM_BACKWARD ||
               state->mode == FROT_ITEM_OPEN;
  return begins && state->since > k;
}

/* What begins at a later order rests exactly at order k: the equations of its reaction leave an
 * acceleration of rounding, which stiff loads multiply in the next order. */
static void rest_exactly(frot_searcher *s, const frot_item_state *states, int k, double *x) {
  const frot_motion_problem *p = s->p;
  frot_mode_rows *r = &s->rows;
  int n = p->n, any = 0, redundant;
  for (int i = 0; i < p->n_items; i++)
    any |= !p->items[i].moving && rests_until_later(&states[i], k);
  if (!any) return;
  r->p.equations = r->p.inequalities = 0;
  memcpy(r->unit, p->unit, sizeof(double) * (size_t)n);
  for (int i = 0; i < p->n_permanent + p->n_items; i++) {
    int at = i - p->n_permanent, row = at < 0 ? p->permanent[i] : p->items[at].row;
    int contact = at < 0 ? -1 : p->items[at].contact;
    if (contact >= 0 && states[contact].mode == FROT_ITEM_OPEN) continue;
    if (at >= 0 && p->items[at].moving) continue;
    if (at >= 0 && states[at].mode != FROT_ITEM_HELD && !rests_until_later(&states[at], k))
      continue;
    const double *effects = p->w + row * n;
    memcpy(r->a + r->p.equations * n, effects, sizeof(double) * (size_t)n);
    r->b[r->p.equations++] = -(s->b[k * p->places + row] + frot_dot(effects, x, n));
  }
  if (frot_polyhedron_point(&r->p, s->turned, &redundant, s->doubles, s->integers)) return;
  for (int j = 0; j < n; j++) x[j] += s->turned[j];
}

int frot_find_orders(frot_searcher *s, const frot_item_state *states, frot_look look) {
  const frot_motion_problem *p = s->p;
  frot_mode_rows *r = &s->rows;
  s->family = s->far = 0;
  for (int k = 0; k <= look.top; k++) {
    double *x = s->x + k * p->n, *b = s->b + k * p->places, *size = s->size + k * p->places;
    if (k > 0 && p->right_side(p->context, k, s->x, b, size, s->coefficient + 2 * k * p->n_items))
      return k;
    find_known(s, states, k);
    frot_order order = {k, b, size, scale_of(s, k), s->known, k > 0 ? s->held : NULL};
    frot_reading reading = {s->kinetic, look.directed ? s->direction : NULL, s->strict,
                            look.doubtful && k == look.top, look.sectors};
    frot_list_inequalities(p, states, &order, &reading, r);
    int redundant;
    int why = frot_polyhedron_point(&r->p, x, &redundant, s->doubles, s->integers);
    s->far = why == FROT_NO_POINT_NEAR;
    if (why) return k;
    if (k == 0) s->redundant = redundant;
    int equations = r->p.equations;
    memset(s->held, 0, (size_t)p->n_items);
    if (note_zeros(s, x, order.scale)) {
      frot_implicit_equalities(&r->p, x, s->zero, s->doubles, s->integers);
      int any = 0;
      for (int i = 0; i < r->p.inequalities; i++) {
        if (!s->zero[i]) continue;
        any = 1;
        if (r->tag[i] & FROT_TAG_SECTOR) continue;
        /* what begins by rounding is zero: the next order decides whether it does */
        if (!(r->tag[i] & FROT_TAG_BEGINS) || s->strict == 0) s->held[r->item[i]] |= r->tag[i];
      }
      if (any) flatten(s, x);
    }
    int flat = r->p.equations;
    r->p.equations = equations;
    if (k == 0) s->family = moves_anything(s);
    r->p.equations = flat;
    if (s->family && !take_springs(s, states, k, x)) take_least_bounds(s, states, x);
    if (k < look.top) rest_exactly(s, states, k, x);
    if (look.directed) find_lengths(s, k);
  }
  return -1;
}

int frot_anything_moves(const frot_searcher *s, int top) {
  const frot_motion_problem *p = s->p;
  if (p->moves) return 1;
  for (int i = 0; i < p->n; i++)
    for (int k = 0; k <= top; k++) {
      const double *x = s->x + k * p->n;
      double a = s->b[k * p->places + i] + frot_dot(p->w + i * p->n, x, p->n);
      if (fabs(a) > RESTS * s->size[i]) return 1;
    }
  double square = 0, loads = 0;
  for (int j = 0; j < p->width; j++) {
    double sum = p->force[j];
    for (int i = 0; i < p->n; i++) sum += s->x[i] * p->rows[i * p->width + j];
    square += sum * sum, loads += p->force[j] * p->force[j];
  }
  return square > RESTS * RESTS * loads;
}

double frot_usual_force(const frot_searcher *s) {
  const frot_motion_problem *p = s->p;
  double force = typical(p, s->b);
  for (int i = 0; i < p->n_items; i++)
    if (p->items[i].kind == FROT_ITEM_LAW && p->items[i].bound == FROT_BOUND_VALUE)
      force = fmax(force, p->items[i].mu_s / p->unit[p->items[i].row]);
  return force;
}
