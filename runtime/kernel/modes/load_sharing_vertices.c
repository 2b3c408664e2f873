/* Reactions that are not unique: which elements are at their bounds and which contacts carry
 * nothing, so that the others carry the load.
 *
 * Where friction is bounded by cones of reactions that press, a linear program says it
 * (load_sharing_lp.c). Else the worst is put at its bound until none is left, and where that leads
 * nowhere each is tried: the reactions that hold a load are a body with edges, and where it is not
 * empty it has a corner, at which as many inequalities are equalities as reactions are not unique.
 */
#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "model/indexing.h"
#include "numerics/dense.h"
#include "modes/mode_options.h"
#include "numerics/basis.h"
#include "reactions/reactions.h"
#include "modes/enumeration.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

#define MOST 6         /* elements whose friction is free that are put at their bounds together */
#define UNCHANGED 1e-6 /* part by which what no other reactions change may differ by rounding */

/* Whether an element was at its bound until now, or has come to it. */
static int was_at_bound(const frot_instant *in, int e) {
  return frot_element_mode(in->m, in->w->search.before, e)->at_bound != 0 || in->left[e] != 0;
}

/* The same of any of them. */
static int some_were_at_bound(const frot_instant *in, const int *chosen, int count) {
  int own[FROT_LAWS_OF_CONTACT], some = 0;
  for (int c = 0; c < count; c++) {
    int laws = frot_laws_of(in->m, chosen[c], own);
    for (int k = 0; k < laws; k++) some |= was_at_bound(in, own[k]);
  }
  return some;
}

/* The loaded contact whose reaction is worst beyond what is admissible or, if none is, the element;
 * -1 for the other. With `touching` what was at its bound is beyond it where it is there to slack.
 * Returns whether there is any. */
static int find_worst(const frot_instant *in, const int *chosen, int count, int touching,
                      int *contact, int *friction) {
  const frot_model *m = in->m;
  const frot_contact_mode *trial = in->w->search.trial;
  double most = -FROT_BOUND_SLACK;
  int worst_contact = -1, worst_element = -1;
  for (int c = 0; c < count; c++) {
    int i = chosen[c];
    if (!frot_is_loaded(m, trial, i) || !frot_must_press(in, i)) continue;
    double left = frot_pressure(in, i);
    if (left < most) most = left, worst_contact = i;
  }
  for (int e = 0; e < m->n_elements && worst_contact < 0; e++) {
    int among = 0;
    for (int c = 0; c < count; c++) among |= chosen[c] == m->elements[e].contact;
    if (!among || !frot_is_held(m, trial, e)) continue;
    double left = frot_reserve(in, e);
    if (touching && was_at_bound(in, e)) left -= 2 * FROT_BOUND_SLACK;
    if (left < most) most = left, worst_element = e;
  }
  *contact = worst_contact, *friction = worst_element;
  return worst_contact >= 0 || worst_element >= 0;
}

/* Whether the modes say of a contact that it carries nothing, or of an element that it is at its
 * bound. */
static int gives_bounds(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  const frot_contact_mode *trial = in->w->search.trial;
  for (int c = 0; c < count; c++) {
    if (trial[chosen[c]].unloaded) return 1;
    for (int e = 0; e < m->n_elements; e++)
      if (m->elements[e].contact == chosen[c] && trial[m->n_contacts + e].at_bound != 0) return 1;
  }
  return 0;
}

/* The reactions of w->search.trial anew. Returns 0 where there are none. */
static int solve(const frot_instant *in, int contact) {
  const frot_group *g = &in->m->groups[in->m->contact_group[contact]];
  return !frot_group_reactions(in->m, in->w, g, in->w->search.trial, in->resists);
}

/* Put the worst at its bound or without load until nothing is beyond what is admissible. */
static int relieve(const frot_instant *in, const int *chosen, int count, int touching) {
  const frot_model *m = in->m;
  frot_contact_mode *trial = in->w->search.trial;
  int contact, element;
  while (find_worst(in, chosen, count, touching, &contact, &element)) {
    if (contact >= 0)
      trial[contact].unloaded = 1;
    else
      trial[m->n_contacts + element].at_bound =
          in->w->core.lam[m->elements[element].row] > 0 ? 1 : -1;
    if (!solve(in, chosen[0])) return 0;
  }
  return frot_reactions_hold(in, chosen, count);
}

/* By how much the reactions of w->search.trial are beyond their inequalities, of contacts and then
 * of elements, into `beyond`: 0 where there is none or it holds. Returns how many do not hold. */
