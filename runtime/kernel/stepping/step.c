#include "stepping/step.h"

#include <math.h>
#include <string.h>

#include "stepping/attempt.h"
#include "model/sleeping.h"
#include "evaluation/fault_source.h"
#include "guards/conditions.h"
#include "singular/singular_posture.h"
#include "stepping/step_ends.h"
#include "stepping/error_estimate.h"
#include "guards/guard_crossing.h"
#include "guards/vanishing_slips.h"
#include "model/indexing.h"
#include "methods/jacobian.h"
#include "stepping/step_length.h"
#include "stepping/event_location.h"
#include "singular/undetermined_branch.h"
#include "guards/closest_features.h"
#include "guards/equal_curvature.h"
#include "stepping/posture_passage.h"
#include "constraints/projection.h"
#include "numerics/bernstein.h"
#include "model/segment.h"
#include "methods/error_scales.h"
#include "constraints/redundant_rows.h"
#include "methods/dormand_prince.h"
#include "methods/method_choice.h"
#include "methods/rate_rounding.h"
#include "recording/segment_store.h"
#include "numerics/tolerances.h"

/* What is left of the measure of rounding a step later, and steps that their error limits after
 * which it is measured though none of them fails. */
#define FORGET 0.99
#define MEASURED 64
/* Part of its length at least to which a step is shortened in which a guard seems to fall and does
 * not. */
#define SHORTER 0.25
/* Part of the step by which its end may be found after where it was looked for: further on, other
 * guards may have fallen before. */
#define STRAY 0.01
/* How much farther from zero than events are located a condition has left it. */
#define CLEAR 4
/* What is left at least of the length of calm steps after one that is shorter, and the part of the
 * time passed in short steps by which that length falls. */
#define CALM 0.5

/* Run the step again with the length h, with its dense output. */
static int run_again(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a, double h) {
  a->h = h, a->to_due = 0, a->dense = 1, a->beyond = a->refined = 0;
  int status = frot_run_stages(m, s, w, a->t, h);
  if (status != FROT_OK) return status;
  frot_measure_slips(m, s, w);
  frot_measure_end(m, s, w, a->t + h, w->step.z1);
  return frot_make_dense(m, s, w, a->t, h);
}

/* End the step where the first guard is crossed inside it. *guard is the one that does, or -1. A
 * guard may seem to fall, in a step that is long for it, where it only comes near zero: a step that
 * ends before it, or is much shorter, shows that it does not, and hides no other guard's fall. */
static int cut_at_event(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a,
                        int *guard) {
  int first = -1; /* the guard located before, in a step that crosses another */
  for (*guard = -1; a->guard >= 0;) {
    double longest = a->h;
    int crosses;
    if (a->theta * a->h <= FROT_LEAST_STEP * fmax(fabs(a->t), a->h)) {
      frot_fire_at_start(s, w, a->guard);
      return FROT_OK;
    }
    int status = frot_locate(m, s, w, a, &crosses);
    crosses &= a->h <= (a->theta + STRAY) * longest;
    double part = fmin(fmax(FROT_NEARLY * a->theta, SHORTER), FROT_NEARLY);
    if (status == FROT_OK && crosses && a->guard != first &&
        frot_crosses_other_gap_or_end(m, s, w, a->guard)) {
      first = a->guard;
      status = run_again(m, s, w, a, a->h);
      if (status != FROT_OK) return status;
      a->guard = frot_first_crossing(m, s, w, a->t, a->h, &a->theta);
      if (a->guard < 0) a->guard = first, a->theta = 1;
      continue;
    }
    if (status == FROT_OK && crosses) {
      *guard = a->guard, a->to_due = 0;
      return FROT_OK;
    }
    if (status == FROT_OK) status = run_again(m, s, w, a, part * longest);
    if (status != FROT_OK) return status;
    a->guard = frot_first_crossing(m, s, w, a->t, a->h, &a->theta);
  }
  return FROT_OK;
}

/* What a `when` waits for is no longer near where it was when it fired: event_iteration.c. Implicit
 * steps evaluate no guard at their stages, so that its polynomial is read. */
