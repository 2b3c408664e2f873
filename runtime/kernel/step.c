/* Explicit Runge-Kutta step of order 8 with dense output of order 7 and location of events.
 *
 * Beside coordinates, speeds and the energies, the integrals of the guards are integrated. Their
 * dense output, differentiated, follows every guard inside the step at no cost in evaluations, and
 * their error estimate makes the step resolve what the guards do even while nothing moves. */
#include "step.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "blocks.h"
#include "conditions.h"
#include "core.h"
#include "guards.h"
#include "implicit.h"
#include "mechanics.h"
#include "pace.h"
#include "probe.h"
#include "projection.h"
#include "reactions.h"
#include "roots.h"
#include "sizes.h"
#include "stiffness.h"
#include "tolerances.h"

/* Part of the tolerance given to one step, so that the whole run keeps it. */
#define LOCAL_SHARE 0.1
/* A guard need only be followed well enough to see where it goes. */
#define GUARD_LOOSEST 1e-3
#define GUARD_TIGHTEST 1e-6
/* Part of its largest size by which a condition is off zero by rounding: far below
 * FROT_GUARD_FLOOR, so that what counts as fallen does not fall again. */
#define CONDITION_ZERO 4e-15
/* Part of its size in the next step by which a condition moves that has no rate. */
#define FLAT 1e-10
/* Part of the way to where a condition seems to be zero, beyond which there is no value. */
#define NEARLY 0.9
#define LEAST_STEP (16 * DBL_EPSILON)
/* Time from which on steps are measured by its resolution, in longest steps. */
#define LEAST_TIME 1e-12
#define LOCATE_PASSES 12
/* The first step, in longest steps: what starts from rest shows its size only as it moves. */
#define FIRST_PART 1e-3
/* Rejections of one step after which the rounding of its derivatives is measured, and what is left
 * of that measure a step later. */
#define PATIENCE 2
#define FORGET 0.99
/* Rejections after which the sizes of states no longer shrink with the step. */
#define HOLD 6
/* Estimates below this, over their bound, do not keep the next step from being longer. */
#define LIMITING 1e-4
#define CHUNK 4 /* states summed together, in registers */

static double *stage(const frot_layout *l, frot_work *w, int i) { return w->k + i * l->nz; }

static const frot_contact_mode *modes_of(frot_state *s, const frot_layout *l) {
  return (const frot_contact_mode *)(const void *)(s->data + l->modes);
}

static int slope_at(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l,
                    double t, const double *z, double *slope) {
  return frot_derivatives(m, s, w, t, z, s->data + l->d, modes_of(s, l), s->data + l->frozen,
                          slope);
}

/* sum[j] <- sum of coefficient[k] times stage k < count at state from + j, j < size <= CHUNK. */
static void weigh(const frot_work *w, int nz, const double *coefficient, int count, int from,
                  int size, double sum[CHUNK]) {
  const double *slopes = w->k + from;
  if (size == CHUNK) {
    double a = 0, b = 0, c = 0, d = 0;
    for (int k = 0; k < count; k++, slopes += nz) {
      const double factor = coefficient[k];
      a += factor * slopes[0], b += factor * slopes[1];
      c += factor * slopes[2], d += factor * slopes[3];
    }
    sum[0] = a, sum[1] = b, sum[2] = c, sum[3] = d;
    return;
  }
  for (int j = 0; j < size; j++) {
    double total = 0;
    for (int k = 0; k < count; k++) total += coefficient[k] * slopes[k * nz + j];
    sum[j] = total;
  }
}

/* Values integrated together: the states and the guards listed. */
static int width(const frot_work *w) { return w->layout.nx + w->n_guards; }

/* z <- base + h * (sum of coefficient[k] times stage k < count); base may be NULL. */
static void combine(const frot_work *w, int nz, const double *coefficient, int count, double h,
                    const double *base, double *z) {
  int end = width(w);
  for (int from = 0; from < end; from += CHUNK) {
    double sum[CHUNK];
    int size = end - from < CHUNK ? end - from : CHUNK;
    weigh(w, nz, coefficient, count, from, size, sum);
    for (int j = 0; j < size; j++) z[from + j] = (base ? base[from + j] : 0) + h * sum[j];
  }
}

/* Stages 1..12 of a step h from z0, stage 0 being there; w->z1 is the end, stage 12 its derivative,
 * w->y_end the unknowns of the blocks there. */
static int run_stages(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l,
                      double t, double h) {
  if (s->implicit) return frot_implicit_stages(m, s, w, t, h);
  memcpy(w->y, s->data + l->y, sizeof(double) * (size_t)m->ny);
  for (int i = 1; i <= DP_STAGES; i++) {
    double *z = i == DP_STAGES ? w->z1 : w->ztry;
    combine(w, l->nz, dp_a[i], i, h, w->z0, z);
    int status = slope_at(m, s, w, l, i == DP_STAGES ? t + h : t + dp_c[i] * h, z, stage(l, w, i));
    if (status != FROT_OK) {
      memmove(w->z1, z, sizeof(double) * (size_t)l->nx); /* where it happened */
      return status;
    }
  }
  memcpy(w->y_end, w->y, sizeof(double) * (size_t)m->ny);
  return FROT_OK;
}

