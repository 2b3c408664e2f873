/* A phase of an impact by springs, where several contacts are pressed or slips turn: the speeds and
 * the forces of the springs by the method of order 8(5,3) of Dormand and Prince. */
#include <math.h>
#include <string.h>

#include "contact/impact_parts.h"
#include "numerics/dense.h"
#include "numerics/dormand_prince_table.h"

#define TOLERANCE 1e-12
#define MOST_STEPS 8000 /* of an impact */
/* Steps of a phase after which slips are taken for stiff. */
#ifndef FROT_EXPLICIT_STEPS
#define FROT_EXPLICIT_STEPS 300
#endif
#define FIRST_STEP 0.05 /* over the time in which the stiffest contact turns by one radian */
#define SAFETY 0.8
#define LEAST_CHANGE 0.2
#define MOST_CHANGE 5.0
/* Part of its usual size below which a slip counts as its own measure of its errors. */
#define SMALL_SLIP 1e-2
/* Steps of the search for a change; every third takes the middle. */
#define LOCATING 150
#define MIDDLE 3
/* Parts of a speed or force, over its size, at which a change is located. */
#define LOCATED 1e-14

int frot_spring_doubles(int rows, int blocks) {
  return (DP_STAGES + 5 + FROT_IMPLICIT_COLUMNS) * 2 * (rows + blocks);
}

/* The force of a contact at a state y. */
double frot_impact_force(const frot_impact *f, const double *y, int k) {
  const frot_impact_block *block = &f->given->blocks[k];
  const frot_impact_part *part = &f->parts[k];
  if (!frot_is_driven(part)) return 0;
  if (part->state == FROT_PART_UNLOADING && block->law == FROT_NEWTON) {
    if (f->alone) return part->peak; /* its impulse is the time, whatever the force */
    double share = y[block->at] / (block->restitution * part->approach);
    return share < 1 ? part->peak * sqrt(1 - fmax(share, 0) * share) : 0;
  }
  return fmax(y[2 * f->given->rows + k], 0);
}

double frot_impact_force_rate(const frot_impact *f, const double *y, int k) {
  const frot_impact_block *block = &f->given->blocks[k];
  const frot_impact_part *part = &f->parts[k];
  double e = block->restitution;
  if (part->state == FROT_PART_LOADING) return -f->stiffness * y[block->at];
  if (part->state != FROT_PART_UNLOADING) return 0;
  if (block->law == FROT_ENERGETIC) return -f->stiffness / (e * e) * y[block->at];
  if (block->law != FROT_POISSON) return 0;
  double given_back = y[f->given->rows + block->at] - part->mark, turn = part->peak / e;
  return -(turn / part->compressed) * (turn / part->compressed) * given_back;
}

/* rate <- y'. */
static int differentiate(frot_impact *f, const double *y, double *rate) {
  const frot_impact_problem *p = f->given;
  for (int k = 0; k < p->n_blocks; k++) f->force[k] = frot_impact_force(f, y, k);
  if (frot_impact_rates(f, y)) return 1;
  memcpy(rate, f->a, sizeof(double) * (size_t)p->rows);
  memcpy(rate + p->rows, f->x, sizeof(double) * (size_t)p->rows);
  for (int k = 0; k < p->n_blocks; k++) {
    const frot_impact_block *block = &p->blocks[k];
    double *of_force = rate + 2 * p->rows + k;
    *of_force = frot_impact_force_rate(f, y, k), of_force[p->n_blocks] = 0;
    for (int i = block->at; i < block->at + block->n && block->rule != FROT_ROW_READS; i++)
      of_force[p->n_blocks] -= f->x[i] * y[i];
  }
  return 0;
}

/* The largest force that the springs have, or get from the energy of the motion. */
double frot_impact_size_of_forces(const frot_impact *f, const double *y) {
  const frot_impact_problem *p = f->given;
  double force = 0;
  for (int b = 0; b < p->n_blocks; b++) {
    int at = p->blocks[b].at;
    force = fmax(force, fabs(y[2 * p->rows + b]));
    if (frot_is_driven(&f->parts[b]))
      force = fmax(force, sqrt(f->stiffness / p->w[at * (p->rows + 1)]) * f->scale[at]);
  }
  return force;
}

