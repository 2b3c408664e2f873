#include "conditions.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "blocks.h"
#include "core.h"
#include "mechanics.h"
#include "tolerances.h"

/* Conditions that depend on each other are changed all at once as many times as their chain can be
 * long, then the first that is wrong alone (least index: K. Murty, Linear Complementarity, 1988,
 * ch. 4, which ends where they are those of ideal switches). */
#define ALL_AT_ONCE 3
#define ONE_BY_ONE 20
#define CROSSINGS 8 /* doublings of a rounding of time */

static int holds(const frot_model *m, const frot_work *w, int j) {
  return m->condition_strict[j] ? w->core.condition[j] > 0 : w->core.condition[j] >= 0;
}

int frot_look(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
              const double *v) {
  const frot_layout *l = &w->layout;
  const double *d = s->data + l->d;
  int status = frot_kinematics(m, s, w, t, q, v, d);
  if (status != FROT_OK || m->n_sensed == 0) return status;
  const frot_contact_mode *modes = (const void *)(s->data + l->modes);
  return frot_solution(m, s, w, t, q, v, d, modes, s->data + l->frozen, s->data + l->along, 1);
}

int frot_note_conditions(const frot_model *m, frot_state *s, frot_work *w, double t,
                         const double *q, const double *v) {
  if (m->n_conditions == 0) return FROT_OK;
  int status = frot_look(m, s, w, t, q, v);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  memcpy(w->events.known, w->core.condition, sizeof(double) * (size_t)m->n_conditions);
  return FROT_OK;
}

/* Whether a located condition that fires is still on the side on which it was. */
static int is_short(const frot_model *m, const frot_state *s, const frot_work *w) {
  const double *d = s->data + w->layout.d;
  const double *fired = s->data + w->layout.fired + frot_condition_guard(m);
  for (int j = 0; j < m->n_located; j++)
    if (fired[j] != 0 && holds(m, w, j) == (d[j] != 0)) return 1;
  return 0;
}

int frot_cross(const frot_model *m, frot_state *s, frot_work *w, double *t, double *q, double *v) {
  const frot_layout *l = &w->layout;
  const double *slope = s->data + l->slope;
  const double *fired = s->data + l->fired + frot_condition_guard(m);
  int located = 0, timed = 0;
  for (int j = 0; j < m->n_located + m->n_timed; j++) {
    located |= j < m->n_located && fired[j] != 0;
    timed |= j >= m->n_located && fired[j] != 0;
  }
  if (!located) return FROT_OK;
  int status = frot_look(m, s, w, *t, q, v);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, *t);
  double moved = 0, step = DBL_EPSILON * fmax(fabs(*t), 1e-3 * s->h_max);
  double *there = w->step.z;
  for (int k = 0; is_short(m, s, w); k++, step *= 2) {
    if (k == CROSSINGS) return FROT_OK; /* one that has no rate does not cross */
    moved += step;
    for (int j = 0; j < m->nq; j++) there[j] = q[j] + moved * slope[j];
    for (int j = 0; j < m->nv; j++) there[m->nq + j] = v[j] + moved * slope[m->nq + j];
    /* an instant known before stays what it is */
    double then = timed ? *t : *t + moved;
    if (frot_look(m, s, w, then, there, there + m->nq) != FROT_OK) return FROT_OK;
  }
  if (moved == 0) return FROT_OK;
  memcpy(q, there, sizeof(double) * (size_t)m->nq);
  memcpy(v, there + m->nq, sizeof(double) * (size_t)m->nv);
  if (!timed) *t += moved;
  return FROT_OK;
}

/* Whether the value of condition j is the one its flag was decided with. */
static int is_known(const frot_model *m, const frot_state *s, const frot_work *w, int j) {
  double value = w->core.condition[j], known = w->events.known[j];
  if (j >= m->n_located) return value == known;
  double size = s->data[w->layout.scale_g + frot_condition_guard(m) + j];
  double rounding = FROT_UNCHANGED * size + 4 * DBL_EPSILON * fmax(fabs(value), fabs(known));
  return fabs(value - known) <= rounding;
}

/* Decide the conditions from their values, the first that changes alone if `alone`. Returns the
 * last one changed, -1 if none. */
static int decide(const frot_model *m, const frot_state *s, frot_work *w, double *d, int alone) {
  int changed = -1;
  for (int j = 0; j < m->n_conditions; j++) {
    if (is_known(m, s, w, j)) continue;
    int now = holds(m, w, j);
    if (now != (d[j] != 0)) {
      if (alone && changed >= 0) continue;
      d[j] = now;
      changed = j;
    }
    w->events.known[j] = w->core.condition[j];
  }
  return changed;
}

int frot_settle_conditions(const frot_model *m, frot_state *s, frot_work *w, double t,
                           const double *q, const double *v) {
  double *d = s->data + w->layout.d;
  int together = m->n_conditions + ALL_AT_ONCE, most = together + ONE_BY_ONE * (together + 1);
  int changed = -1, other = -1;
  for (int pass = 0; pass < most; pass++) {
    int status = frot_look(m, s, w, t, q, v);
    if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
    int last = decide(m, s, w, d, pass >= together);
    if (last < 0) return FROT_OK;
    if (last != changed) other = changed, changed = last;
  }
  return frot_fail(s, FROT_CHATTER, t, -1, changed, other, FROT_NO_TRUTH);
}

void frot_find_due(const frot_model *m, frot_state *s, frot_work *w) {
  s->due = INFINITY;
  if (m->n_timed == 0) return;
  const double *d = s->data + w->layout.d;
  double *due = s->data + w->layout.due, *slope = w->events.timer,
         *at_zero = w->events.timer + m->n_timed;
  w->call.arg[0] = s->data + w->layout.u, w->call.arg[1] = s->data + w->layout.p,
  w->call.arg[2] = d;
  w->call.res[0] = slope, w->call.res[1] = at_zero;
  frot_call(w, &m->timers);
  for (int j = 0; j < m->n_timed; j++) {
    int falls = d[m->n_located + j] != 0 ? slope[j] < 0 : slope[j] > 0;
    due[j] = falls ? -at_zero[j] / slope[j] : INFINITY;
    if (isnan(due[j])) due[j] = INFINITY;
    s->due = fmin(s->due, due[j]);
  }
  double last = s->due;
  for (int j = 0; j < m->n_timed; j++)
    if (due[j] > last && due[j] <= s->due + FROT_SAME_INSTANT(s->due)) last = due[j];
  s->due = last;
}

void frot_fire_due(const frot_model *m, frot_state *s) {
  frot_layout l = frot_layout_of(m);
  const double *due = s->data + l.due;
  double *fired = s->data + l.fired + frot_condition_guard(m) + m->n_located;
  for (int j = 0; j < m->n_timed; j++)
    if (due[j] <= s->due) fired[j] = 1;
  s->pending = 1;
}
