#include "assembly/gauss_newton.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "assembly/unknowns.h"
#include "evaluation/evaluate.h"
#include "inertia/mass_matrix.h"
#include "numerics/dense.h"
#include "numerics/basis.h"
#include "assembly/start_parts.h"
#include "numerics/tolerances.h"
#include "evaluation/quaternions.h"

#define PASSES 100
/* By how much a pass may change an angle: what it is taken for straight bends in such an arc. */
#define MOST_TURN 0.5
#define HALF_TURN 3.141592653589793

static const double ASIDE[4] = {0.8, 0.36, 0.288, 0.384}; /* about no axis of a figure */

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

/* The entries of the metric for the unknowns of the part that have a speed. */
static void copy_metric(const frot_opening *p) {
  const frot_model *m = p->m;
  const int *own = p->w->opening.own;
  int count = p->attached;
  for (int b = 0; b < count; b++) {
    int speed = frot_speed_behind(p, own[b]), group = m->speed_group[speed];
    const double *column = frot_metric_column(p->w, &m->groups[group], m->speed_local[speed]);
    for (int a = 0; a < count; a++) {
      int other = frot_speed_behind(p, own[a]);
      p->w->opening.factor[count * b + a] =
          m->speed_group[other] == group ? column[m->speed_local[other]] : 0;
    }
  }
}

/* Turn what turns of the part, the same in every run. */
static void turn_aside(const frot_opening *p) {
  for (int i = 0; i < p->part->n_turns; i++) {
    const frot_turn *turn = &p->w->opening.turns[i];
    double turned[4];
    frot_turned(turn, ASIDE, p->x + turn->at, turned);
    memcpy(p->x + turn->at, turned, sizeof turned);
  }
  for (int k = 0; k < p->n_own; k++)
    if (frot_is_angle(p, k)) p->x[k] += 1;
}

static int find_metric(frot_opening *p) {
  frot_work *w = p->w;
  int count = p->attached;
  frot_put(p);
  int status = frot_inertia(p->m, p->s, w, p->t, p->q, p->v, p->d);
  if (status != FROT_OK) return status;
  copy_metric(p);
  if (!frot_all_finite(w->opening.factor, count * count)) return FROT_NAN;
  for (int i = 0; i < p->part->n_turns && !p->velocity; i++)
    w->relations.unit[w->opening.turns[i].at] = unit_of_length(p, &w->opening.turns[i]);
  return frot_cholesky(w->opening.factor, count) ? FROT_SINGULAR : FROT_OK;
}

int frot_opening_metric(frot_opening *p) {
  size_t bytes = sizeof(double) * (size_t)p->n_own;
  memcpy(p->w->opening.here, p->x, bytes);
  p->factor = p->w->opening.factor, p->order = p->attached, p->basis = p->w->opening.here;
  int status = find_metric(p);
  if (status != FROT_NAN || !p->direct) return status;
  turn_aside(p);
  status = find_metric(p);
  memcpy(p->x, p->w->opening.here, bytes);
  return status;
}

void frot_row_in_metric(const frot_opening *p, const double *x, double *y) {
  double *over = p->w->opening.scratch + 2 * p->n_own;
  const int *own = p->w->opening.own;
  frot_over_changes(p, x, over);
  for (int a = 0; a < p->n_own; a++)
    y[a] = a < p->attached ? over[own[a]] : over[own[a]] * p->w->relations.unit[own[a]];
  frot_forward(p->factor, p->order, p->attached, y);
}

double frot_row_length(const frot_opening *p, int i) {
  double *y = p->w->relations.step;
  frot_row_in_metric(p, p->w->relations.jacobian + p->n_own * i, y);
  return sqrt(frot_dot(y, y, p->n_own));
}

void frot_measure_change(const frot_opening *p, const double *apart, double *y) {
  double *over = p->w->opening.scratch + 2 * p->n_own;
  const int *own = p->w->opening.own;
  int n = p->attached;
  frot_into_changes(p, apart, over);
  for (int a = 0; a < p->n_own; a++)
    y[a] = a < n ? over[own[a]] : over[own[a]] / p->w->relations.unit[own[a]];
  for (int i = 0; i < n; i++) { /* L' x, in place from above */
    double sum = 0;
    for (int k = i; k < n; k++) sum += p->factor[n * i + k] * y[k];
    y[i] = sum;
  }
}

double frot_move_opening(const frot_opening *p, const double *y, const double *x0, double part,
                         double *x, double *size) {
  double *changes = p->w->opening.scratch, *moved = changes + p->n_own;
  const int *own = p->w->opening.own;
  double largest = 0;
  *size = 0;
  memset(changes, 0, sizeof(double) * (size_t)p->n_own);
  for (int a = 0; a < p->n_own; a++)
    changes[own[a]] = part * (a < p->attached ? y[a] : y[a] * p->w->relations.unit[own[a]]);
  frot_from_changes(p, changes, moved);
  for (int k = 0; k < p->n_own; k++) {
    x[k] = x0[k] + moved[k];
    largest = fmax(largest, fabs(moved[k])), *size = fmax(*size, fabs(x[k]));
  }
  return largest;
}