/* The components of a state whose errors count, from `from` on `n`, of the given size: the larger
 * of those of the third and the fifth order so far, over their sizes. */
static void measure_errors(const frot_impact *f, const double *k, int from, int n, double size,
                           double h, double *fifth, double *third) {
  int all = frot_impact_state_size(f);
  for (int c = from; c < from + n && size > 0; c++) {
    double five = 0, three = 0;
    for (int j = 0; j < DP_STAGES; j++)
      five += dp_e5[j] * k[j * all + c], three += dp_e3[j] * k[j * all + c];
    *fifth = fmax(*fifth, fabs(h * five) / size), *third = fmax(*third, fabs(h * three) / size);
  }
}

/* The error of a step from y0 to y1 over the tolerance. Impulses follow from the speeds: friction
 * may be shared in several ways. Slips of several components that vanish turn as fast as they are
 * small. */
static double error_of(const frot_impact *f, const double *y0, const double *y1, const double *k,
                       double h) {
  const frot_impact_problem *p = f->given;
  double fifth = 0, third = 0;
  for (int c = 0; c < p->rows; c++) measure_errors(f, k, c, 1, f->scale[c], h, &fifth, &third);
  double force = frot_impact_size_of_forces(f, y0);
  measure_errors(f, k, 2 * p->rows, p->n_blocks, force, h, &fifth, &third);
  for (int b = 0; b < p->n_blocks; b++) {
    const frot_impact_block *block = &p->blocks[b];
    if (block->rule != FROT_ROW_BALL || block->n == 1 || f->now[b].rule != FROT_ROW_SLIDES)
      continue;
    double size = fmax(frot_impact_slip(block, y0, NULL), frot_impact_slip(block, y1, NULL));
    size = fmax(size, SMALL_SLIP * frot_impact_scale(f, block));
    measure_errors(f, k, block->at, block->n, size, h, &fifth, &third);
  }
  return fifth > 0 ? fifth / TOLERANCE * fifth / sqrt(fifth * fifth + 0.01 * third * third) : 0;
}

/* y1 <- the state after the step h. Returns 1 where a stage has no rates. */
static int step(frot_impact *f, double h, const double *y0, double *y1, double *k) {
  int n = frot_impact_state_size(f);
  double *y = y1 + n;
  for (int i = 1; i < DP_STAGES; i++) {
    memcpy(y, y0, sizeof(double) * (size_t)n);
    for (int j = 0; j < i; j++)
      for (int c = 0; c < n && dp_a[i][j] != 0; c++) y[c] += h * dp_a[i][j] * k[j * n + c];
    if (differentiate(f, y, k + i * n)) return 1;
  }
  for (int c = 0; c < n; c++) {
    double sum = 0;
    for (int j = 0; j < DP_STAGES; j++) sum += dp_a[DP_STAGES][j] * k[j * n + c];
    y1[c] = y0[c] + h * sum;
  }
  return 0;
}

/* What is positive as long as block k keeps its state, over its size: at the state y, whose rates
 * are the last found. `from`: the state at the start of the phase. */
double frot_impact_slack(const frot_impact *f, int k, const double *from, const double *y) {
  const frot_impact_problem *p = f->given;
  const frot_impact_block *block = &p->blocks[k];
  const frot_impact_part *part = &f->parts[k];
  double u = y[block->at], size = f->scale[block->at], e = block->restitution, d[3], along = 0;
  switch (part->state) {
    case FROT_PART_LOADING:
      return -u / size;
    case FROT_PART_OPEN:
      return u / size + (from[block->at] > 0 ? 0 : 10 * LOCATED);
    case FROT_PART_UNLOADING:
      if (block->law == FROT_NEWTON) return (e * part->approach - u) / size;
      return y[2 * p->rows + k] / part->peak;
    case FROT_PART_SLIPS:
      if (!(frot_impact_slip(block, from, d) > 0)) memcpy(d, part->d, sizeof d);
      for (int i = 0; i < block->n; i++) along += d[i] * y[block->at + i];
      size = frot_impact_scale(f, block);
      if (block->n == 1) return along / size;
      if (frot_impact_slip(block, y, NULL) > frot_impact_zero(block->n) * size) return 1;
      /* one that has begun to slip is small at first */
      return frot_impact_slip(block, from, NULL) == 0 && along >= 0 ? 1 : -1;
    default:
      return 1;
  }
}

