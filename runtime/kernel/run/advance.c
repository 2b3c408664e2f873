/* The life of an instance: parameters, start, changes from outside, the run. */
#include <math.h>
#include <string.h>

#include "model/sleeping.h"
#include "starts/closure_fault.h"
#include "evaluation/fault_source.h"
#include "evaluation/algebraic_loops.h"
#include "guards/conditions.h"
#include "events/feature_edges.h"
#include "model/indexing.h"
#include "events/event_iteration.h"
#include "starts/initial_values.h"
#include "stepping/step_length.h"
#include "methods/right_hand_side.h"
#include "recording/event_log.h"
#include "model/workspace.h"
#include "model/segment.h"
#include "methods/dormand_prince.h"
#include "events/sliding_equilibrium.h"
#include "stepping/step.h"
#include "methods/method_choice.h"
#include "events/parameter_change.h"
#include "numerics/tolerances.h"
#include "recording/segment_store.h"

/* Events at one instant after which the modes will not settle. */
#define CROWD 100
/* And after which it is asked whether what they switch comes to rest. */
#define RESTLESS 1
#define MONITOR_EVERY 64
/* First steps and scales of time where forces depend on it, in runs; the longest step:
 * time_resolution.c. */
#define PART_OF_RUN 0.01

int frot_settle_parameters(const frot_model *m, frot_state *s, frot_work *w, double experiment[4]) {
  frot_bind_work(m, w);
  frot_layout l = frot_layout_of(m);
  double *p = w->call.values, *checks = w->call.values + m->np;
  w->call.arg[0] = s->data + l.given, w->call.arg[1] = s->data + l.set,
  w->call.arg[2] = s->data + l.u;
  w->call.res[0] = p, w->call.res[1] = checks;
  w->call.res[2] = s->data + l.unilateral, w->call.res[3] = s->data + l.experiment;
  w->call.res[4] = s->data + l.nominal, w->call.res[5] = s->data + l.carried;
  w->call.res[6] = s->data + l.restitution;
  frot_call(w, &m->parameters);
  memcpy(s->data + l.p, p, sizeof(double) * (size_t)m->np);
  for (int i = 0; i < m->n_checks; i++) {
    double x = checks[i];
    int rule = m->checks[i].rule;
    int good = rule == FROT_POSITIVE        ? x > 0
               : rule == FROT_NOT_NEGATIVE  ? x >= 0
               : rule == FROT_FINITE        ? isfinite(x)
               : rule == FROT_NOT_ZERO      ? x != 0
               : rule == FROT_NOT_ABOVE_MAX ? x <= checks[i - 1]
                                            : x >= checks[i - 1];
    if (!good || !(fabs(x) <= FROT_LARGEST_GIVEN))
      return frot_fail(s, FROT_CHECK, s->t, -1, i, -1, x);
  }
  if (experiment) memcpy(experiment, s->data + l.experiment, 4 * sizeof(double));
  return FROT_OK;
}

/* Kinetic and potential energy together; NaN where the blocks have no solution. Notes the size of
 * the terms. */
static double energy_at(const frot_model *m, frot_state *s, frot_work *w, const double *x,
                        double *kinetic) {
  double energy[3];
  int status = frot_energies(m, s, w, s->t, x, x + m->nq, s->data + frot_layout_of(m).d, energy);
  *kinetic = status == FROT_OK ? fabs(energy[0]) : 0;
  if (status == FROT_OK) s->energy_terms = fmax(s->energy_terms, energy[2]);
  return status == FROT_OK ? energy[0] + energy[1] : NAN;
}

/* The same, where the run goes on from. */
static double energy_now(const frot_model *m, frot_state *s, frot_work *w, const double *x) {
  double kinetic, energy = energy_at(m, s, w, x, &kinetic);
  s->energy_scale = fmax(s->energy_scale, kinetic);
  return energy;
}

