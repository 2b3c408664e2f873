#include "methods/radau.h"

#include <math.h>
#include <string.h>

#include "numerics/dense_complex.h"
#include "singular/singular_posture.h"
#include "constraints/locked_speeds.h"
#include "methods/jacobian.h"
#include "methods/right_hand_side.h"
#include "numerics/radau_table.h"
#include "model/segment.h"
#include "methods/error_scales.h"
#include "numerics/sparse_complex.h"
#include "methods/dormand_prince.h"
#include "numerics/tolerances.h"

/* Newton's method: passes, the part of a step's error that it may leave, the rate (change of a pass
 * over that of the one before) at which it no longer converges, how much it is slower than it was
 * where rounding is all that is left, and the part of the error below which it may be. */
#define PASSES 16
#define LEFT 1e-3
#define STALLED 0.9
#define SLOWER 3
#define ROUNDED 0.1
/* How far beyond its end, in its lengths, the last step shows where the next one goes. */
#define BEYOND 2

typedef char frot_radau_vectors_suffice[RA_VECTORS <= DP_DENSE ? 1 : -1];
typedef char frot_radau_rows_suffice[FROT_RADAU_ERROR < DP_STAGES ? 1 : -1];

typedef struct {
  double *moved;   /* RA_STAGES x n: w, where what the stages have moved is T w */
  double *change;  /* RA_STAGES x n: right sides, then changes of w */
  double *factors; /* RA_PAIRS x 2 x as many as a factor has */
  double *sparse;  /* 2 n */
  int *pivot;      /* RA_PAIRS x n */
} scratch;

/* Items of a factor. */
static int items_of(const frot_model *m) {
  int n = frot_order(m);
  return m->pattern.n > 0 ? m->pattern.start[n] : n * n;
}

static scratch scratch_of(const frot_model *m, const frot_work *w) {
  int n = frot_order(m);
  double *base = w->implicit.items;
  double *factors = base + 2 * RA_STAGES * n, *sparse = factors + 2 * RA_PAIRS * items_of(m);
  return (scratch){base, base + RA_STAGES * n, factors, sparse, w->implicit.pivot};
}

size_t frot_radau_doubles(const frot_model *m) {
  return (size_t)(2 * (RA_STAGES + 1) * frot_order(m) + 2 * RA_PAIRS * items_of(m));
}

size_t frot_radau_integers(const frot_model *m) { return (size_t)(RA_PAIRS * frot_order(m)); }

static double *row(const frot_work *w, int i) { return frot_stage(w, i); }

/* Factor (a + i b)/h I - J for each pair, and ra_gamma/h I - J. */
static int factor(const frot_model *m, frot_work *w, const scratch *x, double h) {
  if (frot_jacobian_factor(m, w, ra_gamma / h)) return 1;
  int n = frot_order(m), items = items_of(m);
  frot_jacobian j = frot_jacobian_of(m, w, NULL, NULL);
  for (int p = 0; p < RA_PAIRS; p++) {
    double *re = x->factors + 2 * p * items, *im = re + items;
    if (m->pattern.n > 0) {
      if (frot_sparse_complex_factor(&m->pattern, j.entries, ra_a[p] / h, ra_b[p] / h, re,
                                     x->sparse))
        return 1;
      continue;
    }
    for (int i = 0; i < n * n; i++) re[i] = -j.entries[i];
    memset(im, 0, sizeof(double) * (size_t)items);
    for (int i = 0; i < n; i++) re[(n + 1) * i] += ra_a[p] / h, im[(n + 1) * i] = ra_b[p] / h;
    if (frot_complex_lu(re, im, n, x->pivot + p * n, j.scale)) return 1;
  }
  return 0;
}

