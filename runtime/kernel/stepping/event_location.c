#include "stepping/event_location.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "model/sleeping.h"
#include "stepping/step_ends.h"
#include "guards/guard_crossing.h"
#include "model/indexing.h"
#include "reactions/switching_functions.h"
#include "methods/jacobian.h"
#include "methods/right_hand_side.h"
#include "constraints/projection.h"
#include "numerics/bernstein.h"
#include "methods/dormand_prince.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

/* Passes of the search, and those after which it ends where the guard is as good as zero. */
#define PASSES 60
#define ENOUGH 12
/* Part of what lies between where a guard has not fallen and where it has that a pass leaves at
 * most, or the next one takes the middle. */
#define HALVES 0.5
/* Part of the step on either side of a root over which the guard's slope is taken, and of the way
 * to the root at most. */
#define SPAN 1e-4
#define SPAN_OF_WAY 0.0625
/* Part of a guard above its rounding that a pass must leave at most, once it is as good as zero; as
 * many passes in a row that leave more end the search. */
#define STALLS 0.1
#define STALLED 4
/* Stages without weight in the dense output: room for that slope, its rate, and the end of the
 * stages. */
enum { AT_END = 2, RATE_AT_END, END };

/* Move the end of the step onto the relations and evaluate there: a guard is read where the motion
 * will go on. */
static int land(const frot_model *m, frot_state *s, frot_work *w, double t) {
  const frot_layout *l = &w->layout;
  const frot_contact_mode *modes = (const void *)(s->data + l->modes);
  int moved;
  if (s->weak && w->step.near[DP_STAGES])
    return FROT_OK; /* no place there is better: singular_posture.h */
  memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)m->ny);
  int status = frot_project(m, s, w, t, w->step.z1, w->step.z1 + m->nq, s->data + l->d, modes, NULL,
                            s->data + l->frozen, &moved);
  if (status != FROT_OK || !moved) return status;
  status = frot_slope(m, s, w, t, w->step.z1, frot_stage(w, DP_STAGES));
  memcpy(w->step.y_end, w->blocks.y, sizeof(double) * (size_t)m->ny);
  return status;
}

/* The search for the instant, from t: the guard's value, with what it may fall below zero, at the
 * part `at` of time, its slope, and the instant before that one with its value. It falls between
 * the last instant known at which it has not fallen, which it begins with, and the first at which
 * it has, if there is one. */
typedef struct {
  double longest, resolved, slack, zero;
  double at, value, slope, last_at, last;
  double before, above, after, below, width;
  int passes, stalled;
} search;

/* The instant at which a straight line between those two is zero, or the middle. */
static double inside(search *a) {
  double width = a->after - a->before, part = a->above / (a->above - a->below);
  int line = a->above > 0 && a->below < 0 && width <= HALVES * a->width;
  a->width = width;
  return a->before + width * (line ? part : 0.5);
}

/* Where the secant goes on, or where it is if nothing is gained by that. */
static double next_instant(search *a, double t) {
  if (a->passes > 0 && a->at != a->last_at && a->value != a->last) {
    double secant = (a->value - a->last) / (a->at - a->last_at);
    if (secant < 0) a->slope = secant;
  }
  if (a->value > 0)
    a->before = a->at, a->above = a->value;
  else
    a->after = a->at, a->below = a->value;
  if (a->value == 0 || !(a->slope < 0) || a->passes == PASSES) return a->at;
  if (a->passes >= ENOUGH && fabs(a->value) <= a->zero) return a->at;
  if (a->resolved > 0 && fabs(a->value) <= a->resolved) return a->at;
  int stalls = a->resolved > 0 && a->passes > 0 && fabs(a->value) > STALLS * fabs(a->last);
  a->stalled = stalls ? a->stalled + 1 : 0;
  if (a->stalled >= STALLED && fabs(a->value) <= a->zero) return a->at;
  double next = a->at - a->value / a->slope;
  if (!(next > a->before) || (a->below < 0 && next >= a->after)) next = inside(a);
  if (next > a->longest) next = a->longest;
  int same = fabs(next - a->at) <= 2 * DBL_EPSILON * fmax(fabs(t + a->at), a->at);
  return same ? a->at : next;
}

/* Go to another instant, where the guard will be looked at. */
static void go_to(search *a, double next) {
  a->last_at = a->at, a->last = a->value, a->at = next, a->passes++;
}

/* z1 and its slope <- those `way` after the end of the step's stages. */
static int shift_end(const frot_model *m, frot_state *s, frot_work *w, double t, double way) {
  const double *base = frot_stage(w, END);
  const double *slope = frot_stage(w, AT_END), *rate = frot_stage(w, RATE_AT_END);
  for (int k = 0; k < w->awake.n; k++) {
    int at = w->awake.now->states[k];
    w->step.z1[at] = base[k] + way * (slope[k] + 0.5 * way * rate[k]);
  }
  memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)m->ny);
  int status = frot_slope(m, s, w, t, w->step.z1, frot_stage(w, DP_STAGES));
  memcpy(w->step.y_end, w->blocks.y, sizeof(double) * (size_t)m->ny);
  if (status == FROT_OK) status = frot_has_jammed(s, w) ? FROT_DIVERGE : land(m, s, w, t);
  double *change = frot_stage(w, RATE_AT_END);
  const double *moved = frot_stage(w, DP_STAGES);
  for (int k = 0; k < w->awake.n && way != 0; k++) change[k] = (moved[k] - slope[k]) / way;
  return status;
}

