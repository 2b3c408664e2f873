#include "events/parameter_change.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "evaluation/fault_source.h"
#include "evaluation/algebraic_loops.h"
#include "evaluation/evaluate.h"
#include "reactions/switching_functions.h"
#include "constraints/invariants.h"
#include "impacts/separation.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

/* The values noted: gaps, rates, places of the carried bodies, invariants. */
typedef struct {
  double *gap, *rate, *place, *invariant;
} noted;

static noted noted_in(const frot_model *m, double *held) {
  noted n = {held, held + m->n_contacts, held + m->n_contacts + m->n_rows, NULL};
  n.invariant = n.place + FROT_PLACE * m->n_carried;
  return n;
}

void frot_accept_parameters(const frot_model *m, frot_state *s) {
  frot_layout l = frot_layout_of(m);
  double *held = s->data + l.kept;
  memcpy(held, s->data + l.set, sizeof(double) * (size_t)m->np);
  memcpy(held + m->np, s->data + l.given, sizeof(double) * (size_t)m->np);
  memcpy(held + 2 * m->np, s->data + l.u, sizeof(double) * (size_t)m->nu);
}

void frot_swap_inputs(const frot_model *m, frot_state *s) {
  frot_layout l = frot_layout_of(m);
  double *u = s->data + l.u, *held = s->data + l.kept + 2 * m->np;
  for (int i = 0; i < m->nu; i++) {
    double given = u[i];
    u[i] = held[i], held[i] = given;
  }
}

void frot_restore_parameters(const frot_model *m, frot_state *s, frot_work *w) {
  frot_layout l = frot_layout_of(m);
  const double *held = s->data + l.kept;
  memcpy(s->data + l.set, held, sizeof(double) * (size_t)m->np);
  memcpy(s->data + l.given, held + m->np, sizeof(double) * (size_t)m->np);
  memcpy(s->data + l.u, held + 2 * m->np, sizeof(double) * (size_t)m->nu);
  frot_fault told = s->fault;
  frot_settle_parameters(m, s, w, NULL); /* good once, good again */
  s->fault = told;
  s->phase = FROT_RUNNING;
  s->changed = s->ramps = 0;
}

/* Kinematics, places and invariants, with their sizes, at the values given now. */
static int look(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                const double *v, double *place, double *invariant) {
  const double *d = s->data + frot_layout_of(m).d;
  int status = frot_kinematics(m, s, w, t, q, v, d);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  frot_inputs(s, w, &t, q, v, d);
  if (m->n_carried > 0) {
    w->call.res[0] = place;
    frot_call(w, &m->places);
  }
  if (m->n_invariants > 0) {
    w->call.res[0] = invariant, w->call.res[1] = w->relations.jacobian,
    w->call.res[2] = w->relations.residual;
    frot_call(w, &m->invariants);
    frot_add_sizes(m, w, q, v, w->relations.residual);
  }
  return FROT_OK;
}

int frot_note_contacts_before_change(const frot_model *m, frot_state *s, frot_work *w, double t,
                                     const double *q, const double *v) {
  noted n = noted_in(m, w->stood);
  int status = look(m, s, w, t, q, v, n.place, n.invariant);
  memcpy(n.gap, w->core.gap, sizeof(double) * (size_t)m->n_contacts);
  memcpy(n.rate, w->core.rate, sizeof(double) * (size_t)m->n_rows);
  return status;
}

static int refuse(frot_state *s, double t, int contact, int item, int why, double value) {
  frot_fail(s, FROT_REFUSED, t, contact, item, why, value);
  s->phase = FROT_RUNNING;
  return FROT_REFUSED;
}

/* Bodies that coordinates or the equations of the text would carry along. Lengths and speeds are
 * measured against the largest of all, so that a place of zero is one like any other. */
