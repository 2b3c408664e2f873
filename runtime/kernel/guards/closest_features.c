#include "guards/closest_features.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "methods/dormand_prince.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

#define TAKE(field, count) FROT_TAKE(a, field, count)

#define HALVINGS 45
/* How many times what shows a place elsewhere it is to show where a step is to end by it. */
#define CLEARLY 2

/* The set of a contact's values among the unknowns of blocks and the flags. */
static const frot_block *block_of(const frot_model *m, int contact) {
  return &m->blocks[m->contacts[contact].followed];
}

/* The place of a contact in y (ny) <- that in `place`. */
static void set_place(const frot_model *m, const double *place, int contact, double *y) {
  const frot_block *block = block_of(m, contact);
  memcpy(y + block->first, place + block->first, sizeof(double) * (size_t)block->count);
}

/* The gap of a contact at the values x, with the places found from those in w->blocks.y: `anew`
 * from between the ends of its figures, and beyond these where that is found to lie, into `flags`
 * (may be NULL). NaN where there is none. */
static double gap_at(const frot_model *m, frot_state *s, frot_work *w, int contact, double t,
                     const double *x, int anew, double *flags) {
  double *d = s->data + w->layout.d, *kept = w->nearer.kept;
  memcpy(kept, d, sizeof(double) * (size_t)m->n_conditions);
  for (int j = 0; j < m->n_conditions && anew; j++)
    if (m->conditions[j].contact == contact) d[j] = 0;
  int changes = 0, status = frot_kinematics(m, s, w, t, x, x + m->nq, d);
  for (int j = 0; j < m->n_conditions && status == FROT_OK; j++) {
    if (m->conditions[j].contact != contact) continue;
    int beyond = w->core.condition[j] > 0;
    if (flags) flags[j] = beyond;
    changes |= beyond != d[j];
    d[j] = beyond;
  }
  if (changes) status = frot_kinematics(m, s, w, t, x, x + m->nq, d);
  memcpy(d, kept, sizeof(double) * (size_t)m->n_conditions);
  return status == FROT_OK ? w->core.gap[contact] : NAN;
}

void frot_values_inside(const frot_work *w, double theta, double *x) {
  int nz = w->layout.nz;
  memcpy(x, w->step.z0, sizeof(double) * (size_t)w->layout.nx);
  for (int k = 0; k < w->awake.n; k++) {
    double sum = 0;
    for (int i = DP_DENSE - 1; i >= 0; i--) {
      sum += w->step.f[i * nz + k];
      sum *= i % 2 == 0 ? theta : 1 - theta;
    }
    x[w->awake.now->states[k]] += sum;
  }
}

/* Whether a place elsewhere counts that has the gap `other`, where the followed one has `own`: of
 * an open contact it is nearer, of a closed one the figures are in each other there: by so many
 * `times` what shows it. NaN does not. */
static int counts(const frot_model *m, const frot_state *s, const frot_work *w, int contact,
                  double other, double own, double times) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  if (!modes[contact].closed) return fabs(other) < (1 - times * FROT_NEARER) * fabs(own);
  double size = frot_gap_size(m, w, m->contacts[contact].row_n, w->step.z1);
  return other < fmin(own, 0) - times * FROT_FEATURE_INSIDE * size;
}

/* Whether after the part theta of the step the place found for its end counts, `times`. */
static int is_nearer(const frot_model *m, frot_state *s, frot_work *w, int contact, double t,
                     double h, double theta, double times) {
  const double *y0 = s->data + w->layout.y;
  double *x = w->step.z, *y = w->blocks.y;
  frot_values_inside(w, theta, x);
  for (int k = 0; k < m->ny; k++) y[k] = y0[k] + theta * (w->step.y_end[k] - y0[k]);
  double own = gap_at(m, s, w, contact, t + theta * h, x, 0, NULL);
  memcpy(y, w->step.y_end, sizeof(double) * (size_t)m->ny);
  set_place(m, w->nearer.y, contact, y);
  double other = gap_at(m, s, w, contact, t + theta * h, x, 1, NULL);
  return counts(m, s, w, contact, other, own, times);
}

/* Whether another place of a contact counts, whose gap is `far` where it is followed: it is kept.
 */
static int look(const frot_model *m, frot_state *s, frot_work *w, int contact, double end,
                double far) {
  double *y = w->blocks.y;
  memcpy(y, w->step.y_end, sizeof(double) * (size_t)m->ny);
  set_place(m, w->nearer.begin, contact, y);
  double other = gap_at(m, s, w, contact, end, w->step.z1, 1, w->nearer.flags);
  if (!counts(m, s, w, contact, other, far, 1)) return 0;
  set_place(m, y, contact, w->nearer.y);
  w->nearer.changed[contact] = other < 0 ? -1 : 1;
  return 1;
}

