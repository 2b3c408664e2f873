#include "motions/permanent_rows.h"

#include <math.h>
#include <string.h>

#include "numerics/basis.h"
#include "numerics/tolerances.h"

/* Part of a row that the permanent rows leave below which nothing can move it. */
#define LOCKED 1e-11

static int is_permanent(const frot_contact_instant *one, int row) {
  for (int k = 0; k < one->problem.n_permanent; k++)
    if (one->permanent[k] == row) return 1;
  return 0;
}

/* The permanent row, not taken yet, of which the basis leaves the largest part, or -1. */
static int longest(const frot_contact_instant *one, const unsigned char *taken, double *part) {
  const frot_motion_problem *p = &one->problem;
  int best = -1;
  *part = 0;
  for (int k = 0; k < p->n_permanent; k++) {
    int row = one->permanent[k], width = p->width;
    double whole = frot_length(one->rows + row * width, width);
    double rest = frot_length(one->turned + row * width, width);
    if (taken[row] || !(whole > 0) || rest / whole <= *part) continue;
    best = row, *part = rest / whole;
  }
  return best;
}

/* Take the basis row `at`, number k of it, out of a row. */
static void take_out(frot_contact_instant *one, int row, int at, int k) {
  int width = one->problem.width;
  double *own = one->turned + row * width;
  const double *unit = one->turned + at * width;
  for (int pass = 0; pass < 2; pass++) {
    double part = frot_dot(own, unit, width);
    for (int j = 0; j < width; j++) own[j] -= part * unit[j];
    one->parts[row * one->problem.n_permanent + k] += part;
  }
}

void frot_turn_permanent_rows(frot_contact_instant *one) {
  const frot_motion_problem *p = &one->problem;
  int width = p->width;
  unsigned char *taken = one->taken;
  memcpy(one->turned, one->rows, sizeof(double) * (size_t)(p->n * width));
  memset(one->parts, 0, sizeof(double) * (size_t)(p->n * p->n_permanent));
  memset(taken, 0, (size_t)p->n);
  one->rank = 0;
  double part;
  for (int row; (row = longest(one, taken, &part)) >= 0 && part > FROT_DEPENDENT;) {
    double *own = one->turned + row * width, length = frot_length(own, width);
    for (int j = 0; j < width; j++) own[j] /= length;
    taken[row] = 1, one->length[one->rank] = length, one->basis_row[one->rank] = row;
    for (int i = 0; i < p->n; i++)
      if (!taken[i]) take_out(one, i, row, one->rank);
    one->rank++;
  }
  for (int i = 0; i < p->n; i++) { /* what depends on the basis says nothing */
    double whole = frot_length(one->rows + i * width, width);
    double *own = one->turned + i * width, rest = frot_length(own, width);
    int depends = is_permanent(one, i) || rest <= LOCKED * whole;
    if (!taken[i] && depends) memset(own, 0, sizeof(double) * (size_t)width);
  }
}

void frot_turn_biases(const frot_contact_instant *one, const double *c, double *turned,
                      double *size) {
  const frot_motion_problem *p = &one->problem;
  for (int k = 0; k < one->rank; k++) {
    int row = one->basis_row[k];
    double sum = c[row], terms = fabs(sum);
    for (int j = 0; j < k; j++) {
      double part = one->parts[row * p->n_permanent + j];
      sum -= part * turned[one->basis_row[j]];
      terms += fabs(part) * size[one->basis_row[j]];
    }
    turned[row] = sum / one->length[k], size[row] = terms / one->length[k];
  }
  for (int i = 0; i < p->n; i++) {
    if (one->taken[i]) continue;
    if (is_permanent(one, i)) {
      turned[i] = size[i] = 0;
      continue;
    }
    turned[i] = c[i], size[i] = fabs(c[i]);
    for (int k = 0; k < one->rank; k++) {
      double part = one->parts[i * p->n_permanent + k];
      turned[i] -= part * turned[one->basis_row[k]];
      size[i] += fabs(part) * size[one->basis_row[k]];
    }
  }
}