static int start(const frot_model *m, frot_state *s, frot_work *w, double t,
                 const frot_options *options) {
  frot_layout l = frot_layout_of(m);
  frot_clear_run(m, s);
  s->fault = frot_no_fault(t);
  s->options = options ? *options : (frot_options){0, FROT_REST, 0};
  s->t = s->began = s->text_event = s->crowded_since = s->left_at = t;
  s->caution = 0.8;
  s->second = -1;
  s->jammed_at = s->heard_at = NAN;
  s->across = s->foreseen = s->due = INFINITY;
  for (int i = 0; i < m->n_rows; i++) s->data[l.posture + i] = NAN;
  frot_choose_first(m, s);
  int status = frot_settle_parameters(m, s, w, NULL);
  if (status != FROT_OK) return status;
  frot_accept_parameters(m, s);
  const double *experiment = s->data + l.experiment;
  double start = isnan(experiment[0]) ? 0 : experiment[0];
  s->tolerance = s->options.tolerance > 0 ? s->options.tolerance
                 : isnan(experiment[2])   ? 1e-8
                                          : experiment[2];
  s->h_max = experiment[1] > start ? experiment[1] - start : 1;
  if (m->time_dependent) s->h_max *= PART_OF_RUN;
  double *x = s->data + l.x;
  status = frot_initial_values(m, s, w, t, x, x + m->nq);
  if (status != FROT_OK) return status;
  status = frot_process_events(m, s, w, t, x, x + m->nq, 1, NULL);
  if (status != FROT_OK && status != FROT_TERMINATED) return status;
  frot_make_instant(m, s, w, t, x);
  const double *quadratures = x + m->nq + m->nv; /* what impacts at the start have taken */
  s->energy = energy_now(m, s, w, x) + quadratures[0] - quadratures[1];
  if (status == FROT_TERMINATED) return FROT_OK; /* told by the first frot_advance */
  status = frot_first_step(m, s, w);
  if (status != FROT_OK) return status;
  s->phase = FROT_RUNNING;
  return FROT_OK;
}

int frot_start(const frot_model *m, frot_state *s, frot_work *w, double t,
               const frot_options *options) {
  frot_bind_work(m, w);
  int status = start(m, s, w, t, options);
  return frot_name_singular_figure(m, s, w, status, s->data + w->layout.x);
}

/* Conditions whose value has changed sign without the motion passing through it. */
static int fire_changed_conditions(const frot_model *m, frot_state *s, frot_work *w) {
  frot_layout l = frot_layout_of(m);
  const double *x = s->data + l.x, *d = s->data + l.d;
  int status = frot_evaluate_conditions(m, s, w, s->t, x, x + m->nq);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, s->t);
  for (int j = 0; j < m->n_conditions; j++) {
    int holds = m->condition_strict[j] ? w->core.condition[j] > 0 : w->core.condition[j] >= 0;
    s->data[l.fired + frot_condition_guard(m) + j] = holds != (d[j] != 0);
  }
  return FROT_OK;
}

/* Let the new values take effect on what holds at the states x; a change that cannot be is taken
 * back. */
static int change_given(const frot_model *m, frot_state *s, frot_work *w, const double *x,
                        frot_recorder *recorder) {
  const double *q = x, *v = x + m->nq;
  frot_swap_inputs(m, s);
  int status = frot_note_contacts_before_change(m, s, w, s->t, q, v);
  frot_swap_inputs(m, s);
  if (status == FROT_OK) status = frot_settle_parameters(m, s, w, NULL);
  if (status == FROT_OK) status = frot_check_contacts_after_change(m, s, w, s->t, q, v, recorder);
  if (status == FROT_CHECK || status == FROT_REFUSED)
    frot_restore_parameters(m, s, w);
  else if (status == FROT_OK)
    frot_accept_parameters(m, s);
  return status;
}

