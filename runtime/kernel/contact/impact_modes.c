/* What slips, sticks and parts within an impact: the problem of contact, with impulses in the place
 * of reactions and changes of speeds in that of accelerations. */
#include <math.h>
#include <string.h>

#include "contact/impact_parts.h"
#include "numerics/dense.h"

#define TOLERANCE 1e-12
#define SWEEPS 30
#define MANY_SWEEPS 400
/* Part of the terms of a rate from which on it is more than rounding. */
#define MOVES 1e-9

double frot_impact_slip(const frot_impact_block *block, const double *u, double d[3]) {
  double size = frot_length(u + block->at, block->n);
  for (int i = 0; i < block->n && d; i++) d[i] = size > 0 ? u[block->at + i] / size : 0;
  return size;
}

double frot_impact_scale(const frot_impact *f, const frot_impact_block *block) {
  return frot_length(f->scale + block->at, block->n);
}

int frot_sticks(const frot_impact *f, int k) {
  const frot_impact_block *block = &f->given->blocks[k];
  return f->parts[k].state == FROT_PART_STICKS &&
         frot_impact_slip(block, f->u, NULL) <= FROT_IMPACT_ZERO * frot_impact_scale(f, block);
}

/* The contact whose impulse bounds an element, or -1. */
static int owner_of(const frot_impact_problem *p, const frot_impact_block *element) {
  if (element->n_bounding != 1) return -1;
  for (int k = 0; k < p->n_blocks; k++)
    if (p->blocks[k].rule == FROT_ROW_PRESSES && p->blocks[k].at == element->bounding) return k;
  return -1;
}

/* An element in its state, beside its contact: friction of a contact that springs press is bounded
 * by a known force. */
static void set_element(frot_impact *f, int k, const double *u) {
  const frot_impact_block *given = &f->given->blocks[k];
  const frot_impact_part *part = &f->parts[k];
  frot_contact_block *now = &f->now[k];
  int owner = owner_of(f->given, given), rests = part->state == FROT_PART_STICKS;
  now->ratio = rests && !part->departs ? given->resting : given->slipping;
  now->bounding = given->bounding, now->n_bounding = given->n_bounding;
  if (owner >= 0 && f->parts[owner].state != FROT_PART_RIGID) {
    int driven = frot_is_driven(&f->parts[owner]);
    now->ratio = driven ? now->ratio * f->force[owner] : 0, now->n_bounding = 0;
    if (!driven) now->rule = FROT_ROW_SLIDES;
  }
  if (rests || now->rule != FROT_ROW_BALL) return;
  now->rule = FROT_ROW_SLIDES;
  if (!(frot_impact_slip(given, u, now->d) > 0)) memcpy(now->d, part->d, sizeof now->d);
}

int frot_impact_rates(frot_impact *f, const double *u) {
  const frot_impact_problem *p = f->given;
  memset(f->b, 0, sizeof(double) * (size_t)p->rows);
  for (int k = 0; k < p->n_blocks; k++) {
    const frot_impact_block *one = &p->blocks[k];
    f->now[k] = (frot_contact_block){.rule = one->rule, .at = one->at, .n = one->n};
    if (one->rule == FROT_ROW_BALL) set_element(f, k, u);
    if (one->rule != FROT_ROW_PRESSES || f->parts[k].state == FROT_PART_RIGID) continue;
    f->now[k].rule = FROT_ROW_ABSENT;
    for (int i = 0; i < p->rows && frot_is_driven(&f->parts[k]); i++)
      f->b[i] += p->w[i * p->rows + one->at] * f->force[k];
  }
  frot_contact_equations equations = {p->rows, p->n_blocks, p->w, f->b, f->now, TOLERANCE};
  int failed = 1;
  for (int sweeps = SWEEPS; failed && sweeps <= MANY_SWEEPS; sweeps += MANY_SWEEPS - SWEEPS) {
    memset(f->x, 0, sizeof(double) * (size_t)p->rows);
    failed = frot_contact_newton(&equations, sweeps, f->x, f->a, f->newton, f->pivot);
  }
  for (int k = 0; k < p->n_blocks && !failed; k++) {
    double *x = &f->x[p->blocks[k].at];
    if (p->blocks[k].rule == FROT_ROW_PRESSES)
      *x = frot_is_driven(&f->parts[k]) ? f->force[k] : fmax(*x, 0);
  }
  return failed;
}

/* Size of the terms that the rates of a block are made of. */
static double terms_of(const frot_impact *f, const frot_impact_block *block) {
  double size = 0;
  for (int i = block->at; i < block->at + block->n; i++)
    for (int j = 0; j < f->given->rows; j++)
      size += fabs(f->given->w[i * f->given->rows + j] * f->x[j]);
  return size;
}

/* Whether an element at rest begins to slip: its friction is at its bound, and its slip grows. */
static int begins_to_slip(const frot_impact *f, int k) {
  const frot_impact_block *block = &f->given->blocks[k];
  double size = frot_length(f->a + block->at, block->n);
  double reaction = frot_length(f->x + block->at, block->n);
  return f->now[k].rule == FROT_ROW_BALL && size > MOVES * terms_of(f, block) &&
         reaction >= (1 - MOVES) * frot_contact_bound(&f->now[k], f->x);
}

/* Change what the rates found change. Returns whether anything has. */
static int change_states(frot_impact *f) {
  int changed = 0;
  for (int k = 0; k < f->given->n_blocks; k++) {
    const frot_impact_block *block = &f->given->blocks[k];
    frot_impact_part *part = &f->parts[k];
    double rate = f->a[block->at];
    if (part->state == FROT_PART_OPEN && f->u[block->at] == 0 &&
        rate < -MOVES * terms_of(f, block)) {
      part->state = FROT_PART_RIGID, changed = 1;
      if (block->restitution > 0) frot_begin_compression(f, k);
    } else if (part->state == FROT_PART_STICKS && !part->departs && begins_to_slip(f, k)) {
      part->departs = changed = 1;
    }
  }
  return changed;
}

int frot_decide_impact(frot_impact *f) {
  for (int k = 0; k < f->given->n_blocks; k++) {
    f->parts[k].departs = 0;
    if (f->parts[k].state == FROT_PART_STICKS && !frot_sticks(f, k))
      f->parts[k].state = FROT_PART_SLIPS;
  }
  int rounds = 2 * f->given->n_blocks + 2;
  do {
    if (frot_impact_rates(f, f->u)) return 1;
  } while (change_states(f) && --rounds > 0);
  for (int k = 0; k < f->given->n_blocks; k++) {
    const frot_impact_block *block = &f->given->blocks[k];
    frot_impact_part *part = &f->parts[k];
    if (part->state == FROT_PART_RIGID && !(f->x[block->at] > 0) &&
        f->a[block->at] > MOVES * terms_of(f, block))
      part->state = FROT_PART_OPEN;
    if (part->state != FROT_PART_STICKS || !begins_to_slip(f, k)) continue;
    frot_impact_slip(block, f->a, part->d);
    part->state = FROT_PART_SLIPS;
  }
  return 0;
}
