/* Enumeration of the modes of a component, and the choice among its motions. */
#include "search.h"

#include <math.h>
#include <string.h>

#include "core.h"
#include "reactions.h"
#include "tolerances.h"

#define OPTIONS 40 /* of one contact: two elements with four modes each, two sides, open */
#define LAWS 2     /* elements of one contact at most */

/* Modes of a contact and of its elements. */
typedef struct {
  frot_contact_mode contact, element[LAWS];
} option;

static const frot_contact_mode OPEN = {0, 1, 0, 0, 0, {0}};

int frot_bounds_something(const frot_model *m, const frot_work *w, int element) {
  const double *k = w->core.coefficient + 2 * element;
  return !(m->elements[element].fixed && k[0] == 0 && k[1] == 0);
}

/* Elements of a contact; returns how many. */
static int elements_of(const frot_model *m, int contact, int own[LAWS]) {
  int n = 0;
  for (int e = 0; e < m->n_elements && n < LAWS; e++)
    if (m->elements[e].contact == contact) own[n++] = e;
  return n;
}

/* The direction in which rest ends now; a prescribed motion says itself. */
static int direction_left(const frot_instant *in, int e) {
  int left = (int)in->left[e];
  if (left != 0 && in->m->elements[e].prescribed)
    return in->w->core.c[in->m->elements[e].row] > 0 ? 1 : -1;
  return left;
}

/* The modes one element may take. */
static int element_options(const frot_instant *in, int e, int forced, frot_contact_mode *list) {
  static const signed char ways[3] = {FROT_STICK, FROT_SLIP_FORWARD, FROT_SLIP_BACKWARD};
  const frot_contact_mode still = {0, 0, 0, FROT_STICK, 0, {0}};
  int n = 0, left = direction_left(in, e);
  list[0] = still;
  if (!frot_bounds_something(in->m, in->w, e)) return list[0].friction = FROT_NONE, 1;
  if (!in->zero[e]) {
    double rate = in->w->core.rate[in->m->elements[e].row];
    return list[0].friction = rate > 0 ? FROT_SLIP_FORWARD : FROT_SLIP_BACKWARD, 1;
  }
  if (!in->at_rest[e]) { /* it departs, in either direction */
    list[0].friction = FROT_SLIP_FORWARD;
    list[1] = still, list[1].friction = FROT_SLIP_BACKWARD;
    return 2;
  }
  if (left != 0 && forced)
    return list[0].friction = left > 0 ? FROT_SLIP_FORWARD : FROT_SLIP_BACKWARD, 1;
  if (left != 0 && !in->m->elements[e].prescribed) /* others may hold what it cannot */
    list[n] = still, list[n++].at_bound = (signed char)-left;
  for (int k = 0; k < 3; k++) list[n] = still, list[n++].friction = ways[k];
  return n;
}

static int contact_options(const frot_instant *in, int i, int forced, option *list) {
  const frot_contact *contact = &in->m->contacts[i];
  frot_contact_mode before = in->w->search.before[i], modes[LAWS][4];
  int own[LAWS], counts[LAWS] = {1, 1}, laws = elements_of(in->m, i, own), n = 0;
  int can_open = in->unilateral[i] != 0 && frot_has_normal(contact);
  int one_sided = can_open || !frot_has_normal(contact), acts = 0;
  int changes = forced && before.closed && in->fired[i] != 0;
  memset(modes, 0, sizeof modes);
  for (int k = 0; k < laws; k++) {
    counts[k] = element_options(in, own[k], forced, modes[k]);
    acts |= modes[k][0].friction != FROT_NONE;
  }
  /* a reaction that came to zero may stay there, if others carry the load */
  int unloads = before.closed && can_open && !contact->reduced && in->fired[i] != 0;
  for (int a = 0; a < counts[0] && !(changes && can_open); a++)
    for (int b = 0; b < counts[1]; b++)
      for (int side = 1; side >= -1; side -= 2) {
        int held = modes[0][a].friction <= FROT_STICK && modes[1][b].friction <= FROT_STICK;
        int turns = changes && !one_sided;
        if (side < 0 && (one_sided || !acts)) continue;
        if (turns && side == before.side) continue;
        /* the side follows from the reaction, but friction at its bound from the side */
        if (side < 0 && !turns && held && !modes[0][a].at_bound && !modes[1][b].at_bound) continue;
        for (int unloaded = unloads; unloaded >= 0; unloaded--, n++)
          list[n] = (option){{1, (signed char)side, (signed char)unloaded, 0, 0, {0}},
                             {modes[0][a], modes[1][b]}};
      }
  if (can_open) list[n] = (option){OPEN, {{0}, {0}}}, n++;
  return n;
}

