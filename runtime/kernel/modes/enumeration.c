/* Enumeration of the modes of a component, and the choice among its motions. */
#include "modes/enumeration.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "reactions/switching_functions.h"
#include "modes/mode_options.h"
#include "reactions/reactions.h"
#include "numerics/tolerances.h"

/* Whether a contact goes on as before. Of one that is held all round the side follows from the
 * reaction: it is no choice. */
static int same_contact(const frot_instant *in, int i) {
  const frot_contact_mode *a = &in->w->search.trial[i], *b = &in->w->search.before[i];
  int follows = in->unilateral[i] == 0 && frot_all_held(in, i);
  return a->closed == b->closed && (!a->closed || follows || a->side == b->side);
}

/* Whether an element has the friction in w->search.trial that it had before the instant. */
static int same_element(const frot_instant *in, int e) {
  return frot_element_mode(in->m, in->w->search.trial, e)->friction ==
         frot_element_mode(in->m, in->w->search.before, e)->friction;
}

/* Whether an element has come to its bound and rests all the same by itself: its guard falls again
 * at once. */
static int stays_beyond(const frot_instant *in, int e) {
  const frot_contact_mode *mode = frot_element_mode(in->m, in->w->search.trial, e);
  return in->left[e] != 0 && mode->friction == FROT_STICK && mode->at_bound == 0;
}

/* How much a combination is preferred: what needs no slack first; what will need none, if it was
 * looked for, else what time can go on in; then rest by itself, then continuity, or the other way
 * round. */
static long long preference(const frot_instant *in, const int *chosen, int count, int lasting) {
  const frot_model *m = in->m;
  long long rest = 0, kept = 0;
  int own[FROT_LAWS_OF_CONTACT], moves = 1;
  for (int c = 0; c < count; c++) {
    int laws = frot_laws_of(m, chosen[c], own);
    kept += same_contact(in, chosen[c]);
    for (int k = 0; k < laws; k++) {
      moves &= !stays_beyond(in, own[k]);
      const frot_contact_mode *mode = frot_element_mode(m, in->w->search.trial, own[k]);
      rest += mode->friction == FROT_STICK && mode->at_bound == 0;
      kept += same_element(in, own[k]);
    }
  }
  long long big = (1 + FROT_LAWS_OF_CONTACT) * m->n_contacts + 1;
  long long exact = frot_is_exact(in, chosen, count) ? 2 * big * big : 0;
  if (lasting ? !in->w->search.falls : moves) exact += big * big;
  int continues = in->s->options.on_indeterminate == FROT_CONTINUE;
  return exact + (continues ? kept * big + rest : rest * big + kept);
}

/* What the reactions that came to zero at the instant, which is known no better than they are zero
 * in the terms they had, could do to a row. */
static double unresolved(const frot_instant *in, const frot_group *g, int row) {
  double sum = 0;
  for (int i = 0; i < g->n_contacts; i++) {
    int c = g->contacts[i], normal = in->m->contacts[c].row_n;
    if (in->vanished[c] > 0 && in->w->core.wanted[normal])
      sum += in->vanished[c] * fabs(frot_effect(in->m, in->w, row, normal));
  }
  return FROT_LOCATED * sum;
}

/* The motion of w->search.trial as the accelerations of its rows, into place `at` of
 * w->search.motions unless one of the motions before is the same to what rounding of their terms
 * can do; returns their number.
 */
static int count_motion(const frot_instant *in, const int *chosen, int motions) {
  const frot_model *m = in->m;
  const frot_group *g = &m->groups[m->contact_group[chosen[0]]];
  double *own = in->w->search.motions + (size_t)FROT_MOST_MOTIONS * (size_t)m->n_rows;
  if (motions >= FROT_MOST_MOTIONS) return motions;
  for (int at = 0; at <= motions; at++) {
    const double *other = in->w->search.motions + (size_t)at * (size_t)m->n_rows;
    int differs = 0;
    for (int i = 0; i < g->n_rows; i++) {
      int r = g->rows[i];
      if (frot_is_reading(m, r) || !in->w->core.wanted[r]) continue;
      double size, a = frot_acceleration(m, in->w, r, &size);
      own[r] = a;
      differs |= fabs(a - other[r]) > FROT_DIFFERENT * (size + in->w->core.row_load[r]) +
                                          2 * frot_row_rounding(m, in->w, r) + unresolved(in, g, r);
    }
    if (at == motions) break;
    if (!differs) return motions;
  }
  memcpy(in->w->search.motions + (size_t)motions * (size_t)m->n_rows, own,
         sizeof(double) * (size_t)m->n_rows);
  return motions + 1;
}

