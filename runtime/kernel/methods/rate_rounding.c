#include "methods/rate_rounding.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "methods/jacobian.h"
#include "model/stage_slopes.h"
#include "numerics/rodas_table.h"

/* Part of a state's size from which on it is noted: so many tolerances, and within these bounds.
 * The estimate bounds each rounding by the sizes of terms, so that a small one may be none. */
#define TOLERANCES 100
#define LEAST_NOTED 1e-3
#define MOST_NOTED 0.1

/* Rows of w->step.k behind those of the stages. */
enum { RIGHT = DP_STAGES + 1, CARRIED, SIZE };
typedef char frot_rounding_rows_suffice[SIZE < DP_ALL ? 1 : -1];

/* A sign for each state and step, in no order. */
static double any_sign(unsigned long long step, int state) {
  unsigned long long mixed = (step + 1) * 0x9e3779b97f4a7c15ull + (unsigned)state + 1;
  mixed = (mixed ^ (mixed >> 31)) * 0xbf58476d1ce4e5b9ull;
  return (mixed ^ (mixed >> 29)) & 1 ? 1 : -1;
}

/* The largest error over the size of its state, and which state that is. */
static double largest(const frot_model *m, const frot_work *w, const double *error, int *state) {
  double most = 0;
  for (int k = 0; k < m->nq; k++) {
    double part = fabs(error[k]) / fmax(w->sizes.own[k], DBL_MIN);
    if (part > most) most = part, *state = k;
  }
  return most;
}

/* What rounding of the terms of the rates makes of a state in a step: of their sizes |J| |z|. */
static void add_rounding(const frot_model *m, const frot_state *s, const frot_work *w, double h,
                         double *error) {
  double *value = frot_stage(w, RIGHT), *size = frot_stage(w, SIZE);
  for (int k = 0; k < m->nq; k++) value[k] = fmax(fabs(w->step.z0[k]), fabs(w->step.z1[k]));
  frot_jacobian_spread(m, w, value, size);
  for (int k = 0; k < m->nq; k++)
    error[k] += any_sign((unsigned long long)s->statistics.steps, k) * DBL_EPSILON *
                (h * size[k] + value[k]);
}

/* into <- X (one e + part x), X = (1 - h gamma J)^-1. */
static void apply(const frot_model *m, const frot_work *w, double h, double one, const double *e,
                  double part, const double *x, double *into) {
  double *right = frot_stage(w, RIGHT), shift = 1 / (h * ro_gamma);
  for (int k = 0; k < m->nq; k++) right[k] = shift * (one * e[k] + part * x[k]);
  frot_jacobian_solve(m, w, right, into);
}

/* error <- c1 X error + c2 X^2 error + c3 X^3 error, to second order exp(h J) error, and X of what
 * is made in the step. On the left half plane that is no larger than one; what X lets grow by
 * 1/(1 - gamma x) grows by exp(x) and no more. The largest over the size of its state; *state is
 * that state. */
static double carry(const frot_model *m, const frot_state *s, const frot_work *w, double h,
                    double *error, int *state) {
  const double first = 1 / ro_gamma - 1, second = 0.5 / (ro_gamma * ro_gamma) - 1;
  const double c3 = second - 2 * first, c2 = first - 2 * c3, c1 = 1 - c2 - c3;
  double *carried = frot_stage(w, CARRIED), before = largest(m, w, error, state);
  apply(m, w, h, 1, error, 0, error, carried);
  double growth = largest(m, w, carried, state) / before;
  apply(m, w, h, c2, error, c3, carried, carried);
  for (int k = 0; k < m->nq; k++) error[k] *= c1;
  add_rounding(m, s, w, h, error);
  apply(m, w, h, 1, error, 1, carried, error);
  double after = largest(m, w, error, state);
  double most = growth > 1 ? before * exp((1 - 1 / growth) / ro_gamma) : after;
  if (!(after > most)) return after;
  for (int k = 0; k < m->nq; k++) error[k] *= most / after;
  return most;
}

void frot_follow_rate_rounding(const frot_model *m, frot_state *s, frot_work *w, double h) {
  double *error = s->data + w->layout.lost;
  int state = -1;
  if (frot_has_motion(m)) return;
  if (!s->implicit) {
    for (int k = 0; k < m->nq; k++) {
      double before = fabs(w->step.z0[k]), after = fabs(w->step.z1[k]);
      if (after < before) error[k] *= after / before;
    }
    return;
  }
  double most = carry(m, s, w, h, error, &state);
  if (!isfinite(most)) frot_forget_rate_rounding(m, s, w);
  double noted = fmin(fmax(TOLERANCES * s->tolerance, LEAST_NOTED), MOST_NOTED);
  if (isfinite(most) && most > fmax(noted, s->statistics.lost))
    s->statistics.lost = most, s->statistics.lost_state = state;
}

void frot_forget_rate_rounding(const frot_model *m, frot_state *s, const frot_work *w) {
  memset(s->data + w->layout.lost, 0, sizeof(double) * (size_t)m->nq);
}
