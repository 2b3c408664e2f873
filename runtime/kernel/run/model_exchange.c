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
#include "recording/event_log.h"
#include "reactions/switching_functions.h"
#include "run/exchange_falls.h"
#include "run/exchange_guards.h"
#include "run/exchange_meetings.h"
#include "run/exchange_slips.h"
#include "stepping/step_ends.h"

/* Rounds of events at one instant after which they will not settle; those after which the text's
 * conditions may rest at zero; time beyond which events no longer crowd, in longest steps. */
#define CROWD 100
#define RESTLESS 1
#define CROWDED 1e-9
/* Distance from the relations that is projected, in tolerances. */
#define DRIFT 100
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

void frot_exchange_sizes(const frot_model *m, const frot_state *s, double *x) {
  const double *met = s->data + frot_layout_of(m).scale_x;
  frot_exchange_nominals(m, s, x);
  for (int j = 0; j < frot_exchange_states(m); j++)
    x[j] = j < m->nq + m->nv ? fmax(x[j], met[j]) : INFINITY;
}

/* Evaluate where an event may be behind. */
static void look_ahead(frot_work *w) { w->reactions.ahead = 1, w->reactions.beyond = -1; }

int frot_exchange_values(const frot_model *m, frot_state *s, frot_work *w, double *values) {
  look_ahead(w);
  int status = frot_values(m, s, w, values);
  w->reactions.ahead = 0;
  return status;
}

/* The slope at x in the current modes. */
static int slope_at(const frot_model *m, frot_state *s, frot_work *w, const frot_segment *g,
                    const double *x) {
  look_ahead(w);
  int status = frot_derivatives(m, s, w, s->t, x, g->d, g->modes, g->frozen, frot_stage(w, 0));
  w->reactions.ahead = 0;
  return status;
}

/* The slope at the states put onto the relations, and figures out of each other, where these are
 * near. */
static int slope_on_relations(const frot_model *m, frot_state *s, frot_work *w,
                              const frot_segment *g, double *x) {
  int moved = 0;
  int status = frot_project(m, s, w, s->t, x, x + m->nq, g->d, g->modes, NULL, g->frozen, &moved);
  if (status == FROT_OK) status = frot_put_out(m, s, w, x, x + m->nq, &moved);
  if (status == FROT_OK && !moved && !w->core.frame) return FROT_OK; /* the same evaluation */
  if (status != FROT_OK) frot_interpolate(m, g, s->t, x);
  return slope_at(m, s, w, g, x);
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
  int status = slope_at(m, s, w, &g, x);
  frot_unpack_awake(w, slope, rates);
  if (status == FROT_OK) status = slope_on_relations(m, s, w, &g, x);
  frot_forget_redundant_rows(w);
  if (status != FROT_OK) return status;
  for (int j = 0; j < frot_exchange_guards(m); j++) guards[j] = 1;
  for (int k = 0; k < w->guards.count; k++) {
    int j = w->guards.list[k];
    guards[j] = frot_indicator(m, s, w, j, slope[w->awake.n + k]);
  }
  for (int e = 0; e < m->n_elements; e++)
    if (frot_slips_outside(m, g.modes, e))
      guards[frot_element_guard(m, e)] = frot_indicator_in_space(m, s, w, g.modes, e);
  frot_mark_beyond(m, w, g.modes, guards);
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
  look_ahead(w);
  int status = frot_start_slope(m, s, w, s->t);
  w->reactions.ahead = 0;
  if (status != FROT_OK) return frot_fail_step(m, s, w, status, s->t, 0, x, x + m->nq);
  frot_unpack_awake(w, frot_stage(w, 0), s->data + l->slope);
  memcpy(s->data + l->slope + l->nx, frot_stage(w, 0) + w->awake.n,
         sizeof(double) * (size_t)w->guards.count);
  return FROT_OK;
}

/* Put the states of the run onto the relations that hold, by the rows that are followed: which of
 * them depend on others is seen there alone. Fires the guards below zero before, if `fires`. */