/* The first guess extrapolates the last step; a state that stays has none to extrapolate. */
static void guess(const frot_model *m, frot_state *s, frot_work *w, const scratch *x, double t,
                  double h) {
  int n = frot_order(m);
  frot_segment last = frot_segment_at(m, s->data + w->layout.segment);
  memset(x->moved, 0, sizeof(double) * (size_t)(RA_STAGES * n));
  if (!s->was_implicit || !(*last.h > 0) || h > BEYOND * *last.h) return;
  double *start = row(w, DP_STAGES + 1), *there = row(w, DP_STAGES + 2);
  frot_interpolate(m, &last, t, start);
  for (int i = 0; i < RA_STAGES; i++) {
    frot_interpolate(m, &last, t + ra_c[i] * h, there);
    for (int r = 0; r < RA_STAGES; r++)
      for (int k = 0; k < n; k++) x->moved[r * n + k] += ra_TI[r][i] * (there[k] - start[k]);
  }
  for (int k = 0; k < n; k++)
    for (int r = 0; r < RA_STAGES && frot_state_stays(m, s->data + w->layout.frozen, k); r++)
      x->moved[r * n + k] = 0;
}

/* Slopes of the stages at what w gives. */
static int evaluate(const frot_model *m, frot_state *s, frot_work *w, const scratch *x, double t,
                    double h) {
  int n = frot_order(m), loops = frot_has_loops(m, s, w);
  double *z = w->step.z1;
  for (int i = 0; i < RA_STAGES; i++) {
    double *moved = row(w, FROT_RADAU_MOVED + i);
    for (int k = 0; k < n; k++) {
      double sum = 0;
      for (int r = 0; r < RA_STAGES; r++) sum += ra_T[i][r] * x->moved[r * n + k];
      moved[k] = sum, z[k] = w->step.z0[k] + sum;
    }
    int status = frot_slope(m, s, w, t + ra_c[i] * h, z, row(w, FROT_RADAU_SLOPES + i));
    if (status != FROT_OK) return status;
    if (frot_has_jammed(s, w)) return FROT_DIVERGE;
    if (loops) frot_note_rows(m, s, w, 2 + i);
  }
  return FROT_OK;
}

/* One pass of Newton's method: the change of w. */
static void improve(const frot_model *m, const frot_work *w, const scratch *x, double h) {
  int n = frot_order(m), items = items_of(m);
  frot_jacobian j = frot_jacobian_of(m, w, NULL, NULL);
  for (int r = 0; r < RA_STAGES; r++) {
    double *right = x->change + r * n;
    for (int k = 0; k < n; k++) right[k] = 0;
    for (int i = 0; i < RA_STAGES; i++) {
      const double *slope = row(w, FROT_RADAU_SLOPES + i);
      for (int k = 0; k < n; k++) right[k] += ra_TI[r][i] * slope[k];
    }
  }
  for (int k = 0; k < n; k++) x->change[k] -= ra_gamma / h * x->moved[k];
  frot_jacobian_solve(m, w, x->change, x->change);
  for (int p = 0; p < RA_PAIRS; p++) {
    const double *u = x->moved + (1 + 2 * p) * n, *v = u + n, *re = x->factors + 2 * p * items;
    double *first = x->change + (1 + 2 * p) * n, *second = first + n, a = ra_a[p] / h,
           b = ra_b[p] / h;
    for (int k = 0; k < n; k++) {
      first[k] -= a * u[k] - b * v[k];
      second[k] -= b * u[k] + a * v[k];
    }
    if (m->pattern.n > 0)
      frot_sparse_complex_apply(&m->pattern, re, x->sparse, first, second);
    else
      frot_complex_apply(re, re + items, n, x->pivot + p * n, j.scale, first, second);
  }
}

/* Largest change of a state in the pass, in sizes of the states; these grow with what they move.
 * What rounding of its rate changes is none. */
