#include "guards/conditions.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "evaluation/fault_source.h"
#include "evaluation/algebraic_loops.h"
#include "evaluation/evaluate.h"
#include "methods/right_hand_side.h"
#include "numerics/tolerances.h"

#define TAKE(field, count) FROT_TAKE(a, field, count)

/* Conditions that depend on each other are changed all at once as many times as their chain can be
 * long, then the first that is wrong alone (least index: K. Murty, Linear Complementarity, 1988,
 * ch. 4, which ends where they are those of ideal switches). */
#define ALL_AT_ONCE 3
#define ONE_BY_ONE 20
/* Doublings of a rounding of time in which a condition crosses zero, and in which one whose values
 * before and after do not move alike is on the other side after: a diode that ceases to conduct
 * leaves its threshold a million times faster than it came to it. */
#define CROSSINGS 8
#define LONGEST 40
/* Of the move across zero, so many at most since what else fires has passed it. */
#define NEAR 64

static int holds(const frot_model *m, const frot_work *w, int j) {
  return m->condition_strict[j] ? w->core.condition[j] > 0 : w->core.condition[j] >= 0;
}

int frot_evaluate_conditions(const frot_model *m, frot_state *s, frot_work *w, double t,
                             const double *q, const double *v) {
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
  int status = frot_evaluate_conditions(m, s, w, t, q, v);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  memcpy(w->events.known, w->core.condition, sizeof(double) * (size_t)m->n_conditions);
  return FROT_OK;
}

/* The size of the values of a located condition. */
static double size_of(const frot_model *m, const frot_state *s, const frot_work *w, int j) {
  return s->data[w->layout.scale_g + frot_condition_guard(m) + j];
}

/* An instant a little later than that of an event, along the slope there. */
typedef struct {
  double t, *q, *v; /* the event's */
  double moved;     /* how much later */
  int timed;        /* an instant known before stays what it is */
} later;

static double time_of(const later *i) { return i->timed ? i->t : i->t + i->moved; }

/* Values of the conditions at it, as the flags say; into w->step.z the coordinates and speeds. */
static int look_later(const frot_model *m, frot_state *s, frot_work *w, const later *i) {
  const double *slope = s->data + w->layout.slope;
  double *there = w->step.z;
  for (int j = 0; j < m->nq; j++) there[j] = i->q[j] + i->moved * slope[j];
  for (int j = 0; j < m->nv; j++) there[m->nq + j] = i->v[j] + i->moved * slope[m->nq + j];
  return frot_evaluate_conditions(m, s, w, time_of(i), there, there + m->nq);
}

/* Change the flags of the located conditions that fire, or change them back. */
static void flip(const frot_model *m, frot_state *s, const frot_work *w) {
  double *d = s->data + w->layout.d;
  const double *fired = s->data + w->layout.fired + frot_condition_guard(m);
  for (int j = 0; j < m->n_located; j++)
    if (fired[j] != 0) d[j] = 1 - d[j];
}

typedef struct {
  int wrong; /* a flag is not what its value says */
  int right; /* a flag is */
  int zero;  /* all values are zero to rounding */
} sides;

/* How the located conditions that fire stand to their flags. */
static sides look_at_sides(const frot_model *m, const frot_state *s, const frot_work *w) {
  const double *d = s->data + w->layout.d;
  const double *fired = s->data + w->layout.fired + frot_condition_guard(m);
  sides found = {0, 0, 1};
  for (int j = 0; j < m->n_located; j++) {
    if (fired[j] == 0) continue;
    int agrees = holds(m, w, j) == (d[j] != 0);
    found.wrong |= !agrees, found.right |= agrees;
    found.zero &= fabs(w->core.condition[j]) <= FROT_UNCHANGED * size_of(m, s, w, j);
  }
  return found;
}

/* Whether what has crossed zero would, changed, be at once where it was before: 1 if so and a
 * little later it may no longer be, 0 if not, -1 if it cannot be said. */
static int is_undone(const frot_model *m, frot_state *s, frot_work *w, const later *i) {
  flip(m, s, w);
  int status = look_later(m, s, w, i);
  sides after = look_at_sides(m, s, w);
  flip(m, s, w);
  if (status != FROT_OK) return -1;
  return after.wrong && !after.zero;
}

/* What has passed zero a few roundings of time before the instant to which the event moves on, and
 * moves away from it, passes it at this event: beyond zero its equations may have no value. */
static void fire_what_passes(const frot_model *m, frot_state *s, frot_work *w, const later *i) {
  const double *d = s->data + w->layout.d, *value = w->core.condition;
  double *fired = s->data + w->layout.fired + frot_condition_guard(m), *first = w->events.was;
  later at_once = *i;
  at_once.moved = 0;
  if (look_later(m, s, w, &at_once) != FROT_OK) return;
  memcpy(first, value, sizeof(double) * (size_t)m->n_located);
  if (look_later(m, s, w, i) != FROT_OK) return;
  for (int j = 0; j < m->n_located; j++) {
    double moved = fabs(value[j] - first[j]);
    if (fired[j] == 0 && holds(m, w, j) != (d[j] != 0) && fabs(value[j]) <= NEAR * moved &&
        value[j] * (value[j] - first[j]) > 0)
      fired[j] = 1;
  }
}

