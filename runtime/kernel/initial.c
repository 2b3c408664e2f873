#include "initial.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "blocks.h"
#include "core.h"
#include "linear.h"
#include "tolerances.h"

#define PASSES 60
#define LEAST_DAMPING 1e-9
#define ROUNDS 10 /* of conditions that depend on values that depend on conditions */
/* Change, in sizes of the scene, that no statement asks for: what an equation does not depend on
 * but for rounding would be moved so far that the rounding there fits. */
#define FAR 1e10
#define ROUNDING 1e-14
#define KEEPS 1e-12 /* slopes of a gap, relative to its lengths, below which they are rounding */
#define TRIES 8     /* beginnings of the search beside the given one, each to both hands */
#define NEARER 1e-6 /* part by which a place must be nearer to be taken instead */
#define PULLS 10    /* towards the beginning */
#define WHOLE_TURN 6.3

/* One system to solve: statements, then contact rows. */
typedef struct {
  const frot_model *m;
  frot_state *s;
  frot_work *w;
  double t, *q, *v;
  const double *d;
  unsigned char *use; /* per contact: its gap or its normal speed is to be zero */
  int velocity, n;
  const double *factor; /* of the metric of the unknowns that have a speed, of the given order */
  int order, attached;
  double scene; /* largest value, term and residual where the search begins */
  int wide;     /* the search may begin elsewhere too */
} problem;

static double *unknown(const problem *p) { return p->velocity ? p->v : p->q; }

static int unknown_count(const problem *p) { return p->velocity ? p->m->nv : p->m->nq; }

/* The statements depend on the unknowns of the blocks too, and these on the states:
 * J <- J - J_y (dr/dy)^-1 dr/dx. */
static int through_blocks(const problem *p, int n) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int early = frot_layout_of(m).early, nx = unknown_count(p);
  if (early == 0 || n == 0 || !m->block_slopes.call) return FROT_OK;
  double *slopes_q = w->slopes, *slopes_v = slopes_q + m->nq * early;
  double *lu = w->slopes_y, *scale = lu + early * early, *part = scale + 2 * early;
  frot_inputs(m, p->s, w, &p->t, p->q, p->v, p->d);
  w->res[0] = part, w->res[1] = slopes_q, w->res[2] = slopes_v, w->res[3] = lu;
  m->block_slopes.call(w->arg, w->res, w->iw, w->w, 0);
  if (!frot_all_finite(lu, early * early) || !frot_all_finite(w->slopes, (m->nq + m->nv) * early))
    return FROT_NAN;
  if (frot_lu(lu, early, w->slopes_pivot, scale)) return FROT_NAN;
  const double *slopes = p->velocity ? slopes_v : slopes_q;
  for (int i = 0; i < n; i++) {
    memcpy(part, w->residual_y + m->ny * i, sizeof(double) * (size_t)early);
    frot_lu_apply(lu, early, w->slopes_pivot, scale, part);
    for (int j = 0; j < early; j++)
      for (int k = 0; part[j] != 0 && k < nx; k++)
        w->jacobian[nx * i + k] -= slopes[nx * j + k] * part[j];
  }
  return FROT_OK;
}

/* Size of the terms of a contact's gap, of those too that cancel out. */
static double length_size(const frot_model *m, const frot_work *w, int contact, const double *q) {
  return fabs(w->gap[contact]) + w->reach[contact] +
         frot_gap_size(m, w, m->contacts[contact].row_n, q);
}

/* What unknowns of their usual sizes, at least 1 in SI, change in equation i. An angle that is zero
 * but for rounding leaves that much of it. */
static double reach_of(const problem *p, int i) {
  int nx = unknown_count(p);
  double sum = 0;
  for (int k = 0; k < nx; k++)
    sum += fabs(p->w->jacobian[nx * i + k]) * fmax(fabs(unknown(p)[k]), 1);
  return sum;
}

