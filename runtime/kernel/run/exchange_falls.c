#include "run/exchange_falls.h"

#include <string.h>

#include "constraints/redundant_rows.h"
#include "evaluation/term_sizes.h"
#include "guards/conditions.h"
#include "methods/dormand_prince.h"
#include "methods/right_hand_side.h"
#include "numerics/tolerances.h"

/* The states after the time `later` from x, along the slope noted. */
static double *lead(const frot_model *m, const frot_state *s, const frot_work *w, const double *x,
                    double later) {
  const double *slope = s->data + w->layout.slope;
  double *there = w->step.z;
  memcpy(there, x, sizeof(double) * (size_t)w->layout.nx);
  for (int k = 0; k < m->nq + m->nv; k++) there[k] += later * slope[k];
  return there;
}

/* Values of the conditions there. */
static int look(const frot_model *m, frot_state *s, frot_work *w, const double *x, double later) {
  const double *there = lead(m, s, w, x, later);
  return frot_evaluate_conditions(m, s, w, s->t + later, there, there + m->nq);
}

void frot_fire_falling(const frot_model *m, frot_state *s, frot_work *w, const double *x) {
  const frot_layout *l = &w->layout;
  const double *value = w->core.condition, *d = s->data + l->d;
  const double *size = s->data + l->scale_g + frot_condition_guard(m);
  double *fired = s->data + l->fired + frot_condition_guard(m), *now = w->events.was;
  double whole = frot_size_of_time(s->t, s->h_max), soon = FROT_SOON * whole;
  if (m->n_located == 0 || look(m, s, w, x, 0) != FROT_OK) return;
  memcpy(now, value, sizeof(double) * (size_t)m->n_located);
  if (look(m, s, w, x, soon) != FROT_OK) return;
  for (int j = 0; j < m->n_located; j++) {
    double way = d[j] != 0 ? 1 : -1, falls = way * (now[j] - value[j]);
    if (!(falls > FROT_UNCHANGED * size[j])) continue;
    if (way * now[j] <= falls * (FROT_ONE_INSTANT / FROT_SOON)) fired[j] = 1;
  }
}

int frot_meets_now(const frot_model *m, const frot_state *s, frot_work *w, int contact,
                   double gap) {
  const frot_layout *l = &w->layout;
  int row = m->contacts[contact].row_n;
  double instant = FROT_ONE_INSTANT * frot_size_of_time(s->t, s->h_max);
  double closes = -w->core.rate[row], none = FROT_ZERO * s->data[l->scale_g + contact];
  if (gap <= 0) return 1;
  if (!(closes > FROT_TOUCH * frot_row_speed(m, w, row, s->data + l->x + m->nq))) return 0;
  return gap <= fmax(none, closes * instant);
}

/* Whether reactions that are not unique hold something. */
static int some_shared(const frot_model *m, const frot_state *s, const frot_work *w) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  for (int i = 0; i < m->n_contacts + m->n_elements; i++)
    if (modes[i].shared || modes[i].at_bound) return 1;
  return 0;
}

void frot_look_beyond(const frot_model *m, frot_state *s, frot_work *w) {
  const frot_layout *l = &w->layout;
  double later = FROT_SOON * frot_size_of_time(s->t, s->h_max);
  if (w->reactions.beyond >= 0 || !some_shared(m, s, w)) return;
  const double *there = lead(m, s, w, s->data + l->x, later);
  memset(w->reactions.carried, 0, (size_t)m->n_rows);
  frot_use_redundant_rows(m, w, s->data + l->spare);
  w->reactions.ahead = 1;
  if (frot_slope(m, s, w, s->t + later, there, frot_stage(w, 0)) != FROT_OK)
    w->reactions.beyond = -1;
  w->reactions.ahead = 0;
  frot_forget_redundant_rows(w);
}
