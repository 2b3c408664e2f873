#include "evaluation/slip_frames.h"
#include "evaluation/algebraic_loops.h"

#include "model/calls.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "numerics/dense.h"
#include "numerics/basis.h"
#include "numerics/tolerances.h"

#define PASSES 250
/* Parts by which a step along Newton's path may leave it, and which it has at least. */
#define LEAVES 0.25
#define LEAST_ON_PATH 1e-4
/* Places between two solutions where it is asked whether they belong together; parts of the way
 * that differ by the golden section repeat with no period. */
#define PLACES 8
#define GOLDEN 0.6180339887498949

/* A search that goes so many times as far as its values are large begins where these tell nothing.
 * It is begun anew that far beside them, in parts of 1 in SI, the first and by how much the others
 * are larger. */
#define NOWHERE 1e6
#define BESIDE 1e-16
#define FARTHER 1e4
#define TIMES 6

/* A block at given arguments; `along`: the search follows Newton's path; `switching`: conditions on
 * the unknowns are as these are. */
typedef struct {
  frot_work *w;
  const frot_block *block;
  double *y;
  int along, switching;
} problem;

/* Residual, its Jacobian and sizes at p->y. Returns 0, or 1 for no number. */
static int evaluate(const problem *p) {
  frot_work *w = p->w;
  int n = p->block->count;
  w->call.res[0] = w->blocks.r, w->call.res[1] = w->blocks.j, w->call.res[2] = w->blocks.size;
  frot_call(w, p->switching ? &p->block->switching : &p->block->residual);
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

/* Whether the residuals, or the steps by the same Jacobian, are nearly those that its equations
 * linearized foretell for this part of the step. Newton's path, along which all residuals fall in
 * one ratio, passes no place where the Jacobian is singular (P. Deuflhard, 2004, sect. 3.1): it
 * leads to the solution that belongs to where the search began, or to an end. */
static int keeps_path(const problem *p, double before, double part) {
  frot_work *w = p->w;
  int n = p->block->count;
  const double *size = w->blocks.size + n, *from = w->blocks.step + n, *r = w->blocks.r;
  double *next = w->blocks.scale + 2 * n, off = 0, longest = 0;
  for (int i = 0; i < n; i++) next[i] = r[i] - (1 - part) * r[n + i];
  if (worst(next, size, n) <= LEAVES * part * before) return 1;
  frot_lu_apply(w->blocks.lu, n, w->blocks.pivot, w->blocks.scale, next);
  for (int i = 0; i < n; i++) {
    double own = fabs(from[i]) + fabs(w->blocks.step[i]);
    if (own == 0 && next[i] != 0) return 0;
    if (own == 0) continue;
    longest = fmax(longest, fabs(w->blocks.step[i]) / own);
    off = fmax(off, fabs(next[i]) / own);
  }
  return off <= LEAVES * part * longest;
}

/* Whether the values p->y, a part of the step on, are taken. `singular`: there are no factors. */
static int is_better(const problem *p, double before, double part, int singular) {
  int n = p->block->count;
  if (p->along && before > FROT_SETTLED) return keeps_path(p, before, part);
  return worst(p->w->blocks.r, p->w->blocks.size + n, n) < before * (1 - 0.25 * part) ||
         (!singular && shortens(p, p->w->blocks.step + n, part));
}

/* Take the largest part of the step, of `longest` or halves of it, that leads to better values.
 * Returns it, or 0 when none does; the values are then those before. */
static double line_search(const problem *p, double before, double longest, int singular) {
  frot_work *w = p->w;
  int n = p->block->count;
  size_t bytes = sizeof(double) * (size_t)n;
  double *from = w->blocks.step + n, least = p->along ? LEAST_ON_PATH : FROT_LEAST_DAMPING;
  memcpy(w->blocks.size + n, w->blocks.size, bytes), memcpy(w->blocks.r + n, w->blocks.r, bytes);
  memcpy(from, p->y, bytes);
  for (double part = longest; part > least; part *= 0.5) {
    for (int i = 0; i < n; i++) p->y[i] = from[i] + part * w->blocks.step[i];
    if (!evaluate(p) && is_better(p, before, part, singular)) return part;
    if (before <= FROT_SETTLED) break;
  }
  memcpy(p->y, from, bytes);
  return 0;
}

/* Whether a whole step was rounding beside where the search began: of what comes to zero by a root
 * that is no simple one, where all terms vanish with it. */
static int is_nothing(const problem *p) {
  int n = p->block->count;
  const double *step = p->w->blocks.step, *start = step + 2 * n;
  for (int i = 0; i < n; i++)
    if (!(fabs(step[i]) <= DBL_EPSILON * fmax(fabs(start[i]), fabs(p->y[i])))) return 0;
  return 1;
}

/* Zero for what is nothing, where that is the solution. */
static void come_to_zero(const problem *p) {
  frot_work *w = p->w;
  int n = p->block->count;
  double *from = w->blocks.step + n;
  const double *start = w->blocks.step + 2 * n;
  memcpy(from, p->y, sizeof(double) * (size_t)n);
  for (int i = 0; i < n; i++)
    if (fabs(p->y[i]) <= n * FROT_ROUNDING * fabs(start[i])) p->y[i] = 0;
  if (evaluate(p) || worst(w->blocks.r, w->blocks.size, n) > FROT_ROUNDING)
    memcpy(p->y, from, sizeof(double) * (size_t)n);
}

/* Newton's method from the values p->y. */
static int search(const problem *p) {
  frot_work *w = p->w;
  int n = p->block->count;
  if (evaluate(p)) return FROT_NAN;
  double part = 1;
  for (int pass = 0; pass < PASSES; pass++) {
    double off = worst(w->blocks.r, w->blocks.size, n);
    if (off <= FROT_ROUNDING) return FROT_OK;
    if (pass > 0 && part == 1 && is_nothing(p)) return come_to_zero(p), FROT_OK;
    int singular = newton_step(p);
    double longest = p->along ? fmin(1, 4 * part) : 1;
    part = p->along && singular ? 0 : line_search(p, off, longest, singular);
    if (part > 0) continue;
    if (off <= FROT_SETTLED) return FROT_OK;
    w->blocks.singular = singular;
    return FROT_ALGEBRAIC;
  }
  return FROT_ALGEBRAIC;
}

/* The sign of the Jacobian's determinant at the values p->y, 0 where it is none, -2 where they have
 * no numbers. */
static int side_of(const problem *p) {
  frot_work *w = p->w;
  int n = p->block->count, sign = 1;
  if (evaluate(p)) return -2;
  if (factor(p)) return 0;
  for (int k = 0; k < n; k++) {
    if (w->blocks.pivot[k] != k) sign = -sign;
    if (w->blocks.lu[k * n + k] < 0) sign = -sign;
  }
  return sign;
}

/* Whether the solution p->y belongs to where the search began: between them the Jacobian, which may
 * be singular at a place, does not turn its sign. */
static int belongs(const problem *p) {
  frot_work *w = p->w;
  int n = p->block->count, side = 0, same = 1;
  size_t bytes = sizeof(double) * (size_t)n;
  const double *start = w->blocks.step + 2 * n;
  double *found = w->blocks.step + n, part = 0;
  memcpy(found, p->y, bytes);
  for (int k = 0; k <= PLACES && same; k++, part = fmod(part + GOLDEN, 1)) {
    for (int i = 0; i < n; i++) p->y[i] = start[i] + part * (found[i] - start[i]);
    int here = side_of(p);
    same = here != -2 && here * side >= 0;
    if (here != 0) side = here;
  }
  memcpy(p->y, found, bytes);
  return same;
}

/* Whether nothing is to be told from where the search began: the Jacobian, singular there or next
 * to that, leads far away. */
static int begins_nowhere(const problem *p) {
  frot_work *w = p->w;
  int n = p->block->count;
  const double *start = w->blocks.step + 2 * n;
  memcpy(p->y, start, sizeof(double) * (size_t)n);
  if (evaluate(p)) return 0;
  if (newton_step(p)) return 1;
  for (int i = 0; i < n; i++)
    if (fabs(w->blocks.step[i]) > NOWHERE * fabs(start[i])) return 1;
  return 0;
}

/* A solution from the values p->y. Inside a step it must belong to the last one: others are reached
 * at events, and never by a longer step. */
static int find(const problem *p) {
  int status = search(p);
  if (status != FROT_OK || p->along || !p->w->blocks.within || belongs(p)) return status;
  p->w->blocks.singular = 0;
  return FROT_ALGEBRAIC;
}

/* The same from places around them. */
static int find_beside(const problem *p) {
  int n = p->block->count, status = FROT_ALGEBRAIC;
  const double *start = p->w->blocks.step + 2 * n;
  double far = BESIDE;
  for (int k = 0; k < 2 * TIMES && status != FROT_OK; k++) {
    double way = k % 2 ? -far : far, share = 1;
    for (int i = 0; i < n; i++, share = fmod(share + GOLDEN, 1))
      p->y[i] = start[i] + way * (share + GOLDEN);
    status = find(p);
    if (k % 2) far *= FARTHER;
  }
  return status;
}

/* Whether the values p->y are on the sides of the block's own conditions that d says. */
static int are_sides(const problem *p) {
  frot_work *w = p->w;
  int n = p->block->count, same = 1;
  problem own = *p;
  own.switching = 0;
  if (p->block->switching.call == NULL || evaluate(&own)) return 1;
  memcpy(w->blocks.r + n, w->blocks.r, sizeof(double) * (size_t)n);
  own.switching = 1;
  if (evaluate(&own)) return 0;
  for (int i = 0; i < n; i++)
    same &= fabs(w->blocks.r[i] - w->blocks.r[n + i]) <= FROT_SETTLED * w->blocks.size[i];
  return same;
}

/* From the values p->y along Newton's path; where that ends, anywhere. A solution with conditions
 * as d says that these contradict is where the motion would go on to in a step from their sides;
 * elsewhere one that they do not contradict comes before it. */
static int solve_nonlinear(const problem *p) {
  frot_work *w = p->w;
  int n = p->block->count, switches = p->block->switching.call != NULL;
  int first = FROT_OK, beyond = 0, goes_on = w->blocks.within && are_sides(p);
  size_t bytes = sizeof(double) * (size_t)n;
  double *start = w->blocks.step + 2 * n, *kept = start + n;
  memcpy(start, p->y, bytes);
  if (p->block->followed) return search(p);
  for (int k = 0; k < 4; k++) {
    problem own = *p;
    own.along = k < 2, own.switching = k % 2;
    if (own.switching && !switches) continue;
    memcpy(p->y, start, bytes);
    int status = find(&own);
    if (status == FROT_OK && (own.switching || (k == 0 && goes_on) || are_sides(p))) return status;
    if (status == FROT_OK && !beyond) beyond = 1, memcpy(kept, p->y, bytes);
    if (status != FROT_OK && first == FROT_OK) first = status;
  }
  problem own = *p;
  own.switching = switches;
  if (begins_nowhere(&own) && find_beside(&own) == FROT_OK) return FROT_OK;
  if (beyond) memcpy(p->y, kept, bytes);
  return beyond ? FROT_OK : first;
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
    problem p = {w, block, w->blocks.y + block->first, 0, 0};
    frot_inputs(s, w, &t, q, v, d);
    w->call.arg[7] = w->core.a, w->call.arg[8] = frot_lam_of_text(m, w);
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
