/* Whether an admissible motion lasts beyond its instant.
 *
 * Where an inequality is an equality for the instant, as at each event one is, the accelerations do
 * not say whether it holds after it: a rest that ends at its bound goes on as slip where the slip
 * then grows, and not where friction jams it (P. Painleve, Lecons sur le frottement, 1895); a
 * reaction that is zero at the start has the sign of its rate. So the mechanism is moved on a
 * little in these modes, and what was zero is looked at again. */
#include <math.h>
#include <string.h>

#include "evaluation/algebraic_loops.h"
#include "modes/contact_components.h"
#include "evaluation/evaluate.h"
#include "reactions/switching_functions.h"
#include "methods/right_hand_side.h"
#include "modes/mode_options.h"
#include "constraints/projection.h"
#include "reactions/equal_springs.h"
#include "reactions/reactions.h"
#include "modes/enumeration.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"
#include "evaluation/quaternions.h"

/* Of the step that comes, how far the mechanism is moved on, and as far as what changes slowly
 * beside the terms it is made of (a heavy body on a light one) may ask for. */
#define LATER 1e-3
#define LATEST 0.1
#define CLEARLY 1e-8 /* part of its terms by which what was zero has fallen then */

double frot_margin_of_contact(const frot_instant *in, int i) {
  frot_work *w = in->w;
  const frot_contact_mode *mode = &w->search.trial[i];
  int row = in->m->contacts[i].row_n;
  double size, value;
  if (!frot_has_normal(&in->m->contacts[i]) || mode->unloaded == 1) return 1;
  if (mode->unloaded) {
    frot_spring_of_unloaded(in->m, w, w->search.trial, in->resists, i, &value);
    value = -value, size = fabs(value) + frot_reaction_size(in->m, w, row);
  } else if (!mode->closed) {
    value = frot_acceleration(in->m, w, row, &size);
    size += w->core.row_load[row];
  } else {
    if (in->unilateral[i] == 0 && !frot_sign_matters(in->m, w->search.trial, i)) return 1;
    value = mode->side * w->core.lam[row];
    size = fabs(value) + frot_reaction_size(in->m, w, row);
  }
  return size > 0 ? value / size : 0;
}

double frot_margin_of_element(const frot_instant *in, int e) {
  const frot_model *m = in->m;
  const frot_work *w = in->w;
  const frot_element *element = &m->elements[e];
  const frot_contact_mode *mode = frot_element_mode(m, w->search.trial, e);
  double size, value;
  if (!w->search.trial[element->contact].closed || !in->zero[e] || element->prescribed) return 1;
  if (mode->friction == FROT_STICK) {
    if (!frot_is_held(m, w->search.trial, e)) return 1;
    double bound = frot_bound_of_rest(m, w, e, w->search.trial);
    double lam = fabs(w->core.lam[element->row]);
    value = bound - lam, size = fabs(bound) + lam + frot_reaction_size(m, w, element->row);
  } else {
    if (mode->friction == FROT_NONE) return 1;
    value = frot_acceleration(m, w, element->row, &size);
    if (mode->friction == FROT_SLIP_BACKWARD) value = -value;
    size += w->core.row_load[element->row];
  }
  return size > 0 ? value / size : 0;
}

/* Whether a reaction has come to zero and goes on with the other sign: its guard says so more
 * clearly than what rounding leaves of loads that begin. */
static int has_turned(const frot_instant *in, int i) {
  return in->fired[i] != 0 && in->w->search.trial[i].side != in->w->search.before[i].side;
}

/* Whether a slip that begins is none: it does not grow, its margin a little later is rounding. */
static int fades(const frot_instant *in, int e, double now) {
  return in->at_rest[e] && now <= FROT_ROUNDING &&
         frot_element_mode(in->m, in->w->search.trial, e)->friction > FROT_STICK;
}

/* 1 + what begins to slip first, for which there are no reactions a little later: where others are
 * at rest it moves by rounding alone. 0 where nothing begins. */
static int first_begun(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  for (int c = 0; c < count; c++)
    for (int e = 0; e < m->n_elements; e++)
      if (m->elements[e].contact == chosen[c] && in->at_rest[e] &&
          frot_element_mode(m, in->w->search.trial, e)->friction > FROT_STICK)
        return m->n_contacts + e + 1;
  return 0;
}

/* Whether a guard of element e has fired. */
static int fired(const frot_instant *in, int e) {
  int guard = frot_element_guard(in->m, e), any = 0;
  for (int k = 0; k < FROT_ELEMENT_GUARDS; k++) any |= in->fired[guard + k] != 0;
  return any;
}

/* Margins of contacts and elements that are small, into w->search.margin; the others are 1. What
 * has fired is zero, however small its terms are at the instant. Returns whether there are any. */
