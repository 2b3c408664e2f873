#include "run/exchange_slips.h"

#include <math.h>
#include <string.h>

#include "constraints/projection.h"
#include "evaluation/slip_frames.h"
#include "guards/vanishing_slips.h"
#include "model/indexing.h"
#include "run/exchange_guards.h"

/* Part of their sizes that speeds move at most where a slip is put at zero. */
#define NEAR 1e-4
static frot_contact_mode *modes_of(frot_state *s, const frot_work *w) {
  return (frot_contact_mode *)(void *)(s->data + w->layout.modes);
}

/* Whether speeds have moved by no more than a small part of their sizes. */
static int is_near(const frot_model *m, const frot_state *s, const frot_work *w, const double *x,
                   const double *there) {
  const double *size = s->data + w->layout.scale_x;
  for (int j = m->nq; j < m->nq + m->nv; j++)
    if (!(fabs(there[j] - x[j]) <= NEAR * size[j])) return 0;
  return 1;
}

/* Note that a slip of several components goes where its speed says. */
static void follow(const frot_model *m, frot_state *s, const frot_work *w, int e,
                   const double *direction, double slip) {
  s->data[w->layout.slip + e] = slip;
  memcpy(s->data + w->layout.heading + e, direction, sizeof(double) * (size_t)m->elements[e].parts);
}

int frot_stop_slips(const frot_model *m, frot_state *s, frot_work *w, double *x, int *moved) {
  const frot_layout *l = &w->layout;
  unsigned char *stopped = w->search.at_rest;
  double *there = w->step.z1;
  memset(stopped, 0, (size_t)m->n_elements);
  for (int e = 0; e < m->n_elements; e++) {
    if (!w->search.zero[e]) continue;
    stopped[e] = 1;
    memcpy(there, x, sizeof(double) * (size_t)l->nx);
    int status = frot_project(m, s, w, s->t, there, there + m->nq, s->data + l->d, modes_of(s, w),
                              stopped, s->data + l->frozen, moved);
    if (status != FROT_OK) return status;
    stopped[e] = (unsigned char)is_near(m, s, w, x, there);
    if (stopped[e])
      memcpy(x, there, sizeof(double) * (size_t)l->nx);
    else
      s->data[l->fired + frot_element_guard(m, e)] = FROT_SLIP_PASSES;
  }
  return FROT_OK;
}

/* Whether the slip of several components e can stop where it has come to zero. The states stay. */
static int may_stop(const frot_model *m, frot_state *s, frot_work *w, int e, const double *x) {
  unsigned char *stopped = w->search.at_rest;
  double *there = w->step.z1;
  int moved = 0;
  memset(stopped, 0, (size_t)m->n_elements);
  memset(stopped + e, 1, (size_t)m->elements[e].parts);
  memcpy(there, x, sizeof(double) * (size_t)w->layout.nx);
  int status = frot_project(m, s, w, s->t, there, there + m->nq, s->data + w->layout.d,
                            modes_of(s, w), stopped, s->data + w->layout.frozen, &moved);
  return status == FROT_OK && is_near(m, s, w, x, there);
}

int frot_let_slips_pass(const frot_model *m, frot_state *s, frot_work *w, const double *x) {
  int any = 0;
  for (int e = 0; e < m->n_elements; e++) {
    if (!w->search.zero[e]) continue;
    any = 1; /* before the rows are those of another place */
    w->guards.passed_slip[e] = frot_turned_slip(m, w, e, w->guards.end_direction + e);
  }
  for (int e = 0; e < m->n_elements; e++) {
    if (!w->search.zero[e] || may_stop(m, s, w, e, x)) continue;
    s->data[w->layout.fired + frot_element_guard(m, e)] = 0;
    follow(m, s, w, e, w->guards.end_direction + e, w->guards.passed_slip[e]);
  }
  return any;
}

void frot_follow_slips(const frot_model *m, frot_state *s, frot_work *w) {
  frot_contact_mode *modes = modes_of(s, w);
  frot_measure_slips(m, s, w);
  for (int e = 0; e < m->n_elements; e++) {
    if (!frot_slips_outside(m, modes, e)) continue;
    frot_contact_mode *mode = &modes[m->n_contacts + e];
    double guard = frot_guard_in_space(m, s, w, modes, e);
    if (mode->starts ? guard > 0 : guard <= 0 && frot_has_vanished(m, w, e)) continue;
    mode->starts = 0;
    double d[FROT_MOST_PARTS], slip = frot_turned_slip(m, w, e, d);
    follow(m, s, w, e, d, slip);
  }
}
