/* Whether given modes are admissible: the inequalities of Painleve's rules.
 *
 * Slip opposes its friction, rest stays within mu_s N, what is closed presses, what opens parts. */
#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "numerics/dense.h"
#include "numerics/basis.h"
#include "reactions/switching_functions.h"
#include "modes/mode_options.h"
#include "reactions/reactions.h"
#include "modes/enumeration.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

/* Acceleration of a row and how much of it is zero. */
static double acceleration(const frot_instant *in, int row, double *zero) {
  double size, value = frot_acceleration(in->m, in->w, row, &size);
  *zero = FROT_DEPARTURE_SLACK * (size + in->w->core.row_load[row]) +
          frot_row_rounding(in->m, in->w, row);
  return value;
}

static int is_still(const frot_instant *in, int row) {
  double zero, value = acceleration(in, row, &zero);
  return fabs(value) <= zero;
}

/* By how much the reaction of a row may be off by rounding: its terms cancel. */
static double reaction_rounding(const frot_instant *in, int row) {
  double size;
  frot_acceleration(in->m, in->w, row, &size);
  double own = frot_is_reading(in->m, row) ? 1 : fabs(frot_effect(in->m, in->w, row, row));
  return FROT_ZERO_OF_MOTION * (frot_reaction_size(in->m, in->w, row) + (own > 0 ? size / own : 0));
}

/* The same of what is left of the bound of an element that holds. */
static double rounding_of_reserve(const frot_instant *in, int e) {
  const frot_element *element = &in->m->elements[e];
  double rounding = reaction_rounding(in, element->row);
  for (int k = 0; k < FROT_BOUNDING; k++)
    if (element->bounded_by[k] >= 0)
      rounding +=
          in->w->core.coefficient[2 * e + 1] * reaction_rounding(in, element->bounded_by[k]);
  return rounding;
}

double frot_reserve(const frot_instant *in, int e) {
  const frot_element *element = &in->m->elements[e];
  frot_work *w = in->w;
  double bound = fabs(frot_bound_of_rest(in->m, w, e, w->search.trial)),
         lam = fabs(w->core.lam[element->row]);
  double size = bound + lam + rounding_of_reserve(in, e) / FROT_BOUND_SLACK;
  return size > 0 ? (bound - lam) / size : 0;
}

double frot_pressure(const frot_instant *in, int i) {
  int row = in->m->contacts[i].row_n;
  double lam = in->w->search.trial[i].side * in->w->core.lam[row];
  double rounding = reaction_rounding(in, row);
  double terms = fabs(lam) + frot_reaction_size(in->m, in->w, row);
  /* what came to zero is zero in the terms it had, which may all vanish now: its sign is seen later
   */
  rounding += FROT_LOCATED * in->vanished[i];
  double size = terms + rounding / FROT_BOUND_SLACK;
  return size > 0 ? lam / size : 0;
}

/* Whether a row is held without a reaction of its own, by what holds in w->search.trial: then it
 * cannot start to move. Of a mass matrix it lies in the span of the rows that hold. */
static int is_carried(const frot_instant *in, int row) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const frot_group *g = frot_group_of(m, row);
  int ns = g->n_speeds, held = 0;
  if (!g->general) {
    double *x = w->core.column;
    memcpy(x, frot_entries(m, w->core.half, row), sizeof(double) * (size_t)ns);
    double length = frot_length(x, ns);
    double rest = frot_reject(x, w->span.basis, w->span.rank, ns, w->span.parts);
    return !(rest > frot_least_length(m, w, row, length));
  }
  /* W_ee - W_eh W_hh^-1 W_he: what its own reaction does to it while the others hold */
  int *rows = w->relations.rows;
  for (int i = 0; i < g->n_contacts; i++)
    if (frot_is_loaded(m, w->search.trial, g->contacts[i]))
      rows[held++] = m->contacts[g->contacts[i]].row_n;
  for (int i = 0; i < g->n_elements; i++)
    if (frot_is_held(m, w->search.trial, g->elements[i]))
      rows[held++] = m->elements[g->elements[i]].row;
  double own = frot_effect(m, w, row, row), left = own, size = fabs(own);
  double *b = w->linear.right, *x = w->reactions.solution;
  for (int i = 0; i < held; i++) {
    b[i] = frot_effect(m, w, rows[i], row);
    for (int j = 0; j < held; j++)
      w->linear.matrix[j * held + i] = frot_effect(m, w, rows[i], rows[j]);
  }
  frot_least_norm(w->linear.matrix, b, held, held, FROT_RANK, x, w->linear.scratch,
                  w->linear.pivot);
  for (int i = 0; i < held; i++) {
    left -= frot_effect(m, w, row, rows[i]) * x[i];
    size += fabs(frot_effect(m, w, row, rows[i]) * x[i]);
  }
  return fabs(left) <= FROT_DEPENDENT * size;
}