static int check_carried(const frot_model *m, frot_state *s, double t, const double *before,
                         const double *after) {
  static const int why[3] = {FROT_CARRIES, FROT_TURNS, FROT_JERKS};
  double size[3] = {0, 1, 0};
  for (int i = 0; i < FROT_PLACE * m->n_carried; i++) {
    int kind = i % FROT_PLACE / 3;
    if (kind != 1) size[kind] = fmax(size[kind], fmax(fabs(before[i]), fabs(after[i])));
  }
  for (int i = 0; i < FROT_PLACE * m->n_carried; i++) {
    int kind = i % FROT_PLACE / 3;
    double change = after[i] - before[i];
    if (fabs(change) > FROT_TOUCH * size[kind])
      return refuse(s, t, -1, i / FROT_PLACE, why[kind], change);
  }
  return FROT_OK;
}

/* The change, and what it is to open when all of it is allowed. */
typedef struct {
  const frot_model *m;
  frot_state *s;
  frot_work *w;
  frot_layout l;
  double t;
  const double *q, *v;
  noted before;
  frot_recorder *recorder; /* NULL where nothing is recorded */
} change;

/* Look at contact i or, with `act`, open it or let it close. */
static int check_contact(const change *c, int i, int act) {
  frot_state *s = c->s;
  const frot_model *m = c->m;
  frot_contact_mode *mode = (frot_contact_mode *)(void *)(s->data + c->l.modes) + i;
  int row = m->contacts[i].row_n, parts = s->data[c->l.unilateral + i] != 0;
  double gap = c->w->core.gap[i], rate = c->w->core.rate[row];
  double moved = gap - c->before.gap[i], jerked = rate - c->before.rate[row];
  const double *usual_speeds = s->data + c->l.scale_x + m->nq;
  double size = fabs(gap) + fabs(c->before.gap[i]) + frot_gap_size(m, c->w, row, c->q);
  double usual = frot_row_size(m, c->w, row, c->v) + frot_row_size(m, c->w, row, usual_speeds);
  int moves = fabs(moved) > FROT_TOUCH * size,
      jerks = fabs(jerked) > FROT_TOUCH * (usual + fabs(jerked));
  if (!moves && !jerks) return FROT_OK;
  if (mode->closed && !parts)
    return refuse(s, c->t, i, -1, moves ? FROT_PARTS : FROT_JERKS, moves ? moved : jerked);
  if (moves && gap < -FROT_TOUCH * size) return refuse(s, c->t, i, -1, FROT_ENTERS, -gap);
  int touches = fabs(gap) <= FROT_TOUCH * size, leaves = rate > FROT_TOUCH * usual;
  if (touches && rate < -FROT_TOUCH * usual) return refuse(s, c->t, i, -1, FROT_MEETS, -rate);
  if (!act) return FROT_OK;
  if (mode->closed && (!touches || leaves))
    frot_part_contact(c->m, c->s, c->t, i, c->recorder);
  else if (!mode->closed && touches && !leaves)
    s->data[c->l.fired + i] = 1;
  return FROT_OK;
}

/* The first relation between states that has moved since it was noted, -1 if none has. */
static int moved_invariant(const frot_model *m, const frot_work *w, const noted *before,
                           const double *now) {
  for (int i = 0; i < m->n_invariants; i++)
    if (fabs(now[i] - before->invariant[i]) >
        FROT_TOUCH * (w->relations.residual[i] + fabs(now[i])))
      return i;
  return -1;
}

static int check_invariants(const change *c, const double *now) {
  const frot_model *m = c->m;
  int i = moved_invariant(m, c->w, &c->before, now);
  if (i < 0) return FROT_OK;
  return refuse(c->s, c->t, -1, m->n_statements - m->n_invariants + i, FROT_BREAKS,
                now[i] - c->before.invariant[i]);
}

int frot_check_switch(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                      const double *v) {
  noted before = noted_in(m, w->stood);
  double *place = before.invariant + m->n_invariants;
  double *now = place + FROT_PLACE * m->n_carried;
  int status = look(m, s, w, t, q, v, place, now);
  if (status != FROT_OK) return status;
  int i = moved_invariant(m, w, &before, now);
  if (i < 0) return FROT_OK;
  return frot_fail(s, FROT_JUMP, t, -1, m->n_statements - m->n_invariants + i, FROT_BREAKS,
                   now[i] - before.invariant[i]);
}

