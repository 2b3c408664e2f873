#include "modes/resolve.h"

#include <math.h>
#include <string.h>

#include "evaluation/fault_source.h"
#include "evaluation/algebraic_loops.h"
#include "modes/contact_components.h"
#include "evaluation/evaluate.h"
#include "constraints/locked_speeds.h"
#include "reactions/switching_functions.h"
#include "modes/departures.h"
#include "constraints/projection.h"
#include "recording/event_log.h"
#include "modes/enumeration.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"
#include "modes/zero_slip.h"

/* Events at one instant after which slips may come to zero in turn, ever faster: to no end. */
#define IN_TURN 50

/* A reaction that reached its upper bound (first guard) lets the body go backward. */
static int left_by(const double *fired) { return fired[0] != 0 ? -1 : (fired[1] != 0 ? 1 : 0); }

/* A gap that opens stays open. One that closes with speed is an impact, which is over by now. */
static int open_leaving(const frot_instant *in, double t) {
  const frot_model *m = in->m;
  for (int i = 0; i < m->n_contacts; i++) {
    double rate;
    enum frot_approach approach = frot_approach_of(in, i, &rate);
    if (approach == FROT_LEAVES) frot_open(m, in->w->search.best, i);
    if (approach == FROT_CLOSES) return frot_fail(in->s, FROT_IMPACT, t, i, -1, -1, rate);
  }
  return FROT_OK;
}

/* Note which rests end now, and in which direction, and which reactions have come to zero. What was
 * left at this very instant stays left: where two rests hold each other at their bounds, both end.
 * What has come to zero is zero, whatever else happens at the instant. */
static void note_ends(const frot_model *m, frot_state *s, double t) {
  frot_layout l = frot_layout_of(m);
  double *left = s->data + l.left, *vanished = s->data + l.vanished;
  const frot_contact_mode *modes = (const void *)(s->data + l.modes);
  if (!(fabs(t - s->left_at) <= FROT_ONE_INSTANT * frot_size_of_time(t, s->h_max)))
    memset(left, 0, sizeof(double) * (size_t)m->n_elements),
        memset(vanished, 0, sizeof(double) * (size_t)m->n_contacts);
  for (int e = 0; e < m->n_elements; e++) {
    int way = left_by(s->data + l.fired + frot_element_guard(m, e));
    if (frot_element_mode(m, modes, e)->friction == FROT_STICK && way) left[e] = way;
  }
  for (int i = 0; i < m->n_contacts; i++)
    if (s->data[l.fired + i] != 0 && modes[i].closed)
      vanished[i] = fmax(vanished[i], s->data[l.scale_g + i]);
  s->left_at = t;
}

/* What is known of the speeds: a slip that has come to zero is zero exactly, if its law can hold
 * it. Moves coordinates and speeds onto what holds. */
static int settle_speeds(frot_instant *in, double t, double *q, double *v) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  for (int e = 0; e < m->n_elements; e++) {
    int friction = frot_element_mode(m, w->search.before, e)->friction;
    in->zero[e] = w->search.best[m->elements[e].contact].closed && frot_bounds_something(m, w, e) &&
                  frot_is_zero_rate(in, e, v, friction);
    in->at_rest[e] = in->zero[e];
  }
  size_t modes = (size_t)(m->n_contacts + m->n_elements);
  memcpy(w->search.trial, w->search.best, sizeof *w->search.trial * modes);
  for (int e = 0; e < m->n_elements; e++) w->search.trial[m->n_contacts + e].friction = FROT_NONE;
  int moved;
  return frot_project(m, in->s, w, t, q, v, in->s->data + in->l.d, w->search.trial, in->zero, NULL,
                      &moved);
}

/* Whether nothing in the group of a contact can part or has friction: its relations alone leave no
 * motion, as where they depend on each other and the speeds do not agree. */
static int only_loops(const frot_instant *in, int contact) {
  const frot_group *g = &in->m->groups[in->m->contact_group[contact]];
  for (int i = 0; i < g->n_contacts; i++)
    if (in->unilateral[g->contacts[i]] != 0) return 0;
  return g->n_elements == 0;
}

