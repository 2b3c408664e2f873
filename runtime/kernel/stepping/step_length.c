#include "stepping/step_length.h"

#include <math.h>

#include "evaluation/fault_source.h"
#include "singular/singular_posture.h"
#include "stepping/step_ends.h"
#include "model/indexing.h"
#include "inertia/mass_matrix.h"
#include "methods/jacobian.h"
#include "singular/undetermined_branch.h"
#include "stepping/time_resolution.h"
#include "stepping/slope_probe.h"
#include "constraints/redundant_rows.h"
#include "methods/dormand_prince.h"
#include "numerics/tolerances.h"
#include "singular/tangent_cone.h"

/* The first step, in longest steps: what starts from rest shows its size only as it moves. */
#define FIRST_PART 1e-3
/* Part of a value by which the first step may change it. */
#define FIRST_CHANGE 0.01
/* The angle by which a loop turns in the first step from a singular posture: nearer to it rounding
 * grows faster than errors shrink. */
#define LEAVES 0.2
/* Change of the step's length: at most, at least, after no value, and what of it is taken. */
#define MOST_GROWTH 6
#define LEAST_PART (1.0 / 3)
#define CUT 0.25
#define HALF 0.5 /* of the implicit method, whose stages were not found */
#define SAFETY 0.9
/* How much shorter the steps after one that failed are to be, and how much longer after one that
 * did not: by their ratio one in twenty fails, whatever the motion is like. The least part. */
#define FAILED 0.95
#define PASSED 1.0025
#define LEAST_CAUTION 0.5
/* Error, over its bound, beyond which no caution would have helped; part of one from which on
 * rounding may be what fails it, whatever the length. */
#define HOPELESS 256
#define AUDIBLE 0.01
/* The same where the error is below what rounding does: by this where it is well below, unless a
 * step so long has failed lately, which counts less from step to step. */
#define ALL_NOISE 1.5
#define NOISE_ALONE 2
#define LATELY 1.05

int frot_first_step(const frot_model *m, frot_state *s, frot_work *w) {
  int status = frot_start_slope(m, s, w, s->t);
  if (status != FROT_OK)
    return frot_fail_step(m, s, w, status, s->t, 0, w->step.z0, w->step.z0 + m->nq);
  s->statistics.free = frot_count_free_speeds(m, s, w);
  for (int i = 0; i < w->awake.now->n_groups; i++) {
    const frot_group *g = &m->groups[w->awake.now->groups[i]];
    if (!g->general) s->statistics.masked = fmax(s->statistics.masked, frot_masked_part(m, w, g));
  }
  double h = FIRST_PART * s->h_max;
  double leaves = INFINITY;
  unsigned char *lost = w->opening.use;
  frot_starts_singular(m, s, w, s->t, h, lost);
  for (int i = 0; i < m->n_contacts; i++) {
    if (!lost[i]) continue;
    if (!frot_begins_on_branch(m, s, w, s->t, i))
      return frot_fail(s, FROT_POSTURE, s->t, i, -1, -1, 0);
    const frot_group *g = frot_group_of(m, m->contacts[i].row_n);
    leaves = fmin(leaves, LEAVES * frot_time_of_turn(m, s, g, w->step.z0 + m->nq));
  }
  if (isfinite(leaves)) {
    s->h = fmin(leaves, s->h_max);
    return FROT_OK;
  }
  for (int j = 0; j < m->nq + m->nv; j++) {
    double slope = fabs(frot_stage(w, 0)[j]), size = fabs(w->step.z0[j]);
    if (slope > 0 && size > 0) h = fmin(h, FIRST_CHANGE * size / slope);
  }
  h = frot_probe_slopes(m, s, w, s->t, fmax(h, FROT_FIRST_LEAST * s->h_max));
  s->h = frot_finest_step(m, s, w, h);
  return FROT_OK;
}

double frot_least_step(const frot_state *s, const frot_attempt *a) {
  return FROT_LEAST_STEP * fmax(fabs(a->t), FROT_LEAST_TIME * s->h_max);
}

