/* Reactions of the active rows of a group.
 *
 * Held rows do not accelerate (held_rows.c). What slips follows the reaction that bounds it, lam_t
 * = ratio * bounding. Where that is the reaction of a held row, its column takes the friction
 * along; where it is a reading, which depends on all reactions, the friction is an unknown with an
 * equation of its own (friction_rows.c). */
#include "reactions/reactions.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "numerics/dense.h"
#include "contact/spring_rows.h"
#include "reactions/equal_springs.h"
#include "reactions/force_problem.h"
#include "constraints/redundant_rows.h"
#include "numerics/tolerances.h"
#include "inertia/extended_inertia.h"

#define TAKE(field, count) FROT_TAKE(a, field, count)

/* Part of a pin's reaction missed below which the factors of a pass serve for steps more, what each
 * of these must leave at most. */
#define NEAR 0.02
#define FASTER 0.05
#define EAGER 8   /* passes of Newton's method before it is damped */
#define HALVES 20 /* of one of its steps */

/* Size of the reaction that bounds an element, by w->core.lam; 1 where a value bounds it. With the
 * sign of the mode: negative where a normal reaction has the wrong one. */
static double bounding(const frot_model *m, const frot_work *w, int element,
                       const frot_contact_mode *modes) {
  const frot_element *e = &m->elements[element];
  if (e->bound == FROT_BY_VALUE) return 1;
  if (e->bound == FROT_BY_PIN) return frot_bounding_length(e, w->core.lam);
  return modes[e->contact].side * w->core.lam[e->bounded_by[0]];
}

double frot_bound_of_rest(const frot_model *m, const frot_work *w, int element,
                          const frot_contact_mode *modes) {
  return w->core.coefficient[2 * element + 1] * bounding(m, w, element, modes);
}

double frot_acceleration(const frot_model *m, const frot_work *w, int row, double *size) {
  const frot_group *g = frot_group_of(m, row);
  const double *effects = frot_effect_on(m, w, row);
  double sum = w->core.free[row];
  *size = 0;
  for (int k = 0; k < g->n_rows; k++) {
    double lam = w->core.lam[g->rows[k]];
    if (lam == 0 || frot_is_reading(m, g->rows[k])) continue;
    sum += effects[k] * lam, *size += fabs(effects[k] * lam);
  }
  return sum;
}

double frot_free_size(const frot_model *m, const frot_work *w, int row) {
  const frot_group *g = frot_group_of(m, row);
  if (frot_is_reading(m, row) && frot_in_wide(m, w, g)) return fabs(w->core.free[row]);
  double sum = w->core.bias_size[row];
  const double *force = w->core.force + g->vector;
  const double *entries = frot_entries(m, g->general ? w->core.rows : w->core.half, row);
  int count = g->general ? g->n : g->n_speeds;
  for (int k = 0; k < count; k++) sum += fabs(entries[k] * force[k]);
  return sum;
}

double frot_size_of_motion(const frot_model *m, const frot_work *w, const frot_group *g) {
  int count = g->general ? g->n : g->n_speeds;
  const double *force = w->core.force + g->vector;
  double motion = frot_length(force, count);
  for (int i = 0; i < g->n_rows; i++) {
    const double *half = w->core.half + g->entries + i * g->n;
    double lam = w->core.lam[g->rows[i]];
    if (lam == 0 || frot_is_reading(m, g->rows[i])) continue;
    motion += fabs(lam) * frot_length(half, count);
  }
  return motion;
}

double frot_rounding_of_motion(const frot_model *m, const frot_work *w, int row, double motion) {
  const frot_group *g = frot_group_of(m, row);
  int count = g->general ? g->n : g->n_speeds;
  const double *own = frot_entries(m, g->general ? w->core.rows : w->core.half, row);
  return 4 * FROT_ROUNDING * frot_length(own, count) * motion;
}

double frot_row_rounding(const frot_model *m, const frot_work *w, int row) {
  return frot_rounding_of_motion(m, w, row, frot_size_of_motion(m, w, frot_group_of(m, row)));
}

double frot_free_rounding(const frot_work *w, const frot_group *g, double length) {
  const double *force = w->core.force + g->vector;
  int count = g->general ? g->n : g->n_speeds;
  return 4 * FROT_ROUNDING * length * frot_length(force, count);
}

/* Whether a held row follows from others, with which it was found to agree. */
static int is_left_to_others(const frot_problem *p, int row) {
  return frot_is_redundant(p->w, row) || (!p->g->general && p->w->reactions.carried[row]);
}

