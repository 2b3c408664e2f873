#include "reactions/switching_functions.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "reactions/equal_springs.h"
#include "reactions/reactions.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

#define TAKE(field, count) FROT_TAKE(a, field, count)

#define AGREES 0.5 /* cosine by which a direction is the one before, however small the reaction */

int frot_sign_matters(const frot_model *m, const frot_contact_mode *modes, int i) {
  const frot_group *g = &m->groups[m->contact_group[i]];
  for (int k = 0; k < g->n_elements; k++) {
    int e = g->elements[k];
    if (m->elements[e].contact == i && frot_element_mode(m, modes, e)->friction != FROT_NONE)
      return 1;
  }
  return 0;
}

static int contact_has_guard(const frot_model *m, const frot_state *s, const frot_work *w,
                             const frot_contact_mode *modes, int i) {
  if (m->contacts[i].row_n < 0) return 0;
  if (!modes[i].closed) return 1;
  if (modes[i].unloaded == FROT_BY_SPRINGS) return 1;
  if (modes[i].unloaded || modes[i].shared) return 0;
  return s->data[w->layout.unilateral + i] != 0 || frot_sign_matters(m, modes, i);
}

/* Reactions of a pin, each of which has a guard while it slips. */
static int count_norms(const frot_element *e) {
  int n = 0;
  while (e->bound == FROT_BY_PIN && n < FROT_NORMS && e->norm[n] > 0) n++;
  return n;
}

static int count_element_guards(const frot_model *m, const frot_contact_mode *modes, int e) {
  const frot_element *element = &m->elements[e];
  const frot_contact_mode *mode = frot_element_mode(m, modes, e);
  if (!modes[element->contact].closed || modes[element->contact].unloaded) return 0;
  if (mode->friction == FROT_NONE || mode->at_bound != 0 || element->part > 0) return 0;
  if (element->parts > 1 && mode->friction == FROT_STICK) return !mode->shared;
  if (mode->friction == FROT_STICK) return element->prescribed ? 1 : 2;
  return 1 + count_norms(element);
}

void frot_list_guards(const frot_model *m, const frot_state *s, frot_work *w,
                      const frot_contact_mode *modes) {
  const frot_awake_lists *now = w->awake.now;
  int n = 0;
  for (int i = 0; i < now->n_contacts; i++)
    if (contact_has_guard(m, s, w, modes, now->contacts[i])) w->guards.list[n++] = now->contacts[i];
  for (int i = 0; i < now->n_elements; i++) {
    int e = now->elements[i], count = count_element_guards(m, modes, e);
    /* the zero of a slip of several components is found otherwise: guards/vanishing_slips.c */
    int first = m->elements[e].parts > 1 && frot_element_mode(m, modes, e)->friction > FROT_STICK;
    for (int k = first; k < count; k++) w->guards.list[n++] = frot_element_guard(m, e) + k;
  }
  for (int i = 0; i < now->n_located; i++)
    w->guards.list[n++] = frot_condition_guard(m) + now->located[i];
  w->guards.count = n;
}

double frot_reaction_size(const frot_model *m, const frot_work *w, int row) {
  if (frot_is_reading(m, row)) return w->core.row_load[row];
  double own = fabs(frot_effect(m, w, row, row));
  return own > 0 ? w->core.row_load[row] / own : 0;
}

/* Size of the terms of a row's reaction: what loads could make of it, and as much as makes rounding
 * of what the other reactions leave in the row no more than the floor of a guard. */
static double terms_of_reaction(const frot_model *m, const frot_work *w, int row) {
  double motion = w->guards.motion[m->row_group[row]];
  double own = frot_is_reading(m, row) ? 1 : fabs(frot_effect(m, w, row, row));
  double rounding = own > 0 ? frot_rounding_of_motion(m, w, row, motion) / own : 0;
  return frot_reaction_size(m, w, row) + rounding / FROT_GUARD_FLOOR;
}

/* The same of the reaction that bounds an element. */
static double bounding_size(const frot_model *m, const frot_work *w, const frot_element *e) {
  double sum = 0;
  for (int k = 0; k < FROT_BOUNDING; k++)
    if (e->bounded_by[k] >= 0) sum += terms_of_reaction(m, w, e->bounded_by[k]);
  return sum;
}