/* Size against which the error of value j is measured: the largest it has had, or what the step
 * brings it by what is known at its start. The step's own result is no witness, but where a value
 * begins at zero without any rate there is no other. */
static double size_at_start(const frot_model *m, const frot_state *s, const frot_work *w,
                            const frot_layout *l, int j, double h) {
  double size = fmax(s->data[l->scale_x + j], fabs(w->z0[j])), change = h * fabs(w->k[j]);
  if (j < m->nq && m->q_speed[j] < 0) return w->own_size[j];
  if (j < m->nq) change += h * h * fabs(w->k[m->nq + m->q_speed[j]]);
  size = fmax(size, change);
  return size > 0 ? size : fabs(w->z1[j] - w->z0[j]);
}

/* What the step brings the states that are no coordinates, by their slopes at its start. Where that
 * leaves a size of zero, by the first slope that is not: of what begins with the step nothing else
 * is known, and later ones may be wild where the step is far too long. */
static void size_own_states(const frot_model *m, const frot_state *s, frot_work *w,
                            const frot_layout *l, double h) {
  for (int j = 0; j < m->nq; j++) w->change[j] = h * fabs(w->k[j]);
  if (!frot_state_sizes(m, s, w)) return;
  for (int j = 0; j < m->nq; j++)
    for (int k = 1; m->q_speed[j] < 0 && w->own_size[j] == 0 && w->change[j] == 0; k++) {
      if (k > DP_STAGES) break;
      w->change[j] = h * fabs(w->k[k * l->nz + j]);
    }
  frot_state_sizes(m, s, w);
}

/* The worst estimate of the local error over its bound, and in w->worst the value it is of. */
static double worst_error(const frot_model *m, const frot_state *s, frot_work *w,
                          const frot_layout *l, double h) {
  double tolerance = fmax(LOCAL_SHARE * s->tolerance, FROT_LEAST_TOLERANCE), worst = 0;
  double guard_tolerance = fmin(GUARD_LOOSEST, fmax(GUARD_TIGHTEST, 10 * s->tolerance));
  double e5[CHUNK], e3[CHUNK];
  int end = width(w);
  w->worst = -1;
  for (int j = 0; j < end; j++) {
    int at = j % CHUNK, size = end - j < CHUNK ? end - j : CHUNK;
    if (at == 0) {
      weigh(w, l->nz, dp_e5, DP_STAGES + 1, j, size, e5);
      weigh(w, l->nz, dp_e3, DP_STAGES + 1, j, size, e3);
    }
    if (j >= m->nq + m->nv && j < l->nx) continue; /* energies follow */
    if (e5[at] == 0 && e3[at] == 0) continue;
    double bound, noise = 0, fifth = h * e5[at], third = h * e3[at];
    if (j < l->nx) {
      int plain = j < m->nq && m->q_speed[j] < 0;
      noise = (plain ? FROT_NOISE_OF_RATES : FROT_NOISE_MARGIN) * h * s->data[l->noise + j];
      bound = tolerance * size_at_start(m, s, w, l, j, h);
      if (plain) bound = fmax(bound, noise), noise = 0; /* no inertia smooths it */
    } else {
      double largest = GUARD_LOOSEST * s->data[l->scale_g + w->guards[j - l->nx]];
      for (int k = 0; k <= DP_STAGES; k++) largest = fmax(largest, fabs(w->k[k * l->nz + j]));
      bound = guard_tolerance * h * largest;
    }
    double joint = sqrt(fifth * fifth + 0.01 * third * third);
    double error = joint > 0 ? fifth * fifth / joint : joint;
    /* what rounding makes grows with the step as its bound does: it is no reason for a shorter one
     */
    double ratio = error <= noise ? 0 : (error - noise) / bound;
    if (!(ratio <= worst)) worst = ratio, w->worst = j < m->nq + m->nv ? j : -1;
    if (isnan(worst)) break;
  }
  return worst;
}

/* Estimate of the local error over its bound: at most 1 for a good step, NaN for no number. The
 * Jacobian is asked for only where a small state is what limits the step. */
static double error_ratio(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l,
                          double t, double h) {
  if (s->implicit) return frot_implicit_error(m, s, w, h);
  size_own_states(m, s, w, l, h);
  double worst = worst_error(m, s, w, l, h);
  if (!(worst > LIMITING) || w->worst < 0 || w->worst >= m->nq || !frot_is_small(m, s, w, w->worst))
    return worst;
  int no_jacobian = !m->has_jacobian || frot_implicit_begin(m, s, w, t) != FROT_OK;
  frot_raise_small(m, s, w, h, no_jacobian);
  return worst_error(m, s, w, l, h);
}

