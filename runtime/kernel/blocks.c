#include "blocks.h"

#include <math.h>
#include <string.h>

#include "linear.h"
#include "orthogonal.h"
#include "mechanics.h"
#include "tolerances.h"

#define PASSES 100

/* A block at given arguments. */
typedef struct {
  frot_work *w;
  const frot_block *block;
  double *y;
} problem;

/* Residual, its Jacobian and sizes at p->y. Returns 0, or 1 for no number. */
static int evaluate(const problem *p) {
  frot_work *w = p->w;
  int n = p->block->count;
  w->call.res[0] = w->blocks.r, w->call.res[1] = w->blocks.j, w->call.res[2] = w->blocks.size;
  frot_call(w, &p->block->residual);
  double sum = 0;
  for (int i = 0; i < n; i++) sum += w->blocks.r[i] - w->blocks.r[i];
  for (int i = 0; i < n * n; i++) sum += w->blocks.j[i] - w->blocks.j[i];
  return !(sum == 0);
}

/* The largest residual in the given sizes of the terms. */
static double worst(const double *r, const double *size, int n) {
  double largest = 0;
  for (int i = 0; i < n; i++)
    if (r[i] != 0) largest = fmax(largest, size[i] > 0 ? fabs(r[i]) / size[i] : 1);
  return largest;
}

static int factor(const problem *p) {
  frot_work *w = p->w;
  int n = p->block->count;
  memcpy(w->blocks.lu, w->blocks.j, sizeof(double) * (size_t)(n * n));
  return frot_lu(w->blocks.lu, n, 1, w->blocks.pivot, w->blocks.scale);
}

/* The Newton step into w->blocks.step; of least norm where the Jacobian is singular. */
static int newton_step(const problem *p) {
  frot_work *w = p->w;
  int n = p->block->count, singular = factor(p);
  double *step = w->blocks.step;
  for (int i = 0; i < n; i++) step[i] = -w->blocks.r[i];
  if (!singular) {
    frot_lu_apply(w->blocks.lu, n, w->blocks.pivot, w->blocks.scale, step);
    return 0;
  }
  memcpy(w->blocks.lu, w->blocks.j, sizeof(double) * (size_t)(n * n));
  double *right = step + n;
  memcpy(right, step, sizeof(double) * (size_t)n);
  frot_least_norm(w->blocks.lu, right, n, n, FROT_RANK, step, w->blocks.scale, w->blocks.pivot);
  return 1;
}

static int solve_linear(const problem *p) {
  frot_work *w = p->w;
  int n = p->block->count;
  memset(p->y, 0, sizeof(double) * (size_t)n);
  for (int pass = 0; pass < 2; pass++) { /* the second one refines */
    if (evaluate(p)) return FROT_NAN;
    if (pass == 0 && factor(p)) {
      w->blocks.singular = 1;
      return FROT_ALGEBRAIC;
    }
    frot_lu_apply(w->blocks.lu, n, w->blocks.pivot, w->blocks.scale, w->blocks.r);
    double sum = 0;
    for (int i = 0; i < n; i++) {
      p->y[i] -= w->blocks.r[i];
      sum += p->y[i] - p->y[i];
    }
    if (!(sum == 0)) return FROT_NAN;
  }
  return FROT_OK;
}

/* Whether the same Jacobian would now take a shorter step, in sizes of the values and their steps
 * (P. Deuflhard, Newton Methods for Nonlinear Problems, 2004, sect. 3.3). This asks nothing of the
 * terms of an equation, whose sizes may all be zero where the search begins. */
static int shortens(const problem *p, const double *from, double part) {
  frot_work *w = p->w;
  int n = p->block->count;
  double *next = w->blocks.scale + 2 * n, longest = 0, now = 0;
  memcpy(next, w->blocks.r, sizeof(double) * (size_t)n);
  frot_lu_apply(w->blocks.lu, n, w->blocks.pivot, w->blocks.scale, next);
  for (int i = 0; i < n; i++) {
    double size = fabs(from[i]) + fabs(w->blocks.step[i]);
    if (size == 0 && next[i] != 0) return 0;
    if (size == 0) continue;
    longest = fmax(longest, fabs(w->blocks.step[i]) / size);
    now = fmax(now, fabs(next[i]) / size);
  }
  return now < longest * (1 - 0.25 * part);
}

