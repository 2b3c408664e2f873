/* Directions of reactions of two components whose length bounds friction.
 *
 * In a sector of half width h about u, R.u <= |R| <= R.u/cos h: the law lies in a convex hull, by
 * which the search prunes. In a direction that is known the law is linear: Newton's method turns
 * the direction to that of the reaction. */
#include <math.h>
#include <string.h>

#include "motion_search/motion_orders.h"

#define STEPS 30
/* Change of a direction that is none, and that is small enough where the steps end. */
#define TURNED 1e-14
#define NEARLY 1e-9
/* Part of the usual reaction below which one has no direction. */
#define NO_REACTION 1e-12
/* Half width in radians of the finest sector. */
#define FINEST 1e-6

static double size_of(const frot_searcher *s, int i) {
  double size = 0;
  for (int c = 0; c < 2; c++) {
    int place = s->p->items[i].reads[c];
    size = fmax(size, place < s->p->n ? s->p->unit[place] : 1);
  }
  return size * s->force;
}

static int has_length(const frot_motion_problem *p, int i) {
  return p->items[i].kind == FROT_ITEM_LAW && p->items[i].bound == FROT_BOUND_LENGTH;
}

/* Whether friction follows the reaction of an item: it slips. Rest needs a bound that is no larger
 * than that of the reaction, which any direction gives. */
static int follows(const frot_searcher *s, const frot_item_state *states, int i) {
  return s->p->items[i].moving != 0 || states[i].mode == FROT_ITEM_FORWARD ||
         states[i].mode == FROT_ITEM_BACKWARD;
}

/* The direction of the reaction of item i, r. Returns by how much that of its law is another; 0
 * where it has none. */
static double misses_direction(const frot_searcher *s, int i, double r[2]) {
  const double *d = s->direction + 2 * i;
  frot_bounding_reaction(s->p, &s->p->items[i], s->b, s->x, r);
  double length = hypot(r[0], r[1]);
  if (length <= NO_REACTION * size_of(s, i)) return r[0] = d[0], r[1] = d[1], 0;
  r[0] /= length, r[1] /= length;
  return hypot(r[0] - d[0], r[1] - d[1]);
}

/* Turn the directions to the reactions, of what slips or of `all`. Returns the largest change. */
static double turn(frot_searcher *s, const frot_item_state *states, int all) {
  double change = 0;
  for (int i = 0; i < s->p->n_items; i++) {
    double r[2];
    if (!has_length(s->p, i) || !(all || follows(s, states, i))) continue;
    change = fmax(change, misses_direction(s, i, r));
    memcpy(s->direction + 2 * i, r, sizeof r);
  }
  return change;
}

static void turn_to_middles(frot_searcher *s, const frot_item_state *states) {
  for (int i = 0; i < s->p->n_items; i++)
    s->direction[2 * i] = cos(states[i].angle), s->direction[2 * i + 1] = sin(states[i].angle);
}

/* Reactions of the equations alone, after those of the inequalities too are none. Returns 1 where
 * there are none. */
static int take_equations(frot_searcher *s) {
  int redundant;
  s->rows.p.inequalities = 0;
  return frot_polyhedron_point(&s->rows.p, s->x, &redundant, s->doubles, s->integers);
}

/* Newton's method from the middles of the sectors: an inequality that is nearly zero may not hold
 * on the way. Returns whether the directions are found. */
static int find(frot_searcher *s, const frot_item_state *states, int all) {
  int outside = 0;
  double change = 1;
  turn_to_middles(s, states);
  for (int k = 0; k < STEPS && change > TURNED; k++) {
    outside = frot_find_orders(s, states, (frot_look){0, 1, 0, 1}) >= 0;
    if (outside && take_equations(s)) return 0;
    change = turn(s, states, all);
  }
  return !outside && change <= NEARLY;
}

int frot_follows_its_reaction(const frot_searcher *s, const frot_item_state *states) {
  for (int i = 0; i < s->p->n_items; i++) {
    double r[2];
    if (has_length(s->p, i) && follows(s, states, i) && misses_direction(s, i, r) > 2 * FINEST)
      return 0;
  }
  return 1;
}

int frot_find_directions(frot_searcher *s, const frot_item_state *states) {
  const frot_motion_problem *p = s->p;
  int widest = -1;
  for (int i = 0; i < p->n_items; i++)
    if (has_length(p, i) && (widest < 0 || states[i].half > states[widest].half)) widest = i;
  if (widest < 0 || find(s, states, 1) || find(s, states, 0)) return -1;
  if ((double)states[widest].half > FINEST) return widest;
  turn_to_middles(s, states); /* which the law tells from R by less than may be missed */
  return -1;
}