/* Whether the slip of a block turns by more than a right angle in a step. */
static int turns_back(const frot_impact *f, const double *y0, const double *y1) {
  for (int k = 0; k < f->given->n_blocks; k++) {
    const frot_impact_block *block = &f->given->blocks[k];
    double d[3], along = 0;
    if (block->rule != FROT_ROW_BALL || block->n == 1 || f->parts[k].state != FROT_PART_SLIPS)
      continue;
    if (!(frot_impact_slip(block, y0, d) >
          frot_impact_zero(block->n) * frot_impact_scale(f, block)))
      continue;
    for (int i = 0; i < block->n; i++) along += d[i] * y1[block->at + i];
    if (along < 0) return 1;
  }
  return 0;
}

/* The first block that changes its state between y0 and y1, or -1. */
static int first_change(const frot_impact *f, const double *from, const double *y0,
                        const double *y1) {
  int first = -1;
  double soonest = INFINITY;
  for (int k = 0; k < f->given->n_blocks; k++) {
    double before = frot_impact_slack(f, k, from, y0), after = frot_impact_slack(f, k, from, y1);
    if (after > 0 || (after == 0 && before <= 0)) continue;
    double part = before > 0 ? before / (before - after) : 0;
    if (part < soonest) soonest = part, first = k;
  }
  return first;
}

/* Change the states of all blocks whose slack is used up, or nearly. */
void frot_change_contacts(frot_impact *f, const double *from, const double *y) {
  const frot_impact_problem *p = f->given;
  for (int k = 0; k < p->n_blocks; k++) {
    frot_impact_part *part = &f->parts[k];
    if (frot_impact_slack(f, k, from, y) > 10 * LOCATED) continue;
    if (part->state == FROT_PART_LOADING)
      frot_end_compression(f, k);
    else if (part->state == FROT_PART_UNLOADING)
      frot_end_restitution(f, k);
    else if (part->state == FROT_PART_OPEN)
      frot_begin_compression(f, k);
    else if (part->state == FROT_PART_SLIPS && !f->implicit)
      frot_put_at_rest(f, k);
  }
}

/* Whether modes that the rates have decided on by themselves are others at the end of a step: a
 * slip at rest that begins, a contact that parts; or a compression that begins again. */
static int decides_anew(const frot_impact *f, const double *y) {
  for (int k = 0; k < f->given->n_blocks; k++) {
    const frot_impact_block *block = &f->given->blocks[k];
    const frot_impact_part *part = &f->parts[k];
    if (part->state == FROT_PART_RIGID && f->x[block->at] <= 0) return 1;
    if (part->state == FROT_PART_UNLOADING && y[block->at] < -LOCATED * f->scale[block->at])
      return 1;
    double bound = frot_contact_bound(&f->now[k], f->x);
    if (part->state == FROT_PART_STICKS && f->now[k].rule == FROT_ROW_BALL && bound > 0 &&
        frot_length(f->x + block->at, block->n) >= bound * (1 - 1e-9))
      return 1;
  }
  return 0;
}

/* Take the state y over. */
void frot_accept_impact(frot_impact *f, const double *y) {
  const frot_impact_problem *p = f->given;
  memcpy(f->u, y, sizeof(double) * (size_t)p->rows);
  memcpy(f->p, y + p->rows, sizeof(double) * (size_t)p->rows);
  memcpy(f->lost, y + 2 * p->rows + p->n_blocks, sizeof(double) * (size_t)p->n_blocks);
  for (int k = 0; k < p->n_blocks; k++) {
    double force = frot_impact_force(f, y, k);
    if (frot_is_driven(&f->parts[k])) f->parts[k].stored = force * force / (2 * f->stiffness);
    if (f->parts[k].state == FROT_PART_UNLOADING && y[p->blocks[k].at] < 0)
      frot_begin_compression(f, k);
  }
}

