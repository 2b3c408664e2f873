#include "contact/contact_newton.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "numerics/basis.h"
#include "numerics/dense.h"

#define STEPS 60
#define HALVINGS 12
#define POLISH 3 /* steps once the tolerance is met, while they miss less */
/* Part of the longest column below which one of Newton's matrix is none. */
#define RANK 1e-12
/* Part of what is missed that a step must take away. */
#define ENOUGH 1e-3

int frot_contact_newton_doubles(int rows) { return 2 * rows * rows + 12 * rows; }
int frot_contact_newton_integers(int rows) { return rows; }

typedef struct {
  const frot_contact_equations *p;
  double *r; /* of each row: the weight of a in x - r a */
} natural_map;

/* Reactions in the j-th of the lengths that bound a block, 0 beyond the last. */
static int count_in_norm(const frot_contact_block *k, int j) {
  if (j >= (int)(sizeof k->norm / sizeof *k->norm)) return 0;
  return j == 0 && k->norm[0] == 0 ? k->n_bounding : k->norm[j];
}

double frot_contact_bound(const frot_contact_block *k, const double *x) {
  if (!k->n_bounding) return k->ratio;
  double sum = 0;
  for (int j = 0, at = k->bounding, n; (n = count_in_norm(k, j)) > 0; j++, at += n)
    sum += frot_length(x + at, n);
  return k->ratio * sum;
}

/* The radius of a ball that a normal bounds is zero where that pulls. */
static double radius_of(const frot_contact_equations *p, const frot_contact_block *k,
                        const double *x) {
  if (k->n_bounding != 1) return frot_contact_bound(k, x);
  for (int i = 0; i < p->n_blocks; i++)
    if (p->blocks[i].rule == FROT_ROW_PRESSES && p->blocks[i].at == k->bounding)
      return k->ratio * fmax(x[k->bounding], 0);
  return frot_contact_bound(k, x);
}

static void accelerate(const frot_contact_equations *p, const double *x, double *a) {
  for (int i = 0; i < p->rows; i++) a[i] = p->b[i] + frot_dot(p->w + i * p->rows, x, p->rows);
}

/* What is missed in each row: x - P(x - r a), or what the rule asks. */
static void miss(const natural_map *f, const double *x, const double *a, double *missed) {
  for (int k = 0; k < f->p->n_blocks; k++) {
    const frot_contact_block *one = &f->p->blocks[k];
    int at = one->at;
    double y[3], bound, size;
    switch (one->rule) {
      case FROT_ROW_ABSENT:
        for (int i = at; i < at + one->n; i++) missed[i] = x[i];
        break;
      case FROT_ROW_HELD:
        for (int i = at; i < at + one->n; i++) missed[i] = f->r[i] * a[i];
        break;
      case FROT_ROW_READS:
        missed[at] = x[at] - a[at];
        break;
      case FROT_ROW_PRESSES:
        missed[at] = x[at] - fmax(0, x[at] - f->r[at] * a[at]);
        break;
      case FROT_ROW_SLIDES:
        bound = frot_contact_bound(one, x);
        for (int i = 0; i < one->n; i++) missed[at + i] = x[at + i] + bound * one->d[i];
        break;
      default:
        for (int i = 0; i < one->n; i++) y[i] = x[at + i] - f->r[at] * a[at + i];
        bound = radius_of(f->p, one, x), size = frot_length(y, one->n);
        for (int i = 0; i < one->n; i++)
          missed[at + i] = x[at + i] - (size > bound ? bound / size * y[i] : y[i]);
    }
  }
}

/* The largest part of its size by which an equation is missed. */
static double worst_of(const natural_map *f, const double *x, const double *missed) {
  const frot_contact_equations *p = f->p;
  double worst = 0, longest = frot_length(x, p->rows);
  for (int i = 0; i < p->rows; i++) {
    const double *row = p->w + i * p->rows;
    double size = fabs(x[i]) + longest * DBL_EPSILON;
    double terms = (p->terms ? p->terms[i] : fabs(p->b[i])) + frot_length(row, p->rows) * longest;
    size += f->r[i] * terms;
    double part = size > 0 ? fabs(missed[i]) / size : 0;
    if (!(part <= worst)) worst = part;
  }
  return worst;
}

/* Row `at + i` of Newton's matrix gets factor times the derivative of the bound of a block. */
static void add_bound(const frot_contact_equations *p, const frot_contact_block *k, const double *x,
                      double factor, double *row_entry) {
  for (int j = 0, at = k->bounding, n; (n = count_in_norm(k, j)) > 0; j++, at += n) {
    double size = frot_length(x + at, n);
    for (int i = at; i < at + n && size > 0; i++)
      row_entry[i * p->rows] += factor * k->ratio * x[i] / size;
  }
}

