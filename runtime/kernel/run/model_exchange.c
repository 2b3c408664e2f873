#include "run/model_exchange.h"

#include <math.h>
#include <string.h>

#include "constraints/projection.h"
#include "constraints/redundant_rows.h"
#include "evaluation/fault_source.h"
#include "evaluation/slip_frames.h"
#include "evaluation/term_sizes.h"
#include "events/event_iteration.h"
#include "events/feature_edges.h"
#include "events/parameter_change.h"
#include "events/sliding_equilibrium.h"
#include "guards/conditions.h"
#include "guards/vanishing_slips.h"
#include "methods/dormand_prince.h"
#include "methods/right_hand_side.h"
#include "model/indexing.h"
#include "model/segment.h"
#include "model/sleeping.h"
#include "numerics/tolerances.h"
#include "reactions/switching_functions.h"
#include "stepping/step_ends.h"

/* Rounds of events at one instant after which they will not settle; those after which the text's
 * conditions may rest at zero; time beyond which events no longer crowd, in longest steps. */
#define CROWD 100
#define RESTLESS 1
#define CROWDED 1e-9
/* Distance from the relations that is projected, in tolerances. */
#define DRIFT 100
/* Part of its usual speed below which a slip of several components is none, in tolerances; above
 * which one that has begun goes where its speed says. */
#define ENDS 1
#define BEGUN 3
/* Part of the time within which an instant of the text is the one set from outside. */
#define ROUNDING 1e-9

int frot_exchange_states(const frot_model *m) { return m->nq + m->nv + FROT_QUADRATURES; }

int frot_exchange_guards(const frot_model *m) { return frot_condition_guard(m) + m->n_located; }

static frot_contact_mode *modes_of(frot_state *s, const frot_work *w) {
  return (frot_contact_mode *)(void *)(s->data + w->layout.modes);
}

/* Make the states of the run the instant t. */
static void stand(const frot_model *m, frot_state *s, frot_work *w, double t) {
  const frot_layout *l = &w->layout;
  memcpy(w->blocks.y, s->data + l->y, sizeof(double) * (size_t)m->ny);
  frot_make_instant(m, s, w, t, s->data + l->x);
  memcpy(frot_segment_at(m, s->data + l->segment).spare, s->data + l->spare,
         sizeof(double) * (size_t)m->n_rows);
  s->pending = 0;
}

void frot_exchange_place(const frot_model *m, frot_state *s, frot_work *w, double t,
                         const double *x) {
  frot_bind_work(m, w);
  if (x) memcpy(s->data + w->layout.x, x, sizeof(double) * (size_t)w->layout.nx);
  s->t = t;
  stand(m, s, w, t);
}

void frot_exchange_read(const frot_model *m, frot_state *s, double *x) {
  frot_segment g = frot_segment_at(m, s->data + frot_layout_of(m).segment);
  frot_interpolate(m, &g, s->t, x);
}

void frot_exchange_nominals(const frot_model *m, const frot_state *s, double *x) {
  const double *given = s->data + frot_layout_of(m).nominal;
  for (int j = 0; j < frot_exchange_states(m); j++) x[j] = j < m->nq && given[j] > 0 ? given[j] : 1;
}

/* Whether an element is the first of a slip of several components. */
static int slips_in_space(const frot_model *m, const frot_contact_mode *modes, int e) {
  const frot_element *element = &m->elements[e];
  return element->parts > 1 && element->part == 0 && modes[element->contact].closed &&
         frot_element_mode(m, modes, e)->friction > FROT_STICK;
}

/* Below which the slip of an element of several components is none. */
static double least_slip(const frot_model *m, const frot_state *s, const frot_work *w, int e) {
  const double *usual = s->data + w->layout.scale_x + m->nq;
  return ENDS * s->tolerance * frot_row_size(m, w, m->elements[e].row, usual);
}

/* Its guard: how far it is from where it ends, or from where its beginning does. */
static double guard_in_space(const frot_model *m, const frot_state *s, const frot_work *w,
                             const frot_contact_mode *modes, int e) {
  double slip = w->core.rate[m->elements[e].row], least = least_slip(m, s, w, e);
  return frot_element_mode(m, modes, e)->starts ? BEGUN * least - slip : slip - least;
}

