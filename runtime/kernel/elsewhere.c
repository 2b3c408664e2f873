#include "elsewhere.h"

#include <math.h>
#include <string.h>

#include "changes.h"
#include "closest.h"
#include "core.h"
#include "nearest.h"
#include "tolerances.h"

#define TRIES 8 /* beginnings of the search beside the given one, each to both hands */
#define WHOLE_TURN 6.3

void frot_begin_elsewhere(frot_opening *p, int k, int alike) {
  const frot_model *m = p->m;
  double least = INFINITY, *changes = p->w->opening.scratch;
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
    changes[i] = (k % 2 ? -1 : 1) * 3 * (0.1 + 0.9 * part) * unit;
  }
  p->basis = p->w->opening.begin;
  frot_from_changes(p, changes, p->q);
  for (int i = 0; i < m->nq; i++) p->q[i] += p->w->opening.begin[i];
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
  int found = frot_solve_nearest(p);
  if (found == FROT_OK && memcmp(w->opening.begin, p->q, bytes) == 0) return found;
  if (found != FROT_OK && (found != FROT_INITIAL || !p->wide)) return found;
  int status = frot_note_beginning(p);
  if (status != FROT_OK) return frot_no_number(p, status);
  if (found == FROT_OK) {
    if (!went_far(p)) return frot_come_closest(p);
    best = 0.5 * frot_change_size(p);
    memcpy(w->opening.nearest, p->q, bytes);
  }
  for (int k = 0; k < 4 * TRIES; k++) {
    frot_clear_opening(p);
    frot_begin_elsewhere(p, k % (2 * TRIES), k >= 2 * TRIES);
    if (frot_solve_nearest(p) != FROT_OK || frot_come_closest(p) != FROT_OK) continue;
    double far = frot_change_size(p);
    if (far < (1 - FROT_NEARER) * best) best = far, memcpy(w->opening.nearest, p->q, bytes);
  }
  frot_clear_opening(p);
  memcpy(p->q, isfinite(best) ? w->opening.nearest : w->opening.begin, bytes);
  return frot_solve_nearest(p);
}
