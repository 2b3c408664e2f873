#include "methods/rodas.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "singular/singular_posture.h"
#include "methods/jacobian.h"
#include "methods/right_hand_side.h"
#include "methods/radau.h"
#include "numerics/rodas_table.h"
#include "numerics/bernstein.h"
#include "methods/error_scales.h"
#include "numerics/tolerances.h"

#define TAKE(field, count) FROT_TAKE(a, field, count)

#define GUARD_NODES 7 /* values at k/6 */

/* Rows of w->step.k: the slopes at both ends, U_1 .. U_8 between, then scratch. */
#define FIRST_ROW 1
#define SLOPE_ROW (DP_STAGES + 1)
#define RIGHT_ROW (DP_STAGES + 2)

typedef char frot_rows_suffice[FIRST_ROW + RO_STAGES <= DP_STAGES && RIGHT_ROW < DP_ALL ? 1 : -1];

/* Bernstein coefficients, times 600, of the polynomial through values at k/6. */
static const double through[GUARD_NODES][GUARD_NODES] = {
    {600, 0, 0, 0, 0, 0, 0},
    {-870, 3600, -4500, 4000, -2250, 720, -100},
    {908, -5328, 12060, -12320, 7380, -2448, 348},
    {-681, 4536, -12555, 18000, -12555, 4536, -681},
    {348, -2448, 7380, -12320, 12060, -5328, 908},
    {-100, 720, -2250, 4000, -4500, 3600, -870},
    {0, 0, 0, 0, 0, 0, 600},
};

static double *row(const frot_layout *l, const frot_work *w, int i) {
  return w->step.k + i * l->nz;
}

size_t frot_implicit_doubles(const frot_model *m) {
  size_t doubles = 0;
  if (m->has_jacobian) frot_jacobian_of(m, NULL, &doubles, NULL);
  return doubles;
}

size_t frot_implicit_integers(const frot_model *m) {
  size_t doubles, integers = 0;
  if (m->has_jacobian) frot_jacobian_of(m, NULL, &doubles, &integers);
  return integers;
}

int frot_implicit_begin(const frot_model *m, frot_state *s, frot_work *w, double t) {
  const frot_layout *l = &w->layout;
  memcpy(w->blocks.y, s->data + l->y, sizeof(double) * (size_t)m->ny);
  int status = frot_jacobian_at(m, s, w, t, w->step.z0, s->data + l->d, row(l, w, SLOPE_ROW));
  if (status == FROT_OK && frot_has_loops(m, s, w)) frot_note_rows(m, s, w, 1);
  return status;
}

/* Sums over j < count of a[j] U_j and b[j] U_j (and c[j] U_j) for a pair of states, or for one: in
 * one pass over memory, in registers, and no sum waits for another. */
typedef struct {
  double a[2], b[2], c[2];
} sums;

static inline sums weigh(const double *u, int nz, int pair, const double *a, const double *b,
                         const double *c, int count) {
  double a0 = 0, a1 = 0, b0 = 0, b1 = 0, c0 = 0, c1 = 0;
  for (int j = 0; j < count; j++, u += nz) {
    double first = u[0], second = u[pair];
    a0 += a[j] * first, a1 += a[j] * second;
    b0 += b[j] * first, b1 += b[j] * second;
    if (c) c0 += c[j] * first, c1 += c[j] * second;
  }
  return (sums){{a0, a1}, {b0, b1}, {c0, c1}};
}

/* For stage i: its argument into z, which holds that of the stage before, and sum C_ij U_j / h
 * into right. */
static void prepare(const frot_layout *l, const frot_work *w, int n, int i, double h, double *z,
                    double *right) {
  static const double none[RO_STAGES] = {0};
  const double *u = row(l, w, FIRST_ROW), *last = row(l, w, FIRST_ROW + i - 1), *z0 = w->step.z0;
  const double *a = i < RO_ROWS ? ro_a[i] : none;
  double c[RO_STAGES];
  for (int j = 0; j < i; j++) c[j] = ro_C[i][j] / h;
  for (int k = 0; k < n; k += 2) {
    int pair = k + 1 < n;
    sums s = weigh(u + k, l->nz, pair, a, c, NULL, i);
    for (int e = 0; e <= pair; e++) {
      z[k + e] = i < RO_ROWS ? z0[k + e] + s.a[e] : z[k + e] + last[k + e];
      right[k + e] = s.b[e];
    }
  }
}

