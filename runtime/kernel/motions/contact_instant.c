#include "motions/contact_instant.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "evaluation/fault_source.h"
#include "evaluation/slip_frames.h"
#include "evaluation/term_sizes.h"
#include "inertia/extended_inertia.h"
#include "motions/permanent_rows.h"
#include "motions/taylor.h"
#include "numerics/dense.h"
#include "numerics/tolerances.h"

/* Whether a law's coefficients can ever bound anything. */
static int bounds_anything(const frot_model *m, const frot_work *w, int e) {
  const double *k = w->core.coefficient + 2 * e;
  return !(m->elements[e].fixed && k[0] == 0 && k[1] == 0);
}

/* Speed of a row up to which it is none: of the speeds it is made of, of what all motion could
 * bring it, and of what loads bring in a rounding of time to what has never moved. */
static double no_speed(const frot_place_of_motion *at, int row) {
  const double *met = at->s->data + at->w->layout.scale_x + at->m->nq;
  double known = frot_row_size(at->m, at->w, row, met);
  double size = fmax(frot_row_size(at->m, at->w, row, at->v), known);
  double least = FROT_LOCATED * size;
  least += FROT_ZERO_OF_MOTION * frot_row_speed(at->m, at->w, row, at->v);
  if (known > 0) return least;
  return least + DBL_EPSILON * fmax(fabs(at->t), at->s->h_max) * at->w->core.row_load[row];
}

static int is_unilateral(const frot_place_of_motion *at, int i) {
  return at->s->data[at->w->layout.unilateral + i] != 0;
}

/* Whether a contact that may part may be closed at the instant; FROT_IMPACT where it closes with
 * speed. */
static int close_contact(const frot_place_of_motion *at, int i, int *closed) {
  const frot_model *m = at->m;
  const frot_contact_mode *kept = (const void *)(at->s->data + at->w->layout.modes);
  int row = m->contacts[i].row_n;
  double least = no_speed(at, row), rate = at->w->core.rate[row];
  double size = frot_size_of_gap(m, at->s, at->w, i, at->q);
  int touches = kept[i].closed || at->w->core.gap[i] <= FROT_LOCATED * size;
  *closed = touches && fabs(rate) <= least;
  return touches && rate < -least ? frot_fail(at->s, FROT_IMPACT, at->t, i, -1, -1, rate) : FROT_OK;
}

/* Modes from the kinematics: what is closed, and what rests. */
static int find_modes(frot_place_of_motion *at) {
  const frot_model *m = at->m;
  const frot_contact_mode *kept = (const void *)(at->s->data + at->w->layout.modes);
  memset(at->modes, 0, sizeof *at->modes * (size_t)(m->n_contacts + m->n_elements));
  for (int i = 0; i < m->n_contacts; i++) {
    int closed = 1, status = FROT_OK;
    if (frot_has_normal(&m->contacts[i]) && is_unilateral(at, i) && !m->contacts[i].reduced)
      status = close_contact(at, i, &closed);
    if (status != FROT_OK) return status;
    at->modes[i].closed = (signed char)closed, at->modes[i].side = 1;
  }
  for (int e = 0; e < m->n_elements; e++) {
    const frot_element *element = &m->elements[e];
    int first = e - element->part, row = element->row - element->part;
    int rested = frot_element_mode(m, kept, first)->friction == FROT_STICK;
    double least = 0;
    for (int k = 0; k < element->parts; k++) least = fmax(least, no_speed(at, row + k));
    if (element->prescribed) least = fmax(least, FROT_PRESCRIBED_REST);
    double rate = frot_slip_of(m, at->w->core.rate, first, NULL);
    at->zero[e] = (unsigned char)(rested || rate <= least);
    at->modes[m->n_contacts + e].friction =
        (signed char)(at->zero[e]                           ? FROT_STICK
                      : element->part > 0                   ? FROT_NONE
                      : at->w->core.rate[element->row] >= 0 ? FROT_SLIP_FORWARD
                      : element->parts > 1                  ? FROT_SLIP_FORWARD
                                                            : FROT_SLIP_BACKWARD);
  }
  return FROT_OK;
}

int frot_evaluate_place(frot_place_of_motion *at) {
  const frot_model *m = at->m;
  int status = frot_kinematics(m, at->s, at->w, at->t, at->q, at->v, at->d);
  if (status != FROT_OK) return frot_fail_evaluation(m, at->s, at->w, status, at->t);
  frot_note_reaches(m, at->s, at->w, at->t, at->q, at->v, at->d);
  for (int i = 0; i < m->n_contacts; i++) at->modes[i].closed = 1;
  status = frot_dynamics(m, at->s, at->w, at->t, at->q, at->v, at->d, at->modes, FROT_LAWS);
  if (status == FROT_OK) status = frot_metric(m, at->w);
  if (status != FROT_OK) return frot_fail_evaluation(m, at->s, at->w, status, at->t);
  frot_row_loads(m, at->s, at->w, at->t, at->q, at->v, at->d);
  status = find_modes(at);
  if (status != FROT_OK) return status;
  status = frot_dynamics(m, at->s, at->w, at->t, at->q, at->v, at->d, at->modes, FROT_LAWS);
  if (status == FROT_OK) status = frot_metric(m, at->w);
  if (status != FROT_OK) return frot_fail_evaluation(m, at->s, at->w, status, at->t);
  frot_row_loads(m, at->s, at->w, at->t, at->q, at->v, at->d);
  return FROT_OK;
}

