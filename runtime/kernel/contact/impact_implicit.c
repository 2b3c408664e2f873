/* A phase of an impact by springs where slips are stiff: several of them vanish together, or begin
 * together as slowly as friction lets them.
 *
 * One step of the implicit method of Euler is a contact problem for the speeds at its end,
 * u1 = u0 + h W x, in which friction opposes u1: what rests and what slips is a part of its
 * solution. Steps of h/1, h/2, h/3, ... are extrapolated to h = 0 (P. Deuflhard 1985; E. Hairer, G.
 * Wanner, Solving Ordinary Differential Equations II, sect. IV.9). */
#include <math.h>
#include <string.h>

#include "contact/impact_parts.h"
#include "numerics/dense.h"

#define TOLERANCE 1e-11
#define COLUMNS FROT_IMPLICIT_COLUMNS
#define MOST_STEPS 4000 /* of an impact */
#define FIRST_STEP 0.02 /* over the time in which the stiffest contact turns by one radian */
#define LEAST_STEP 1e-13
#define BREAKING 2e-8 /* the step in which a rest may end by its coefficient */
#define SHORTER 0.3
#define LONGER 2.5
#define LEAST_COLUMNS 4
#define FEW_COLUMNS 6 /* with so many a step may grow */
#define LOCATING 60
#define LOCATED 1e-12
/* Part of its size by which rounding decides on a slip that is stiff. */
#define SMALL 1e-9

/* The contact problem of a step h from the state y: its blocks in f->now, its right side in f->b.
 */
static void state_problem(frot_impact *f, double h, const double *y) {
  const frot_impact_problem *p = f->given;
  frot_impact_blocks(f, y);
  for (int k = 0; k < p->n_blocks; k++) {
    const frot_impact_block *one = &p->blocks[k];
    if (one->rule == FROT_ROW_READS || one->rule == FROT_ROW_HELD) continue;
    for (int i = one->at; i < one->at + one->n; i++)
      f->b[i] += y[i] / h, f->terms[i] += fabs(y[i]) / h;
  }
}

/* y <- the state after one step of Euler. Returns 1 where there is none. */
static int euler(frot_impact *f, double h, double *y) {
  const frot_impact_problem *p = f->given;
  int rows = p->rows;
  for (int k = 0; k < p->n_blocks; k++) f->force[k] = frot_impact_force(f, y, k);
  state_problem(f, h, y);
  if (frot_impact_solve(f)) return 1;
  for (int k = 0; k < p->n_blocks; k++) {
    const frot_impact_block *block = &p->blocks[k];
    double *force = y + 2 * rows + k, *lost = force + p->n_blocks;
    for (int i = block->at; i < block->at + block->n; i++) {
      int acts = block->rule != FROT_ROW_READS, moves = acts && block->rule != FROT_ROW_HELD;
      double after = moves ? h * f->a[i] : y[i];
      if (acts) *lost -= 0.5 * h * f->x[i] * (y[i] + after);
      y[i] = after, y[rows + i] += h * f->x[i];
    }
    *force += h * frot_impact_force_rate(f, y, k);
  }
  return 0;
}

/* The largest difference of two states over the sizes of speeds and forces. */
static double difference(const frot_impact *f, const double *y, const double *z, double force) {
  const frot_impact_problem *p = f->given;
  double worst = 0;
  for (int i = 0; i < p->rows; i++)
    if (f->scale[i] > 0) worst = fmax(worst, fabs(y[i] - z[i]) / f->scale[i]);
  for (int k = 2 * p->rows; k < 2 * p->rows + p->n_blocks && force > 0; k++)
    worst = fmax(worst, fabs(y[k] - z[k]) / force);
  return isfinite(worst) ? worst : INFINITY;
}

/* y1 <- the state after the step h from y0, extrapolated in the table (COLUMNS states) until its
 * error is below the tolerance; *columns: how many it took. Returns 1 where a step of Euler has no
 * solution. */
static int extrapolate(frot_impact *f, double h, const double *y0, double *y1, double *table,
                       int *columns, double *error) {
  int n = frot_impact_state_size(f);
  double force = frot_impact_size_of_forces(f, y0);
  *error = INFINITY;
  for (int j = 0; j < COLUMNS && !(j >= LEAST_COLUMNS && *error <= TOLERANCE); j++) {
    memcpy(y1, y0, sizeof(double) * (size_t)n);
    for (int i = 0; i <= j; i++)
      if (euler(f, h / (j + 1), y1)) return 1;
    for (int k = 1; k <= j; k++) {
      double *last = table + (k - 1) * n, ratio = (double)(j + 1) / (j + 1 - k) - 1;
      for (int c = 0; c < n; c++) {
        double better = y1[c] + (y1[c] - last[c]) / ratio;
        last[c] = y1[c], y1[c] = better;
      }
    }
    memcpy(table + j * n, y1, sizeof(double) * (size_t)n);
    if (j > 0) *error = difference(f, y1, table + (j - 1) * n, force);
    *columns = j + 1;
  }
  return 0;
}