static void leave_near(const frot_model *m, frot_state *s, const frot_work *w, double h) {
  double *near = s->data + w->layout.near;
  for (int k = 0; k < w->guards.count; k++) {
    int j = w->guards.list[k] - frot_condition_guard(m);
    if (j < 0 || near[j] == 0) continue;
    double clear = CLEAR * FROT_GUARD_FLOOR * s->data[w->layout.scale_g + w->guards.list[k]];
    double g[7];
    if (s->implicit) frot_guard_polynomial(s, w, k, h, g);
    for (int i = 1; i <= DP_STAGES && near[j] != 0; i++) {
      double value =
          s->implicit ? frot_bernstein(g, i / (double)DP_STAGES) : frot_stage(w, i)[w->awake.n + k];
      if (value > clear) near[j] = 0;
    }
  }
}

/* Rounding that was measured is measured anew before long. */
static void forget_noise(const frot_model *m, frot_state *s, const frot_work *w) {
  const frot_awake_lists *now = w->awake.now;
  double *noise = s->data + w->layout.noise, *guards = noise + m->nq + m->nv;
  for (int k = 0; k < now->n - FROT_QUADRATURES; k++) noise[now->states[k]] *= FORGET;
  for (int k = 0; k < now->n_contacts; k++) guards[now->contacts[k]] *= FORGET;
  for (int k = 0; k < now->n_elements; k++)
    for (int i = 0; i < FROT_ELEMENT_GUARDS; i++)
      guards[frot_element_guard(m, now->elements[k]) + i] *= FORGET;
  for (int k = 0; k < now->n_located; k++)
    guards[frot_condition_guard(m) + now->located[k]] *= FORGET;
}

/* Record the step that was kept. If a time inside it is asked for and it has no dense output, make
 * that. Both leave other values in the scratch memory, so all that the step decides about the next
 * one comes before: the motion does not depend on the times that are asked for. */
static void show(const frot_model *m, frot_state *s, frot_work *w, const frot_attempt *a,
                 frot_recorder *recorder) {
  frot_segment g = frot_segment_at(m, s->data + w->layout.segment);
  frot_return_to_stages(w, a);
  if (recorder && recorder->segments) frot_record(m, s, w, recorder, !a->dense);
  if (!a->dense && *g.t1 > w->step.looked) frot_complete_dense_output(m, s, w, &g);
}

/* The state that has grown so far that its squares are no numbers, -1 if none has. */
static int grown(const frot_model *m, const double *x) {
  for (int i = 0; i < m->nq + m->nv; i++)
    if (fabs(x[i]) > FROT_LARGEST) return i;
  return -1;
}

/* The step that was kept ends at x: put that onto the relations; the slope there serves the next
 * step if nothing moved. */
static int land(const frot_model *m, frot_state *s, frot_work *w, const frot_attempt *a, double end,
                double *x) {
  const frot_layout *l = &w->layout;
  const frot_contact_mode *modes = (const void *)(s->data + l->modes);
  int moved = 0, lost = frot_undetermined_row(m, s, w, a->t, a->h), large = grown(m, x);
  if (large >= 0) return frot_fail(s, FROT_DIVERGE, end, -1, FROT_GROWS, large, x[large]);
  if (lost >= 0) return frot_fail(s, FROT_POSTURE, end, lost, -1, -1, a->h);
  int status = s->weak && w->step.near[DP_STAGES]
                   ? FROT_OK
                   : frot_project(m, s, w, end, x, x + m->nq, s->data + l->d, modes, NULL,
                                  s->data + l->frozen, &moved);
  if (status != FROT_OK) return frot_fail_step(m, s, w, status, end, a->h, x, x + m->nq);
  lost = moved ? frot_projection_loses_energy(m, s, w, end, a->h) : -1;
  if (lost >= 0) return frot_fail(s, FROT_POSTURE, end, lost, -1, -1, a->h);
  memcpy(s->data + l->y, w->blocks.y, sizeof(double) * (size_t)m->ny);
  frot_take_closer_features(m, s, w);
  s->has_slope = !moved && !s->pending && !s->spare_loops && w->nearer.count == 0;
  if (s->has_slope && frot_update_redundant_contacts(m, s, w)) s->has_slope = 0;
  if (s->has_slope) frot_turn_references_at_end(m, s, w, s->data + l->slope);
  if (!s->implicit) frot_keep_crossings(m, s, w, a->t, a->h);
  if (s->tied > 0) s->has_slope = 0; /* stages are put onto relations by the inertia at the start */
  if (!s->pending && !s->implicit && frot_note_resting_islands(m, s, w, x))
    s->has_slope = 0; /* other guards are listed */
  return FROT_OK;
}