void frot_begin_units(const frot_opening *p) {
  double *unit = p->w->relations.unit, largest = 0;
  for (int k = 0; k < p->n_own; k++) largest = fmax(largest, fabs(p->x[k]));
  for (int k = 0; k < p->n_own; k++)
    unit[k] = fabs(p->x[k]) > DBL_EPSILON * largest ? fabs(p->x[k]) : 1;
  for (int i = 0; i < p->part->n_turns; i++)
    for (int k = 0; k < 4; k++) unit[p->w->opening.turns[i].at + k] = 1;
}

/* Sum of the squares of the residuals, each as the change that would remove it alone, so that units
 * do not matter, without counters that follow, and whether they are all near rounding. */
static double square(const frot_opening *p, int *close) {
  double sum = 0;
  *close = 1;
  for (int j = 0; j < p->n_rows; j++) {
    int i = p->w->opening.rows[j];
    double change = p->w->relations.residual[i] * p->w->opening.row_weight[i];
    sum += change * change;
    if (!frot_statement_agrees(p, i, 0)) *close = 0;
  }
  return sum;
}

void frot_weigh_rows(const frot_opening *p) {
  double *weight = p->w->opening.row_weight;
  const int *rows = p->w->opening.rows;
  for (int j = 0; j < p->n_rows; j++) weight[rows[j]] = frot_row_length(p, rows[j]);
  for (int j = 0, end; j < p->n_rows; j = end) {
    double longest = 0;
    for (end = j; end < p->n_rows && frot_are_items(p, rows[j], rows[end]); end++)
      longest = fmax(longest, weight[rows[end]]);
    for (int i = j; i < end; i++) {
      double *own = weight + rows[i];
      *own = *own > 0 && isfinite(1 / longest) ? 1 / longest : 0;
    }
  }
}

/* Least change of the unknowns that removes the residuals to first order, over L, into w->step. */
static void least_change(const frot_opening *p) {
  frot_work *w = p->w;
  int nx = p->n_own, own = p->n_own, n = p->n_rows;
  double *a = w->linear.matrix, *b = w->linear.right, *y = w->relations.step;
  frot_weigh_rows(p);
  for (int j = 0; j < n; j++) {
    int i = w->opening.rows[j];
    double weight = w->opening.row_weight[i];
    frot_row_in_metric(p, w->relations.jacobian + nx * i, y);
    for (int k = 0; k < own; k++) a[k * n + j] = y[k] * weight;
    b[j] = -w->relations.residual[i] * weight;
    if (frot_is_follower(p, i)) w->opening.row_weight[i] = 0;
  }
  frot_least_norm(a, b, n, own, FROT_RANK, y, w->linear.scratch, w->linear.pivot);
  frot_backward(p->factor, p->order, p->attached, y);
}

/* Limit a change of places from x0 to x, for no angle may change by more than MOST_TURN. It is
 * taken in part, such that all equations are followed alike; angles that would change by more than
 * half a turn, of which a linear equation knows nothing, are limited alone. */
static void limit_turns(const frot_opening *p, const double *x0, double *x) {
  double largest = 0;
  for (int k = 0; k < p->n_own; k++) {
    if (!frot_is_angle(p, k)) continue;
    double turned = x[k] - x0[k];
    if (fabs(turned) > HALF_TURN) turned = copysign(MOST_TURN, turned);
    x[k] = x0[k] + turned, largest = fmax(largest, fabs(turned));
  }
  if (largest <= MOST_TURN) return;
  for (int k = 0; k < p->n_own; k++) x[k] = x0[k] + MOST_TURN / largest * (x[k] - x0[k]);
}

/* Take the change of w->relations.step, or the part of it that improves the residuals. Returns
 * whether the values have come to rest: nothing improves, or nothing moves any more. */
static int take(frot_opening *p) {
  frot_work *w = p->w;
  double *x = p->x, *x0 = w->step.z, size, moved;
  int close;
  double before = square(p, &close);
  size_t bytes = sizeof(double) * (size_t)p->n_own;
  memcpy(x0, x, bytes);
  frot_keep_blocks(p, w->step.y_end);
  for (double part = 1; part > FROT_LEAST_DAMPING_AT_START; part *= 0.5) {
    moved = frot_move_opening(p, w->relations.step, x0, part, x, &size);
    if (part == 1 && moved > FROT_FAR * p->scene) break;
    limit_turns(p, x0, x);
    if (moved <= 4 * DBL_EPSILON * size) return 1;
    if (frot_evaluate_statements(p) == FROT_OK && (square(p, &close) <= before || close)) return 0;
    frot_return_blocks(p, w->step.y_end);
  }
  memcpy(x, x0, bytes);
  return 1;
}

