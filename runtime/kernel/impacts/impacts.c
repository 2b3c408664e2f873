#include "impacts/impacts.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "evaluation/fault_source.h"
#include "evaluation/term_sizes.h"
#include "impacts/accumulation.h"
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

/* Record the event of a contact that has taken an impulse. */
static void record_impact(const frot_instant *in, int i, int driver, const frot_impact_scene *scene,
                          frot_recorder *recorder) {
  const frot_contact_mode *modes = (const void *)(in->s->data + in->l.modes);
  double impulse, lost = frot_lost_by_contact(in, scene, i, &impulse);
  if (!(impulse > 0)) return;
  double *flight = frot_flight_of(in->s, &in->l, i);
  int last = flight[FROT_STAYS_CLOSED] != 0;
  frot_event event = {.t = in->t,
                      .kind = i == driver ? FROT_EVENT_TANGENTIAL_IMPACT
                              : last      ? FROT_EVENT_LAST_IMPACT
                                          : FROT_EVENT_IMPACT,
                      .contact = i,
                      .before = frot_mode_value(in->m, in->w->search.before, i),
                      .after = frot_mode_value(in->m, modes, i),
                      .solutions = scene->phases,
                      .together = scene->together,
                      .impulse = impulse,
                      .lost = lost,
                      .until = last ? flight[FROT_ENDS_AT] : 0};
  if (in->s->phase != FROT_CLEARED) {
    frot_record_whole_event(recorder, in->s, &event);
    return;
  }
  /* at the start there is no recorder yet: the first frot_advance records it */
  flight[FROT_START_KIND] = event.kind, flight[FROT_START_IMPULSE] += impulse;
  flight[FROT_START_LOST] += lost, in->s->several = 1;
}

/* The modes that an impact leaves: contacts that part are open, and elements at rest that slip are
 * no more at rest. */
static void set_modes(const frot_instant *in, const frot_impact_scene *scene,
                      frot_recorder *recorder) {
  const frot_model *m = in->m;
  const frot_impact_work *own = &in->w->impacts;
  frot_contact_mode *modes = (void *)(in->s->data + in->l.modes);
  for (int k = 0; k < scene->problem.n_blocks; k++) {
    const frot_impact_block *block = &own->blocks[k];
    double u = own->after[block->at];
    int e = own->block_of[k], i = ~e;
    if (block->rule == FROT_ROW_PRESSES && modes[i].closed && u > 0) {
      frot_record_event(recorder, in->s, in->t, FROT_EVENT_SEPARATION, i,
                        frot_mode_value(m, modes, i), FROT_MODE_OPEN, 1);
      frot_open(m, modes, i);
      frot_forget_guards(m, in->s, i, 1);
      double *flight = frot_flight_of(in->s, &in->l, i);
      flight[FROT_MET] = in->t, flight[FROT_HAS_MET] = 1;
    }
    if (block->rule != FROT_ROW_BALL || !modes[m->elements[e].contact].closed) continue;
    frot_contact_mode *mode = &modes[m->n_contacts + e];
    if (mode->friction != FROT_STICK || !(frot_length(own->after + block->at, block->n) > 0))
      continue;
    frot_forget_guards(m, in->s, frot_element_guard(m, e), FROT_ELEMENT_GUARDS);
    for (int c = 0; c < block->n; c++) mode[c] = (frot_contact_mode){.friction = FROT_NONE};
    mode->friction = (signed char)(block->n > 1 || u > 0 ? FROT_SLIP_FORWARD : FROT_SLIP_BACKWARD);
  }
}

/* The impact of one component; `driver`: the contact that presses by its friction alone, or -1. */
static int meet(frot_instant *in, const int *chosen, int count, int driver, double *v,
                frot_recorder *recorder) {
  const frot_model *m = in->m;
  frot_state *s = in->s;
  frot_work *w = in->w;
  int settles = frot_note_flights(in, chosen, count);
  frot_impact_scene scene;
  frot_list_impact(in, chosen, count, driver, &scene);
  int failed =
      frot_solve_impact(&scene.problem, scene.driver, w->impacts.after, w->impacts.impulse,
                        w->impacts.lost, &scene.phases, w->impacts.scratch, w->impacts.pivot);
  if (!failed && settles) failed = frot_hold_settled(in, &scene);
  if (failed) return frot_fail(s, FROT_IMPACT, in->t, scene.first, -1, -1, scene.rate);
  double before = frot_kinetic(m, w, v);
  frot_apply_impact(in, &scene, v);
  double lost = 0, gained = frot_kinetic(m, w, v) - before;
  for (int k = 0; k < scene.problem.n_blocks; k++) lost += w->impacts.lost[k];
  double *quadratures = s->data + in->l.x + m->nq + m->nv;
  quadratures[0] += lost, quadratures[1] += gained + lost;
  set_modes(in, &scene, recorder);
  for (int c = 0; c < count; c++) record_impact(in, chosen[c], driver, &scene, recorder);
  frot_forget_rate_rounding(m, s, w);
  return FROT_OK;
}