static int note_margins(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  double *margin = in->w->search.margin;
  int any = 0;
  for (int k = 0; k < m->n_contacts + m->n_elements; k++) margin[k] = 1;
  for (int c = 0; c < count; c++) {
    double *own = margin + chosen[c];
    *own = frot_margin_of_contact(in, chosen[c]);
    if ((in->fired[chosen[c]] != 0 || in->vanished[chosen[c]] > 0) && *own < 1) *own = 0;
    for (int e = 0; e < m->n_elements; e++) {
      if (m->elements[e].contact != chosen[c]) continue;
      own = margin + m->n_contacts + e, *own = frot_margin_of_element(in, e);
      if (fired(in, e) && *own < 1) *own = 0;
    }
  }
  for (int k = 0; k < m->n_contacts + m->n_elements; k++)
    if (margin[k] < FROT_RESOLVED)
      any = 1;
    else
      margin[k] = 1;
  return any;
}

/* The kinematics and dynamics at t, q, v with what may be closed at the instant. */
static int evaluate(const frot_instant *in, double t, double *q, double *v) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const double *d = in->s->data + in->l.d;
  frot_contact_mode *modes = w->search.guess_ahead;
  memcpy(modes, w->search.trial, sizeof *modes * (size_t)(m->n_contacts + m->n_elements));
  for (int i = 0; i < m->n_contacts; i++) modes[i].closed = w->search.component[i] >= 0;
  int status = frot_kinematics(m, in->s, w, t, q, v, d);
  if (status == FROT_OK) status = frot_dynamics(m, in->s, w, t, q, v, d, modes, FROT_LAWS);
  if (status == FROT_OK) status = frot_metric(m, w);
  if (status == FROT_OK) frot_row_loads(m, in->s, w, t, q, v, d);
  return status;
}

/* Move on by dt: the group with its accelerations, all else, whose speeds may drive it (a damper),
 * as it moved until now, and with their rates what has no speeds (the strain of a spring). */
static int move_on(const frot_instant *in, const frot_group *own, double dt, double *q, double *v) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  int moved, begun = in->s->statistics.steps > 0;
  const double *slope = in->s->data + in->l.slope + m->nq;
  memcpy(q, in->q, sizeof(double) * (size_t)m->nq);
  memcpy(v, in->v, sizeof(double) * (size_t)m->nv);
  for (int k = 0; k < m->n_groups; k++) {
    const frot_group *g = &m->groups[k];
    for (int i = 0; i < g->n_speeds; i++) {
      double other = begun ? slope[g->unknowns[i]] : 0;
      double a = g == own ? w->core.a[g->unknowns[i]] : other;
      w->relations.step[i] = v[g->unknowns[i]] + 0.5 * dt * a;
      v[g->unknowns[i]] += dt * a;
    }
    frot_displace(m, g, q, w->relations.step, dt);
  }
  frot_drift(m, q, w->search.rates, dt);
  return frot_project(m, in->s, w, in->t + dt, q, v, in->s->data + in->l.d, w->search.trial, NULL,
                      NULL, &moved);
}

/* Whether nothing that was zero has fallen below in the meantime; *slow is 1 + what has fallen
 * most, of that which has moved so little that it does not show (a contact, or n_contacts + an
 * element). A reaction that may have either sign and was zero shows it now; one that was only small
 * comes to zero at an event of its own. */
static int still_holds(const frot_instant *in, const int *chosen, int count, int *slow) {
  const frot_model *m = in->m;
  const double *margin = in->w->search.margin;
  double least = -FROT_ROUNDING;
  for (int c = 0; c < count; c++) {
    int i = chosen[c];
    const frot_contact_mode *mode = &in->w->search.trial[i];
    if (margin[i] < 1) {
      double now = frot_margin_of_contact(in, i);
      if (now < 0 && mode->closed && in->unilateral[i] == 0 && frot_all_held(in, i)) {
        if (margin[i] <= FROT_ZERO && !has_turned(in, i)) frot_flip_normal_sign(in, i);
      } else if (now < 0 && now < margin[i] - CLEARLY) {
        return 0;
      } else if (now < least) {
        *slow = i + 1, least = now;
      }
    }
    for (int e = 0; e < m->n_elements; e++) {
      if (m->elements[e].contact != i || !(margin[m->n_contacts + e] < 1)) continue;
      double now = frot_margin_of_element(in, e);
      if (now < 0 && now < margin[m->n_contacts + e] - CLEARLY) return 0;
      if (now < least) *slow = m->n_contacts + e + 1, least = now;
      if (*slow == 0 && fades(in, e, now)) *slow = m->n_contacts + e + 1;
    }
  }
  return 1;
}

/* Whether the modes are those of before in a group that has no reactions in them beyond the
 * instant: what friction makes of the reactions that bound it has no solution any more. Then other
 * modes come, or another share of the load, though no bound was passed, and reactions jump. */