int frot_implicit_stages(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  if (frot_has_motion(m)) return frot_radau_stages(m, s, w, t, h);
  frot_layout l = frot_layout_of(m);
  frot_jacobian jacobian = frot_jacobian_of(m, w, NULL, NULL);
  int n = m->nq, status;
  double shift = 1 / (h * ro_gamma), *z = w->step.z1;
  memcpy(z, w->step.z0, sizeof(double) * (size_t)l.nx);
  memcpy(w->blocks.y, s->data + l.y, sizeof(double) * (size_t)m->ny);
  if (frot_jacobian_factor(m, w, shift)) return FROT_DIVERGE;
  for (int i = 0; i < RO_STAGES; i++) {
    double *slope = i == 0 ? row(&l, w, 0) : row(&l, w, SLOPE_ROW);
    double *right = row(&l, w, RIGHT_ROW), *u = row(&l, w, FIRST_ROW + i);
    if (i > 0) {
      prepare(&l, w, n, i, h, z, right);
      double at = i >= RO_ROWS - 1 ? t + h : t + ro_c[i] * h;
      if ((status = frot_slope(m, s, w, at, z, slope)) != FROT_OK) return status;
    }
    double by_time = h * ro_d[i];
    for (int k = 0; k < n; k++) right[k] = i > 0 ? slope[k] + right[k] : slope[k];
    for (int k = 0; m->time_dependent && k < n; k++) right[k] += by_time * jacobian.rate[k];
    frot_jacobian_solve(m, w, right, u);
    if (i == 0 && !(frot_jacobian_error(m, w, shift, right, u) < FROT_GROWN)) return FROT_DIVERGE;
  }
  const double *last = row(&l, w, FIRST_ROW + RO_STAGES - 1);
  for (int k = 0; k < n; k++) z[k] += last[k];
  status = frot_slope(m, s, w, t + h, z, row(&l, w, DP_STAGES));
  memcpy(w->step.y_end, w->blocks.y, sizeof(double) * (size_t)m->ny);
  return status;
}

/* The worst estimate of the local error over its bound; w->step.worst is the state it is of. */
static double worst_error(const frot_model *m, const frot_state *s, frot_work *w,
                          const frot_layout *l, double h) {
  double tolerance = fmax(FROT_IMPLICIT_SHARE * s->tolerance, FROT_LEAST_IMPLICIT), worst = 0;
  const double *error =
      row(l, w, frot_has_motion(m) ? FROT_RADAU_ERROR : FIRST_ROW + RO_STAGES - 1);
  const double *damping = frot_jacobian_damping(m, w, h);
  w->step.worst = -1, w->step.noisy = 0, w->step.pardoned = 0;
  for (int k = 0; k < frot_order(m); k++) {
    if (error[k] == 0) continue;
    double bound = fmax(tolerance * w->sizes.own[k], DBL_MIN);
    double noise = frot_rate_rounding(m, s, w, k, h);
    double rounding = noise > 0 ? FROT_NOISE_OF_RATES * h * noise / damping[k] : 0;
    int plain = k < m->nq && m->q_speed[k] < 0;
    w->step.pardoned |= plain && fabs(error[k]) > bound && fabs(error[k]) <= rounding;
    bound = fmax(bound, rounding);
    if (plain && fabs(error[k]) > bound) bound = fmax(bound, frot_rounding_of_turn(m, k));
    double ratio = fabs(error[k]) / bound;
    if (!(ratio <= worst)) worst = ratio, w->step.worst = k;
    if (isnan(worst)) break;
  }
  return worst;
}

double frot_implicit_error(const frot_model *m, frot_state *s, frot_work *w, double h) {
  frot_layout l = frot_layout_of(m);
  const double *slope = row(&l, w, 0);
  frot_motion_sizes(m, s, w, h, slope, 1);
  /* a stiff state does not go where its slope at the start points to */
  for (int k = 0; k < m->nq; k++) {
    double pointed = h * fabs(slope[k]), gone = fabs(w->step.z1[k] - w->step.z0[k]);
    w->sizes.change[k] = pointed < gone ? pointed : gone;
    w->sizes.left[k] = INFINITY;
  }
  if (frot_state_sizes(m, s, w)) {
    for (int k = 0; k < m->nq; k++)
      if (w->sizes.own[k] == 0) w->sizes.change[k] = fabs(w->step.z1[k] - w->step.z0[k]);
    frot_state_sizes(m, s, w);
  }
  double worst = worst_error(m, s, w, &l, h);
  if (!(worst > FROT_LIMITING) || w->step.worst < 0 || w->step.worst >= m->nq ||
      !frot_is_small(m, s, w, w->step.worst))
    return worst;
  frot_raise_small(m, s, w, h, 0);
  return worst_error(m, s, w, &l, h);
}

/* State inside the step by the vectors w->step.f. */
static void inside(const frot_model *m, const frot_layout *l, const frot_work *w, double theta,
                   double *z) {
  const double *f = w->step.f;
  for (int k = 0; k < frot_order(m); k++) {
    double sum = 0;
    for (int i = DP_DENSE - 1; i >= 0; i--)
      sum = (sum + f[i * l->nz + k]) * (i % 2 == 0 ? theta : 1 - theta);
    z[k] = w->step.z0[k] + sum;
  }
}