static int list_violated(const frot_instant *in, const int *chosen, int count, double *beyond) {
  const frot_model *m = in->m;
  const frot_contact_mode *trial = in->w->search.trial;
  const double *lam = in->w->core.lam;
  int own[FROT_LAWS_OF_CONTACT], violated = 0;
  memset(beyond, 0, sizeof(double) * (size_t)(m->n_contacts + m->n_elements));
  for (int c = 0; c < count; c++) {
    int i = chosen[c], laws = frot_laws_of(m, i, own);
    if (frot_is_loaded(m, trial, i) && frot_must_press(in, i) &&
        frot_pressure(in, i) < -FROT_BOUND_SLACK)
      beyond[i] = fabs(lam[m->contacts[i].row_n]), violated++;
    for (int k = 0; k < laws; k++) {
      int e = own[k];
      if (!frot_is_held(m, trial, e) || !(frot_reserve(in, e) < -FROT_BOUND_SLACK)) continue;
      double bound = fabs(frot_bound_of_rest(m, in->w, e, trial));
      beyond[m->n_contacts + e] = fabs(lam[m->elements[e].row]) - bound, violated++;
    }
  }
  return violated;
}

/* Whether an inequality that does not hold is one that no other reactions change: on what two of
 * them agree, weighed in other ways, all do. Then there is no corner to look for. */
static int is_hopeless(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  double *beyond = in->w->search.beyond, *again = beyond + m->n_contacts + m->n_elements;
  int hopeless = 0;
  if (!list_violated(in, chosen, count, beyond)) return 0;
  const frot_group *g = &m->groups[m->contact_group[chosen[0]]];
  if (!frot_even_reactions(m, in->w, g, in->w->search.trial, in->resists)) {
    list_violated(in, chosen, count, again);
    for (int k = 0; k < m->n_contacts + m->n_elements; k++)
      hopeless |= beyond[k] > 0 && fabs(again[k] - beyond[k]) <= UNCHANGED * beyond[k];
  }
  return hopeless || !solve(in, chosen[0]);
}

/* Whether the reactions of w->search.trial hold now and a little later. */
static int hold_on(const frot_instant *in, const int *chosen, int count) {
  return frot_is_admissible(in, chosen, count) && frot_lasts(in, chosen, count);
}

/* Whether reactions hold with more of the contacts and elements from `first` on at their bounds,
 * and with `lasting` beyond the instant; the first of each contact stands before its elements.
 * Reactions of w->search.trial are solved. */
static int find_corner(const frot_instant *in, const int *chosen, int count, int lasting,
                       int first) {
  const frot_model *m = in->m;
  frot_contact_mode *trial = in->w->search.trial;
  if (!in->w->reactions.dependent)
    return lasting ? hold_on(in, chosen, count) : frot_reactions_hold(in, chosen, count);
  int all = count + m->n_elements;
  for (int k = first; k < all; k++) {
    int e = k - count, contact = e < 0 ? chosen[k] : m->elements[e].contact, among = e < 0;
    for (int c = 0; c < count; c++) among |= chosen[c] == contact;
    if (!among || (e < 0 ? !frot_is_loaded(m, trial, contact) || !frot_must_press(in, contact)
                         : !frot_is_held(m, trial, e)))
      continue;
    for (int way = 1; way >= (e < 0 ? 1 : -1); way -= 2) {
      if (in->w->search.corners-- <= 0) return 0;
      if (e < 0)
        trial[contact].unloaded = 1;
      else
        trial[m->n_contacts + e].at_bound = (signed char)(way * trial[contact].side);
      if (solve(in, chosen[0]) && find_corner(in, chosen, count, lasting, k + 1)) return 1;
      if (e < 0)
        trial[contact].unloaded = 0;
      else
        trial[m->n_contacts + e].at_bound = 0;
    }
  }
  return 0;
}

/* The elements chosen that rest and that no speed moves beside what closes the group, as the slide
 * of a crank in its dead centre: their friction is free, and loads pins that hold by it. After the
 * reactions of w->search.trial; returns how many, of the first MOST. */