/* Accelerations that are nothing but rounding of their terms in all stages of the step: what they
 * bring is noise, however small the values moved (a value that is zero shows none by being moved).
 */
static void add_rounding(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l,
                         double t, double *largest) {
  double *noise = s->data + l->noise, *size = w->residual;
  frot_acceleration_sizes(m, s, w, t, w->z0, w->z0 + m->nq, s->data + l->d, size);
  for (int k = 0; k < m->nv; k++) {
    double rounding = FROT_ROUNDING * size[k];
    if (largest[m->nq + k] <= FROT_NOISE_MARGIN * rounding)
      noise[m->nq + k] = fmax(noise[m->nq + k], rounding);
  }
}

/* What rounding does to the derivatives at time t, into the state: that of the values and of the
 * time, by their influence, and that of the evaluation, by what a second difference leaves where
 * nothing bends so fast. A value whose derivative is nothing but rounding would shrink the step
 * without end. */
static void measure_noise(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l,
                          double t) {
  double *base = stage(l, w, 1), *forth = stage(l, w, 2), *back = stage(l, w, 3);
  double *noise = s->data + l->noise;
  int n = m->nq + m->nv;
  double *largest = w->f;
  for (int j = 0; j < n; j++) {
    largest[j] = 0;
    for (int i = 0; i <= DP_STAGES; i++) largest[j] = fmax(largest[j], fabs(stage(l, w, i)[j]));
  }
  memcpy(w->y, s->data + l->y, sizeof(double) * (size_t)m->ny);
  if (slope_at(m, s, w, l, t, w->z0, base) != FROT_OK) return;
  memset(noise, 0, sizeof(double) * (size_t)n);
  for (int pattern = 0; pattern < 2; pattern++) {
    for (int side = 0; side < 2; side++) {
      double moved = (side ? -1 : 1) * FROT_APART, *there = side ? back : forth;
      memcpy(w->ztry, w->z0, sizeof(double) * (size_t)l->nz);
      for (int j = 0; j < n; j++) w->ztry[j] *= 1 + (((j >> pattern) & 1) != 0 ? moved : -moved);
      memcpy(w->y, s->data + l->y, sizeof(double) * (size_t)m->ny);
      if (slope_at(m, s, w, l, t * (1 + moved), w->ztry, there) != FROT_OK) return;
    }
    for (int j = 0; j < n; j++) {
      double sensitivity = 0.5 * fabs(forth[j] - back[j]) * (FROT_NUDGE / FROT_APART);
      double rounding = 0.5 * fabs(forth[j] - 2 * base[j] + back[j]);
      noise[j] = fmax(noise[j], sensitivity + rounding);
    }
  }
  if (slope_at(m, s, w, l, t, w->z0, base) == FROT_OK) add_rounding(m, s, w, l, t, largest);
  /* a position can be no better than its speed */
  for (int j = 0; j < m->nq; j++) {
    if (m->q_speed[j] < 0) continue;
    int speed = m->nq + m->q_speed[j];
    noise[j] = fmax(noise[j], fmax(FROT_NUDGE * fabs(w->z0[speed]), fabs(s->h) * noise[speed]));
  }
}

/* Vectors of the dense output of the step h into w->f (DP_DENSE x nz). Takes three evaluations. */
static int make_dense(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l,
                      double t, double h) {
  if (s->implicit) return frot_implicit_dense(m, s, w, t, h);
  memcpy(w->y, s->data + l->y, sizeof(double) * (size_t)m->ny);
  for (int i = DP_STAGES + 1; i < DP_ALL; i++) {
    combine(w, l->nz, dp_a[i], i, h, w->z0, w->ztry);
    int status = slope_at(m, s, w, l, t + dp_c[i] * h, w->ztry, stage(l, w, i));
    if (status != FROT_OK) return status;
  }
  const double *start = stage(l, w, 0), *end = stage(l, w, DP_STAGES);
  for (int j = 0; j < width(w); j++) {
    double step = w->z1[j] - w->z0[j];
    w->f[j] = step;
    w->f[l->nz + j] = h * start[j] - step;
    w->f[2 * l->nz + j] = 2 * step - h * (end[j] + start[j]);
  }
  for (int i = 0; i < 4; i++) combine(w, l->nz, dp_d[i], DP_ALL, h, NULL, w->f + (3 + i) * l->nz);
  return FROT_OK;
}

static void guard_polynomial(const frot_state *s, const frot_work *w, const frot_layout *l,
                             int guard, double h, double g[7]) {
  for (int k = 0; s->implicit && k < 7; k++) g[k] = w->f[k * l->nz + l->nx + guard];
  if (s->implicit) return;
  for (int k = 0; k < 7; k++) {
    double sum = 0;
    for (int j = 0; j < DP_DENSE; j++) sum += dp_rate[k][j] * w->f[j * l->nz + l->nx + guard];
    g[k] = sum / h;
  }
}