int frot_check_contacts_after_change(const frot_model *m, frot_state *s, frot_work *w, double t,
                                     const double *q, const double *v, frot_recorder *recorder) {
  change c = {m, s, w, frot_layout_of(m), t, q, v, noted_in(m, w->stood), recorder};
  double *place = c.before.invariant + m->n_invariants;
  double *invariant = place + FROT_PLACE * m->n_carried;
  int status = look(m, s, w, t, q, v, place, invariant);
  if (status == FROT_OK) status = check_carried(m, s, t, c.before.place, place);
  if (status == FROT_OK) status = check_invariants(&c, invariant);
  for (int act = 0; act < 2 && status == FROT_OK; act++) {
    /* what the old values were about to bring about is gone */
    if (act) memset(s->data + c.l.fired, 0, sizeof(double) * (size_t)c.l.nf);
    for (int i = 0; i < m->n_contacts && status == FROT_OK; i++)
      if (frot_has_normal(&m->contacts[i]) && !m->contacts[i].reduced)
        status = check_contact(&c, i, act);
  }
  return status;
}

/* The body or the relation of the text that a change would move, NULL for a contact. */
static const frot_carried *carried_of(const frot_model *m, const frot_fault *f) {
  int known = f->contact < 0 && f->other != FROT_BREAKS && f->item >= 0 && f->item < m->n_carried;
  return known ? &m->carried[f->item] : NULL;
}

static const frot_statement *relation_of(const frot_model *m, const frot_fault *f) {
  int known = f->other == FROT_BREAKS && f->item >= 0 && f->item < m->n_statements;
  return known ? &m->statements[f->item] : NULL;
}

/* What the change would do, in the words that follow the name of the contact or body. */
static const char *words_of(const frot_fault *f) {
  switch (f->other) {
    case FROT_PARTS:
      return "it cannot part, and would be apart by %.6g m";
    case FROT_ENTERS:
      return "the body would be inside by %.6g m";
    case FROT_MEETS:
      return "the bodies would meet with a speed of %.6g m/s";
    case FROT_CARRIES:
      return "it would move by %.6g m at once";
    case FROT_TURNS:
      return "it would turn by %.6g rad at once";
    case FROT_BREAKS:
      return "it would be off by %.6g";
    default:
      return f->contact >= 0 ? "it cannot part, and would part with a speed of %.6g m/s"
                             : "what carries it would change its speed by %.6g m/s at once";
  }
}

void frot_refusal_text(const frot_model *m, const frot_fault *f, char *text, size_t size) {
  const frot_carried *body = carried_of(m, f);
  const frot_statement *relation = relation_of(m, f);
  char what[128];
  snprintf(what, sizeof what, words_of(f), f->value);
  const char *before =
      f->status == FROT_JUMP
          ? (f->contact >= 0 ? "`reinit` moves a body against its liaisons"
                             : "a switch moves at once what equations prescribe")
          : "the change of parameters or inputs is refused, and the old values stay";
  if (f->contact >= 0 && f->contact < m->n_contacts)
    snprintf(text, size, "%s at t = %.17g: liaison '%s': %s", before, f->t,
             m->contacts[f->contact].name, what);
  else if (body)
    snprintf(text, size, "%s at t = %.17g: body '%s', %s%s%s: %s", before, f->t, body->body,
             body->by[0] ? "carried by liaison '" : "whose motion the equations prescribe",
             body->by, body->by[0] ? "'" : "", what);
  else
    snprintf(text, size, "%s at t = %.17g: %s: %s", before, f->t,
             relation ? relation->text : "a relation of the text", what);
}

const char *frot_refusal_place(const frot_model *m, const frot_fault *f) {
  const frot_carried *body = carried_of(m, f);
  const frot_statement *relation = relation_of(m, f);
  return body ? body->place : relation ? relation->place : "";
}
