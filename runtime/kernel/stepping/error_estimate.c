#include "stepping/error_estimate.h"

#include <math.h>

#include "singular/posture_rounding.h"
#include "guards/vanishing_slips.h"
#include "model/indexing.h"
#include "reactions/switching_functions.h"
#include "methods/rodas.h"
#include "methods/jacobian.h"
#include "evaluation/row_rounding.h"
#include "methods/error_scales.h"
#include "methods/dormand_prince.h"
#include "numerics/tolerances.h"

/* Weight of a stage in the step, which what is doubtful in its slope has. */
#define DOUBTED 0.001

double frot_step_tolerance(const frot_state *s) {
  return fmax(FROT_EXPLICIT_SHARE * s->tolerance, FROT_LEAST_TOLERANCE);
}

/* Size against which the error of value j is measured: the largest it has had, or what the step
 * brings it by what is known at its start. The step's own result is no witness, but where a value
 * begins at zero without any rate there is no other. */
static double size_at_start(const frot_model *m, const frot_state *s, const frot_work *w, int j,
                            double h) {
  const int *place = w->awake.now->place;
  double size = fmax(s->data[w->layout.scale_x + j], fabs(w->step.z0[j])),
         change = h * fabs(w->step.k[place[j]]);
  if (j < m->nq && m->q_speed[j] < 0) return w->sizes.own[j];
  if (j < m->nq) change += h * h * fabs(w->step.k[place[m->nq + m->q_speed[j]]]);
  size = fmax(size, change);
  return size > 0 ? size : fabs(w->step.z1[j] - w->step.z0[j]);
}

/* What the step brings the states that are no coordinates, by their slopes at its start, and what
 * it leaves them: what they are and move by at its end. Where that makes a size of zero, by the
 * first slope that is more than rounding, or by the first where none is: of what begins with the
 * step nothing else is known, and later ones may be wild where the step is far too long. */
static void size_own_states(const frot_model *m, const frot_state *s, frot_work *w, double h) {
  const frot_size_work *own = &w->sizes;
  const double *end = frot_stage(w, DP_STAGES);
  for (int i = 0; i < own->count; i++) {
    int j = own->states[i], at = w->awake.now->place[j];
    own->change[j] = at < 0 ? 0 : h * fabs(w->step.k[at]);
    own->left[j] = at < 0 ? INFINITY : fmax(fabs(w->step.z1[j]), h * fabs(end[at]));
  }
  if (!frot_state_sizes(m, s, w)) return;
  for (int i = 0; i < own->count; i++) {
    int j = own->states[i], at = w->awake.now->place[j];
    if (own->own[j] != 0 || own->change[j] != 0) continue;
    double rounding = FROT_NOISE_MARGIN * s->data[w->layout.noise + j], slope = 0, first = 0;
    for (int k = 1; at >= 0 && !(slope > rounding) && k <= DP_STAGES; k++) {
      slope = fabs(frot_stage(w, k)[at]);
      if (first == 0) first = slope;
    }
    own->change[j] = h * (slope > rounding ? slope : first);
  }
  frot_state_sizes(m, s, w);
}

/* What guard j may be off by at the end of the step, where its row comes to be more than rounding
 * of lengths. */
static double dropped(const frot_model *m, const frot_state *s, const frot_work *w, int j) {
  int e = frot_slip_of_guard(m, s, w, j);
  return e < 0 ? 0 : frot_dropped_rate(m, s, w, e, w->step.z1 + m->nq);
}

