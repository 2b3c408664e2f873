#include "contact/cone_point.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "numerics/dense.h"

#define STEPS 200
#define HALVINGS 40
/* Growth of the dual function that a step must show, of what its slope promises. */
#define SUFFICIENT 1e-4
/* Part of the dual function that is its rounding. */
#define ROUNDING (16 * DBL_EPSILON)
/* The diagonal added to the Hessian: this part of its own at least, and no more than MOST of it. */
#define LEAST_DAMPING 1e-14
#define MOST_DAMPING 1e-3
/* Multipliers so many times what the right side asks for belong to no point. */
#define FARTHEST 1e13

int frot_cone_scratch(int n, int rows) { return 3 * n + n * rows + rows * rows + 4 * rows; }

/* The bounding unknown of cone c after projection, from the values `x` before it: the zero of
 * N - x_N - sum of ratio (|f| - ratio N) over the balls with |f| > ratio N, which grows with N. At
 * most zero: the whole block projects to zero. `weight` (may be NULL) <- 1 + sum of ratio^2. */
static double bounding_of(const frot_cone_problem *p, int c, const double *x, double *weight) {
  double value = x[p->cones[c].at], sum = 1;
  for (int pass = 0; pass <= p->n_balls; pass++) {
    double top = x[p->cones[c].at], next;
    sum = 1;
    for (int k = 0; k < p->n_balls; k++) {
      const frot_ball *ball = &p->balls[k];
      double size = ball->bounding == c ? frot_length(x + ball->at, ball->n) : 0;
      if (ball->bounding != c || !(size > ball->ratio * value)) continue;
      top += ball->ratio * size, sum += ball->ratio * ball->ratio;
    }
    next = top / sum;
    if (!(next > value)) break;
    value = next;
  }
  if (weight) *weight = sum;
  return value;
}

void frot_project_cones(const frot_cone_problem *p, double *x) {
  for (int c = 0; c < p->n_cones; c++) {
    double value = bounding_of(p, c, x, NULL);
    for (int k = 0; k < p->n_balls; k++) {
      const frot_ball *ball = &p->balls[k];
      if (ball->bounding != c) continue;
      double size = frot_length(x + ball->at, ball->n), most = ball->ratio * fmax(value, 0);
      for (int i = 0; i < ball->n && size > most; i++) x[ball->at + i] *= most / size;
    }
    x[p->cones[c].at] = fmax(value, 0);
  }
  for (int k = 0; k < p->n_balls; k++) {
    const frot_ball *ball = &p->balls[k];
    double size = ball->bounding < 0 ? frot_length(x + ball->at, ball->n) : 0;
    for (int i = 0; i < ball->n && size > ball->ratio; i++) x[ball->at + i] *= ball->ratio / size;
  }
}

/* Of one ball, the change `dx` of what is projected becomes that of the projection, where the
 * radius is `most` and changes by `dmost`. */
static void turn_ball(const frot_ball *ball, const double *x, double most, double dmost,
                      double *dx) {
  double size = frot_length(x + ball->at, ball->n);
  if (!(size > most)) return;
  double along = frot_dot(x + ball->at, dx + ball->at, ball->n) / size;
  for (int i = 0; i < ball->n; i++) {
    double unit = x[ball->at + i] / size;
    dx[ball->at + i] = dmost * unit + most / size * (dx[ball->at + i] - along * unit);
  }
}

/* dx <- the derivative of the projection at x in the direction dx. */
static void project_change(const frot_cone_problem *p, const double *x, double *dx) {
  for (int c = 0; c < p->n_cones; c++) {
    double weight, value = bounding_of(p, c, x, &weight), change = dx[p->cones[c].at];
    for (int k = 0; k < p->n_balls; k++) {
      const frot_ball *ball = &p->balls[k];
      double size = ball->bounding == c ? frot_length(x + ball->at, ball->n) : 0;
      if (ball->bounding == c && size > ball->ratio * value)
        change += ball->ratio * frot_dot(x + ball->at, dx + ball->at, ball->n) / size;
    }
    change = value > 0 ? change / weight : 0;
    for (int k = 0; k < p->n_balls; k++) {
      const frot_ball *ball = &p->balls[k];
      if (ball->bounding == c)
        turn_ball(ball, x, ball->ratio * fmax(value, 0), ball->ratio * change, dx);
    }
    dx[p->cones[c].at] = change;
  }
  for (int k = 0; k < p->n_balls; k++)
    if (p->balls[k].bounding < 0) turn_ball(&p->balls[k], x, p->balls[k].ratio, 0, dx);
}

