#include "guards/guard_crossing.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "model/sleeping.h"
#include "guards/conditions.h"
#include "evaluation/evaluate.h"
#include "model/indexing.h"
#include "reactions/switching_functions.h"
#include "methods/right_hand_side.h"
#include "numerics/bernstein.h"
#include "methods/dormand_prince.h"
#include "numerics/tolerances.h"

#define SAMPLES 8  /* places at which a guard that seems to dip may have risen again */
#define BETWEEN 32 /* the same, of one that its stages say has not fallen */
#define IDLE 10    /* falls to no effect, one after the other, after which one is to be clear */
/* Part of its largest size below which what was measured of a force is no longer of this one. */
#define FADED 1e-2
/* What the polynomial of a guard, of degree six, dips at most below its values at the stages, in
 * parts of what they change by (by a linear program: 1.68). */
#define DIPS 1.7

void frot_guard_polynomial(const frot_state *s, const frot_work *w, int guard, double h,
                           double g[7]) {
  const double *f = w->step.f + w->awake.n + guard;
  int nz = w->layout.nz;
  for (int k = 0; s->implicit && k < 7; k++) g[k] = f[k * nz];
  if (s->implicit) return;
  for (int k = 0; k < 7; k++) {
    double sum = 0;
    for (int j = 0; j < DP_DENSE; j++) sum += dp_rate[k][j] * f[j * nz];
    g[k] = sum / h;
  }
}

/* The value below which guard j, at zero at time t, counts as fallen with the one that is located,
 * whose instant rounding leaves `unsure`: by the same measure, but no more than the error that the
 * run allows. */
static double fallen(const frot_model *m, const frot_state *s, const frot_work *w, int j, double t,
                     double slope, double unsure) {
  double size = s->data[w->layout.scale_g + j];
  if (j >= frot_condition_guard(m))
    return FROT_CONDITION_ZERO * size + 8 * DBL_EPSILON * fabs(t) * fabs(slope);
  double error = fmax(s->tolerance * size, unsure * fabs(slope));
  return fmax(FROT_ZERO * size, fmin(FROT_LOCATED * size, error));
}

/* The slope of a guard at the end of its polynomial over h. */
static double slope_at_end(const double g[7], double h) { return 6 * (g[6] - g[5]) / h; }

double frot_crossing_level(const frot_model *m, const frot_state *s, const frot_work *w, int k,
                           double t, double slope) {
  double size = s->data[w->layout.scale_g + w->guards.list[k]];
  if (w->guards.list[k] < frot_condition_guard(m)) return FROT_LOCATED * size;
  return FROT_GUARD_FLOOR * size + 8 * DBL_EPSILON * fabs(t) * fabs(slope);
}

/* Whether condition j is lost at the start of the step, where it is zero. One at whose coming to
 * hold a `when` fired may be lost however little it moves: a ball leaves the floor, and rounding
 * would hide the jump and the next fall with it. What a `reinit` has left at zero without a rate
 * does not hold there: it may come to hold again. */
static int lost_at_once(const frot_state *s, const frot_work *w, int j, const double g[7],
                        double inside, int falls) {
  double rise = g[1] - g[0];
  if (s->data[w->layout.fresh + j] == 0) return falls && g[0] <= 0 && rise < 0;
  return rise < (s->jumped ? FROT_FLAT : -2 * FROT_ROUNDING) * inside;
}

/* Whether guard j is the gap of an open contact. */
static int is_gap(const frot_model *m, const frot_state *s, const frot_work *w, int j) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  return j < m->n_contacts && !modes[j].closed;
}

/* Whether guard j is the condition that a place of contact is beyond the end of a figure. */
static int is_end(const frot_model *m, int j) {
  int condition = j - frot_condition_guard(m);
  return condition >= 0 && m->conditions[condition].contact >= 0;
}

/* Whether guard j is that of what is closed: no gap, no condition. */
static int is_reaction_or_slip(const frot_model *m, const frot_state *s, const frot_work *w,
                               int j) {
  return j < frot_condition_guard(m) && !is_gap(m, s, w, j);
}

