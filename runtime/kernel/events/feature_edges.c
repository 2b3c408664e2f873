#include "events/feature_edges.h"

#include <math.h>
#include <string.h>

#include "evaluation/fault_source.h"
#include "evaluation/algebraic_loops.h"
#include "guards/conditions.h"
#include "evaluation/evaluate.h"
#include "model/indexing.h"
#include "methods/right_hand_side.h"
#include "impacts/separation.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

/* Passes of Newton's method to the instant at which an end is passed. */
#define PASSES 2

int frot_has_edges(const frot_model *m) {
  for (int j = 0; j < m->n_conditions; j++)
    if (m->conditions[j].contact >= 0) return 1;
  return 0;
}

void frot_note_normals(const frot_model *m, frot_work *w) {
  memcpy(w->events.normals, w->core.rows, sizeof(double) * (size_t)m->n_entries);
}

/* Whether the normal of a contact has turned about since it was noted. */
static int turned_about(const frot_model *m, const frot_work *w, int row) {
  const double *now = frot_entries(m, w->core.rows, row),
               *before = frot_entries(m, w->events.normals, row);
  double product = 0;
  for (int k = 0; k < frot_group_of(m, row)->n; k++) product += now[k] * before[k];
  return product < 0;
}

/* Mark the contacts whose place has passed an end. */
static int mark(const frot_model *m, const frot_state *s, frot_work *w) {
  const double *d = s->data + w->layout.d;
  int any = 0;
  memset(w->nearer.changed, 0, (size_t)m->n_contacts);
  for (int j = 0; j < m->n_conditions; j++) {
    int i = m->conditions[j].contact;
    if (i < 0 || d[j] == w->events.before[j]) continue;
    w->nearer.changed[i] = 1, any = 1;
  }
  return any;
}

/* The gap of contact i below which it touches. */
static double how_near(const frot_model *m, const frot_work *w, int row, int i, const double *q) {
  return FROT_TOUCH * (fabs(w->core.gap[i]) + frot_gap_size(m, w, row, q));
}

int frot_pass_edges(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, frot_recorder *recorder) {
  const frot_layout *l = &w->layout;
  double *side = s->data + l->d + m->n_conditions;
  frot_contact_mode *modes = (void *)(s->data + l->modes);
  int changes = 0;
  if (!mark(m, s, w)) return FROT_OK;
  for (int i = 0; i < m->n_contacts; i++) {
    if (!w->nearer.changed[i]) continue;
    int row = m->contacts[i].row_n;
    double near = how_near(m, w, row, i, q), gap = w->core.gap[i];
    int turned = gap <= near && turned_about(m, w, row);
    if (modes[i].closed ? turned : gap < -near) side[i] = -side[i], changes = 1;
  }
  int status = changes ? frot_kinematics(m, s, w, t, q, v, s->data + l->d) : FROT_OK;
  for (int i = 0; i < m->n_contacts && status == FROT_OK; i++) {
    int row = m->contacts[i].row_n;
    if (!w->nearer.changed[i] || s->data[l->unilateral + i] == 0) continue;
    double near = how_near(m, w, row, i, q);
    int apart = w->core.gap[i] > near, met = w->core.gap[i] < 0 && w->core.gap[i] >= -near;
    if (!modes[i].closed && apart) s->data[l->fired + i] = 0;
    if (!modes[i].closed && (met || frot_is_flush(m, s, w, i, q))) s->data[l->fired + i] = 1;
    if (!modes[i].closed) continue;
    if (!apart && !(w->core.rate[row] > FROT_TOUCH * frot_row_speed(m, w, row, v))) continue;
    frot_part_contact(m, s, t, i, recorder);
    s->data[l->fired + i] = 0; /* its reaction may have vanished too */
  }
  return status == FROT_OK ? status : frot_fail_evaluation(m, s, w, status, t);
}

/* Whether condition j is that of an end of an open contact that meets something now. */
static int may_pass(const frot_model *m, const frot_state *s, const frot_work *w, int j) {
  const frot_layout *l = &w->layout;
  const frot_contact_mode *modes = (const void *)(s->data + l->modes);
  int i = m->conditions[j].contact;
  return i >= 0 && !modes[i].closed && s->data[l->fired + i] != 0;
}

/* Whether the gap of the contact of condition j, which is zero to rounding, is so after `wait` too.
 */
static int stays_flush(const frot_model *m, const frot_state *s, const frot_work *w, int j,
                       const double *q, double wait) {
  int i = m->conditions[j].contact, row = m->contacts[i].row_n;
  double size = frot_size_of_gap(m, s, w, i, q);
  return fabs(w->core.rate[row]) * wait <= FROT_FLUSH * size;
}

/* The conditions after a short time, along the slope at the instant. */
static int look_ahead(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                      const double *v, double wait) {
  const double *slope = s->data + w->layout.slope;
  double *there = w->step.z;
  for (int k = 0; k < m->nq; k++) there[k] = q[k] + wait * slope[k];
  for (int k = 0; k < m->nv; k++) there[m->nq + k] = v[k] + wait * slope[m->nq + k];
  return frot_evaluate_conditions(m, s, w, t + wait, there, there + m->nq);
}

int frot_fire_ends(const frot_model *m, frot_state *s, frot_work *w, double *t, double *q,
                   double *v) {
  const double *slope = s->data + w->layout.slope, *value = w->core.condition;
  double *fired = s->data + w->layout.fired + frot_condition_guard(m), *now = w->events.was,
         size = frot_size_of_time(*t, s->h_max), far = FROT_APART * size;
  int any = 0;
  for (int j = 0; j < m->n_located; j++) any |= may_pass(m, s, w, j);
  if (!any) return FROT_OK;
  int status = frot_evaluate_conditions(m, s, w, *t, q, v);
  memcpy(now, value, sizeof(double) * (size_t)m->n_conditions);
  if (status == FROT_OK) status = look_ahead(m, s, w, *t, q, v, far);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, *t);
  double later = 0, last_rate = 0;
  int last = -1;
  for (int j = 0; j < m->n_located; j++) {
    double way = s->data[w->layout.d + j] == 0 ? 1 : -1; /* beyond the end, or back from there */
    double rate = way * (value[j] - now[j]) / far, left = -way * now[j];
    if (!may_pass(m, s, w, j) || !(rate > 0)) continue;
    if (left > FROT_LOCATED * size * rate && !stays_flush(m, s, w, j, q, left / rate)) continue;
    fired[j] = 1;
    if (left / rate > later) later = left / rate, last = j, last_rate = way * rate;
  }
  for (int k = 0; k < PASSES && last >= 0; k++) { /* by Newton's method */
    status = look_ahead(m, s, w, *t, q, v, later);
    if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, *t);
    later = fmax(later - value[last] / last_rate, 0);
  }
  *t += later;
  for (int k = 0; k < m->nq; k++) q[k] += later * slope[k];
  for (int k = 0; k < m->nv; k++) v[k] += later * slope[m->nq + k];
  return FROT_OK;
}
