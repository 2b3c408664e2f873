#include "run/exchange_meetings.h"

#include <string.h>

#include "constraints/projection.h"
#include "evaluation/evaluate.h"
#include "run/exchange_guards.h"

/* Whether a contact is to have the gap zero. */
typedef int (*choice)(const frot_model *m, frot_state *s, frot_work *w, int contact);

static int meets(const frot_model *m, frot_state *s, frot_work *w, int i) {
  return s->data[w->layout.fired + i] != 0 && m->contacts[i].row_n >= 0;
}

/* The modes of the run in w->search.trial, with the open contacts chosen closed and free to slip.
 * Returns whether there are some. */
static int close_chosen(const frot_model *m, frot_state *s, frot_work *w, choice chosen) {
  frot_contact_mode *trial = w->search.trial;
  size_t modes = (size_t)(m->n_contacts + m->n_elements);
  int any = 0;
  memcpy(trial, s->data + w->layout.modes, sizeof *trial * modes);
  for (int i = 0; i < m->n_contacts; i++) {
    if (trial[i].closed || !chosen(m, s, w, i)) continue;
    trial[i].closed = 1, any = 1;
    for (int e = 0; e < m->n_elements; e++)
      if (m->elements[e].contact == i) trial[m->n_contacts + e].friction = FROT_NONE;
  }
  return any;
}

/* Put the open contacts chosen to the gap zero. */
static void put(const frot_model *m, frot_state *s, frot_work *w, double *q, const double *v,
                choice chosen, int *moved) {
  const frot_layout *l = &w->layout;
  double *there = w->step.z;
  int moves = 0;
  if (!close_chosen(m, s, w, chosen)) return;
  memcpy(there, q, sizeof(double) * (size_t)m->nq);
  memcpy(there + m->nq, v, sizeof(double) * (size_t)m->nv);
  int status = frot_project(m, s, w, s->t, there, there + m->nq, s->data + l->d, w->search.trial,
                            NULL, s->data + l->frozen, &moves);
  if (status != FROT_OK || !moves) return;
  memcpy(q, there, sizeof(double) * (size_t)m->nq);
  *moved = 1;
}

void frot_put_meetings(const frot_model *m, frot_state *s, frot_work *w, double *q, const double *v,
                       int *moved) {
  put(m, s, w, q, v, meets, moved);
}

int frot_put_out(const frot_model *m, frot_state *s, frot_work *w, double *q, const double *v,
                 int *moved) {
  for (int i = 0; i < m->n_contacts; i++) {
    if (!frot_has_just_parted(m, s, w, i)) continue;
    int status = frot_kinematics(m, s, w, s->t, q, v, s->data + w->layout.d);
    if (status == FROT_OK) put(m, s, w, q, v, frot_is_inside_by_error, moved);
    return status;
  }
  return FROT_OK;
}