static void take(const frot_instant *in, int i, const option *chosen) {
  int own[LAWS], laws = elements_of(in->m, i, own);
  in->w->search.trial[i] = chosen->contact;
  for (int k = 0; k < laws; k++)
    in->w->search.trial[in->m->n_contacts + own[k]] = chosen->element[k];
}

static int same(const frot_contact_mode *a, const frot_contact_mode *b) {
  return a->closed == b->closed && a->friction == b->friction && (!a->closed || a->side == b->side);
}

/* How much a combination is preferred: rest first, then continuity, or the other way round. */
static int preference(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  int rest = 0, kept = 0, own[LAWS];
  for (int c = 0; c < count; c++) {
    int laws = elements_of(m, chosen[c], own);
    kept += same(&in->w->search.trial[chosen[c]], &in->w->search.before[chosen[c]]);
    for (int k = 0; k < laws; k++) {
      const frot_contact_mode *mode = frot_element_mode(m, in->w->search.trial, own[k]);
      rest += mode->friction == FROT_STICK;
      kept += same(mode, frot_element_mode(m, in->w->search.before, own[k]));
    }
  }
  int big = (1 + LAWS) * m->n_contacts + 1;
  return in->s->options.on_indeterminate == FROT_CONTINUE ? kept * big + rest : rest * big + kept;
}

/* The motion of w->search.trial as the accelerations of its rows, into place `at` of
 * w->search.motions unless one of the motions before is the same to what rounding of their terms
 * can do; returns their number.
 */
static int count_motion(const frot_instant *in, const int *chosen, int motions) {
  const frot_model *m = in->m;
  const frot_group *g = &m->groups[m->contact_group[chosen[0]]];
  double *own = in->w->search.motions + (size_t)(FROT_MOTIONS - 1) * (size_t)m->n_rows;
  if (motions >= FROT_MOTIONS - 1) return motions;
  for (int at = 0; at <= motions; at++) {
    const double *other = in->w->search.motions + (size_t)at * (size_t)m->n_rows;
    int differs = 0;
    for (int i = 0; i < g->n_rows; i++) {
      int r = g->rows[i];
      if (frot_is_reading(m, r) || !in->w->core.wanted[r]) continue;
      double size, a = frot_acceleration(m, in->w, r, &size);
      own[r] = a;
      differs |= fabs(a - other[r]) > FROT_DIFFERENT * (size + in->w->core.row_load[r]) +
                                          2 * frot_row_rounding(m, in->w, r);
    }
    if (at == motions) break;
    if (!differs) return motions;
  }
  memcpy(in->w->search.motions + (size_t)motions * (size_t)m->n_rows, own,
         sizeof(double) * (size_t)m->n_rows);
  return motions + 1;
}

static void remember(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  int own[LAWS];
  for (int c = 0; c < count; c++) {
    int laws = elements_of(m, chosen[c], own);
    in->w->search.best[chosen[c]] = in->w->search.trial[chosen[c]];
    for (int k = 0; k < laws; k++)
      in->w->search.best[m->n_contacts + own[k]] = in->w->search.trial[m->n_contacts + own[k]];
  }
}

/* Examine all combinations of the options; those of contacts that are `certain` (may be NULL) stay
 * as they are in w->trial. */
