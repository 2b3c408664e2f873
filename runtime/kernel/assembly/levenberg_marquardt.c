#include "assembly/levenberg_marquardt.h"

#include <math.h>
#include <string.h>

#include "assembly/unknowns.h"
#include "numerics/dense.h"
#include "assembly/start_parts.h"
#include "numerics/tolerances.h"

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

/* What the angles do to an equation, whatever the masses, squared. */
static double square_of_arm(const frot_opening *p, int i) {
  const double *row = p->w->relations.jacobian + p->n_own * i;
  double square = 0;
  for (int k = 0; k < p->n_own; k++)
    if (frot_is_angle(p, k)) square += row[k] * row[k];
  for (int j = 0; j < p->part->n_turns; j++) {
    const double *four = row + p->w->opening.turns[j].at;
    square += frot_dot(four, four, 4) / 4;
  }
  return square;
}

/* By their arms, or their sizes where no angle moves them; those between lengths, or between
 * directions, of one liaison and those of one guessed vector by the mean of theirs: so that it does
 * not matter where the scene stands, nor along which axes it is seen. */
static void weigh_alike(const frot_opening *p) {
  const frot_part *part = p->part;
  double *weight = p->w->opening.row_weight, *arm = p->w->opening.off_at_first;
  int n = part->n_stated;
  for (int i = 0; i < p->n; i++) arm[i] = weight[i] = square_of_arm(p, i);
  for (int a = 0; a < part->n_contacts; a++) {
    int i = part->contacts[a], at = part->n_stated;
    double square = 0, count = 0;
    if (!frot_is_equation(p, i)) continue;
    for (int b = 0; b < part->n_contacts; b++) {
      int k = part->contacts[b];
      if (!frot_is_equation(p, k)) continue;
      if (frot_are_alike(p, i, k)) square += arm[at], count++;
      at++;
    }
    weight[n++] = square / count;
  }
  for (int i = 0; i < part->n_guessed && p->guessed; i++, n++) {
    double square = 0, count = 0;
    for (int k = 0; k < part->n_guessed; k++)
      if (part->vectors[k] == part->vectors[i]) square += arm[n - i + k], count++;
    weight[n] = square / count / (SHARE * SHARE);
  }
  for (int i = 0; i < p->n; i++) {
    double size = weight[i] > 0 ? sqrt(weight[i]) : frot_statement_size(p, i);
    weight[i] = size > 0 ? 1 / size : 0;
  }
}

void frot_weigh_equations(const frot_opening *p) {
  const frot_relation_work *r = &p->w->relations;
  double *weight = p->w->opening.row_weight;
  if (p->alike) weigh_alike(p);
  for (int i = 0; i < p->n; i++) {
    double size = fmax(frot_statement_size(p, i), fabs(r->residual[i]));
    if (!p->alike) weight[i] = size > 0 ? 1 / size : 0;
    if (frot_is_follower(p, i)) weight[i] = 0;
  }
}

/* The rows at p->x over the unknowns of the part into w->linear.matrix, weighed; changes are
 * measured by the most that they have moved so far (J. More 1978), in w->relations.unit. */
static void scale_rows(const frot_opening *p) {
  frot_work *w = p->w;
  int nx = p->n_own, own = p->n_own, n = p->n_rows;
  const int *rows = w->opening.rows;
  double *y = w->linear.matrix;
  for (int a = 0; a < own; a++) {
    int k = w->opening.own[a];
    double sum = 0, *unit = w->relations.unit + k;
    int stays = p->some && w->opening.state[k] != FROT_MOVES_NOW;
    for (int j = 0; j < n; j++) {
      double entry = w->relations.jacobian[nx * rows[j] + k] * w->opening.row_weight[rows[j]];
      y[own * j + a] = stays ? 0 : entry, sum += stays ? 0 : entry * entry;
    }
    *unit = fmax(*unit, sqrt(sum));
    for (int j = 0; j < n && *unit > 0; j++) y[own * j + a] /= *unit;
  }
}

/* step <- the change that makes |rows step + residual|^2 + damping |step|^2 least, or that way as
 * far as is known of. Returns 0 if there is none. */
static int damped_change(const frot_opening *p, double damping, double *step) {
  frot_work *w = p->w;
  int own = p->n_own, n = p->n_rows;
  double *product = w->linear.scratch, *b = w->linear.right, *change = w->opening.apart,
         largest = 0;
  for (int j = 0; j < n; j++) {
    const double *row = w->linear.matrix + own * j;
    for (int i = j; i < n; i++)
      product[n * j + i] = frot_dot(row, w->linear.matrix + own * i, own) + (i == j ? damping : 0);
    b[j] = -w->linear.right[n + j];
  }
  if (frot_cholesky(product, n)) return 0;
  frot_forward(product, n, n, b);
  frot_backward(product, n, n, b);
  memset(change, 0, sizeof(double) * (size_t)own);
  for (int i = 0; i < n; i++)
    for (int a = 0; a < own; a++) change[a] += w->linear.matrix[own * i + a] * b[i];
  for (int a = 0; a < own; a++) largest = fmax(largest, fabs(change[a]));
  for (int a = 0; a < own; a++) {
    double unit = w->relations.unit[w->opening.own[a]];
    step[w->opening.own[a]] = unit > 0 ? change[a] / unit / fmax(largest, 1) : 0;
  }
  return 1;
}

int frot_follow_damped(frot_opening *p) {
  frot_work *w = p->w;
  double damping = DAMPING, *x0 = w->opening.way, *step = w->relations.step;
  int nx = p->n_own;
  if (frot_evaluate_statements(p) != FROT_OK) return 0;
  frot_weigh_equations(p);
  for (int i = 0; i < p->n && p->some; i++)
    if (!w->opening.chosen[i]) w->opening.row_weight[i] = 0;
  memset(w->relations.unit, 0, sizeof(double) * (size_t)nx);
  for (int pass = 0; pass < PASSES; pass++) {
    double before = frot_missed_square(p), after = INFINITY;
    scale_rows(p);
    const int *rows = w->opening.rows;
    for (int j = 0; j < p->n_rows; j++)
      w->linear.right[p->n_rows + j] =
          w->relations.residual[rows[j]] * w->opening.row_weight[rows[j]];
    memcpy(x0, p->x, sizeof(double) * (size_t)nx);
    frot_keep_blocks(p, w->step.y_end);
    for (; damping < STUCK && !(after < before); damping *= HARDER) {
      frot_return_blocks(p, w->step.y_end);
      if (!damped_change(p, damping, step)) continue;
      for (int k = 0; k < nx; k++) p->x[k] = x0[k] + step[k];
      after = frot_evaluate_statements(p) == FROT_OK ? frot_missed_square(p) : INFINITY;
    }
    if (!(after < before)) {
      memcpy(p->x, x0, sizeof(double) * (size_t)nx);
      return frot_evaluate_statements(p) == FROT_OK;
    }
    damping *= EASIER / HARDER;
    if (after <= FROT_NOTHING_MISSED || after > (1 - SETTLED) * before) return 1;
  }
  return 1;
}
