#include "events/feature_edges.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "evaluation/fault_source.h"
#include "evaluation/algebraic_loops.h"
#include "guards/conditions.h"
#include "evaluation/evaluate.h"
#include "model/indexing.h"
#include "methods/right_hand_side.h"
#include "recording/event_log.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

/* Part of the lengths of a gap that is none. */
#define FLUSH (64 * DBL_EPSILON)

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

/* Whether an open contact has come onto what it is flush with: no gap falls to zero any more. */
static int is_flush(const frot_model *m, const frot_state *s, const frot_work *w, int i,
                    const double *q) {
  double size = frot_gap_size(m, w, m->contacts[i].row_n, q) + s->data[w->layout.reach + i];
  return fabs(w->core.gap[i]) <= FLUSH * size;
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
    double near = FROT_TOUCH * (fabs(w->core.gap[i]) + frot_gap_size(m, w, row, q));
    int inside = w->core.gap[i] < -near;
    if (modes[i].closed ? turned_about(m, w, row) : inside) side[i] = -side[i], changes = 1;
  }
  int status = changes ? frot_kinematics(m, s, w, t, q, v, s->data + l->d) : FROT_OK;
  for (int i = 0; i < m->n_contacts && status == FROT_OK; i++) {
    int row = m->contacts[i].row_n;
    if (!w->nearer.changed[i] || s->data[l->unilateral + i] == 0) continue;
    if (!modes[i].closed && is_flush(m, s, w, i, q)) s->data[l->fired + i] = 1;
    if (!modes[i].closed) continue;
    if (!(w->core.rate[row] > FROT_TOUCH * frot_row_speed(m, w, row, v))) continue;
    frot_record_event(recorder, s, t, FROT_EVENT_SEPARATION, i, frot_mode_value(m, modes, i),
                      FROT_MODE_OPEN, 1);
    frot_open(m, modes, i);
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

int frot_fire_ends(const frot_model *m, frot_state *s, frot_work *w, double *t, double *q,
                   double *v) {
  const double *slope = s->data + w->layout.slope, *value = w->core.condition;
  double *fired = s->data + w->layout.fired + frot_condition_guard(m), *now = w->events.was,
         *there = w->step.z, size = frot_size_of_time(*t, s->h_max), far = FROT_APART * size;
  int any = 0;
  for (int j = 0; j < m->n_located; j++) any |= may_pass(m, s, w, j);
  if (!any) return FROT_OK;
  int status = frot_evaluate_conditions(m, s, w, *t, q, v);
  memcpy(now, value, sizeof(double) * (size_t)m->n_conditions);
  for (int k = 0; k < m->nq; k++) there[k] = q[k] + far * slope[k];
  for (int k = 0; k < m->nv; k++) there[m->nq + k] = v[k] + far * slope[m->nq + k];
  if (status == FROT_OK) status = frot_evaluate_conditions(m, s, w, *t + far, there, there + m->nq);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, *t);
  double later = 0;
  for (int j = 0; j < m->n_located; j++) {
    double way = s->data[w->layout.d + j] == 0 ? 1 : -1; /* beyond the end, or back from there */
    double rate = way * (value[j] - now[j]) / far, left = -way * now[j];
    if (!may_pass(m, s, w, j) || !(rate > 0) || !(left <= FROT_LOCATED * size * rate)) continue;
    fired[j] = 1, later = fmax(later, left / rate);
  }
  *t += later;
  for (int k = 0; k < m->nq; k++) q[k] += later * slope[k];
  for (int k = 0; k < m->nv; k++) v[k] += later * slope[m->nq + k];
  return FROT_OK;
}