/* Evaluate the instant with the contacts that may be closed, in the axes of the text. */
static int look(frot_instant *in, int first) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  size_t modes = sizeof *w->search.best * (size_t)(m->n_contacts + m->n_elements);
  memcpy(w->search.before, in->s->data + in->l.modes, modes);
  memset(w->search.zero, 0, (size_t)m->n_elements);
  int status = frot_kinematics(m, in->s, w, in->t, in->q, in->v, in->s->data + in->l.d);
  frot_list_closable(in, first);
  memset(w->search.best + m->n_contacts, 0, sizeof *w->search.best * (size_t)m->n_elements);
  return status;
}

/* The contacts of a component into w->search.chosen; returns how many. */
static int choose(const frot_instant *in, int root) {
  int count = 0;
  for (int i = 0; i < in->m->n_contacts; i++)
    if (in->w->search.component[i] == root) in->w->search.chosen[count++] = i;
  return count;
}

/* Let the contacts that close with speed meet. */
static int make_impacts(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                        double *v, int first, frot_recorder *recorder) {
  if (!can_any_part(m, s, w)) return FROT_OK;
  frot_instant in = frot_instant_at(m, s, w, t, q, v);
  int any = 0, status = look(&in, first);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  if (!may_meet(&in)) return FROT_OK;
  status = find_meeting(&in, v, &any);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  if (!any) return FROT_OK;
  frot_find_components(&in);
  for (int root = 0; root < m->n_contacts && status == FROT_OK; root++) {
    int count = choose(&in, root), meets = 0;
    for (int c = 0; c < count; c++) meets |= w->impacts.meets[w->search.chosen[c]];
    if (meets) status = meet(&in, w->search.chosen, count, -1, v, recorder);
  }
  return status;
}

/* Where no motion is admissible: let a contact of the component of `contact` be pressed by its own
 * friction, as its slip continues, until that ends (L. Lecornu 1905; F. Genot, B. Brogliato 1999).
 * *made: whether there is such a contact. */
static int make_tangential_impact(const frot_model *m, frot_state *s, frot_work *w, double t,
                                  const double *q, double *v, int contact, frot_recorder *recorder,
                                  int *made) {
  *made = 0;
  if (!can_any_part(m, s, w)) return FROT_OK;
  frot_instant in = frot_instant_at(m, s, w, t, q, v);
  int any, status = look(&in, 0);
  if (status == FROT_OK) status = find_meeting(&in, v, &any);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  frot_find_components(&in);
  int count = choose(&in, w->search.component[contact]);
  frot_impact_scene scene;
  frot_list_impact(&in, w->search.chosen, count, -1, &scene);
  int driver = frot_jamming_contact(&scene.problem, w->impacts.after, w->impacts.impulse,
                                    w->impacts.lost, w->impacts.scratch, w->impacts.pivot);
  if (driver < 0) return FROT_OK;
  *made = 1;
  return meet(&in, w->search.chosen, count, ~w->impacts.block_of[driver], v, recorder);
}

int frot_meet_and_resolve(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                          double *v, int first, frot_recorder *recorder) {
  int phase = s->phase, status = make_impacts(m, s, w, t, q, v, first, recorder);
  if (status != FROT_OK) return status;
  for (int round = 0; round <= m->n_contacts; round++) {
    status = frot_resolve(m, s, w, t, q, v, first, recorder);
    if (status != FROT_IMPASSE || s->options.on_impasse == FROT_IMPASSE_ENDS) return status;
    frot_fault fault = s->fault;
    int made;
    s->phase = phase, s->fault = frot_no_fault(t);
    int failed = make_tangential_impact(m, s, w, t, q, v, fault.contact, recorder, &made);
    if (failed) return failed;
    if (!made) return s->phase = FROT_FAULTED, s->fault = fault, status;
  }
  return status;
}