int frot_exchange_rates(const frot_model *m, frot_state *s, frot_work *w, double *rates,
                        double *guards) {
  frot_bind_work(m, w);
  frot_segment g = frot_segment_at(m, s->data + w->layout.segment);
  double *x = w->step.z1, *slope = frot_stage(w, 0);
  frot_interpolate(m, &g, s->t, x);
  frot_guess_unknowns(m, w, &g, s->t);
  frot_list_guards(m, s, w, g.modes);
  memset(w->reactions.carried, 0, (size_t)m->n_rows);
  frot_use_redundant_rows(m, w, g.spare);
  int status = frot_derivatives(m, s, w, s->t, x, g.d, g.modes, g.frozen, slope);
  frot_forget_redundant_rows(w);
  if (status != FROT_OK) return status;
  frot_unpack_awake(w, slope, rates);
  for (int j = 0; j < frot_exchange_guards(m); j++) guards[j] = 1;
  for (int k = 0; k < w->guards.count; k++) guards[w->guards.list[k]] = slope[w->awake.n + k];
  for (int e = 0; e < m->n_elements; e++)
    if (slips_in_space(m, g.modes, e))
      guards[frot_element_guard(m, e)] = guard_in_space(m, s, w, g.modes, e);
  return frot_all_finite(rates, w->layout.nx) ? FROT_OK : FROT_NAN;
}

int frot_exchange_inputs(const frot_model *m, frot_state *s, frot_work *w) {
  if (!s->changed) return FROT_OK;
  int status = frot_settle_parameters(m, s, w, NULL);
  if (status != FROT_OK) {
    frot_restore_parameters(m, s, w);
    return status;
  }
  frot_accept_parameters(m, s);
  s->changed = 0;
  return FROT_OK;
}

/* The slope at the states of the run, with the sizes of values and guards there. */
static int evaluate(const frot_model *m, frot_state *s, frot_work *w) {
  const frot_layout *l = &w->layout;
  double *x = s->data + l->x;
  s->has_slope = 0;
  int status = frot_start_slope(m, s, w, s->t);
  if (status != FROT_OK) return frot_fail_step(m, s, w, status, s->t, 0, x, x + m->nq);
  frot_unpack_awake(w, frot_stage(w, 0), s->data + l->slope);
  memcpy(s->data + l->slope + l->nx, frot_stage(w, 0) + w->awake.n,
         sizeof(double) * (size_t)w->guards.count);
  return FROT_OK;
}

/* Put x onto the relations that hold. */
static int project(const frot_model *m, frot_state *s, frot_work *w, double *x, int *moved) {
  const frot_layout *l = &w->layout;
  frot_use_redundant_rows(m, w, s->data + l->spare);
  int status = frot_project(m, s, w, s->t, x, x + m->nq, s->data + l->d, modes_of(s, w), NULL,
                            s->data + l->frozen, moved);
  frot_forget_redundant_rows(w);
  if (status != FROT_OK) return frot_fail_step(m, s, w, status, s->t, 0, x, x + m->nq);
  return FROT_OK;
}

/* The directions of slips of several components are those of their speeds. */
static void follow_slips(const frot_model *m, frot_state *s, frot_work *w) {
  frot_contact_mode *modes = modes_of(s, w);
  frot_measure_slips(m, s, w);
  for (int e = 0; e < m->n_elements; e++) {
    if (!slips_in_space(m, modes, e)) continue;
    frot_contact_mode *mode = &modes[m->n_contacts + e];
    if (mode->starts && guard_in_space(m, s, w, modes, e) > 0) continue;
    mode->starts = 0;
    s->data[w->layout.slip + e] = w->core.rate[m->elements[e].row];
    for (int k = 0; k < m->elements[e].parts; k++)
      s->data[w->layout.along + 2 * (e + k)] = w->guards.end_direction[2 * (e + k)];
  }
}

int frot_exchange_accept(const frot_model *m, frot_state *s, frot_work *w, int *event) {
  frot_bind_work(m, w);
  const frot_layout *l = &w->layout;
  const double *x = s->data + l->x, *size = s->data + l->scale_x;
  double *there = w->step.z1;
  int moved;
  *event = 0;
  int status = evaluate(m, s, w);
  if (status != FROT_OK) return status;
  follow_slips(m, s, w);
  s->from_posture = 0, s->statistics.steps++;
  memcpy(there, x, sizeof(double) * (size_t)l->nx);
  status = project(m, s, w, there, &moved);
  if (status != FROT_OK) return status;
  for (int j = 0; j < m->nq + m->nv; j++) {
    double usual = size[j] > 0 ? size[j] : 1;
    *event |= fabs(there[j] - x[j]) > DRIFT * s->tolerance * usual;
  }
  stand(m, s, w, s->t);
  return FROT_OK;
}

/* Fire what has come to zero: with `raw`, before the states are put onto the relations, what is
 * below zero; at the `first` round what is zero to rounding, but conditions, which only their
 * values change; later what is clearly below. Returns how many. */