static double contact_guard(const frot_model *m, frot_work *w, const double *q,
                            const frot_contact_mode *modes, int i, double *scale) {
  const frot_contact_mode *mode = &modes[i];
  int row = m->contacts[i].row_n;
  if (!mode->closed) {
    if (scale) *scale = fabs(w->core.gap[i]) + frot_gap_size(m, w, row, q);
    return w->core.gap[i];
  }
  double force = mode->side * w->core.lam[row];
  if (mode->unloaded) frot_spring_of_unloaded(m, w, modes, NULL, i, &force), force = -force;
  if (scale) *scale = fabs(force) + terms_of_reaction(m, w, row);
  return force;
}

/* The guard of an element of several components that sticks: bound^2 - |lam|^2, which is smooth. */
static double vector_guard(const frot_model *m, const frot_work *w, const frot_contact_mode *modes,
                           int e, double *scale) {
  const frot_element *element = &m->elements[e];
  double bound = frot_bound_of_rest(m, w, e, modes), square = 0, terms = 0;
  for (int k = 0; k < element->parts; k++) {
    double lam = w->core.lam[element->row + k];
    square += lam * lam, terms += fabs(lam) + terms_of_reaction(m, w, element->row + k);
  }
  if (scale) {
    double size = fabs(bound) + terms;
    size += w->core.coefficient[2 * e + 1] * bounding_size(m, w, element);
    *scale = size * (fabs(bound) + sqrt(square)); /* as bound - |lam| beside `size` */
  }
  return bound * fabs(bound) - square;
}

/* Guard k of an element. */
static double element_guard(const frot_model *m, const frot_state *s, const frot_work *w,
                            const double *v, const frot_contact_mode *modes, int e, int k,
                            double *scale) {
  const frot_element *element = &m->elements[e];
  int friction = frot_element_mode(m, modes, e)->friction, row = element->row;
  if (element->parts > 1 && friction == FROT_STICK) return vector_guard(m, w, modes, e, scale);
  if (friction == FROT_STICK && element->prescribed) {
    /* rest lasts as long as the prescribed motion rests */
    if (scale) *scale = FROT_PRESCRIBED_REST;
    return FROT_PRESCRIBED_REST - fabs(w->core.c[row]);
  }
  if (friction == FROT_STICK) {
    double bound = frot_bound_of_rest(m, w, e, modes), lam = w->core.lam[row];
    if (scale)
      *scale = fabs(bound) + fabs(lam) + terms_of_reaction(m, w, row) +
               w->core.coefficient[2 * e + 1] * bounding_size(m, w, element);
    return k == 0 ? bound - lam : bound + lam;
  }
  if (k == 0) {
    if (scale) *scale = frot_row_size(m, w, row, v);
    return friction == FROT_SLIP_FORWARD ? w->core.rate[row] : -w->core.rate[row];
  }
  const double *along = s->data + w->layout.along + FROT_BOUNDING * e;
  if (scale) *scale = bounding_size(m, w, element);
  for (int j = 0; j < FROT_BOUNDING && scale; j++)
    if (element->bounded_by[j] >= 0) *scale += fabs(w->core.lam[element->bounded_by[j]]);
  return frot_bounding_along(element, w->core.lam, along, k - 1);
}

void frot_guards(const frot_model *m, const frot_state *s, frot_work *w, const double *q,
                 const double *v, const double *d, const frot_contact_mode *modes, double *guard,
                 double *scale) {
  int conditions = frot_condition_guard(m);
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; scale && k < now->n_groups; k++)
    w->guards.motion[now->groups[k]] = frot_size_of_motion(m, w, &m->groups[now->groups[k]]);
  for (int k = 0; k < w->guards.count; k++) {
    int j = w->guards.list[k];
    double *size = scale ? scale + k : NULL;
    if (j < m->n_contacts) {
      guard[k] = contact_guard(m, w, q, modes, j, size);
    } else if (j < conditions) {
      int e = frot_guarded_element(m, j);
      guard[k] = element_guard(m, s, w, v, modes, e, j - frot_element_guard(m, e), size);
    } else {
      guard[k] = frot_condition_value(w, d, j - conditions);
      if (size) *size = fabs(guard[k]);
    }
  }
}

int frot_guards_read_loads(const frot_model *m, const frot_work *w,
                           const frot_contact_mode *modes) {
  for (int k = 0; k < w->guards.count && w->guards.list[k] < frot_condition_guard(m); k++) {
    int j = w->guards.list[k];
    if (j >= m->n_contacts || modes[j].closed) return 1;
  }
  return 0;
}

int frot_has_direction(const frot_model *m, const frot_state *s, const frot_work *w, int e, int k) {
  double size = frot_norm_length(&m->elements[e], w->core.lam, k);
  return size > FROT_NO_DIRECTION * s->data[w->layout.scale_g + frot_element_guard(m, e) + 1 + k];
}

