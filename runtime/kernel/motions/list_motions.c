/* Every admissible motion of a state, part after part: groups whose loads read each other. */
#include <limits.h>
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
#include "motions/motions_memory.h"
#include "numerics/dense.h"

/* Contacts of a part whose laws act while they are closed, and of which all choices are tried. */
#define MOST_TOUCHING 6

/* Coordinates and speeds of the state, and the values that go with them. */
static void find_state(const frot_model *m, frot_state *s, frot_work *w, frot_motions_memory *c) {
  frot_layout l = frot_layout_of(m);
  double *x = c->place;
  c->at =
      (frot_place_of_motion){m, s, w, s->t, x, x + m->nq, s->data + l.d, c->at.modes, c->at.zero};
  if (s->phase == FROT_FAULTED) {
    memcpy(x, s->data + l.x, sizeof(double) * (size_t)(m->nq + m->nv));
    memcpy(w->blocks.y, s->data + l.y, sizeof(double) * (size_t)m->ny);
    return;
  }
  frot_segment g = frot_segment_at(m, s->data + l.segment);
  frot_interpolate(m, &g, s->t, x);
  frot_guess_unknowns(m, w, &g, s->t);
  frot_normalise(m, x);
}

/* What is read of whether a contact is closed, in a state. */
static double *closed_read(const frot_place_of_motion *at, int k) {
  const frot_model *m = at->m;
  return at->s->data + frot_layout_of(m).d + m->n_conditions + m->n_contacts + k;
}

/* Let laws that act while their contact is closed act as in the `chosen` modes of a part: contacts
 * that are apart are open, those that touch are closed by the bits of it. Returns how many touch.
 */
static int put_closed(const frot_motions_memory *c, int part, unsigned chosen) {
  const frot_model *m = c->at.m;
  int touching = 0;
  for (int k = 0; k < m->n_modes; k++) {
    int contact = m->mode_contact[k];
    if (m->mode_reads[k] != FROT_READS_CLOSED || c->part_of_contact[contact] != part) continue;
    int touches = c->at.modes[contact].closed;
    *closed_read(&c->at, k) = touches && (touching >= MOST_TOUCHING || !(chosen >> touching & 1));
    touching += touches;
  }
  return touching;
}

