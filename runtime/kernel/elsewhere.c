#include "elsewhere.h"

#include <math.h>
#include <string.h>

#include "core.h"
#include "nearest.h"
#include "tolerances.h"

#define TRIES 8  /* beginnings of the search beside the given one, each to both hands */
#define PULLS 10 /* towards the beginning */
#define WHOLE_TURN 6.3

/* Distance of the coordinates from w->opening.begin in the metric. */
static double distance(const frot_opening *p) {
  const double *begin = p->w->opening.begin;
  double sum = 0;
  for (int a = 0; a < p->m->nq; a++) {
    double change = p->q[a] - begin[a];
    if (!frot_is_attached(p, a)) {
      sum += change * change / (p->w->relations.unit[a] * p->w->relations.unit[a]);
      continue;
    }
    for (int b = 0; b < p->m->nq; b++)
      if (frot_is_attached(p, b))
        sum += change *
               frot_metric_entry(p->m, p->w, frot_speed_behind(p, a), frot_speed_behind(p, b)) *
               (p->q[b] - begin[b]);
  }
  return sqrt(fmax(sum, 0));
}

/* A beginning of the search away from w->opening.begin, the same in every run: turns of up to half
 * a revolution. `alike`: of lengths that move as much mass, else in SI. */
static void begin_elsewhere(const frot_opening *p, int k, int alike) {
  const frot_model *m = p->m;
  double least = INFINITY;
  for (int i = 0; i < m->nq; i++)
    if (frot_is_attached(p, i))
      least =
          fmin(least,
               sqrt(frot_metric_entry(m, p->w, frot_speed_behind(p, i), frot_speed_behind(p, i))));
  for (int i = 0; i < m->nq; i++) {
    double part = fmod((k / 2 + 1) * (0.3819660112501051 + 0.6180339887498949 * i), 1);
    double unit = p->w->relations.unit[i];
    if (frot_is_attached(p, i)) {
      double own =
          sqrt(frot_metric_entry(m, p->w, frot_speed_behind(p, i), frot_speed_behind(p, i)));
      unit = alike ? least / own : 1;
    }
    p->q[i] = p->w->opening.begin[i] + (k % 2 ? -1 : 1) * 3 * (0.1 + 0.9 * part) * unit;
  }
}

/* Go on from a place that is found to the nearest one to w->opening.begin, if that can be found. */
static int pull_back(frot_opening *p) {
  frot_work *w = p->w;
  double *found = w->step.z1, size;
  size_t bytes = sizeof(double) * (size_t)p->m->nq;
  memcpy(found, p->q, bytes);
  double before = distance(p);
  int status = FROT_OK;
  for (int k = 0; k < PULLS && status == FROT_OK; k++) {
    status = frot_opening_metric(p);
    if (status == FROT_OK) status = frot_evaluate_statements(p);
    if (status != FROT_OK) break;
    frot_least_change(p, w->opening.begin);
    frot_move_opening(p, w->relations.step, w->opening.begin, 1, p->q, &size);
  }
  if (status == FROT_OK && frot_solve_nearest(p) == FROT_OK && distance(p) <= before)
    return FROT_OK;
  memcpy(p->q, found, bytes);
  frot_clear_opening(p);
  return frot_solve_nearest(p);
}

/* Whether a coordinate came so far from w->opening.begin that, if it is an angle, it went round. */
static int went_far(const frot_opening *p) {
  for (int k = 0; k < p->m->nq; k++)
    if (fabs(p->q[k] - p->w->opening.begin[k]) > WHOLE_TURN) return 1;
  return 0;
}

int frot_solve_widely(frot_opening *p) {
  frot_work *w = p->w;
  size_t bytes = sizeof(double) * (size_t)p->m->nq;
  double best = INFINITY;
  memcpy(w->opening.begin, p->q, bytes);
  int status = frot_solve_nearest(p);
  if (status == FROT_OK) {
    if (!went_far(p)) return status;
    best = 0.5 * distance(p);
    memcpy(w->opening.nearest, p->q, bytes);
  } else if (status != FROT_INITIAL || !p->wide) {
    return status;
  }
  for (int k = 0; k < 4 * TRIES; k++) {
    frot_clear_opening(p);
    begin_elsewhere(p, k % (2 * TRIES), k >= 2 * TRIES);
    if (frot_solve_nearest(p) != FROT_OK || pull_back(p) != FROT_OK) continue;
    double far = distance(p);
    if (far < (1 - FROT_NEARER) * best) best = far, memcpy(w->opening.nearest, p->q, bytes);
  }
  frot_clear_opening(p);
  memcpy(p->q, isfinite(best) ? w->opening.nearest : w->opening.begin, bytes);
  return frot_solve_nearest(p);
}