/* An error that is rounding grows with the step, not with its ninth power: it may keep steps short
 * without one that fails. */
static void look_at_noise(const frot_model *m, frot_state *s, frot_work *w, const frot_attempt *a) {
  if (s->implicit || !(a->ratio > FROT_LIMITING)) return;
  if (++s->unmeasured < MEASURED && !s->noise_shown) return;
  s->unmeasured = 0;
  frot_measure_rounding(m, s, w, a->t + a->h, 0);
}

/* Take the step: it becomes the current segment. */
static int keep(const frot_model *m, frot_state *s, frot_work *w, const frot_attempt *a, int guard,
                frot_recorder *recorder) {
  const frot_layout *l = &w->layout;
  double *x = s->data + l->x, *slope = s->data + l->slope;
  double end = a->to_due ? s->due : a->t + (a->h + a->beyond);
  s->statistics.steps++;
  if (w->reactions.sliding_spring > 0)
    s->statistics.springs++, s->statistics.spring = w->reactions.sliding_spring - 1;
  w->reactions.sliding_spring = 0;
  s->statistics.implicit_steps += s->implicit, s->was_implicit = s->implicit;
  memset(s->data + l->fresh, 0, sizeof(double) * (size_t)m->n_conditions);
  frot_follow_rate_rounding(m, s, w, a->h);
  frot_update_sizes(m, s, w, w->step.z1, frot_stage(w, DP_STAGES) + w->awake.n);
  frot_update_state_sizes(s, w, w->step.z1);
  leave_near(m, s, w, a->h);
  if (guard >= 0) s->last_ratio = 0;
  if (guard >= 0) frot_fire_guards(m, s, w, guard, a->t, a->h);
  if (a->to_due) frot_fire_time_event(m, s);
  forget_noise(m, s, w);
  frot_keep_step(m, s, w, a->t, a->h, end);
  frot_keep_friction(s, w);
  frot_copy_awake(w, w->step.z1, x);
  frot_unpack_awake(w, frot_stage(w, DP_STAGES), slope);
  memcpy(slope + l->nx, frot_stage(w, DP_STAGES) + w->awake.n,
         sizeof(double) * (size_t)w->guards.count);
  memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)m->ny);
  int begun = frot_end_slips(m, s, w);
  int status = land(m, s, w, a, end, x);
  if (begun) s->has_slope = 0;
  if (status == FROT_OK && !s->pending) look_at_noise(m, s, w, a);
  show(m, s, w, a, recorder);
  if (status != FROT_OK) return status;
  frot_choose_next(m, s, a->stiff);
  s->calm = fmax(s->h, fmax(CALM * s->calm, s->calm - CALM * a->h));
  if (s->implicit) frot_wake_within_step(m, s, w);
  if (end > s->crowded_since + FROT_CROWDED_STEPS * s->h_max) {
    s->crowded_since = end, s->crowded = s->idle = 0;
    s->told = s->statistics.events;
  }
  return FROT_OK;
}

/* What the implicit method cannot do here the explicit one is to do, if there is one. */
static int go_explicitly(const frot_model *m, frot_state *s) {
  if (!s->implicit || (!frot_has_motion(m) && m->method != FROT_AUTO)) return 0;
  frot_pass_explicitly(s);
  return 1;
}

