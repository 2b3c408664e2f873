#include "starts/part_places.h"

#include <math.h>
#include <string.h>

#include "assembly/gauss_newton.h"
#include "assembly/nearest_solution.h"
#include "assembly/start_equations.h"
#include "assembly/start_parts.h"
#include "numerics/tolerances.h"
#include "starts/closure_fault.h"
#include "starts/contact_sides.h"
#include "starts/guesses.h"
#include "starts/multistart.h"
#include "starts/relaxation.h"

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
int frot_place_part(frot_opening *p, double *side, int stay) {
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
