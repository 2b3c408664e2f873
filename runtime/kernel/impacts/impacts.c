#include "impacts/impacts.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "evaluation/fault_source.h"
#include "evaluation/term_sizes.h"
#include "impacts/accumulation.h"
#include "impacts/component_impact.h"
#include "impacts/impact_rows.h"
#include "methods/rate_rounding.h"
#include "modes/contact_components.h"
#include "mode_choice/resolve.h"
#include "modes/zero_slip.h"
#include "numerics/dense.h"
#include "numerics/tolerances.h"
#include "reactions/switching_functions.h"
#include "recording/event_log.h"

/* Whether there is a contact that can part: no other meets. */
static int can_any_part(const frot_model *m, const frot_state *s, const frot_work *w) {
  const double *unilateral = s->data + w->layout.unilateral;
  for (int i = 0; i < m->n_contacts; i++)
    if (unilateral[i] != 0 && w->impacts.blocks) return 1;
  return 0;
}

/* Whether a contact may close with speed, by the kinematics alone. */
static int may_meet(const frot_instant *in) {
  const frot_model *m = in->m;
  for (int i = 0; i < m->n_contacts; i++) {
    int row = m->contacts[i].row_n;
    if (!in->w->search.best[i].closed || in->unilateral[i] == 0 || row < 0) continue;
    if (in->w->core.rate[row] < -FROT_ROUNDING * frot_row_size(m, in->w, row, in->v)) return 1;
  }
  return 0;
}

/* Evaluate the instant with all contacts that may be closed, and note which of them meet in
 * w->impacts.meets. *any: whether one does. */
static int find_meeting(frot_instant *in, const double *v, int *any) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const double *d = in->s->data + in->l.d;
  *any = 0;
  frot_note_reaches(m, in->s, w, in->t, in->q, v, d);
  int status = frot_dynamics(m, in->s, w, in->t, in->q, v, d, w->search.best, FROT_LAWS);
  if (status == FROT_OK) status = frot_metric(m, w);
  if (status != FROT_OK) return status;
  frot_row_loads(m, in->s, w, in->t, in->q, v, d);
  for (int i = 0; i < m->n_contacts; i++) {
    double rate;
    w->impacts.meets[i] = frot_approach_of(in, i, &rate) == FROT_CLOSES;
    *any |= w->impacts.meets[i];
  }
  return FROT_OK;
}

/* The impact of one component; `driver`: the contact that presses by its friction alone, or -1. */
static int meet(const frot_instant *in, const int *chosen, int count, int driver, double *v,
                frot_recorder *recorder) {
  int settles = frot_note_flights(in, chosen, count);
  frot_impact_scene scene;
  frot_list_impact(in, chosen, count, driver, &scene);
  double lost = 0, before = frot_kinetic(in->m, in->w, v);
  int status =
      frot_act_on_component(in, chosen, count, driver, settles, &scene, v, &lost, recorder);
  if (status == FROT_OK) frot_count_energy(in, before, lost, v);
  return status;
}

/* Let the contacts that close with speed meet. *any: whether there are such. */
static int meet_once(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                     double *v, int first, frot_recorder *recorder, int *any) {
  *any = 0;
  frot_instant in = frot_instant_at(m, s, w, t, q, v);
  int status = frot_evaluate_closable(&in, first);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  for (int i = 0; i < m->n_contacts; i++) /* the gap is none, whether or not it opens */
    if (w->impacts.met[i]) w->search.best[i].closed = 1;
  if (!may_meet(&in)) return FROT_OK;
  status = find_meeting(&in, v, any);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  if (!*any) return FROT_OK;
  for (int i = 0; i < m->n_contacts; i++) w->impacts.met[i] |= w->impacts.meets[i];
  frot_find_components(&in);
  for (int root = 0; root < m->n_contacts && status == FROT_OK; root++) {
    int count = frot_choose_component(&in, root), meets = 0;
    for (int c = 0; c < count; c++) meets |= w->impacts.meets[w->search.chosen[c]];
    if (meets) status = meet(&in, w->search.chosen, count, -1, v, recorder);
  }
  return status;
}

/* The same until nothing closes any more: an impact may send bodies onto others that are as near as
 * instants are told apart. What has met takes part in each further impact of the instant, so that
 * blows that follow each other without end are one impact. */