/* The value below which guard j, at zero to rounding at time t, counts as fallen. */
static double fallen(const frot_model *m, const frot_state *s, const frot_layout *l, int j,
                     double t, double slope) {
  double size = s->data[l->scale_g + j];
  if (j < frot_condition_guard(m)) return FROT_ZERO * size;
  return CONDITION_ZERO * size + 8 * DBL_EPSILON * fabs(t) * fabs(slope);
}

/* Whether condition j is lost at the start of the step, where it is zero. One at whose coming to
 * hold a `when` fired may be lost however little it moves: a ball leaves the floor, and rounding
 * would hide the jump and the next fall with it. What a `reinit` has left at zero without a rate
 * does not hold there: it may come to hold again. */
static int lost_at_once(const frot_state *s, const frot_layout *l, int j, const double g[7],
                        double inside, int falls) {
  double rise = g[1] - g[0];
  if (s->data[l->fresh + j] == 0) return falls && g[0] <= 0 && rise < 0;
  return rise < (s->jumped ? FLAT : -2 * FROT_ROUNDING) * inside;
}

/* The first guard to fall inside the step from t, its theta in *theta; -1 when none does. A guard
 * that was zero at an event is known no better than its slope times the resolution of time. */
static int first_guard(const frot_model *m, const frot_state *s, const frot_work *w,
                       const frot_layout *l, double t, double h, double *theta) {
  int found = -1, conditions = frot_condition_guard(m);
  *theta = FROT_NO_ROOT;
  for (int k = 0; k < w->n_guards; k++) {
    double g[7];
    int j = w->guards[k];
    guard_polynomial(s, w, l, k, h, g);
    double size = s->data[l->scale_g + j], inside = 0;
    for (int i = 0; i < 7; i++) inside = fmax(inside, fabs(g[i]));
    size = fmax(size, inside);
    double slope = 6 * fabs(g[1] - g[0]) / h, first = g[0];
    /* what is zero at the start but for rounding, and rises, has not fallen */
    for (int i = 0;
         j < conditions && i < 6 && g[i] < 0 && g[i] >= -FROT_ZERO * size && g[i + 1] > g[i]; i++)
      g[i] = 0;
    double at = frot_first_fall(g, FROT_GUARD_FLOOR * size + 8 * DBL_EPSILON * fabs(t) * slope);
    if (j >= conditions && fabs(first) <= FROT_ZERO * size &&
        lost_at_once(s, l, j - conditions, g, inside, at < FROT_NO_ROOT))
      at = 0;
    if (at < *theta) *theta = at, found = k;
  }
  return found;
}

/* Move the end of the step onto the relations and evaluate there: a guard is read where the motion
 * will go on. */
static int land(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l, double t) {
  int moved;
  memcpy(w->y, w->y_end, sizeof(double) * (size_t)m->ny);
  int status =
      frot_project(m, s, w, t, w->z1, w->z1 + m->nq, s->data + l->d, modes_of(s, l), NULL, &moved);
  if (status != FROT_OK || !moved) return status;
  status = slope_at(m, s, w, l, t, w->z1, stage(l, w, DP_STAGES));
  memcpy(w->y_end, w->y, sizeof(double) * (size_t)m->ny);
  return status;
}

/* Shorten the step so that it ends where the listed guard j is zero, by the secant on steps made
 * anew: the event is as exact as the steps are. Returns a status; *h is the length and *falls
 * whether it does fall. */
static int locate(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l, double t,
                  int j, double theta, double *h, int *falls) {
  double longest = *h, g[7];
  guard_polynomial(s, w, l, j, *h, g);
  double span = 1e-4, left = fmax(theta - span, 0), right = fmin(theta + span, 1);
  double slope = (frot_bernstein(g, right) - frot_bernstein(g, left)) / ((right - left) * longest);
  double at = theta * longest, last_at = 0, last = 0, value = 0;
  for (int pass = 0;; pass++) {
    int status = run_stages(m, s, w, l, t, at);
    if (status == FROT_OK && !s->implicit) status = land(m, s, w, l, t + at);
    if (status != FROT_OK) return status;
    value = stage(l, w, DP_STAGES)[l->nx + j];
    if (pass > 0 && at != last_at && value != last) {
      double secant = (value - last) / (at - last_at);
      if (secant < 0) slope = secant;
    }
    if (value == 0 || !(slope < 0) || pass == LOCATE_PASSES) break;
    last_at = at, last = value;
    double next = at - value / slope;
    if (!(next > 0)) next = 0.5 * at;
    if (next > longest) next = longest;
    if (fabs(next - at) <= 2 * DBL_EPSILON * fmax(fabs(t + at), at) || next == at) break;
    at = next;
  }
  *h = at;
  /* A dip that never reaches zero is no event; the shorter step stands all the same. */
  double size = s->data[l->scale_g + w->guards[j]], close = 1e-9 * size;
  if (w->guards[j] >= frot_condition_guard(m))
    close = FROT_GUARD_FLOOR * size + 8 * DBL_EPSILON * fabs(t) * fabs(slope);
  *falls = value <= close;
  return FROT_OK;
}