/* Residuals (w->residual) and the rows of the Jacobian (w->jacobian); sets p->n. */
static int evaluate(problem *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int nx = unknown_count(p);
  int n = p->velocity ? m->n_velocity : m->n_position;
  const frot_callable *call = p->velocity ? &m->initial_velocity : &m->initial_position;
  p->n = 0;
  int status = frot_kinematics(m, p->s, w, p->t, p->q, p->v, p->d);
  if (status != FROT_OK) return status;
  if (n > 0) {
    frot_inputs(m, p->s, w, &p->t, p->q, p->v, p->d);
    w->res[0] = w->residual, w->res[1] = w->jacobian, w->res[2] = w->size;
    w->res[3] = w->residual_y;
    call->call(w->arg, w->res, w->iw, w->w, 0);
    status = through_blocks(p, n);
    if (status != FROT_OK) return status;
    /* slopes that are rounding of what cancels out tell no way */
    for (int i = 0; i < n; i++)
      if (reach_of(p, i) <= KEEPS * w->size[i])
        memset(w->jacobian + nx * i, 0, sizeof(double) * (size_t)nx);
  }
  for (int i = 0; i < m->n_contacts; i++) {
    if (!p->use[i]) continue;
    int row = m->contacts[i].row_n;
    const frot_group *group = frot_group_of(m, row);
    const double *entries = frot_entries(m, w->rows, row);
    double *equation = w->jacobian + nx * n;
    w->residual[n] = p->velocity ? w->rate[row] : w->gap[i];
    memset(equation, 0, sizeof(double) * (size_t)nx);
    for (int k = 0; k < group->n_speeds; k++) {
      int speed = group->unknowns[k], at = p->velocity ? speed : m->speed_coordinate[speed];
      if (at >= 0) equation[at] = entries[k];
    }
    w->size[n] = p->velocity ? fabs(w->residual[n]) : length_size(m, w, i, p->q);
    double steepest = 0;
    for (int k = 0; k < nx; k++) steepest = fmax(steepest, fabs(equation[k]));
    if (steepest <= KEEPS * w->reach[i]) {
      /* the lengths cancel out: no unknown moves this gap, and none is moved for it */
      memset(equation, 0, sizeof(double) * (size_t)nx);
      if (p->velocity) w->residual[n] = w->size[n] = 0;
    }
    n++;
  }
  p->n = n;
  int finite = frot_all_finite(w->residual, n) && frot_all_finite(w->jacobian, n * nx);
  return finite ? FROT_OK : FROT_NAN;
}

static int speed_of(const problem *p, int k) { return p->velocity ? k : p->m->q_speed[k]; }

static int is_attached(const problem *p, int k) { return speed_of(p, k) >= 0; }

/* The metric at the present values: that of the speeds for the unknowns that have one (their number
 * in p->attached, its factor in p->factor), for the others the size of their guess. */
static int find_metric(problem *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int count = 0;
  const frot_contact_mode *modes = (const void *)(p->s->data + frot_layout_of(m).modes);
  int status = frot_dynamics(m, p->s, w, p->t, p->q, p->v, p->d, modes, FROT_MOTION);
  if (status == FROT_OK) status = frot_metric(m, w);
  if (status != FROT_OK) return status;
  for (int k = 0; k < unknown_count(p); k++) count += is_attached(p, k);
  for (int a = 0, i = 0; a < unknown_count(p); a++) {
    if (!is_attached(p, a)) continue;
    for (int b = 0, j = 0; b < unknown_count(p); b++)
      if (is_attached(p, b))
        w->position_factor[count * j++ + i] =
            frot_metric_entry(m, w, speed_of(p, a), speed_of(p, b));
    i++;
  }
  p->factor = w->position_factor, p->order = p->attached = count;
  return frot_cholesky(w->position_factor, count) ? FROT_SINGULAR : FROT_OK;
}

/* y <- L^-1 x: a row in the units of the metric; the attached unknowns come first. */
static void into_metric(const problem *p, const double *x, double *y) {
  int first = 0, other = p->attached;
  for (int k = 0; k < unknown_count(p); k++) {
    if (is_attached(p, k))
      y[first++] = x[k];
    else
      y[other++] = x[k] * p->w->unit[k];
  }
  frot_forward(p->factor, p->order, p->attached, y);
}

/* x <- x0 + part * L'^-1 y. Returns the largest change, and in *size the largest value. */
static double move(const problem *p, const double *y, const double *x0, double part, double *x,
                   double *size) {
  int first = 0, other = p->attached;
  double largest = 0;
  *size = 0;
  for (int k = 0; k < unknown_count(p); k++) {
    double change = part * (is_attached(p, k) ? y[first++] : y[other++] * p->w->unit[k]);
    x[k] = x0[k] + change;
    largest = fmax(largest, fabs(change)), *size = fmax(*size, fabs(x[k]));
  }
  return largest;
}