static int make_impacts(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                        double *v, int first, frot_recorder *recorder) {
  int any = can_any_part(m, s, w), status = FROT_OK;
  if (any) memset(w->impacts.met, 0, (size_t)m->n_contacts);
  for (int round = 0; round <= m->n_contacts && any && status == FROT_OK; round++)
    status = meet_once(m, s, w, t, q, v, first, recorder, &any);
  return status;
}

/* Where no motion is admissible: let a contact of the component of `contact` be pressed by its own
 * friction, as its slip continues, until that ends (L. Lecornu 1905; F. Genot, B. Brogliato 1999).
 * The same where steps have `ended` for its reaction grows without bound (A. Nordmark, P. Varkonyi,
 * A. Champneys 2018). *made: whether there is such a contact. */
static int make_tangential_impact(const frot_model *m, frot_state *s, frot_work *w, double t,
                                  const double *q, double *v, int contact, int ended,
                                  frot_recorder *recorder, int *made) {
  *made = 0;
  if (!can_any_part(m, s, w)) return FROT_OK;
  frot_instant in = frot_instant_at(m, s, w, t, q, v);
  int any, status = frot_evaluate_closable(&in, 0);
  if (status == FROT_OK) status = find_meeting(&in, v, &any);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  frot_find_components(&in);
  int count = frot_choose_component(&in, w->search.component[contact]);
  frot_impact_scene scene;
  frot_list_impact(&in, w->search.chosen, count, -1, &scene);
  int driver = frot_jamming_contact(&scene.problem, ended, w->impacts.after, w->impacts.impulse,
                                    w->impacts.lost, w->impacts.scratch, w->impacts.pivot);
  if (driver < 0) return FROT_OK;
  *made = 1, s->jammed = -1;
  return meet(&in, w->search.chosen, count, ~w->impacts.block_of[driver], v, recorder);
}

/* The same at each contact that may be closed and can be pressed so, whether or not other motions
 * are admissible. */
static int make_all_tangential_impacts(const frot_model *m, frot_state *s, frot_work *w, double t,
                                       const double *q, double *v, frot_recorder *recorder) {
  if (!can_any_part(m, s, w)) return FROT_OK;
  for (int i = 0; i < m->n_contacts; i++) {
    frot_instant in = frot_instant_at(m, s, w, t, q, v);
    int made, status = frot_evaluate_closable(&in, 0);
    if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
    if (!w->search.best[i].closed || in.unilateral[i] == 0) continue;
    status = make_tangential_impact(m, s, w, t, q, v, i, 0, recorder, &made);
    if (status != FROT_OK) return status;
  }
  return FROT_OK;
}

/* Whether steps have come to an end at t by the reactions of a slip. */
static int ends_in_jam(const frot_model *m, const frot_state *s, const frot_work *w, double t) {
  return s->jammed >= 0 && s->jammed_at == t && s->options.on_impasse != FROT_IMPASSE_ENDS &&
         frot_group_of_jamming_slip(m, s, w) == s->jammed;
}

int frot_meet_and_resolve(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                          double *v, int first, frot_recorder *recorder) {
  int phase = s->phase, made, status = make_impacts(m, s, w, t, q, v, first, recorder);
  if (status == FROT_OK && ends_in_jam(m, s, w, t))
    status = make_tangential_impact(m, s, w, t, q, v, m->groups[s->jammed].contacts[0], 1, recorder,
                                    &made);
  if (status == FROT_OK && s->options.on_indeterminate == FROT_COLLIDE)
    status = make_all_tangential_impacts(m, s, w, t, q, v, recorder);
  if (status != FROT_OK) return status;
  for (int round = 0; round <= m->n_contacts; round++) {
    status = frot_resolve(m, s, w, t, q, v, first, recorder);
    if (status != FROT_IMPASSE || s->options.on_impasse == FROT_IMPASSE_ENDS) return status;
    frot_fault fault = s->fault;
    s->phase = phase, s->fault = frot_no_fault(t);
    int failed = make_tangential_impact(m, s, w, t, q, v, fault.contact, 0, recorder, &made);
    if (failed) return failed;
    if (!made) return s->phase = FROT_FAULTED, s->fault = fault, status;
  }
  return status;
}