static int element_is_admissible(const frot_instant *in, int e) {
  const frot_element *element = &in->m->elements[e];
  const frot_contact_mode *mode = frot_element_mode(in->m, in->w->search.trial, e);
  if (mode->friction == FROT_STICK && element->prescribed)
    return fabs(in->w->core.c[element->row]) <= FROT_PRESCRIBED_REST;
  if (mode->friction == FROT_STICK) {
    if (in->w->search.trial[element->contact].unloaded || mode->at_bound != 0)
      return is_still(in, element->row) && is_carried(in, element->row);
    return frot_reserve(in, e) >= -FROT_BOUND_SLACK;
  }
  if (mode->friction == FROT_NONE || !in->zero[e]) return 1;
  double zero, a = acceleration(in, element->row, &zero);
  if (mode->friction == FROT_SLIP_BACKWARD) a = -a;
  return a >= -zero;
}

/* Whether an element is about to slip by no acceleration of its own: it is held by others, or no
 * speed moves it in this posture. */
static int departs(const frot_instant *in, int e) {
  const frot_element *element = &in->m->elements[e];
  const frot_contact_mode *mode = frot_element_mode(in->m, in->w->search.trial, e);
  if (mode->friction <= FROT_STICK || !in->zero[e] || element->prescribed) return 0;
  return is_still(in, element->row) && is_carried(in, element->row);
}

/* What is held in this posture alone must stay at rest when the mechanism moves on, what slips must
 * slip. Whether element e goes against that a little later. */
static int goes_against(const frot_instant *in, int e) {
  const frot_contact_mode *mode = frot_element_mode(in->m, in->w->search.trial, e);
  int ahead = in->w->search.ahead[e];
  if (!in->w->search.trial[in->m->elements[e].contact].closed) return 0;
  if (mode->friction == FROT_STICK) return ahead != 0;
  return in->w->search.departs[e] && ahead != (mode->friction == FROT_SLIP_FORWARD ? 1 : -1);
}

/* Look at the slips a little later if the accelerations leave any in doubt; returns whether they
 * do, -1 where it cannot be seen. */
static int look_at_doubts(const frot_instant *in, const frot_group *g) {
  const frot_model *m = in->m;
  int doubt = !g->general && in->w->reactions.dependent;
  memset(in->w->search.departs, 0, (size_t)m->n_elements);
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    if (!in->w->search.trial[m->elements[e].contact].closed) continue;
    in->w->search.departs[e] = (unsigned char)departs(in, e);
    if (in->w->search.departs[e] && g->general) return -1;
    /* nor does an acceleration start what rests at its bound, or beside a contact that carries
     * nothing, though it may rest in this posture alone */
    int at_bound = !g->general && frot_element_mode(m, in->w->search.trial, e)->at_bound != 0;
    doubt |= in->w->search.departs[e] || at_bound;
  }
  for (int i = 0; i < g->n_contacts; i++)
    doubt |= !g->general && in->w->search.trial[g->contacts[i]].unloaded;
  return doubt && frot_look_ahead(in, g) != FROT_OK ? -1 : doubt;
}

/* Whether what the accelerations leave in doubt goes on as the modes say. */
static int goes_on(const frot_instant *in, const frot_group *g) {
  int doubt = look_at_doubts(in, g), *against = &in->w->search.against;
  for (int i = 0; i < g->n_elements && doubt > 0; i++) *against += goes_against(in, g->elements[i]);
  return doubt >= 0 && *against == 0;
}

int frot_follow_ahead(const frot_instant *in, const frot_group *g) {
  if (in->w->search.against == 0) return 0;
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i], ahead = in->w->search.ahead[e];
    frot_contact_mode *mode = in->w->search.trial + in->m->n_contacts + e;
    if (!goes_against(in, e)) continue;
    mode->friction = ahead > 0 ? FROT_SLIP_FORWARD : ahead < 0 ? FROT_SLIP_BACKWARD : FROT_STICK;
    mode->at_bound = 0;
  }
  return 1;
}

int frot_all_held(const frot_instant *in, int i) {
  for (int e = 0; e < in->m->n_elements; e++)
    if (in->m->elements[e].contact == i &&
        frot_element_mode(in->m, in->w->search.trial, e)->friction > FROT_STICK)
      return 0;
  return 1;
}

int frot_must_press(const frot_instant *in, int i) {
  if (in->unilateral[i] != 0) return 1;
  return frot_sign_matters(in->m, in->w->search.trial, i) && !frot_all_held(in, i);
}

