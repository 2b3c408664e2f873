#include "starts/homotopy.h"

#include <math.h>
#include <string.h>

#include "assembly/levenberg_marquardt.h"
#include "assembly/gauss_newton.h"
#include "assembly/start_parts.h"

#define TURN 0.25

/* The angle that equation i alone speaks of, -1 if none. */
static int only_angle(const frot_opening *p, int i) {
  int only = frot_only_unknown(p, i);
  return only >= 0 && frot_is_angle(p, only) ? only : -1;
}

int frot_solve_by_homotopy(frot_opening *p) {
  double largest = 0;
  size_t bytes = sizeof(double) * (size_t)p->n_own;
  if (frot_evaluate_statements(p) != FROT_OK) return FROT_INITIAL;
  for (int i = 0; i < p->n; i++) {
    int k = only_angle(p, i);
    if (k >= 0) largest = fmax(largest, fabs(p->x[k])), p->x[k] = 0;
  }
  if (largest == 0 || frot_evaluate_statements(p) != FROT_OK) return FROT_INITIAL;
  memcpy(p->w->opening.left, p->w->relations.residual, sizeof(double) * (size_t)p->n);
  double *last = p->w->opening.next_way, least = fmin(TURN / largest, 1), part = least, left = 1;
  int status = FROT_OK;
  while (left > 0) {
    memcpy(last, p->x, bytes);
    p->left = fmax(left - part, 0);
    status = frot_solve_nearest(p);
    if (status != FROT_OK) {
      frot_clear_opening(p);
      memcpy(p->x, last, bytes);
      if (frot_follow_damped(p)) status = frot_solve_nearest(p);
    }
    if (status == FROT_OK)
      left = p->left, part = least;
    else if (part >= left)
      break;
    else
      part *= 2, memcpy(p->x, last, bytes), frot_clear_opening(p);
  }
  p->left = 0;
  return status;
}