/* End the step where another place of a contact that may part comes to count: closest_features.h.
 */
static int cut_where_nearer(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a,
                            int *guard) {
  for (double part = 0; part < 1 && !s->pending && *guard < 0;) {
    int status = frot_find_closer_features(m, s, w, a->t, a->h, &part);
    if (status == FROT_OK && part < 1 && !(part * a->h <= FROT_LEAST_STEP * fmax(fabs(a->t), a->h)))
      status = run_again(m, s, w, a, part * a->h);
    else
      part = 1;
    if (status != FROT_OK || part == 1) return status;
    w->nearer.count = 0;
    a->guard = frot_first_crossing(m, s, w, a->t, a->h, &a->theta);
    status = cut_at_event(m, s, w, a, guard);
    if (status != FROT_OK) return status;
  }
  return FROT_OK;
}

/* End the step where figures that touch come to bend alike: equal_curvature.h. *alike <- whether it
 * ends there. */
static int cut_where_alike(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a,
                           int *guard, int *alike) {
  double part;
  int status = frot_find_equal_curvature(m, s, w, a->t, a->h, &part);
  *alike = 0;
  if (status != FROT_OK || part == 1) return status;
  if (part * a->h <= FROT_LEAST_STEP * fmax(fabs(a->t), a->h)) return FROT_SINGULAR;
  w->nearer.count = 0;
  status = run_again(m, s, w, a, part * a->h);
  if (status != FROT_OK) return status;
  a->guard = frot_first_crossing(m, s, w, a->t, a->h, &a->theta);
  status = cut_at_event(m, s, w, a, guard);
  *alike = *guard < 0 && !s->pending;
  return status;
}

/* Find the step's length and its end, and take it. */
static int take(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a,
                frot_recorder *recorder) {
  int guard, alike = 0, status = frot_find_length(m, s, w, a);
  w->nearer.count = 0;
  if (status != FROT_OK || s->pending) return status;
  status = cut_at_event(m, s, w, a, &guard);
  if (status == FROT_DIVERGE && go_explicitly(m, s)) { /* no stages of a step that ends there */
    a->h = a->first, a->to_due = a->h >= s->due - a->t, a->guard = -1, a->looks = 0;
    status = frot_find_length(m, s, w, a);
    if (status != FROT_OK || s->pending) return status;
    status = cut_at_event(m, s, w, a, &guard);
  }
  if (status == FROT_OK) status = cut_where_nearer(m, s, w, a, &guard);
  if (status == FROT_OK && !s->pending) status = cut_where_alike(m, s, w, a, &guard, &alike);
  if (status != FROT_OK)
    return frot_fail_step(m, s, w, status, a->t, a->h, w->step.z1, w->step.z1 + m->nq);
  if (s->pending) return FROT_OK;
  status = keep(m, s, w, a, guard, recorder);
  return status == FROT_OK && alike ? frot_fail(s, FROT_SINGULAR, a->t + a->h, -1, 0, -1, a->h)
                                    : status;
}

static int step(const frot_model *m, frot_state *s, frot_work *w, frot_recorder *recorder) {
  frot_attempt a = frot_attempt_from(*frot_segment_at(m, s->data + w->layout.segment).t1);
  if (s->due <= a.t) {
    frot_fire_time_event(m, s);
    return FROT_OK;
  }
  int status = frot_begin_step(m, s, w, &a);
  if (status == FROT_NAN && go_explicitly(m, s))
    status = frot_begin_step(m, s, w, &a); /* no Jacobian */
  if (status != FROT_OK)
    return frot_fail_step(m, s, w, status, a.t, 0, w->step.z1, w->step.z1 + m->nq);
  if (!s->pending) status = take(m, s, w, &a, recorder);
  frot_forget_redundant_rows(w);
  w->reactions.follow = 0;
  return status;
}

int frot_step(const frot_model *m, frot_state *s, frot_work *w, frot_recorder *recorder) {
  frot_enter_sleep(m, s, w);
  int status = step(m, s, w, recorder);
  frot_leave_sleep(w);
  return status;
}