/* Size of the terms of equation i at the present values. */
static double size_of(const problem *p, int i) {
  double sum = p->w->size[i];
  const double *x = unknown(p);
  int nx = unknown_count(p);
  for (int k = 0; k < nx; k++) sum += fabs(p->w->jacobian[nx * i + k] * x[k]);
  return sum;
}

static int agrees(const problem *p, int i, double before) {
  double off = fabs(p->w->residual[i]);
  return off <= FROT_AGREES * fmax(size_of(p, i), before) || off <= ROUNDING * reach_of(p, i);
}

/* The contradiction: the statement with the largest residual and the one most at odds with it. */
static int contradiction(const problem *p) {
  const frot_model *m = p->m;
  const int *statement = p->velocity ? m->velocity_statement : m->position_statement;
  int own = p->velocity ? m->n_velocity : m->n_position, worst = 0, other = -1, contact = -1;
  for (int i = 1; i < p->n; i++)
    if (fabs(p->w->residual[i]) > fabs(p->w->residual[worst])) worst = i;
  for (int i = 0; i < p->n; i++) {
    if (i == worst || agrees(p, i, 0)) continue;
    if (i < own && worst < own && statement[i] == statement[worst]) continue;
    if (other < 0 || fabs(p->w->residual[i]) > fabs(p->w->residual[other])) other = i;
  }
  int rows[2] = {worst, other}, items[2] = {-1, -1};
  for (int k = 0; k < 2; k++) {
    if (rows[k] < 0) continue;
    if (rows[k] < own) {
      items[k] = statement[rows[k]];
      continue;
    }
    int at = own;
    for (int i = 0; i < m->n_contacts; i++)
      if (p->use[i] && at++ == rows[k]) contact = i;
  }
  if (items[0] < 0) items[0] = items[1], items[1] = -1;
  /* the least-squares solution shares the contradiction out among the equations */
  double apart = fabs(p->w->residual[worst]) + (other < 0 ? 0 : fabs(p->w->residual[other]));
  return frot_fail(p->s, FROT_INITIAL, p->t, contact, items[0], items[1], apart);
}

/* Record that an initial statement, or a load at the start, is no number. */
static int no_number(const problem *p, int status) {
  const frot_model *m = p->m;
  const int *statement = p->velocity ? m->velocity_statement : m->position_statement;
  int own = p->velocity ? m->n_velocity : m->n_position;
  for (int i = 0; i < own && p->n > 0 && status == FROT_NAN; i++)
    if (!isfinite(p->w->residual[i]))
      return frot_fail(p->s, FROT_INITIAL, p->t, -1, statement[i], -1, NAN);
  return frot_fail_evaluation(p->m, p->s, p->w, status, p->t);
}

/* Sum of the squares of the residuals, each as the change that would remove it alone, so that units
 * do not matter, and whether they are all near rounding. */
static double square(const problem *p, int *close) {
  double sum = 0;
  *close = 1;
  for (int i = 0; i < p->n; i++) {
    double change = p->w->residual[i] * p->w->row_weight[i];
    sum += change * change;
    if (!agrees(p, i, 0)) *close = 0;
  }
  return sum;
}

/* Least change of the unknowns that removes the residuals to first order, over L, into w->step.
 * With `from`, the change from there is the least one, that is from the present values what is left
 * of it. Each row is divided by its length in the metric. */
static void least_change(const problem *p, const double *from) {
  frot_work *w = p->w;
  int nx = unknown_count(p);
  double *a = w->active, *b = w->right, *y = w->step;
  for (int i = 0; i < p->n; i++) {
    into_metric(p, w->jacobian + nx * i, y);
    double length = sqrt(frot_dot(y, y, nx)), *weight = w->row_weight + i;
    *weight = length > 0 && isfinite(1 / length) ? 1 / length : 0;
    for (int k = 0; k < nx; k++) a[k * p->n + i] = y[k] * *weight;
    b[i] = -w->residual[i];
    for (int k = 0; from != NULL && k < nx; k++)
      b[i] += w->jacobian[nx * i + k] * (unknown(p)[k] - from[k]);
    b[i] *= *weight;
  }
  frot_least_norm(a, b, p->n, nx, y, w->lstsq, w->pivot);
  frot_backward(p->factor, p->order, p->attached, y);
}

