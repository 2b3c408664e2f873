/* Every admissible motion of a state, part after part: groups whose loads read each other. */
#include <math.h>
#include <string.h>

#include "motion_search/motion_search.h"
#include "evaluation/algebraic_loops.h"
#include "evaluation/fault_source.h"
#include "evaluation/quaternions.h"
#include "evaluation/slip_frames.h"
#include "model/calls.h"
#include "model/indexing.h"
#include "model/segment.h"
#include "motions/describe_motion.h"
#include "numerics/dense.h"

/* Motions of all parts that are kept, beside one of each. */
#define MOST 64

typedef struct {
  char *base;
  size_t used;
} arena;

static void *take(arena *a, size_t count, size_t size) {
  size_t at = (a->used + 15) & ~(size_t)15;
  a->used = at + count * size;
  return a->base ? a->base + at : NULL;
}
#define TAKE(field, count) (field = take(a, (size_t)(count), sizeof *field))

static int parts_of(const frot_model *m) { return m->n_islands > 0 ? m->n_islands : 1; }

static void groups_of(const frot_model *m, int part, int *first, int *end) {
  *first = m->n_islands > 0 ? m->islands[part].first_group : 0;
  *end = *first + (m->n_islands > 0 ? m->islands[part].n_groups : m->n_groups);
}

static size_t larger(size_t a, size_t b) { return a > b ? a : b; }

static void lay_out_motions(const frot_model *m, const frot_layout *l, arena *a,
                            frot_motions_memory *c) {
  int count = MOST + parts_of(m);
  frot_motion none = {0};
  TAKE(c->motions, count);
  for (int k = 0; k < count; k++) {
    frot_motion *one = a->base ? &c->motions[k] : &none;
    TAKE(one->a, l->nw), TAKE(one->lam, m->n_rows), TAKE(one->acceleration, m->n_elements);
    TAKE(one->painleve, m->n_elements), TAKE(one->direction, m->n_elements);
    TAKE(one->values, m->n_variables);
    TAKE(one->contact, m->n_contacts), TAKE(one->element, m->n_elements);
    TAKE(one->since, m->n_contacts + m->n_elements);
  }
}

static void lay_out(const frot_model *m, arena *a, frot_motions_memory *c) {
  frot_layout l = frot_layout_of(m);
  size_t places = 0, items = 0, width = 0, doubles = 0, integers = 0;
  for (int part = 0; part < parts_of(m); part++) {
    int first, end;
    groups_of(m, part, &first, &end);
    frot_instant_size size = frot_size_of_instant(m, first, end);
    places = larger(places, (size_t)size.places), items = larger(items, (size_t)size.items);
    width = larger(width, (size_t)size.width);
    doubles = larger(doubles, (size_t)frot_motion_doubles(size.places, size.places, size.width,
                                                          size.places, size.items));
    integers = larger(integers, (size_t)frot_motion_integers(size.places, size.places, size.items));
    int rows = size.places + 3 * size.items;
    doubles = larger(doubles, (size_t)frot_vector_doubles(rows));
    integers = larger(integers, (size_t)frot_vector_integers(rows));
  }
  TAKE(c->at.q, m->nq + m->nv + FROT_QUADRATURES);
  TAKE(c->at.modes, m->n_contacts + m->n_elements), TAKE(c->at.zero, m->n_elements + 1);
  TAKE(c->one.place_of, m->n_rows + 1), TAKE(c->one.row_at, places + 1);
  TAKE(c->one.contact_of, items + 1), TAKE(c->one.element_of, items + 1);
  TAKE(c->one.items, items + 1), TAKE(c->one.permanent, places + 1);
  TAKE(c->one.w, places * places + 1), TAKE(c->one.unit, places + 1);
  TAKE(c->one.rows, places * width + 1), TAKE(c->one.force, width + 1);
  TAKE(c->one.turned, places * width + 1), TAKE(c->one.parts, places * places + 1);
  TAKE(c->one.length, places + 1), TAKE(c->one.gram, places * places + 1);
  TAKE(c->one.bias, 2 * places + 1), TAKE(c->one.bias_size, places + 1);
  TAKE(c->one.basis_row, places + 1), TAKE(c->one.taken, places + 1);
  TAKE(c->taylor.z, FROT_ORDERS * l.nw + 1), TAKE(c->taylor.lam, FROT_ORDERS * m->n_rows + 1);
  TAKE(c->taylor.force, FROT_ORDERS * l.nw + 1), TAKE(c->taylor.nothing, l.nw + 1);
  TAKE(c->taylor.given, FROT_ORDERS * (l.nw + m->n_rows + 2 * m->n_elements) + 1);
  TAKE(c->x, places + 1), TAKE(c->b, places + 1), TAKE(c->vectors, 1);
  TAKE(c->blocks, frot_vector_blocks((int)(places + 3 * items)));
  TAKE(c->list, 1), TAKE(c->doubles, doubles), TAKE(c->integers, integers);
  TAKE(c->part_of_contact, m->n_contacts + 1), TAKE(c->contacts, m->n_contacts + 1);
  lay_out_motions(m, &l, a, c);
}

