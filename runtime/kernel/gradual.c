#include "gradual.h"

#include <math.h>
#include <string.h>

#include "damped.h"
#include "nearest.h"

#define TURN 0.25

/* The angle that equation i alone speaks of, -1 if none. */
static int only_angle(const frot_opening *p, int i) {
  int only = frot_only_unknown(p, i);
  int speed = only < 0 ? -1 : frot_speed_behind(p, only);
  return speed >= 0 && frot_angle_of(p->m, speed) == only ? only : -1;
}

int frot_solve_gradually(frot_opening *p) {
  double largest = 0;
  size_t bytes = sizeof(double) * (size_t)p->m->nq;
  if (frot_evaluate_statements(p) != FROT_OK) return FROT_INITIAL;
  for (int i = 0; i < p->n; i++) {
    int k = only_angle(p, i);
    if (k >= 0) largest = fmax(largest, fabs(p->q[k])), p->q[k] = 0;
  }
  if (largest == 0 || frot_evaluate_statements(p) != FROT_OK) return FROT_INITIAL;
  memcpy(p->w->opening.left, p->w->relations.residual, sizeof(double) * (size_t)p->n);
  double *last = p->w->opening.next_way, least = fmin(TURN / largest, 1), part = least, left = 1;
  int status = FROT_OK;
  while (left > 0) {
    memcpy(last, p->q, bytes);
    p->left = fmax(left - part, 0);
    status = frot_solve_nearest(p);
    if (status != FROT_OK) {
      frot_clear_opening(p);
      memcpy(p->q, last, bytes);
      if (frot_follow_damped(p)) status = frot_solve_nearest(p);
    }
    if (status == FROT_OK)
      left = p->left, part = least;
    else if (part >= left)
      break;
    else
      part *= 2, memcpy(p->q, last, bytes), frot_clear_opening(p);
  }
  p->left = 0;
  return status;
}
