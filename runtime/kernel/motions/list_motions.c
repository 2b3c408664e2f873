/* Every admissible motion of a state, part after part: groups whose loads read each other. */
#include <math.h>
#include <string.h>

#include "contact/motion_search.h"
#include "evaluation/algebraic_loops.h"
#include "evaluation/fault_source.h"
#include "evaluation/quaternions.h"
#include "evaluation/slip_frames.h"
#include "model/calls.h"
#include "model/indexing.h"
#include "model/segment.h"
#include "motions/contact_instant.h"
#include "motions/taylor.h"
#include "motions/vector_motions.h"
#include "numerics/dense.h"

/* Motions of all parts that are kept, beside one of each. */
#define MOST 64
/* Part of their terms up to which accelerations are none. */
#define RESTS 1e-11

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

/* All memory of a call. */
typedef struct {
  frot_place_of_motion at;
  frot_contact_instant one;
  frot_taylor taylor;
  frot_motion_list *list;
  frot_vector_problem *vectors;
  frot_contact_block *blocks;
  double *doubles, *x, *b;
  int *integers, *part_of_contact;
  frot_motion *motions;
  signed char *contacts;
} memory_of_call;

static int parts_of(const frot_model *m) { return m->n_islands > 0 ? m->n_islands : 1; }

static void groups_of(const frot_model *m, int part, int *first, int *end) {
  *first = m->n_islands > 0 ? m->islands[part].first_group : 0;
  *end = *first + (m->n_islands > 0 ? m->islands[part].n_groups : m->n_groups);
}

static size_t larger(size_t a, size_t b) { return a > b ? a : b; }

