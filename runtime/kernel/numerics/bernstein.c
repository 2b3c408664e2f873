#include "numerics/bernstein.h"

#include <math.h>
#include <string.h>

#define N 7
#define DEEPEST 40

double frot_bernstein(const double g[7], double theta) {
  double b[N];
  memcpy(b, g, sizeof b);
  for (int level = 1; level < N; level++)
    for (int i = 0; i < N - level; i++) b[i] = (1 - theta) * b[i] + theta * b[i + 1];
  return b[0];
}

/* Halve (de Casteljau): `b` becomes the left half, `right` the right one. */
static void halve(double b[N], double right[N]) {
  double left[N], x[N];
  memcpy(x, b, sizeof x);
  for (int level = 0; level < N; level++) {
    left[level] = x[0];
    right[N - 1 - level] = x[N - 1 - level];
    for (int i = 0; i < N - 1 - level; i++) x[i] = 0.5 * (x[i] + x[i + 1]);
  }
  memcpy(b, left, sizeof left);
}

/* The polynomial is positive at lo, below -floor at hi and crosses once: bisect on its values. */
static double bisect(const double g[7], double lo, double hi) {
  for (int i = 0; i < 60 && hi - lo > 1e-16; i++) {
    double mid = 0.5 * (lo + hi);
    if (frot_bernstein(g, mid) > 0)
      lo = mid;
    else
      hi = mid;
  }
  return 0.5 * (lo + hi);
}

double frot_first_fall(const double g[7], double floor) {
  double stack[DEEPEST + 2][N], low[DEEPEST + 2], width[DEEPEST + 2];
  int top = 0;
  memcpy(stack[0], g, sizeof stack[0]);
  low[0] = 0, width[0] = 1;
  while (top >= 0) {
    double *b = stack[top], least = b[0];
    for (int i = 1; i < N; i++) least = fmin(least, b[i]);
    if (least >= -floor) {
      top--;
      continue;
    }
    if (b[0] < -floor) return low[top] == 0 ? 0 : bisect(g, 0, low[top]);
    int changes = 0;
    for (int i = 1; i < N; i++) changes += (b[i] > 0) != (b[i - 1] > 0);
    if (changes == 1 && b[0] > 0 && b[N - 1] < -floor)
      return bisect(g, low[top], low[top] + width[top]);
    if (width[top] < 1e-9) {
      if (b[N - 1] < -floor) return low[top];
      top--;
      continue;
    }
    double right[N];
    halve(b, right);
    /* the left half is looked at first: it goes on top */
    double half = 0.5 * width[top], at = low[top];
    memcpy(stack[top + 1], b, sizeof right);
    memcpy(stack[top], right, sizeof right);
    low[top] = at + half, width[top] = half;
    low[top + 1] = at, width[top + 1] = half;
    top++;
  }
  return FROT_NO_ROOT;
}

void frot_weigh_values(const double *at, int n, double t, double *weight) {
  for (int i = 0; i < n; i++) {
    double above = 1, below = 1;
    for (int j = 0; j < n; j++)
      if (j != i) above *= t - at[j], below *= at[i] - at[j];
    weight[i] = above / below;
  }
}
