#include "elsewhere.h"

#include <math.h>
#include <string.h>

#include "changes.h"
#include "closest.h"
#include "core.h"
#include "damped.h"
#include "gradual.h"
#include "nearest.h"
#include "tolerances.h"

#define TRIES 8 /* beginnings of the search beside the given one, each to both hands */
#define WHOLE_TURN 6.3
/* From a beginning as near as this, in angles, the straight way leads to what is nearest. */
#define BEND 1.0

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

/* The most that an angle changed from w->opening.begin. */
static double most_turned(const frot_opening *p) {
  double most = 0;
  for (int j = 0; j < p->m->nv; j++) {
    int k = frot_angle_of(p->m, j);
    if (k >= 0) most = fmax(most, fabs(p->q[k] - p->w->opening.begin[k]));
  }
  return most;
}

typedef struct {
  double far, turned; /* the size of the change, and the most that an angle changed */
} nearest_found;

/* Keep the values as they are now where they are nearer to the beginning than the best so far. */
static void keep_nearer(frot_opening *p, nearest_found *best) {
  double far = frot_change_size(p);
  if (!(far < (1 - FROT_NEARER) * best->far)) return;
  best->far = far, best->turned = most_turned(p);
  memcpy(p->w->opening.nearest, p->q, sizeof(double) * (size_t)p->m->nq);
}

static void begin_again(const frot_opening *p) {
  frot_clear_opening(p);
  memcpy(p->q, p->w->opening.begin, sizeof(double) * (size_t)p->m->nq);
}

int frot_solve_widely(frot_opening *p) {
  frot_work *w = p->w;
  size_t bytes = sizeof(double) * (size_t)p->m->nq;
  nearest_found best = {INFINITY, INFINITY};
  memcpy(w->opening.begin, p->q, bytes);
  int found = frot_solve_nearest(p);
  if (found == FROT_OK && memcmp(w->opening.begin, p->q, bytes) == 0) return found;
  if (found != FROT_OK && (found != FROT_INITIAL || !p->wide)) return found;
  int status = frot_note_beginning(p);
  if (status != FROT_OK) return frot_no_number(p, status);
  if (found == FROT_OK) found = frot_come_closest(p);
  if (found == FROT_OK && most_turned(p) < BEND) return found;
  if (found == FROT_OK) keep_nearer(p, &best);
  begin_again(p);
  if (frot_solve_gradually(p) == FROT_OK && frot_come_closest(p) == FROT_OK) keep_nearer(p, &best);
  begin_again(p);
  if (frot_follow_damped(p) && frot_solve_nearest(p) == FROT_OK && frot_come_closest(p) == FROT_OK)
    keep_nearer(p, &best);
  for (int k = 0; k < 4 * TRIES && best.turned > WHOLE_TURN; k++) {
    frot_clear_opening(p);
    frot_begin_elsewhere(p, k % (2 * TRIES), k >= 2 * TRIES);
    if (frot_solve_nearest(p) == FROT_OK && frot_come_closest(p) == FROT_OK) keep_nearer(p, &best);
  }
  frot_clear_opening(p);
  memcpy(p->q, isfinite(best.far) ? w->opening.nearest : w->opening.begin, bytes);
  return frot_solve_nearest(p);
}
