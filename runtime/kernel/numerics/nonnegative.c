#include "numerics/nonnegative.h"

#include <math.h>
#include <string.h>

#include "numerics/basis.h"
#include "numerics/tolerances.h"

#define PASSES 10 /* for each column, and as many more at least */

int frot_nonnegative_doubles(int rows, int columns) {
  return rows * columns + rows + 2 * columns + rows + 4 * columns + columns * columns + 8;
}
int frot_nonnegative_integers(int columns) { return 3 * columns; }

typedef struct {
  const double *e, *f;
  int rows, columns, n;
  int *used, *banned, *pivot; /* columns in use, n of them; those that may not be taken now */
  double *copy, *right, *x, *slope, *work;
} problem;

/* p->x <- the least squares of the columns in use. */
static void solve(const problem *p) {
  size_t size = sizeof(double) * (size_t)p->rows;
  for (int k = 0; k < p->n; k++) memcpy(p->copy + k * p->rows, p->e + p->used[k] * p->rows, size);
  memcpy(p->right, p->f, size);
  frot_least_norm(p->copy, p->right, p->rows, p->n, FROT_NO_COLUMN, p->x, p->work, p->pivot);
}

static void find_rest(const problem *p, const double *u, double *rest) {
  memcpy(rest, p->f, sizeof(double) * (size_t)p->rows);
  for (int k = 0; k < p->n; k++) {
    const double *column = p->e + p->used[k] * p->rows;
    for (int i = 0; i < p->rows; i++) rest[i] -= u[p->used[k]] * column[i];
  }
}

/* The unknown at zero along which the sum falls most, or -1. */
static int steepest(const problem *p, const double *u, const double *rest, double length) {
  int best = -1;
  double most = 0;
  for (int j = 0; j < p->columns; j++) {
    const double *column = p->e + j * p->rows;
    if (u[j] > 0 || p->banned[j]) continue;
    double own = frot_length(column, p->rows), slope = frot_dot(column, rest, p->rows);
    if (!(own > 0) || slope <= FROT_FLAT_SLOPE * own * length || slope / own <= most) continue;
    int in_use = 0;
    for (int k = 0; k < p->n; k++) in_use |= p->used[k] == j;
    if (!in_use) best = j, most = slope / own;
  }
  return best;
}

static void drop(problem *p, double *u, int k) {
  u[p->used[k]] = 0;
  p->used[k] = p->used[--p->n];
}

/* Go to the least squares of the columns in use as far as no unknown turns negative; those that
 * come to zero are dropped, until none does. */
static void go(problem *p, double *u) {
  while (p->n > 0) {
    double part = 1;
    int first = -1;
    solve(p);
    for (int k = 0; k < p->n; k++) {
      double old = u[p->used[k]];
      if (p->x[k] > 0) continue;
      double own = old > 0 ? old / (old - p->x[k]) : 0;
      if (first < 0 || own < part) part = own, first = k;
    }
    if (first < 0) {
      for (int k = 0; k < p->n; k++) u[p->used[k]] = p->x[k];
      return;
    }
    for (int k = 0; k < p->n; k++) u[p->used[k]] += part * (p->x[k] - u[p->used[k]]);
    u[p->used[first]] = 0;
    for (int k = p->n - 1; k >= 0; k--)
      if (!(u[p->used[k]] > 0)) drop(p, u, k);
  }
}

int frot_nonnegative(const double *e, const double *f, int rows, int columns, double *u,
                     double *rest, double *doubles, int *integers) {
  problem p = {.e = e, .f = f, .rows = rows, .columns = columns};
  p.copy = doubles, p.right = p.copy + rows * columns, p.x = p.right + rows;
  p.slope = p.x + columns, p.work = p.slope + columns;
  p.used = integers, p.banned = integers + columns, p.pivot = integers + 2 * columns;
  double length = frot_length(f, rows);
  memset(u, 0, sizeof(double) * (size_t)columns);
  memset(p.banned, 0, sizeof(int) * (size_t)columns);
  memcpy(rest, f, sizeof(double) * (size_t)rows);
  for (int pass = 0; pass < PASSES * (columns + 1); pass++) {
    int j = steepest(&p, u, rest, length);
    if (j < 0) return 0;
    p.used[p.n++] = j;
    solve(&p);
    if (!(p.x[p.n - 1] > 0)) { /* rounding made its slope */
      p.n--, p.banned[j] = 1;
      continue;
    }
    go(&p, u);
    find_rest(&p, u, rest);
    memset(p.banned, 0, sizeof(int) * (size_t)columns);
  }
  return 1;
}