void frot_interpolate(const frot_model *m, const frot_segment *g, double t, double *x) {
  int nx = frot_layout_of(m).nx;
  double theta = *g->h > 0 ? (t - *g->t0) / *g->h : 0, one = 1 - theta;
  for (int j = 0; j < nx; j++) {
    double sum = 0;
    for (int i = DP_DENSE - 1; i >= 0; i--) {
      sum += g->f[i * nx + j];
      sum *= i % 2 == 0 ? theta : one;
    }
    x[j] = g->x0[j] + sum;
  }
}

void frot_guess_unknowns(const frot_model *m, frot_work *w, const frot_segment *g, double t) {
  double theta = *g->h > 0 ? (t - *g->t0) / *g->h : 0;
  for (int k = 0; k < m->ny; k++) w->y[k] = g->y0[k] + theta * (g->y1[k] - g->y0[k]);
}

static void copy_modes(frot_state *s, const frot_layout *l, const frot_model *m,
                       const frot_segment *g) {
  memcpy(g->modes, s->data + l->modes, sizeof *g->modes * (size_t)(m->n_contacts + m->n_elements));
  memcpy(g->along, s->data + l->along, sizeof(double) * 2 * (size_t)m->n_elements);
  memcpy(g->d, s->data + l->d, sizeof(double) * (size_t)l->nd);
  memcpy(g->frozen, s->data + l->frozen, sizeof(double) * (size_t)m->nv);
}

void frot_make_instant(const frot_model *m, frot_state *s, const frot_work *w, double t,
                       const double *x) {
  frot_layout l = frot_layout_of(m);
  frot_segment g = frot_segment_at(m, s->data + l.segment);
  *g.t0 = *g.t1 = t;
  *g.h = 0;
  copy_modes(s, &l, m, &g);
  memcpy(s->data + l.y, w->y, sizeof(double) * (size_t)m->ny);
  memcpy(g.y0, w->y, sizeof(double) * (size_t)m->ny);
  memcpy(g.y1, w->y, sizeof(double) * (size_t)m->ny);
  memcpy(g.x0, x, sizeof(double) * (size_t)l.nx);
  memset(g.f, 0, sizeof(double) * DP_DENSE * (size_t)l.nx);
  memmove(s->data + l.x, x, sizeof(double) * (size_t)l.nx);
  s->has_slope = 0;
}

/* Sizes of the guards' terms at (t, z) into w->guard; the last evaluation was there. */
static void measure(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l,
                    double t, const double *z) {
  const double *d = s->data + l->d;
  for (int e = 0; e < m->n_elements; e++)
    for (int k = 0; k < 2 && m->elements[e].bound == FROT_BY_PIN; k++)
      w->end_reaction[2 * e + k] = w->lam[m->elements[e].bounded_by[k]];
  if (frot_guards_read_loads(m, w, modes_of(s, l))) frot_row_loads(m, s, w, t, z, z + m->nq, d);
  frot_guards(m, s, w, z, z + m->nq, d, modes_of(s, l), w->ztry, w->guard);
}

/* Note how large values and guards have been, after `measure` at z. */
static void note_sizes(const frot_model *m, frot_state *s, const frot_work *w, const frot_layout *l,
                       const double *z) {
  for (int j = 0; j < m->nq + m->nv; j++)
    s->data[l->scale_x + j] = fmax(s->data[l->scale_x + j], fabs(z[j]));
  for (int k = 0; k < w->n_guards; k++) {
    double *scale = s->data + l->scale_g + w->guards[k];
    *scale = fmax(*scale, w->guard[k]);
  }
  s->energy_scale = fmax(s->energy_scale, frot_kinetic(m, w, z + m->nq));
}

/* Derivative at the start of the step into stage 0. */
static int start_slope(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l,
                       double t) {
  memcpy(w->z0, s->data + l->x, sizeof(double) * (size_t)l->nx);
  memset(w->z0 + l->nx, 0, sizeof(double) * (size_t)l->ng);
  frot_list_guards(m, s, w, modes_of(s, l));
  if (s->has_slope) {
    memcpy(stage(l, w, 0), s->data + l->slope, sizeof(double) * (size_t)l->nz);
    return FROT_OK;
  }
  memcpy(w->z1, w->z0, sizeof(double) * (size_t)l->nx);
  memcpy(w->y, s->data + l->y, sizeof(double) * (size_t)m->ny);
  int status = slope_at(m, s, w, l, t, w->z0, stage(l, w, 0));
  if (status == FROT_OK) {
    memcpy(s->data + l->y, w->y, sizeof(double) * (size_t)m->ny);
    frot_turn_references(m, s, w);
    measure(m, s, w, l, t, w->z0);
    note_sizes(m, s, w, l, w->z0);
    memcpy(stage(l, w, 0) + l->nx, w->ztry, sizeof(double) * (size_t)w->n_guards);
  }
  return status;
}

