#include "assembly/nearest_solution.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "assembly/unknowns.h"
#include "assembly/levenberg_marquardt.h"
#include "assembly/tangent_newton.h"
#include "numerics/dense.h"
#include "assembly/gauss_newton.h"
#include "assembly/start_parts.h"
#include "numerics/tolerances.h"

#define WAYS 40 /* towards it */
/* Ratio of two slopes, one way apart, below which the search continues to rounding. */
#define SHRINKS 0.25
#define LEAST_PART 1e-4
#define MOST_TURN 0.5 /* of an angle on one way */

#define WHOLE_TURN 6.283185307179586

/* On from values that hold along the relations (tangent_newton.h), put back onto them; what has not
 * come nearer is taken back. */

void frot_measure_by_beginning(frot_opening *p) {
  p->factor = p->w->opening.first_factor, p->order = p->attached;
  p->basis = p->w->opening.begin;
  memcpy(p->w->relations.unit, p->w->opening.first_unit, sizeof(double) * (size_t)p->n_own);
}

int frot_note_beginning(frot_opening *p) {
  frot_work *w = p->w;
  size_t bytes = sizeof(double) * (size_t)p->n_own;
  memcpy(w->opening.found, p->x, bytes);
  memcpy(p->x, w->opening.begin, bytes);
  frot_begin_units(p);
  int status = frot_opening_metric(p);
  memcpy(w->opening.first_unit, w->relations.unit, bytes);
  memcpy(w->opening.first_factor, w->opening.factor,
         sizeof(double) * (size_t)(p->attached * p->attached));
  memcpy(p->x, w->opening.found, bytes);
  return status;
}

/* a.b of two changes, measured at the beginning. */
static double product(frot_opening *p, const double *a, const double *b) {
  double *scratch = p->w->opening.scratch, *first = scratch, *second = scratch + p->n_own;
  double sum = 0;
  frot_measure_by_beginning(p);
  frot_measure_change(p, a, first);
  frot_measure_change(p, b, second);
  for (int k = 0; k < p->n_own; k++) sum += first[k] * second[k];
  return sum;
}

static void between(const frot_opening *p, const double *x, const double *x0, double *apart) {
  for (int k = 0; k < p->n_own; k++) apart[k] = x[k] - x0[k];
}

double frot_change_size(frot_opening *p) {
  double *apart = p->w->opening.apart;
  between(p, p->x, p->w->opening.begin, apart);
  return sqrt(fmax(product(p, apart, apart), 0));
}

void frot_unwind(frot_opening *p) {
  if (frot_evaluate_statements(p) != FROT_OK) return;
  frot_weigh_equations(p);
  double missed = frot_missed_square(p) * FROT_UNNOTICED + FROT_NOTHING_MISSED;
  for (int k = 0; k < p->n_own; k++) {
    double here = p->x[k], turns = round((p->w->opening.begin[k] - here) / WHOLE_TURN);
    if (turns == 0) continue;
    p->x[k] = here + turns * WHOLE_TURN;
    if (frot_evaluate_statements(p) != FROT_OK || !(frot_missed_square(p) <= missed))
      p->x[k] = here;
  }
}

/* How far the values are from what is aimed at. */
static double far_off(frot_opening *p) { return p->aim ? p->missed(p) : frot_change_size(p); }

/* The longest part of a way that no angle turns too far on. */
static double first_part(const frot_opening *p, const double *d) {
  double most = 0;
  for (int k = 0; k < p->n_own; k++)
    if (frot_is_angle(p, k)) most = fmax(most, fabs(d[k]));
  for (int i = 0; i < p->part->n_turns; i++) {
    const double *four = d + p->w->opening.turns[i].at;
    most = fmax(most, 2 * frot_length(four, 4));
  }
  return most > MOST_TURN ? MOST_TURN / most : 1;
}

int frot_come_closest(frot_opening *p) {
  frot_opening_work *w = &p->w->opening;
  double *x = w->found, *d = w->way, before = INFINITY, left = 0;
  size_t bytes = sizeof(double) * (size_t)p->n_own;
  if (p->n_rows > 0 && !p->aim) frot_unwind(p);
  double far = far_off(p);
  int moved = 0, status = FROT_OK, some = p->n_rows > 0 || p->aim;
  for (int k = 0; k < WAYS && some && far > 0; k++) {
    status = frot_way_down(p, &left);
    if (status != FROT_OK || left <= DBL_EPSILON * far) break;
    if (left <= FROT_NEAREST_SLOPE * far && left > SHRINKS * before) break;
    before = left;
    memcpy(x, p->x, bytes);
    double now = INFINITY, part = first_part(p, d);
    for (; part >= LEAST_PART; part *= 0.25) {
      for (int i = 0; i < p->n_own; i++) p->x[i] = x[i] + part * d[i];
      if (frot_solve_nearest(p) == FROT_OK && (now = far_off(p)) < far * FROT_NO_FARTHER) break;
      frot_clear_opening(p);
    }
    if (part < LEAST_PART) {
      memcpy(p->x, x, bytes);
      break;
    }
    moved = 1, far = fmin(far, now);
  }
  if (status != FROT_OK) frot_clear_opening(p);
  return moved || some ? frot_solve_nearest(p) : FROT_OK;
}
