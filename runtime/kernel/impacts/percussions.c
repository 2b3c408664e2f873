#include "impacts/percussions.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "evaluation/fault_source.h"
#include "evaluation/term_sizes.h"
#include "impacts/component_impact.h"
#include "methods/rate_rounding.h"
#include "modes/contact_components.h"
#include "recording/event_log.h"

/* The discrete values of a state: those of the text, after conditions and sides. */
static double *discrete_of(const frot_instant *in) {
  return in->s->data + in->l.d + in->m->n_conditions + in->m->n_contacts;
}

/* Put the factors of the percussions that are due to one, or to zero; returns how many are. */
static int set_strikes(const frot_instant *in, double factor) {
  const frot_model *m = in->m;
  double *discrete = discrete_of(in);
  int count = 0;
  for (int k = 0; k < m->n_percussions; k++) {
    const frot_percussion *one = &m->percussions[k];
    discrete[one->strike] = discrete[one->due] != 0 ? factor : 0;
    count += discrete[one->due] != 0;
  }
  return count;
}

/* rows (n_rows) and speeds (nv) += sign times their accelerations without reactions. */
static int add_free_motion(const frot_instant *in, double sign, double *rows, double *speeds) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  int status = frot_dynamics(m, in->s, w, in->t, in->q, in->v, in->s->data + in->l.d,
                             w->search.best, FROT_LAWS);
  if (status != FROT_OK) return status;
  memset(w->core.lam, 0, sizeof(double) * (size_t)m->n_rows);
  frot_accelerations(m, w, w->impacts.moving);
  for (int i = 0; i < m->n_rows; i++)
    if (w->core.wanted[i]) rows[i] += sign * w->core.free[i];
  for (int i = 0; i < m->nv; i++) speeds[i] += sign * w->core.a[i];
  return FROT_OK;
}

/* What the percussions alone do: the difference of two evaluations, with them and without. */
static int find_change(const frot_instant *in) {
  const frot_model *m = in->m;
  frot_impact_work *own = &in->w->impacts;
  memset(own->struck_rows, 0, sizeof(double) * (size_t)m->n_rows);
  memset(own->struck, 0, sizeof(double) * (size_t)m->nv);
  memset(own->moving, 0, sizeof(double) * (size_t)in->l.nw);
  set_strikes(in, 1);
  int status = add_free_motion(in, 1, own->struck_rows, own->struck);
  set_strikes(in, 0);
  if (status == FROT_OK) status = add_free_motion(in, -1, own->struck_rows, own->struck);
  if (status == FROT_OK) status = frot_metric(m, in->w);
  return status;
}

/* The reactions of each component to the percussions. */
static int react(const frot_instant *in, double *v, double *lost, frot_recorder *recorder) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  memset(w->impacts.meets, 0, (size_t)m->n_contacts);
  frot_find_components(in);
  for (int root = 0; root < m->n_contacts; root++) {
    int count = frot_choose_component(in, root), status;
    if (count == 0) continue;
    frot_impact_scene scene;
    frot_list_impact(in, w->search.chosen, count, -1, &scene);
    if (!frot_add_percussion(in, w->impacts.struck_rows, &scene)) continue;
    status = frot_act_on_component(in, w->search.chosen, count, -1, 0, &scene, v, lost, recorder);
    if (status != FROT_OK) return status;
  }
  return FROT_OK;
}

/* Note the impulses of the percussions; nothing is known of their work yet. */
static int note_impulses(const frot_instant *in) {
  const frot_model *m = in->m;
  double *blows = in->s->data + in->l.blows;
  frot_inputs(in->s, in->w, &in->t, in->q, in->v, in->s->data + in->l.d);
  in->w->call.res[0] = blows;
  frot_call(in->w, &m->impulses);
  for (int k = 0; k < m->n_percussions; k++) blows[3 * m->n_percussions + k] = NAN;
  return frot_all_finite(blows, 3 * m->n_percussions) ? FROT_OK : FROT_NAN;
}

/* Note the work of the percussions of the instant with the first of them, and in its event. */
static void note_work(const frot_instant *in, double work, frot_recorder *recorder) {
  const frot_model *m = in->m;
  int first = 0;
  while (discrete_of(in)[m->percussions[first].due] == 0) first++;
  in->s->data[in->l.blows + 3 * m->n_percussions + first] = work;
  for (long long e = recorder ? recorder->event_count : 0; e-- > 0;) {
    frot_event *event = &recorder->events[e];
    int is_it = event->kind == FROT_EVENT_PERCUSSION && event->t == in->t;
    if (is_it && event->contact == m->percussions[first].outcome)
      event->lost = -work, event->together = 1;
  }
}

/* Record the events of the percussions. At the start there is no recorder yet. */
static void tell(const frot_instant *in, frot_recorder *recorder) {
  const frot_model *m = in->m;
  for (int k = 0; k < m->n_percussions; k++) {
    int outcome = m->percussions[k].outcome;
    if (discrete_of(in)[m->percussions[k].due] == 0) continue;
    if (in->s->phase != FROT_CLEARED)
      frot_record_percussion(m, recorder, in->s, in->t, k);
    else
      in->s->data[in->l.requested + outcome] = in->t, in->s->untold = 1;
  }
}

int frot_strike(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                double *v, int *struck, frot_recorder *recorder) {
  *struck = 0;
  if (m->n_percussions == 0) return FROT_OK;
  frot_instant in = frot_instant_at(m, s, w, t, q, v);
  *struck = set_strikes(&in, 0) > 0;
  if (!*struck) return FROT_OK;
  int status = frot_evaluate_closable(&in, 0);
  if (status == FROT_OK) frot_note_reaches(m, s, w, t, q, v, s->data + in.l.d);
  if (status == FROT_OK) status = note_impulses(&in);
  if (status == FROT_OK) status = find_change(&in);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  frot_row_loads(m, s, w, t, q, v, s->data + in.l.d);
  tell(&in, recorder);
  double lost = 0, before = frot_kinetic(m, w, v);
  status = react(&in, v, &lost, recorder);
  if (status != FROT_OK) return status;
  for (int i = 0; i < m->nv; i++) v[i] += w->impacts.struck[i];
  note_work(&in, frot_kinetic(m, w, v) - before + lost, recorder);
  frot_count_energy(&in, before, lost, v);
  for (int k = 0; k < m->n_percussions; k++) discrete_of(&in)[m->percussions[k].due] = 0;
  s->jumped = 1;
  return FROT_OK;
}