/* Whether the modes have ended for want of reactions beyond the instant, and no others last: what
 * goes on in them would do so by rounding, beyond a pole. */
static int has_jammed(const frot_instant *in, int contact) {
  return !in->w->search.lasts && in->s->jammed_at == in->t &&
         in->s->jammed == in->m->contact_group[contact];
}

/* The modes into w->search.best, component after component; each that has several motions is told.
 * FROT_DIVERGE that is no fault yet where they have jammed: what is to blame is looked for
 * elsewhere, which a search that may go on does not outlast. */
static int choose_modes(const frot_instant *in, double t, int first, frot_recorder *recorder) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  int several = 0, several_at = -1;
  if (first) memset(in->s->data + in->l.several, 0, sizeof(double) * (size_t)m->n_contacts);
  in->s->fleeting = -1;
  /* of what is looked at later no reactions are known */
  memset(w->core.lam, 0, sizeof(double) * (size_t)m->n_rows);
  frot_find_components(in);
  for (int root = 0; root < m->n_contacts; root++) {
    int *chosen = w->search.chosen, count = 0, unsearched = 0;
    for (int i = 0; i < m->n_contacts; i++)
      if (w->search.component[i] == root) chosen[count++] = i;
    if (count == 0) continue;
    frot_note_others(in, chosen, count);
    int motions = frot_slips_in_space(in, chosen, count)
                      ? frot_find_contact_motion(in, chosen, count)
                      : frot_look_for_motions(in, chosen, count, &unsearched);
    in->s->statistics.unsearched += unsearched;
    if (!w->search.lasts) in->s->fleeting = chosen[0];
    if (motions > 0 && has_jammed(in, chosen[0])) return FROT_DIVERGE;
    if (motions == 0) {
      int fault = unsearched                  ? FROT_TOO_LARGE
                  : only_loops(in, chosen[0]) ? FROT_POSTURE
                                              : FROT_IMPASSE;
      int apart =
          fault == FROT_POSTURE ? frot_contact_opened_by_time(m, in->s, w, t, in->q, in->v) : -1;
      if (apart >= 0) return frot_fail(in->s, FROT_DIVERGE, t, apart, 0, -1, 0);
      int begins = fault == FROT_POSTURE && in->s->statistics.steps == 0; /* fault_messages.c */
      return frot_fail(in->s, fault, t, chosen[0], -1, -1, begins ? 0 : count);
    }
    if (motions < 2) continue;
    if (!several) several = motions, several_at = chosen[0];
    if (!first)
      frot_record_event(recorder, in->s, t, FROT_EVENT_SEVERAL, chosen[0],
                        frot_mode_value(m, w->search.before, chosen[0]),
                        frot_mode_value(m, w->search.best, chosen[0]), motions);
    else
      in->s->several = 1, in->s->data[in->l.several + chosen[0]] = motions; /* told at once after */
  }
  if (several && in->s->options.on_indeterminate == FROT_HALT)
    return frot_fail(in->s, FROT_SEVERAL, t, several_at, -1, -1, several);
  return FROT_OK;
}

/* Whether a slip that is one is no more than a part of what it usually is. */
static int any_slight(const frot_instant *in, double part) {
  const frot_model *m = in->m;
  for (int e = 0; e < m->n_elements; e++) {
    int row = m->elements[e].row;
    int acts = in->w->search.closable[m->elements[e].contact].closed && !in->zero[e];
    if (acts && frot_bounds_something(m, in->w, e) &&
        fabs(in->w->core.rate[row]) <= part * frot_typical_speed(in, row))
      return 1;
  }
  return 0;
}

/* The modes of an instant into w->search.best, with what holds put where it holds; *slight says
 * whether a slip is no more than `part` of what it usually is. */
