#include "guesses.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "closest.h"
#include "core.h"
#include "damped.h"
#include "elsewhere.h"
#include "linear.h"
#include "nearest.h"
#include "tolerances.h"

#define BEGINNINGS 10 /* of the search for a place near the guesses */
/* A place is what the guesses mean if what they are missed by is this square of their sizes. */
#define MEANT 1e-4
/* Part of the length of a slope that is its own, beside the vector it is an item of and the other
 * guesses, for its guess to say more. */
#define SAYS_MORE 0.1

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

int frot_near_guesses(frot_opening *p) {
  frot_opening_work *w = &p->w->opening;
  double least = INFINITY, *y = p->w->blocks.y, *best = w->near, *best_y = best + p->m->nq;
  double *first_y = w->first + p->m->nq;
  size_t bytes = sizeof(double) * (size_t)p->m->nq, y_bytes = sizeof(double) * (size_t)p->m->ny;
  frot_take_liaisons(p);
  p->guessed = 1;
  if (frot_evaluate_statements(p) == FROT_OK) memcpy(w->begin, w->natural, bytes);
  for (int k = 0; k < BEGINNINGS && least > MEANT; k++) {
    frot_clear_opening(p);
    memcpy(p->q, w->begin, bytes);
    memcpy(y, first_y, y_bytes);
    frot_begin_units(p);
    if (k > 0 && frot_opening_metric(p) == FROT_OK) frot_begin_elsewhere(p, k - 1, k % 3 == 0);
    if (!frot_follow_damped(p)) continue;
    double missed = missed_from(p, 0);
    if (missed < least) least = missed, memcpy(best, p->q, bytes), memcpy(best_y, y, y_bytes);
  }
  if (isfinite(least)) {
    memcpy(p->q, best, bytes);
    memcpy(y, best_y, y_bytes);
    if (frot_note_beginning(p) == FROT_OK) frot_unwind(p);
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

/* The factor of the metric of the speeds marked in `moves`, which come first; returns how many. */
static int factor_moving(frot_opening *p, const double *moves, int *list) {
  int n = 0;
  for (int k = 0; k < p->m->nv; k++)
    if (moves[k] != 0) list[n++] = k;
  double *factor = p->w->opening.factor;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) factor[n * j + i] = frot_metric_entry(p->m, p->w, list[i], list[j]);
  return frot_cholesky(factor, n) ? 0 : n;
}

int frot_look_at_guessed_speeds(const frot_opening *p) {
  frot_work *w = p->w;
  int n = p->m->n_guessed_speeds, nv = p->m->nv;
  frot_inputs(p->m, p->s, w, &p->t, p->q, p->v, p->d);
  w->call.res[0] = w->relations.residual, w->call.res[1] = w->relations.size;
  w->call.res[2] = w->relations.jacobian, w->call.res[3] = w->relations.jacobian + n * nv;
  w->call.res[4] = w->opening.scratch;
  frot_call(w, &p->m->guessed_speeds);
  return frot_all_finite(w->relations.residual, n) &&
         frot_all_finite(w->relations.jacobian, 4 * n * nv);
}

/* y <- L^-1 of the slope of a guess in the speeds that move; returns its square. */
static double half_of_slope(const frot_work *w, const double *slope, const int *list, int count,
                            double *y) {
  for (int k = 0; k < count; k++) y[k] = slope[list[k]];
  frot_forward(w->opening.factor, count, count, y);
  return frot_dot(y, y, count);
}

int frot_follow_guessed_speeds(frot_opening *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int n = m->n_guessed_speeds, *list = w->linear.pivot + m->nv;
  if (n == 0) return FROT_OK;
  int status = frot_opening_metric(p);
  if (status != FROT_OK) return frot_no_number(p, status);
  if (!frot_look_at_guessed_speeds(p)) return FROT_OK;
  double *missed = w->relations.residual, *slopes = w->relations.jacobian;
  double *items = slopes + n * m->nv;
  int count = factor_moving(p, w->opening.scratch, list);
  double *a = w->linear.matrix, *b = w->linear.right, *y = w->relations.step, most = 0;
  for (int i = 0; i < n; i++) {
    double whole = 0;
    for (int c = 3 * i; c < 3 * i + 3; c++)
      whole += half_of_slope(w, items + c * m->nv, list, count, y);
    double own = half_of_slope(w, slopes + i * m->nv, list, count, y);
    double weight = whole > 0 ? 1 / sqrt(whole) : 0;
    most = fmax(most, own * weight * weight);
    for (int k = 0; k < count; k++) a[k * n + i] = weight * y[k];
    b[i] = -weight * missed[i];
  }
  if (most < SAYS_MORE * SAYS_MORE) return FROT_OK;
  frot_least_norm(a, b, n, count, SAYS_MORE, y, w->linear.scratch, w->linear.pivot);
  frot_backward(w->opening.factor, count, count, y);
  for (int k = 0; k < count; k++) p->v[list[k]] += y[k];
  return FROT_OK;
}