/* y1 <- the state at the first change within the step h from y0, at whose end block `changing` has
 * changed: by the rule of false position with halves (Illinois). Returns 1 where a step has no
 * rates. */
static int locate(frot_impact *f, const double *from, const double *y0, double *y1, double *k,
                  double h, int changing) {
  double low = 0, high = h, at_low = frot_impact_slack(f, changing, from, y0),
         at_high = frot_impact_slack(f, changing, from, y1);
  int side = 0;
  for (int i = 0; i < LOCATING && high - low > 1e-16 * high; i++) {
    double length = at_low - at_high > 0 ? low + (high - low) * at_low / (at_low - at_high) : low;
    if (i % MIDDLE == MIDDLE - 1 || !(length > low && length < high)) length = 0.5 * (low + high);
    if (step(f, length, y0, y1, k)) return 1;
    int other = first_change(f, from, y0, y1);
    double now = frot_impact_slack(f, changing, from, y1);
    if (fabs(now) <= LOCATED && (other < 0 || other == changing)) break;
    if (other < 0) {
      if (side == -1) at_high *= 0.5;
      low = length, at_low = now, side = -1;
      continue;
    }
    if (other != changing) {
      changing = other, at_low = frot_impact_slack(f, other, from, y0);
      now = frot_impact_slack(f, other, from, y1), side = 0;
    }
    if (side == 1) at_low *= 0.5;
    high = length, at_high = now, side = 1;
  }
  /* what jumps is taken where it has changed */
  return frot_impact_slack(f, changing, from, y1) > 10 * LOCATED && step(f, high, y0, y1, k);
}

void frot_impact_state_of(const frot_impact *f, double *y) {
  const frot_impact_problem *p = f->given;
  memcpy(y, f->u, sizeof(double) * (size_t)p->rows);
  memcpy(y + p->rows, f->p, sizeof(double) * (size_t)p->rows);
  for (int b = 0; b < p->n_blocks; b++)
    y[2 * p->rows + b] =
        frot_is_driven(&f->parts[b]) ? sqrt(2 * f->stiffness * f->parts[b].stored) : 0;
  memcpy(y + 2 * p->rows + p->n_blocks, f->lost, sizeof(double) * (size_t)p->n_blocks);
}

int frot_spring_phase(frot_impact *f) {
  int n = frot_impact_state_size(f), stiff = f->steps + FROT_EXPLICIT_STEPS;
  double *k = f->stages, *y0 = k + DP_STAGES * n, *y1 = y0 + n, *from = y1 + 2 * n;
  frot_impact_state_of(f, y0);
  memcpy(from, y0, sizeof(double) * (size_t)n);
  double h = FIRST_STEP; /* the stiffness is that over the largest W of a contact */
  while (f->steps++ < MOST_STEPS) {
    if (f->steps > stiff) return f->implicit = 1, 0;
    if (differentiate(f, y0, k) || step(f, h, y0, y1, k)) return 1;
    double error = error_of(f, y0, y1, k, h);
    double factor = error > 0 ? SAFETY * pow(error, -0.125) : MOST_CHANGE;
    factor = fmin(fmax(factor, LEAST_CHANGE), MOST_CHANGE);
    if (error > 1 || turns_back(f, y0, y1)) {
      h *= error > 1 ? fmin(factor, 1) : 0.5;
      continue;
    }
    int changing = first_change(f, from, y0, y1);
    if (changing < 0) {
      memcpy(y0, y1, sizeof(double) * (size_t)n);
      frot_accept_impact(f, y0);
      if (decides_anew(f, y0)) return 0;
      h *= factor;
      continue;
    }
    if (locate(f, from, y0, y1, k, h, changing)) return 1;
    frot_accept_impact(f, y1);
    frot_change_contacts(f, from, y1);
    return 0;
  }
  return 1;
}