void frot_flip_normal_sign(const frot_instant *in, int i) {
  const frot_model *m = in->m;
  frot_contact_mode *trial = in->w->search.trial;
  trial[i].side = (signed char)-trial[i].side;
  for (int e = 0; e < m->n_elements; e++) {
    frot_contact_mode *law = &trial[m->n_contacts + e];
    if (m->elements[e].contact == i) law->at_bound = (signed char)-law->at_bound;
  }
}

static int contact_is_admissible(const frot_instant *in, int i) {
  int row = in->m->contacts[i].row_n;
  frot_contact_mode *mode = &in->w->search.trial[i];
  if (!frot_has_normal(&in->m->contacts[i])) return 1;
  if (!mode->closed) {
    double below, a = acceleration(in, row, &below);
    if (a > below) return 1;
    /* what pressed until its reaction came to zero, and would part no faster than that is zero */
    below += FROT_LOCATED * in->vanished[i] * fabs(frot_effect(in->m, in->w, row, row));
    return a >= -below && !is_carried(in, row);
  }
  if (mode->unloaded) return is_still(in, row) && is_carried(in, row);
  /* held all round, the side follows from the reaction */
  if (in->unilateral[i] == 0 && frot_all_held(in, i) && mode->side * in->w->core.lam[row] < 0)
    frot_flip_normal_sign(in, i);
  if (in->unilateral[i] == 0 && !frot_sign_matters(in->m, in->w->search.trial, i)) return 1;
  return frot_pressure(in, i) >= -FROT_BOUND_SLACK;
}

int frot_reactions_hold(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  const frot_group *g = &m->groups[m->contact_group[chosen[0]]];
  for (int c = 0; c < count; c++)
    if (!contact_is_admissible(in, chosen[c])) return 0;
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    if (in->w->search.trial[m->elements[e].contact].closed && !element_is_admissible(in, e))
      return 0;
  }
  return 1;
}

/* What a guard has brought to its bound is there as the instant was located. */
int frot_element_is_exact(const frot_instant *in, int e) {
  const frot_element *element = &in->m->elements[e];
  const frot_contact_mode *mode = frot_element_mode(in->m, in->w->search.trial, e);
  int stuck = frot_element_mode(in->m, in->w->search.before, e)->friction == FROT_STICK;
  int guard = frot_element_guard(in->m, e);
  if (!in->zero[e] || element->prescribed || mode->friction == FROT_NONE) return 1;
  if (stuck && (in->fired[guard] != 0 || in->fired[guard + 1] != 0)) return 1;
  if (mode->friction == FROT_STICK) {
    if (!frot_is_held(in->m, in->w->search.trial, e)) return 1;
    double bound = fabs(frot_bound_of_rest(in->m, in->w, e, in->w->search.trial));
    return bound - fabs(in->w->core.lam[element->row]) >= -rounding_of_reserve(in, e);
  }
  double size, a = frot_acceleration(in->m, in->w, element->row, &size);
  if (mode->friction == FROT_SLIP_BACKWARD) a = -a;
  return a >= -frot_row_rounding(in->m, in->w, element->row);
}

int frot_is_exact(const frot_instant *in, const int *chosen, int count) {
  int own[FROT_LAWS_OF_CONTACT];
  for (int c = 0; c < count; c++) {
    int laws = in->w->search.trial[chosen[c]].closed ? frot_laws_of(in->m, chosen[c], own) : 0;
    for (int k = 0; k < laws; k++)
      if (!frot_element_is_exact(in, own[k])) return 0;
  }
  return 1;
}

void frot_begin_directions(const frot_instant *in) {
  static const double none[2] = {1, 0};
  const double *from = in->s->data + in->l.along, *turn = in->turn ? in->turn : none;
  double *along = in->w->reactions.along;
  for (int e = 0; e < in->m->n_elements; e++, from += FROT_BOUNDING, along += FROT_BOUNDING) {
    const frot_element *element = &in->m->elements[e];
    memcpy(along, from, FROT_BOUNDING * sizeof(double));
    for (int k = 0; k < FROT_NORMS && element->norm[k] > 0; k++) {
      int at = frot_norm_first(element, k);
      if (element->norm[k] == 1) {
        along[at] = turn[0] < 0 ? -from[at] : from[at];
        continue;
      }
      along[at] = turn[0] * from[at] - turn[1] * from[at + 1];
      along[at + 1] = turn[1] * from[at] + turn[0] * from[at + 1];
    }
  }
}

int frot_is_admissible(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const frot_group *g = &m->groups[m->contact_group[chosen[0]]];
  w->search.against = 0;
  frot_begin_directions(in);
  if (frot_group_reactions(m, w, g, w->search.trial, in->resists)) return 0;
  if (!w->reactions.dependent) return frot_reactions_hold(in, chosen, count) && goes_on(in, g);
  return frot_others_carry(in, chosen, count) && goes_on(in, g);
}