/* Keep the directions of a pin's reactions to go on from; of one that slips on they may have come
 * to zero. */
static void remember_directions(const frot_instant *in, int e) {
  const frot_element *element = &in->m->elements[e];
  int slips = frot_element_mode(in->m, in->w->search.before, e)->friction > FROT_STICK;
  for (int k = 0; k < FROT_NORMS && element->bound == FROT_BY_PIN; k++) {
    int at = FROT_BOUNDING * e + frot_norm_first(element, k);
    if (element->norm[k] == 0 || (slips && !frot_has_direction(in->m, in->s, in->w, e, k)))
      continue;
    memcpy(in->w->search.along + at, in->w->reactions.along + at,
           sizeof(double) * (size_t)element->norm[k]);
  }
}

void frot_remember_modes(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  in->w->search.exact = frot_is_exact(in, chosen, count);
  in->w->search.fades = in->w->search.falls;
  int own[FROT_LAWS_OF_CONTACT];
  for (int c = 0; c < count; c++) {
    int laws = frot_laws_of(m, chosen[c], own);
    in->w->search.best[chosen[c]] = in->w->search.trial[chosen[c]];
    for (int k = 0; k < laws; k++) {
      in->w->search.best[m->n_contacts + own[k]] = in->w->search.trial[m->n_contacts + own[k]];
      remember_directions(in, own[k]);
    }
  }
}

/* Whether the motion lasts, with these reactions or, where they are not unique, with others. */
static int lasts(const frot_instant *in, const int *chosen, int count) {
  return frot_lasts(in, chosen, count) || frot_others_last(in, chosen, count);
}

/* Examine all combinations of the options; those of contacts that are `certain` (may be NULL) stay
 * as they are in w->trial. */
static int enumerate(const frot_instant *in, const int *chosen, int count, int forced, int lasting,
                     const unsigned char *certain) {
  frot_work *w = in->w;
  frot_option lists[FROT_OPTIONS];
  int *options = w->search.choice, *digit = w->search.choice + count, motions = 0, any = 0;
  long long best = 0;
  for (int c = 0; c < count; c++) {
    int fixed = certain && certain[chosen[c]];
    options[c] = fixed ? 1 : frot_contact_options(in, chosen[c], forced, lists);
    digit[c] = 0;
    if (options[c] == 0) return 0;
    if (!fixed) frot_take_option(in, chosen[c], &lists[0]);
  }
  size_t modes = (size_t)(in->m->n_contacts + in->m->n_elements);
  memcpy(w->search.guess, w->search.trial, sizeof *w->search.trial * modes);
  for (;;) {
    if (frot_is_admissible(in, chosen, count) && (!lasting || lasts(in, chosen, count))) {
      long long rank = preference(in, chosen, count, lasting);
      motions = count_motion(in, chosen, motions);
      if (!any || rank > best) best = rank, frot_remember_modes(in, chosen, count);
      any = 1;
    }
    /* what frot_is_admissible has set at bounds is taken back */
    int c = 0;
    for (; c < count; c++) {
      if (options[c] > 1) {
        digit[c] = (digit[c] + 1) % options[c];
        frot_contact_options(in, chosen[c], forced, lists);
        frot_take_option(in, chosen[c], &lists[digit[c]]);
        if (digit[c] != 0) break;
      }
    }
    if (c == count) return motions;
    for (int k = 0; k < count; k++) {
      if (options[k] > 1) {
        frot_contact_options(in, chosen[k], forced, lists);
        frot_take_option(in, chosen[k], &lists[digit[k]]);
      } else {
        int own[FROT_LAWS_OF_CONTACT], laws = frot_laws_of(in->m, chosen[k], own);
        w->search.trial[chosen[k]] = w->search.guess[chosen[k]];
        for (int j = 0; j < laws; j++)
          w->search.trial[in->m->n_contacts + own[j]] = w->search.guess[in->m->n_contacts + own[j]];
      }
    }
  }
}