/* The applied force that is no number at the last evaluation (values w->z1), or -1. */
static int wrong_load(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l) {
  double *sizes = w->ztry, *loads = w->values;
  if (m->n_loads == 0) return -1;
  frot_inputs(m, s, w, &w->t, w->z1, w->z1 + m->nq, s->data + l->d);
  w->res[0] = sizes, w->res[1] = loads;
  m->sizes.call(w->arg, w->res, w->iw, w->w, 0);
  for (int i = 0; i < m->n_loads; i++)
    if (!isfinite(loads[i])) return i;
  return -1;
}

/* The equation of the text that gives no number at the last evaluation (values w->z1), or -1. */
static int wrong_equation(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l) {
  if (m->n_watched == 0) return -1;
  frot_inputs(m, s, w, &w->t, w->z1, w->z1 + m->nq, s->data + l->d);
  w->arg[7] = w->a, w->arg[8] = w->lam;
  w->res[0] = w->values;
  m->watched.call(w->arg, w->res, w->iw, w->w, 0);
  for (int i = 0; i < m->n_watched; i++)
    if (!isfinite(w->values[i])) return i;
  return -1;
}

/* Record a fault with what is to blame: a block of equations, the contact of a coefficient or the
 * force that is no number or, when the step goes to zero, the state whose error forced it, or the
 * contact with the largest reaction where that is a coordinate or a speed. */
static int fail_at(const frot_model *m, frot_state *s, frot_work *w, int status, double t,
                   double h) {
  int blamed = -1;
  double largest = 0;
  frot_layout l = frot_layout_of(m);
  int equation = status == FROT_NAN ? wrong_equation(m, s, w, &l) : -1;
  if (equation >= 0) return frot_fail(s, FROT_NAN, t, -1, m->n_loads + equation, -1, h);
  if (status == FROT_ALGEBRAIC || (status == FROT_NAN && w->block >= 0))
    return frot_fail_evaluation(m, s, w, status, t);
  for (int e = 0; e < m->n_elements; e++) {
    const double *k = w->coefficient + 2 * e;
    const frot_element *element = &m->elements[e];
    int row = element->bounded_by[0] >= 0 ? element->bounded_by[0] : element->row;
    double size = fabs(w->lam[row]);
    int wrong = status == FROT_NAN ? isnan(k[0] + k[1]) : size > largest;
    if (wrong) largest = size, blamed = element->contact;
  }
  for (int i = 0; i < m->n_contacts && status != FROT_NAN; i++) {
    int row = m->contacts[i].row_n;
    if (row >= 0 && fabs(w->lam[row]) > largest) largest = fabs(w->lam[row]), blamed = i;
  }
  int load = status == FROT_NAN && blamed < 0 ? wrong_load(m, s, w, &l) : -1, state = -1;
  if (status == FROT_DIVERGE && w->worst >= 0) {
    int own = w->worst < m->nq && m->q_speed[w->worst] < 0;
    if (own) blamed = -1;
    if (own || blamed < 0) state = w->worst;
  }
  return frot_fail(s, status, t, blamed, load, state, h);
}

int frot_first_step(const frot_model *m, frot_state *s, frot_work *w) {
  frot_layout l = frot_layout_of(m);
  int status = start_slope(m, s, w, &l, s->t);
  if (status != FROT_OK) return fail_at(m, s, w, status, s->t, 0);
  double h = FIRST_PART * s->h_max;
  for (int j = 0; j < m->nq + m->nv; j++) {
    double slope = fabs(stage(&l, w, 0)[j]), size = fabs(w->z0[j]);
    if (slope > 0 && size > 0) h = fmin(h, 0.01 * size / slope);
  }
  h = frot_probe_step(m, s, w, s->t, fmax(h, 1e-6 * s->h_max));
  s->h = frot_finest_step(m, s, h);
  return FROT_OK;
}

/* Whether nothing moves, nor starts to. */
static int is_still(const frot_model *m, const frot_work *w) {
  for (int j = 0; j < m->nq + m->nv; j++)
    if (w->k[j] != 0) return 0;
  return 1;
}

static int fire_at_start(frot_state *s, const frot_work *w, const frot_layout *l, int guard) {
  s->data[l->fired + w->guards[guard]] = 1;
  memcpy(s->data + l->slope, w->k, sizeof(double) * (size_t)l->nz);
  s->pending = 1;
  return FROT_OK;
}