static double size_of_change(const frot_model *m, const frot_state *s, const frot_work *w,
                             const scratch *x, double h) {
  int n = frot_order(m);
  const double *most = s->data + w->layout.scale_x, *worth = s->data + w->layout.worth;
  double largest = 0;
  for (int k = 0; k < n; k++) {
    int own = k < m->nq && m->q_speed[k] < 0;
    double size = fmax(own ? worth[k] : most[k], fabs(w->step.z0[k])), change = 0;
    for (int i = 0; i < RA_STAGES; i++) {
      double sum = 0;
      for (int r = 0; r < RA_STAGES; r++) sum += ra_T[i][r] * x->change[r * n + k];
      size = fmax(size, fabs(row(w, FROT_RADAU_MOVED + i)[k]));
      change = fmax(change, fabs(sum));
    }
    change -= FROT_NOISE_MARGIN * h * frot_rate_rounding(m, s, w, k, h);
    if (change <= 0 || (own && change <= frot_rounding_of_turn(m, k))) continue;
    if (!(change <= largest * fmax(size, change))) largest = change / fmax(size, change);
    if (isnan(largest)) break;
  }
  return largest;
}

/* Solve the stages. FROT_OK, FROT_DIVERGE or the status of an evaluation. */
static int iterate(const frot_model *m, frot_state *s, frot_work *w, const scratch *x, double t,
                   double h) {
  double error = fmax(FROT_IMPLICIT_SHARE * s->tolerance, FROT_LEAST_IMPLICIT), last = INFINITY;
  double best = INFINITY;
  int n = frot_order(m);
  w->implicit.rate = 0;
  for (int pass = 0; pass < PASSES; pass++) {
    int status = evaluate(m, s, w, x, t, h);
    if (status != FROT_OK) return status;
    improve(m, w, x, h);
    double change = size_of_change(m, s, w, x, h), rate = change / last;
    if (!isfinite(change)) return FROT_DIVERGE;
    for (int k = 0; k < RA_STAGES * n; k++) x->moved[k] += x->change[k];
    if (change <= FROT_ROUNDING) return FROT_OK;
    /* a rate that grows where little changes is that of rounding */
    if (pass > 0 && rate >= fmin(STALLED, SLOWER * best) && change <= ROUNDED * error)
      return FROT_OK;
    if (pass > 0 && rate >= STALLED) {
      if (rate > 2 || pass > 2) return FROT_DIVERGE;
    } else if (pass > 0) {
      best = fmin(best, rate);
      if (last > ROUNDED * error) w->implicit.rate = fmax(w->implicit.rate, rate);
      if (rate / (1 - rate) * change <= LEFT * error) return FROT_OK;
      if (pow(rate, PASSES - pass) * change > error) return FROT_DIVERGE;
    }
    last = change;
  }
  return FROT_DIVERGE;
}

/* What the stages and the energies have moved. */
static void finish(const frot_model *m, frot_work *w, const scratch *x, double h) {
  int n = frot_order(m);
  for (int i = 0; i < RA_STAGES; i++) {
    double *moved = row(w, FROT_RADAU_MOVED + i);
    for (int k = 0; k < n + FROT_QUADRATURES; k++) {
      double sum = 0;
      for (int r = 0; r < RA_STAGES; r++)
        sum += k < n ? ra_T[i][r] * x->moved[r * n + k]
                     : h * ra_A[i][r] * row(w, FROT_RADAU_SLOPES + r)[k];
      moved[k] = sum;
    }
  }
  const double *last = row(w, FROT_RADAU_MOVED + RA_STAGES - 1);
  for (int k = 0; k < n + FROT_QUADRATURES; k++) w->step.z1[k] = w->step.z0[k] + last[k];
}

/* The error. 0, or 1 where the factors without pivoting do not give it. */
static int estimate(const frot_model *m, frot_work *w, const scratch *x, double h) {
  int n = frot_order(m);
  double *error = row(w, FROT_RADAU_ERROR), *right = x->change;
  const double *slope = row(w, 0);
  for (int k = 0; k < n; k++) {
    double sum = 0;
    for (int i = 0; i < RA_STAGES; i++) sum += ra_e[i] * row(w, FROT_RADAU_MOVED + i)[k];
    right[k] = slope[k] + ra_gamma / h * sum;
  }
  frot_jacobian_solve(m, w, right, error);
  return !(frot_jacobian_error(m, w, ra_gamma / h, right, error) < FROT_GROWN);
}

