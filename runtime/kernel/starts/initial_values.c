#include "starts/initial_values.h"

#include <math.h>
#include <string.h>

#include "starts/closure_fault.h"
#include "assembly/closing_speeds.h"
#include "starts/start_branch.h"
#include "assembly/nearest_solution.h"
#include "guards/conditions.h"
#include "evaluation/evaluate.h"
#include "starts/multistart.h"
#include "starts/guesses.h"
#include "assembly/gauss_newton.h"
#include "assembly/start_parts.h"
#include "starts/relaxation.h"
#include "starts/contact_sides.h"
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

/* The part again where its search begins. */
static void begin_part(const frot_opening *p) {
  frot_begin_as_met(p);
  memcpy(p->x, p->w->opening.begin, sizeof(double) * (size_t)p->n_own);
  frot_begin_blocks(p);
}

/* Take no contact of the part for an equation. */
static void leave_contacts(const frot_opening *p) {
  for (int i = 0; i < p->part->n_contacts; i++) p->use[p->part->contacts[i]] = 0;
}

/* Whether the statements on the part hold where the search begins, with the sides of that place:
 * then nothing is to be moved. */
static int hold_already(frot_opening *p) {
  if (frot_evaluate_statements(p) != FROT_OK) return 0;
  for (int i = 0; i < p->n; i++)
    if (!(fabs(p->w->relations.residual[i]) <= FROT_TOUCH * frot_statement_size(p, i))) return 0;
  return p->n_rows > 0;
}

/* The statements alone show on which side of its line each point is meant to be. A stated gap needs
 * a side before: that of the guess if the statements hold there, else the natural one or, if the
 * statements contradict that, the one of the guess. */
static int solve_statements(frot_opening *p, double *side) {
  frot_state *s = p->s;
  leave_contacts(p);
  int status = frot_look_at_part(p);
  if (status != FROT_OK) return frot_no_number(p, status);
  frot_choose_sides(p, side, 0);
  if (!hold_already(p)) frot_choose_sides(p, side, 1);
  status = frot_solve_widely(p);
  if (status != FROT_INITIAL && status != FROT_ALGEBRAIC) return status;
  frot_fault first = s->fault;
  begin_part(p);
  int again = frot_look_at_part(p) == FROT_OK && frot_choose_sides(p, side, 0) > 0 &&
              frot_solve_widely(p) == FROT_OK;
  s->fault = again ? frot_no_fault(p->t) : first;
  s->phase = again ? FROT_CLEARED : FROT_FAULTED;
  return again ? FROT_OK : status;
}

/* From a place where the statements hold to one where the liaisons do too; chooses the sides of the
 * contacts. */
static int put_together(frot_opening *p, double *side) {
  frot_choose_sides(p, side, 0);
  frot_take_liaisons(p);
  /* what cannot part may move a point over a line: its side is the one where it comes to be */
  int status = frot_solve_widely(p);
  if (status != FROT_OK) return status;
  frot_choose_sides(p, side, 0);
  return frot_keep_outside(p);
}

/* Keep coordinates and unknowns of blocks, or take them again. */
static void copy_place(const frot_opening *p, double *kept, int again) {
  size_t bytes = sizeof(double) * (size_t)p->n_own;
  memcpy(again ? p->x : kept, again ? kept : p->x, bytes);
  again ? frot_return_blocks(p, kept + p->n_own) : frot_keep_blocks(p, kept + p->n_own);
}

/* The same with the sides of the contacts and which of them are equations. */
static void keep_place(const frot_opening *p, double *side, int again) {
  frot_opening_work *w = &p->w->opening;
  double *kept = w->first + p->n_own + p->part->ny;
  copy_place(p, w->first, again);
  for (int k = 0; k < p->part->n_contacts; k++) {
    int i = p->part->contacts[k];
    if (again)
      side[i] = kept[k], p->use[i] = w->first_use[k];
    else
      kept[k] = side[i], w->first_use[k] = p->use[i];
  }
}

/* Put the place of the part outside of what it has come to be inside of since the sides were
 * chosen, on the sides where it is now. */
static int stay_outside(frot_opening *p, double *side) {
  if (frot_look_at_part(p) != FROT_OK) return 0;
  frot_choose_sides(p, side, 0);
  return frot_keep_outside(p) == FROT_OK;
}

/* From a place that meets the guesses to the one that is nearest to the beginning and does too. */
static int meet_nearest(frot_opening *p, double *side) {
  frot_begin_as_met(p);
  p->guessed = 1;
  int met = frot_note_beginning(p) == FROT_OK && frot_solve_nearest(p) == FROT_OK &&
            frot_come_closest(p) == FROT_OK;
  p->guessed = 0;
  return met && stay_outside(p, side);
}

/* Whether another place of the part, put together with its own sides, misses its guesses by far
 * less than `missed`: then the nearest of that kind to where the search began. */
