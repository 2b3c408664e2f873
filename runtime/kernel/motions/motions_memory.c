#include "motions/motions_memory.h"

#include <string.h>

#include "model/segment.h"

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

int frot_parts_of(const frot_model *m) { return m->n_islands > 0 ? m->n_islands : 1; }

void frot_groups_of_part(const frot_model *m, int part, int *first, int *end) {
  *first = m->n_islands > 0 ? m->islands[part].first_group : 0;
  *end = *first + (m->n_islands > 0 ? m->islands[part].n_groups : m->n_groups);
}

static size_t larger(size_t a, size_t b) { return a > b ? a : b; }

static void lay_out_described(const frot_model *m, const frot_layout *l, arena *a,
                              frot_motions_memory *c) {
  int count = FROT_MOST_DESCRIBED + frot_parts_of(m);
  frot_motion none = {0};
  TAKE(c->place, m->nq + m->nv + FROT_QUADRATURES);
  TAKE(c->motions, count);
  TAKE(c->part_of_contact, m->n_contacts + 1), TAKE(c->contacts, m->n_contacts + 1);
  for (int k = 0; k < count; k++) {
    frot_motion *one = a->base ? &c->motions[k] : &none;
    TAKE(one->a, l->nw), TAKE(one->lam, m->n_rows), TAKE(one->acceleration, m->n_elements);
    TAKE(one->painleve, m->n_elements), TAKE(one->direction, m->n_elements);
    TAKE(one->values, m->n_variables);
    TAKE(one->contact, m->n_contacts), TAKE(one->element, m->n_elements);
    TAKE(one->since, m->n_contacts + m->n_elements);
  }
}

static void lay_out(const frot_model *m, int most_items, arena *a, frot_motions_memory *c) {
  frot_layout l = frot_layout_of(m);
  size_t places = 0, items = 0, width = 0, doubles = 0, integers = 0;
  for (int part = 0; part < frot_parts_of(m); part++) {
    int first, end;
    frot_groups_of_part(m, part, &first, &end);
    frot_instant_size size = frot_size_of_instant(m, first, end);
    if (size.items > most_items) continue;
    places = larger(places, (size_t)size.places), items = larger(items, (size_t)size.items);
    width = larger(width, (size_t)size.width);
    doubles = larger(doubles, (size_t)frot_motion_doubles(size.places, size.places, size.width,
                                                          size.places, size.items));
    integers = larger(integers, (size_t)frot_motion_integers(size.places, size.places, size.items));
    int rows = size.places + 3 * size.items;
    doubles = larger(doubles, (size_t)frot_vector_doubles(rows));
    integers = larger(integers, (size_t)frot_vector_integers(rows));
  }
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
}

size_t frot_motions_bytes(const frot_model *m, int most_items, int described) {
  arena a = {NULL, 0};
  frot_motions_memory c;
  frot_layout l = frot_layout_of(m);
  memset(&c, 0, sizeof c);
  lay_out(m, most_items, &a, &c);
  if (described) lay_out_described(m, &l, &a, &c);
  return a.used + 16;
}

void frot_lay_out_motions(const frot_model *m, void *block, int most_items, int described,
                          frot_motions_memory *c) {
  arena a = {block, 0};
  frot_layout l = frot_layout_of(m);
  memset(c, 0, sizeof *c);
  lay_out(m, most_items, &a, c);
  if (described) lay_out_described(m, &l, &a, c);
}