/* Take the change of w->step, or the part of it that improves the residuals. Returns whether the
 * values have come to rest: nothing improves, or nothing moves any more. */
static int take(problem *p) {
  frot_work *w = p->w;
  double *x = unknown(p), *x0 = w->ztry, size, moved;
  int close;
  double before = square(p, &close);
  memcpy(x0, x, sizeof(double) * (size_t)unknown_count(p));
  memcpy(w->y_end, w->y, sizeof(double) * (size_t)p->m->ny);
  for (double part = 1; part > LEAST_DAMPING; part *= 0.5) {
    moved = move(p, w->step, x0, part, x, &size);
    if (part == 1 && moved > FAR * p->scene) break;
    if (moved <= 4 * DBL_EPSILON * size) return 1;
    if (evaluate(p) == FROT_OK && (square(p, &close) <= before || close)) return 0;
    memcpy(w->y, w->y_end, sizeof(double) * (size_t)p->m->ny);
  }
  memcpy(x, x0, sizeof(double) * (size_t)unknown_count(p));
  return 1;
}

/* The size of what is stated and of the values where the search begins. */
static double scene_of(const problem *p) {
  const double *x = unknown(p);
  double scene = 0;
  for (int k = 0; k < unknown_count(p); k++) scene = fmax(scene, fabs(x[k]));
  for (int i = 0; i < p->n; i++) scene = fmax(scene, fmax(fabs(p->w->residual[i]), p->w->size[i]));
  return scene;
}

/* Damped Gauss-Newton to the nearest values in the metric. */
static int solve(problem *p) {
  frot_work *w = p->w;
  double last = INFINITY;
  if (unknown_count(p) == 0) return FROT_OK;
  for (int k = 0; !p->velocity && k < p->m->nq; k++) w->unit[k] = p->q[k] != 0 ? fabs(p->q[k]) : 1;
  for (int pass = 0;; pass++) {
    int status = find_metric(p);
    if (status == FROT_OK) status = evaluate(p);
    if (status != FROT_OK) return no_number(p, status);
    int good = 1;
    double largest = 0; /* relative to the terms */
    for (int i = 0; i < p->n; i++) {
      double off = fabs(w->residual[i]), size = size_of(p, i);
      if (pass == 0) w->off_at_first[i] = off;
      if (off > 2 * DBL_EPSILON * size) good = 0;
      size = fmax(size, w->off_at_first[i]);
      if (off > 0) largest = fmax(largest, off / size);
    }
    if (pass == 0) p->scene = scene_of(p);
    if (good || p->n == 0) return FROT_OK;
    if (pass > 3 && largest >= last && largest <= FROT_AGREES) return FROT_OK;
    last = largest;
    least_change(p, NULL);
    if (!take(p) && pass < PASSES - 1) continue;
    status = evaluate(p);
    if (status != FROT_OK) return no_number(p, status);
    for (int i = 0; i < p->n; i++)
      if (!agrees(p, i, w->off_at_first[i])) return contradiction(p);
    return FROT_OK;
  }
}

/* What a statement says of one unknown alone holds to the last digit: the least change, which moves
 * all of them, leaves it with rounding. */
static int keep_stated(problem *p) {
  double *x = unknown(p);
  int nx = unknown_count(p), moved = 0;
  for (int i = 0; i < p->n; i++) {
    const double *row = p->w->jacobian + nx * i;
    int only = -1, count = 0;
    for (int k = 0; k < nx; k++)
      if (row[k] != 0) only = k, count++;
    if (count != 1 || p->w->residual[i] == 0) continue;
    x[only] -= p->w->residual[i] / row[only], moved = 1;
  }
  if (!moved) return FROT_OK;
  int status = evaluate(p);
  return status == FROT_OK ? FROT_OK : no_number(p, status);
}

static int solve_and_look(problem *p) {
  int status = solve(p);
  if (status == FROT_OK && unknown_count(p) > 0) status = keep_stated(p);
  if (status != FROT_OK) return status;
  status = frot_kinematics(p->m, p->s, p->w, p->t, p->q, p->v, p->d);
  return status == FROT_OK ? FROT_OK : no_number(p, status);
}