static int list_idle(const frot_instant *in, const int *chosen, int count, int idle[MOST]) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const frot_group *g = &m->groups[m->contact_group[chosen[0]]];
  const frot_contact_mode *trial = w->search.trial;
  int n = 0, rank = 0, ns = g->n_speeds, own[FROT_LAWS_OF_CONTACT];
  for (int i = 0; i < g->n_contacts; i++)
    rank += frot_is_loaded(m, trial, g->contacts[i]) &&
            !w->reactions.carried[m->contacts[g->contacts[i]].row_n];
  for (int c = 0; c < count && !g->general; c++) {
    int laws = frot_laws_of(m, chosen[c], own);
    for (int k = 0; k < laws && n < MOST; k++) {
      int row = m->elements[own[k]].row;
      if (!frot_is_held(m, trial, own[k]) || !w->reactions.carried[row]) continue;
      double *x = w->core.rest;
      memcpy(x, frot_entries(m, w->core.half, row), sizeof(double) * (size_t)ns);
      double length = frot_length_beside(m, w, row, frot_length(x, ns));
      double rest = frot_reject(x, w->span.basis, rank, ns, w->span.parts);
      if (rest <= FROT_DEPENDENT * length) idle[n++] = own[k];
    }
  }
  return n;
}

/* Put the idle elements at their bounds as the digits of `code` to the base 3 say: at neither, at
 * the one, at the other. Returns how many are. */
static int put_at_bounds(const frot_instant *in, const int *idle, int n, int code) {
  frot_contact_mode *trial = in->w->search.trial;
  int put = 0;
  for (int i = 0; i < n; i++, code /= 3) {
    int way = code % 3 == 2 ? -1 : code % 3, contact = in->m->elements[idle[i]].contact;
    trial[in->m->n_contacts + idle[i]].at_bound = (signed char)(way * trial[contact].side);
    put += way != 0;
  }
  return put;
}

/* Whether reactions hold, and with `lasting` beyond the instant, with what is idle at its bounds
 * and the worst of the rest at theirs: with all of it first, for a friction that is free turns a
 * pin's reaction without end where it begins. Else the modes are as they were. */
static int relieve_idle(const frot_instant *in, const int *chosen, int count, int lasting) {
  const frot_model *m = in->m;
  int idle[MOST], n = list_idle(in, chosen, count, idle), combinations = 1;
  size_t size = (size_t)(m->n_contacts + m->n_elements);
  /* what lasts is looked for by looking at others in turn */
  frot_contact_mode *trial = in->w->search.trial,
                    *before = in->w->search.idle + (lasting ? size : 0);
  if (n == 0) return 0;
  for (int i = 0; i < n; i++) combinations *= 3;
  memcpy(before, trial, sizeof *trial * size);
  for (int at_bound = n, left = 1; left && at_bound > 0; at_bound--)
    for (int code = 1; left && code < combinations; code++) {
      memcpy(trial, before, sizeof *trial * size);
      if (put_at_bounds(in, idle, n, code) != at_bound) continue;
      left = in->w->search.corners-- > 0;
      if (!left) break;
      if (solve(in, chosen[0]) && relieve(in, chosen, count, 0) &&
          (!lasting || hold_on(in, chosen, count)))
        return 1;
    }
  memcpy(trial, before, sizeof *trial * size);
  solve(in, chosen[0]);
  return 0;
}

/* Reactions at a corner, as above. */
static int find_any(const frot_instant *in, const int *chosen, int count, int lasting) {
  return relieve_idle(in, chosen, count, lasting) || find_corner(in, chosen, count, lasting, 0);
}

int frot_others_carry(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  frot_contact_mode *trial = in->w->search.trial, *before = in->w->search.corner;
  size_t modes = sizeof *trial * (size_t)(m->n_contacts + m->n_elements);
  int worst;
  if (!gives_bounds(in, chosen, count) && !find_worst(in, chosen, count, 0, &worst, &worst))
    return frot_reactions_hold(in, chosen, count);
  enum frot_share share = frot_share_load(in, chosen, count);
  if (share == FROT_NO_SHARE) return 0;
  if (share == FROT_SHARED) return frot_reactions_hold(in, chosen, count);
  memcpy(before, trial, modes);
  for (int touching = some_were_at_bound(in, chosen, count); touching >= 0; touching--) {
    if (relieve(in, chosen, count, touching)) return 1;
    memcpy(trial, before, modes);
    if (!solve(in, chosen[0])) return 0;
  }
  return !is_hopeless(in, chosen, count) && find_any(in, chosen, count, 0);
}

int frot_others_last(const frot_instant *in, const int *chosen, int count) {
  if (!in->w->reactions.dependent) return 0;
  enum frot_share share = frot_share_load(in, chosen, count);
  if (share == FROT_NO_SHARE) return 0;
  return share == FROT_SHARED ? hold_on(in, chosen, count) : find_any(in, chosen, count, 1);
}