double frot_crossing_tolerance(const frot_model *m, const frot_state *s, const frot_work *w, int k,
                               double h, const double g[7]) {
  int j = w->guards.list[k];
  double size = s->data[w->layout.scale_g + j], most = s->data[w->layout.most_g + j];
  double inside = 0, floor = FROT_GUARD_FLOOR * size;
  for (int i = 0; i < 7; i++) inside = fmax(inside, fabs(g[i]));
  floor += FROT_NOISE_MARGIN * frot_guard_rounding(m, s, w, j, h);
  if (size > 0 && size < FADED * most) floor = fmin(floor, FROT_DROWNED * size);
  double slack = fmax(FROT_LOCATED * inside, floor);
  if (!frot_guard_is_force(m, s, w, k) || !(fabs(g[0]) <= slack)) slack = 0;
  return s->idle > IDLE && is_reaction_or_slip(m, s, w, j) ? fmax(slack, 2 * FROT_LOCATED * size)
                                                           : slack;
}

int frot_guard_may_cross(const frot_state *s, const frot_work *w, int rests) {
  for (int k = 0; k < w->guards.count; k++) {
    const double *value = w->step.k + w->awake.n + k;
    double least = *value, most = *value;
    for (int i = 1; i <= DP_STAGES; i++) {
      value += w->layout.nz;
      least = *value < least ? *value : least, most = *value > most ? *value : most;
    }
    double size = s->data[w->layout.scale_g + w->guards.list[k]];
    if (!(least > DIPS * (most - least) && least > FROT_LOCATED * size)) return 1;
    if (rests && most - least > FROT_GUARD_LOOSEST * most) return 1;
  }
  return 0;
}

int frot_guards_fit_stages(const frot_state *s, const frot_work *w, double h) {
  for (int k = 0; k < w->guards.count; k++) {
    double g[7], largest = s->data[w->layout.most_g + w->guards.list[k]], off = 0;
    frot_guard_polynomial(s, w, k, h, g);
    for (int i = 1; i < DP_STAGES; i++) {
      double value = frot_stage(w, i)[w->awake.n + k];
      off = fmax(off, fabs(value - frot_bernstein(g, dp_c[i])));
      largest = fmax(largest, fabs(value));
    }
    if (!(off <= FROT_GUARD_LOOSEST * largest)) return 0;
  }
  return 1;
}

/* Whether a guard at zero at the start falls below it by its polynomial alone: no stage of the step
 * lies below, and the polynomial is farther off them than it is below zero. What begins with a
 * broken power of time is followed no better, however short the step. */
static int falls_between_stages(const frot_state *s, const frot_work *w, int k, const double g[7]) {
  double off = 0, below = 0;
  if (s->implicit) return 0;
  for (int i = 1; i <= DP_STAGES; i++) {
    double value = frot_stage(w, i)[w->awake.n + k];
    if (!(value >= 0)) return 0;
    if (i < DP_STAGES) off = fmax(off, fabs(value - frot_bernstein(g, dp_c[i])));
  }
  for (int i = 1; i < BETWEEN; i++) below = fmax(below, -frot_bernstein(g, i / (double)BETWEEN));
  return below <= off;
}

int frot_first_crossing(const frot_model *m, const frot_state *s, const frot_work *w, double t,
                        double h, double *theta) {
  int found = -1, conditions = frot_condition_guard(m);
  *theta = FROT_NO_ROOT;
  for (int k = 0; k < w->guards.count; k++) {
    double g[7];
    int j = w->guards.list[k];
    frot_guard_polynomial(s, w, k, h, g);
    double size = s->data[w->layout.scale_g + j], inside = 0;
    for (int i = 0; i < 7; i++) inside = fmax(inside, fabs(g[i]));
    size = fmax(fmax(size, inside), w->guards.size[k]);
    double slope = 6 * fabs(g[1] - g[0]) / h, first = g[0];
    /* what is as near to zero at the start as events are located, and rises, has not fallen */
    for (int i = 0;
         j < conditions && i < 6 && g[i] < 0 && g[i] >= -FROT_LOCATED * size && g[i + 1] > g[i];
         i++)
      g[i] = 0;
    double slack = frot_crossing_tolerance(m, s, w, k, h, g);
    for (int i = 0; i < 7; i++) g[i] += slack;
    double floor = FROT_GUARD_FLOOR * size + FROT_NOISE_MARGIN * frot_guard_rounding(m, s, w, j, h);
    /* next to a jam noise would hide any reversal, but what has no size yet may be all noise */
    if (s->data[w->layout.scale_g + j] > 0) floor = fmin(floor, FROT_DROWNED * size);
    double at = frot_first_fall(g, floor + 8 * DBL_EPSILON * fabs(t) * slope);
    if (at < FROT_NO_ROOT && j >= conditions && fabs(first) <= FROT_CONDITION_ZERO * size &&
        s->data[w->layout.fresh + j - conditions] == 0 && falls_between_stages(s, w, k, g))
      continue;
    if (j >= conditions && fabs(first) <= FROT_ZERO * size &&
        lost_at_once(s, w, j - conditions, g, inside, at < FROT_NO_ROOT))
      at = 0;
    if (at < *theta) *theta = at, found = k;
  }
  return found;
}