static int project(const frot_model *m, frot_state *s, frot_work *w, int fires, int *moved) {
  const frot_layout *l = &w->layout;
  const double *frozen = s->data + l->frozen;
  double *x = s->data + l->x, *slope = frot_stage(w, 0);
  int met = 0;
  for (int k = 0; k < m->nv; k++)
    if (frozen[k] != 0) x[m->nq + k] = 0; /* the other integrator has left rounding */
  memcpy(w->blocks.y, s->data + l->y, sizeof(double) * (size_t)m->ny);
  memset(w->reactions.carried, 0, (size_t)m->n_rows);
  memset(w->search.zero, 0, (size_t)m->n_elements);
  frot_list_guards(m, s, w, modes_of(s, w));
  frot_use_redundant_rows(m, w, s->data + l->spare);
  int status = frot_project(m, s, w, s->t, x, x + m->nq, s->data + l->d, modes_of(s, w), NULL,
                            frozen, moved);
  if (status == FROT_OK) status = frot_put_out(m, s, w, x, x + m->nq, moved);
  if (fires && status == FROT_OK) {
    look_ahead(w);
    status = frot_slope(m, s, w, s->t, x, slope);
    w->reactions.ahead = 0;
    if (status == FROT_OK) frot_fire_below(m, s, w, slope + w->awake.n);
    frot_unpack_awake(w, slope, s->data + l->slope);
    if (status == FROT_OK) frot_fire_falling(m, s, w, x);
    if (status == FROT_OK) frot_put_meetings(m, s, w, x, x + m->nq, &met);
  }
  if (status == FROT_OK) status = frot_stop_slips(m, s, w, x, moved);
  *moved |= met;
  frot_forget_redundant_rows(w);
  if (status != FROT_OK) return frot_fail_step(m, s, w, status, s->t, 0, x, x + m->nq);
  return FROT_OK;
}

int frot_exchange_accept(const frot_model *m, frot_state *s, frot_work *w, int *event) {
  frot_bind_work(m, w);
  const frot_layout *l = &w->layout;
  double *x = s->data + l->x, *size = w->step.z;
  const double *given = frot_segment_at(m, s->data + l->segment).x0;
  int moved;
  *event = 0;
  int status = project(m, s, w, 0, &moved);
  if (status == FROT_OK) status = evaluate(m, s, w);
  if (status != FROT_OK) return status;
  frot_see_above(m, s, w, s->data + l->slope + l->nx);
  *event = frot_has_fallen_on(m, s, w, s->data + l->slope + l->nx);
  *event |= w->reactions.beyond >= 0;
  frot_follow_slips(m, s, w);
  s->from_posture = 0, s->statistics.steps++;
  double drift = 0;
  frot_exchange_sizes(m, s, size);
  for (int j = 0; j < m->nq + m->nv; j++) drift = fmax(drift, fabs(given[j] - x[j]) / size[j]);
  s->step_drift = fmax(s->step_drift, drift - s->drift);
  s->drift = drift;
  *event |= drift > DRIFT * s->tolerance;
  memcpy(x, given, sizeof(double) * (size_t)l->nx);
  stand(m, s, w, s->t);
  return FROT_OK;
}

void frot_exchange_begin(const frot_model *m, frot_state *s, frot_work *w) {
  if (s->phase != FROT_RUNNING) return;
  frot_bind_work(m, w);
  if (evaluate(m, s, w) == FROT_OK)
    frot_note_below(m, s, w, s->data + w->layout.slope + w->layout.nx);
  stand(m, s, w, s->t);
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
  frot_record_settled_contacts(m, s, INFINITY, -1, recorder); /* time is another integrator's */
  memcpy(s->data + l->y, w->blocks.y, sizeof(double) * (size_t)m->ny);
  return status;
}

/* Slips that a posture takes through zero go on; evaluate again. */
static int let_slips_pass(const frot_model *m, frot_state *s, frot_work *w) {
  frot_use_redundant_rows(m, w, s->data + w->layout.spare);
  int any = frot_let_slips_pass(m, s, w, s->data + w->layout.x);
  frot_forget_redundant_rows(w);
  return any ? evaluate(m, s, w) : FROT_OK;
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
  const double *guards = s->data + w->layout.slope + w->layout.nx;
  int projected = 0, happened = 0, status = project(m, s, w, 1, &projected);
  for (int round = 0; status == FROT_OK; round++) {
    status = evaluate(m, s, w);
    if (status != FROT_OK) break;
    int any = 0;
    if (round == 0) {
      frot_follow_slips(m, s, w);
      frot_fire_in_space(m, s, w);
      status = let_slips_pass(m, s, w);
      any = frot_fire_others(m, s, w);
    } else {
      frot_fire_at_once(m, s, w, guards);
      frot_fire_falling(m, s, w, s->data + w->layout.x);
    }
    if (status != FROT_OK) break;
    frot_look_beyond(m, s, w);
    any |= frot_end_beyond(s, w);
    for (int j = 0; j < w->layout.nf; j++) any |= s->data[w->layout.fired + j] != 0;
    if (!any) break;
    if (round == CROWD) return frot_fail(s, FROT_CHATTER, s->t, -1, 0, -1, round);
    count_events(s);
    happened = 1;
    status = happen(m, s, w, recorder);
  }
  s->unseen = s->drift = 0;
  *moved = projected || happened;
  if (status == FROT_OK && happened) frot_note_below(m, s, w, guards);
  if (status != FROT_OK && status != FROT_TERMINATED) return status;
  stand(m, s, w, s->t);
  return status;
}