static int enumerate(const frot_instant *in, const int *chosen, int count, int forced, int lasting,
                     const unsigned char *certain) {
  frot_work *w = in->w;
  option lists[OPTIONS];
  int *options = w->search.choice, *digit = w->search.choice + count, motions = 0, best = 0,
      any = 0;
  for (int c = 0; c < count; c++) {
    int fixed = certain && certain[chosen[c]];
    options[c] = fixed ? 1 : contact_options(in, chosen[c], forced, lists);
    digit[c] = 0;
    if (!fixed) take(in, chosen[c], &lists[0]);
  }
  size_t modes = (size_t)(in->m->n_contacts + in->m->n_elements);
  memcpy(w->search.guess, w->search.trial, sizeof *w->search.trial * modes);
  for (;;) {
    if (frot_is_admissible(in, chosen, count) && (!lasting || frot_lasts(in, chosen, count))) {
      int rank = preference(in, chosen, count);
      motions = count_motion(in, chosen, motions);
      if (!any || rank > best) best = rank, remember(in, chosen, count);
      any = 1;
    }
    /* what frot_is_admissible has set at bounds is taken back */
    int c = 0;
    for (; c < count; c++) {
      if (options[c] > 1) {
        digit[c] = (digit[c] + 1) % options[c];
        contact_options(in, chosen[c], forced, lists);
        take(in, chosen[c], &lists[digit[c]]);
        if (digit[c] != 0) break;
      }
    }
    if (c == count) return motions;
    for (int k = 0; k < count; k++) {
      if (options[k] > 1) {
        contact_options(in, chosen[k], forced, lists);
        take(in, chosen[k], &lists[digit[k]]);
      } else {
        int own[LAWS], laws = elements_of(in->m, chosen[k], own);
        w->search.trial[chosen[k]] = w->search.guess[chosen[k]];
        for (int j = 0; j < laws; j++)
          w->search.trial[in->m->n_contacts + own[j]] = w->search.guess[in->m->n_contacts + own[j]];
      }
    }
  }
}

int frot_rest_goes_on(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  int own[LAWS];
  memset(w->search.trial, 0, sizeof *w->search.trial * (size_t)(m->n_contacts + m->n_elements));
  for (int c = 0; c < count; c++) {
    int laws = elements_of(m, chosen[c], own);
    w->search.trial[chosen[c]] = w->search.before[chosen[c]];
    if (!w->search.before[chosen[c]].closed) return 0;
    for (int k = 0; k < laws; k++) {
      const frot_contact_mode *before = frot_element_mode(m, w->search.before, own[k]);
      int bounds = frot_bounds_something(m, w, own[k]);
      if (bounds && (before->friction != FROT_STICK || !in->at_rest[own[k]])) return 0;
      w->search.trial[m->n_contacts + own[k]] = *before;
    }
  }
  w->search.corners = FROT_ENOUGH;
  if (frot_share_load(in, chosen, count) != FROT_SHARED) return 0;
  if (!frot_is_admissible(in, chosen, count) || !frot_lasts(in, chosen, count)) return 0;
  remember(in, chosen, count);
  return 1;
}

/* Whether a guard of the contact or of its elements fired. */
static int left_here(const frot_instant *in, int i) {
  int own[LAWS], laws = elements_of(in->m, i, own), any = in->fired[i] != 0;
  for (int k = 0; k < laws; k++) any |= in->left[own[k]] != 0;
  return any;
}

/* One motion by pivoting, and what it leaves in doubt examined. `ends`: a rest ends now. */
static int search_near(const frot_instant *in, const int *chosen, int count, int forced,
                       int lasting, int ends) {
  unsigned char *certain = in->w->search.certain;
  option lists[OPTIONS];
  double combinations = 1;
  frot_guess_modes(in, chosen, count, ends, certain);
  for (int c = 0; c < count; c++) {
    int options = contact_options(in, chosen[c], forced, lists);
    if (left_here(in, chosen[c])) certain[chosen[c]] = 0;
    if (certain[chosen[c]]) continue;
    if (combinations * options > FROT_ENOUGH)
      certain[chosen[c]] = 1;
    else
      combinations *= options;
  }
  return enumerate(in, chosen, count, forced, lasting, certain);
}

static int search_all(const frot_instant *in, const int *chosen, int count, int forced, int lasting,
                      int *unsearched) {
  frot_work *w = in->w;
  const frot_model *m = in->m;
  option lists[OPTIONS];
  double combinations = 1;
  for (int c = 0; c < count; c++) combinations *= contact_options(in, chosen[c], forced, lists);
  memset(w->search.trial, 0, sizeof *w->search.trial * (size_t)(m->n_contacts + m->n_elements));
  if (combinations <= FROT_ENOUGH) return enumerate(in, chosen, count, forced, lasting, NULL);
  *unsearched = 1;
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