/* Into z what is projected, A' y; into x the projection; into `rest` b - A x. Returns the dual
 * function b'y - (y'A x - |x|^2 / 2). *missed: the largest part of the
 * size of an equation, |b| + |row| |x|, by which it is missed. */
static double evaluate(const frot_cone_problem *p, const double *y, double *z, double *x,
                       double *rest, double *missed) {
  int n = p->n;
  memset(z, 0, sizeof(double) * (size_t)n);
  for (int r = 0; r < p->rows; r++)
    for (int j = 0; j < n; j++) z[j] += y[r] * p->a[r * n + j];
  memcpy(x, z, sizeof(double) * (size_t)n);
  frot_project_cones(p, x);
  *missed = 0;
  double length = frot_length(x, n);
  for (int r = 0; r < p->rows; r++) {
    const double *row = p->a + r * n;
    double size = fabs(p->b[r]) + length * frot_length(row, n);
    rest[r] = p->b[r] - frot_dot(row, x, n);
    if (size > 0) *missed = fmax(*missed, fabs(rest[r]) / size);
  }
  return frot_dot(p->b, y, p->rows) - frot_dot(z, x, n) + 0.5 * frot_dot(x, x, n);
}

/* step <- (A P' A' + damping)^-1 rest; `turned` (rows x n) is scratch. Returns 1 where there is
 * none. */
static int newton_step(const frot_cone_problem *p, const double *z, const double *rest,
                       double damping, double *turned, double *hessian, double *step) {
  int n = p->n, rows = p->rows;
  double most = 0;
  for (int r = 0; r < rows; r++) {
    memcpy(turned + r * n, p->a + r * n, sizeof(double) * (size_t)n);
    project_change(p, z, turned + r * n);
  }
  for (int r = 0; r < rows; r++)
    for (int k = 0; k < rows; k++) {
      hessian[k * rows + r] = frot_dot(p->a + r * n, turned + k * n, n);
      if (r == k) most = fmax(most, frot_dot(p->a + r * n, p->a + r * n, n));
    }
  for (int r = 0; r < rows; r++) hessian[r * rows + r] += damping * most;
  memcpy(step, rest, sizeof(double) * (size_t)rows);
  if (frot_cholesky(hessian, rows)) return 1;
  frot_forward(hessian, rows, rows, step);
  frot_backward(hessian, rows, rows, step);
  return 0;
}

int frot_cone_point(const frot_cone_problem *p, double *x, double *y, double *scratch) {
  int n = p->n, rows = p->rows;
  double *z = scratch, *turned = z + n, *hessian = turned + n * rows, *rest = hessian + rows * rows,
         *step = rest + rows, *next = step + rows, *next_rest = next + rows,
         *next_z = next_rest + rows, *next_x = next_z + n, missed, size = frot_length(p->b, rows);
  double value = evaluate(p, y, z, x, rest, &missed);
  for (int k = 0; k < STEPS && missed > p->tolerance; k++) {
    double part = size > 0 ? frot_length(rest, rows) / size : 1;
    double damping = fmin(MOST_DAMPING, fmax(LEAST_DAMPING, part * part * MOST_DAMPING));
    for (int tries = 0; newton_step(p, z, rest, damping, turned, hessian, step); tries++) {
      if (tries == 8) return 1;
      damping *= 100;
    }
    double slope = frot_dot(rest, step, rows), length = 1, next_missed = 0;
    int halving = 0;
    for (; halving < HALVINGS; halving++, length *= 0.5) {
      for (int r = 0; r < rows; r++) next[r] = y[r] + length * step[r];
      double found = evaluate(p, next, next_z, next_x, next_rest, &next_missed);
      if (found >= value + SUFFICIENT * length * slope - ROUNDING * fabs(value) ||
          next_missed <= p->tolerance) {
        value = found;
        break;
      }
    }
    if (halving == HALVINGS) return 1;
    memcpy(y, next, sizeof(double) * (size_t)rows), memcpy(z, next_z, sizeof(double) * (size_t)n);
    memcpy(x, next_x, sizeof(double) * (size_t)n);
    memcpy(rest, next_rest, sizeof(double) * (size_t)rows);
    missed = next_missed;
    if (frot_length(x, n) > FARTHEST * size && size > 0) return 1;
  }
  return !(missed <= p->tolerance);
}
