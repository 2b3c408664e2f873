#include "mode_choice/listed_motions.h"

#include <math.h>
#include <string.h>

#include "evaluation/slip_frames.h"
#include "model/indexing.h"
#include "modes/departures.h"
#include "modes/mode_options.h"
#include "motions/taylor.h"
#include "motion_search/mode_inequalities.h"
#include "numerics/tolerances.h"
#include "reactions/reactions.h"
#include "reactions/switching_functions.h"

void frot_begin_list(const frot_instant *in, frot_motions_memory *c) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  size_t modes = sizeof *c->at.modes * (size_t)(m->n_contacts + m->n_elements);
  frot_lay_out_motions(m, w->search.list, FROT_MOST_LISTED, 0, c);
  c->at.m = m, c->at.s = in->s, c->at.w = w, c->at.t = in->t;
  c->at.q = in->q, c->at.v = in->v, c->at.d = in->s->data + in->l.d;
  memcpy(c->at.modes, w->search.best, modes);
  memcpy(c->at.zero, in->zero, (size_t)m->n_elements);
  memset(c->taylor.nothing, 0, sizeof(double) * (size_t)in->l.nw);
  c->one.at = &c->at, c->one.taylor = &c->taylor, c->taylor.of = &c->one;
}

/* What the modes before leave of the inequality of an item whose guard fired, which is located at
 * zero; reactions are those of these modes. */
static void note_offsets(const frot_instant *in, frot_contact_instant *one) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const frot_contact_mode *before = w->search.before;
  for (int i = 0; i < one->problem.n_items; i++) {
    frot_motion_item *item = &one->items[i];
    int e = one->element_of[i], c = one->contact_of[i], row = one->row_at[item->row];
    double off = 0, size = frot_reaction_size(m, w, row) + fabs(w->core.lam[row]);
    if (!before[c].closed) continue;
    if (e < 0) {
      if (in->fired[c] != 0) off = w->core.lam[row];
    } else if (frot_element_mode(m, before, e)->friction == FROT_STICK) {
      const double *fired = in->fired + frot_element_guard(m, e);
      double bound = frot_bound_of_rest(m, w, e, before), lam = w->core.lam[row];
      if (fired[0] != 0) off = bound - lam;
      if (fired[1] != 0) off = bound + lam;
      size += fabs(bound);
    }
    if (fabs(off) <= FROT_RESOLVED * size) item->off = off;
    if (e < 0 || item->bound != FROT_BOUND_SIDED || in->fired[c] == 0) continue;
    int normal = m->elements[e].bounded_by[0];
    size = frot_reaction_size(m, w, normal) + fabs(w->core.lam[normal]);
    if (fabs(w->core.lam[normal]) <= FROT_RESOLVED * size) item->side_off = w->core.lam[normal];
  }
}

/* Whether a guard of a part has fired. */
static int any_fired(const frot_instant *in, const frot_contact_instant *one) {
  int any = 0;
  for (int i = 0; i < one->problem.n_items; i++) {
    int e = one->element_of[i];
    any |= in->fired[one->contact_of[i]] != 0;
    for (int k = 0; e >= 0 && k < FROT_ELEMENT_GUARDS; k++)
      any |= in->fired[frot_element_guard(in->m, e) + k] != 0;
  }
  return any;
}

/* Note what fired guards leave of their inequalities, by the reactions of the modes before. */
static void note_fired(const frot_instant *in, frot_contact_instant *one) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  if (!any_fired(in, one)) return;
  int failed = 0;
  for (int g = one->first; g < one->end; g++)
    failed |= frot_group_reactions(m, w, &m->groups[g], w->search.before, NULL);
  if (!failed) note_offsets(in, one);
}

/* What an item does in a motion, as an element or contact of the run. */
static int friction_of(const frot_contact_instant *one, const frot_found_motion *found, int i) {
  int moving = one->items[i].moving, mode = found->states[i].mode;
  if (moving) return moving > 0 ? FROT_SLIP_FORWARD : FROT_SLIP_BACKWARD;
  return mode == FROT_ITEM_FORWARD    ? FROT_SLIP_FORWARD
         : mode == FROT_ITEM_BACKWARD ? FROT_SLIP_BACKWARD
                                      : FROT_STICK;
}

static int is_open(const frot_found_motion *found, int item) {
  return item >= 0 && found->states[item].mode == FROT_ITEM_OPEN;
}