/* Whether the held rows do not accelerate and friction follows its reaction. */
static int is_solution(const frot_problem *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  for (int k = 0; k < p->unknowns; k++) {
    double size, value, rounding = 0;
    if (k < p->held && is_left_to_others(p, w->reactions.unknown[k])) continue;
    if (k < p->held) {
      value = frot_acceleration(m, w, w->reactions.unknown[k], &size);
      size += frot_free_size(m, w, w->reactions.unknown[k]);
      rounding = frot_row_rounding(m, w, w->reactions.unknown[k]);
    } else {
      const frot_element *element = &m->elements[w->reactions.owner[k]];
      double along[FROT_BOUNDING] = {1, 0, 0}, bounding = 0;
      if (element->bound == FROT_BY_PIN)
        memcpy(along, w->reactions.along + FROT_BOUNDING * w->reactions.owner[k], sizeof along);
      double ratio = w->reactions.ratio[w->reactions.owner[k]], terms = 0;
      for (int i = 0; i < FROT_BOUNDING; i++) {
        int reading = element->bounded_by[i];
        if (reading < 0) continue;
        bounding += along[i] * w->core.lam[reading];
        if (!frot_is_reading(m, reading)) continue;
        frot_acceleration(m, w, reading, &size);
        terms += size + frot_free_size(m, w, reading);
      }
      value = w->core.lam[element->row] - ratio * bounding;
      size = fabs(w->core.lam[element->row]) + fabs(value) + fabs(ratio) * terms;
    }
    if (!(fabs(value) <= FROT_AGREES * size + rounding)) return 0;
  }
  return 1;
}

/* The readings that are wanted, from the reactions of the group. */
static void read_reactions(const frot_problem *p) {
  const frot_model *m = p->m;
  const frot_group *g = p->g;
  frot_work *w = p->w;
  int *acting = w->core.listed, count = 0;
  for (int i = 0; i < g->n_rows; i++)
    if (w->core.lam[g->rows[i]] != 0) acting[count++] = i;
  for (int i = 0; i < g->n_rows; i++) {
    int r = g->rows[i];
    if (!frot_is_reading(m, r) || !w->core.wanted[r]) continue;
    const double *effects = frot_effect_on(m, w, r);
    double sum = w->core.free[r];
    for (int k = 0; k < count; k++) sum += effects[acting[k]] * w->core.lam[g->rows[acting[k]]];
    w->core.lam[r] = sum;
  }
}

/* All reactions of the group from those of the unknowns. */
static void spread_reactions(const frot_problem *p, const double *x) {
  const frot_model *m = p->m;
  const frot_group *g = p->g;
  frot_work *w = p->w;
  for (int i = 0; i < g->n_rows; i++) w->core.lam[g->rows[i]] = 0;
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    if (m->elements[e].bound == FROT_BY_VALUE && w->reactions.ratio[e] != 0)
      w->core.lam[m->elements[e].row] = w->reactions.ratio[e];
  }
  for (int c = 0; c < p->unknowns; c++) {
    double lam = x[c] * w->reactions.unit_of[c];
    w->core.lam[w->reactions.unknown[c]] = lam;
    for (int k = FROT_FOLDS * c; k < FROT_FOLDS * (c + 1); k++)
      if (w->reactions.fold[k] >= 0)
        w->core.lam[w->reactions.fold[k]] = w->reactions.fold_ratio[k] * lam;
  }
  read_reactions(p);
}

static int group_is_finite(const frot_problem *p) {
  for (int i = 0; i < p->g->n_rows; i++)
    if (!isfinite(p->w->core.lam[p->g->rows[i]])) return 0;
  return 1;
}

/* Solve once in the directions w->reactions.along; *regular: whether one solution was all there is,
 * the reactions are then not yet spread. */
static int solve(frot_problem *p, int *regular) {
  frot_work *w = p->w;
  int n = p->unknowns;
  double *x = w->reactions.solution;
  frot_follow_readings(p);
  *regular = p->equations == n;
  if (*regular) {
    memcpy(w->linear.scratch, w->linear.matrix, sizeof(double) * (size_t)(n * n));
    memcpy(x, w->linear.right, sizeof(double) * (size_t)n);
    *regular = !frot_lu_solve(w->linear.scratch, x, n, w->linear.pivot,
                              &w->reactions.sign[p->g - p->m->groups]);
  }
  if (*regular) return 0;
  frot_effects(p->m, w, p->g);
  w->reactions.dependent = 1, w->reactions.sign[p->g - p->m->groups] = 0;
  if (frot_solve_least(p, x) > 0) {
    w->reactions.sliding_spring = 1 + frot_sliding_spring(p);
    spread_reactions(p, x);
    w->reactions.stretched = frot_stretched_spring(p, w->core.lam, 0);
    if (w->reactions.stretched >= 0) return !p->stretched;
  }
  int outside = frot_keep_within_bounds(p, x);
  if (outside && !w->reactions.ahead) return 1;
  spread_reactions(p, x);
  if (!group_is_finite(p)) return 1;
  if (!outside && is_solution(p)) return 0;
  if (w->reactions.ahead) w->reactions.beyond = (int)(p->g - p->m->groups);
  return !w->reactions.ahead;
}