int frot_crosses_other_gap_or_end(const frot_model *m, const frot_state *s, const frot_work *w,
                                  int guard) {
  const double *start = frot_stage(w, 0) + w->awake.n, *end = frot_stage(w, DP_STAGES) + w->awake.n;
  int located = w->guards.list[guard];
  int sign = located >= frot_condition_guard(m) && !is_end(m, located);
  for (int k = 0; k < w->guards.count; k++) {
    int j = w->guards.list[k];
    if (k == guard || !(is_gap(m, s, w, j) || (sign && is_end(m, j)))) continue;
    double level = FROT_LOCATED * s->data[w->layout.scale_g + j];
    if (start[k] >= -level && end[k] < -level) return 1;
  }
  return 0;
}

/* The values after h, as the slopes at the start of the step lead, with its blocks. */
static double *lead(const frot_model *m, const frot_state *s, frot_work *w, double h) {
  const double *slope = frot_stage(w, 0);
  double *z = w->step.z;
  memcpy(z, w->step.z0, sizeof(double) * (size_t)w->layout.nx);
  for (int i = 0; i < w->awake.n; i++) z[w->awake.now->states[i]] += h * slope[i];
  memcpy(w->blocks.y, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
  return z;
}

/* Whether a located condition, zero at the start of the step, rises there by the slope. */
static int rises(const frot_model *m, frot_state *s, frot_work *w, int k, double t, double h) {
  double part = FROT_AT_ONCE * h, first = frot_stage(w, 0)[w->awake.n + k],
         *z = lead(m, s, w, part);
  if (frot_evaluate_conditions(m, s, w, t + part, z, z + m->nq) != FROT_OK) return 0;
  double value =
      frot_condition_value(w, s->data + w->layout.d, w->guards.list[k] - frot_condition_guard(m));
  return value - first > FROT_CONDITION_ZERO * s->data[w->layout.scale_g + w->guards.list[k]];
}

int frot_may_be_dip(const frot_model *m, frot_state *s, frot_work *w, int k, double theta, double t,
                    double h) {
  double g[7];
  if (k < 0 || theta > FROT_EARLY) return 0;
  int condition = w->guards.list[k] - frot_condition_guard(m);
  if (condition >= 0 && s->data[w->layout.fresh + condition] != 0) return 0;
  frot_guard_polynomial(s, w, k, h, g);
  double zero = condition >= 0 ? FROT_ZERO : FROT_LOCATED;
  if (fabs(g[0]) > zero * s->data[w->layout.scale_g + w->guards.list[k]]) return 0;
  /* a root of a gap so near to the start is one of the polynomial's errors, or of a shorter step */
  if (is_gap(m, s, w, w->guards.list[k]) && theta > 0 && theta < s->tolerance) return 1;
  for (int i = 1; i <= SAMPLES; i++)
    if (frot_bernstein(g, theta + (1 - theta) * i / SAMPLES) > 0) return 1;
  return condition >= 0 && theta == 0 && rises(m, s, w, k, t, h);
}

void frot_fire_at_start(frot_state *s, const frot_work *w, int guard) {
  const frot_layout *l = &w->layout;
  s->data[l->fired + w->guards.list[guard]] = FROT_AT_START;
  frot_unpack_awake(w, w->step.k, s->data + l->slope);
  s->pending = 1;
}

/* The largest value of a guard at the start of its polynomial and within it: a gap that has just
 * opened is zero at the start. */
static double most_within(const double g[7]) {
  double most = g[0];
  for (int i = 1; i < SAMPLES; i++) most = fmax(most, frot_bernstein(g, (double)i / SAMPLES));
  return most;
}

void frot_fire_guards(const frot_model *m, frot_state *s, const frot_work *w, int first, double t,
                      double h) {
  int n = w->awake.n, located = w->guards.list[first];
  const double *end = frot_stage(w, DP_STAGES) + n;
  double g[7], unsure = 0;
  frot_guard_polynomial(s, w, first, h, g);
  if (located < frot_condition_guard(m))
    unsure = FROT_ROUNDING * s->data[w->layout.scale_g + located] / fabs(slope_at_end(g, h));
  for (int k = 0; k < w->guards.count; k++) {
    frot_guard_polynomial(s, w, k, h, g);
    double limit = fallen(m, s, w, w->guards.list[k], t + h, slope_at_end(g, h), unsure);
    double most = most_within(g);
    /* the height of a short flight is the measure of its end */
    if (is_gap(m, s, w, w->guards.list[k]) &&
        most > FROT_GUARD_FLOOR * s->data[w->layout.scale_g + w->guards.list[k]])
      limit = fmin(limit, FROT_DROWNED * most);
    if (k == first || (end[k] <= limit && most > limit))
      s->data[w->layout.fired + w->guards.list[k]] = 1;
  }
  s->pending = 1;
}

/* The listed guard of the first condition: those awake are all listed, last. */
static int first_condition(const frot_work *w) { return w->guards.count - w->awake.now->n_located; }

int frot_condition_passed(const frot_model *m, frot_state *s, frot_work *w, double t, double h,
                          double *part) {
  const double *d = s->data + w->layout.d;
  const double *start = w->step.k + w->awake.n + first_condition(w);
  int passed = -1;
  if (m->n_located == 0 || !frot_all_finite(w->step.z1, m->nq + m->nv)) return -1;
  memcpy(w->blocks.y, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
  if (frot_kinematics(m, s, w, w->core.t, w->step.z1, w->step.z1 + m->nq, d) != FROT_OK) return -1;
  *part = 1;
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_located; k++) {
    int j = now->located[k];
    if (j >= m->n_located - m->n_sensed) continue; /* nothing is solved there */
    double value = frot_condition_value(w, d, j);
    if (!(value < 0 && start[k] >= 0)) continue;
    double at = (w->core.t - t) / h * start[k] / (start[k] - value);
    if (at <= *part) *part = at, passed = j;
  }
  return passed;
}

/* The values of conditions after h, as the slopes at the start lead, in w->core.condition. Returns
 * whether the motion has a slope there, without which nothing is told by those that read
 * accelerations. What the last evaluation has told of its failure stays. */
static int look_later(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  int failed = w->blocks.failed, singular = w->blocks.singular, jammed = w->reactions.jammed;
  double *z = lead(m, s, w, h);
  int seen = frot_slope(m, s, w, t + h, z, frot_stage(w, 1)) == FROT_OK;
  if (!seen) frot_kinematics(m, s, w, t + h, z, z + m->nq, s->data + w->layout.d);
  w->blocks.failed = failed, w->blocks.singular = singular, w->reactions.jammed = jammed;
  return seen;
}

int frot_condition_at_zero(const frot_model *m, frot_state *s, frot_work *w, int passed, double t,
                           double h) {
  int first = first_condition(w);
  const double *guard = frot_stage(w, 0) + w->awake.n + first;
  const double *sizes = s->data + w->layout.scale_g + frot_condition_guard(m);
  int found = -1, looked = 0, seen = 0;
  double most = -1;
  for (int k = 0; k < w->awake.now->n_located; k++) {
    int j = w->awake.now->located[k];
    double size = sizes[j];
    if (!(fabs(guard[k]) <= FROT_GUARD_FLOOR * size)) continue;
    if (j == passed) return first + k;
    if (!looked) seen = look_later(m, s, w, t, h), looked = 1;
    double there = frot_condition_value(w, s->data + w->layout.d, j);
    int known = isfinite(there) && (seen || j < m->n_located - m->n_sensed);
    double moved = known ? fabs(there - guard[k]) / size : 0;
    if (seen && moved == 0) continue; /* where nothing has a slope later any of them may be why */
    if (moved > most || found < 0) found = first + k, most = moved > most ? moved : most;
  }
  return found;
}