/* Guards that have come to zero together with the first one at the end of the step. */
static void fire(const frot_model *m, frot_state *s, const frot_work *w, const frot_layout *l,
                 int first, double t, double h) {
  const double *end = w->k + DP_STAGES * l->nz + l->nx, *start = w->k + l->nx;
  for (int k = 0; k < w->n_guards; k++) {
    double g[7];
    guard_polynomial(s, w, l, k, h, g);
    double limit = fallen(m, s, l, w->guards[k], t + h, 6 * (g[6] - g[5]) / h);
    if (k == first || (end[k] <= limit && start[k] > limit)) s->data[l->fired + w->guards[k]] = 1;
  }
  s->pending = 1;
}

/* The listed guard of the first condition: they are all listed, last. */
static int first_condition(const frot_model *m, const frot_work *w) {
  return w->n_guards - m->n_located;
}

/* After a stage that gave no number (its values in w->z1): a condition may have passed through zero
 * before it, beyond which its branch has no value, as a root. The first such one, -1 if none; *part
 * is the part of the step h from t after which it seems to be zero. */
static int condition_passed(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l,
                            double t, double h, double *part) {
  const double *d = s->data + l->d, *start = w->k + l->nx + first_condition(m, w);
  int passed = -1;
  if (m->n_located == 0 || !frot_all_finite(w->z1, m->nq + m->nv)) return -1;
  memcpy(w->y, s->data + l->y, sizeof(double) * (size_t)m->ny);
  if (frot_kinematics(m, s, w, w->t, w->z1, w->z1 + m->nq, d) != FROT_OK) return -1;
  *part = 1;
  for (int j = 0; j < m->n_located; j++) {
    double value = d[j] != 0 ? w->condition[j] : -w->condition[j];
    if (!(value < 0 && start[j] >= 0)) continue;
    double at = (w->t - t) / h * start[j] / (start[j] - value);
    if (at <= *part) *part = at, passed = j;
  }
  return passed;
}

/* Turn the pins' references at the end of the step, and with them the guards in its slope. */
static void turn_at_end(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l,
                        double *slope) {
  for (int e = 0; e < m->n_elements; e++)
    for (int k = 0; k < 2 && m->elements[e].bound == FROT_BY_PIN; k++)
      w->lam[m->elements[e].bounded_by[k]] = w->end_reaction[2 * e + k];
  frot_turn_references(m, s, w);
  for (int k = 0; k < w->n_guards && w->guards[k] < frot_condition_guard(m); k++) {
    int e = (w->guards[k] - m->n_contacts) / 2;
    if (w->guards[k] < m->n_contacts || w->guards[k] == frot_element_guard(m, e)) continue;
    if (frot_element_mode(m, modes_of(s, l), e)->friction == FROT_STICK) continue;
    const double *along = s->data + l->along + 2 * e, *reaction = w->end_reaction + 2 * e;
    slope[l->nx + k] = along[0] * reaction[0] + along[1] * reaction[1];
  }
}

/* Where no step is possible: a condition that is zero there, so that the branch may end before it,
 * as that of a tank that runs empty. -1 if there is none. */
static int condition_at_zero(const frot_model *m, const frot_state *s, const frot_work *w,
                             const frot_layout *l) {
  const double *guard = w->k + l->nx + first_condition(m, w);
  for (int j = 0; j < m->n_located; j++)
    if (fabs(guard[j]) <= FROT_GUARD_FLOOR * s->data[l->scale_g + frot_condition_guard(m) + j])
      return j;
  return -1;
}

/* What the ratio of an error to its bound is raised to for the change of the step. */
static double order_power(const frot_state *s) { return s->implicit ? -1.0 / 5 : -1.0 / 8; }

