#include "starts/closure_fault.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "assembly/levenberg_marquardt.h"
#include "starts/multistart.h"
#include "assembly/gauss_newton.h"
#include "assembly/start_parts.h"
#include "starts/contact_sides.h"
#include "assembly/start_equations.h"
#include "numerics/tolerances.h"
#include "evaluation/quaternions.h"

#define PLACES 8 /* from which the best is looked for */
#define ROUNDS 4 /* of it until nothing moves */
/* Part of the longest step after which it is looked whether a loop still closes. */
#define SOON 0.01

/* The liaison that is left farthest open, its first contact. */
typedef struct {
  int contact, turned;
  double part, by; /* of its reach, and by how much */
} left_open;

static left_open find_open(const frot_opening *p) {
  const frot_contact *contacts = p->m->contacts;
  const double *reach = p->w->opening.reach, *gap = p->w->core.gap;
  left_open worst = {-1, 0, 0, 0};
  for (int a = 0; a < p->part->n_contacts; a++) {
    int i = p->part->contacts[a];
    double square = 0;
    for (int b = a; b < p->part->n_contacts; b++) {
      int k = p->part->contacts[b];
      if (frot_are_alike(p, i, k)) square += gap[k] * gap[k];
    }
    double by = sqrt(square), part = by > 0 ? by / reach[i] : 0;
    if (part > worst.part) worst = (left_open){i, contacts[i].turns, part, by};
  }
  return worst;
}

/* p->x <- the place near it at which the liaisons hold best, and the one that is left open there;
 * no number where none is found. */
static left_open close_best(frot_opening *p) {
  double before = INFINITY, missed = INFINITY;
  for (int i = 0; i < ROUNDS && frot_follow_damped(p); i++) {
    missed = frot_missed_square(p);
    if (!(missed < before)) break;
    before = missed;
    frot_put(p);
    frot_normalise(p->m, p->q);
    frot_take_part(p, p->part);
  }
  int found = isfinite(before) && frot_evaluate_statements(p) == FROT_OK;
  return found ? find_open(p) : (left_open){-1, 0, NAN, NAN};
}

void frot_tell_apart(frot_opening *p) {
  frot_fault fault = p->s->fault;
  double *start = p->w->opening.begin;
  size_t bytes = sizeof(double) * (size_t)p->n_own;
  left_open best = {-1, 0, INFINITY, 0};
  frot_take_liaisons(p);
  p->alike = 1;
  memcpy(start, p->x, bytes);
  for (int k = 0; k < PLACES; k++) {
    frot_clear_opening(p);
    memcpy(p->x, start, bytes);
    frot_begin_units(p);
    if (k > 0 && frot_opening_metric(p) == FROT_OK) frot_begin_multistart(p, k - 1, 1);
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
  for (int i = 0; i < p->part->n_stated && i < p->n; i++)
    if (frot_statement_of(p, i) >= 0 && !frot_statement_agrees(p, i, 0) &&
        (most < 0 || fabs(residual[i]) > fabs(residual[most])))
      most = i;
  return most;
}

/* What is left open when the motion goes on: a liaison, or a statement that holds at any time. */
typedef struct {
  left_open liaison;
  int statement;
  double missed;
} kept_apart;

/* The same with what is left open of a part, if that is more. */
static void look_at_part(frot_opening *p, kept_apart *most) {
  frot_take_liaisons(p);
  if (frot_look_at_part(p) != FROT_OK) return;
  frot_look_at_sides(p);
  left_open found = close_best(p);
  int missed = isfinite(found.part) ? missed_by_most(p) : -1; /* else nothing is known there */
  if (found.contact >= 0 && found.part > most->liaison.part) most->liaison = found;
  double by = missed >= 0 ? fabs(p->w->relations.residual[missed]) : 0;
  if (by > most->missed) most->statement = frot_statement_of(p, missed), most->missed = by;
}

int frot_report_unreachable(const frot_model *m, frot_state *s, frot_work *w, int status) {
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
  p.alike = p.timeless = 1;
  kept_apart found = {{-1, 0, 0, 0}, -1, 0};
  for (int i = 0; i < m->n_parts; i++) {
    frot_take_part(&p, &m->parts[i]);
    look_at_part(&p, &found);
  }
  frot_leave_parts(&p);
  s->fault = fault, s->phase = phase;
  left_open open = found.liaison;
  if (open.contact >= 0 && open.part > FROT_TOUCH)
    frot_fail(s, FROT_DIVERGE, fault.t, open.contact, 1, -1, open.by);
  else if (found.statement >= 0 && fault.contact >= 0)
    frot_fail(s, FROT_DIVERGE, fault.t, fault.contact, 1, found.statement, found.missed);
  else
    return status;
  s->fault.where[0] = later, s->fault.where[1] = open.turned;
  return FROT_DIVERGE;
}
