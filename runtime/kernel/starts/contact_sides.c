#include "starts/contact_sides.h"

#include <string.h>

#include "evaluation/evaluate.h"
#include "starts/multistart.h"
#include "model/island_calls.h"
#include "assembly/start_parts.h"
#include "numerics/tolerances.h"

void frot_look_at_sides(const frot_opening *p) {
  frot_opening_work *w = &p->w->opening;
  frot_call_sides(p->s, p->w, p->part, p->t, p->q, p->v, p->d, w->witness, w->reach);
}

static int sign_beyond(double x, double rounding) {
  return x > rounding ? 1 : x < -rounding ? -1 : 0;
}

int frot_choose_sides(const frot_opening *p, double *side, int natural) {
  const frot_model *m = p->m;
  const double *unilateral = p->s->data + p->w->layout.unilateral;
  int changes = 0;
  frot_look_at_sides(p);
  for (int k = 0; k < p->part->n_contacts; k++) {
    int i = p->part->contacts[k];
    if (!frot_has_normal(&m->contacts[i]) || (p->use[i] && unilateral[i] != 0)) continue;
    const double *witness = p->w->opening.witness + 3 * i;
    double rounding = FROT_TOUCH * frot_length_size(m, p->w, i, p->q);
    int sign = natural ? 0 : sign_beyond(witness[0], rounding);
    if (sign == 0) sign = sign_beyond(witness[1], FROT_TOUCH);
    if (sign == 0) sign = sign_beyond(witness[2], rounding);
    if (sign == 0) sign = 1;
    changes += sign != (int)side[i];
    side[i] = sign;
  }
  return changes;
}

/* Whether contact i of the scene is none of the equations, and the part is inside of it. */
static int is_inside(const frot_opening *p, int i) {
  const frot_model *m = p->m;
  const frot_work *w = p->w;
  if (p->use[i] || m->contacts[i].reduced || !frot_has_normal(&m->contacts[i])) return 0;
  return w->core.gap[i] < -FROT_TOUCH * frot_length_size(m, w, i, p->q);
}

/* Keep the place of the part, or take it again. */
static void copy_place(const frot_opening *p, double *kept, int again) {
  size_t bytes = sizeof(double) * (size_t)p->n_own;
  memcpy(again ? p->x : kept, again ? kept : p->x, bytes);
  again ? frot_return_blocks(p, kept + p->n_own) : frot_keep_blocks(p, kept + p->n_own);
}

/* Take for equations what the part is inside of; returns how many these are. */
static int add_inside(const frot_opening *p) {
  int added = 0;
  frot_look_at_sides(p);
  for (int k = 0; k < p->part->n_contacts; k++)
    if (is_inside(p, p->part->contacts[k])) p->use[p->part->contacts[k]] = 1, added++;
  return added;
}

/* Whether contact i is an equation that may be left out. */
static int may_leave(const frot_opening *p, int i) {
  const double *unilateral = p->s->data + p->w->layout.unilateral;
  return p->use[i] && unilateral[i] != 0 && !p->m->contacts[i].reduced &&
         frot_has_normal(&p->m->contacts[i]);
}

/* Whether the part, put together from `start` without the equation of contact i, is outside of it
 * and inside of no other: it was nothing but held there. */
static int is_held(frot_opening *p, int i, double *start) {
  const frot_part *part = p->part;
  p->use[i] = 0;
  copy_place(p, start, 1);
  int found = frot_solve_widely(p) == FROT_OK, inside = 0;
  if (!found) frot_clear_opening(p);
  frot_look_at_sides(p);
  for (int k = 0; k < part->n_contacts; k++) inside |= is_inside(p, part->contacts[k]);
  double touch = FROT_TOUCH * frot_length_size(p->m, p->w, i, p->q);
  if (found && !inside && p->w->core.gap[i] > touch) return 1;
  p->use[i] = 1;
  return 0;
}

/* Leave out the contacts that the part is only held at: the least change from `start` needs none of
 * them. Returns whether there were any. */
static int leave_held(frot_opening *p, double *start) {
  const frot_part *part = p->part;
  int equations = 0, left = 0;
  for (int k = 0; k < part->n_contacts; k++) equations += may_leave(p, part->contacts[k]);
  for (int k = 0; k < part->n_contacts && equations > 1; k++) {
    int i = part->contacts[k];
    if (!may_leave(p, i) || !is_held(p, i, start)) continue;
    equations--, left = 1, k = -1;
  }
  return left;
}

int frot_keep_outside(frot_opening *p) {
  double *start = p->w->opening.outside, *found = start + p->n_own + p->part->ny;
  copy_place(p, start, 0);
  do {
    int status = frot_solve_widely(p);
    if (status != FROT_OK) return status;
  } while (add_inside(p));
  copy_place(p, found, 0);
  int left = leave_held(p, start);
  copy_place(p, left ? start : found, 1);
  return left ? frot_solve_widely(p) : frot_look_at_part(p);
}