/* matrix (by columns) <- the derivative of what is missed. */
static void differentiate(const natural_map *f, const double *x, const double *a, double *matrix) {
  const frot_contact_equations *p = f->p;
  int n = p->rows;
  memset(matrix, 0, sizeof(double) * (size_t)(n * n));
  for (int k = 0; k < p->n_blocks; k++) {
    const frot_contact_block *one = &p->blocks[k];
    int at = one->at;
    double y[3], size, radius;
    for (int i = at; i < at + one->n; i++) {
      const double *w = p->w + i * n;
      double *entry = matrix + i;
      switch (one->rule) {
        case FROT_ROW_ABSENT:
          entry[i * n] = 1;
          continue;
        case FROT_ROW_HELD:
          for (int j = 0; j < n; j++) entry[j * n] = f->r[i] * w[j];
          continue;
        case FROT_ROW_READS:
          for (int j = 0; j < n; j++) entry[j * n] = (i == j) - w[j];
          continue;
        case FROT_ROW_PRESSES:
          if (x[i] - f->r[i] * a[i] > 0)
            for (int j = 0; j < n; j++) entry[j * n] = f->r[i] * w[j];
          else
            entry[i * n] = 1;
          continue;
        case FROT_ROW_SLIDES:
          entry[i * n] += 1;
          add_bound(p, one, x, one->d[i - at], entry);
          continue;
        default:
          break;
      }
      for (int c = 0; c < one->n; c++) y[c] = x[at + c] - f->r[at] * a[at + c];
      size = frot_length(y, one->n), radius = radius_of(p, one, x);
      if (size <= radius) {
        for (int j = 0; j < n; j++) entry[j * n] = f->r[at] * w[j];
        continue;
      }
      /* x - radius y/|y| */
      entry[i * n] += 1;
      double unit = y[i - at] / size;
      if (radius > 0) add_bound(p, one, x, -unit, entry);
      for (int c = 0; c < one->n; c++) {
        double turn = radius / size * ((c == i - at) - unit * y[c] / size);
        entry[(at + c) * n] -= turn;
        const double *other = p->w + (at + c) * n;
        for (int j = 0; j < n; j++) entry[j * n] += turn * f->r[at] * other[j];
      }
    }
  }
}

/* Weights of accelerations: one over the largest entry of a block's own part of W. */
static void weigh(const natural_map *f) {
  const frot_contact_equations *p = f->p;
  for (int k = 0; k < p->n_blocks; k++) {
    const frot_contact_block *one = &p->blocks[k];
    double most = 0;
    for (int i = one->at; i < one->at + one->n; i++) {
      double sum = 0;
      for (int j = one->at; j < one->at + one->n; j++) sum += fabs(p->w[i * p->rows + j]);
      most = fmax(most, sum);
    }
    for (int i = one->at; i < one->at + one->n; i++) f->r[i] = most > 0 ? 1 / most : 1;
  }
}

/* Projected sweeps, block after block; readings follow. */
static void sweep(const natural_map *f, double *x, double *a) {
  const frot_contact_equations *p = f->p;
  for (int k = 0; k < p->n_blocks; k++) {
    const frot_contact_block *one = &p->blocks[k];
    for (int i = 0; i < one->n; i++) {
      int row = one->at + i;
      a[row] = p->b[row] + frot_dot(p->w + row * p->rows, x, p->rows);
    }
    double own[3] = {0};
    double radius = one->rule == FROT_ROW_BALL ? radius_of(p, one, x) : 0;
    for (int i = 0; i < one->n; i++) own[i] = x[one->at + i] - f->r[one->at] * a[one->at + i];
    double size = frot_length(own, one->n);
    for (int i = 0; i < one->n; i++) {
      int row = one->at + i;
      switch (one->rule) {
        case FROT_ROW_ABSENT:
          x[row] = 0;
          break;
        case FROT_ROW_HELD:
          x[row] = own[i];
          break;
        case FROT_ROW_READS:
          x[row] = a[row];
          break;
        case FROT_ROW_PRESSES:
          x[row] = fmax(0, own[i]);
          break;
        case FROT_ROW_SLIDES:
          x[row] = -frot_contact_bound(one, x) * one->d[i];
          break;
        default:
          x[row] = size > radius ? radius / size * own[i] : own[i];
      }
    }
  }
}

int frot_contact_newton(const frot_contact_equations *p, int sweeps, double *x, double *a,
                        double *doubles, int *integers) {
  int n = p->rows;
  natural_map f = {p, doubles};
  double *missed = doubles + 2 * n, *step = missed + n, *next = step + n, *next_a = next + n,
         *next_missed = next_a + n, *work = next_missed + n, *matrix = work + 5 * n + n * n;
  weigh(&f);
  for (int k = 0; k < sweeps; k++) sweep(&f, x, a);
  accelerate(p, x, a), miss(&f, x, a, missed);
  double worst = worst_of(&f, x, missed), sum = frot_length(missed, n);
  for (int k = 0, more = 0; k < STEPS && more < POLISH && worst > 0; k++) {
    if (worst <= p->tolerance) more++;
    differentiate(&f, x, a, matrix);
    memcpy(next, missed, sizeof(double) * (size_t)n);
    frot_least_norm(matrix, next, n, n, RANK, step, work, integers);
    double length = 1, next_sum = 0;
    for (int half = 0; half <= HALVINGS; half++, length *= 0.5) {
      for (int i = 0; i < n; i++) next[i] = x[i] - length * step[i];
      accelerate(p, next, next_a), miss(&f, next, next_a, next_missed);
      next_sum = frot_length(next_missed, n);
      if (next_sum <= (1 - ENOUGH * length) * sum) break;
    }
    if (!(next_sum < sum) && more) break; /* rounding */
    if (!(next_sum < sum)) {              /* one more try a whole step on: the map has corners */
      for (int i = 0; i < n; i++) next[i] = x[i] - step[i];
      accelerate(p, next, next_a), miss(&f, next, next_a, next_missed);
      next_sum = frot_length(next_missed, n);
      if (!isfinite(next_sum)) return 1;
    }
    memcpy(x, next, sizeof(double) * (size_t)n), memcpy(a, next_a, sizeof(double) * (size_t)n);
    memcpy(missed, next_missed, sizeof(double) * (size_t)n);
    sum = next_sum, worst = worst_of(&f, x, missed);
  }
  return !(worst <= p->tolerance);
}
