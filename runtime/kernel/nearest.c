#include "nearest.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "changes.h"
#include "core.h"
#include "linear.h"
#include "tolerances.h"

#define PASSES 100
/* By how much a pass may change an angle: what it is taken for straight bends in such an arc. */
#define MOST_TURN 0.5
#define HALF_TURN 3.141592653589793

/* The inertia of the groups at the values as they are. */
static int find_inertia(const frot_opening *p) {
  const frot_contact_mode *modes = (const void *)(p->s->data + p->w->layout.modes);
  int status = frot_dynamics(p->m, p->s, p->w, p->t, p->q, p->v, p->d, modes, FROT_INERTIA);
  return status == FROT_OK ? frot_metric(p->m, p->w) : status;
}

/* Of the length of a quaternion, such that the whole change of it is measured by the body's
 * inertia.
 */
static double unit_of_length(const frot_opening *p, const frot_turn *turn) {
  double inertia = 0, count = 0;
  for (int k = 0; k < 3; k++)
    if (turn->speed[k] >= 0)
      inertia += frot_metric_entry(p->m, p->w, turn->speed[k], turn->speed[k]), count++;
  return 0.5 / sqrt(inertia / count);
}

/* The factor of the metric of all unknowns, after find_inertia. */
static int factor_metric(frot_opening *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int count = 0;
  for (int k = 0; k < frot_opening_count(p); k++) count += frot_is_attached(p, k);
  for (int a = 0, i = 0; a < frot_opening_count(p); a++) {
    if (!frot_is_attached(p, a)) continue;
    for (int b = 0, j = 0; b < frot_opening_count(p); b++)
      if (frot_is_attached(p, b))
        w->opening.factor[count * j++ + i] =
            frot_metric_entry(m, w, frot_speed_behind(p, a), frot_speed_behind(p, b));
    i++;
  }
  for (int i = 0; i < m->n_turns && !p->velocity; i++)
    w->relations.unit[m->turns[i].at] = unit_of_length(p, &m->turns[i]);
  p->factor = w->opening.factor, p->order = p->attached = count;
  memcpy(w->opening.here, p->q, sizeof(double) * (size_t)m->nq);
  p->basis = w->opening.here;
  return frot_cholesky(w->opening.factor, count) ? FROT_SINGULAR : FROT_OK;
}

int frot_opening_metric(frot_opening *p) {
  int status = find_inertia(p);
  return status == FROT_OK ? factor_metric(p) : status;
}

/* y <- L^-1 x: a row in the units of the metric; the attached changes come first. */
static void into_metric(const frot_opening *p, const double *x, double *y) {
  double *over = p->w->opening.scratch + 2 * frot_opening_count(p);
  int first = 0, other = p->attached;
  frot_over_changes(p, x, over);
  for (int k = 0; k < frot_opening_count(p); k++) {
    if (frot_is_attached(p, k))
      y[first++] = over[k];
    else
      y[other++] = over[k] * p->w->relations.unit[k];
  }
  frot_forward(p->factor, p->order, p->attached, y);
}

void frot_measure_change(const frot_opening *p, const double *apart, double *y) {
  double *over = p->w->opening.scratch + 2 * frot_opening_count(p);
  int n = p->attached, first = 0, other = n;
  frot_into_changes(p, apart, over);
  for (int k = 0; k < frot_opening_count(p); k++) {
    if (frot_is_attached(p, k))
      y[first++] = over[k];
    else
      y[other++] = over[k] / p->w->relations.unit[k];
  }
  for (int i = 0; i < n; i++) { /* L' x, in place from above */
    double sum = 0;
    for (int k = i; k < n; k++) sum += p->factor[n * i + k] * y[k];
    y[i] = sum;
  }
}