/* How much a motion is preferred: rest, then continuity, or the other way round. */
static long long preference(const frot_instant *in, const frot_contact_instant *one,
                            const frot_found_motion *found) {
  const frot_contact_mode *before = in->w->search.before;
  long long rest = 0, kept = 0, big = 3 * one->problem.n_items + 1;
  for (int i = 0; i < one->problem.n_items; i++) {
    int e = one->element_of[i], c = one->contact_of[i], item = one->items[i].contact;
    if (e < 0) {
      kept += before[c].closed == !is_open(found, i);
    } else if (!is_open(found, item)) {
      int friction = friction_of(one, found, i);
      rest += friction == FROT_STICK;
      kept += one->items[i].bound != FROT_BOUND_SIDED || friction == FROT_STICK ||
              found->states[i].side == before[c].side;
      kept += before[c].closed && frot_element_mode(in->m, before, e)->friction == friction;
    } else {
      kept += !before[c].closed;
    }
  }
  int continues = in->s->options.on_indeterminate == FROT_CONTINUE;
  return continues ? kept * big + rest : rest * big + kept;
}

/* Whether a law that acts in a part is that of a dry pin: the list compares sectors of its reaction
 * at the instant, and enumeration after a short time. */
static int any_pin(const frot_instant *in, const frot_contact_instant *one) {
  int any = 0;
  for (int k = one->first; k < one->end; k++)
    for (int j = 0; j < in->m->groups[k].n_elements; j++) {
      int e = in->m->groups[k].elements[j];
      any |= in->m->elements[e].bound == FROT_BY_PIN && frot_bounds_something(in->m, in->w, e);
    }
  return any;
}

/* Whether there is a choice: where everything moves the modes are known, and where one slip alone
 * has come to zero enumeration examines the three that follow. */
static int has_choice(const frot_instant *in, const frot_contact_instant *one) {
  int choices = 0;
  for (int i = 0; i < one->problem.n_items; i++) {
    int e = one->element_of[i];
    if (e < 0) return 1;
    if (one->items[i].moving) continue;
    int slipped = frot_element_mode(in->m, in->w->search.before, e)->friction > FROT_STICK;
    choices += slipped ? 1 : 2;
  }
  return choices > 1;
}

/* The motion that is preferred, or -1. */
static int best_of(const frot_instant *in, const frot_contact_instant *one,
                   const frot_motion_list *list) {
  int best = -1;
  long long most = 0;
  for (int k = 0; k < list->count; k++) {
    long long own = preference(in, one, &list->found[k]);
    if (best < 0 || own > most) best = k, most = own;
  }
  return best;
}

int frot_list_part(const frot_instant *in, frot_motions_memory *c, int part, int pins) {
  const frot_model *m = in->m;
  frot_contact_instant *one = &c->one;
  frot_groups_of_part(m, part, &one->first, &one->end);
  if (one->first == one->end || any_pin(in, one) != pins) return -1;
  if (frot_size_of_instant(m, one->first, one->end).items > FROT_MOST_LISTED) return -1;
  for (int g = one->first; g < one->end; g++) /* a search that has jammed is another one */
    if (in->s->jammed == g && in->s->jammed_at == in->t) return -1;
  frot_pose_contact_problem(one);
  if (one->vectors > 0 || one->wide || one->problem.orders == 0 || one->problem.n_items == 0)
    return -1;
  if (!has_choice(in, one)) return -1;
  note_fired(in, one);
  frot_list_motions(&one->problem, FROT_LISTED_NODES, c->list, c->doubles, c->integers);
  int best = best_of(in, one, c->list);
  if (!c->list->complete) return -1;
  if (best < 0) return FROT_NONE_LISTED;
  return c->list->found[best].decided ? best : -1;
}

/* The modes that a motion gives to contacts and elements, into w->search.given. */
static void give_modes(const frot_instant *in, const frot_contact_instant *one,
                       const frot_found_motion *found) {
  const frot_model *m = in->m;
  frot_contact_mode *given = in->w->search.given;
  memset(given, 0, sizeof *given * (size_t)(m->n_contacts + m->n_elements));
  for (int i = 0; i < m->n_contacts; i++) {
    int row = m->contacts[i].row_n, at = row < 0 ? -1 : one->place_of[row];
    double reaction = at >= 0 && at < one->problem.n ? found->x[at] : 0;
    given[i].closed = in->w->search.best[i].closed;
    given[i].side = (signed char)(in->unilateral[i] != 0 || reaction >= 0 ? 1 : -1);
  }
  for (int i = 0; i < one->problem.n_items; i++) {
    int e = one->element_of[i], c = one->contact_of[i];
    if (e < 0 && is_open(found, i)) given[c].closed = 0;
    if (e < 0) continue;
    given[m->n_contacts + e].friction = (signed char)friction_of(one, found, i);
    if (one->items[i].bound == FROT_BOUND_SIDED && found->states[i].side != 0)
      given[c].side = found->states[i].side;
  }
}

/* The directions of the reactions of pins in a motion, into the state: their search begins there.
 */