static void clear_fault(const problem *p) {
  p->s->fault = (frot_fault){FROT_OK, -1, -1, -1, p->t, 0};
  p->s->phase = FROT_CLEARED;
}

/* Distance of the coordinates from w->begin in the metric. */
static double distance(const problem *p) {
  const double *begin = p->w->begin;
  double sum = 0;
  for (int a = 0; a < p->m->nq; a++) {
    double change = p->q[a] - begin[a];
    if (!is_attached(p, a)) {
      sum += change * change / (p->w->unit[a] * p->w->unit[a]);
      continue;
    }
    for (int b = 0; b < p->m->nq; b++)
      if (is_attached(p, b))
        sum += change * frot_metric_entry(p->m, p->w, speed_of(p, a), speed_of(p, b)) *
               (p->q[b] - begin[b]);
  }
  return sqrt(fmax(sum, 0));
}

/* A beginning of the search away from w->begin, the same in every run: turns of up to half a
 * revolution. `alike`: of lengths that move as much mass, else in SI. */
static void begin_elsewhere(const problem *p, int k, int alike) {
  const frot_model *m = p->m;
  double least = INFINITY;
  for (int i = 0; i < m->nq; i++)
    if (is_attached(p, i))
      least = fmin(least, sqrt(frot_metric_entry(m, p->w, speed_of(p, i), speed_of(p, i))));
  for (int i = 0; i < m->nq; i++) {
    double part = fmod((k / 2 + 1) * (0.3819660112501051 + 0.6180339887498949 * i), 1);
    double unit = p->w->unit[i];
    if (is_attached(p, i)) {
      double own = sqrt(frot_metric_entry(m, p->w, speed_of(p, i), speed_of(p, i)));
      unit = alike ? least / own : 1;
    }
    p->q[i] = p->w->begin[i] + (k % 2 ? -1 : 1) * 3 * (0.1 + 0.9 * part) * unit;
  }
}

/* Go on from a place that is found to the nearest one to w->begin, if that can be found. */
static int pull_back(problem *p) {
  frot_work *w = p->w;
  double *found = w->z1, size;
  size_t bytes = sizeof(double) * (size_t)p->m->nq;
  memcpy(found, p->q, bytes);
  double before = distance(p);
  int status = FROT_OK;
  for (int k = 0; k < PULLS && status == FROT_OK; k++) {
    status = find_metric(p);
    if (status == FROT_OK) status = evaluate(p);
    if (status != FROT_OK) break;
    least_change(p, w->begin);
    move(p, w->step, w->begin, 1, p->q, &size);
  }
  if (status == FROT_OK && solve_and_look(p) == FROT_OK && distance(p) <= before) return FROT_OK;
  memcpy(p->q, found, bytes);
  clear_fault(p);
  return solve_and_look(p);
}

/* Whether a coordinate came so far from w->begin that, if it is an angle, it went round. */
static int went_far(const problem *p) {
  for (int k = 0; k < p->m->nq; k++)
    if (fabs(p->q[k] - p->w->begin[k]) > WHOLE_TURN) return 1;
  return 0;
}

/* As solve_and_look. A posture in which nothing moves a gap, such as a dead centre, tells no way to
 * close it, and one beside it a way too far: then other beginnings are tried, and the nearest place
 * taken that is found. */
static int solve_nearest(problem *p) {
  frot_work *w = p->w;
  size_t bytes = sizeof(double) * (size_t)p->m->nq;
  double best = INFINITY;
  memcpy(w->begin, p->q, bytes);
  int status = solve_and_look(p);
  if (status == FROT_OK) {
    if (!went_far(p)) return status;
    best = 0.5 * distance(p);
    memcpy(w->nearest, p->q, bytes);
  } else if (status != FROT_INITIAL || !p->wide) {
    return status;
  }
  for (int k = 0; k < 4 * TRIES; k++) {
    clear_fault(p);
    begin_elsewhere(p, k % (2 * TRIES), k >= 2 * TRIES);
    if (solve_and_look(p) != FROT_OK || pull_back(p) != FROT_OK) continue;
    double far = distance(p);
    if (far < (1 - NEARER) * best) best = far, memcpy(w->nearest, p->q, bytes);
  }
  clear_fault(p);
  memcpy(p->q, isfinite(best) ? w->nearest : w->begin, bytes);
  return solve_and_look(p);
}