/* Go on to the instant by the slope at the end of the stages, which is that near, and its rate: an
 * evaluation a time. */
static int refine(const frot_model *m, frot_state *s, frot_work *w, double t, int guard, search *a,
                  double next) {
  double stages = a->at;
  int known = 0; /* whether the rate is */
  frot_pack_awake(w, w->step.z1, frot_stage(w, END));
  memcpy(frot_stage(w, AT_END), frot_stage(w, DP_STAGES), sizeof(double) * (size_t)frot_width(w));
  memset(frot_stage(w, RATE_AT_END), 0, sizeof(double) * (size_t)w->awake.n);
  do {
    go_to(a, next);
    double way = a->at - stages;
    int status = FROT_OK;
    if (!known && fabs(way) > FROT_NEXT_BY_SLOPE * stages)
      status = shift_end(m, s, w, t + a->at, way);
    if (status == FROT_OK) status = shift_end(m, s, w, t + a->at, way);
    if (status != FROT_OK) return status;
    known = 1;
    a->value = frot_stage(w, DP_STAGES)[w->awake.n + guard] + a->slack;
    next = next_instant(a, t);
  } while (next != a->at && fabs(next - stages) <= FROT_NEXT_TO_END * stages);
  return FROT_OK;
}

void frot_return_to_stages(const frot_work *w, const frot_attempt *a) {
  if (!a->refined) return;
  frot_unpack_awake(w, frot_stage(w, END), w->step.z1);
  memcpy(frot_stage(w, DP_STAGES), frot_stage(w, AT_END), sizeof(double) * (size_t)w->awake.n);
}

/* The dense output of the step h that ends where the guard is zero, or next to that. */
static int make_inside(const frot_model *m, frot_state *s, frot_work *w, const frot_attempt *a,
                       double h) {
  if (a->dense) return frot_make_dense(m, s, w, a->t, h);
  frot_make_cubic(w, h);
  return FROT_OK;
}

/* Below which a slip that guard j follows is none beside the motion: next to a dead centre,
 * rounding of places leaves more of it than what it is to be told from. 0 of other guards. */
static double slip_of_rounding(const frot_model *m, const frot_state *s, frot_work *w, int j) {
  int e = frot_slip_of_guard(m, s, w, j);
  if (e < 0 || frot_metric(m, w) != FROT_OK) return 0;
  return FROT_ZERO_OF_MOTION * frot_row_speed(m, w, m->elements[e].row, w->step.z1 + m->nq);
}

int frot_locate(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *step,
                int *crosses) {
  double g[7], t = step->t, theta = step->theta, h = step->h;
  int guard = step->guard;
  frot_guard_polynomial(s, w, guard, h, g);
  double span = theta > 0 ? fmin(SPAN, SPAN_OF_WAY * theta) : SPAN;
  double left = fmax(theta - span, 0), right = fmin(theta + span, 1);
  double slope = (frot_bernstein(g, right) - frot_bernstein(g, left)) / ((right - left) * h);
  /* what reactions decide is read no better than this: nothing is gained by the steps beyond */
  int j = w->guards.list[guard];
  double slack = frot_crossing_tolerance(m, s, w, guard, h, g);
  double resolved =
      j < frot_condition_guard(m) ? FROT_ROOT_RESOLVED * s->data[w->layout.scale_g + j] : 0;
  search a = {.longest = h, .resolved = resolved, .slack = slack, .at = theta * h, .slope = slope};
  a.zero = frot_crossing_level(m, s, w, guard, t, slope);
  a.above = w->step.first[w->awake.n + guard] + slack, a.width = INFINITY;
  step->dense = frot_needs_inside(m, s);
  for (;;) {
    int status = frot_run_stages(m, s, w, t, a.at);
    if (status == FROT_OK && !(s->implicit && !frot_has_motion(m)))
      status = land(m, s, w, t + a.at);
    if (status != FROT_OK) return status;
    a.value = frot_stage(w, DP_STAGES)[w->awake.n + guard] + slack;
    double next = next_instant(&a, t);
    int there = next == a.at;
    step->h = a.at;
    if (!there && (s->implicit || s->weak || fabs(next - a.at) > FROT_NEXT_TO_END * a.at)) {
      go_to(&a, next);
      continue;
    }
    step->refined = !there;
    if (there) frot_measure_end(m, s, w, t + a.at, w->step.z1);
    status = make_inside(m, s, w, step, a.at);
    if (!there && status == FROT_OK) status = refine(m, s, w, t, guard, &a, next);
    if (!there) frot_measure_end(m, s, w, t + a.at, w->step.z1);
    step->beyond = a.at - step->h;
    double close = slack > 0 ? 0.5 * slack : frot_crossing_level(m, s, w, guard, t, a.slope);
    *crosses = a.value <= fmax(close, slip_of_rounding(m, s, w, j));
    return status;
  }
}