int frot_pass_conditions(const frot_model *m, frot_state *s, frot_work *w, double *t, double *q,
                         double *v) {
  const double *fired = s->data + w->layout.fired + frot_condition_guard(m);
  int located = 0, timed = 0;
  for (int j = 0; j < m->n_located + m->n_timed; j++) {
    located |= j < m->n_located && fired[j] != 0;
    timed |= j >= m->n_located && fired[j] != 0;
  }
  if (!located) return FROT_OK;
  later i = {*t, q, v, 0, timed};
  double step = DBL_EPSILON * frot_size_of_time(*t, s->h_max), crossed = -1;
  for (int k = 0; k < LONGEST; k++, i.moved += step, step *= 2) {
    int status = look_later(m, s, w, &i);
    if (status != FROT_OK && k == 0) return frot_fail_evaluation(m, s, w, status, *t);
    if (status != FROT_OK) break;
    sides before = look_at_sides(m, s, w);
    if (crossed >= 0 && !before.zero) break; /* the event was before */
    if (before.right) {
      if (k == CROSSINGS && crossed < 0) break; /* one that has no rate does not cross */
      continue;
    }
    int undone = is_undone(m, s, w, &i);
    if (crossed < 0 || undone == 0) crossed = i.moved;
    if (undone != 1) break;
  }
  if (!(crossed > 0)) return FROT_OK;
  i.moved = crossed;
  fire_what_passes(m, s, w, &i);
  memcpy(q, w->step.z, sizeof(double) * (size_t)m->nq);
  memcpy(v, w->step.z + m->nq, sizeof(double) * (size_t)m->nv);
  *t = time_of(&i);
  return FROT_OK;
}

/* Whether the value of condition j is the one its flag was decided with. */
static int is_known(const frot_model *m, const frot_state *s, const frot_work *w, int j) {
  double value = w->core.condition[j], known = w->events.known[j];
  if (j >= m->n_located) return value == known;
  double rounding =
      FROT_UNCHANGED * size_of(m, s, w, j) + 4 * DBL_EPSILON * fmax(fabs(value), fabs(known));
  return fabs(value - known) <= rounding;
}

int frot_change_conditions(const frot_model *m, frot_state *s, frot_work *w, double t,
                           const double *q, const double *v) {
  double *d = s->data + w->layout.d, *fired = s->data + w->layout.fired + frot_condition_guard(m);
  int located = 0;
  for (int j = 0; j < m->n_conditions; j++) {
    if (fired[j] != 0) d[j] = 1 - d[j];
    located |= j < m->n_located && fired[j] != 0;
  }
  int status = located ? frot_evaluate_conditions(m, s, w, t, q, v) : FROT_OK;
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  for (int j = 0; j < m->n_located; j++) {
    double value = w->core.condition[j];
    if (fired[j] != 0 && fabs(value) <= FROT_LOCATED * size_of(m, s, w, j))
      w->events.known[j] = value;
  }
  memset(fired, 0, sizeof(double) * (size_t)m->n_conditions);
  return FROT_OK;
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
    int status = frot_evaluate_conditions(m, s, w, t, q, v);
    if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
    int last = decide(m, s, w, d, pass >= together);
    if (last < 0) return FROT_OK;
    if (last != changed) other = changed, changed = last;
  }
  return frot_fail(s, FROT_CHATTER, t, -1, changed, other, FROT_NO_TRUTH);
}

void frot_find_time_event(const frot_model *m, frot_state *s, frot_work *w) {
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

void frot_fire_time_event(const frot_model *m, frot_state *s) {
  frot_layout l = frot_layout_of(m);
  const double *due = s->data + l.due;
  double *fired = s->data + l.fired + frot_condition_guard(m) + m->n_located;
  for (int j = 0; j < m->n_timed; j++)
    if (due[j] <= s->due) fired[j] = 1;
  s->pending = 1;
}

void frot_bind_events(const frot_model *m, int edges, frot_event_work *w, frot_arena *a) {
  TAKE(w->was, m->n_conditions), TAKE(w->firing, m->n_whens);
  TAKE(w->outcome, m->n_outcomes);
  TAKE(w->before, m->n_conditions), TAKE(w->known, m->n_conditions);
  TAKE(w->timer, 2 * m->n_timed), TAKE(w->discrete, m->n_discrete);
  TAKE(w->discrete_before, m->n_discrete), TAKE(w->held, m->n_held);
  TAKE(w->normals, edges ? m->n_entries : 0);
}