/* The worst estimate of the local error over its bound, and in w->step.worst the value it is of. */
static double worst_error(const frot_model *m, const frot_state *s, frot_work *w, double h) {
  const frot_layout *l = &w->layout;
  double tolerance = frot_step_tolerance(s), worst = 0;
  double guard_tolerance = frot_guard_tolerance(s->tolerance);
  double e5[FROT_CHUNK], e3[FROT_CHUNK];
  int end = frot_width(w), n = w->awake.n, states = n - FROT_QUADRATURES;
  w->step.worst = -1, w->step.noisy = 0, w->step.rounded = w->step.pardoned = 0;
  for (int j = 0; j < end; j++) {
    int at = j % FROT_CHUNK, size = end - j < FROT_CHUNK ? end - j : FROT_CHUNK;
    if (at == 0) {
      frot_weigh_stages(w, dp_e5, DP_STAGES + 1, j, size, e5);
      frot_weigh_stages(w, dp_e3, DP_STAGES + 1, j, size, e3);
    }
    if (j >= states && j < n) continue; /* energies follow */
    int speed = j < states ? w->awake.now->states[j] - m->nq : -1;
    if (speed >= 0) w->step.beyond[speed] = 0;
    if (e5[at] == 0 && e3[at] == 0) continue;
    double bound, noise = 0, rounding = 0, fifth = h * e5[at], third = h * e3[at];
    if (j < n) {
      int state = w->awake.now->states[j], plain = state < m->nq && m->q_speed[state] < 0;
      if (state >= m->nq) {
        fifth -= w->step.excused[state - m->nq];
        third -= w->step.excused[m->nv + state - m->nq];
      }
      noise = (plain ? FROT_NOISE_OF_RATES : FROT_NOISE_MARGIN) * h *
              frot_rate_rounding(m, s, w, state, h);
      bound = tolerance * size_at_start(m, s, w, state, h);
      if (plain) rounding = noise, noise = 0; /* no inertia smooths it */
    } else {
      double largest = FROT_GUARD_LOOSEST * s->data[l->most_g + w->guards.list[j - n]];
      largest = fmax(largest, w->guards.shown[j - n]);
      for (int k = 0; k <= DP_STAGES; k++) {
        double value = fabs(frot_stage(w, k)[j]);
        if (value > largest) largest = value;
      }
      bound = guard_tolerance * h * largest;
      double measured = frot_guard_rounding(m, s, w, w->guards.list[j - n], h);
      measured = fmax(measured, dropped(m, s, w, w->guards.list[j - n]));
      noise = FROT_NOISE_MARGIN * h * fmax(measured, FROT_GUARD_FLOOR * w->guards.size[j - n]);
    }
    double joint = sqrt(fifth * fifth + 0.01 * third * third);
    double error = joint > 0 ? fifth * fifth / joint : joint;
    error += DOUBTED * h * w->step.doubt[j];
    if (error > bound && speed >= 0) w->step.beyond[speed] = error, w->step.rounded = 1;
    w->step.pardoned |= error > bound && error <= rounding;
    bound = fmax(bound, rounding);
    double ratio = error > 0 ? error / (bound + noise) : error; /* both may underflow */
    if (!(ratio <= worst)) {
      worst = ratio, w->step.worst = j < states ? w->awake.now->states[j] : -1;
      w->step.noisy = noise / error;
    }
    if (isnan(worst)) break;
  }
  return worst;
}

double frot_error_ratio(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  w->step.turning = 0;
  frot_measure_slips(m, s, w);
  double slips = frot_slip_error(m, s, w, h, frot_step_tolerance(s));
  if (slips > 1) return w->step.worst = -1, w->step.noisy = w->step.rounded = 0, slips;
  if (s->implicit) return fmax(slips, frot_implicit_error(m, s, w, h));
  size_own_states(m, s, w, h);
  frot_excuse_rounding(m, s, w, t, h);
  double worst = worst_error(m, s, w, h);
  if (!(worst > FROT_LIMITING) || w->step.worst < 0 || w->step.worst >= m->nq ||
      !frot_is_small(m, s, w, w->step.worst))
    return worst;
  /* of a motion it would take the place of what was last evaluated */
  int no_jacobian =
      !m->has_jacobian || frot_has_motion(m) || frot_implicit_begin(m, s, w, t) != FROT_OK;
  frot_raise_small(m, s, w, h, no_jacobian);
  return worst_error(m, s, w, h);
}

void frot_keep_guard_sizes(const frot_state *s, const frot_work *w) {
  int first = w->awake.n;
  for (int k = 0; k < w->guards.count; k++)
    /* of an implicit step only the slopes at its ends are there */
    for (int i = 0; i <= DP_STAGES; i += s->implicit ? DP_STAGES : 1) {
      double size = fabs(frot_stage(w, i)[first + k]);
      if (size < INFINITY) w->guards.shown[k] = fmax(w->guards.shown[k], size);
    }
}