frot_instant_size frot_size_of_instant(const frot_model *m, int first, int end) {
  frot_instant_size size = {0, 0, 0};
  for (int k = first; k < end; k++) {
    const frot_group *g = &m->groups[k];
    size.places += g->n_rows, size.items += g->n_contacts + g->n_elements;
    size.width += g->n_speeds;
  }
  return size;
}

static int add_row(frot_contact_instant *one, int row) {
  int at = one->problem.n++;
  one->place_of[row] = at, one->row_at[at] = row;
  return at;
}

/* Rows with unknowns: of contacts that are closed, and of laws that act. */
static void list_rows(frot_contact_instant *one, const frot_group *g) {
  const frot_place_of_motion *at = one->at;
  const frot_model *m = at->m;
  for (int k = 0; k < g->n_contacts; k++) {
    const frot_contact *contact = &m->contacts[g->contacts[k]];
    if (contact->row_n < 0 || contact->reduced || !at->modes[g->contacts[k]].closed) continue;
    int place = add_row(one, contact->row_n);
    if (!is_unilateral(at, g->contacts[k])) one->permanent[one->problem.n_permanent++] = place;
  }
  for (int k = 0; k < g->n_elements; k++) {
    int e = g->elements[k];
    const frot_element *element = &m->elements[e];
    if (!at->modes[element->contact].closed || !bounds_anything(m, at->w, e - element->part))
      continue;
    if (element->part > 0 && !at->zero[e]) continue;
    if (element->parts > 1 && at->zero[e]) one->vectors++;
    add_row(one, element->row);
  }
}

static int add_item(frot_contact_instant *one, int contact, int element) {
  int at = one->problem.n_items++;
  one->items[at] = (frot_motion_item){.contact = -1};
  one->contact_of[at] = contact, one->element_of[at] = element;
  return at;
}

static void add_contacts(frot_contact_instant *one, const frot_group *g) {
  for (int k = 0; k < g->n_contacts; k++) {
    int i = g->contacts[k], row = one->at->m->contacts[i].row_n;
    if (row < 0 || one->at->m->contacts[i].reduced || !one->at->modes[i].closed) continue;
    if (!is_unilateral(one->at, i)) continue;
    frot_motion_item *item = &one->items[add_item(one, i, -1)];
    item->kind = FROT_ITEM_CONTACT, item->row = one->place_of[row];
  }
}

static int item_of_contact(const frot_contact_instant *one, int contact) {
  for (int k = 0; k < one->problem.n_items; k++)
    if (one->element_of[k] < 0 && one->contact_of[k] == contact) return k;
  return -1;
}

static void add_laws(frot_contact_instant *one, const frot_group *g) {
  const frot_place_of_motion *at = one->at;
  const frot_model *m = at->m;
  for (int k = 0; k < g->n_elements; k++) {
    int e = g->elements[k];
    const frot_element *element = &m->elements[e];
    int place = one->place_of[element->row];
    if (place < 0 || (element->parts > 1 && at->zero[e])) continue;
    frot_motion_item *item = &one->items[add_item(one, element->contact, e)];
    const double *coefficient = at->w->core.coefficient + 2 * e;
    item->kind = FROT_ITEM_LAW, item->row = place;
    item->mu = coefficient[0], item->mu_s = coefficient[1];
    item->contact = item_of_contact(one, element->contact);
    if (!at->zero[e])
      item->moving = element->parts > 1 || at->w->core.rate[element->row] > 0 ? 1 : -1;
    item->bound = element->bound == FROT_BY_VALUE ? FROT_BOUND_VALUE
                  : element->bound == FROT_BY_PIN ? FROT_BOUND_LENGTH
                  : item->contact >= 0            ? FROT_BOUND_PRESSING
                                                  : FROT_BOUND_SIDED;
    for (int c = 0; c < 2 && element->bounded_by[c] >= 0; c++)
      item->reads[c] = one->place_of[element->bounded_by[c]];
    /* the sectors are those of one length of two components; other bounds take Newton's method */
    int by_one_length = element->bounded_by[2] < 0 && element->norm[1] == 0;
    if (element->bound == FROT_BY_PIN && !by_one_length) one->vectors++;
  }
}

/* Units in which reactions compare: forces along normals and slips beside them as they are; others
 * by the motion they bring, over that of those. */