size_t frot_motions_size(const frot_model *m) {
  arena a = {NULL, 0};
  frot_motions_memory c;
  memset(&c, 0, sizeof c);
  lay_out(m, &a, &c);
  return a.used + 16;
}

/* Coordinates and speeds of the state, and the values that go with them. */
static void find_state(const frot_model *m, frot_state *s, frot_work *w, frot_place_of_motion *at) {
  frot_layout l = frot_layout_of(m);
  *at = (frot_place_of_motion){m, s, w, s->t, at->q, NULL, s->data + l.d, at->modes, at->zero};
  at->v = at->q + m->nq;
  if (s->phase == FROT_FAULTED) {
    memcpy(at->q, s->data + l.x, sizeof(double) * (size_t)(m->nq + m->nv));
    memcpy(w->blocks.y, s->data + l.y, sizeof(double) * (size_t)m->ny);
    return;
  }
  frot_segment g = frot_segment_at(m, s->data + l.segment);
  frot_interpolate(m, &g, s->t, at->q);
  frot_guess_unknowns(m, w, &g, s->t);
  frot_normalise(m, at->q);
}

/* Values of the variables in a motion, and of the other parts in their first ones. */
static int find_values(frot_motions_memory *c, const frot_motions_found *found, int k) {
  const frot_place_of_motion *at = &c->at;
  const frot_model *m = at->m;
  frot_work *w = at->w;
  frot_motion *own = &found->motions[k];
  memset(w->core.lam, 0, sizeof(double) * (size_t)m->n_rows);
  for (int part = 0; part < found->n_parts; part++) {
    const frot_motion *of = own->part == part ? own : NULL;
    for (int i = 0; i < found->count && !of; i++)
      if (found->motions[i].part == part) of = &found->motions[i];
    int first, end;
    groups_of(m, part, &first, &end);
    for (int g = first; g < end; g++) {
      const frot_group *group = &m->groups[g];
      for (int j = 0; j < group->n; j++)
        w->core.a[group->unknowns[j]] = of ? of->a[group->unknowns[j]] : NAN;
      for (int j = 0; j < group->n_rows; j++)
        w->core.lam[group->rows[j]] = of ? of->lam[group->rows[j]] : NAN;
    }
  }
  double energies[FROT_QUADRATURES] = {0};
  if (frot_solve_late(m, at->s, w, at->t, at->q, at->v, at->d) != FROT_OK) return FROT_NAN;
  frot_inputs(at->s, w, &at->t, at->q, at->v, at->d);
  w->call.arg[7] = w->core.a, w->call.arg[8] = frot_lam_of_text(m, w), w->call.arg[9] = energies;
  w->call.res[0] = own->values;
  frot_call(w, &m->variables);
  return FROT_OK;
}

