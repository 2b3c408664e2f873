#include "guesses.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "closest.h"
#include "core.h"
#include "elsewhere.h"
#include "linear.h"
#include "nearest.h"
#include "tolerances.h"

#define PASSES 60
#define BEGINNINGS 10 /* of the search for a place near the guesses */
/* Damping, relative to rows of length 1: at first, how it falls and grows, and where no way is. */
#define DAMPING 0.03
#define EASIER 0.2
#define HARDER 5.0
#define STUCK 1e6
/* What is left of a sum of squares that is zero, and what it must fall by in a pass. */
#define NOTHING 1e-24
#define SETTLED 1e-4
#define WHOLE_TURN 6.283185307179586
#define UNNOTICED (1 + 1e-9)
#define ROUNDS 4  /* of turns that others make shorter */
#define SHARE 0.3 /* how much guesses count beside statements and liaisons */
/* A place is what the guesses mean if what they are missed by is this square of their sizes. */
#define MEANT 1e-4

/* Sum of the squares of the residuals, weighed as they are. */
static double square(const frot_opening *p) {
  double sum = 0;
  for (int i = 0; i < p->n; i++) {
    double part = p->w->relations.residual[i] * p->w->opening.row_weight[i];
    sum += part * part;
  }
  return sum;
}

/* What residuals are measured by: the sizes of the terms where the search begins. */
static void weigh_rows(const frot_opening *p) {
  const frot_relation_work *r = &p->w->relations;
  for (int i = 0; i < p->n; i++) {
    int guess = i >= p->n - p->m->n_guessed;
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

/* To a place near p->q where all equations hold as far as they can together
 * (K. Levenberg 1944, D. Marquardt 1963). Returns 0 where something is no number. */
static int follow(frot_opening *p) {
  frot_work *w = p->w;
  double damping = DAMPING, *x0 = w->opening.way, *step = w->relations.step;
  int nx = p->m->nq;
  if (frot_evaluate_statements(p) != FROT_OK) return 0;
  weigh_rows(p);
  memset(w->relations.unit, 0, sizeof(double) * (size_t)nx);
  for (int pass = 0; pass < PASSES; pass++) {
    double before = square(p), after = INFINITY;
    scale_rows(p);
    for (int i = 0; i < p->n; i++)
      w->linear.right[p->n + i] = w->relations.residual[i] * w->opening.row_weight[i];
    memcpy(x0, p->q, sizeof(double) * (size_t)nx);
    memcpy(w->step.y_end, w->blocks.y, sizeof(double) * (size_t)p->m->ny);
    for (; damping < STUCK && !(after < before); damping *= HARDER) {
      memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)p->m->ny);
      if (!damped_change(p, damping, step)) continue;
      for (int k = 0; k < nx; k++) p->q[k] = x0[k] + step[k];
      after = frot_evaluate_statements(p) == FROT_OK ? square(p) : INFINITY;
    }
    if (!(after < before)) {
      memcpy(p->q, x0, sizeof(double) * (size_t)nx);
      return frot_evaluate_statements(p) == FROT_OK;
    }
    damping *= EASIER / HARDER;
    if (after <= NOTHING || after > (1 - SETTLED) * before) return 1;
  }
  return 1;
}

/* Mean square of what the equations from `first` on are missed by, in parts of their sizes. */
static double missed_from(const frot_opening *p, int first) {
  double sum = 0;
  for (int i = first; i < p->n; i++) {
    int guess = i >= p->n - p->m->n_guessed;
    double size = guess ? p->w->relations.size[i] : frot_statement_size(p, i);
    double part = size > 0 ? p->w->relations.residual[i] / size : 0;
    sum += part * part;
  }
  return p->n > first ? sum / (p->n - first) : 0;
}

/* The bilateral liaisons, with the sides of the place as it is. */
static void take_liaisons(const frot_opening *p) {
  const frot_model *m = p->m;
  const double *unilateral = p->s->data + frot_layout_of(m).unilateral;
  for (int i = 0; i < m->n_contacts; i++)
    p->use[i] = frot_has_normal(&m->contacts[i]) && !m->contacts[i].reduced && unilateral[i] == 0;
}

/* Whether another turn of coordinate k is nearer to the beginning, and no equation notices. */
static int take_turn(frot_opening *p, int k, double turn, double missed, double *far) {
  double here = p->q[k];
  p->q[k] = here + turn;
  double now = frot_change_size(p);
  if (now < (1 - FROT_NEARER) * *far && frot_evaluate_statements(p) == FROT_OK &&
      square(p) <= missed * UNNOTICED + NOTHING) {
    *far = now;
    return 1;
  }
  p->q[k] = here;
  return 0;
}

/* Whole turns on the way say nothing: the least change is wanted that leads to this place. */
static void unwind(frot_opening *p) {
  if (frot_note_beginning(p) != FROT_OK || frot_evaluate_statements(p) != FROT_OK) return;
  weigh_rows(p);
  double far = frot_change_size(p), missed = square(p);
  for (int round = 0, moved = 1; round < ROUNDS && moved; round++) {
    moved = 0;
    for (int k = 0; k < p->m->nq; k++)
      moved |=
          take_turn(p, k, WHOLE_TURN, missed, &far) || take_turn(p, k, -WHOLE_TURN, missed, &far);
  }
}

int frot_near_guesses(frot_opening *p) {
  frot_opening_work *w = &p->w->opening;
  double least = INFINITY, *y = p->w->blocks.y, *best = w->near, *best_y = best + p->m->nq;
  double *first_y = w->first + p->m->nq;
  size_t bytes = sizeof(double) * (size_t)p->m->nq, y_bytes = sizeof(double) * (size_t)p->m->ny;
  take_liaisons(p);
  p->guessed = 1;
  if (frot_evaluate_statements(p) == FROT_OK) memcpy(w->begin, w->natural, bytes);
  for (int k = 0; k < BEGINNINGS && least > MEANT; k++) {
    frot_clear_opening(p);
    memcpy(p->q, w->begin, bytes);
    memcpy(y, first_y, y_bytes);
    frot_begin_units(p);
    if (k > 0 && frot_opening_metric(p) == FROT_OK) frot_begin_elsewhere(p, k - 1, k % 3 == 0);
    if (!follow(p)) continue;
    double missed = missed_from(p, 0);
    if (missed < least) least = missed, memcpy(best, p->q, bytes), memcpy(best_y, y, y_bytes);
  }
  if (isfinite(least)) {
    memcpy(p->q, best, bytes);
    memcpy(y, best_y, y_bytes);
    unwind(p);
  }
  p->guessed = 0;
  frot_clear_opening(p);
  return isfinite(least);
}

double frot_guesses_missed(frot_opening *p) {
  p->guessed = 1;
  int status = frot_evaluate_statements(p);
  p->guessed = 0;
  if (status != FROT_OK) return INFINITY;
  double missed = missed_from(p, p->n - p->m->n_guessed);
  p->n -= p->m->n_guessed;
  return isfinite(missed) ? missed : INFINITY;
}
