#include "starts/guesses.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "assembly/nearest_solution.h"
#include "evaluation/evaluate.h"
#include "assembly/levenberg_marquardt.h"
#include "starts/multistart.h"
#include "starts/sequential_guesses.h"
#include "numerics/dense.h"
#include "numerics/basis.h"
#include "assembly/gauss_newton.h"
#include "assembly/start_parts.h"
#include "numerics/tolerances.h"

#define BEGINNINGS 10 /* of the search for another place near the guesses */
#define ROUNDS 40     /* of the weights of guesses, until they are settled */
/* Part of the length of a slope that is its own, beside the vector it is an item of and the other
 * guesses, for its guess to say more. */
#define SAYS_MORE 0.1

int frot_has_guesses(const frot_opening *p) { return !p->velocity && p->part->n_guessed > 0; }

/* What each guess counts: the items of a vector alike, by the effective mass of the vector at p->x.
 * Returns the largest part that one of them changed by, INFINITY where something is no number. */
static double weigh_guesses(frot_opening *p) {
  const frot_part *part = p->part;
  double *weights = p->w->opening.guess_weight, *square = weights + p->m->n_guessed, most = 0;
  frot_begin_units(p);
  p->aim = 1;
  int status = frot_opening_metric(p);
  if (status == FROT_OK) status = frot_evaluate_statements(p);
  p->aim = 0;
  if (status != FROT_OK) return INFINITY;
  for (int j = 0; j < part->n_guessed; j++) {
    double length = frot_row_length(p, p->n + j), *whole = square + part->vectors[j];
    *whole = (part->vectors[j] == j ? 0 : *whole) + length * length;
  }
  for (int j = 0; j < part->n_guessed; j++) {
    double whole = square[part->vectors[j]], *weight = weights + part->guessed[j];
    double before = *weight;
    *weight = whole > 0 && isfinite(1 / whole) ? 1 / sqrt(whole) : 0;
    if (*weight != before) most = fmax(most, fabs(*weight - before) / fmax(*weight, before));
  }
  return most;
}

double frot_guesses_missed(frot_opening *p) {
  double sum = 0;
  int aims = p->aim;
  p->aim = 1;
  int status = frot_evaluate_statements(p);
  p->aim = aims;
  for (int j = 0; j < p->part->n_guessed && status == FROT_OK; j++) {
    double weight = p->w->opening.guess_weight[p->part->guessed[j]];
    double part = p->w->relations.residual[p->n + j] * weight;
    sum += part * part;
  }
  return status == FROT_OK && isfinite(sum) ? sqrt(sum) : INFINITY;
}

int frot_are_guesses_met(frot_opening *p) {
  int met = 1;
  p->aim = 1;
  if (frot_evaluate_statements(p) != FROT_OK) met = 0;
  for (int j = 0; j < p->part->n_guessed && met; j++) met = frot_statement_agrees(p, p->n + j, 0);
  p->aim = 0;
  return met;
}

/* p->x <- the place at which guesses and equations hold best together near it, by damped least
 * squares, then the equations. Returns 0 if there is none. */
static int compromise(frot_opening *p) {
  p->guessed = p->alike = 1;
  int found = frot_follow_damped(p);
  p->guessed = p->alike = 0;
  if (found) found = frot_solve_nearest(p) == FROT_OK;
  frot_clear_opening(p);
  return found;
}

/* On from a place where the equations hold to one near it that misses the guesses least, weighed as
 * they are there. */
static void aim(frot_opening *p) {
  for (int k = 0; k < ROUNDS; k++) {
    double changed = weigh_guesses(p);
    if (!isfinite(changed) || (k > 0 && changed < FROT_GUESS_SETTLED)) break;
    p->aim = 1, p->missed = frot_guesses_missed;
    if (frot_come_closest(p) != FROT_OK) frot_clear_opening(p);
    p->aim = 0;
  }
}

double frot_least_missed(frot_opening *p) {
  memcpy(p->w->opening.begin, p->x, sizeof(double) * (size_t)p->n_own);
  if (frot_note_beginning(p) != FROT_OK) return INFINITY;
  aim(p);
  return frot_are_guesses_met(p) ? 0 : frot_guesses_missed(p);
}

/* Angles without whole turns that neither equations nor guesses notice. */
static void unwind(frot_opening *p) {
  p->guessed = p->alike = 1;
  frot_unwind(p);
  p->guessed = p->alike = 0;
}

/* p->x <- of compromises near w->opening.begin and near places elsewhere the one that misses the
 * guesses least, the first that meets them. Returns 0 if there is none. */
static int compromise_widely(frot_opening *p) {
  frot_opening_work *w = &p->w->opening;
  double least = INFINITY, *best = w->near, *best_y = best + p->n_own;
  size_t bytes = sizeof(double) * (size_t)p->n_own;
  for (int k = 0, met = 0; k < BEGINNINGS && !met; k++) {
    frot_clear_opening(p);
    memcpy(p->x, w->begin, bytes);
    frot_begin_blocks(p);
    frot_begin_units(p);
    if (frot_opening_metric(p) != FROT_OK) continue;
    if (k == 1) frot_meet_guesses_in_sequence(p);
    if (k > 1) frot_begin_multistart(p, k - 2, (k - 1) % 3 == 0);
    if (!compromise(p)) continue;
    double missed = frot_guesses_missed(p);
    met = frot_are_guesses_met(p);
    if (met || missed < (1 - FROT_NEARER) * least)
      least = missed, memcpy(best, p->x, bytes), frot_keep_blocks(p, best_y);
  }
  frot_clear_opening(p);
  if (!isfinite(least)) return 0;
  memcpy(p->x, best, bytes);
  frot_return_blocks(p, best_y);
  return 1;
}