static int has_ended(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  const frot_contact_mode *trial = in->w->search.trial, *before = in->w->search.before;
  if (in->s->jammed_at != in->t || in->s->jammed != m->contact_group[chosen[0]]) return 0;
  for (int c = 0; c < count; c++) {
    const frot_contact_mode *now = &trial[chosen[c]], *was = &before[chosen[c]];
    if (now->closed != was->closed || now->unloaded != was->unloaded) return 0;
    int own[FROT_LAWS_OF_CONTACT], laws = frot_laws_of(m, chosen[c], own);
    for (int k = 0; k < laws; k++) {
      now = trial + m->n_contacts + own[k], was = before + m->n_contacts + own[k];
      if (now->friction != was->friction || now->at_bound != was->at_bound) return 0;
    }
  }
  return 1;
}

/* The accelerations of the instant and the rates of what has no speeds. Returns whether there are
 * any. */
static int note_rates(const frot_instant *in, const frot_group *g) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const double *d = in->s->data + in->l.d;
  frot_move_beside_others(in, g);
  if (m->late_rates && (frot_solve_late(m, in->s, w, in->t, in->q, in->v, d) != FROT_OK ||
                        frot_late_rates(m, in->s, w, in->t, in->q, in->v, d) != FROT_OK))
    return 0;
  memcpy(w->search.rates, w->core.qd, sizeof(double) * (size_t)m->nq);
  return 1;
}

/* How much later an instant is for a part of the step that comes. */
static double later_by(const frot_instant *in, double part, double way) {
  double step = in->s->calm > 0 ? in->s->calm : in->s->h_max;
  return way > 0 ? fmin(part * step, way) : part * step;
}

/* Evaluate the group at the instant again. */
static void go_back(const frot_instant *in, const frot_group *g, double *q, double *v) {
  memcpy(q, in->q, sizeof(double) * (size_t)in->m->nq);
  memcpy(v, in->v, sizeof(double) * (size_t)in->m->nv);
  evaluate(in, in->t, q, v);
  frot_group_reactions(in->m, in->w, g, in->w->search.trial, in->resists);
}

int frot_lasts(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const frot_group *g = &m->groups[m->contact_group[chosen[0]]];
  double *q = w->step.z, *v = q + m->nq;
  w->search.falls = 0;
  if (has_ended(in, chosen, count)) return 0;
  if (!note_margins(in, chosen, count) || !note_rates(in, g)) return 1;
  double way = frot_time_of_way(in, g, FROT_WAY);
  int lasts = 1, slow = 1;
  for (double part = LATER; lasts && slow && part <= LATEST; part *= 10) {
    double dt = later_by(in, part, way);
    slow = 0;
    if (move_on(in, g, dt, q, v) != FROT_OK || evaluate(in, in->t + dt, q, v) != FROT_OK) break;
    if (frot_group_reactions(m, w, g, w->search.trial, in->resists))
      slow = first_begun(in, chosen, count);
    else
      lasts = still_holds(in, chosen, count, &slow);
  }
  go_back(in, g, q, v);
  w->search.falls = slow;
  return lasts;
}

int frot_share_later(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const frot_group *g = &m->groups[m->contact_group[chosen[0]]];
  double *q = w->step.z, *v = q + m->nq;
  if (frot_group_reactions(m, w, g, w->search.trial, in->resists) || !note_rates(in, g)) return 0;
  double dt = later_by(in, LATER, frot_time_of_way(in, g, FROT_WAY));
  int shared = move_on(in, g, dt, q, v) == FROT_OK && evaluate(in, in->t + dt, q, v) == FROT_OK &&
               frot_share_load(in, chosen, count) == FROT_SHARED;
  go_back(in, g, q, v);
  return shared;
}

int frot_sets_out(const frot_instant *in, const frot_group *g) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  double *q = w->step.z, *v = q + m->nq;
  /* room of enumeration.c between two motions */
  double *lam = w->search.motions + (size_t)FROT_MOST_MOTIONS * (size_t)m->n_rows;
  int sets_out = 0;
  memcpy(lam, w->core.lam, sizeof(double) * (size_t)m->n_rows);
  if (!note_rates(in, g)) return 0;
  for (double part = LATER; !sets_out && part <= LATEST; part *= 10) {
    double dt = later_by(in, part, 0);
    if (move_on(in, g, dt, q, v) != FROT_OK || evaluate(in, in->t + dt, q, v) != FROT_OK) break;
    if (frot_group_reactions(m, w, g, w->search.trial, in->resists)) break;
    frot_move_beside_others(in, g);
    sets_out = !frot_group_rests(in, g);
    memcpy(w->search.set_out, w->core.a, sizeof(double) * (size_t)m->nv);
  }
  go_back(in, g, q, v);
  memcpy(w->core.lam, lam, sizeof(double) * (size_t)m->n_rows);
  if (sets_out) memcpy(w->core.a, w->search.set_out, sizeof(double) * (size_t)m->nv);
  return sets_out;
}