static int find_modes(frot_instant *in, double *q, double *v, int first, double part, int *slight,
                      frot_recorder *recorder) {
  const frot_model *m = in->m;
  frot_state *s = in->s;
  frot_work *w = in->w;
  const double *d = s->data + in->l.d, t = in->t;
  int status = settle_speeds(in, t, q, v);
  frot_begin_slips_in_space(in);
  if (status == FROT_OK) status = frot_dynamics(m, s, w, t, q, v, d, w->search.best, FROT_LAWS);
  if (status == FROT_OK && frot_find_growth(in, d))
    status = frot_dynamics(m, s, w, t, q, v, d, w->search.best, FROT_LAWS);
  if (status == FROT_OK) status = frot_metric(m, w);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  frot_row_loads(m, s, w, t, q, v, d);
  *slight = any_slight(in, part);
  return choose_modes(in, t, first, recorder);
}

/* Whether a slip ends at an instant crowded with events: the next one may bring it back. */
static int ends_in_turn(const frot_instant *in) {
  int ends = 0;
  for (int e = 0; e < in->m->n_elements; e++) {
    int slips = frot_element_mode(in->m, in->w->search.before, e)->friction > FROT_STICK;
    ends |= slips && in->fired[frot_element_guard(in->m, e)] != 0;
  }
  return ends && in->s->crowded > IN_TURN;
}

/* The status of a search, with what is to blame where it has jammed. */
static int blame(const frot_instant *in, int status) {
  frot_work *w = in->w;
  if (status != FROT_DIVERGE || in->s->phase == FROT_FAULTED) return status;
  w->step.worst = -1, w->reactions.jammed = in->s->jammed;
  return frot_fail_step(in->m, in->s, w, status, in->t, 0, in->q, in->v);
}

/* The same where a slip runs into an impasse, which would stop it at once (L. Lecornu's tangential
 * impact), or where slips end in turn: one that is no more than the run tells from rest is rest, if
 * modes are found then that last. */
static int find_lasting_modes(frot_instant *in, double *q, double *v, int first,
                              frot_recorder *recorder) {
  const frot_model *m = in->m;
  frot_state *s = in->s;
  frot_search_work *found = &in->w->search;
  double *kept = found->moved_from, part = fmax(FROT_TOUCH, s->tolerance);
  size_t modes = sizeof *found->best * (size_t)(m->n_contacts + m->n_elements);
  int phase = s->phase;
  long long events = s->statistics.events, unsearched = s->statistics.unsearched;
  long long noted = recorder ? recorder->event_count : 0;
  memcpy(kept, q, sizeof(double) * (size_t)m->nq);
  memcpy(kept + m->nq, v, sizeof(double) * (size_t)m->nv);
  memcpy(found->closable, found->best, modes);
  int in_turn = ends_in_turn(in);
  in->slight = in_turn ? part : 0;
  for (int pass = in_turn;; pass++) {
    int slight = 0, status = find_modes(in, q, v, first, part, &slight, recorder);
    int told = status == FROT_OK || status == FROT_DIVERGE;
    int ended = status == FROT_IMPASSE || (told && s->fleeting >= 0);
    if (!ended || pass == 2 || (pass == 0 && !slight)) return blame(in, status);
    in->slight = pass == 0 ? part : 0; /* else as they were */
    s->phase = phase, s->fault = frot_no_fault(in->t);
    s->statistics.events = events, s->statistics.unsearched = unsearched;
    if (recorder) recorder->event_count = noted;
    memcpy(q, kept, sizeof(double) * (size_t)m->nq);
    memcpy(v, kept + m->nq, sizeof(double) * (size_t)m->nv);
    memcpy(found->best, found->closable, modes);
    status = frot_kinematics(m, s, in->w, in->t, q, v, s->data + in->l.d);
    if (status != FROT_OK) return frot_fail_evaluation(m, s, in->w, status, in->t);
  }
}

/* The pins' reactions go on from those of the modes found: friction that follows their size may
 * have solutions in other directions. What passes through zero is turned by its own rule. */
