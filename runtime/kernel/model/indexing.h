/* Places of a group's parts in the packed arrays, and the rows and modes of liaisons and elements.
 */
#ifndef FROT_INDEXING_H
#define FROT_INDEXING_H

#include <math.h>

#include "model/workspace.h"

/* The group of a row, and the row's entries over the unknowns of that group. */
static inline const frot_group *frot_group_of(const frot_model *m, int row) {
  return &m->groups[m->row_group[row]];
}
static inline double *frot_entries(const frot_model *m, double *packed, int row) {
  const frot_group *g = frot_group_of(m, row);
  return packed + g->entries + m->row_local[row] * g->n;
}

/* What a reaction in the row `by` of the same group does to the row: an acceleration, or to a
 * reading a reaction. */
static inline double *frot_effect_on(const frot_model *m, const frot_work *w, int row) {
  const frot_group *g = frot_group_of(m, row);
  return w->core.delassus + g->square + m->row_local[row] * g->n_rows;
}
static inline double frot_effect(const frot_model *m, const frot_work *w, int row, int by) {
  return frot_effect_on(m, w, row)[m->row_local[by]];
}

static inline int frot_is_reading(const frot_model *m, int row) { return m->row_reads[row] >= 0; }

static inline const frot_contact_mode *frot_element_mode(const frot_model *m,
                                                         const frot_contact_mode *modes, int e) {
  return modes + m->n_contacts + e;
}

/* Whether the motion of an element is held by a reaction of its own in `modes`. */
static inline int frot_is_held(const frot_model *m, const frot_contact_mode *modes, int element) {
  const frot_element *e = &m->elements[element];
  const frot_contact_mode *mode = frot_element_mode(m, modes, element);
  return modes[e->contact].closed && !modes[e->contact].unloaded && mode->friction == FROT_STICK &&
         mode->at_bound == 0 && !e->prescribed;
}

/* Whether a contact keeps its distance by a reaction of its own. */
static inline int frot_is_loaded(const frot_model *m, const frot_contact_mode *modes, int contact) {
  const frot_contact *c = &m->contacts[contact];
  return c->row_n >= 0 && !c->reduced && modes[contact].closed && !modes[contact].unloaded;
}

/* The first component of the k-th reaction that bounds an element, in its bounded_by. */
static inline int frot_norm_first(const frot_element *e, int k) {
  int at = 0;
  for (int i = 0; i < k; i++) at += e->norm[i];
  return at;
}

/* Length of the k-th of those reactions. */
static inline double frot_norm_length(const frot_element *e, const double *lam, int k) {
  const int *by = e->bounded_by + frot_norm_first(e, k);
  if (e->norm[k] == 1) return fabs(lam[by[0]]);
  double across = hypot(lam[by[0]], lam[by[1]]);
  return e->norm[k] == 2 ? across : hypot(across, lam[by[2]]);
}

/* The sum of their lengths, which bounds a pin's friction. */
static inline double frot_bounding_length(const frot_element *e, const double *lam) {
  double sum = frot_norm_length(e, lam, 0);
  for (int k = 1; k < FROT_NORMS && e->norm[k] > 0; k++) sum += frot_norm_length(e, lam, k);
  return sum;
}

/* Part of the k-th reaction along its direction in `along` (FROT_BOUNDING, of all of them). */
static inline double frot_bounding_along(const frot_element *e, const double *lam,
                                         const double *along, int k) {
  int at = frot_norm_first(e, k);
  double part = along[at] * lam[e->bounded_by[at]];
  for (int i = 1; i < e->norm[k]; i++) part += along[at + i] * lam[e->bounded_by[at + i]];
  return part;
}

/* Its items of `along` <- the direction of the k-th reaction, whose length is `size`. */
static inline void frot_bounding_direction(const frot_element *e, const double *lam, double size,
                                           int k, double *along) {
  int at = frot_norm_first(e, k);
  for (int i = at; i < at + e->norm[k]; i++) along[i] = lam[e->bounded_by[i]] / size;
}

/* Guards: one of each contact, as many of each element, then those of the conditions. */
enum { FROT_ELEMENT_GUARDS = 1 + FROT_NORMS };
static inline int frot_element_guard(const frot_model *m, int e) {
  return m->n_contacts + FROT_ELEMENT_GUARDS * e;
}
/* The element of a guard that is one of an element. */
static inline int frot_guarded_element(const frot_model *m, int guard) {
  return (guard - m->n_contacts) / FROT_ELEMENT_GUARDS;
}
/* Of a guard that fired: at the start of a step, before time could move on. */
enum { FROT_AT_START = 2 };
static inline int frot_condition_guard(const frot_model *m) {
  return m->n_contacts + FROT_ELEMENT_GUARDS * m->n_elements;
}

#endif