int frot_radau_stages(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  scratch x = scratch_of(m, w);
  memcpy(w->step.z1, w->step.z0, sizeof(double) * (size_t)w->layout.nx);
  memcpy(w->blocks.y, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
  /* the slope at the end is none yet: error_estimate.h */
  memcpy(row(w, DP_STAGES), row(w, 0), sizeof(double) * (size_t)frot_width(w));
  if (factor(m, w, &x, h)) return FROT_DIVERGE;
  guess(m, s, w, &x, t, h);
  int status = iterate(m, s, w, &x, t, h);
  if (status != FROT_OK) return status;
  double gap = ra_c[RA_STAGES - 1] - ra_c[RA_STAGES - 2];
  status = frot_meets_posture(m, s, w, 1, 1 + RA_STAGES, gap);
  if (status != FROT_OK) return status;
  finish(m, w, &x, h);
  status = frot_slope(m, s, w, t + h, w->step.z1, row(w, DP_STAGES));
  memcpy(w->step.y_end, w->blocks.y, sizeof(double) * (size_t)m->ny);
  if (status == FROT_OK && frot_has_jammed(s, w)) status = FROT_DIVERGE;
  if (status == FROT_OK && estimate(m, w, &x, h)) status = FROT_DIVERGE;
  return status;
}

/* What the polynomial is off at a place between, in w->implicit's scratch: with d what its rate
 * misses there and S = (I - h/ra_gamma J)^-1 it is h/ra_gamma S d + (left - 1/ra_gamma) h S^2 d,
 * which is -J^-1 d of what is stiff, and left h d of what is not. */
static int miss(const frot_model *m, frot_state *s, frot_work *w, double t, double h, int k) {
  int n = frot_order(m), count = n + FROT_QUADRATURES;
  double *off = scratch_of(m, w).change + k * count, *again = scratch_of(m, w).moved;
  double *slope = row(w, DP_STAGES + 1), *rate = row(w, DP_STAGES + 2), *z = w->step.z;
  for (int j = 0; j < count; j++) {
    double value = w->step.z0[j], sum = 0;
    for (int i = 0; i < RA_STAGES; i++) {
      double moved = row(w, FROT_RADAU_MOVED + i)[j];
      value += ra_value[k][i] * moved, sum += ra_rate[k][i] * moved;
    }
    z[j] = value, rate[j] = sum / h;
  }
  for (int j = 0; j < m->ny; j++) {
    double first = s->data[w->layout.y + j];
    w->blocks.y[j] = first + ra_between[k] * (w->step.y_end[j] - first);
  }
  int status = frot_slope(m, s, w, t + ra_between[k] * h, z, slope);
  if (status != FROT_OK) return status;
  for (int j = 0; j < count; j++) off[j] = slope[j] - rate[j];
  for (int j = n; j < count; j++) off[j] *= ra_left[k] * h;
  frot_jacobian_solve(m, w, off, off);
  for (int j = 0; j < n; j++) again[j] = ra_gamma / h * off[j];
  frot_jacobian_solve(m, w, again, again);
  for (int j = 0; j < n; j++) off[j] += (ra_left[k] * ra_gamma - 1) * again[j];
  return FROT_OK;
}

int frot_radau_dense(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  int count = frot_order(m) + FROT_QUADRATURES, nz = w->layout.nz;
  double *last = row(w, FROT_RADAU_MOVED + RA_STAGES - 1), *off = scratch_of(m, w).change;
  for (int k = 0; k < count; k++) /* the end may have been put onto the relations */
    last[k] = w->step.z1[k] - w->step.z0[k];
  for (int k = 0; k < RA_BETWEEN; k++) {
    int status = miss(m, s, w, t, h, k);
    if (status != FROT_OK) return status;
  }
  for (int k = 0; k < count; k++)
    for (int i = 0; i < RA_VECTORS; i++) {
      double sum = ra_bubble[i][0] * off[k] + ra_bubble[i][1] * off[count + k];
      for (int r = 0; i < RA_STAGES && r < RA_STAGES; r++)
        sum += ra_dense[i][r] * row(w, FROT_RADAU_MOVED + r)[k];
      w->step.f[i * nz + k] = sum;
    }
  return FROT_OK;
}