/* The same for one part. */
static void meet_part(frot_opening *p) {
  frot_opening_work *w = &p->w->opening;
  size_t bytes = sizeof(double) * (size_t)p->n_own;
  if (!isfinite(weigh_guesses(p))) return;
  memcpy(w->begin, p->x, bytes);
  if (frot_note_beginning(p) != FROT_OK) return;
  p->guessed = 1;
  int met = frot_solve_nearest(p) == FROT_OK && frot_come_closest(p) == FROT_OK;
  p->guessed = 0;
  frot_clear_opening(p);
  if (met) return;
  if (!compromise_widely(p)) memcpy(p->x, w->begin, bytes);
  unwind(p);
  aim(p);
}

void frot_meet_guesses(frot_opening *p) {
  memset(p->use, 0, (size_t)p->m->n_contacts);
  memset(p->w->opening.guess_weight, 0, sizeof(double) * (size_t)p->m->n_guessed);
  p->direct = p->w->blocks.unwanted = 1;
  for (int part = 0; part < p->m->n_parts && p->m->n_guessed > 0; part++) {
    if (p->m->parts[part].n_guessed == 0) continue;
    frot_take_part(p, &p->m->parts[part]);
    meet_part(p);
    frot_put(p);
  }
  p->direct = p->w->blocks.unwanted = 0;
  frot_leave_parts(p);
}

void frot_begin_as_met(const frot_opening *p) {
  frot_opening_work *w = &p->w->opening;
  for (int k = 0; k < p->n_own; k++) w->begin[k] = w->met[p->part->reads.q[k]];
}

int frot_find_other(frot_opening *p) {
  frot_begin_as_met(p);
  if (!compromise_widely(p)) return 0;
  if (frot_note_beginning(p) == FROT_OK) unwind(p);
  return 1;
}

/* The factor of the metric of the speeds marked in `moves`, which come first; returns how many. */
static int factor_moving(frot_opening *p, const double *moves, int *list) {
  const int *speed = p->part->reads.v;
  int n = 0;
  for (int k = 0; k < p->n_own; k++)
    if (moves[k] != 0) list[n++] = k;
  double *factor = p->w->opening.factor;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      factor[n * j + i] = frot_metric_entry(p->m, p->w, speed[list[i]], speed[list[j]]);
  return frot_cholesky(factor, n) ? 0 : n;
}

int frot_look_at_guessed_speeds(const frot_opening *p) {
  frot_work *w = p->w;
  int n = p->part->n_guessed, nx = p->n_own;
  frot_put(p);
  w->call.res[0] = w->relations.residual, w->call.res[1] = w->relations.size;
  w->call.res[2] = w->relations.jacobian, w->call.res[3] = w->relations.jacobian + n * nx;
  w->call.res[4] = w->opening.scratch;
  frot_evaluate_part(p, &p->part->guessing);
  return frot_all_finite(w->relations.residual, n) &&
         frot_all_finite(w->relations.jacobian, 4 * n * nx);
}

/* y <- L^-1 of the slope of a guess in the speeds that move; returns its square. */
static double half_of_slope(const frot_work *w, const double *slope, const int *list, int count,
                            double *y) {
  for (int k = 0; k < count; k++) y[k] = slope[list[k]];
  frot_forward(w->opening.factor, count, count, y);
  return frot_dot(y, y, count);
}

int frot_follow_guessed_speeds(frot_opening *p) {
  frot_work *w = p->w;
  int n = p->part->n_guessed, nx = p->n_own, *list = w->linear.pivot + nx;
  if (n == 0) return FROT_OK;
  int status = frot_opening_metric(p);
  if (status != FROT_OK) return frot_no_number(p, status);
  if (!frot_look_at_guessed_speeds(p)) return FROT_OK;
  double *missed = w->relations.residual, *slopes = w->relations.jacobian;
  double *items = slopes + n * nx;
  int count = factor_moving(p, w->opening.scratch, list);
  double *a = w->linear.matrix, *b = w->linear.right, *y = w->relations.step, most = 0;
  for (int i = 0; i < n; i++) {
    double whole = 0;
    for (int c = 3 * i; c < 3 * i + 3; c++)
      whole += half_of_slope(w, items + c * nx, list, count, y);
    double own = half_of_slope(w, slopes + i * nx, list, count, y);
    double weight = whole > 0 ? 1 / sqrt(whole) : 0;
    most = fmax(most, own * weight * weight);
    for (int k = 0; k < count; k++) a[k * n + i] = weight * y[k];
    b[i] = -weight * missed[i];
  }
  if (most < SAYS_MORE * SAYS_MORE) return FROT_OK;
  frot_least_norm(a, b, n, count, SAYS_MORE, y, w->linear.scratch, w->linear.pivot);
  frot_backward(w->opening.factor, count, count, y);
  for (int k = 0; k < count; k++) p->x[list[k]] += y[k];
  return FROT_OK;
}