static void choose_units(frot_contact_instant *one) {
  const frot_model *m = one->at->m;
  int n = one->problem.n;
  double of_forces = 0;
  for (int pass = 0; pass < 2; pass++)
    for (int j = 0; j < n; j++) {
      int row = one->row_at[j], is_force = m->row_beside[row] >= 0;
      for (int i = 0; i < m->n_contacts; i++)
        is_force |= m->contacts[i].row_n == row && !m->contacts[i].turns;
      double own = one->w[j * n + j];
      if (pass == 0 && is_force) of_forces = fmax(of_forces, own);
      if (pass == 0) continue;
      one->unit[j] = is_force || !(own > 0) ? 1 : sqrt((of_forces > 0 ? of_forces : 1) / own);
    }
}

/* Rows in the metric of the speeds, and the loads there. */
static void list_metric(frot_contact_instant *one) {
  const frot_model *m = one->at->m;
  frot_work *w = one->at->w;
  int width = one->problem.width, n = one->problem.n, from = 0;
  memset(one->rows, 0, sizeof(double) * (size_t)(n * width));
  for (int k = one->first; k < one->end; k++) {
    const frot_group *g = &m->groups[k];
    for (int j = 0; j < n; j++)
      if (m->row_group[one->row_at[j]] == k)
        memcpy(one->rows + j * width + from, frot_entries(m, w->core.half, one->row_at[j]),
               sizeof(double) * (size_t)g->n_speeds);
    memcpy(one->force + from, w->core.force + g->vector, sizeof(double) * (size_t)g->n_speeds);
    from += g->n_speeds;
  }
}

static int anything_moves(const frot_contact_instant *one) {
  const frot_model *m = one->at->m;
  for (int k = one->first; k < one->end; k++)
    for (int j = 0; j < m->groups[k].n_speeds; j++)
      if (one->at->v[m->groups[k].unknowns[j]] != 0) return 1;
  return 0;
}

/* How fast loads change, in 1/s: over the run, and as loads move lengths. */
static double rate_of(const frot_contact_instant *one) {
  const frot_place_of_motion *at = one->at;
  double rate = at->s->h_max > 0 ? 1 / at->s->h_max : 1;
  for (int i = 0; i < at->m->n_contacts; i++) {
    int row = at->m->contacts[i].row_n;
    if (row < 0 || at->m->row_group[row] < one->first || at->m->row_group[row] >= one->end)
      continue;
    double length = at->s->data[at->w->layout.reach + i];
    if (length > 0 && at->modes[i].closed && !at->m->contacts[i].reduced)
      rate = fmax(rate, sqrt(at->w->core.row_load[row] / length));
  }
  return rate;
}

void frot_pose_contact_problem(frot_contact_instant *one) {
  const frot_model *m = one->at->m;
  frot_work *w = one->at->w;
  frot_motion_problem *p = &one->problem;
  *p = (frot_motion_problem){0};
  one->vectors = one->wide = 0;
  for (int i = 0; i < m->n_rows; i++) one->place_of[i] = -1;
  int general = 0;
  for (int k = one->first; k < one->end; k++) {
    list_rows(one, &m->groups[k]);
    general |= m->groups[k].general, one->wide |= frot_in_wide(m, w, &m->groups[k]);
  }
  p->places = p->n;
  for (int k = one->first; k < one->end; k++)
    for (int i = 0; i < m->groups[k].n_rows; i++) {
      int row = m->groups[k].rows[i];
      if (!frot_is_reading(m, row)) continue;
      one->place_of[row] = p->places, one->row_at[p->places++] = row;
    }
  for (int i = 0; i < p->places; i++)
    for (int j = 0; j < p->n; j++) {
      int a = one->row_at[i], b = one->row_at[j];
      one->w[i * p->n + j] = m->row_group[a] == m->row_group[b] ? frot_effect(m, w, a, b) : 0;
    }
  choose_units(one);
  p->items = one->items, p->permanent = one->permanent, p->w = one->w;
  frot_instant_size size = frot_size_of_instant(m, one->first, one->end);
  p->width = general ? 0 : size.width;
  p->unit = one->unit, p->rows = one->rows, p->force = one->force;
  memcpy(one->gram, one->w, sizeof(double) * (size_t)(p->n * p->n));
  one->rank = 0;
  if (!general) {
    list_metric(one);
    frot_turn_permanent_rows(one);
    for (int i = 0; i < p->n; i++)
      for (int j = 0; j < p->n; j++)
        one->w[i * p->n + j] =
            frot_dot(one->turned + i * p->width, one->rows + j * p->width, p->width);
  }
  p->gram = one->gram;
  for (int k = one->first; k < one->end; k++) add_contacts(one, &m->groups[k]);
  for (int k = one->first; k < one->end; k++) add_laws(one, &m->groups[k]);
  p->moves = anything_moves(one), p->rate = rate_of(one);
  p->orders = m->orders.call && !one->wide ? FROT_HIGHEST_ORDER : 0;
  one->taylor->of = one;
  p->right_side = frot_taylor_right_side, p->context = one->taylor;
}