static int put_elsewhere(frot_opening *p, double *side, double missed) {
  frot_take_liaisons(p);
  int found = frot_find_other(p);
  leave_contacts(p);
  if (!found || frot_look_at_part(p) != FROT_OK || put_together(p, side) != FROT_OK) return 0;
  double *best = p->w->opening.other, *nearest = best + p->n_own + p->part->ny;
  double other = frot_least_missed(p);
  if (!(other < sqrt(FROT_GUESS_LESS) * missed)) return 0;
  if (other == 0) return meet_nearest(p, side);
  copy_place(p, best, 0);
  frot_begin_as_met(p);
  int status = frot_note_beginning(p) == FROT_OK ? frot_come_closest(p) : FROT_NAN;
  copy_place(p, nearest, 0);
  /* the way to what is nearer may lead to a place of the first kind */
  int same = status == FROT_OK && !(other < sqrt(FROT_GUESS_LESS) * frot_least_missed(p));
  frot_clear_opening(p);
  copy_place(p, same ? nearest : best, 1);
  return frot_solve_nearest(p) == FROT_OK && stay_outside(p, side);
}

/* Where the place of the part that is found misses the guesses, another one if that misses them by
 * far less: what goes together in several ways is meant so. `status` is that of the place. */
static int look_elsewhere(frot_opening *p, double *side, int status) {
  if (!frot_has_guesses(p) || (status == FROT_OK && frot_are_guesses_met(p))) return status;
  frot_fault fault = p->s->fault;
  keep_place(p, side, 0);
  double missed = status == FROT_OK ? frot_least_missed(p) : INFINITY;
  /* the way on from it may have led to where they are met */
  int found = missed > 0 ? put_elsewhere(p, side, missed) : meet_nearest(p, side);
  if (found) return FROT_OK;
  frot_clear_opening(p);
  keep_place(p, side, 1);
  int kept = frot_look_at_part(p);
  if (status == FROT_OK && kept != FROT_OK) return frot_no_number(p, kept);
  if (status != FROT_OK) p->s->fault = fault, p->s->phase = FROT_FAULTED;
  return status;
}

/* Coordinates of the part: those that follow from the beginning or others that the guesses mean
 * rather. */
static int solve_part(frot_opening *p, double *side) {
  int status = solve_statements(p, side);
  frot_fault fault = p->s->fault;
  if (status == FROT_INITIAL && p->wide) { /* it may be the liaisons that tell how they are met */
    frot_clear_opening(p);
    begin_part(p);
    int found = put_together(p, side) == FROT_OK;
    p->s->fault = found ? p->s->fault : fault;
    status = found ? FROT_OK : status;
  } else if (status == FROT_OK) {
    status = put_together(p, side);
  }
  int several = status == FROT_OK || status == FROT_INITIAL || status == FROT_ALGEBRAIC;
  return several ? look_elsewhere(p, side, status) : status;
}

/* The coordinates of a part, from where its search begins or, to `stay`, from where they are: near
 * there, or where the part comes to rest, or widely. */
static int look_for_places(frot_opening *p, double *side, int stay) {
  if (!stay) begin_part(p);
  int status = solve_part(p, side);
  if (status == FROT_INITIAL && frot_balance_of(p) != FROT_PLAIN) {
    frot_fault fault = p->s->fault;
    frot_clear_opening(p);
    begin_part(p);
    status = frot_relax(p) ? solve_part(p, side) : FROT_INITIAL;
    if (status != FROT_OK) p->s->fault = fault, p->s->phase = FROT_FAULTED, status = FROT_INITIAL;
  }
  if (status != FROT_INITIAL) return status;
  frot_clear_opening(p);
  begin_part(p);
  p->wide = 1;
  status = solve_part(p, side);
  p->wide = 0;
  return status;
}

/* The coordinates of a part, with all statements or without those that are optional. */
static int place_part(frot_opening *p, double *side, int stay) {
  int status = look_for_places(p, side, stay);
  if (status == FROT_INITIAL && frot_balance_of(p) == FROT_OPTIONAL) {
    frot_clear_opening(p);
    p->fewest = 1;
    status = look_for_places(p, side, 0);
    p->fewest = 0;
  }
  if (status == FROT_INITIAL && p->s->fault.item < 0) frot_tell_apart(p);
  return status;
}

/* All coordinates, part by part: what stands beside a part does nothing to it. */
static int solve_positions(frot_opening *p, double *side, int stay) {
  int status = FROT_OK;
  p->velocity = 0;
  for (int i = 0; i < p->m->n_parts && status == FROT_OK; i++) {
    const frot_part *part = &p->m->parts[i];
    if (part->n_stated + part->n_contacts + part->n_guessed == 0) continue;
    frot_take_part(p, part);
    status = place_part(p, side, stay);
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
