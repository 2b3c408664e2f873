#include "closest.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "changes.h"
#include "damped.h"
#include "nearest.h"

#define PULLS 40
/* Part of the change from the beginning that may be left at the end; what still shrinks so much
 * from way to way is followed on, to rounding. */
#define SETTLED 1e-9
#define SHRINKS 0.25
#define NO_FARTHER (1 + 1e-13) /* rounding of a size: near the least one, ways say more */
#define LEAST_PART 1e-4
#define MOST_PART 8.0

#define WHOLE_TURN 6.283185307179586
#define UNNOTICED (1 + 1e-9)

/* The values nearest to the beginning are those from which no way along the relations leads back
 * towards it. Such a way is d = x* - x, where x* is the least change from the beginning that the
 * relations, linear at x, allow. How far to go along it is told by how it changed on the last way s
 * (Barzilai and Borwein 1988): s.s/s.(d_before - d); then the values are put back onto the
 * relations, and what has not come nearer is taken back. */

static void measure_by_beginning(frot_opening *p) {
  p->factor = p->w->opening.first_factor, p->order = p->attached;
  p->basis = p->w->opening.begin;
  memcpy(p->w->relations.unit, p->w->opening.first_unit, sizeof(double) * (size_t)p->m->nq);
}

int frot_note_beginning(frot_opening *p) {
  frot_work *w = p->w;
  size_t bytes = sizeof(double) * (size_t)p->m->nq;
  memcpy(w->opening.found, p->q, bytes);
  memcpy(p->q, w->opening.begin, bytes);
  frot_begin_units(p);
  int status = frot_opening_metric(p);
  memcpy(w->opening.first_unit, w->relations.unit, bytes);
  memcpy(w->opening.first_factor, w->opening.factor,
         sizeof(double) * (size_t)(p->attached * p->attached));
  memcpy(p->q, w->opening.found, bytes);
  return status;
}

/* a.b of two changes, measured at the beginning. */
static double product(frot_opening *p, const double *a, const double *b) {
  double *scratch = p->w->opening.scratch, *first = scratch, *second = scratch + p->m->nq;
  double sum = 0;
  measure_by_beginning(p);
  frot_measure_change(p, a, first);
  frot_measure_change(p, b, second);
  for (int k = 0; k < p->m->nq; k++) sum += first[k] * second[k];
  return sum;
}

static void between(const frot_opening *p, const double *x, const double *x0, double *apart) {
  for (int k = 0; k < p->m->nq; k++) apart[k] = x[k] - x0[k];
}

double frot_change_size(frot_opening *p) {
  double *apart = p->w->opening.apart;
  between(p, p->q, p->w->opening.begin, apart);
  return sqrt(fmax(product(p, apart, apart), 0));
}

void frot_unwind(frot_opening *p) {
  if (frot_evaluate_statements(p) != FROT_OK) return;
  frot_weigh_equations(p);
  double missed = frot_missed_square(p) * UNNOTICED + FROT_NOTHING_MISSED;
  for (int k = 0; k < p->m->nq; k++) {
    double here = p->q[k], turns = round((p->w->opening.begin[k] - here) / WHOLE_TURN);
    if (turns == 0) continue;
    p->q[k] = here + turns * WHOLE_TURN;
    if (frot_evaluate_statements(p) != FROT_OK || !(frot_missed_square(p) <= missed))
      p->q[k] = here;
  }
}

/* d <- the way from p->q to the least change from the beginning. */
static int way_back(frot_opening *p, double *d) {
  double size;
  int status = frot_evaluate_statements(p);
  if (status != FROT_OK) return status;
  measure_by_beginning(p);
  frot_least_change(p, p->w->opening.begin);
  frot_move_opening(p, p->w->relations.step, p->w->opening.begin, 1, d, &size);
  between(p, d, p->q, d);
  return FROT_OK;
}

int frot_come_closest(frot_opening *p) {
  frot_opening_work *w = &p->w->opening;
  double *x = w->found, *d = w->way, *next = w->next_way, *s = w->apart;
  size_t bytes = sizeof(double) * (size_t)p->m->nq;
  if (p->n > 0 && !p->velocity) frot_unwind(p);
  double far = frot_change_size(p), part = 1, before = INFINITY;
  int moved = 0, status = p->n > 0 && far > 0 ? way_back(p, d) : FROT_OK;
  for (int k = 0; k < PULLS && status == FROT_OK && p->n > 0 && far > 0; k++) {
    double left = sqrt(product(p, d, d));
    if (left <= DBL_EPSILON * far || (left <= SETTLED * far && left > SHRINKS * before)) break;
    before = left;
    memcpy(x, p->q, bytes);
    double now = INFINITY;
    for (; part >= LEAST_PART; part *= 0.25) {
      for (int i = 0; i < p->m->nq; i++) p->q[i] = x[i] + part * d[i];
      if (frot_solve_nearest(p) == FROT_OK && (now = frot_change_size(p)) < far * NO_FARTHER) break;
      frot_clear_opening(p);
    }
    if (part < LEAST_PART) {
      memcpy(p->q, x, bytes);
      break;
    }
    moved = 1;
    status = way_back(p, next);
    if (status != FROT_OK) break;
    far = fmin(far, now);
    between(p, p->q, x, s);
    double along = product(p, s, s);
    for (int i = 0; i < p->m->nq; i++) d[i] -= next[i];
    double less = product(p, s, d);
    part = less > 0 ? fmin(fmax(along / less, 16 * LEAST_PART), MOST_PART) : 1;
    memcpy(d, next, bytes);
  }
  if (status != FROT_OK) frot_clear_opening(p);
  return moved || p->n > 0 ? frot_solve_nearest(p) : FROT_OK;
}
