/* Order k: A z_k = h_k + E lam_k, accelerations J z_k + c_k, with the matrices of order 0. h_k and
 * c_k are what the function `orders` gives from the lower orders. */
#include "motions/taylor.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "inertia/mass_matrix.h"
#include "motions/permanent_rows.h"
#include "numerics/dense.h"

static int nw_of(const frot_taylor *t) { return t->of->at->w->layout.nw; }

/* Part of a row of a general group in the motion z: auxiliary unknowns do not move. */
static double motion_of(const frot_group *g, const double *row, const double *z) {
  int after = g->n_speeds + g->n_auxiliary;
  return frot_dot(row, z, g->n_speeds) + frot_dot(row + after, z + after, g->n - after);
}

void frot_taylor_motion(frot_taylor *t, int j, const double *x, const double *b) {
  const frot_contact_instant *one = t->of;
  const frot_model *m = one->at->m;
  frot_work *w = one->at->w;
  const frot_motion_problem *p = &one->problem;
  double *lam = t->lam + j * m->n_rows;
  memset(lam, 0, sizeof(double) * (size_t)m->n_rows);
  for (int i = 0; i < p->places; i++)
    lam[one->row_at[i]] = i < p->n ? x[i] : b[i] + frot_dot(p->w + i * p->n, x, p->n);
  double *own_force = w->core.force, *own_lam = w->core.lam;
  w->core.lam = lam;
  if (j > 0) w->core.force = t->force + j * nw_of(t);
  frot_accelerations(m, w, t->nothing);
  w->core.force = own_force, w->core.lam = own_lam;
  memcpy(t->z + j * nw_of(t), w->core.a, sizeof(double) * (size_t)nw_of(t));
}

/* Call the function `orders` with the derivatives that are known. */
static void call_orders(frot_taylor *t) {
  frot_place_of_motion at = *t->of->at;
  const frot_model *m = at.m;
  frot_work *w = at.w;
  int nw = nw_of(t), all = nw + m->n_rows + 2 * m->n_elements;
  w->call.arg[0] = &at.t, w->call.arg[1] = at.q, w->call.arg[2] = at.v;
  w->call.arg[3] = at.s->data + w->layout.u, w->call.arg[4] = at.s->data + w->layout.p;
  w->call.arg[5] = at.d, w->call.arg[6] = w->blocks.y;
  for (int j = 0; j < FROT_HIGHEST_ORDER; j++) {
    w->call.arg[7 + 2 * j] = t->z + j * nw, w->call.arg[8 + 2 * j] = t->lam + j * m->n_rows;
    w->call.res[j] = t->given + j * all;
  }
  frot_call(w, &m->orders);
}

/* force <- what loads h do to the speeds of a group, in its metric (A^-1 h where it is general). */
static void spread_load(const frot_taylor *t, const frot_group *g, const double *h, double *force) {
  frot_work *w = t->of->at->w;
  int count = g->general ? g->n : g->n_speeds;
  for (int k = 0; k < count; k++) force[k] = h[g->unknowns[k]];
  if (!g->general)
    frot_inwards(w, g, force);
  else
    frot_lu_apply(w->core.lu + g->matrix, g->n, w->core.lu_pivot + g->vector,
                  w->core.lu_scale + 2 * g->vector, force);
}

/* b and size at a place of order k, of loads h and biases c. */
static double free_value(const frot_taylor *t, int place, const double *h, const double *c,
                         const double *force, double *size) {
  const frot_contact_instant *one = t->of;
  const frot_model *m = one->at->m;
  frot_work *w = one->at->w;
  int row = one->row_at[place], reads = m->row_reads[row];
  const frot_group *g = frot_group_of(m, row);
  const double *f = force + g->vector, *half = frot_entries(m, w->core.half, row);
  if (g->general) {
    double value = reads >= 0 ? f[reads] : motion_of(g, frot_entries(m, w->core.rows, row), f);
    double known = reads >= 0 ? 0 : c[row];
    const double *entries = frot_entries(m, w->core.rows, row);
    *size = fabs(known) + (reads >= 0 ? fabs(value) : 0);
    for (int k = 0; k < g->n && reads < 0; k++) *size += fabs(entries[k] * f[k]);
    return value + known;
  }
  double known = reads >= 0 ? -h[g->unknowns[reads]] : c[row];
  *size = fabs(known) + frot_length(half, g->n_speeds) * frot_length(f, g->n_speeds);
  return frot_dot(f, half, g->n_speeds) + known;
}