static int fire(const frot_model *m, frot_state *s, frot_work *w, int first, int raw) {
  const frot_layout *l = &w->layout;
  const double *guards = s->data + l->slope + l->nx;
  const frot_contact_mode *modes = modes_of(s, w);
  double *fired = s->data + l->fired;
  int count = 0;
  for (int k = 0; k < w->guards.count; k++) {
    int j = w->guards.list[k], is_condition = j >= frot_condition_guard(m);
    double zero = FROT_GUARD_FLOOR * s->data[l->scale_g + j];
    double level = !first ? -zero : raw || is_condition ? 0 : zero;
    if (fired[j] != 0 || !(first ? guards[k] <= level : guards[k] < level)) continue;
    fired[j] = first ? 1 : FROT_AT_START, count++;
  }
  for (int e = 0; e < m->n_elements && first; e++) {
    int j = frot_element_guard(m, e);
    if (fired[j] != 0 || !slips_in_space(m, modes, e) || modes[m->n_contacts + e].starts) continue;
    if (guard_in_space(m, s, w, modes, e) <= 0) fired[j] = FROT_SLIP_ENDED, count++;
  }
  return count;
}

/* Fire the conditions that time changes now, and those that only inputs change. */
static int fire_others(const frot_model *m, frot_state *s, frot_work *w) {
  const frot_layout *l = &w->layout;
  const double *x = s->data + l->x, *d = s->data + l->d;
  double *fired = s->data + l->fired + frot_condition_guard(m);
  int count = 0;
  if (s->due <= s->t + ROUNDING * frot_size_of_time(s->t, s->h_max)) {
    frot_fire_time_event(m, s);
    count++;
  }
  if (m->n_conditions == m->n_located + m->n_timed) return count;
  if (frot_evaluate_conditions(m, s, w, s->t, x, x + m->nq) != FROT_OK) return count;
  for (int j = m->n_located + m->n_timed; j < m->n_conditions; j++) {
    double value = w->core.condition[j];
    int holds = m->condition_strict[j] ? value > 0 : value >= 0;
    if (holds != (d[j] != 0)) fired[j] = 1, count++;
  }
  return count;
}

/* What has fired happens. Time is the integrator's: the roundings by which the kernel passes a
 * condition move the states alone. */
static int happen(const frot_model *m, frot_state *s, frot_work *w, frot_recorder *recorder) {
  const frot_layout *l = &w->layout;
  double *x = s->data + l->x, t = fmax(s->t, s->due <= s->t * (1 + ROUNDING) ? s->due : s->t);
  memcpy(w->blocks.y, s->data + l->y, sizeof(double) * (size_t)m->ny);
  int stays = s->crowded > RESTLESS && frot_find_sliding_equilibrium(m, s, w, t, x);
  int status = frot_fire_ends(m, s, w, &t, x, x + m->nq);
  if (status == FROT_OK && !stays) status = frot_pass_conditions(m, s, w, &t, x, x + m->nq);
  if (status == FROT_OK) status = frot_process_events(m, s, w, t, x, x + m->nq, 0, recorder);
  memcpy(s->data + l->y, w->blocks.y, sizeof(double) * (size_t)m->ny);
  return status;
}

/* Events at one instant are counted. */
static void count_events(frot_state *s) {
  if (s->t > s->crowded_since + CROWDED * s->h_max) {
    s->crowded_since = s->t, s->crowded = s->idle = 0;
    s->told = s->statistics.events;
  }
  s->crowded++;
}

int frot_exchange_event(const frot_model *m, frot_state *s, frot_work *w, int *moved,
                        frot_recorder *recorder) {
  if (s->phase == FROT_ENDED) return FROT_TERMINATED;
  if (s->phase != FROT_RUNNING) return s->fault.status;
  frot_bind_work(m, w);
  double *x = s->data + w->layout.x;
  int status = evaluate(m, s, w), projected = 0, happened = 0;
  if (status == FROT_OK) {
    fire(m, s, w, 1, 1);
    follow_slips(m, s, w);
    status = project(m, s, w, x, &projected);
  }
  for (int round = 0; status == FROT_OK; round++) {
    status = evaluate(m, s, w);
    if (status != FROT_OK) break;
    int others = round == 0 ? fire_others(m, s, w) : 0;
    fire(m, s, w, round == 0, 0);
    int any = others;
    for (int j = 0; j < w->layout.nf; j++) any |= s->data[w->layout.fired + j] != 0;
    if (!any) break;
    if (round == CROWD) return frot_fail(s, FROT_CHATTER, s->t, -1, 0, -1, round);
    count_events(s);
    happened = 1;
    status = happen(m, s, w, recorder);
  }
  *moved = projected || happened;
  if (status != FROT_OK && status != FROT_TERMINATED) return status;
  stand(m, s, w, s->t);
  return status;
}