/* Values of `sides` at the coordinates at which kinematics was evaluated last. */
static void look_at_sides(const problem *p) {
  frot_inputs(p->m, p->s, p->w, &p->t, p->q, p->v, p->d);
  p->w->res[0] = p->w->witness, p->w->res[1] = p->w->reach;
  p->m->sides.call(p->w->arg, p->w->res, p->w->iw, p->w->w, 0);
}

static int sign_beyond(double x, double rounding) {
  return x > rounding ? 1 : x < -rounding ? -1 : 0;
}

/* The sides of the contacts: where the point is or, if `natural` or where that is on the line,
 * against gravity, else where the body's G is, else to the left. Returns how many change. */
static int choose_sides(const problem *p, double *side, int natural) {
  const frot_model *m = p->m;
  int changes = 0;
  look_at_sides(p);
  for (int i = 0; i < m->n_contacts; i++) {
    if (!frot_has_normal(&m->contacts[i])) continue;
    const double *witness = p->w->witness + 3 * i;
    double rounding = FROT_TOUCH * length_size(m, p->w, i, p->q);
    int sign = natural ? 0 : sign_beyond(witness[0], rounding);
    if (sign == 0) sign = sign_beyond(witness[1], FROT_TOUCH);
    if (sign == 0) sign = sign_beyond(witness[2], rounding);
    if (sign == 0) sign = 1;
    changes += sign != (int)side[i];
    side[i] = sign;
  }
  return changes;
}

static void set_conditions(const frot_model *m, const frot_work *w, double *d) {
  for (int j = 0; j < m->n_conditions; j++)
    d[j] = m->condition_strict[j] ? w->condition[j] > 0 : w->condition[j] >= 0;
}

/* Where the text says that the search begins. */
static void guess(const problem *p, double *q, double *v) {
  const frot_model *m = p->m;
  frot_layout l = frot_layout_of(m);
  frot_work *w = p->w;
  double *discrete = p->s->data + l.d + m->n_conditions + m->n_contacts;
  w->arg[0] = &p->t, w->arg[1] = p->s->data + l.u, w->arg[2] = p->s->data + l.p;
  w->res[0] = q, w->res[1] = v, w->res[2] = w->y, w->res[3] = discrete;
  m->start.call(w->arg, w->res, w->iw, w->w, 0);
}

/* The statements alone show on which side of its line each point is meant to be. A stated gap needs
 * a side before: the natural one or, if the statements contradict that, the one of the guess. */
static int solve_statements(problem *p, double *side) {
  const frot_model *m = p->m;
  frot_state *s = p->s;
  memset(p->use, 0, (size_t)m->n_contacts);
  int status = frot_kinematics(m, s, p->w, p->t, p->q, p->v, p->d);
  if (status != FROT_OK) return no_number(p, status);
  choose_sides(p, side, 1);
  status = solve_nearest(p);
  if (status != FROT_INITIAL) return status;
  frot_fault first = s->fault;
  guess(p, p->q, p->v);
  int again = frot_kinematics(m, s, p->w, p->t, p->q, p->v, p->d) == FROT_OK &&
              choose_sides(p, side, 0) > 0 && solve_nearest(p) == FROT_OK;
  s->fault = again ? (frot_fault){FROT_OK, -1, -1, -1, p->t, 0} : first;
  s->phase = again ? FROT_CLEARED : FROT_FAULTED;
  return again ? FROT_OK : status;
}

/* Coordinates; chooses the sides of the contacts. Leaves w->gap there. */
static int solve_positions(problem *p, double *side) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int nc = m->n_contacts;
  const double *unilateral = p->s->data + frot_layout_of(m).unilateral;
  p->velocity = 0;
  int status = solve_statements(p, side);
  if (status != FROT_OK) return status;
  choose_sides(p, side, 0);
  for (int i = 0; i < nc; i++) {
    const frot_contact *contact = &m->contacts[i];
    p->use[i] = frot_has_normal(contact) && !contact->reduced && unilateral[i] == 0;
  }
  /* what cannot part may move a point over a line: its side is the one where it comes to be */
  status = solve_nearest(p);
  if (status != FROT_OK) return status;
  choose_sides(p, side, 0);
  for (;;) {
    status = solve_nearest(p);
    if (status != FROT_OK) return status;
    look_at_sides(p);
    int added = 0;
    for (int i = 0; i < nc; i++) {
      if (p->use[i] || m->contacts[i].reduced || !frot_has_normal(&m->contacts[i])) continue;
      if (w->gap[i] < -FROT_TOUCH * length_size(m, w, i, p->q)) p->use[i] = 1, added = 1;
    }
    if (!added) return FROT_OK;
  }
}

