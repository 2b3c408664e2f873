#include "guesses.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "closest.h"
#include "core.h"
#include "damped.h"
#include "elsewhere.h"
#include "nearest.h"
#include "tolerances.h"

#define BEGINNINGS 10 /* of the search for a place near the guesses */
/* A place is what the guesses mean if what they are missed by is this square of their sizes. */
#define MEANT 1e-4

/* Mean square of what the equations from `first` on are missed by, in parts of their sizes. */
static double missed_from(const frot_opening *p, int first) {
  double sum = 0;
  for (int i = first; i < p->n; i++) {
    int guess = i >= p->n - p->m->n_guessed;
    double size = guess ? p->w->relations.size[i] : frot_statement_size(p, i);
    double part = size > 0 ? p->w->relations.residual[i] / size : 0;
    sum += part * part;
  }
  return p->n > first ? sum / (p->n - first) : 0;
}

/* The bilateral liaisons, with the sides of the place as it is. */
static void take_liaisons(const frot_opening *p) {
  const frot_model *m = p->m;
  const double *unilateral = p->s->data + frot_layout_of(m).unilateral;
  for (int i = 0; i < m->n_contacts; i++)
    p->use[i] = frot_has_normal(&m->contacts[i]) && !m->contacts[i].reduced && unilateral[i] == 0;
}

int frot_near_guesses(frot_opening *p) {
  frot_opening_work *w = &p->w->opening;
  double least = INFINITY, *y = p->w->blocks.y, *best = w->near, *best_y = best + p->m->nq;
  double *first_y = w->first + p->m->nq;
  size_t bytes = sizeof(double) * (size_t)p->m->nq, y_bytes = sizeof(double) * (size_t)p->m->ny;
  take_liaisons(p);
  p->guessed = 1;
  if (frot_evaluate_statements(p) == FROT_OK) memcpy(w->begin, w->natural, bytes);
  for (int k = 0; k < BEGINNINGS && least > MEANT; k++) {
    frot_clear_opening(p);
    memcpy(p->q, w->begin, bytes);
    memcpy(y, first_y, y_bytes);
    frot_begin_units(p);
    if (k > 0 && frot_opening_metric(p) == FROT_OK) frot_begin_elsewhere(p, k - 1, k % 3 == 0);
    if (!frot_follow_damped(p)) continue;
    double missed = missed_from(p, 0);
    if (missed < least) least = missed, memcpy(best, p->q, bytes), memcpy(best_y, y, y_bytes);
  }
  if (isfinite(least)) {
    memcpy(p->q, best, bytes);
    memcpy(y, best_y, y_bytes);
    if (frot_note_beginning(p) == FROT_OK) frot_unwind(p);
  }
  p->guessed = 0;
  frot_clear_opening(p);
  return isfinite(least);
}

double frot_guesses_missed(frot_opening *p) {
  p->guessed = 1;
  int status = frot_evaluate_statements(p);
  p->guessed = 0;
  if (status != FROT_OK) return INFINITY;
  double missed = missed_from(p, p->n - p->m->n_guessed);
  p->n -= p->m->n_guessed;
  return isfinite(missed) ? missed : INFINITY;
}