/* Whether anything moves in the group of a contact. */
static int moves(const frot_instant *in, int contact) {
  const frot_group *g = &in->m->groups[in->m->contact_group[contact]];
  for (int k = 0; k < g->n_speeds; k++)
    if (in->v[g->unknowns[k]] != 0) return 1;
  return 0;
}

/* Whether the load of w->search.trial is shared in a way that lasts, where something moves in one
 * for a little later; then that is remembered. */
static int share(const frot_instant *in, const int *chosen, int count) {
  frot_contact_mode *trial = in->w->search.trial, *first = in->w->search.guess;
  size_t modes = sizeof *trial * (size_t)(in->m->n_contacts + in->m->n_elements);
  memcpy(first, trial, modes);
  for (int later = moves(in, chosen[0]); later >= 0; later--) {
    memcpy(trial, first, modes);
    int shared = later ? frot_share_later(in, chosen, count)
                       : frot_share_load(in, chosen, count) == FROT_SHARED;
    if (!shared || !frot_is_admissible(in, chosen, count) || !frot_lasts(in, chosen, count))
      continue;
    frot_remember_modes(in, chosen, count);
    return 1;
  }
  return 0;
}

/* Whether all that may stay at rest does, its load shared in some way, while what slips goes on:
 * then these modes are remembered. */
static int can_rest(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  int own[FROT_LAWS_OF_CONTACT];
  memset(w->search.trial, 0, sizeof *w->search.trial * (size_t)(m->n_contacts + m->n_elements));
  for (int c = 0; c < count; c++) {
    int laws = frot_laws_of(m, chosen[c], own);
    frot_contact_mode *contact = &w->search.trial[chosen[c]];
    *contact = w->search.best[chosen[c]];
    if (contact->side == 0) contact->side = 1;
    for (int k = 0; k < laws; k++) {
      double rate = w->core.rate[m->elements[own[k]].row];
      frot_contact_mode *law = &w->search.trial[m->n_contacts + own[k]];
      *law = *frot_element_mode(m, w->search.before, own[k]);
      if (!frot_bounds_something(m, w, own[k])) continue;
      if (in->zero[own[k]] && !in->at_rest[own[k]]) return 0;
      law->friction = in->zero[own[k]] ? FROT_STICK
                      : rate > 0       ? FROT_SLIP_FORWARD
                                       : FROT_SLIP_BACKWARD;
    }
  }
  w->search.corners = FROT_ENOUGH;
  frot_begin_directions(in);
  return share(in, chosen, count);
}

int frot_rest_goes_on(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  int own[FROT_LAWS_OF_CONTACT];
  for (int c = 0; c < count; c++) {
    int laws = frot_laws_of(m, chosen[c], own);
    if (!in->w->search.before[chosen[c]].closed) return 0;
    for (int k = 0; k < laws; k++) {
      const frot_contact_mode *before = frot_element_mode(m, in->w->search.before, own[k]);
      int bounds = frot_bounds_something(m, in->w, own[k]);
      if (bounds && (before->friction != FROT_STICK || !in->at_rest[own[k]])) return 0;
    }
  }
  return can_rest(in, chosen, count);
}

/* Whether a guard of the contact or of its elements fired. */
static int left_here(const frot_instant *in, int i) {
  int own[FROT_LAWS_OF_CONTACT], laws = frot_laws_of(in->m, i, own), any = in->fired[i] != 0;
  for (int k = 0; k < laws; k++) any |= in->left[own[k]] != 0;
  return any;
}

/* The guess of the modes mended until they are admissible: one motion, or none. What falls later,
 * though no more than slack admits, is changed in turn. */