/* Kinematics of the end, and where searches begin there. */
static int look_at_end(const frot_model *m, frot_state *s, frot_work *w, double end) {
  const double *x = w->step.z1, *d = s->data + w->layout.d;
  memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)m->ny);
  int status = frot_kinematics(m, s, w, end, x, x + m->nq, d);
  memcpy(w->nearer.far, w->core.gap, sizeof(double) * (size_t)m->n_contacts);
  memcpy(w->nearer.flags, d, sizeof(double) * (size_t)m->n_conditions);
  frot_inputs(s, w, &end, x, x + m->nq, d);
  w->call.res[0] = w->nearer.begin;
  frot_call(w, &m->beginnings);
  return status;
}

/* Of the places found for closed contacts those are none at which the figures are in each other at
 * the start of the step already: where they meet they come together. */
static void keep_met(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  for (int i = 0; i < m->n_contacts; i++)
    if (w->nearer.changed[i] && modes[i].closed && is_nearer(m, s, w, i, t, h, 0, 1))
      w->nearer.changed[i] = 0, w->nearer.count--;
}

/* The part of the step after which one of the places found counts first. */
static double first_nearer(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  double first = 1;
  for (int i = 0; i < m->n_contacts; i++) {
    double low = 0, high = first;
    if (!w->nearer.changed[i] || !is_nearer(m, s, w, i, t, h, high, CLEARLY)) continue;
    for (int k = 0; k < HALVINGS; k++) {
      double middle = 0.5 * (low + high);
      if (is_nearer(m, s, w, i, t, h, middle, CLEARLY))
        high = middle;
      else
        low = middle;
    }
    first = high;
  }
  return first > FROT_AT_FEATURE_END ? 1 : first;
}

int frot_find_closer_features(const frot_model *m, frot_state *s, frot_work *w, double t, double h,
                              double *part) {
  const double *unilateral = s->data + w->layout.unilateral, end = t + h;
  const frot_awake_lists *now = w->awake.now;
  int listed = 0, status = FROT_OK;
  w->nearer.count = 0, *part = 1;
  if (m->n_followed == 0) return FROT_OK;
  memset(w->nearer.changed, 0, (size_t)m->n_contacts);
  for (int k = 0; k < now->n_contacts; k++) {
    int i = now->contacts[k];
    if (m->contacts[i].followed < 0 || unilateral[i] == 0) continue;
    if (!listed) status = look_at_end(m, s, w, end), listed = 1;
    if (status != FROT_OK) return status;
    w->nearer.count += look(m, s, w, i, end, w->nearer.far[i]);
  }
  if (w->nearer.count) status = frot_make_dense(m, s, w, t, h);
  if (w->nearer.count && status == FROT_OK) keep_met(m, s, w, t, h);
  if (w->nearer.count && status == FROT_OK) *part = first_nearer(m, s, w, t, h);
  memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)m->ny);
  const double *x = w->step.z1;
  int back = listed ? frot_kinematics(m, s, w, end, x, x + m->nq, s->data + w->layout.d) : FROT_OK;
  return status == FROT_OK ? back : status;
}

void frot_take_closer_features(const frot_model *m, frot_state *s, frot_work *w) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  double *d = s->data + w->layout.d, *side = d + m->n_conditions;
  for (int i = 0; i < m->n_contacts && w->nearer.count > 0; i++) {
    if (!w->nearer.changed[i]) continue;
    if (modes[i].closed) {
      s->pending = 1, s->second = i;
      continue;
    }
    set_place(m, w->nearer.y, i, s->data + w->layout.y);
    if (w->nearer.changed[i] < 0) side[i] = -side[i];
    for (int j = 0; j < m->n_conditions; j++)
      if (m->conditions[j].contact == i) d[j] = w->nearer.flags[j];
  }
}

void frot_bind_nearer(const frot_model *m, frot_nearer_work *w, frot_arena *a) {
  int some = m->n_followed > 0;
  TAKE(w->begin, m->n_followed), TAKE(w->y, some * m->ny), TAKE(w->far, some * m->n_contacts);
  TAKE(w->flags, m->n_conditions), TAKE(w->kept, m->n_conditions);
  TAKE(w->changed, m->n_contacts);
}