/* Newton's steps with the factors of the last pass, while each leaves a small part of what the one
 * before it did: they cost a square, and passes a cube. Returns what is missed at the end, or 0
 * where it is rounding. */
static double mend(const frot_problem *p, double *rest, double missed) {
  frot_work *w = p->w;
  for (double rate = 0; missed > FROT_PIN_ROUNDING;) {
    frot_lu_again(w->linear.scratch, rest, p->unknowns, w->linear.pivot);
    for (int c = 0; c < p->unknowns; c++) w->reactions.solution[c] += rest[c];
    if (rate * missed <= 0.5 * DBL_EPSILON && rate > 0) return 0;
    double left = frot_update_pin_directions(p, rest);
    rate = left / missed, missed = left;
    if (!(rate < FASTER)) return missed > FROT_PIN_ROUNDING ? missed : 0;
  }
  return 0;
}

/* What is missing in the equations of the friction that follows, `rest` of
 * frot_update_pin_directions. */
static double missing(const frot_problem *p, const double *rest) {
  double sum = 0;
  for (int k = p->holding; k < p->unknowns; k++) sum += fabs(rest[k]);
  return sum;
}

/* Go back half the way to the unknowns `before`, in which *least was missing, while no less is now:
 * where reactions come near zero their directions change so much in a whole step of Newton's that
 * it goes to and fro. Each half step holds the rows that both hold. Returns what is missed: nothing
 * where no less is and no unknown is another, but for rounding of them all, in which a reaction is
 * lost that vanishes with others. With an infinite *least there is none before. */
static double damp(const frot_problem *p, double *before, double *least, double *rest,
                   double missed) {
  double *x = p->w->reactions.solution, now = missing(p, rest), change = 0, size = 0;
  for (int c = 0; c < p->unknowns && *least < INFINITY; c++)
    change = fmax(change, fabs(x[c] - before[c])), size = fmax(size, fabs(x[c]));
  if (now >= *least && change <= FROT_PIN_ROUNDING * size) return 0;
  for (int k = 0; k < HALVES && now > *least; k++) {
    for (int c = 0; c < p->unknowns; c++) x[c] = 0.5 * (x[c] + before[c]);
    missed = frot_update_pin_directions(p, rest), now = missing(p, rest);
  }
  memcpy(before, x, sizeof(double) * (size_t)p->unknowns);
  *least = now;
  return missed;
}

/* Find what frot_dynamics has left to friction_fixed_point.c; else see that what the rest asks for
 * is there. */
static int left_to_pins(const frot_problem *p) {
  frot_work *w = p->w;
  if (w->core.formed[p->g - p->m->groups] != FROT_FACTOR || p->g->general) return 0;
  int found = frot_iterate_friction(p);
  if (found)
    w->reactions.sign[p->g - p->m->groups] = 1;
  else
    frot_effects(p->m, w, p->g);
  return found;
}

int frot_solve_reactions(const frot_problem *posed, const unsigned char *at_rest) {
  frot_problem p = *posed;
  const frot_model *m = p.m;
  const frot_group *g = p.g;
  frot_work *w = p.w;
  w->reactions.dependent = w->reactions.sign[g - m->groups] = 0;
  w->reactions.stretched = -1;
  if (g->n_rows == 0) return 0;
  frot_list_unknowns(&p, at_rest);
  int pins = 0, regular = 0;
  for (int f = p.held; f < p.unknowns; f++)
    pins |= m->elements[w->reactions.owner[f]].bound == FROT_BY_PIN;
  w->span.rank = 0;
  if (left_to_pins(&p)) return 0;
  if (p.unknowns == 0) return spread_reactions(&p, w->reactions.solution), !group_is_finite(&p);
  if (frot_hold_rows(&p)) return 1;
  if (p.equations > p.unknowns) return 1; /* no reaction is left for a row that is to be kept */
  p.holding = p.equations;
  frot_read_bounds(&p);
  double *rest = w->linear.scratch + p.unknowns * p.unknowns, least = INFINITY;
  for (int pass = 0, last = 0; pass < FROT_PIN_PASSES; pass++) {
    if (solve(&p, &regular)) return 1;
    double missed = pins ? frot_update_pin_directions(&p, rest) : 0;
    if (!regular)
      least = INFINITY;
    else if (pass >= EAGER)
      missed = damp(&p, rest + p.unknowns, &least, rest, missed);
    if (regular && missed < NEAR) missed = mend(&p, rest, missed);
    if (last || missed <= 2 * DBL_EPSILON) {
      if (!regular) return 0;
      spread_reactions(&p, w->reactions.solution);
      return !group_is_finite(&p);
    }
    last = missed < FROT_PIN_CLOSE;
  }
  return 1;
}

