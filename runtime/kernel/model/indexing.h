/* Places of a group's parts in the packed arrays, and the rows and modes of liaisons and elements.
 */
#ifndef FROT_INDEXING_H
#define FROT_INDEXING_H

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

/* Length of the reaction of two or three components that bounds an element. */
static inline double frot_bounding_length(const frot_element *e, const double *lam) {
  double across = hypot(lam[e->bounded_by[0]], lam[e->bounded_by[1]]);
  return e->bounded_by[2] < 0 ? across : hypot(across, lam[e->bounded_by[2]]);
}

/* Part of that reaction along a direction (FROT_BOUNDING). */
static inline double frot_bounding_along(const frot_element *e, const double *lam,
                                         const double *along) {
  double part = along[0] * lam[e->bounded_by[0]] + along[1] * lam[e->bounded_by[1]];
  return e->bounded_by[2] < 0 ? part : part + along[2] * lam[e->bounded_by[2]];
}

/* along <- the direction of that reaction, whose length is `size`. */
static inline void frot_bounding_direction(const frot_element *e, const double *lam, double size,
                                           double *along) {
  for (int k = 0; k < FROT_BOUNDING; k++)
    along[k] = e->bounded_by[k] < 0 ? 0 : lam[e->bounded_by[k]] / size;
}

/* Guards: one of each contact, two of each element, then those of the conditions. */
static inline int frot_element_guard(const frot_model *m, int e) { return m->n_contacts + 2 * e; }
/* Of a guard that fired: at the start of a step, before time could move on. */
enum { FROT_AT_START = 2 };
static inline int frot_condition_guard(const frot_model *m) {
  return m->n_contacts + 2 * m->n_elements;
}

#endif