/* The size of what is stated and of the values where the search begins. */
static double scene_of(const frot_opening *p) {
  double scene = 0;
  for (int k = 0; k < p->n_own; k++) scene = fmax(scene, fabs(p->x[k]));
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

enum { KEPT = 1, NOW = 2 };

/* The unknown that equation i alone speaks of beside those that are kept, -1 if there are several
 * or none. */
static int only_left(const frot_opening *p, int i) {
  const int *bounds = p->w->relations.bounds + 2 * i;
  const double *row = p->w->relations.jacobian + p->n_own * i;
  int only = -1;
  for (int k = bounds[0]; k < bounds[1]; k++) {
    if (row[k] == 0 || p->w->opening.kept[k] == KEPT) continue;
    if (only >= 0) return -1;
    only = k;
  }
  return only;
}

/* An angle that an equation alone gives, or that follows from others so given, is many turns away
 * at once: the way there says nothing. Leaves the equations evaluated. */
static int turn_far(frot_opening *p) {
  unsigned char *kept = p->w->opening.kept;
  int status = FROT_OK;
  memset(kept, 0, (size_t)p->n_own);
  for (int found = 1; found && status == FROT_OK;) {
    found = 0;
    for (int i = 0; i < p->n && status == FROT_OK; i++) {
      int only = only_left(p, i);
      if (only < 0) continue;
      double before = p->x[only];
      double by = -p->w->relations.residual[i] / p->w->relations.jacobian[p->n_own * i + only];
      kept[only] = KEPT, found = 1;
      if (!frot_is_angle(p, only) || !(fabs(by) > HALF_TURN)) continue;
      p->x[only] += by;
      status = frot_evaluate_statements(p);
      if (status == FROT_OK && frot_statement_agrees(p, i, 0)) continue;
      p->x[only] = before;
      status = frot_evaluate_statements(p);
    }
  }
  return status;
}

/* Damped Gauss-Newton to the nearest values in the metric. */
static int solve(frot_opening *p) {
  frot_work *w = p->w;
  double last = INFINITY;
  if (p->n_own == 0) return look_at_statements(p);
  if (!p->velocity) frot_begin_units(p);
  p->n = 0;
  for (int pass = 0;; pass++) {
    int status = frot_evaluate_statements(p);
    if (status == FROT_OK && pass == 0 && !p->velocity) status = turn_far(p);
    /* where the inertia is no number either, no statement is to blame */
    if (status != FROT_OK && p->velocity && frot_opening_metric(p) != FROT_OK) p->n = 0;
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
    if (good || p->n_rows == 0) return FROT_OK;
    if (pass > 3 && largest >= last && largest <= FROT_AGREES) return FROT_OK;
    last = largest;
    if (pass == 0 || !p->velocity) status = frot_opening_metric(p); /* speeds do not change it */
    if (status != FROT_OK) return frot_no_number(p, status);
    least_change(p);
    if (!take(p) && pass < PASSES - 1) continue;
    status = frot_evaluate_statements(p);
    if (status != FROT_OK) return frot_no_number(p, status);
    for (int i = 0; i < p->n; i++)
      if (!frot_statement_agrees(p, i, w->opening.off_at_first[i])) return frot_contradiction(p);
    return FROT_OK;
  }
}

/* What is stated or guessed of one unknown alone holds to the last digit, and then what is of one
 * more: the least change, which moves all of them, leaves it with rounding. */
static int keep_stated(frot_opening *p) {
  double *x = p->x;
  unsigned char *kept = p->w->opening.kept;
  int nx = p->n_own, own = p->part->n_stated;
  int guesses = p->guessed ? p->n - p->part->n_guessed : p->n;
  memset(kept, 0, (size_t)nx);
  for (int found = 1; found;) {
    double *by = p->w->step.z;
    int moved = found = 0;
    for (int i = 0; i < p->n; i++) {
      int only = i < own || i >= guesses ? only_left(p, i) : -1;
      if (only < 0) continue;
      double change = -p->w->relations.residual[i] / p->w->relations.jacobian[nx * i + only];
      /* of several the one that is off by least: the others follow from more */
      if (kept[only] != NOW || fabs(change) < fabs(by[only])) by[only] = change;
      found = 1, kept[only] = NOW;
    }
    for (int k = 0; k < nx; k++) {
      if (kept[k] == NOW && by[k] != 0) x[k] += by[k], moved = 1;
      kept[k] = kept[k] != 0; /* KEPT */
    }
    int status = moved ? frot_evaluate_statements(p) : FROT_OK;
    if (status != FROT_OK) return frot_no_number(p, status);
  }
  return FROT_OK;
}

int frot_solve_nearest(frot_opening *p) {
  int status = solve(p);
  return status == FROT_OK ? keep_stated(p) : status;
}