int frot_is_too_short(const frot_state *s, const frot_attempt *a) {
  return !(a->h > frot_least_step(s, a));
}

/* Whether a motion limits an explicit step. What other states are measured against changes with
 * them, and where stability limits them their error does not follow the length. */
static int motion_limits(const frot_model *m, const frot_state *s, const frot_work *w) {
  int j = w->step.worst;
  return m->nv > 0 && !s->implicit && (j < 0 || j >= m->nq || m->q_speed[j] >= 0);
}

/* Change of the step's length that brings its error near the bound. More is kept back where steps
 * fail often: where reactions pass near zero they bend a motion at once, and in a method of high
 * order a little length saves most of the rejections. */
static double change_of_length(const frot_model *m, const frot_state *s, const frot_work *w,
                               double ratio) {
  if (s->implicit) return SAFETY * pow(ratio, frot_has_motion(m) ? -1.0 / 6 : -1.0 / 5);
  return (motion_limits(m, s, w) ? s->caution : 1) * SAFETY * pow(ratio, -1.0 / 8);
}

void frot_shorten(const frot_model *m, frot_state *s, const frot_work *w, frot_attempt *a) {
  s->failed_h = a->h;
  if (a->ratio > 1 && a->ratio < HOPELESS && w->step.noisy < AUDIBLE && motion_limits(m, s, w))
    s->caution = fmax(FAILED * s->caution, LEAST_CAUTION);
  if (a->ratio > 1 && a->ratio < 1e300)
    a->h *= fmax(change_of_length(m, s, w, a->ratio), LEAST_PART);
  else
    a->h *= a->passed >= 0 ? fmin(fmax(FROT_NEARLY * a->part, 0.01), FROT_NEARLY)
            : s->implicit && frot_has_motion(m) ? HALF
                                                : CUT;
}

/* Change of the step's length that its error will bear if it goes on as it went from the step
 * before to this one (K. Gustafsson, ACM Trans. Math. Softw. 20, 1994, p. 496). Errors that bound
 * neither, of steps that something else made short, tell no trend. */
static double trend(const frot_model *m, frot_state *s, const frot_work *w, const frot_attempt *a) {
  double change = INFINITY;
  if (motion_limits(m, s, w) && s->last_ratio > FROT_LIMITING && a->ratio > FROT_LIMITING)
    change = s->caution * SAFETY * a->h / s->last_h *
             pow(s->last_ratio / (a->ratio * a->ratio), 1.0 / 8);
  s->last_h = a->h, s->last_ratio = a->ratio;
  return change;
}

void frot_plan_next(const frot_model *m, frot_state *s, const frot_work *w, const frot_attempt *a,
                    double planned) {
  double factor = a->ratio > 0 ? change_of_length(m, s, w, a->ratio) : MOST_GROWTH;
  factor = fmin(factor, trend(m, s, w, a));
  factor = fmin(fmax(factor, LEAST_PART), a->rejections ? 1 : MOST_GROWTH);
  if (factor < 1 && !a->to_due && frot_foresees_posture(m, s, w, a->t, a->h))
    factor = 1; /* a tied step need not be shorter */
  /* noise grows with the step as its bound does: an error that is all noise says no more */
  int may_grow = !(s->failed_h > 0) || ALL_NOISE * a->h < s->failed_h;
  if (w->step.noisy >= 1)
    factor = fmax(factor, w->step.noisy > NOISE_ALONE && may_grow ? ALL_NOISE : 1);
  s->failed_h *= LATELY;
  if (a->rejections == 0) s->caution = fmin(PASSED * s->caution, 1);
  s->h = fmin(a->h * factor, fmin(a->longest, a->stable));
  if (s->weak) s->h = fmax(a->h, a->want); /* noise does not show how long it may be */
  if (a->to_due) s->h = fmax(s->h, planned);
  s->heard = fmax(s->heard, s->h);
}