static int settle(const frot_model *m, frot_state *s, frot_work *w, frot_recorder *recorder) {
  if (s->phase == FROT_ENDED) return FROT_TERMINATED;
  if (s->phase != FROT_RUNNING) return s->fault.status;
  if (!s->changed) return FROT_OK;
  frot_bind_work(m, w);
  frot_layout l = frot_layout_of(m);
  frot_segment g = frot_segment_at(m, s->data + l.segment);
  double *x = w->step.z1;
  frot_interpolate(m, &g, s->t, x);
  frot_guess_unknowns(m, w, &g, s->t);
  frot_swap_inputs(m, s);
  double before = energy_now(m, s, w, x);
  frot_swap_inputs(m, s);
  s->changed = 0;
  int status = change_given(m, s, w, x, recorder);
  if (status != FROT_OK) return status;
  memcpy(s->data + l.x, x, sizeof(double) * (size_t)l.nx);
  x = s->data + l.x;
  status = fire_changed_conditions(m, s, w);
  if (status != FROT_OK) return status;
  double events = s->energy; /* what the text's events change is added there */
  status = frot_process_events(m, s, w, s->t, x, x + m->nq, 0, recorder);
  if (status != FROT_OK && status != FROT_TERMINATED) return status;
  frot_make_instant(m, s, w, s->t, x);
  s->energy = events + energy_now(m, s, w, x) - before;
  s->pending = 0, s->second = -1; /* what the step led to comes no more */
  return status;
}

int frot_settle(const frot_model *m, frot_state *s, frot_work *w) { return settle(m, s, w, NULL); }

/* The condition of the text that fires now, -1 where none does. */
static int condition_at_fault(const frot_model *m, const frot_state *s) {
  const double *fired = s->data + frot_layout_of(m).fired + frot_condition_guard(m);
  for (int j = 0; j < m->n_conditions; j++)
    if (fired[j] != 0) return j;
  return -1;
}

