/* What slips, sticks and parts within an impact: the problem of contact, with impulses in the place
 * of reactions and changes of speeds in that of accelerations. */
#include <math.h>
#include <string.h>

#include "contact/impact_parts.h"
#include "numerics/dense.h"

/* Parts of its terms by which a rate may be missed, and sweeps before Newton's method. */
#define EXACT 1e-12
#define SWEEPS 30
/* Other attempts. Rows that depend on each other but for how flat bodies lie contradict each other
 * by more than rounding. */
static const struct {
  double tolerance;
  int sweeps;
} attempts[] = {{EXACT, SWEEPS}, {EXACT, 400}, {1e-8, SWEEPS}, {1e-8, 400}};
/* Part of the terms of a rate from which on it is more than that. */
#define MOVES 1e-8

/* The square root of W of a row: the speed that it has by a unit of energy, but for a factor. */
static double root_of(const frot_impact_problem *p, int row) {
  return sqrt(fmax(p->w[row * (p->rows + 1)], 0));
}

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
         frot_impact_slip(block, f->u, NULL) <=
             frot_impact_zero(block->n) * frot_impact_scale(f, block);
}

/* The contact whose impulse bounds an element, or -1. */
static int owner_of(const frot_impact_problem *p, const frot_impact_block *element) {
  if (element->n_bounding != 1) return -1;
  for (int k = 0; k < p->n_blocks; k++)
    if (p->blocks[k].rule == FROT_ROW_PRESSES && p->blocks[k].at == element->bounding) return k;
  return -1;
}

int frot_can_rub(const frot_impact *f, int k) {
  int owner = owner_of(f->given, &f->given->blocks[k]);
  return owner < 0 || f->parts[owner].state != FROT_PART_OPEN;
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
  memcpy(now->norm, given->norm, sizeof now->norm);
  if (owner >= 0 && f->parts[owner].state != FROT_PART_RIGID) {
    int driven = frot_is_driven(&f->parts[owner]);
    now->ratio = driven ? now->ratio * f->force[owner] : 0, now->n_bounding = 0;
    if (!driven) now->rule = FROT_ROW_SLIDES;
  }
  if (rests || now->rule != FROT_ROW_BALL || f->implicit) return;
  now->rule = FROT_ROW_SLIDES;
  if (given->n == 1 || !(frot_impact_slip(given, u, now->d) > 0))
    memcpy(now->d, part->d, sizeof now->d);
}

void frot_impact_blocks(frot_impact *f, const double *u) {
  const frot_impact_problem *p = f->given;
  double terms = 0;
  memset(f->b, 0, sizeof(double) * (size_t)p->rows);
  for (int k = 0; k < p->n_blocks; k++) {
    const frot_impact_block *one = &p->blocks[k];
    f->now[k] = (frot_contact_block){.rule = one->rule, .at = one->at, .n = one->n};
    if (one->rule == FROT_ROW_BALL) set_element(f, k, u);
    if (one->rule != FROT_ROW_PRESSES || f->parts[k].state == FROT_PART_RIGID) continue;
    f->now[k].rule = FROT_ROW_ABSENT;
    for (int i = 0; i < p->rows && frot_is_driven(&f->parts[k]); i++)
      f->b[i] += p->w[i * p->rows + one->at] * f->force[k];
    if (frot_is_driven(&f->parts[k])) terms += root_of(p, one->at) * fabs(f->force[k]);
  }
  for (int i = 0; i < p->rows; i++) f->terms[i] = root_of(p, i) * terms;
}

int frot_impact_rates(frot_impact *f, const double *u) {
  frot_impact_blocks(f, u);
  memset(f->x, 0, sizeof(double) * (size_t)f->given->rows);
  return frot_impact_solve(f);
}

int frot_impact_solve(frot_impact *f) {
  const frot_impact_problem *p = f->given;
  /* first contacts that give a little share what is redundant; then rigid ones, from there */
  frot_contact_equations equations = {p->rows, p->n_blocks,         f->soft, f->b,
                                      f->now,  FROT_GIVE_TOLERANCE, f->terms};
  int failed = frot_contact_newton(&equations, SWEEPS, f->x, f->a, f->newton, f->pivot);
  equations.w = p->w, equations.tolerance = EXACT;
  if (!failed) failed = frot_contact_newton(&equations, 0, f->x, f->a, f->newton, f->pivot);
  for (size_t k = 0; failed && k < sizeof attempts / sizeof *attempts; k++) {
    memset(f->x, 0, sizeof(double) * (size_t)p->rows);
    equations.tolerance = attempts[k].tolerance;
    failed = frot_contact_newton(&equations, attempts[k].sweeps, f->x, f->a, f->newton, f->pivot);
  }
  double least = EXACT * frot_length(f->x, p->rows);
  for (int k = 0; k < p->n_blocks && !failed; k++) {
    double *x = &f->x[p->blocks[k].at];
    if (p->blocks[k].rule == FROT_ROW_PRESSES)
      *x = frot_is_driven(&f->parts[k]) ? f->force[k] : *x > least ? *x : 0;
  }
  return failed;
}

/* Size of the terms that the rate of a block is made of, each as large as its impulse can make it:
 * entries of W that are zero but for rounding say nothing. */
static double terms_of(const frot_impact *f, const frot_impact_block *block) {
  double all = 0, size = 0;
  for (int j = 0; j < f->given->rows; j++) all += root_of(f->given, j) * fabs(f->x[j]);
  for (int i = block->at; i < block->at + block->n; i++) size += root_of(f->given, i) * all;
  return size;
}

double frot_impact_rate_of(const frot_impact *f, const frot_impact_block *block) {
  double rate = f->a[block->at];
  return fabs(rate) > EXACT * terms_of(f, block) ? rate : 0;
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
    double rate = f->a[block->at], *u = &f->u[block->at];
    int parted = block->rule == FROT_ROW_PRESSES && part->state == FROT_PART_OPEN;
    int is_zero = *u <= 0 && *u >= -frot_impact_zero(1) * f->scale[block->at];
    if (parted && is_zero && rate < -MOVES * terms_of(f, block)) {
      part->state = FROT_PART_RIGID, *u = 0, changed = 1;
      if (frot_gives_back(f, k)) frot_begin_compression(f, k);
    } else if (parted && *u < 0 && !is_zero) { /* it has been missed */
      part->state = FROT_PART_LOADING, part->stored = part->compressed = 0, changed = 1;
      part->mark = f->p[block->at];
    } else if (part->state == FROT_PART_STICKS && !part->departs && begins_to_slip(f, k)) {
      part->departs = changed = 1;
    }
  }
  return changed;
}

/* Whether an element has come so near to zero slip that it has none. */
static int is_small(const frot_impact *f, int k) {
  const frot_impact_block *block = &f->given->blocks[k];
  double slip = frot_impact_slip(block, f->u, NULL);
  return f->parts[k].state == FROT_PART_SLIPS && slip > 0 &&
         slip <= frot_impact_zero(block->n) * frot_impact_scale(f, block);
}

int frot_decide_impact(frot_impact *f) {
  for (int k = 0; k < f->given->n_blocks; k++) {
    f->parts[k].departs = 0;
    if (f->parts[k].state == FROT_PART_STICKS && !frot_sticks(f, k))
      f->parts[k].state = FROT_PART_SLIPS;
    if (is_small(f, k)) frot_put_at_rest(f, k);
    /* along one row the sense stays until the slip has ended */
    if (f->parts[k].state == FROT_PART_SLIPS && f->u[f->given->blocks[k].at] != 0)
      frot_impact_slip(&f->given->blocks[k], f->u, f->parts[k].d);
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
