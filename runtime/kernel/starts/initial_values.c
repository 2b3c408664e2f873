#include "starts/initial_values.h"

#include <math.h>
#include <string.h>

#include "assembly/closing_speeds.h"
#include "starts/start_branch.h"
#include "guards/conditions.h"
#include "evaluation/evaluate.h"
#include "starts/guesses.h"
#include "assembly/gauss_newton.h"
#include "assembly/start_parts.h"
#include "starts/contact_sides.h"
#include "starts/part_places.h"
#include "assembly/start_equations.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

/* Conditions that depend on values that depend on conditions: rounds in which all are set, beyond
 * those that their chain can be long, and for each of these those in which the first that is wrong
 * is changed alone (conditions.c); rounds that may have no solution. */
#define ROUNDS 10
#define ONE_BY_ONE 20

/* Set the conditions as their values say, or `alone` the first of those that are not. */
static void set_conditions(const frot_model *m, const frot_work *w, double *d, int alone) {
  for (int j = 0; j < m->n_conditions; j++) {
    int now = m->condition_strict[j] ? w->core.condition[j] > 0 : w->core.condition[j] >= 0;
    int changes = now != (d[j] != 0);
    d[j] = now;
    if (changes && alone) return;
  }
}

/* v and y <- where the search for speeds and for the unknowns of the blocks begins at the places as
 * they are; w->core.condition <- the conditions there. */
static void begin_values(const frot_opening *p, double *v, double *y) {
  frot_work *w = p->w;
  frot_inputs(p->s, w, &p->t, p->q, p->v, p->d);
  w->call.res[0] = v, w->call.res[1] = y, w->call.res[2] = w->core.condition;
  frot_call(w, &p->m->beginning);
}

/* Where the text says that the search begins. */
static void guess(frot_opening *p) {
  const frot_model *m = p->m;
  frot_layout l = frot_layout_of(m);
  frot_work *w = p->w;
  double *discrete = p->s->data + l.d + m->n_conditions + m->n_contacts;
  p->velocity = 0;
  memset(p->v, 0, sizeof(double) * (size_t)m->nv);
  w->call.arg[0] = &p->t, w->call.arg[1] = p->s->data + l.u, w->call.arg[2] = p->s->data + l.p;
  w->call.res[0] = p->q, w->call.res[1] = discrete;
  frot_call(w, &m->start);
  begin_values(p, p->v, w->blocks.y);
  frot_meet_guesses(p);
  memcpy(w->opening.met, p->q, sizeof(double) * (size_t)m->nq);
  begin_values(p, p->v, w->blocks.y);
}

/* All coordinates, part by part: what stands beside a part does nothing to it. */
static int solve_positions(frot_opening *p, double *side, int stay) {
  int status = FROT_OK;
  p->velocity = 0;
  for (int i = 0; i < p->m->n_parts && status == FROT_OK; i++) {
    const frot_part *part = &p->m->parts[i];
    if (part->n_stated + part->n_contacts + part->n_guessed == 0) continue;
    frot_take_part(p, part);
    status = frot_place_part(p, side, stay);
    frot_put(p);
    frot_look_at_sides(p);
  }
  frot_leave_parts(p);
  if (status == FROT_OK) {
    status = frot_kinematics(p->m, p->s, p->w, p->t, p->q, p->v, p->d);
    if (status != FROT_OK) frot_no_number(p, status);
  }
  return status;
}

/* Speeds of a part; opens contacts that separate. */
static int move_part(frot_opening *p, frot_contact_mode *modes) {
  int status = frot_follow_guessed_speeds(p);
  if (status == FROT_OK && p->part->n_contacts > 0) { /* what speeds are measured by */
    status = frot_opening_metric(p);
    if (status != FROT_OK) return frot_no_number(p, status);
  }
  return status == FROT_OK ? frot_stop_approach(p, modes) : status;
}

/* All speeds, part by part. */
static int solve_speeds(frot_opening *p, frot_contact_mode *modes) {
  int status = FROT_OK;
  begin_values(p, p->v, p->w->opening.fresh);
  p->velocity = 1;
  for (int i = 0; i < p->m->n_speed_parts && status == FROT_OK; i++) {
    const frot_part *part = &p->m->speed_parts[i];
    if (part->n_stated + part->n_contacts + part->n_guessed == 0) continue;
    frot_take_part(p, part);
    status = move_part(p, modes);
    if (status == FROT_OK) status = frot_choose_branch(p);
    frot_put(p);
  }
  frot_leave_parts(p);
  if (status == FROT_OK) {
    status = frot_kinematics(p->m, p->s, p->w, p->t, p->q, p->v, p->d);
    if (status != FROT_OK) frot_no_number(p, status);
  }
  return status;
}