/* The same as in a motion; whether that is as they act now. */
static int acts_as_in(const frot_motions_memory *c, const frot_motion *motion) {
  const frot_model *m = c->at.m;
  int same = 1;
  for (int k = 0; k < m->n_modes; k++) {
    int contact = m->mode_contact[k];
    if (m->mode_reads[k] != FROT_READS_CLOSED || c->part_of_contact[contact] != motion->part)
      continue;
    double *read = closed_read(&c->at, k), closed = motion->contact[contact] == 1;
    same &= *read == closed;
    *read = closed;
  }
  return same;
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
    if (of) acts_as_in(c, of);
    int first, end;
    frot_groups_of_part(m, part, &first, &end);
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

/* The motions of a part under the loads at hand. */
static void list_under_loads(frot_motions_memory *c, int part, int nodes,
                             frot_motions_found *found) {
  const frot_model *m = c->at.m;
  frot_contact_instant *one = &c->one;
  one->at = &c->at, one->taylor = &c->taylor, c->taylor.of = one;
  frot_groups_of_part(m, part, &one->first, &one->end);
  if (one->first == one->end) return;
  frot_pose_contact_problem(one);
  if (one->vectors > 0) {
    frot_pose_vector_problem(one, c->doubles, c->integers, c->blocks, c->vectors);
    frot_list_vector_motions(c->vectors);
    found->complete &= c->vectors->complete, found->proved = found->highest = 0;
    for (int k = 0; k < c->vectors->count && found->count < FROT_MOST_DESCRIBED + part; k++)
      frot_describe_vector_motion(c, part, k, &found->motions[found->count++]);
    for (int i = 0; i < c->vectors->n_items; i++) c->contacts[c->vectors->items[i].contact] = 1;
    return;
  }
  frot_list_motions(&one->problem, nodes, c->list, c->doubles, c->integers);
  found->complete &= c->list->complete, found->nodes += c->list->nodes;
  found->highest = one->problem.orders < found->highest ? one->problem.orders : found->highest;
  int before = found->count, left = FROT_MOST_DESCRIBED - (before - part);
  for (int k = 0; k < c->list->count; k++) {
    if (k >= left && k > 0) {
      found->complete = 0;
      break;
    }
    frot_describe_motion(c, part, k, before, &found->motions[found->count++]);
  }
  for (int i = 0; i < one->problem.n_items; i++) c->contacts[one->contact_of[i]] = 1;
}

/* Take a motion off the list; its memory is that of the next one. */
static void take_off(frot_motions_found *found, int k) {
  frot_motion gone = found->motions[k];
  found->count--;
  for (int i = k; i < found->count; i++) {
    frot_motion *motion = &found->motions[i];
    *motion = found->motions[i + 1];
    if (motion->same >= k) motion->same = motion->same == k ? -1 : motion->same - 1;
  }
  found->motions[found->count] = gone;
}

/* The motions of a part: of those under each choice of the laws that act, those which they fit. */
static int list_part(frot_motions_memory *c, int part, int nodes, frot_motions_found *found) {
  int touching = put_closed(c, part, 0);
  unsigned choices = 1u << (touching < MOST_TOUCHING ? touching : MOST_TOUCHING);
  found->complete &= touching <= MOST_TOUCHING;
  for (unsigned chosen = 0; chosen < choices; chosen++) {
    int before = found->count, status = FROT_OK;
    put_closed(c, part, chosen);
    if (touching > 0) status = frot_evaluate_place(&c->at);
    if (status != FROT_OK) return status;
    list_under_loads(c, part, nodes, found);
    for (int k = before; k < found->count;) {
      put_closed(c, part, chosen);
      if (acts_as_in(c, &found->motions[k]))
        k++;
      else
        take_off(found, k);
    }
  }
  return FROT_OK;
}

size_t frot_motions_size(const frot_model *m) { return frot_motions_bytes(m, INT_MAX, 1); }

int frot_motions(const frot_model *m, frot_state *s, frot_work *w, void *memory, int nodes,
                 frot_motions_found *found) {
  if (s->phase == FROT_CLEARED) return FROT_MISUSE;
  frot_motions_memory c;
  memset(memory, 0, frot_motions_size(m));
  frot_lay_out_motions(m, memory, INT_MAX, 1, &c);
  frot_bind_work(m, w);
  find_state(m, s, w, &c);
  *found = (frot_motions_found){
      frot_parts_of(m), 0, 1, 1, FROT_HIGHEST_ORDER, 0, c.motions, c.contacts, c.part_of_contact};
  int phase = s->phase, status = frot_evaluate_place(&c.at);
  if (status != FROT_OK) return status;
  for (int i = 0; i < m->n_contacts; i++)
    for (int part = 0; part < found->n_parts; part++) {
      int first, end;
      frot_groups_of_part(m, part, &first, &end);
      if (m->contact_group[i] >= first && m->contact_group[i] < end) c.part_of_contact[i] = part;
    }
  for (int part = 0; part < found->n_parts && status == FROT_OK; part++)
    status = list_part(&c, part, nodes, found);
  if (status != FROT_OK) return status;
  for (int k = 0; k < found->count && status == FROT_OK; k++) status = find_values(&c, found, k);
  for (int k = 0; k < m->n_modes; k++)
    *closed_read(&c.at, k) =
        frot_mode_read(m, (const void *)(s->data + frot_layout_of(m).modes), k);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, s->t);
  s->phase = phase;
  return FROT_OK;
}

int frot_element_count(const frot_model *m) { return m->n_elements; }

int frot_law_of_element(const frot_model *m, int element, int *contact, int *part, int *parts) {
  const frot_element *e = &m->elements[element];
  *contact = e->contact, *part = e->part, *parts = e->parts;
  if (e->bound == FROT_BY_VALUE) return FROT_OF_THE_TEXT;
  if (!e->rolling && e->joint != FROT_JOINT_GOES)
    return e->joint == FROT_JOINT_TURNS ? FROT_IN_A_PIN : FROT_OF_THE_TEXT;
  if (!e->rolling) return FROT_SLIDING;
  /* in space rolling has two components, pivoting one; in the plane nothing pivots */
  int vectors = 0;
  for (int k = 0; k < m->n_elements; k++) vectors |= m->elements[k].parts > 1;
  return vectors && e->parts == 1 ? FROT_TURNING : FROT_ROLLING;
}