/* Polynomials of the guards, and how far they miss them near both ends, where such a polynomial is
 * at its worst. */
static int follow_guards(const frot_model *m, frot_state *s, frot_work *w, const frot_layout *l,
                         double t, double h) {
  frot_jacobian jacobian = frot_jacobian_of(m, w, NULL, NULL);
  int count = w->guards.count;
  double *slope = row(l, w, SLOPE_ROW), *value = w->step.f + l->nx;
  const double *start = row(l, w, 0) + l->nx, *end = row(l, w, DP_STAGES) + l->nx;
  memcpy(w->step.z, w->step.z0, sizeof(double) * (size_t)l->nx);
  for (int i = 0; i < GUARD_NODES; i++) {
    const double *from = i == 0 ? start : i == GUARD_NODES - 1 ? end : slope + l->nx;
    if (from == slope + l->nx) {
      double theta = i / (GUARD_NODES - 1.0);
      inside(m, l, w, theta, w->step.z);
      int status = frot_slope(m, s, w, t + theta * h, w->step.z, slope);
      if (status != FROT_OK) return status;
    }
    for (int g = 0; g < count; g++) value[i * l->nz + g] = from[g];
  }
  for (int g = 0; g < count; g++) {
    double at[GUARD_NODES];
    for (int i = 0; i < GUARD_NODES; i++) at[i] = value[i * l->nz + g];
    for (int i = 0; i < GUARD_NODES; i++) {
      double sum = 0;
      for (int j = 0; j < GUARD_NODES; j++) sum += through[i][j] * at[j];
      value[i * l->nz + g] = sum / 600;
    }
    jacobian.misfit[g] = 0;
  }
  for (int i = 0; i < 2; i++) {
    double theta = i == 0 ? 1.0 / 12 : 11.0 / 12;
    inside(m, l, w, theta, w->step.z);
    int status = frot_slope(m, s, w, t + theta * h, w->step.z, slope);
    if (status != FROT_OK) return status;
    for (int g = 0; g < count; g++) {
      double b[GUARD_NODES];
      for (int k = 0; k < GUARD_NODES; k++) b[k] = value[k * l->nz + g];
      double miss = fabs(frot_bernstein(b, theta) - slope[l->nx + g]);
      jacobian.misfit[g] = fmax(jacobian.misfit[g], miss);
    }
  }
  return FROT_OK;
}

int frot_implicit_dense(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  frot_layout l = frot_layout_of(m);
  if (frot_has_motion(m)) {
    memset(w->step.f, 0, sizeof(double) * (size_t)(DP_DENSE * l.nz));
    int status = frot_radau_dense(m, s, w, t, h);
    if (status != FROT_OK) return status;
    return w->guards.count > 0 ? follow_guards(m, s, w, &l, t, h) : FROT_OK;
  }
  for (int i = 0; i < DP_DENSE; i++) { /* what no state fills below */
    int from = i < 4 ? m->nq : 0;
    memset(w->step.f + i * l.nz + from, 0, sizeof(double) * (size_t)(l.nz - from));
  }
  const double *u = row(&l, w, FIRST_ROW);
  double *f = w->step.f;
  for (int k = 0; k < m->nq; k += 2) {
    int pair = k + 1 < m->nq;
    sums c = weigh(u + k, l.nz, pair, ro_h[0], ro_h[1], ro_h[2], RO_STAGES);
    for (int e = 0; e <= pair; e++) {
      f[k + e] = w->step.z1[k + e] - w->step.z0[k + e];
      f[l.nz + k + e] = c.a[e];
      f[2 * l.nz + k + e] = c.b[e] + c.c[e];
      f[3 * l.nz + k + e] = -c.c[e];
    }
  }
  return w->guards.count > 0 ? follow_guards(m, s, w, &l, t, h) : FROT_OK;
}

int frot_implicit_follows_guards(const frot_model *m, const frot_state *s, const frot_work *w) {
  frot_layout l = frot_layout_of(m);
  frot_jacobian jacobian = frot_jacobian_of(m, w, NULL, NULL);
  double tolerance = frot_guard_tolerance(s->tolerance);
  for (int g = 0; g < w->guards.count; g++) {
    double size = fmax(fabs(row(&l, w, 0)[l.nx + g]), fabs(row(&l, w, DP_STAGES)[l.nx + g]));
    size = fmax(size, FROT_GUARD_LOOSEST * s->data[l.most_g + w->guards.list[g]]);
    if (!(jacobian.misfit[g] <= tolerance * size)) return 0;
  }
  return 1;
}

double frot_implicit_rate(const frot_model *m, const frot_work *w) {
  return frot_jacobian_bound(m, w, w->sizes.own);
}

void frot_bind_implicit(const frot_model *m, frot_implicit_work *w, frot_arena *a) {
  TAKE(w->items, frot_implicit_doubles(m)), TAKE(w->pivot, frot_implicit_integers(m));
}