static void lay_out_motions(const frot_model *m, const frot_layout *l, arena *a,
                            memory_of_call *c) {
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

static void lay_out(const frot_model *m, arena *a, memory_of_call *c) {
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
  memory_of_call c;
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

static int friction_of(const frot_item_state *state) {
  return state->mode == FROT_ITEM_FORWARD    ? FROT_SLIP_FORWARD
         : state->mode == FROT_ITEM_BACKWARD ? FROT_SLIP_BACKWARD
                                             : FROT_STICK;
}

static void clear_motion(const frot_model *m, const frot_layout *l, frot_motion *one) {
  memset(one->a, 0, sizeof(double) * (size_t)l->nw);
  memset(one->lam, 0, sizeof(double) * (size_t)m->n_rows);
  memset(one->acceleration, 0, sizeof(double) * (size_t)m->n_elements);
  memset(one->direction, 0, sizeof(double) * (size_t)m->n_elements);
  memset(one->contact, -1, (size_t)m->n_contacts);
  memset(one->element, -1, (size_t)m->n_elements);
  memset(one->since, 0, (size_t)(m->n_contacts + m->n_elements));
  for (int e = 0; e < m->n_elements; e++) one->painleve[e] = NAN;
}

/* Accelerations of a group that are no more than rounding of what they are the sum of are zero. */
static void rest_in_rounding(const frot_contact_instant *in, const double *x, double *a) {
  const frot_model *m = in->at->m;
  const frot_motion_problem *p = &in->problem;
  for (int k = in->first, from = 0; k < in->end && p->width > 0; k++) {
    const frot_group *g = &m->groups[k];
    double square = 0, size = 0;
    for (int j = from; j < from + g->n_speeds; j++) {
      double sum = p->force[j], terms = fabs(sum);
      for (int i = 0; i < p->n; i++) {
        double term = p->rows[i * p->width + j] * x[i];
        sum += term, terms += fabs(term);
      }
      square += sum * sum, size += terms * terms;
    }
    from += g->n_speeds;
    if (square > RESTS * RESTS * size) continue;
    for (int j = 0; j < g->n_speeds; j++) a[g->unknowns[j]] = 0;
  }
}

/* Accelerations and reactions of a motion from the reactions x (n) and right sides b (places). */
static void tell_dynamics(memory_of_call *c, int part, const double *x, const double *b,
                          frot_motion *one) {
  const frot_contact_instant *in = &c->one;
  const frot_model *m = in->at->m;
  clear_motion(m, &in->at->w->layout, one);
  one->part = part, one->decided = 1, one->same = -1;
  one->order = one->family = one->hardly = 0;
  frot_taylor_motion(&c->taylor, 0, x, b);
  memcpy(one->lam, c->taylor.lam, sizeof(double) * (size_t)m->n_rows);
  for (int g = in->first; g < in->end; g++)
    for (int j = 0; j < m->groups[g].n; j++) {
      int at = m->groups[g].unknowns[j];
      one->a[at] = c->taylor.z[at];
    }
  rest_in_rounding(in, x, one->a);
  for (int i = 0; i < m->n_contacts; i++)
    if (c->part_of_contact[i] == part && in->at->modes[i].closed) one->contact[i] = 1;
}

/* Direction and acceleration of the slip of a law with several components, in its rows as the text
 * has them. */
static void tell_slip(const frot_place_of_motion *at, const frot_vector_item *item, const double *a,
                      frot_motion *one) {
  const frot_element *element = &at->m->elements[item->element];
  int e = item->element, parts = element->parts, departs = at->zero[e];
  double size = frot_length(a, item->n);
  if (departs || parts == 1) {
    for (int k = 0; k < item->n; k++) one->acceleration[e + k] = a[k];
    double way = at->w->core.rate[element->row] < 0 ? -1 : 1;
    for (int k = 0; k < item->n; k++) one->direction[e + k] = departs ? a[k] / size : way;
    return;
  }
  const double *frame = at->w->core.frame + FROT_MOST_PARTS * FROT_MOST_PARTS * e;
  for (int k = 0; k < parts; k++) {
    one->direction[e + k] = frame[k], one->acceleration[e + k] = 0;
    for (int j = 0; j < parts; j++) {
      double along = j == 0 ? a[0] : at->w->core.free[element->row + j];
      for (int r = 0; r < at->m->n_rows && j > 0; r++)
        if (at->m->row_group[r] == at->m->row_group[element->row] && one->lam[r] != 0 &&
            !frot_is_reading(at->m, r))
          along += frot_effect(at->m, at->w, element->row + j, r) * one->lam[r];
      one->acceleration[e + k] += frame[j * parts + k] * along;
    }
  }
}

/* What the found motion k of a part is in the terms of the model. */
static void tell_motion(memory_of_call *c, int part, int k, int before, frot_motion *one) {
  const frot_contact_instant *in = &c->one;
  const frot_model *m = in->at->m;
  const frot_motion_problem *p = &in->problem;
  const frot_found_motion *found = &c->list->found[k];
  tell_dynamics(c, part, found->x, found->b, one);
  one->order = found->order, one->decided = found->decided;
  one->family = found->family, one->hardly = found->hardly;
  one->same = found->same < 0 ? -1 : before + found->same;
  for (int e = 0; e < m->n_elements; e++) {
    int i = in->place_of[m->elements[e].row];
    if (i >= 0 && i < p->n)
      one->acceleration[e] = found->b[i] + frot_dot(p->w + i * p->n, found->x, p->n);
  }
  for (int i = 0; i < p->n_items; i++) {
    const frot_item_state *state = &found->states[i];
    int contact = in->contact_of[i], e = in->element_of[i];
    if (e < 0) {
      one->contact[contact] = state->mode != FROT_ITEM_OPEN;
      one->since[contact] = state->since;
      continue;
    }
    int item = p->items[i].contact;
    if (item >= 0 && found->states[item].mode == FROT_ITEM_OPEN) continue;
    one->element[e] = (signed char)friction_of(state);
    one->since[m->n_contacts + e] = state->since;
    if (state->mode == FROT_ITEM_HELD || state->since > 0) one->acceleration[e] = 0;
    if (state->mode == FROT_ITEM_HELD) continue;
    if (m->elements[e].parts > 1) {
      const frot_vector_item item = {.element = e, .n = 1};
      double along = one->acceleration[e];
      tell_slip(in->at, &item, &along, one);
    } else {
      one->direction[e] = state->mode == FROT_ITEM_FORWARD ? 1 : -1;
    }
    one->painleve[e] = frot_painleve_coefficient(p, found, i, c->doubles, c->integers);
  }
}

static void tell_vector_motion(memory_of_call *c, int part, int k, frot_motion *one) {
  frot_vector_problem *p = c->vectors;
  const frot_contact_instant *in = &c->one;
  const frot_vector_motion *found = &p->found[k];
  for (int i = 0; i < in->problem.places; i++) {
    c->b[i] = in->at->w->core.free[in->row_at[i]], c->x[i] = 0;
    for (int j = 0; j < p->n; j++)
      if (p->row_of[j] == in->row_at[i]) c->x[i] = found->x[j];
  }
  tell_dynamics(c, part, c->x, c->b, one);
  for (int i = 0; i < p->n_items; i++) {
    const frot_vector_item *item = &p->items[i];
    if (item->element < 0) one->contact[item->contact] = !(found->open >> i & 1u);
  }
  for (int i = 0; i < p->n_items; i++) {
    const frot_vector_item *item = &p->items[i];
    if (item->element < 0 || one->contact[item->contact] == 0) continue;
    int slips = p->blocks[item->block].rule == FROT_ROW_SLIDES || (found->departs >> i & 1u);
    one->element[item->element] = (signed char)(slips ? FROT_SLIP_FORWARD : FROT_STICK);
    if (!slips) continue;
    tell_slip(in->at, item, found->a + item->at, one);
    one->painleve[item->element] = frot_vector_painleve(p, found, i);
  }
}

/* Values of the variables in a motion, and of the other parts in their first ones. */
static int find_values(memory_of_call *c, const frot_motions_found *found, int k) {
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

static void list_part(memory_of_call *c, int part, int nodes, frot_motions_found *found) {
  const frot_model *m = c->at.m;
  frot_contact_instant *one = &c->one;
  one->at = &c->at, one->taylor = &c->taylor, c->taylor.of = one;
  groups_of(m, part, &one->first, &one->end);
  if (one->first == one->end) return;
  frot_pose_contact_problem(one);
  if (one->vectors > 0) {
    frot_list_vector_motions(one, c->doubles, c->integers, c->blocks, c->vectors);
    found->complete &= c->vectors->complete, found->proved = found->highest = 0;
    for (int k = 0; k < c->vectors->count && found->count < MOST + part; k++)
      tell_vector_motion(c, part, k, &found->motions[found->count++]);
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
    tell_motion(c, part, k, before, &found->motions[found->count++]);
  }
  for (int i = 0; i < one->problem.n_items; i++) c->contacts[one->contact_of[i]] = 1;
}

int frot_motions(const frot_model *m, frot_state *s, frot_work *w, void *memory, int nodes,
                 frot_motions_found *found) {
  if (s->phase == FROT_CLEARED) return FROT_MISUSE;
  arena a = {memory, 0};
  memory_of_call c;
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