/* The values of the rows with unknowns by turned rows: of loads `force` (nw) and biases c. */
static void turn_values(const frot_taylor *t, const double *c, const double *force, double *b,
                        double *size) {
  const frot_contact_instant *one = t->of;
  const frot_model *m = one->at->m;
  const frot_motion_problem *p = &one->problem;
  double *own = one->bias + p->n, length = 0;
  if (p->width == 0) return;
  for (int i = 0; i < p->n; i++) own[i] = c[one->row_at[i]];
  frot_turn_biases(one, own, one->bias, one->bias_size);
  for (int k = one->first; k < one->end; k++) {
    const double *f = force + m->groups[k].vector;
    length = hypot(length, frot_length(f, m->groups[k].n_speeds));
  }
  for (int i = 0; i < p->n; i++) {
    const double *row = one->turned + i * p->width;
    double sum = 0;
    for (int k = one->first, from = 0; k < one->end; k++) {
      int count = m->groups[k].n_speeds;
      sum += frot_dot(row + from, force + m->groups[k].vector, count), from += count;
    }
    b[i] = one->taken[i] || frot_length(row, p->width) > 0 ? sum + one->bias[i] : one->bias[i];
    /* loads may cancel before they are spread */
    double before = frot_length(one->rows + i * p->width, p->width), loads = length;
    if (c == one->at->w->core.c && before > 0)
      loads = fmax(loads, one->at->w->core.row_load[one->row_at[i]] / before);
    size[i] = frot_length(row, p->width) * loads + one->bias_size[i];
  }
}

int frot_taylor_right_side(void *context, int k, const double *x, double *b, double *size,
                           double *coefficient) {
  frot_taylor *t = context;
  const frot_contact_instant *one = t->of;
  const frot_model *m = one->at->m;
  frot_work *w = one->at->w;
  const frot_motion_problem *p = &one->problem;
  int nw = nw_of(t);
  if (k == 0) {
    for (int i = 0; i < p->places; i++) {
      int row = one->row_at[i];
      b[i] = w->core.free[row];
      size[i] = w->core.row_load[row] + fabs(b[i]);
      if (!frot_is_reading(m, row)) size[i] += fabs(w->core.c[row]);
    }
    turn_values(t, w->core.c, w->core.force, b, size);
    for (int i = 0; i < p->n_items; i++)
      for (int c = 0; c < 2 && one->element_of[i] >= 0; c++)
        coefficient[2 * i + c] = w->core.coefficient[2 * one->element_of[i] + c];
    return 0;
  }
  /* right sides of lower orders stand before b */
  frot_taylor_motion(t, k - 1, x + (k - 1) * p->n, b - p->places);
  for (int j = k; j < FROT_HIGHEST_ORDER; j++) {
    memset(t->z + j * nw, 0, sizeof(double) * (size_t)nw);
    memset(t->lam + j * m->n_rows, 0, sizeof(double) * (size_t)m->n_rows);
  }
  call_orders(t);
  double *given = t->given + (k - 1) * (nw + m->n_rows + 2 * m->n_elements), *h = given;
  const double *c = given + nw, *coefficients = c + m->n_rows;
  double *force = t->force + k * nw;
  for (int i = 0; i < nw; i++) h[i] = -h[i];
  for (int g = one->first; g < one->end; g++)
    spread_load(t, &m->groups[g], h, force + m->groups[g].vector);
  int finite = 1;
  for (int i = 0; i < p->places; i++) {
    b[i] = free_value(t, i, h, c, force, &size[i]);
    finite &= isfinite(b[i]);
  }
  turn_values(t, c, force, b, size);
  for (int i = 0; i < p->n_items; i++)
    for (int j = 0; j < 2 && one->element_of[i] >= 0; j++)
      coefficient[2 * i + j] = coefficients[2 * one->element_of[i] + j];
  return !finite;
}