/* Speeds; opens contacts that separate. */
static int solve_speeds(problem *p, frot_contact_mode *modes) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  p->velocity = 1;
  for (;;) {
    int status = solve_and_look(p);
    if (status != FROT_OK) return status;
    int added = 0;
    for (int i = 0; i < m->n_contacts; i++) {
      const frot_contact *contact = &m->contacts[i];
      int row = contact->row_n;
      if (p->use[i] || contact->reduced || !frot_has_normal(contact) || !modes[i].closed) continue;
      double size =
          DBL_EPSILON * frot_row_size(m, w, row, p->v) + ROUNDING * frot_row_speed(m, w, row, p->v);
      if (w->rate[row] > size)
        modes[i].closed = 0; /* it leaves */
      else if (w->rate[row] < -size)
        p->use[i] = 1, added = 1;
    }
    if (!added) return FROT_OK;
  }
}

static void look_at_conditions(const problem *p) {
  frot_kinematics(p->m, p->s, p->w, p->t, p->q, p->v, p->d);
  set_conditions(p->m, p->w, p->s->data + frot_layout_of(p->m).d);
}

/* All values from the guesses, with the conditions as they are; then sets these. */
static int solve_once(problem *p, double *q, double *v) {
  const frot_model *m = p->m;
  frot_state *s = p->s;
  frot_work *w = p->w;
  frot_layout l = frot_layout_of(m);
  int nc = m->n_contacts;
  double *d = s->data + l.d, *side = d + m->n_conditions;
  const double *unilateral = s->data + l.unilateral;
  frot_contact_mode *modes = (void *)(s->data + l.modes);
  memset(modes, 0, sizeof *modes * (size_t)nc);
  for (int i = 0; i < nc; i++) {
    side[i] = modes[i].side = 1;
    modes[i].closed = (signed char)!frot_has_normal(&m->contacts[i]);
  }
  guess(p, q, v);
  int status = solve_positions(p, side);
  if (status == FROT_INITIAL) {
    clear_fault(p);
    guess(p, q, v);
    p->wide = 1;
    status = solve_positions(p, side);
    p->wide = 0;
  }
  if (status != FROT_OK) return status;
  set_conditions(m, w, d);
  for (int i = 0; i < nc; i++) {
    const frot_contact *contact = &m->contacts[i];
    if (!frot_has_normal(contact)) continue;
    int touches =
        unilateral[i] == 0 || p->use[i] || fabs(w->gap[i]) <= FROT_TOUCH * length_size(m, w, i, q);
    modes[i].closed = (signed char)touches;
    p->use[i] = touches && unilateral[i] == 0 && !contact->reduced;
  }
  status = solve_speeds(p, modes);
  if (status != FROT_OK) return status;
  set_conditions(m, w, d);
  return FROT_OK;
}

int frot_initial_values(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                        double *v) {
  frot_layout l = frot_layout_of(m);
  problem p = {m, s, w, t, q, v, s->data + l.d, (unsigned char *)w->choice, 0, 0, NULL, 0, 0, 0, 0};
  memset(s->data + l.d, 0, sizeof(double) * (size_t)l.nd);
  size_t size = sizeof(double) * (size_t)m->n_conditions;
  guess(&p, q, v);
  look_at_conditions(&p);
  for (int round = 0; round < ROUNDS; round++) {
    memcpy(w->condition_before, p.d, size);
    int status = solve_once(&p, q, v);
    /* what has no solution under these conditions may have one under those found there */
    if (status != FROT_OK) look_at_conditions(&p);
    if (memcmp(w->condition_before, p.d, size) == 0) return status;
    clear_fault(&p);
  }
  return frot_fail(s, FROT_CHATTER, t, -1, -1, -1, ROUNDS);
}
