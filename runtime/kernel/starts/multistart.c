#include "starts/multistart.h"

#include <math.h>
#include <string.h>

#include "assembly/unknowns.h"
#include "assembly/nearest_solution.h"
#include "evaluation/evaluate.h"
#include "assembly/levenberg_marquardt.h"
#include "starts/homotopy.h"
#include "assembly/gauss_newton.h"
#include "assembly/start_parts.h"
#include "numerics/tolerances.h"

#define TRIES 8 /* beginnings of the search beside the given one, each to both hands */
#define WHOLE_TURN 6.3
/* From a beginning as near as this, in angles, the straight way leads to what is nearest. */
#define BEND 1.0
/* Beginnings beside each other are a Kronecker sequence. A change has one of so many strides: no
 * multiple of the golden section is an integer, so that each change differs between beginnings. */
#define GOLDEN 0.6180339887498949
#define STRIDES 12

/* The square root of what change i moves of mass or inertia. */
static double moved_by(const frot_opening *p, int i) {
  int speed = frot_speed_behind(p, i);
  return sqrt(frot_metric_entry(p->m, p->w, speed, speed));
}

/* The least and the largest of these of all turns of the part; 0 where nothing turns. */
static void span_turns(const frot_opening *p, double span[2]) {
  span[0] = span[1] = 0;
  for (int a = 0; a < p->attached; a++) {
    int k = p->w->opening.own[a];
    if (!p->m->speed_turns[frot_speed_behind(p, k)]) continue;
    double own = moved_by(p, k);
    span[0] = span[0] > 0 ? fmin(span[0], own) : own, span[1] = fmax(span[1], own);
  }
}

/* A unit of change i: of a turn 1 or, if `alike`, such that all move as much; of a length the arm
 * that turns have, the shortest or the longest. So the unit of length does not matter. */
static double unit_of(const frot_opening *p, int i, const double *span, int alike) {
  int speed = frot_speed_behind(p, i);
  if (speed < 0) return p->w->relations.unit[i];
  if (p->m->speed_turns[speed]) return alike ? span[0] / moved_by(p, i) : 1;
  if (span[1] == 0) return p->scene;
  return span[alike ? 0 : 1] / moved_by(p, i);
}

void frot_begin_multistart(frot_opening *p, int k, int alike) {
  double span[2], *changes = p->w->opening.scratch;
  span_turns(p, span);
  memset(changes, 0, sizeof(double) * (size_t)p->n_own);
  for (int i = 0; i < p->n_own; i++) {
    double part = fmod(GOLDEN * ((k / 2 + 1) * (1 + i % STRIDES) + i), 1);
    changes[i] = (k % 2 ? -1 : 1) * 3 * (0.1 + 0.9 * part) * unit_of(p, i, span, alike);
  }
  /* an orientation stays of length 1 */
  for (int i = 0; i < p->part->n_turns; i++) changes[p->w->opening.turns[i].at] = 0;
  p->basis = p->w->opening.begin;
  frot_from_changes(p, changes, p->x);
  for (int i = 0; i < p->n_own; i++) p->x[i] += p->w->opening.begin[i];
  frot_begin_blocks(p);
}

/* The most that an angle changed from w->opening.begin. */
static double most_turned(const frot_opening *p) {
  double most = 0;
  for (int k = 0; k < p->n_own; k++)
    if (frot_is_angle(p, k)) most = fmax(most, fabs(p->x[k] - p->w->opening.begin[k]));
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
  memcpy(p->w->opening.nearest, p->x, sizeof(double) * (size_t)p->n_own);
  frot_keep_blocks(p, p->w->opening.nearest + p->n_own);
}

static void begin_again(const frot_opening *p) {
  frot_clear_opening(p);
  memcpy(p->x, p->w->opening.begin, sizeof(double) * (size_t)p->n_own);
  frot_return_blocks(p, p->w->opening.begin_y);
}

int frot_solve_widely(frot_opening *p) {
  frot_work *w = p->w;
  size_t bytes = sizeof(double) * (size_t)p->n_own;
  nearest_found best = {INFINITY, INFINITY};
  memcpy(w->opening.begin, p->x, bytes);
  frot_keep_blocks(p, w->opening.begin_y);
  int found = frot_solve_nearest(p);
  if (found == FROT_OK && memcmp(w->opening.begin, p->x, bytes) == 0) return found;
  if (found != FROT_OK && (found != FROT_INITIAL || !p->wide)) return found;
  int status = frot_note_beginning(p);
  if (status != FROT_OK) return frot_no_number(p, status);
  if (found == FROT_OK) found = frot_come_closest(p);
  if (found == FROT_OK && most_turned(p) < BEND) return found;
  if (found == FROT_OK) keep_nearer(p, &best);
  begin_again(p);
  if (frot_solve_by_homotopy(p) == FROT_OK && frot_come_closest(p) == FROT_OK)
    keep_nearer(p, &best);
  begin_again(p);
  if (frot_follow_damped(p) && frot_solve_nearest(p) == FROT_OK && frot_come_closest(p) == FROT_OK)
    keep_nearer(p, &best);
  for (int k = 0; k < 4 * TRIES && best.turned > WHOLE_TURN; k++) {
    frot_clear_opening(p);
    frot_begin_multistart(p, k % (2 * TRIES), k >= 2 * TRIES);
    if (frot_solve_nearest(p) == FROT_OK && frot_come_closest(p) == FROT_OK) keep_nearer(p, &best);
  }
  frot_clear_opening(p);
  const double *end = isfinite(best.far) ? w->opening.nearest : w->opening.begin;
  memcpy(p->x, end, bytes);
  frot_return_blocks(p, isfinite(best.far) ? end + p->n_own : w->opening.begin_y);
  return frot_solve_nearest(p);
}
