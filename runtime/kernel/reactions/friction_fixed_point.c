/* Friction that follows readings where nothing is held: the fixed point.
 *
 * A couple of friction does little to the reactions of the pins, in proportion to the radius over
 * the lengths of the links. So reactions and friction are found in turn, from one solution of the
 * inertia to the next: that costs a square each, along a tree in proportion to its steps, and what
 * the reactions do to each other is never formed. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "inertia/mass_matrix.h"
#include "numerics/dense.h"
#include "reactions/friction_predictor.h"
#include "reactions/force_problem.h"
#include "reactions/reactions.h"
#include "numerics/tolerances.h"

/* What so many passes must leave at most of what the first of them changed, and how many there may
 * be: else Newton's method, which depends on no such thing, is sooner there. */
#define SOME 10
#define LEFT 0.5
#define PASSES 100
/* Ratio of the changes of two passes from which on they are rounding. */
#define STAYS 0.9

/* load (n) <- what the friction of `acting` elements does to the unknowns of the group. */
static void load_by_friction(const frot_problem *p, int acting, double *load) {
  memset(load, 0, sizeof(double) * (size_t)p->g->n);
  for (int f = 0; f < acting; f++) {
    const frot_follower *own = &p->w->reactions.followers[f];
    const double friction = *own->friction, *entries = own->entries;
    for (int k = own->from; k < own->to; k++) load[k] += friction * entries[k];
  }
}

static void list_friction(const frot_problem *p, int element, frot_follower *own) {
  const frot_work *w = p->w;
  int row = p->m->elements[element].row;
  own->friction = &p->w->core.lam[row], own->ratio = w->reactions.ratio[element];
  own->entries = frot_entries(p->m, w->core.rows, row);
  own->from = w->core.reach[2 * row], own->to = w->core.reach[2 * row + 1];
}

/* What is known of the followers before the first pass, and behind them of friction that values
 * bound. Returns how many act. */
static int list_followers(const frot_problem *p) {
  const frot_model *m = p->m;
  const frot_group *g = p->g;
  frot_work *w = p->w;
  int acting = p->unknowns;
  for (int f = 0; f < p->unknowns; f++) {
    int e = w->reactions.owner[f], pin = m->elements[e].bound == FROT_BY_PIN;
    frot_follower *own = &w->reactions.followers[f];
    list_friction(p, e, own);
    own->norm = pin ? m->elements[e].norm : NULL;
    for (int k = 0; k < FROT_BOUNDING; k++) {
      int by = k == 0 || pin ? m->elements[e].bounded_by[k] : -1;
      int at = by >= 0 ? m->row_reads[by] : -1;
      own->at[k] = at, own->force[k] = at < 0 ? 0 : w->core.h[g->unknowns[at]];
    }
  }
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    if (m->elements[e].bound != FROT_BY_VALUE || w->reactions.ratio[e] == 0) continue;
    list_friction(p, e, &w->reactions.followers[acting++]);
  }
  return acting;
}

/* One over the size of the terms that the friction of a follower is made of; 0 where it has none.
 */
static double per_size(const frot_follower *own, const double *whole, const double *load) {
  double size = 0;
  for (int k = 0; k < FROT_BOUNDING && own->at[k] >= 0; k++)
    size += fabs(whole[own->at[k]]) + fabs(own->force[k]) + fabs(load[own->at[k]]);
  size *= fabs(own->ratio);
  return size > 0 ? 1 / size : 0;
}

/* What the readings make of the friction of each follower. Returns the largest change, as a part of
 * the terms that one is made of. */
static double follow(const frot_problem *p, const double *whole, const double *load, int pass) {
  double most = 0, sum = 0; /* what is no number stays in a sum */
  for (int f = 0; f < p->unknowns; f++) {
    frot_follower *own = &p->w->reactions.followers[f];
    double first = whole[own->at[0]] - own->force[0] - load[own->at[0]];
    own->reaction[0] = own->size = first;
    if (own->norm) own->size = 0;
    for (int j = 0, k = 0; own->norm && j < FROT_NORMS && own->norm[j] > 0; j++) {
      double square = 0;
      for (int end = k + own->norm[j]; k < end; k++) {
        double one = whole[own->at[k]] - own->force[k] - load[own->at[k]];
        own->reaction[k] = one, square += one * one;
      }
      own->size += sqrt(square);
    }
    if (pass == 0 || own->per_size == 0) own->per_size = per_size(own, whole, load);
    own->next = own->ratio * own->size;
    double change = fabs(own->next - *own->friction) * own->per_size;
    most = change > most ? change : most, sum += change;
  }
  return isnan(sum) ? NAN : most;
}

