#include "contact/contact_springs.h"

#include <math.h>
#include <string.h>

/* Give of springs in turn, as a part of the largest W. */
#define SOFT 0.3
#define STIFFER 0.1
#define RIGID 1e-8

int frot_contact_springs_doubles(int rows) {
  return rows * rows + 2 * rows + frot_contact_newton_doubles(rows);
}

double frot_soften(const frot_contact_equations *problem, double part, int all, double *w) {
  int n = problem->rows;
  double most = 0;
  memcpy(w, problem->w, sizeof(double) * (size_t)(n * n));
  for (int i = 0; i < n; i++) most = fmax(most, w[i * (n + 1)]);
  for (int k = 0; k < problem->n_blocks; k++) {
    const frot_contact_block *one = &problem->blocks[k];
    if (one->rule != FROT_ROW_PRESSES && !(all && one->rule == FROT_ROW_BALL)) continue;
    for (int i = one->at; i < one->at + one->n; i++) w[i * (n + 1)] += part * most;
  }
  return part * most;
}

int frot_contact_springs(const frot_contact_equations *problem, double *x, double *a,
                         double *doubles, int *integers) {
  int n = problem->rows, failed = 0;
  double *w = doubles, *b = w + n * n, *spring = b + n, *scratch = spring + n;
  frot_contact_equations soft = *problem;
  soft.w = w, soft.b = b, soft.tolerance = FROT_GIVE_TOLERANCE;
  memset(spring, 0, sizeof(double) * (size_t)n);
  for (double part = SOFT; part > RIGID && !failed; part *= STIFFER) {
    double give = frot_soften(problem, part, 0, w);
    for (int i = 0; i < n; i++) b[i] = problem->b[i] - give * spring[i];
    failed = frot_contact_newton(&soft, 0, x, a, scratch, integers);
    for (int k = 0; k < problem->n_blocks; k++) {
      int at = problem->blocks[k].at;
      if (problem->blocks[k].rule == FROT_ROW_PRESSES) spring[at] = x[at] - a[at] / give;
    }
  }
  return failed || frot_contact_newton(problem, 0, x, a, scratch, integers);
}
