#include "apart.h"

#include <math.h>
#include <string.h>

#include "changes.h"
#include "core.h"
#include "damped.h"
#include "elsewhere.h"
#include "nearest.h"
#include "parts.h"
#include "sides.h"
#include "statements.h"
#include "tolerances.h"
#include "turns.h"

#define PLACES 8 /* from which the best is looked for */
#define ROUNDS 4 /* of it until nothing moves */
#define SOON \
  0.01 /* part of the longest step after which it is looked whether a loop still closes */

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
    if (!frot_is_of_part(p, m->contact_part[i])) continue;
    double square = 0;
    for (int k = i; k < m->n_contacts && p->use[i]; k++)
      if (p->use[k] && !m->contacts[k].kinematic && (reach[k] == 1) == (reach[i] == 1) &&
          strcmp(m->contacts[k].name, m->contacts[i].name) == 0)
        square += gap[k] * gap[k];
    double by = sqrt(square), part = by > 0 ? by / reach[i] : 0;
    if (part > worst.part) worst = (left_open){i, reach[i] == 1, part, by};
  }
  return worst;
}

/* p->q <- the place near it at which the liaisons hold best, and the one that is left open there;
 * no number where none is found. */
static left_open close_best(frot_opening *p) {
  double before = INFINITY, missed = INFINITY;
  for (int i = 0; i < ROUNDS && frot_follow_damped(p); i++) {
    missed = frot_missed_square(p);
    if (!(missed < before)) break;
    before = missed;
    frot_normalise(p->m, p->q);
  }
  int found = isfinite(before) && frot_evaluate_statements(p) == FROT_OK;
  return found ? find_open(p) : (left_open){-1, 0, NAN, NAN};
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
    left_open found = close_best(p);
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

/* The equation of what holds at any time that is missed by most, -1 where all of them hold. */
static int missed_by_most(const frot_opening *p) {
  const double *residual = p->w->relations.residual;
  int most = -1;
  for (int i = 0; i < p->m->n_position && i < p->n; i++)
    if (p->m->position_statement[i] >= 0 && !frot_statement_agrees(p, i, 0) &&
        (most < 0 || fabs(residual[i]) > fabs(residual[most])))
      most = i;
  return most;
}

int frot_name_reach(const frot_model *m, frot_state *s, frot_work *w, int status) {
  frot_fault fault = s->fault;
  int phase = s->phase;
  double *q = w->opening.first, later = SOON * s->h_max;
  if (s->statistics.steps == 0 || !isfinite(later)) return status;
  if ((status != FROT_DIVERGE && status != FROT_POSTURE) || fault.item >= 0) return status;
  frot_opening p = {.m = m, .s = s, .w = w, .t = fault.t + later, .q = q, .v = w->opening.start};
  p.d = s->data + w->layout.d, p.use = w->opening.use;
  memcpy(q, s->data + w->layout.x, sizeof(double) * (size_t)m->nq);
  memcpy(p.v, s->data + w->layout.x + m->nq, sizeof(double) * (size_t)m->nv);
  memcpy(w->blocks.y, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
  frot_name_changes(&p);
  frot_take_part(&p, -1);
  frot_take_liaisons(&p);
  p.alike = p.timeless = 1;
  left_open found = {-1, 0, 0, 0};
  int missed = -1;
  if (frot_kinematics(m, s, w, p.t, p.q, p.v, p.d) == FROT_OK) {
    frot_look_at_sides(&p);
    found = close_best(&p);
    if (isfinite(found.part)) missed = missed_by_most(&p); /* else nothing is known there */
  }
  s->fault = fault, s->phase = phase;
  if (found.contact >= 0 && found.part > FROT_TOUCH)
    frot_fail(s, FROT_DIVERGE, fault.t, found.contact, 1, -1, found.by);
  else if (missed >= 0 && fault.contact >= 0)
    frot_fail(s, FROT_DIVERGE, fault.t, fault.contact, 1, m->position_statement[missed],
              fabs(w->relations.residual[missed]));
  else
    return status;
  s->fault.where[0] = later, s->fault.where[1] = found.turned;
  return FROT_DIVERGE;
}