void frot_turn_references(const frot_model *m, frot_state *s, const frot_work *w) {
  const frot_awake_lists *now = w->awake.now;
  for (int i = 0; i < now->n_elements; i++) {
    int e = now->elements[i];
    const frot_element *element = &m->elements[e];
    double *along = s->data + w->layout.along + FROT_BOUNDING * e;
    for (int k = 0; k < count_norms(element); k++) {
      double size = frot_norm_length(element, w->core.lam, k);
      int agrees = frot_bounding_along(element, w->core.lam, along, k) > AGREES * size;
      if (agrees || frot_has_direction(m, s, w, e, k))
        frot_bounding_direction(element, w->core.lam, size, k, along);
    }
  }
}

void frot_flip_pin_references(const frot_model *m, frot_state *s, frot_work *w,
                              const frot_contact_mode *modes) {
  for (int e = 0; e < m->n_elements; e++) {
    const frot_element *element = &m->elements[e];
    const double *fired = s->data + w->layout.fired + frot_element_guard(m, e);
    int any = 0;
    for (int k = 0; k < count_norms(element); k++) any |= fired[1 + k] != 0;
    if (!any || frot_element_mode(m, modes, e)->friction <= FROT_STICK) continue;
    if (frot_group_reactions(m, w, frot_group_of(m, element->row), modes, NULL)) continue;
    double *along = s->data + w->layout.along + FROT_BOUNDING * e;
    for (int k = 0; k < count_norms(element); k++) {
      int at = frot_norm_first(element, k);
      if (fired[1 + k] == 0 || frot_has_direction(m, s, w, e, k)) continue;
      for (int i = at; i < at + element->norm[k]; i++) along[i] = -along[i];
    }
  }
}

void frot_forget_guards(const frot_model *m, frot_state *s, int first, int count) {
  frot_layout l = frot_layout_of(m);
  memset(s->data + l.scale_g + first, 0, sizeof(double) * (size_t)count);
  memset(s->data + l.most_g + first, 0, sizeof(double) * (size_t)count);
  memset(s->data + l.noise + m->nq + m->nv + first, 0, sizeof(double) * (size_t)count);
}

int frot_slip_of_guard(const frot_model *m, const frot_state *s, const frot_work *w, int j) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  int e = frot_guarded_element(m, j);
  if (j < m->n_contacts || j >= frot_condition_guard(m) || j != frot_element_guard(m, e)) return -1;
  return frot_element_mode(m, modes, e)->friction > FROT_STICK ? e : -1;
}

int frot_guard_is_force(const frot_model *m, const frot_state *s, const frot_work *w, int k) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  int j = w->guards.list[k], e = frot_guarded_element(m, j);
  if (j >= frot_condition_guard(m)) return 0;
  if (j < m->n_contacts) return modes[j].closed;
  return frot_element_mode(m, modes, e)->friction <= FROT_STICK || j != frot_element_guard(m, e);
}

double frot_condition_value(const frot_work *w, const double *d, int j) {
  return d[j] != 0 ? w->core.condition[j] : -w->core.condition[j];
}

double frot_guard_rounding(const frot_model *m, const frot_state *s, const frot_work *w, int j,
                           double h) {
  const double *noise = s->data + w->layout.noise;
  double own = noise[m->nq + m->nv + j];
  int e = frot_slip_of_guard(m, s, w, j), condition = j - frot_condition_guard(m);
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  /* a gap is made of lengths that are no coordinates too: those of the body beyond its G */
  if (j < m->n_contacts && !modes[j].closed)
    return fmax(own, FROT_ROUNDING * s->data[w->layout.reach + j]);
  /* how far a place is beyond an end is told in parts of the length between the ends */
  if (condition >= 0 && condition < m->n_conditions && m->conditions[condition].contact >= 0)
    return fmax(own, FROT_ROUNDING);
  return e < 0 ? own : own + h * frot_row_size(m, w, m->elements[e].row, noise + m->nq);
}

void frot_bind_guards(const frot_model *m, const frot_layout *l, frot_guard_work *w,
                      frot_arena *a) {
  TAKE(w->list, l->ng), TAKE(w->size, l->ng), TAKE(w->shown, l->ng), TAKE(w->motion, m->n_groups);
  TAKE(w->end_reaction, FROT_BOUNDING * m->n_elements), TAKE(w->end_friction, m->n_elements);
  if (!frot_has_vectors(m)) return;
  TAKE(w->end_slip, 4 * m->n_elements), TAKE(w->end_direction, 2 * m->n_elements);
  TAKE(w->passed_slip, m->n_elements);
}