int frot_step(const frot_model *m, frot_state *s, frot_work *w) {
  frot_layout l = frot_layout_of(m);
  frot_segment g = frot_segment_at(m, s->data + l.segment);
  double t = *g.t1, longest = frot_longest_step(m, s, t, 0);
  double h = fmin(s->h, longest), stable;
  if (s->due <= t) {
    frot_fire_due(m, s);
    return FROT_OK;
  }
  int status = start_slope(m, s, w, &l, t), rejections = 0, stiff = 0, changed = 0;
  if (status != FROT_OK) return fail_at(m, s, w, status, t, 0);
  if (is_still(m, w)) {
    longest = frot_longest_step(m, s, t, 1);
    h = m->time_dependent ? fmin(s->h, longest) : longest;
  }
  if (s->implicit) status = frot_implicit_begin(m, s, w, t);
  if (status != FROT_OK) return fail_at(m, s, w, status, t, 0);
  double planned = s->h;
  int passed = -1;              /* condition beyond which the last try had no value */
  int to_due = h >= s->due - t; /* the step ends where time changes a condition */
  if (to_due) h = s->due - t;
  double power = order_power(s), first = h;
  for (;;) {
    double paced = frot_pace_step(m, s, w, t, h);
    if (paced < h) h = paced, to_due = 0;
    if (!to_due && !(h > LEAST_STEP * fmax(fabs(t), LEAST_TIME * s->h_max))) {
      int ends = condition_at_zero(m, s, w, &l);
      int over = passed >= 0 && ends >= 0; /* no method has a value beyond it */
      if (!over && !changed && frot_change_method(m, s)) {
        int begun = s->implicit ? frot_implicit_begin(m, s, w, t) : FROT_OK;
        changed = 1, h = first, power = order_power(s);
        if (begun == FROT_OK) continue;
      }
      if (ends >= 0) return fire_at_start(s, w, &l, first_condition(m, w) + ends);
      return fail_at(m, s, w, status == FROT_OK ? FROT_DIVERGE : status, t, h);
    }
    status = run_stages(m, s, w, &l, t, h);
    double part = 1;
    passed = status == FROT_NAN ? condition_passed(m, s, w, &l, t, h, &part) : -1;
    double ratio = status == FROT_OK ? error_ratio(m, s, w, &l, t, h) : NAN;
    if (ratio <= 1) {
      stiff = frot_is_stiff(m, s, w, h);
      stable = frot_stable_step(m, s, w);
      measure(m, s, w, &l, t + h, w->z1);
      status = make_dense(m, s, w, &l, t, h);
      if (status == FROT_OK && s->implicit && !frot_implicit_follows_guards(m, s, w))
        status = FROT_DIVERGE;
      if (status == FROT_OK) {
        double factor = ratio > 0 ? 0.9 * pow(ratio, power) : 6;
        s->h = fmin(h * fmin(fmax(factor, 1.0 / 3), rejections ? 1 : 6), fmin(longest, stable));
        if (to_due) s->h = fmax(s->h, planned);
        break;
      }
      ratio = NAN;
    }
    s->statistics.rejected++;
    to_due = 0;
    if (++rejections % PATIENCE == 0 && ratio > 1) measure_noise(m, s, w, &l, t + h);
    if (rejections % HOLD == 0) frot_hold_worth(m, s, w);
    h *= ratio > 1 && ratio < 1e300 ? fmax(0.9 * pow(ratio, power), 1.0 / 3)
         : passed >= 0              ? fmin(fmax(NEARLY * part, 0.01), NEARLY)
                                    : 0.25;
  }

  double theta;
  int guard = first_guard(m, s, w, &l, t, h, &theta), falls = 0;
  if (guard >= 0) {
    if (theta * h <= LEAST_STEP * fmax(fabs(t), h)) return fire_at_start(s, w, &l, guard);
    status = locate(m, s, w, &l, t, guard, theta, &h, &falls);
    to_due = 0;
    if (status == FROT_OK) {
      measure(m, s, w, &l, t + h, w->z1);
      status = make_dense(m, s, w, &l, t, h);
    }
    if (status != FROT_OK) return fail_at(m, s, w, status, t, h);
  }
  s->statistics.steps++;
  s->statistics.implicit_steps += s->implicit;
  memset(s->data + l.fresh, 0, sizeof(double) * (size_t)m->n_conditions);
  note_sizes(m, s, w, &l, w->z1);
  frot_note_worth(m, s, w->z1);
  if (falls) fire(m, s, w, &l, guard, t, h);
  if (to_due) frot_fire_due(m, s);
  for (int j = 0; j < m->nq + m->nv; j++) s->data[l.noise + j] *= FORGET;

  *g.t0 = t, *g.t1 = to_due ? s->due : t + h, *g.h = h;
  copy_modes(s, &l, m, &g);
  memcpy(g.y0, s->data + l.y, sizeof(double) * (size_t)m->ny);
  memcpy(g.y1, w->y_end, sizeof(double) * (size_t)m->ny);
  memcpy(g.x0, w->z0, sizeof(double) * (size_t)l.nx);
  for (int i = 0; i < DP_DENSE; i++)
    memcpy(g.f + i * l.nx, w->f + i * l.nz, sizeof(double) * (size_t)l.nx);

  /* Onto the relations; the slope at the end serves the next step if nothing moved. */
  double *x = s->data + l.x, *slope = s->data + l.slope;
  memcpy(x, w->z1, sizeof(double) * (size_t)l.nx);
  memcpy(slope, stage(&l, w, DP_STAGES), sizeof(double) * (size_t)l.nz);
  int moved;
  memcpy(w->y, w->y_end, sizeof(double) * (size_t)m->ny);
  status = frot_project(m, s, w, *g.t1, x, x + m->nq, s->data + l.d, modes_of(s, &l), NULL, &moved);
  if (status != FROT_OK) return fail_at(m, s, w, status, *g.t1, h);
  memcpy(s->data + l.y, w->y, sizeof(double) * (size_t)m->ny);
  s->has_slope = !moved && !s->pending;
  if (s->has_slope) turn_at_end(m, s, w, &l, slope);
  frot_choose_next(m, s, stiff);
  if (*g.t1 > s->crowded_since + 1e-9 * s->h_max) s->crowded_since = *g.t1, s->crowded = 0;
  return FROT_OK;
}
