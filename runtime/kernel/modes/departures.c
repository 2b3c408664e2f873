#include "modes/departures.h"

#include <string.h>

#include "evaluation/evaluate.h"
#include "modes/mode_options.h"
#include "modes/enumeration.h"

#define HALF 0.7071067811865476 /* sine of an eighth of a turn */

/* Elements of the contacts chosen that start to slip against less friction than held them: from now
 * on they are looked at with that. Returns how many. */
static int note_departures(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  int departed = 0;
  for (int c = 0; c < count; c++)
    for (int e = 0; e < m->n_elements; e++) {
      const double *k = in->w->core.coefficient + 2 * e;
      if (m->elements[e].contact != chosen[c] || !in->at_rest[e] || k[0] == k[1]) continue;
      if (!in->w->search.best[chosen[c]].closed) continue;
      if (frot_element_mode(m, in->w->search.best, e)->friction <= FROT_STICK) continue;
      in->at_rest[e] = 0, departed++;
    }
  return departed;
}

/* Put the modes found aside, or back. */
static void put_aside(const frot_instant *in, frot_contact_mode *aside) {
  size_t modes = sizeof *aside * (size_t)(in->m->n_contacts + in->m->n_elements);
  memcpy(aside, in->w->search.best, modes);
}
static void put_back(const frot_instant *in, const frot_contact_mode *aside) {
  size_t modes = sizeof *aside * (size_t)(in->m->n_contacts + in->m->n_elements);
  memcpy(in->w->search.best, aside, modes);
  in->w->search.exact = 0;
}

/* Motions in which what fired changes, or else any; those that last before those that do not.
 * Slack admits changes that are taken back at once, and a slip that does not grow is rest: of those
 * that last, such come last. */
int frot_search_lasting(const frot_instant *in, const int *chosen, int count, int *unsearched) {
  frot_search_work *found = &in->w->search;
  int slack = 0;
  for (int lasting = 1; lasting >= 0 && !slack; lasting--)
    for (int forced = 1; forced >= 0; forced--) {
      int motions = frot_search(in, chosen, count, forced, lasting, unsearched);
      found->lasts = lasting;
      if (motions > 0 && ((found->exact && !found->fades) || !lasting)) return motions;
      if (motions > 0 && !slack) slack = motions, put_aside(in, found->slack);
    }
  if (slack) put_back(in, found->slack);
  return slack;
}

/* Nothing has departed yet. */
static void take_back(const frot_instant *in, const int *chosen, int count) {
  for (int c = 0; c < count; c++)
    for (int e = 0; e < in->m->n_elements; e++)
      if (in->m->elements[e].contact == chosen[c]) in->at_rest[e] = in->zero[e];
}

/* The same where what begins to slip has the friction of motion, and what rests that of rest. */
static int search_moving(const frot_instant *in, const int *chosen, int count, int *unsearched) {
  frot_instant moving = *in;
  moving.resists = NULL;
  return frot_search_lasting(&moving, chosen, count, unsearched);
}

/* What departs would be held at once by the friction of motion: where others can carry what it
 * cannot, less departs or nothing. Else some of what departs may do so without the rest: all that
 * slips has the friction of motion, and what rests that of rest. If there is no such motion, it is
 * told as it was found. */
static int hold(const frot_instant *in, const int *chosen, int count, int *unsearched) {
  take_back(in, chosen, count);
  in->w->search.lasts = 1;
  int motions = frot_search_corners(in, chosen, count, unsearched);
  while (motions > 0 && note_departures(in, chosen, count))
    motions = frot_search_corners(in, chosen, count, unsearched);
  take_back(in, chosen, count);
  if (motions == 0 || !in->w->search.exact) motions = search_moving(in, chosen, count, unsearched);
  return motions > 0 ? motions : frot_search_lasting(in, chosen, count, unsearched);
}

/* As `hold` where what departs with the friction of motion goes on by slack alone; that stays where
 * it finds no motion that needs none. */
static int hold_exactly(const frot_instant *in, const int *chosen, int count, int *unsearched,
                        int motions) {
  put_aside(in, in->w->search.found);
  int others = hold(in, chosen, count, unsearched);
  if (others > 0 && in->w->search.exact) return others;
  put_back(in, in->w->search.found);
  return motions;
}

/* Motions of a component, the one preferred into w->search.best. What departs has the friction of
 * motion at once, and what the others do follows from that: looked for again until nothing more
 * departs.
 */
static int look_from_here(const frot_instant *in, const int *chosen, int count, int *unsearched) {
  in->w->search.lasts = 1;
  if (frot_rest_goes_on(in, chosen, count)) return 1;
  int motions = frot_search_lasting(in, chosen, count, unsearched), departed = 0;
  while (motions > 0 && note_departures(in, chosen, count)) {
    int again = frot_search_lasting(in, chosen, count, unsearched);
    if (again == 0) return hold(in, chosen, count, unsearched);
    motions = again, departed = 1;
  }
  /* no rest ends by passing its bound: what holds with the friction of motion is left */
  if (motions == 0) return search_moving(in, chosen, count, unsearched);
  if (departed && !in->w->search.exact) return hold_exactly(in, chosen, count, unsearched, motions);
  return motions;
}

static int has_pins(const frot_instant *in, const int *chosen, int count) {
  int own[FROT_LAWS_OF_CONTACT];
  for (int c = 0; c < count; c++) {
    int laws = frot_laws_of(in->m, chosen[c], own);
    for (int k = 0; k < laws; k++)
      if (in->m->elements[own[k]].bound == FROT_BY_PIN) return 1;
  }
  return 0;
}

int frot_look_for_motions(const frot_instant *in, const int *chosen, int count, int *unsearched) {
  /* once around: where no other direction serves it is as it was */
  static const double ways[][2] = {{1, 0},        {HALF, HALF},  {0, 1},
                                   {-HALF, HALF}, {-1, 0},       {-HALF, -HALF},
                                   {0, -1},       {HALF, -HALF}, {1, 0}};
  int motions = 0, pins = has_pins(in, chosen, count);
  for (size_t k = 0; k < (pins ? sizeof ways / sizeof *ways : 1); k++) {
    frot_instant turned = *in;
    turned.turn = ways[k];
    if (k > 0) take_back(&turned, chosen, count);
    motions = look_from_here(&turned, chosen, count, unsearched);
    if (motions > 0 && in->w->search.lasts) break;
  }
  return motions;
}
