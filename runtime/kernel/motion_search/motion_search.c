/* Motions with the coefficient of rest first, then with that of motion of what departs. Where what
 * departs is held at once by its lower friction, and others cannot depart with it: all that slips
 * has the coefficient of motion, and what rests that of rest. */
#include "motion_search/motion_search.h"

#include <math.h>
#include <string.h>

#include "motion_search/branch_and_bound.h"
#include "motion_search/mode_inequalities.h"
#include "numerics/dense.h"

/* Part of their terms by which accelerations of one motion differ. */
#define EQUAL 1e-7

/* Room for the motions of a list behind the searcher; those of scratch after them. */
static double *give_room(const frot_motion_problem *p, frot_found_motion *found, int count,
                         double *doubles) {
  size_t states = (sizeof(frot_item_state) * (size_t)p->n_items + 7) / 8;
  size_t bytes = ((size_t)p->n_items + 7) / 8;
  for (int k = 0; k < count; k++) {
    found[k].states = (void *)doubles, doubles += states;
    found[k].kinetic = (void *)doubles, doubles += bytes;
    found[k].x = doubles, doubles += FROT_ORDERS * p->n;
    found[k].b = doubles, doubles += FROT_ORDERS * p->places;
  }
  return doubles;
}

static void copy_motion(const frot_motion_problem *p, frot_found_motion *to,
                        const frot_found_motion *from) {
  frot_found_motion place = *to;
  size_t items = (size_t)p->n_items;
  memcpy(place.states, from->states, items * sizeof *place.states);
  memcpy(place.kinetic, from->kinetic, items);
  memcpy(place.x, from->x, sizeof(double) * (size_t)((from->order + 1) * p->n));
  memcpy(place.b, from->b, sizeof(double) * (size_t)((from->order + 1) * p->places));
  *to = *from;
  to->states = place.states, to->kinetic = place.kinetic, to->x = place.x, to->b = place.b;
}

static double acceleration(const frot_motion_problem *p, const frot_found_motion *m, int k, int row,
                           double *size) {
  const double *x = m->x + k * p->n, *w = p->w + row * p->n;
  *size += fabs(m->b[k * p->places + row]);
  for (int j = 0; j < p->n; j++) *size += fabs(w[j] * x[j]);
  return m->b[k * p->places + row] + frot_dot(w, x, p->n);
}

/* What usual reactions, of the size `force` over their units, do to a row, as it usually changes in
 * order k. */
static double usual(const frot_motion_problem *p, int k, int row, double force) {
  double sum = 0;
  for (int j = 0; j < p->n; j++) sum += fabs(p->w[row * p->n + j]) * p->unit[j];
  return sum * force * pow(p->rate, k);
}

/* Whether two motions have equal accelerations at every order that both know, or at order 0 where
 * both begin by no more than rounding. */
static int are_equal(const frot_motion_problem *p, const frot_found_motion *a,
                     const frot_found_motion *b, double force) {
  int top = a->hardly && b->hardly ? 0 : a->order;
  for (int k = 0; k <= top && k <= b->order; k++)
    for (int i = 0; i < p->n; i++) {
      double missed = frot_apart(p) * FROT_MISSED * usual(p, k, i, force), size = 0;
      double one = acceleration(p, a, k, i, &size), two = acceleration(p, b, k, i, &size);
      if (fabs(one - two) > EQUAL * size + missed) return 0;
    }
  return 1;
}

/* Whether the first motion departs in an item whose friction falls then, and that has not departed
 * before. */
static int departs(const frot_motion_problem *p, const frot_found_motion *m, int i) {
  const frot_motion_item *item = &p->items[i];
  int mode = m->states[i].mode;
  int open = item->contact >= 0 && m->states[item->contact].mode == FROT_ITEM_OPEN;
  return item->kind == FROT_ITEM_LAW && !open && !m->kinetic[i] && item->mu_s > item->mu &&
         (mode == FROT_ITEM_FORWARD || mode == FROT_ITEM_BACKWARD);
}

/* What a search begins from: modes that are given, and what has the coefficient of motion. */
static int is_known(const frot_motion_problem *p, const frot_found_motion *starts, int count) {
  const frot_found_motion *new = &starts[count];
  for (int k = 0; k < count; k++)
    if (!memcmp(starts[k].kinetic, new->kinetic, (size_t)p->n_items) &&
        !memcmp(starts[k].states, new->states, sizeof *new->states * (size_t)p->n_items))
      return 1;
  return 0;
}

