#include "apart.h"

#include <math.h>
#include <string.h>

#include "core.h"
#include "damped.h"
#include "elsewhere.h"
#include "nearest.h"
#include "statements.h"
#include "tolerances.h"
#include "turns.h"

#define PLACES 8 /* from which the best is looked for */
#define ROUNDS 4 /* of it until nothing moves */

/* The liaison that is left farthest open, its first contact. */
typedef struct {
  int contact, turned;
  double part, by; /* of its reach, and by how much */
} left_open;

static left_open find_open(const frot_opening *p) {
  const frot_model *m = p->m;
  const double *reach = p->w->opening.reach, *gap = p->w->core.gap;
  left_open worst = {-1, 0, 0, 0};
  for (int i = 0; i < m->n_contacts; i++) {
    double square = 0;
    for (int k = i; k < m->n_contacts && p->use[i]; k++)
      if (p->use[k] && !m->contacts[k].kinematic && (reach[k] == 1) == (reach[i] == 1) &&
          strcmp(m->contacts[k].name, m->contacts[i].name) == 0)
        square += gap[k] * gap[k];
    double by = sqrt(square), part = by / (reach[i] > 0 ? reach[i] : 1);
    if (part > worst.part) worst = (left_open){i, reach[i] == 1, part, by};
  }
  return worst;
}

void frot_tell_apart(frot_opening *p) {
  const frot_model *m = p->m;
  frot_fault fault = p->s->fault;
  double *start = p->w->opening.begin;
  size_t bytes = sizeof(double) * (size_t)m->nq;
  left_open best = {-1, 0, INFINITY, 0};
  frot_take_liaisons(p);
  p->alike = 1;
  memcpy(start, p->q, bytes);
  for (int k = 0; k < PLACES; k++) {
    frot_clear_opening(p);
    memcpy(p->q, start, bytes);
    frot_begin_units(p);
    if (k > 0 && frot_opening_metric(p) == FROT_OK) frot_begin_elsewhere(p, k - 1, 1);
    double before = INFINITY, missed = INFINITY;
    for (int i = 0; i < ROUNDS && frot_follow_damped(p); i++) {
      missed = frot_missed_square(p);
      if (!(missed < before)) break;
      before = missed;
      frot_normalise(m, p->q);
    }
    if (!isfinite(before) || frot_evaluate_statements(p) != FROT_OK) continue;
    left_open found = find_open(p);
    /* what closes after all tells nothing */
    if (found.contact >= 0 && found.part > FROT_TOUCH && found.part < (1 - FROT_NEARER) * best.part)
      best = found;
  }
  p->alike = 0;
  p->s->fault = fault, p->s->phase = FROT_FAULTED;
  if (best.contact < 0) return;
  p->s->fault.contact = best.contact, p->s->fault.value = best.by, p->s->fault.other = -3;
  p->s->fault.where[0] = best.turned;
}
