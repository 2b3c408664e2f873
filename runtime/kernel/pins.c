/* Friction that follows readings where nothing is held: the fixed point.
 *
 * A couple of friction does little to the reactions of the pins, in proportion to the radius over
 * the lengths of the links. So reactions and friction are found in turn, from one solution of the
 * inertia to the next: that costs a square each, along a tree in proportion to its steps, and what
 * the reactions do to each other is never formed. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "inertia.h"
#include "linear.h"
#include "problem.h"
#include "reactions.h"

/* Followers from which on it costs less than a system for all of them. */
#define MANY 3
/* What a pass must leave at most of what the one before it changed: else Newton's method, which
 * depends on no such thing, is sooner there. Passes that shrink so need no more than these. */
#define FASTER 0.1
#define PASSES 20
/* Part of a friction that the next pass would change, which is none. */
#define ENOUGH (8 * DBL_EPSILON)
/* Part of a friction within which it is what rounding of its terms leaves that a pass changes. */
#define ROUNDED 1e-12
/* The same from which on what the next pass changes shows what passes leave, and no rounding. */
#define SHOWN 1e-6

int frot_only_follows(const frot_model *m, const frot_group *g, const frot_contact_mode *modes) {
  int followers = 0;
  for (int i = 0; i < g->n_contacts; i++) {
    int c = g->contacts[i];
    if (modes[c].unloaded || frot_is_loaded(m, modes, c)) return 0;
  }
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    const frot_element *element = &m->elements[e];
    const frot_contact_mode *mode = frot_element_mode(m, modes, e);
    if (!modes[element->contact].closed || mode->friction == FROT_NONE) continue;
    if (mode->friction == FROT_STICK || mode->at_bound != 0) return 0;
    if (element->bound == FROT_BY_VALUE) continue;
    if (!frot_is_reading(m, element->bounded_by[0])) return 0;
    followers++;
  }
  return followers >= MANY;
}

/* load (n) <- what the reactions w->core.lam of the elements do to the unknowns of the group. */
static void load_by_friction(const frot_problem *p, double *load) {
  const frot_group *g = p->g;
  const frot_work *w = p->w;
  memset(load, 0, sizeof(double) * (size_t)g->n);
  for (int i = 0; i < g->n_elements; i++) {
    int row = p->m->elements[g->elements[i]].row;
    const int *reach = w->core.reach + 2 * row;
    const double lam = w->core.lam[row], *entries = frot_entries(p->m, w->core.rows, row);
    if (lam == 0) continue;
    for (int k = reach[0]; k < reach[1]; k++) load[k] += lam * entries[k];
  }
}

/* What is read off the unknown `at`, where the motion makes the momenta `whole`. */
static double read(const frot_problem *p, const double *whole, const double *load, int at) {
  return whole[at] - p->w->core.h[p->g->unknowns[at]] - load[at];
}

/* Let the friction of each follower follow the readings. Returns the largest part of one that
 * changes. */
static double follow(const frot_problem *p, const double *whole, const double *load) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  double most = 0;
  for (int f = 0; f < p->unknowns; f++) {
    int e = w->reactions.owner[f];
    const frot_element *element = &m->elements[e];
    double size = read(p, whole, load, m->row_reads[element->bounded_by[0]]);
    if (element->bound == FROT_BY_PIN) {
      double first = size, second = read(p, whole, load, m->row_reads[element->bounded_by[1]]);
      size = sqrt(first * first + second * second);
      if (size > 0)
        w->reactions.along[2 * e] = first / size, w->reactions.along[2 * e + 1] = second / size;
    }
    double friction = w->reactions.ratio[e] * size, *lam = &w->core.lam[element->row];
    double change = fabs(friction - *lam);
    if (change > 0) most = fmax(most, change / fabs(friction));
    if (isnan(change)) return change;
    *lam = friction;
  }
  return most;
}

/* The friction that values bound; of those that follow what it was in the stage before, or none.
 * Returns whether it was that. */
static int begin(const frot_problem *p) {
  const frot_model *m = p->m;
  const frot_group *g = p->g;
  frot_work *w = p->w;
  int warm = w->reactions.follow && w->reactions.warm;
  if (!warm) w->reactions.rate[g - m->groups] = 0;
  for (int i = 0; i < g->n_rows && !warm; i++) w->core.lam[g->rows[i]] = 0;
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    if (m->elements[e].bound == FROT_BY_VALUE)
      w->core.lam[m->elements[e].row] = w->reactions.ratio[e];
  }
  return warm;
}

/* What a pass leaves of a change is only seen by one more: a first pass that changes little, from
 * the friction of the stage before, may leave it nearly whole (near a jam). So the rate is that of
 * the slowest pass seen in the step. */
int frot_follow_in_turn(const frot_problem *p) {
  const frot_group *g = p->g;
  frot_work *w = p->w;
  double *load = w->core.column, *whole = w->core.rest, before = 0;
  double *rate = &w->reactions.rate[g - p->m->groups];
  if (begin(p) && *rate > FASTER) return 0;
  for (int pass = 0; pass < PASSES; pass++) {
    load_by_friction(p, load);
    memcpy(whole, load, sizeof(double) * (size_t)g->n_speeds);
    frot_respond(w, g, whole);
    for (int k = 0; k < g->n_speeds; k++) w->core.a[g->unknowns[k]] = whole[k];
    double changed = follow(p, whole, load);
    if (isnan(changed)) return 0;
    int far = pass == 1 && before == 1 && changed > FASTER; /* from none at all: only a beginning */
    if (before > SHOWN && !far) *rate = fmax(*rate, changed / before);
    if (*rate > FASTER) return 0;
    int known = *rate > 0 || changed == 0, stays = changed > FASTER * before;
    int done = known && (changed * *rate <= ENOUGH || (changed <= ROUNDED && before > 0 && stays));
    before = changed;
    if (!done) continue;
    for (int i = 0; i < g->n_rows; i++) {
      int r = g->rows[i], reads = p->m->row_reads[r];
      if (reads >= 0 && w->core.wanted[r]) w->core.lam[r] = read(p, whole, load, reads);
    }
    return 1;
  }
  return 0;
}
