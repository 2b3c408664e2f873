#include "run/exchange_meetings.h"

#include <string.h>

#include "constraints/projection.h"

/* The modes of the run in w->search.trial, with the contacts that meet closed and free to slip.
 * Returns whether there are some. */
static int close_those_that_meet(const frot_model *m, const frot_state *s, frot_work *w) {
  const double *fired = s->data + w->layout.fired;
  frot_contact_mode *trial = w->search.trial;
  size_t modes = (size_t)(m->n_contacts + m->n_elements);
  int any = 0;
  memcpy(trial, s->data + w->layout.modes, sizeof *trial * modes);
  for (int i = 0; i < m->n_contacts; i++) {
    if (trial[i].closed || fired[i] == 0 || m->contacts[i].row_n < 0) continue;
    trial[i].closed = 1, any = 1;
    for (int e = 0; e < m->n_elements; e++)
      if (m->elements[e].contact == i) trial[m->n_contacts + e].friction = FROT_NONE;
  }
  return any;
}

void frot_put_meetings(const frot_model *m, frot_state *s, frot_work *w, double *q, const double *v,
                       int *moved) {
  const double *frozen = s->data + w->layout.frozen;
  double *there = w->step.z1;
  int moves = 0;
  if (!close_those_that_meet(m, s, w)) return;
  memcpy(there, q, sizeof(double) * (size_t)m->nq);
  memcpy(there + m->nq, v, sizeof(double) * (size_t)m->nv);
  int status = frot_project(m, s, w, s->t, there, there + m->nq, s->data + w->layout.d,
                            w->search.trial, NULL, frozen, &moves);
  if (status != FROT_OK || !moves) return;
  memcpy(q, there, sizeof(double) * (size_t)m->nq);
  *moved = 1;
}