static void list_part(frot_motions_memory *c, int part, int nodes, frot_motions_found *found) {
  const frot_model *m = c->at.m;
  frot_contact_instant *one = &c->one;
  one->at = &c->at, one->taylor = &c->taylor, c->taylor.of = one;
  groups_of(m, part, &one->first, &one->end);
  if (one->first == one->end) return;
  frot_pose_contact_problem(one);
  if (one->vectors > 0) {
    frot_pose_vector_problem(one, c->doubles, c->integers, c->blocks, c->vectors);
    frot_list_vector_motions(c->vectors);
    found->complete &= c->vectors->complete, found->proved = found->highest = 0;
    for (int k = 0; k < c->vectors->count && found->count < MOST + part; k++)
      frot_describe_vector_motion(c, part, k, &found->motions[found->count++]);
    for (int i = 0; i < c->vectors->n_items; i++) c->contacts[c->vectors->items[i].contact] = 1;
    return;
  }
  frot_list_motions(&one->problem, nodes, c->list, c->doubles, c->integers);
  found->complete &= c->list->complete, found->nodes += c->list->nodes;
  found->highest = one->problem.orders < found->highest ? one->problem.orders : found->highest;
  int before = found->count, left = MOST - (before - part);
  for (int k = 0; k < c->list->count; k++) {
    if (k >= left && k > 0) {
      found->complete = 0;
      break;
    }
    frot_describe_motion(c, part, k, before, &found->motions[found->count++]);
  }
  for (int i = 0; i < one->problem.n_items; i++) c->contacts[one->contact_of[i]] = 1;
}

int frot_motions(const frot_model *m, frot_state *s, frot_work *w, void *memory, int nodes,
                 frot_motions_found *found) {
  if (s->phase == FROT_CLEARED) return FROT_MISUSE;
  arena a = {memory, 0};
  frot_motions_memory c;
  memset(&c, 0, sizeof c);
  memset(memory, 0, frot_motions_size(m));
  lay_out(m, &a, &c);
  frot_bind_work(m, w);
  find_state(m, s, w, &c.at);
  *found = (frot_motions_found){
      parts_of(m), 0, 1, 1, FROT_HIGHEST_ORDER, 0, c.motions, c.contacts, c.part_of_contact};
  int phase = s->phase, status = frot_evaluate_place(&c.at);
  if (status != FROT_OK) return status;
  for (int i = 0; i < m->n_contacts; i++)
    for (int part = 0; part < found->n_parts; part++) {
      int first, end;
      groups_of(m, part, &first, &end);
      if (m->contact_group[i] >= first && m->contact_group[i] < end) c.part_of_contact[i] = part;
    }
  for (int part = 0; part < found->n_parts; part++) list_part(&c, part, nodes, found);
  for (int k = 0; k < found->count && status == FROT_OK; k++) status = find_values(&c, found, k);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, s->t);
  s->phase = phase;
  return FROT_OK;
}

int frot_element_count(const frot_model *m) { return m->n_elements; }

int frot_law_of_element(const frot_model *m, int element, int *contact, int *part, int *parts) {
  const frot_element *e = &m->elements[element];
  *contact = e->contact, *part = e->part, *parts = e->parts;
  if (e->bound == FROT_BY_VALUE) return FROT_OF_THE_TEXT;
  if (e->bound == FROT_BY_PIN) return FROT_IN_A_PIN;
  if (!e->rolling) return FROT_SLIDING;
  /* in space rolling has two components, pivoting one; in the plane nothing pivots */
  int vectors = 0;
  for (int k = 0; k < m->n_elements; k++) vectors |= m->elements[k].parts > 1;
  return vectors && e->parts == 1 ? FROT_TURNING : FROT_ROLLING;
}
