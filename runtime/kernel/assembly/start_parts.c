#include "assembly/start_parts.h"

#include <string.h>

#include "model/sleeping.h"
#include "evaluation/evaluate.h"
#include "model/island_calls.h"

static const frot_part nothing = {0};

/* Which speed each change is a displacement of, or none (unknowns.h), and the orientations of the
 * part. */
static void name_changes(frot_opening *p) {
  const frot_model *m = p->m;
  const frot_part *part = p->part;
  frot_opening_work *w = &p->w->opening;
  const int *list = p->velocity ? part->reads.v : part->reads.q;
  for (int k = 0; k < part->n_unknowns; k++) {
    w->number[list[k]] = k;
    w->behind[k] = p->velocity ? list[k] : m->q_speed[list[k]];
  }
  for (int i = 0; i < part->n_turns; i++) {
    frot_turn turn = m->turns[part->turns[i]];
    turn.at = w->number[turn.at];
    w->turns[i] = turn;
    for (int k = 0; k < 3; k++) w->behind[turn.at + 1 + k] = turn.speed[k];
  }
}

/* The unknowns, first the ones that have a speed. */
static void put_in_order(frot_opening *p) {
  frot_opening_work *w = &p->w->opening;
  int count = p->part->n_unknowns;
  p->n_own = 0;
  for (int k = 0; k < count; k++)
    if (w->behind[k] >= 0) w->own[p->n_own++] = k;
  p->attached = p->n_own;
  for (int k = 0; k < count; k++)
    if (w->behind[k] < 0) w->own[p->n_own++] = k;
}

void frot_take_part(frot_opening *p, const frot_part *part) {
  frot_opening_work *w = &p->w->opening;
  const double *all = p->velocity ? p->v : p->q;
  const int *list = p->velocity ? part->reads.v : part->reads.q;
  p->part = part, p->x = w->x, p->n = p->n_rows = 0;
  for (int k = 0; k < part->n_unknowns; k++) p->x[k] = all[list[k]];
  name_changes(p);
  put_in_order(p);
  p->w->blocks.some = part->blocks, p->w->blocks.n_some = part->n_blocks;
  frot_restrict_to_islands(p->w, part->islands, part->n_islands, part->groups, part->n_groups);
}

void frot_leave_parts(frot_opening *p) {
  p->part = &nothing, p->x = p->w->opening.x, p->n = p->n_rows = p->n_own = p->attached = 0;
  p->w->blocks.some = NULL;
  frot_leave_sleep(p->w);
}

void frot_put(const frot_opening *p) {
  double *all = p->velocity ? p->v : p->q;
  const int *list = p->velocity ? p->part->reads.v : p->part->reads.q;
  for (int k = 0; k < p->part->n_unknowns; k++) all[list[k]] = p->x[k];
}

int frot_look_at_part(const frot_opening *p) {
  frot_put(p);
  return frot_kinematics(p->m, p->s, p->w, p->t, p->q, p->v, p->d);
}

void frot_keep_blocks(const frot_opening *p, double *kept) {
  for (int k = 0; k < p->part->ny; k++) kept[k] = p->w->blocks.y[p->part->y[k]];
}

void frot_return_blocks(const frot_opening *p, const double *kept) {
  for (int k = 0; k < p->part->ny; k++) p->w->blocks.y[p->part->y[k]] = kept[k];
}

void frot_evaluate_part(const frot_opening *p, const frot_callable *function) {
  frot_call_part(p->s, p->w, p->part, function, &p->t, p->q, p->v, p->d);
}