static void give_directions(const frot_instant *in, const frot_contact_instant *one,
                            const frot_found_motion *found) {
  const frot_motion_problem *p = &one->problem;
  for (int i = 0; i < p->n_items; i++) {
    if (p->items[i].bound != FROT_BOUND_LENGTH) continue;
    int e = one->element_of[i];
    double r[2];
    frot_bounding_reaction(p, &p->items[i], found->b, found->x, r);
    double length = hypot(r[0], r[1]);
    double *along =
        in->s->data + in->l.along + FROT_BOUNDING * e + frot_norm_first(&in->m->elements[e], 0);
    for (int c = 0; c < 2 && length > 0; c++) along[c] = r[c] / length;
  }
}

/* Note which rests of the component end in a motion. */
static void note_departed(const frot_instant *in, const frot_contact_instant *one,
                          const frot_found_motion *found, int root) {
  for (int i = 0; i < one->problem.n_items; i++) {
    int e = one->element_of[i];
    if (e < 0 || in->w->search.component[one->contact_of[i]] != root) continue;
    in->at_rest[e] = in->zero[e] && !(found && found->kinetic[i]);
  }
}

/* The modes with what is zero in the reactions of the motion at its bound. Returns whether
 * reactions are found that hold them. */
static int take_bounds(const frot_instant *in, const frot_contact_instant *one,
                       const frot_found_motion *found, const int *chosen, int count) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  frot_contact_mode *trial = w->search.trial;
  const frot_motion_problem *p = &one->problem;
  memcpy(trial, in->given, sizeof *trial * (size_t)(m->n_contacts + m->n_elements));
  for (int i = 0; i < p->n_items; i++) {
    const frot_motion_item *item = &p->items[i];
    int e = one->element_of[i], c = one->contact_of[i];
    double f = found->x[item->row], size = frot_reaction_size(m, w, one->row_at[item->row]);
    if (is_open(found, e < 0 ? i : item->contact) || found->states[i].mode != FROT_ITEM_HELD)
      continue;
    if (e < 0) {
      trial[c].unloaded = (signed char)(fabs(f) <= FROT_LOCATED * size);
      continue;
    }
    double bound = item->mu_s;
    if (item->bound != FROT_BOUND_VALUE) {
      int at = item->reads[0];
      double normal = at < p->n ? found->x[at] : found->b[at];
      for (int j = 0; j < p->n && at >= p->n; j++) normal += p->w[at * p->n + j] * found->x[j];
      bound *= fabs(normal);
    }
    if (bound - fabs(f) <= FROT_LOCATED * (bound + fabs(f)))
      trial[m->n_contacts + e].at_bound = (signed char)((f > 0 ? 1 : -1) * trial[c].side);
  }
  const frot_group *g = &m->groups[m->contact_group[chosen[0]]];
  frot_begin_directions(in);
  if (frot_group_reactions(m, w, g, trial, in->resists)) return 0;
  if (!frot_reactions_hold(in, chosen, count)) return 0;
  frot_remember_modes(in, chosen, count);
  return 1;
}

/* Motions that differ; of a component that is not all of its part, in its modes. What only another
 * share of redundant reactions would make is none beside the one chosen. */
static int count_motions(const frot_instant *in, const frot_motions_memory *c, int chosen,
                         int root) {
  const frot_contact_instant *one = &c->one;
  int count = 0, whole = 1;
  for (int i = 0; i < one->problem.n_items; i++)
    whole &= in->w->search.component[one->contact_of[i]] == root;
  for (int k = 0; k < c->list->count; k++) {
    const frot_found_motion *found = &c->list->found[k];
    int known = (whole && found->same >= 0) || (found->family && k != chosen);
    for (int j = 0; j < k && !whole && !known; j++) {
      known = 1;
      for (int i = 0; i < one->problem.n_items; i++)
        if (in->w->search.component[one->contact_of[i]] == root)
          known &= c->list->found[j].states[i].mode == found->states[i].mode;
    }
    count += !known;
  }
  return count;
}

int frot_take_motion(const frot_instant *in, const frot_motions_memory *c, int k, const int *chosen,
                     int count) {
  frot_search_work *search = &in->w->search;
  const frot_found_motion *found = &c->list->found[k];
  frot_instant given = *in;
  int unsearched = 0, root = search->component[chosen[0]], taken = 0;
  give_modes(in, &c->one, found);
  note_departed(in, &c->one, found, root);
  given.given = search->given;
  give_directions(in, &c->one, found);
  taken = frot_search_lasting(&given, chosen, count, &unsearched) > 0 && !unsearched;
  if (!taken) taken = take_bounds(&given, &c->one, found, chosen, count);
  search->lasts = 1;
  if (!taken) note_departed(in, &c->one, NULL, root);
  return taken ? count_motions(in, c, k, root) : 0;
}