double frot_move_opening(const frot_opening *p, const double *y, const double *x0, double part,
                         double *x, double *size) {
  double *changes = p->w->opening.scratch, *moved = changes + frot_opening_count(p);
  int first = 0, other = p->attached;
  double largest = 0;
  *size = 0;
  for (int k = 0; k < frot_opening_count(p); k++)
    changes[k] =
        part * (frot_is_attached(p, k) ? y[first++] : y[other++] * p->w->relations.unit[k]);
  frot_from_changes(p, changes, moved);
  for (int k = 0; k < frot_opening_count(p); k++) {
    x[k] = x0[k] + moved[k];
    largest = fmax(largest, fabs(moved[k])), *size = fmax(*size, fabs(x[k]));
  }
  return largest;
}

void frot_begin_units(const frot_opening *p) {
  double *unit = p->w->relations.unit;
  for (int k = 0; k < p->m->nq; k++) unit[k] = p->q[k] != 0 ? fabs(p->q[k]) : 1;
  for (int i = 0; i < p->m->n_turns; i++)
    for (int k = 0; k < 4; k++) unit[p->m->turns[i].at + k] = 1;
}

/* Sum of the squares of the residuals, each as the change that would remove it alone, so that units
 * do not matter, and whether they are all near rounding. */
static double square(const frot_opening *p, int *close) {
  double sum = 0;
  *close = 1;
  for (int i = 0; i < p->n; i++) {
    double change = p->w->relations.residual[i] * p->w->opening.row_weight[i];
    sum += change * change;
    if (!frot_statement_agrees(p, i, 0)) *close = 0;
  }
  return sum;
}

void frot_least_change(const frot_opening *p, const double *from) {
  frot_work *w = p->w;
  int nx = frot_opening_count(p);
  double *a = w->linear.matrix, *b = w->linear.right, *y = w->relations.step;
  for (int i = 0; i < p->n; i++) {
    into_metric(p, w->relations.jacobian + nx * i, y);
    double length = sqrt(frot_dot(y, y, nx)), *weight = w->opening.row_weight + i;
    *weight = length > 0 && isfinite(1 / length) ? 1 / length : 0;
    for (int k = 0; k < nx; k++) a[k * p->n + i] = y[k] * *weight;
    b[i] = -w->relations.residual[i];
    for (int k = 0; from != NULL && k < nx; k++)
      b[i] += w->relations.jacobian[nx * i + k] * (frot_opening_unknown(p)[k] - from[k]);
    b[i] *= *weight;
  }
  frot_least_norm(a, b, p->n, nx, FROT_RANK, y, w->linear.scratch, w->linear.pivot);
  frot_backward(p->factor, p->order, p->attached, y);
}

/* Limit a change of places from x0 to x, for no angle may change by more than MOST_TURN. It is
 * taken in part, such that all equations are followed alike; angles that would change by more than
 * half a turn, of which a linear equation knows nothing, are limited alone. */
static void limit_turns(const frot_opening *p, const double *x0, double *x) {
  double largest = 0;
  for (int j = 0; j < p->m->nv && !p->velocity; j++) {
    int k = frot_angle_of(p->m, j);
    if (k < 0) continue;
    double turned = x[k] - x0[k];
    if (fabs(turned) > HALF_TURN) turned = copysign(MOST_TURN, turned);
    x[k] = x0[k] + turned, largest = fmax(largest, fabs(turned));
  }
  if (largest <= MOST_TURN) return;
  for (int k = 0; k < frot_opening_count(p); k++)
    x[k] = x0[k] + MOST_TURN / largest * (x[k] - x0[k]);
}

/* Take the change of w->relations.step, or the part of it that improves the residuals. Returns
 * whether the values have come to rest: nothing improves, or nothing moves any more. */
static int take(frot_opening *p) {
  frot_work *w = p->w;
  double *x = frot_opening_unknown(p), *x0 = w->step.z, size, moved;
  int close;
  double before = square(p, &close);
  size_t bytes = sizeof(double) * (size_t)frot_opening_count(p);
  memcpy(x0, x, bytes);
  memcpy(w->step.y_end, w->blocks.y, sizeof(double) * (size_t)p->m->ny);
  for (double part = 1; part > FROT_LEAST_DAMPING_AT_START; part *= 0.5) {
    moved = frot_move_opening(p, w->relations.step, x0, part, x, &size);
    if (part == 1 && moved > FROT_FAR * p->scene) break;
    limit_turns(p, x0, x);
    if (moved <= 4 * DBL_EPSILON * size) return 1;
    if (frot_evaluate_statements(p) == FROT_OK && (square(p, &close) <= before || close)) return 0;
    memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)p->m->ny);
  }
  memcpy(x, x0, bytes);
  return 1;
}

