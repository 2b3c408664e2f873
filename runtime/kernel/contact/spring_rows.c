#include "contact/spring_rows.h"

#include <math.h>
#include <string.h>

#include "numerics/dense.h"

/* Part of a combination below which a row is none of it. */
#define NOT_OF_IT 1e-9

/* Kinds of rows: those that are vectors of the basis, and those that are not yet. */
enum { RIGID_TAKEN = -2, SPRING_TAKEN = -1, RIGID = 0, SPRING = 1, LAST = 2, TAKEN = 2 };

int frot_spring_rows_doubles(int n, int width) { return n * (n + width); }
int frot_spring_rows_integers(int n) { return 3 * n; }

void frot_begin_springs(frot_spring_rows *c, int n, int width, double *doubles, int *integers) {
  c->n = n, c->width = width;
  c->x = doubles, c->z = c->x + n * width;
  c->kind = integers, c->part = c->kind + n, c->slides = c->part + n;
}

void frot_add_spring_row(frot_spring_rows *c, int i, const double *row, int spring, int slides) {
  double length = frot_length(row, c->width), unit = length > 0 ? 1 / length : 0;
  for (int j = 0; j < c->width; j++) c->x[i * c->width + j] = unit * row[j];
  memset(c->z + i * c->n, 0, sizeof(double) * (size_t)c->n);
  c->z[i * c->n + i] = unit;
  c->kind[i] = spring ? SPRING : RIGID, c->part[i] = i, c->slides[i] = spring && slides;
}

int frot_is_spring(const frot_spring_rows *c, int i) {
  return c->kind[i] == SPRING || c->kind[i] == SPRING_TAKEN;
}

/* Make row i a vector of the basis and take it out of the others that are none. */
static void take(frot_spring_rows *c, int i, double length) {
  double *x = c->x + i * c->width, *z = c->z + i * c->n;
  for (int j = 0; j < c->width; j++) x[j] /= length;
  for (int j = 0; j < c->n; j++) z[j] /= length;
  c->kind[i] -= TAKEN;
  for (int k = 0; k < c->n; k++) {
    for (int pass = 0; pass < 2 && c->kind[k] >= 0; pass++) {
      double part = frot_dot(c->x + k * c->width, x, c->width);
      for (int j = 0; j < c->width; j++) c->x[k * c->width + j] -= part * x[j];
      for (int j = 0; j < c->n; j++) c->z[k * c->n + j] -= part * z[j];
    }
  }
}

/* Take rows of a kind, the longest remainder first, while it is longer than `least` and fewer than
 * `most` are taken. Returns how many are. */
static int take_longest(frot_spring_rows *c, int kind, double least, int most) {
  int taken = 0;
  for (; taken < most; taken++) {
    int best = -1;
    double longest = least;
    for (int i = 0; i < c->n; i++) {
      double length = c->kind[i] == kind ? frot_length(c->x + i * c->width, c->width) : 0;
      if (length > longest) longest = length, best = i;
    }
    if (best < 0) break;
    take(c, best, longest);
  }
  return taken;
}

/* The largest part of a spring in combination k. */
static double size_of(const frot_spring_rows *c, int k) {
  double largest = 0;
  for (int i = 0; i < c->n; i++)
    if (frot_is_spring(c, i)) largest = fmax(largest, fabs(c->z[k * c->n + i]));
  return largest;
}

static void connect(frot_spring_rows *c) {
  for (int k = 0; k < c->n; k++) {
    if (c->kind[k] != SPRING) continue;
    double least = NOT_OF_IT * size_of(c, k);
    for (int i = 0; i < c->n; i++) {
      int from = c->part[i], to = c->part[k];
      if (!frot_is_spring(c, i) || !(fabs(c->z[k * c->n + i]) > least)) continue;
      for (int j = 0; j < c->n; j++)
        if (c->part[j] == from) c->part[j] = to;
    }
  }
}

void frot_combine_springs(frot_spring_rows *c, double least, int rank, int last) {
  if (last >= 0) c->kind[last] = LAST;
  int rigid = take_longest(c, RIGID, least, c->n);
  take_longest(c, SPRING, rank < 0 ? least : 0, rank < 0 ? c->n : rank - rigid);
  if (last >= 0) c->kind[last] = SPRING;
  connect(c);
}

int frot_remains(const frot_spring_rows *c, int k) { return c->kind[k] == SPRING; }

int frot_is_compatible(const frot_spring_rows *c, int k) {
  if (c->kind[k] != SPRING) return 0;
  int springs = 0, slides = 0;
  for (int i = 0; i < c->n; i++) {
    if (c->part[i] != c->part[k] || !frot_is_spring(c, i)) continue;
    springs++, slides |= c->slides[i];
  }
  return springs > 1 && slides;
}