/* Halve the step until it improves the worst equation, or the next one would be shorter. Returns 1
 * when none does; the values are then those before. `singular`: there are no factors. */
static int line_search(const problem *p, double before, int singular) {
  frot_work *w = p->w;
  int n = p->block->count;
  double *size = w->blocks.size + n, *from = w->blocks.step + n;
  memcpy(size, w->blocks.size, sizeof(double) * (size_t)n);
  memcpy(from, p->y, sizeof(double) * (size_t)n);
  for (double part = 1; part > FROT_LEAST_DAMPING; part *= 0.5) {
    for (int i = 0; i < n; i++) p->y[i] = from[i] + part * w->blocks.step[i];
    if (!evaluate(p) && (worst(w->blocks.r, size, n) < before * (1 - 0.25 * part) ||
                         (!singular && shortens(p, from, part))))
      return 0;
    if (before <= FROT_SETTLED) break;
  }
  memcpy(p->y, from, sizeof(double) * (size_t)n);
  return 1;
}

static int solve_nonlinear(const problem *p) {
  frot_work *w = p->w;
  int n = p->block->count;
  if (evaluate(p)) return FROT_NAN;
  for (int pass = 0; pass < PASSES; pass++) {
    double off = worst(w->blocks.r, w->blocks.size, n);
    if (off <= FROT_ROUNDING) return FROT_OK;
    int singular = newton_step(p);
    if (line_search(p, off, singular)) {
      if (off <= FROT_SETTLED) return FROT_OK;
      w->blocks.singular = singular;
      return FROT_ALGEBRAIC;
    }
  }
  return FROT_ALGEBRAIC;
}

/* Move the solution as rounding may, but further: by that of the terms of each equation, and by its
 * own. */
static void shake(const problem *p) {
  frot_work *w = p->w;
  int n = p->block->count, solved = !evaluate(p) && !factor(p);
  double *change = w->blocks.r;
  for (int i = 0; i < n; i++) {
    int up = ((p->block->first + i) >> w->blocks.pattern) & 1;
    change[i] = (up ? w->blocks.shaken : -w->blocks.shaken) * w->blocks.size[i];
  }
  if (solved) frot_lu_apply(w->blocks.lu, n, w->blocks.pivot, w->blocks.scale, change);
  for (int i = 0; i < n; i++) {
    int up = ((p->block->first + i) >> w->blocks.pattern) & 1;
    double own = (up ? w->blocks.shaken : -w->blocks.shaken) * p->y[i];
    p->y[i] += own + (solved ? change[i] : 0);
  }
}

static int solve(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                 const double *v, const double *d, int late) {
  w->blocks.failed = -1;
  const int *some = late ? NULL : w->blocks.some;
  for (int k = 0; k < (some ? w->blocks.n_some : m->n_blocks); k++) {
    int i = some ? some[k] : k;
    const frot_block *block = &m->blocks[i];
    if (block->late != late) continue;
    problem p = {w, block, w->blocks.y + block->first};
    frot_inputs(s, w, &t, q, v, d);
    w->call.arg[7] = w->core.a, w->call.arg[8] = w->core.lam;
    w->blocks.singular = 0;
    int status = block->linear ? solve_linear(&p) : solve_nonlinear(&p);
    if (status != FROT_OK) {
      w->blocks.failed = i;
      return status;
    }
    if (w->blocks.shaken != 0) shake(&p);
  }
  return FROT_OK;
}

int frot_solve_blocks(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                      const double *v, const double *d) {
  return w->blocks.unwanted ? FROT_OK : solve(m, s, w, t, q, v, d, 0);
}

int frot_solve_late(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, const double *d) {
  return solve(m, s, w, t, q, v, d, 1);
}