/* The size of what is stated and of the values where the search begins. */
static double scene_of(const frot_opening *p) {
  const double *x = frot_opening_unknown(p);
  double scene = 0;
  for (int k = 0; k < frot_opening_count(p); k++) scene = fmax(scene, fabs(x[k]));
  for (int i = 0; i < p->n; i++)
    scene = fmax(scene, fmax(fabs(p->w->relations.residual[i]), p->w->relations.size[i]));
  return scene;
}

/* What no unknown can mend, where there are none: what time prescribes is to agree by itself. */
static int look_at_statements(frot_opening *p) {
  int status = frot_evaluate_statements(p);
  if (status != FROT_OK) return frot_no_number(p, status);
  for (int i = 0; i < p->n; i++)
    if (!frot_is_still(p, i, frot_statement_size(p, i))) return frot_contradiction(p);
  return FROT_OK;
}

/* Damped Gauss-Newton to the nearest values in the metric. */
static int solve(frot_opening *p) {
  frot_work *w = p->w;
  double last = INFINITY;
  if (frot_opening_count(p) == 0) return look_at_statements(p);
  if (!p->velocity) frot_begin_units(p);
  for (int pass = 0;; pass++) {
    int status = find_inertia(p);
    if (status == FROT_OK) status = frot_evaluate_statements(p);
    if (status != FROT_OK) return frot_no_number(p, status);
    int good = 1;
    double largest = 0; /* relative to the terms */
    for (int i = 0; i < p->n; i++) {
      double off = fabs(w->relations.residual[i]), size = frot_statement_size(p, i);
      if (pass == 0) w->opening.off_at_first[i] = off;
      if (off > 2 * DBL_EPSILON * size) good = 0;
      size = fmax(size, w->opening.off_at_first[i]);
      if (off > 0) largest = fmax(largest, off / size);
    }
    if (pass == 0) p->scene = scene_of(p);
    if (good || p->n == 0) return FROT_OK;
    if (pass > 3 && largest >= last && largest <= FROT_AGREES) return FROT_OK;
    last = largest;
    status = factor_metric(p);
    if (status != FROT_OK) return frot_no_number(p, status);
    frot_least_change(p, NULL);
    if (!take(p) && pass < PASSES - 1) continue;
    status = frot_evaluate_statements(p);
    if (status != FROT_OK) return frot_no_number(p, status);
    for (int i = 0; i < p->n; i++)
      if (!frot_statement_agrees(p, i, w->opening.off_at_first[i])) return frot_contradiction(p);
    return FROT_OK;
  }
}

/* What a statement says of one unknown alone holds to the last digit: the least change, which moves
 * all of them, leaves it with rounding. */
static int keep_stated(frot_opening *p) {
  double *x = frot_opening_unknown(p);
  int nx = frot_opening_count(p), moved = 0;
  for (int i = 0; i < p->n; i++) {
    int only = frot_only_unknown(p, i);
    if (only < 0 || p->w->relations.residual[i] == 0) continue;
    x[only] -= p->w->relations.residual[i] / p->w->relations.jacobian[nx * i + only], moved = 1;
  }
  if (!moved) return FROT_OK;
  int status = frot_evaluate_statements(p);
  return status == FROT_OK ? FROT_OK : frot_no_number(p, status);
}

int frot_solve_nearest(frot_opening *p) {
  int status = solve(p);
  if (status == FROT_OK && frot_opening_count(p) > 0) status = keep_stated(p);
  if (status != FROT_OK) return status;
  status = frot_kinematics(p->m, p->s, p->w, p->t, p->q, p->v, p->d);
  return status == FROT_OK ? FROT_OK : frot_no_number(p, status);
}
