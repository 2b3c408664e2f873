#include "damped.h"

#include <math.h>
#include <string.h>

#include "linear.h"

#define PASSES 60
/* Damping, relative to rows of length 1: at first, how it falls and grows, and where no way is. */
#define DAMPING 0.03
#define EASIER 0.2
#define HARDER 5.0
#define STUCK 1e6
#define SETTLED 1e-4 /* what the sum of squares must fall by in a pass */
#define SHARE 0.3    /* how much guesses count beside statements and liaisons */

double frot_missed_square(const frot_opening *p) {
  double sum = 0;
  for (int i = 0; i < p->n; i++) {
    double part = p->w->relations.residual[i] * p->w->opening.row_weight[i];
    sum += part * part;
  }
  return sum;
}

/* What the angles do to an equation, whatever the masses; of what they do nothing to, its size. */
static double arm_of(const frot_opening *p, int i) {
  const double *row = p->w->relations.jacobian + p->m->nq * i;
  double square = 0;
  for (int j = 0; j < p->m->nv; j++) {
    int k = frot_angle_of(p->m, j);
    if (k >= 0) square += row[k] * row[k];
  }
  return square > 0 ? sqrt(square) : frot_statement_size(p, i);
}

/* By their arms, and those between lengths, or between directions (of reach 1), of one liaison by
 * the mean of theirs: so that it does not matter where the scene stands, nor along which axes it is
 * seen. */
static void weigh_alike(const frot_opening *p) {
  const frot_model *m = p->m;
  const double *reach = p->w->opening.reach;
  double *weight = p->w->opening.row_weight, *arm = p->w->opening.off_at_first;
  int n = m->n_position;
  for (int i = 0; i < p->n; i++) arm[i] = weight[i] = arm_of(p, i);
  for (int i = 0; i < m->n_contacts; i++) {
    double square = 0, count = 0;
    if (!p->use[i] || m->contacts[i].kinematic) continue;
    for (int k = 0, at = m->n_position; k < m->n_contacts; k++) {
      if (!p->use[k] || m->contacts[k].kinematic) continue;
      if (strcmp(m->contacts[k].name, m->contacts[i].name) == 0 &&
          (reach[k] == 1) == (reach[i] == 1))
        square += arm[at] * arm[at], count++;
      at++;
    }
    weight[n++] = sqrt(square / count);
  }
  for (int i = 0; i < p->n; i++) weight[i] = weight[i] > 0 ? 1 / weight[i] : 0;
}

void frot_weigh_equations(const frot_opening *p) {
  const frot_relation_work *r = &p->w->relations;
  if (p->alike && p->m->n_turns == 0) {
    weigh_alike(p);
    return;
  }
  for (int i = 0; i < p->n; i++) {
    int guess = p->guessed && i >= p->n - p->m->n_guessed;
    double size = guess ? r->size[i] : fmax(frot_statement_size(p, i), fabs(r->residual[i]));
    p->w->opening.row_weight[i] = size > 0 ? (guess ? SHARE : 1) / size : 0;
  }
}

/* The rows at p->q into w->linear.matrix (n columns), weighed; changes are measured by the most
 * that they have moved so far (J. More 1978), in w->relations.unit. */
static void scale_rows(const frot_opening *p) {
  frot_work *w = p->w;
  int nx = p->m->nq;
  double *y = w->linear.matrix, *unit = w->relations.unit;
  for (int k = 0; k < nx; k++) {
    double sum = 0;
    for (int i = 0; i < p->n; i++) {
      y[nx * i + k] = w->relations.jacobian[nx * i + k] * w->opening.row_weight[i];
      sum += y[nx * i + k] * y[nx * i + k];
    }
    unit[k] = fmax(unit[k], sqrt(sum));
    for (int i = 0; i < p->n && unit[k] > 0; i++) y[nx * i + k] /= unit[k];
  }
}

/* step <- the change that makes |rows step + residual|^2 + damping |step|^2 least, or that way as
 * far as is known of. Returns 0 if there is none. */
static int damped_change(const frot_opening *p, double damping, double *step) {
  frot_work *w = p->w;
  int nx = p->m->nq, n = p->n;
  double *product = w->linear.scratch, *b = w->linear.right, largest = 0;
  for (int j = 0; j < n; j++) {
    const double *row = w->linear.matrix + nx * j;
    for (int i = j; i < n; i++)
      product[n * j + i] = frot_dot(row, w->linear.matrix + nx * i, nx) + (i == j ? damping : 0);
    b[j] = -w->linear.right[n + j];
  }
  if (frot_cholesky(product, n)) return 0;
  frot_forward(product, n, n, b);
  frot_backward(product, n, n, b);
  memset(step, 0, sizeof(double) * (size_t)nx);
  for (int i = 0; i < n; i++)
    for (int k = 0; k < nx; k++) step[k] += w->linear.matrix[nx * i + k] * b[i];
  for (int k = 0; k < nx; k++) largest = fmax(largest, fabs(step[k]));
  for (int k = 0; k < nx; k++)
    step[k] = w->relations.unit[k] > 0 ? step[k] / w->relations.unit[k] / fmax(largest, 1) : 0;
  return 1;
}

int frot_follow_damped(frot_opening *p) {
  frot_work *w = p->w;
  double damping = DAMPING, *x0 = w->opening.way, *step = w->relations.step;
  int nx = p->m->nq;
  if (frot_evaluate_statements(p) != FROT_OK) return 0;
  frot_weigh_equations(p);
  memset(w->relations.unit, 0, sizeof(double) * (size_t)nx);
  for (int pass = 0; pass < PASSES; pass++) {
    double before = frot_missed_square(p), after = INFINITY;
    scale_rows(p);
    for (int i = 0; i < p->n; i++)
      w->linear.right[p->n + i] = w->relations.residual[i] * w->opening.row_weight[i];
    memcpy(x0, p->q, sizeof(double) * (size_t)nx);
    memcpy(w->step.y_end, w->blocks.y, sizeof(double) * (size_t)p->m->ny);
    for (; damping < STUCK && !(after < before); damping *= HARDER) {
      memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)p->m->ny);
      if (!damped_change(p, damping, step)) continue;
      for (int k = 0; k < nx; k++) p->q[k] = x0[k] + step[k];
      after = frot_evaluate_statements(p) == FROT_OK ? frot_missed_square(p) : INFINITY;
    }
    if (!(after < before)) {
      memcpy(p->q, x0, sizeof(double) * (size_t)nx);
      return frot_evaluate_statements(p) == FROT_OK;
    }
    damping *= EASIER / HARDER;
    if (after <= FROT_NOTHING_MISSED || after > (1 - SETTLED) * before) return 1;
  }
  return 1;
}