/* Take what the readings made of friction. What passes leave foretells no more: an extrapolation
 * (D. Anderson, J. ACM 12, 1965, p. 547) ends in another rounding in each stage. */
static void take(const frot_problem *p) {
  for (int f = 0; f < p->unknowns; f++)
    *p->w->reactions.followers[f].friction = p->w->reactions.followers[f].next;
}

/* The directions of the pins' reactions as the last pass found them, also for who goes on. */
static void turn(const frot_problem *p) {
  const frot_reaction_work *r = &p->w->reactions;
  for (int f = 0; f < p->unknowns; f++) {
    const frot_follower *own = &r->followers[f];
    double *along = r->along + FROT_BOUNDING * r->owner[f];
    for (int j = 0, k = 0; own->norm && j < FROT_NORMS && own->norm[j] > 0; j++) {
      int end = k + own->norm[j];
      double square = 0;
      for (int i = k; i < end; i++) square += own->reaction[i] * own->reaction[i];
      for (; k < end; k++)
        if (square > 0) along[k] = own->reaction[k] / sqrt(square);
    }
  }
}

/* The friction and the readings at the end. */
static void finish(const frot_problem *p, const double *whole, const double *load) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  turn(p);
  take(p);
  frot_note_friction(p);
  for (int k = 0; k < p->g->n_speeds; k++) w->core.a[p->g->unknowns[k]] = whole[k];
  for (int i = 0; i < p->g->n_rows; i++) {
    int r = p->g->rows[i], at = m->row_reads[r];
    if (at >= 0 && w->core.wanted[r])
      w->core.lam[r] = whole[at] - w->core.h[p->g->unknowns[at]] - load[at];
  }
}

/* The friction that values bound; of those that follow none, where it is not known at instants
 * before. Returns whether it is. */
static int begin(const frot_problem *p) {
  const frot_model *m = p->m;
  const frot_group *g = p->g;
  frot_work *w = p->w;
  int warm = w->reactions.follow && w->reactions.warm,
      *known = &w->reactions.instants[g - m->groups];
  if (!w->reactions.follow) w->reactions.rate[g - m->groups] = 0, *known = 0;
  for (int i = 0; i < g->n_rows && !warm; i++) w->core.lam[g->rows[i]] = 0;
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    if (m->elements[e].bound == FROT_BY_VALUE)
      w->core.lam[m->elements[e].row] = w->reactions.ratio[e];
  }
  return *known > 0;
}

/* What a pass leaves of a change is only seen by one more: a first pass that changes little, from
 * the friction that stages before foretell, may leave it nearly whole (near a jam). So the rate is
 * that of the last two passes, and where there is but one, what it was in the stage before. */
int frot_iterate_friction(const frot_problem *p) {
  const frot_group *g = p->g;
  frot_work *w = p->w;
  double *load = w->core.column, *whole = w->core.rest, before = 0, some = INFINITY;
  double *rate = &w->reactions.rate[g - p->m->groups];
  int known = begin(p);
  if (*rate >= 1) return 0; /* they have not settled in a stage before */
  int acting = list_followers(p);
  frot_extrapolate_friction(p);
  frot_begin_responses(w, g);
  for (int pass = 0; pass < PASSES; pass++) {
    load_by_friction(p, acting, load);
    memcpy(whole, load, sizeof(double) * (size_t)g->n_speeds);
    frot_respond(w, g, whole);
    double changed = follow(p, whole, load, pass);
    if (isnan(changed)) return 0;
    int far = pass == 1 && !known; /* from none at all: only a beginning */
    if (before > 0 && !far) *rate = changed / before;
    int rated = *rate > 0 || changed == 0, stays = before > 0 && changed > STAYS * before;
    int done = rated && changed * *rate <= FROT_FRICTION_ENOUGH * (1 - *rate);
    if (done || (rated && changed <= FROT_FRICTION_ROUNDED && stays)) {
      *rate = fmin(*rate, STAYS);
      return finish(p, whole, load), 1;
    }
    if (pass % SOME == 0 && !(changed <= LEFT * some)) break;
    if (pass % SOME == 0) some = changed;
    before = changed;
    take(p);
  }
  *rate = 1;
  return turn(p), 0;
}