/* Set the conditions by the values found, if they have values there. */
static void look_at_conditions(const frot_opening *p, int alone) {
  if (frot_kinematics(p->m, p->s, p->w, p->t, p->q, p->v, p->d) != FROT_OK) return;
  set_conditions(p->m, p->w, p->s->data + frot_layout_of(p->m).d, alone);
}

/* The conditions as they are where the search begins: which of several solutions is meant. */
static void look_at_guesses(const frot_opening *p) {
  begin_values(p, p->w->opening.scratch, p->w->opening.fresh);
  set_conditions(p->m, p->w, p->s->data + frot_layout_of(p->m).d, 0);
}

/* All values from the guesses, or from those found before, with the conditions as they are; then
 * sets these. */
static int solve_once(frot_opening *p, int stay, int alone) {
  const frot_model *m = p->m;
  frot_state *s = p->s;
  frot_work *w = p->w;
  frot_layout l = frot_layout_of(m);
  int nc = m->n_contacts;
  double *d = s->data + l.d, *side = d + m->n_conditions;
  const double *unilateral = s->data + l.unilateral;
  frot_contact_mode *modes = (void *)(s->data + l.modes);
  memset(modes, 0, sizeof *modes * (size_t)nc);
  for (int i = 0; i < nc; i++) {
    side[i] = modes[i].side = 1;
    modes[i].closed = (signed char)!frot_has_normal(&m->contacts[i]);
  }
  if (!stay) guess(p);
  int status = solve_positions(p, side, stay);
  if (status != FROT_OK) return status;
  if (!alone) set_conditions(m, w, d, 0);
  for (int i = 0; i < nc; i++) {
    const frot_contact *contact = &m->contacts[i];
    if (!frot_has_normal(contact)) continue;
    int touches = unilateral[i] == 0 || p->use[i] ||
                  fabs(w->core.gap[i]) <= FROT_TOUCH * frot_length_size(m, w, i, p->q);
    modes[i].closed = (signed char)touches;
    p->use[i] = touches && unilateral[i] == 0 && !contact->reduced;
  }
  status = solve_speeds(p, modes);
  if (status != FROT_OK) return status;
  set_conditions(m, w, d, alone);
  return FROT_OK;
}

/* Whether all that has changed are ends that a figure is beyond; with `there`, all of them ends at
 * which the places found are to rounding, and so on both sides. */
static int only_ends(const frot_model *m, const frot_work *w, const double *d, int there) {
  for (int j = 0; j < m->n_conditions; j++) {
    if (d[j] == w->events.before[j]) continue;
    int at_end = fabs(w->core.condition[j]) <= FROT_TOUCH;
    if (m->conditions[j].contact < 0 || (there && !at_end)) return 0;
  }
  return 1;
}

/* The first condition that is not what it was, -1 where there is none. */
static int first_changed(const frot_opening *p) {
  for (int j = 0; j < p->m->n_conditions; j++)
    if (p->d[j] != p->w->events.before[j]) return j;
  return -1;
}

/* Whether conditions with which all has been found agree with what follows from them; sets them as
 * it says. */
static int agree(const frot_opening *p, int alone) {
  look_at_conditions(p, alone);
  return first_changed(p) < 0 || only_ends(p->m, p->w, p->d, 1);
}

int frot_initial_values(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                        double *v) {
  frot_layout l = frot_layout_of(m);
  frot_opening p = {.m = m, .s = s, .w = w, .t = t, .q = q, .v = v};
  p.d = s->data + l.d, p.use = w->opening.use;
  memset(s->data + l.d, 0, sizeof(double) * (size_t)l.nd);
  size_t size = sizeof(double) * (size_t)m->n_conditions;
  frot_leave_parts(&p);
  if (m->n_conditions > 0) guess(&p), look_at_guesses(&p);
  int together = m->n_conditions + ROUNDS, most = together + ONE_BY_ONE * together;
  int changed = -1, other = -1, failures = 0;
  for (int round = 0, stay = 0; round < most; round++) {
    int alone = round >= together;
    memcpy(w->events.before, p.d, size);
    int status = solve_once(&p, stay, alone);
    if (status != FROT_OK) {
      /* what has no solution under these conditions may have one under those found there */
      frot_fault told = s->fault;
      look_at_conditions(&p, alone);
      s->fault = told;
      if (++failures == ROUNDS) return status;
    }
    int last = first_changed(&p);
    if (last < 0 && (status != FROT_OK || agree(&p, alone))) return status;
    if (last < 0) last = first_changed(&p);
    if (last != changed) other = changed, changed = last;
    stay = status == FROT_OK && only_ends(m, w, p.d, 0);
    if (stay && only_ends(m, w, p.d, 1)) return status;
    frot_clear_opening(&p);
  }
  return frot_fail(s, FROT_CHATTER, t, -1, changed, other, FROT_NO_TRUTH);
}