static int mend_guess(const frot_instant *in, const int *chosen, int count, int forced,
                      int lasting) {
  int first = 0, *falls = &in->w->search.falls;
  for (int tries = 0; tries <= count; tries++) {
    if (!frot_mend_modes(in, chosen, count, forced)) break;
    if (lasting && !lasts(in, chosen, count)) break;
    int better = tries == 0 || (*falls == 0 && frot_is_exact(in, chosen, count));
    if (better) frot_remember_modes(in, chosen, count);
    if (better && (!lasting || *falls == 0)) return 1;
    if (tries == 0) first = *falls;
    if (!frot_change_mode(in, *falls - 1, forced)) break;
  }
  *falls = first;
  return first != 0;
}

/* One motion by pivoting; where it needs slack what it leaves in doubt is examined. `ends`: a rest
 * ends now. */
static int search_near(const frot_instant *in, const int *chosen, int count, int forced,
                       int lasting, int ends) {
  unsigned char *certain = in->w->search.certain;
  frot_option lists[FROT_OPTIONS];
  double combinations = 1;
  frot_guess_modes(in, chosen, count, ends, 0, certain);
  if (mend_guess(in, chosen, count, forced, lasting) && in->w->search.exact &&
      !(lasting && in->w->search.falls))
    return 1;
  frot_guess_modes(in, chosen, count, ends, 0, certain);
  for (int c = 0; c < count; c++) {
    int options = frot_contact_options(in, chosen[c], forced, lists);
    if (left_here(in, chosen[c])) certain[chosen[c]] = 0;
    if (certain[chosen[c]]) continue;
    if (combinations * options > FROT_ENOUGH)
      certain[chosen[c]] = 1;
    else
      combinations *= options;
  }
  int motions = enumerate(in, chosen, count, forced, lasting, certain);
  if (motions > 0) return motions;
  for (int later = 0; later <= frot_loads_grow(in, chosen[0]); later++) {
    frot_guess_modes(in, chosen, count, ends, later, certain);
    if (mend_guess(in, chosen, count, forced, lasting)) return 1;
  }
  return 0;
}

static int search_all(const frot_instant *in, const int *chosen, int count, int forced, int lasting,
                      int *unsearched) {
  frot_work *w = in->w;
  const frot_model *m = in->m;
  frot_option lists[FROT_OPTIONS];
  double combinations = 1;
  for (int c = 0; c < count; c++)
    combinations *= frot_contact_options(in, chosen[c], forced, lists);
  memset(w->search.trial, 0, sizeof *w->search.trial * (size_t)(m->n_contacts + m->n_elements));
  /* where others were not looked for they are not either when the friction of what departs changes
   */
  if (combinations <= FROT_ENOUGH && !*unsearched)
    return enumerate(in, chosen, count, forced, lasting, NULL);
  *unsearched = 1;
  if (in->s->options.on_indeterminate != FROT_CONTINUE && can_rest(in, chosen, count)) return 1;
  int motions = search_near(in, chosen, count, forced, lasting, forced);
  /* the rest ends though what fired stays as it is: others carry what it carried */
  if (motions == 0 && !forced) motions = search_near(in, chosen, count, 0, lasting, 1);
  return motions;
}

/* A corner of reactions that are not unique may come to an end, and no other is looked for then:
 * corners are tried only where there is no motion without, and one was asked for. */
int frot_search(const frot_instant *in, const int *chosen, int count, int forced, int lasting,
                int *unsearched) {
  in->w->search.corners = 0;
  int motions = search_all(in, chosen, count, forced, lasting, unsearched);
  if (motions > 0 || in->w->search.corners == 0) return motions;
  in->w->search.corners = FROT_ENOUGH;
  return search_all(in, chosen, count, forced, lasting, unsearched);
}

int frot_search_corners(const frot_instant *in, const int *chosen, int count, int *unsearched) {
  in->w->search.corners = FROT_ENOUGH;
  return search_all(in, chosen, count, 0, 1, unsearched);
}