/* What no modes last after: the contact that carries most there is told, whatever led to it. */
static int fail_at_event(const frot_model *m, frot_state *s, frot_work *w, double t) {
  const double *x = s->data + w->layout.x;
  memcpy(w->blocks.y, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
  frot_slope(m, s, w, t, x, frot_stage(w, 0));
  w->step.worst = w->reactions.jammed = -1;
  return frot_fail_step(m, s, w, FROT_DIVERGE, t, 0, x, x + m->nq);
}

/* What the guards fired at the end of the segment bring about. */
static int happen_at_end(const frot_model *m, frot_state *s, frot_work *w,
                         frot_recorder *recorder) {
  frot_layout l = frot_layout_of(m);
  frot_segment g = frot_segment_at(m, s->data + l.segment);
  double *x = s->data + l.x;
  memcpy(w->blocks.y, s->data + l.y, sizeof(double) * (size_t)m->ny);
  int stays = s->crowded > RESTLESS && frot_find_sliding_equilibrium(m, s, w, *g.t1, x);
  int status = frot_fire_ends(m, s, w, g.t1, x, x + m->nq);
  if (status == FROT_OK && !stays) status = frot_pass_conditions(m, s, w, g.t1, x, x + m->nq);
  double t = *g.t1;
  if (status == FROT_OK) status = frot_process_events(m, s, w, t, x, x + m->nq, 0, recorder);
  memcpy(s->data + l.y, w->blocks.y, sizeof(double) * (size_t)m->ny);
  frot_see_other_system(s);
  if (s->noise_measured > 0) s->noise_measured = -1;
  frot_record_pending_events(m, s, recorder);
  if (status != FROT_TERMINATED) return status;
  s->t = t;
  frot_make_instant(m, s, w, t, x);
  return status;
}

/* The text has ended the run: its last instant is a segment of its own. */
static int end_of_run(const frot_model *m, frot_state *s, frot_work *w, frot_recorder *recorder) {
  if (recorder && recorder->segments && !s->ended_recorded) {
    if (!frot_has_room(m, recorder)) return FROT_FULL;
    frot_record(m, s, w, recorder, 0);
    s->ended_recorded = 1;
  }
  frot_record_pending_events(m, s, recorder);
  return FROT_TERMINATED;
}

int frot_advance(const frot_model *m, frot_state *s, frot_work *w, double t,
                 frot_recorder *recorder, frot_monitor monitor, void *context) {
  if (s->phase == FROT_FAULTED) return s->fault.status;
  if (s->phase == FROT_ENDED) {
    frot_bind_work(m, w);
    return end_of_run(m, s, w, recorder);
  }
  if (s->phase != FROT_RUNNING || !(t >= s->t)) return FROT_MISUSE;
  frot_bind_work(m, w);
  frot_layout l = frot_layout_of(m);
  frot_segment g = frot_segment_at(m, s->data + l.segment);
  if (s->changed) {
    int status = settle(m, s, w, recorder);
    if (status == FROT_TERMINATED) return end_of_run(m, s, w, recorder);
    if (status != FROT_OK) return status;
  }
  w->step.looked = t; /* settling binds the scratch memory again */
  while (*g.t1 <= t + FROT_SAME_INSTANT(t)) {
    if (recorder && (recorder->event_count + frot_events_at_once(m) > recorder->event_capacity ||
                     !frot_has_room(m, recorder)))
      return FROT_FULL;
    frot_record_pending_events(m, s, recorder);
    frot_record_settled_contacts(m, s, *g.t1, -1, recorder);
    int status = FROT_OK;
    long long events = s->statistics.events;
    if (s->pending) {
      frot_wake_all_islands(m, s, w);
      if (s->second >= 0)
        status = frot_fail(s, FROT_IMPACT, *g.t1, s->second, 0, -1, 0);
      else if (++s->crowded > CROWD && s->statistics.events == s->told &&
               condition_at_fault(m, s) < 0)
        status = fail_at_event(m, s, w, *g.t1);        /* the same modes again */
      else if (s->crowded > CROWD && s->fleeting >= 0) /* none holds longer than the instant */
        status = frot_fail(s, FROT_IMPASSE, *g.t1, s->fleeting, -1, -1, s->crowded);
      else if (s->crowded > CROWD)
        status = frot_fail(s, FROT_CHATTER, *g.t1, -1, condition_at_fault(m, s), -1,
                           s->statistics.events == s->told ? FROT_NO_TRUTH : s->crowded);
      else
        s->idle++, status = happen_at_end(m, s, w, recorder);
      if (s->statistics.events != events) s->idle = 0;
      s->pending = s->has_slope = 0;
      if (status == FROT_TERMINATED) return end_of_run(m, s, w, recorder);
    }
    long long steps = s->statistics.steps;
    const double *place = status == FROT_OK ? w->step.z1 : s->data + l.x;
    if (status == FROT_OK) status = frot_step(m, s, w, recorder);
    if (status != FROT_OK) {
      s->t = *g.t1;
      status = frot_name_singular_figure(m, s, w, status, place);
      return frot_report_unreachable(m, s, w, status);
    }
    if (s->statistics.steps == steps) continue;
    if (monitor && s->statistics.steps % MONITOR_EVERY == 0 && monitor(context, fmin(*g.t1, t))) {
      s->t = fmin(*g.t1, t);
      return FROT_STOPPED;
    }
  }
  s->t = fmax(t, *g.t0);
  frot_record_settled_contacts(m, s, s->t, -1, recorder);
  return FROT_OK;
}

int frot_energy(const frot_model *m, frot_state *s, frot_work *w, double balance[5]) {
  if (s->phase == FROT_CLEARED) return FROT_MISUSE;
  frot_bind_work(m, w);
  frot_layout l = frot_layout_of(m);
  frot_segment g = frot_segment_at(m, s->data + l.segment);
  frot_interpolate(m, &g, s->t, w->step.z1);
  frot_guess_unknowns(m, w, &g, s->t);
  double kinetic, mechanical = energy_at(m, s, w, w->step.z1, &kinetic);
  double dissipated = w->step.z1[m->nq + m->nv], work = w->step.z1[m->nq + m->nv + 1];
  balance[0] = mechanical - s->energy + dissipated - work;
  balance[1] = fmax(fmax(s->energy_scale, fmax(kinetic, fabs(mechanical - s->energy))),
                    fmax(fabs(dissipated), fabs(work)));
  balance[1] = fmax(balance[1], FROT_LEAST_ENERGY * s->energy_terms);
  balance[2] = mechanical;
  balance[3] = dissipated;
  balance[4] = work;
  return FROT_OK;
}