/* Add the start that follows from what departs in a motion. Returns whether anything does. */
static int add_start(const frot_motion_problem *p, const frot_found_motion *m,
                     frot_found_motion *starts, int *count, int *complete) {
  int any = 0;
  for (int i = 0; i < p->n_items; i++) any |= departs(p, m, i);
  if (!any) return 0;
  if (*count == FROT_MOST_FOUND) return *complete = 0, 1;
  frot_found_motion *start = &starts[*count];
  memset(start->states, 0, sizeof *start->states * (size_t)p->n_items);
  memcpy(start->kinetic, m->kinetic, (size_t)p->n_items);
  for (int i = 0; i < p->n_items; i++) {
    if (!departs(p, m, i)) continue;
    start->kinetic[i] = 1, start->states[i].mode = m->states[i].mode;
    int contact = p->items[i].contact;
    if (contact >= 0) start->states[contact].mode = FROT_ITEM_HELD;
  }
  if (!is_known(p, starts, *count)) ++*count;
  return 1;
}

/* Whether two motions have equal reactions too. */
static int share_reactions(const frot_motion_problem *p, const frot_found_motion *a,
                           const frot_found_motion *b, double scale) {
  for (int i = 0; i < p->n; i++) {
    double size = fabs(a->x[i]) + fabs(b->x[i]) + p->unit[i] * scale;
    if (fabs(a->x[i] - b->x[i]) > EQUAL * size) return 0;
  }
  return 1;
}

/* Whether two motions are of one family: equal modes in which reactions are open. */
static int is_one_family(const frot_motion_problem *p, const frot_found_motion *a,
                         const frot_found_motion *b) {
  if (!a->family || !b->family) return 0;
  for (int i = 0; i < p->n_items; i++)
    if (a->states[i].mode != b->states[i].mode || a->states[i].since != b->states[i].since)
      return 0;
  return 1;
}

/* Leave out what is one with a motion before: grazing contacts, sectors that touch. What has other
 * reactions is noted as the same motion. */
static void merge(const frot_motion_problem *p, frot_motion_list *list, double scale) {
  for (int i = 0; i < list->count; i++) {
    int twin = 0;
    for (int k = 0; k < i && !twin; k++) {
      if (is_one_family(p, &list->found[i], &list->found[k])) {
        twin = 1;
        continue;
      }
      if (!are_equal(p, &list->found[i], &list->found[k], scale)) continue;
      if (list->found[i].same < 0)
        list->found[i].same = list->found[k].same < 0 ? k : list->found[k].same;
      twin = share_reactions(p, &list->found[i], &list->found[k], scale);
    }
    if (!twin) continue;
    list->count--;
    for (int j = i; j < list->count; j++) copy_motion(p, &list->found[j], &list->found[j + 1]);
    i--;
  }
}

/* Add the motions from a start; where there is none, those that begin by no more than rounding. */
static void search_from(frot_searcher *s, const frot_found_motion *start, int budget,
                        frot_motion_list *list) {
  int before = list->count;
  memcpy(s->kinetic, start->kinetic, (size_t)s->p->n_items);
  for (s->strict = 1; s->strict >= 0 && list->count == before && list->nodes < budget; s->strict--)
    frot_branch(s, start->states, budget, list);
}

void frot_list_motions(const frot_motion_problem *p, int budget, frot_motion_list *list,
                       double *doubles, int *integers) {
  frot_found_motion starts[FROT_MOST_FOUND + 1];
  frot_searcher s;
  double *room = give_room(p, list->found, FROT_MOST_FOUND, doubles);
  room = give_room(p, starts, FROT_MOST_FOUND + 1, room);
  frot_begin_search(p, &s, room, integers);
  list->count = list->nodes = 0, list->complete = 1;
  memset(starts[0].states, 0, sizeof *starts[0].states * (size_t)p->n_items);
  for (int i = 0; i < p->n_items; i++)
    starts[0].kinetic[i] = (unsigned char)(p->items[i].moving != 0);
  int count = 1;
  for (int next = 0; next < count && next < FROT_MOST_FOUND; next++) {
    int before = list->count;
    search_from(&s, &starts[next], budget, list);
    for (int k = before; k < list->count; k++) {
      if (!add_start(p, &list->found[k], starts, &count, &list->complete)) continue;
      list->count--;
      for (int j = k; j < list->count; j++) copy_motion(p, &list->found[j], &list->found[j + 1]);
      k--;
    }
  }
  if (list->count == 0 && count > 1) {
    for (int i = 0; i < p->n_items; i++) starts[0].kinetic[i] = 1;
    search_from(&s, &starts[0], budget, list);
  }
  merge(p, list, s.force);
}