int frot_group_reactions(const frot_model *m, frot_work *w, const frot_group *g,
                         const frot_contact_mode *modes, const unsigned char *at_rest) {
  frot_problem p = {.m = m, .w = w, .g = g, .modes = modes};
  int failed = frot_solve_reactions(&p, at_rest);
  if (w->reactions.stretched < 0) return failed;
  unsigned char *carried = w->reactions.carried_before;
  memcpy(carried, w->reactions.carried, (size_t)m->n_rows);
  failed = frot_find_bearing(&p, at_rest);
  if (failed && w->reactions.ahead) {
    w->reactions.beyond = (int)(g - m->groups);
    p.modes = modes, p.stretched = 1;
    failed = frot_solve_reactions(&p, at_rest);
  }
  memcpy(w->reactions.carried, carried, (size_t)m->n_rows);
  w->reactions.dependent = 1;
  return failed;
}

int frot_even_reactions(const frot_model *m, frot_work *w, const frot_group *g,
                        const frot_contact_mode *modes, const unsigned char *at_rest) {
  frot_problem p = {.m = m, .w = w, .g = g, .modes = modes, .evenly = 1};
  return frot_solve_reactions(&p, at_rest);
}

int frot_reactions(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                   const unsigned char *at_rest) {
  for (int k = 0; k < w->awake.now->n_groups; k++)
    if (frot_group_reactions(m, w, &m->groups[w->awake.now->groups[k]], modes, at_rest))
      return w->reactions.jammed = w->awake.now->groups[k], 1;
  return 0;
}

void frot_bind_reactions(const frot_model *m, frot_reaction_work *r, frot_arena *a) {
  int n = m->n_rows, elements = m->n_elements;
  TAKE(r->unknown, n), TAKE(r->owner, n), TAKE(r->fold, FROT_FOLDS * n), TAKE(r->friction, n);
  TAKE(r->sign, m->n_groups), TAKE(r->carried, n), TAKE(r->fold_ratio, FROT_FOLDS * n),
      TAKE(r->ratio, elements);
  TAKE(r->along, FROT_BOUNDING * elements), TAKE(r->heading, elements), TAKE(r->unit_of, n),
      TAKE(r->weight, n), TAKE(r->solution, n);
  int followers = 0, followed = 0;
  for (int k = 0; k < m->n_groups; k++) {
    followers = frot_larger(followers, m->groups[k].n_elements);
    followed = frot_larger(followed, m->groups[k].n_elements * m->groups[k].n_rows);
  }
  TAKE(r->known, FROT_BOUNDING * followers), TAKE(r->effects, FROT_BOUNDING * followed),
      TAKE(r->rate, m->n_groups);
  TAKE(r->followers, followers), TAKE(r->noted, FROT_INSTANTS * elements);
  TAKE(r->instant, FROT_INSTANTS * m->n_groups), TAKE(r->instants, m->n_groups);
  int widest = 0, longest = 0;
  for (int k = 0; k < m->n_groups; k++) {
    widest = frot_larger(widest, m->groups[k].n_rows);
    longest = frot_larger(longest, m->groups[k].n);
  }
  TAKE(r->spring_rows, frot_spring_rows_doubles(widest + 1, longest)),
      TAKE(r->compatible, widest * widest);
  TAKE(r->springs, frot_spring_rows_integers(widest + 1));
  TAKE(r->bearing, m->n_contacts + elements);
  TAKE(r->carried_before, n), TAKE(r->spare_before, n);
  if (frot_has_vectors(m)) {
    TAKE(r->cone_rows, widest * (widest + 3) + frot_cone_scratch(widest, widest));
    TAKE(r->cones, m->n_contacts), TAKE(r->balls, elements);
  }
}
