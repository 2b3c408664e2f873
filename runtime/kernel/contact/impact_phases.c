/* A phase of an impact in which one contact is pressed and all rates are constant: its impulse is
 * the time, and its end has a closed form. */
#include <math.h>

#include "contact/impact_parts.h"
#include "numerics/dense.h"

/* Impulses that differ by less end one phase. */
#define TOGETHER 1e-13

/* The impulse after which x, which changes by `rate` per impulse, is zero. */
static double until_zero(double x, double rate) { return x * rate < 0 ? -x / rate : INFINITY; }

/* The impulse after which a contact that is let go is free. */
static double until_free(const frot_impact *f, int k) {
  const frot_impact_block *block = &f->given->blocks[k];
  const frot_impact_part *part = &f->parts[k];
  double u = f->u[block->at], rate = frot_impact_rate_of(f, block), e = block->restitution;
  if (block->law == FROT_POISSON) return part->mark + e * part->compressed - f->p[block->at];
  if (block->law == FROT_NEWTON) return rate > 0 ? (e * part->approach - u) / rate : INFINITY;
  double left = e * e * part->stored, square = u * u + 2 * rate * left;
  int held = rate == 0 && fabs(u) <= frot_impact_zero(1) * f->scale[block->at];
  if (!(left > 0) || held) return 0;
  return square < 0 ? INFINITY : 2 * left / (u + sqrt(square)); /* u p + rate p^2 / 2 = left */
}

/* The impulse after which a block changes its state. */
static double until_change(const frot_impact *f, int k) {
  const frot_impact_block *block = &f->given->blocks[k];
  double u = f->u[block->at], rate = frot_impact_rate_of(f, block);
  switch (f->parts[k].state) {
    case FROT_PART_LOADING:
      return u >= 0 && rate > 0 ? 0 : until_zero(fmin(u, 0), rate);
    case FROT_PART_UNLOADING:
      return fmin(until_free(f, k), u > 0 ? until_zero(u, rate) : INFINITY);
    case FROT_PART_OPEN:
      return u > 0 ? until_zero(u, rate) : INFINITY;
    case FROT_PART_SLIPS: {
      double d[3], along = 0, size = frot_impact_slip(block, f->u, d);
      for (int i = 0; i < block->n; i++) along += d[i] * f->a[block->at + i];
      return until_zero(size, along);
    }
    default:
      return INFINITY;
  }
}

/* A block whose change is due ends its state. `is_free`: the restitution of the contact ends. */
static void change(frot_impact *f, int k, int is_free) {
  switch (f->parts[k].state) {
    case FROT_PART_LOADING:
      frot_end_compression(f, k);
      break;
    case FROT_PART_UNLOADING:
      if (is_free)
        frot_end_restitution(f, k);
      else
        frot_begin_compression(f, k);
      break;
    case FROT_PART_OPEN:
      frot_begin_compression(f, k);
      break;
    default:
      frot_put_at_rest(f, k);
  }
}

int frot_constant_phase(frot_impact *f, int driver) {
  const frot_impact_problem *p = f->given;
  double end = INFINITY, *due = f->stages;
  for (int k = 0; k < p->n_blocks; k++) due[k] = until_change(f, k), end = fmin(end, due[k]);
  if (!isfinite(end)) return 1;
  double free = f->parts[driver].state == FROT_PART_UNLOADING ? until_free(f, driver) : INFINITY;
  frot_impact_part *part = &f->parts[driver];
  int at = p->blocks[driver].at;
  double before = f->u[at], e = p->blocks[driver].restitution;
  for (int k = 0; k < p->n_blocks; k++)
    for (int i = p->blocks[k].at;
         i < p->blocks[k].at + p->blocks[k].n && p->blocks[k].rule != FROT_ROW_READS; i++)
      f->lost[k] -= end * f->x[i] * (f->u[i] + 0.5 * end * f->a[i]);
  for (int i = 0; i < p->rows; i++) f->u[i] += end * f->a[i], f->p[i] += end * f->x[i];
  double work = -0.5 * (before + f->u[at]) * end;
  part->stored += part->state == FROT_PART_LOADING ? work : work / (e * e);
  part->stored = fmax(part->stored, 0);
  double last = end + TOGETHER * f->p[at];
  for (int k = 0; k < p->n_blocks; k++)
    if (due[k] <= last) change(f, k, k == driver && free <= last);
  return 0;
}
