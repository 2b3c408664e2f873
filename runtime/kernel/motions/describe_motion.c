#include "motions/describe_motion.h"

#include <math.h>
#include <string.h>

#include "evaluation/slip_frames.h"
#include "model/indexing.h"
#include "numerics/dense.h"

/* Part of their terms up to which accelerations are none. */
#define RESTS 1e-11

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
static void tell_dynamics(frot_motions_memory *c, int part, const double *x, const double *b,
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
void frot_describe_motion(frot_motions_memory *c, int part, int k, int before, frot_motion *one) {
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

void frot_describe_vector_motion(frot_motions_memory *c, int part, int k, frot_motion *one) {
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