/* The first contact whose spring, or gap, changes at the state y: what is positive until then, over
 * its size, is *slack. -1 where none does. */
static int first_change(const frot_impact *f, const double *from, const double *y, double *slack) {
  int first = -1;
  *slack = 0;
  for (int k = 0; k < f->given->n_blocks; k++) {
    if (f->given->blocks[k].rule != FROT_ROW_PRESSES) continue;
    double own = frot_impact_slack(f, k, from, y);
    if (own <= *slack) *slack = own, first = k;
  }
  return first;
}

/* Put elements to rest whose slip is zero, or smaller than a part of its size; others slip. */
static void sort_slips(frot_impact *f, double small) {
  for (int k = 0; k < f->given->n_blocks; k++) {
    const frot_impact_block *block = &f->given->blocks[k];
    frot_impact_part *part = &f->parts[k];
    if (block->rule != FROT_ROW_BALL) continue;
    double slip = frot_impact_slip(block, f->u, NULL);
    int rests = slip <= fmax(small, frot_impact_zero(block->n)) * frot_impact_scale(f, block);
    if (rests != (part->state == FROT_PART_STICKS)) f->phases++;
    part->state = rests ? FROT_PART_STICKS : FROT_PART_SLIPS, part->departs = 0;
    if (!rests) frot_impact_slip(block, f->u, part->d);
  }
}

/* Take the state y over, with what rests and what slips there. */
static void accept(frot_impact *f, const double *y) {
  const frot_impact_problem *p = f->given;
  frot_accept_impact(f, y);
  for (int k = 0; k < p->n_blocks; k++) {
    const frot_impact_block *block = &p->blocks[k];
    frot_impact_part *part = &f->parts[k];
    double size = frot_impact_scale(f, block);
    if (part->state == FROT_PART_RIGID && f->u[block->at] > frot_impact_zero(1) * size)
      part->state = FROT_PART_OPEN;
  }
  sort_slips(f, 0);
  frot_bring_to_rest(f, 0);
}

/* Whether an element at rest whose coefficient falls when it slips has begun to. */
static int breaks_away(const frot_impact *f, const double *y) {
  for (int k = 0; k < f->given->n_blocks; k++) {
    const frot_impact_block *block = &f->given->blocks[k];
    if (block->rule != FROT_ROW_BALL || f->parts[k].state != FROT_PART_STICKS) continue;
    if (block->resting > block->slipping &&
        frot_impact_slip(block, y, NULL) > frot_impact_zero(block->n) * frot_impact_scale(f, block))
      return 1;
  }
  return 0;
}

/* Contacts without spring that nothing keeps from closing are pressed as springs. Returns whether
 * there are any. */
static int press_all(frot_impact *f) {
  int any = 0;
  for (int k = 0; k < f->given->n_blocks; k++) {
    frot_impact_part *part = &f->parts[k];
    if (f->given->blocks[k].rule != FROT_ROW_PRESSES || part->state != FROT_PART_RIGID) continue;
    part->state = FROT_PART_LOADING, part->stored = 0, part->mark = f->p[f->given->blocks[k].at];
    any = 1;
  }
  return any;
}

int frot_implicit_phase(frot_impact *f) {
  int n = frot_impact_state_size(f), columns = 0;
  double *y0 = f->stages, *y1 = y0 + n, *y2 = y1 + n, *from = y2 + n, *table = from + n;
  double h = FIRST_STEP, error = 0, slack, other;
  sort_slips(f, SMALL);
  frot_bring_to_rest(f, 0);
  frot_impact_state_of(f, y0);
  memcpy(from, y0, sizeof(double) * (size_t)n);
  memset(f->x, 0, sizeof(double) * (size_t)f->given->rows);
  while (f->implicit_steps++ < MOST_STEPS) {
    int failed = extrapolate(f, h, y0, y1, table, &columns, &error);
    if (failed && h <= LEAST_STEP) return !press_all(f);
    int shorter = (error > TOLERANCE && h > LEAST_STEP) || (h > BREAKING && breaks_away(f, y1));
    if (failed || shorter) {
      h *= SHORTER;
      continue;
    }
    int changing = first_change(f, from, y1, &slack);
    if (changing >= 0) {
      double low = 0, high = h;
      for (int i = 0; i < LOCATING && slack < -LOCATED && high - low > 1e-15 * high; i++) {
        double middle = 0.5 * (low + high);
        if (extrapolate(f, middle, y0, y2, table, &columns, &error)) return 1;
        if (first_change(f, from, y2, &other) < 0)
          low = middle;
        else
          high = middle, slack = other, memcpy(y1, y2, sizeof(double) * (size_t)n);
      }
      accept(f, y1);
      frot_change_contacts(f, from, y1);
      return 0;
    }
    accept(f, y1);
    frot_impact_state_of(f, y0);
    if (columns <= FEW_COLUMNS) h *= LONGER;
  }
  return 1;
}
