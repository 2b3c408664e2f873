/* A guess of the modes of many contacts mended: what is violated most changes, one at a time.
 *
 * Principal pivoting (K. Murty, Linear Complementarity, Linear and Nonlinear Programming, 1988, ch.
 * 4): of laws that are no cone too, as friction at rest above that of motion, where a rest that
 * ends loads its neighbours at once and may end theirs. Where the worst goes round in a circle the
 * first is taken. What is found is a motion; that others exist is not looked for. One that needs
 * slack is mended on, for the next step would take it back. What the accelerations say nothing of,
 * in a dead centre, goes as it does a little later. */
#include <math.h>
#include <string.h>

#include "model/indexing.h"
#include "modes/mode_options.h"
#include "reactions/reactions.h"
#include "modes/enumeration.h"
#include "numerics/tolerances.h"

/* Changes for each of the contacts and elements: by the worst, then by the first. */
#define WORST 4
#define FIRST 4

/* Whether option o says of a contact and its elements what the trial says, but for sides. */
static int says(const frot_instant *in, int i, const frot_option *o) {
  int own[FROT_LAWS_OF_CONTACT], laws = frot_laws_of(in->m, i, own);
  if (o->contact.closed != in->w->search.trial[i].closed) return 0;
  for (int k = 0; k < laws && o->contact.closed; k++)
    if (o->element[k].friction != frot_element_mode(in->m, in->w->search.trial, own[k])->friction)
      return 0;
  return 1;
}

/* Bring the modes of a contact to what it may do, all of its reactions its own. Returns 0 where it
 * may not do what the trial says: then its first option is taken. */
static int put_right(const frot_instant *in, int i, int forced) {
  frot_option list[FROT_OPTIONS];
  int n = frot_contact_options(in, i, forced, list), side = in->w->search.trial[i].side, found = -1;
  for (int k = 0; k < n && !(found >= 0 && list[found].contact.side == side); k++) {
    const frot_option *o = &list[k];
    if (o->contact.unloaded || o->element[0].at_bound != 0 || o->element[1].at_bound != 0) continue;
    if (says(in, i, o)) found = k;
  }
  frot_take_option(in, i, &list[found < 0 ? 0 : found]);
  return found >= 0;
}

/* Of what the trial violates the worst, or the first: contact k < n_contacts or element
 * k - n_contacts; -1 for none. `exactly`: of elements also what holds by slack alone. */
static int violated(const frot_instant *in, const int *chosen, int count, int first, int exactly) {
  const frot_model *m = in->m;
  double least = 0;
  int found = -1;
  for (int c = 0; c < count && !(first && found >= 0); c++) {
    int own[FROT_LAWS_OF_CONTACT], i = chosen[c], laws = frot_laws_of(m, i, own);
    double margin = frot_margin_of_contact(in, i);
    if (margin < 1 && in->w->search.trial[i].closed) margin = frot_pressure(in, i);
    /* held all round, the side follows from the reaction */
    if (in->unilateral[i] == 0 && margin < 0 && frot_all_held(in, i)) margin = 0;
    if (margin < fmin(least, -FROT_BOUND_SLACK)) least = margin, found = i;
    for (int k = 0; k < laws; k++) {
      margin = frot_margin_of_element(in, own[k]);
      if (margin < 1 && frot_is_held(m, in->w->search.trial, own[k]))
        margin = frot_reserve(in, own[k]);
      if (!(margin < least)) continue;
      if (margin < -FROT_BOUND_SLACK || (exactly && !frot_element_is_exact(in, own[k])))
        least = margin, found = m->n_contacts + own[k];
    }
  }
  return found;
}

/* What is violated changes: a contact opens, closes or presses on its other side, a rest ends in
 * the direction that its reaction is beyond the bound of, a slip that would start backward rests
 * or, if it has departed, turns. */
int frot_change_mode(const frot_instant *in, int k, int forced) {
  const frot_model *m = in->m;
  frot_contact_mode *mode = &in->w->search.trial[k];
  int i = k, e = k - m->n_contacts;
  if (e < 0 && (!mode->closed || in->unilateral[k] != 0)) {
    mode->closed = !mode->closed;
  } else if (e < 0) {
    mode->side = (signed char)-mode->side;
  } else {
    int back = mode->friction == FROT_STICK ? in->w->core.lam[m->elements[e].row] > 0
                                            : mode->friction == FROT_SLIP_FORWARD;
    int rests = mode->friction != FROT_STICK && in->at_rest[e];
    i = m->elements[e].contact;
    mode->friction = rests ? FROT_STICK : back ? FROT_SLIP_BACKWARD : FROT_SLIP_FORWARD;
  }
  return put_right(in, i, forced);
}

/* Whether what is violated is so by the reactions that were taken alone, where they are not unique:
 * then others hold. Else they are left as they were. */
static int shares(const frot_instant *in, const frot_group *g, const int *chosen, int count) {
  if (!in->w->reactions.dependent) return 0;
  if (frot_is_admissible(in, chosen, count)) return 1;
  frot_group_reactions(in->m, in->w, g, in->w->search.trial, in->resists);
  return 0;
}

/* Change one after the other until nothing is violated; returns whether the trial is admissible. */
static int mend(const frot_instant *in, const int *chosen, int count, int forced, int exactly) {
  const frot_group *g = &in->m->groups[in->m->contact_group[chosen[0]]];
  int all = count + g->n_elements;
  for (int round = 0; round < (WORST + FIRST) * all; round++) {
    if (frot_group_reactions(in->m, in->w, g, in->w->search.trial, in->resists)) return 0;
    int k = violated(in, chosen, count, round >= WORST * all, exactly);
    if (k >= 0 && shares(in, g, chosen, count)) return 1;
    if (k < 0 && frot_is_admissible(in, chosen, count)) return 1;
    if (k < 0 ? !frot_follow_ahead(in, g) : !frot_change_mode(in, k, forced)) return 0;
  }
  return 0;
}

int frot_mend_modes(const frot_instant *in, const int *chosen, int count, int forced) {
  frot_contact_mode *trial = in->w->search.trial, *slack = in->w->search.guess;
  size_t modes = sizeof *trial * (size_t)(in->m->n_contacts + in->m->n_elements);
  frot_begin_directions(in);
  for (int c = 0; c < count; c++) put_right(in, chosen[c], forced);
  if (!mend(in, chosen, count, forced, 0)) return 0;
  if (frot_is_exact(in, chosen, count)) return 1;
  memcpy(slack, trial, modes);
  if (mend(in, chosen, count, forced, 1) && frot_is_exact(in, chosen, count)) return 1;
  memcpy(trial, slack, modes);
  return frot_is_admissible(in, chosen, count);
}