static void pass_directions(const frot_instant *in) {
  double *along = in->s->data + in->l.along;
  for (int e = 0; e < in->m->n_elements; e++) {
    int slips = frot_element_mode(in->m, in->w->search.before, e)->friction > FROT_STICK;
    const frot_element *element = &in->m->elements[e];
    const double *fired = in->fired + frot_element_guard(in->m, e) + 1;
    for (int k = 0; k < FROT_NORMS && element->bound == FROT_BY_PIN; k++) {
      int at = FROT_BOUNDING * e + frot_norm_first(element, k);
      if (slips && fired[k] != 0) continue;
      memcpy(along + at, in->w->search.along + at, sizeof(double) * (size_t)element->norm[k]);
    }
  }
}

/* What begins to slip is known no better at its start than it was taken for zero. */
static void size_beginnings(const frot_instant *in) {
  const frot_contact_mode *modes = (const void *)(in->s->data + in->l.modes);
  for (int e = 0; e < in->m->n_elements; e++) {
    double *scale = in->s->data + in->l.scale_g + frot_element_guard(in->m, e);
    if (in->zero[e] && frot_element_mode(in->m, modes, e)->friction > FROT_STICK)
      *scale = fmax(*scale, frot_zero_rate(in, e, in->v) / FROT_LOCATED);
  }
}

int frot_resolve(const frot_model *m, frot_state *s, frot_work *w, double t, double *q, double *v,
                 int first, frot_recorder *recorder) {
  frot_layout l = frot_layout_of(m);
  double *d = s->data + l.d, *fired = s->data + l.fired, *frozen = s->data + l.frozen;
  frot_contact_mode *modes = (frot_contact_mode *)(void *)(s->data + l.modes);
  size_t count = (size_t)(m->n_contacts + m->n_elements);
  note_ends(m, s, t);
  frot_instant in = frot_instant_at(m, s, w, t, q, v);
  memcpy(w->search.before, modes, sizeof *modes * count);
  memcpy(w->search.best, modes, sizeof *modes * count);
  memset(w->search.zero, 0, (size_t)m->n_elements);
  memcpy(w->search.along, s->data + l.along,
         sizeof(double) * FROT_BOUNDING * (size_t)m->n_elements);

  int status = frot_kinematics(m, s, w, t, q, v, d);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  frot_note_reaches(m, s, w, t, q, v, d);
  frot_list_closable(&in, first);
  status = frot_dynamics(m, s, w, t, q, v, d, w->search.best, FROT_LAWS);
  if (status == FROT_OK) status = frot_metric(m, w);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  frot_row_loads(m, s, w, t, q, v, d);
  status = open_leaving(&in, t);
  if (status != FROT_OK) return status;
  status = find_lasting_modes(&in, q, v, first, recorder);
  if (status != FROT_OK) return status;
  if (memcmp(modes, w->search.best, sizeof *modes * count) != 0) s->idle = 0;
  memcpy(modes, w->search.best, sizeof *modes * count);
  pass_directions(&in);
  if (!first) frot_record_mode_changes(m, s, t, w->search.before, modes, recorder);
  frot_find_locked_speeds(m, s, w, modes, frozen);
  for (int k = 0; k < m->nv; k++)
    if (frozen[k] != 0) v[k] = 0;
  frot_flip_pin_references(m, s, w, modes);
  memset(fired, 0, sizeof(double) * (size_t)l.nf);
  /* a reaction that has turned is the same: it was located by what it was */
  for (int i = 0; i < m->n_contacts; i++)
    if (modes[i].closed != w->search.before[i].closed) frot_forget_guards(m, s, i, 1);
  for (int e = 0; e < m->n_elements; e++)
    if (memcmp(&modes[m->n_contacts + e], &w->search.before[m->n_contacts + e], sizeof *modes) != 0)
      frot_forget_guards(m, s, frot_element_guard(m, e), FROT_ELEMENT_GUARDS);
  size_beginnings(&in);
  s->jammed = -1; /* the modes found have not ended */
  return FROT_OK;
}
