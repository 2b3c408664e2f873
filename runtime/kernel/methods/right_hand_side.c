#include "evaluation/slip_frames.h"
#include "methods/right_hand_side.h"

#include <math.h>
#include <string.h>

#include "evaluation/algebraic_loops.h"
#include "evaluation/evaluate.h"
#include "reactions/switching_functions.h"
#include "reactions/reactions.h"
#include "evaluation/term_sizes.h"

/* Whether all accelerations are numbers. */
static int groups_finite(const frot_model *m, const frot_work *w) {
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_groups; k++) {
    const frot_group *g = &m->groups[now->groups[k]];
    for (int i = 0; i < g->n; i++)
      if (!isfinite(w->core.a[g->unknowns[i]])) return 0;
  }
  return 1;
}

/* Values of the conditions that follow from the solution; whether all are numbers. */
static int sense(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                 const double *v, const double *d) {
  frot_inputs(s, w, &t, q, v, d);
  w->call.arg[7] = w->core.a, w->call.arg[8] = frot_lam_of_text(m, w);
  double *values = w->core.condition + m->n_located - m->n_sensed;
  w->call.res[0] = values;
  frot_call(w, &m->sensed);
  return frot_all_finite(values, m->n_sensed);
}

int frot_late_rates(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, const double *d) {
  if (!m->late_rates) return FROT_OK;
  frot_inputs(s, w, &t, q, v, d);
  w->call.arg[7] = w->core.a, w->call.arg[8] = frot_lam_of_text(m, w);
  w->call.res[0] = w->core.qd, w->call.res[1] = w->core.power;
  frot_call(w, &m->rates);
  return frot_all_finite(w->core.qd, m->nq) && frot_all_finite(w->core.power, 1) ? FROT_OK
                                                                                 : FROT_NAN;
}

int frot_solution(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, const frot_contact_mode *modes,
                  const double *frozen, const double *along, int late) {
  late |= m->late_rates || m->n_sensed > 0;
  int status = frot_dynamics(m, s, w, t, q, v, d, modes, late ? FROT_READING : FROT_MOTION);
  if (status != FROT_OK) return status;
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_elements && along; k++) {
    int at = FROT_BOUNDING * now->elements[k];
    memcpy(w->reactions.along + at, along + at, FROT_BOUNDING * sizeof(double));
  }
  if (frot_reactions(m, w, modes, NULL)) return FROT_DIVERGE;
  w->reactions.warm = 1;
  frot_accelerations(m, w, frozen);
  if (!groups_finite(m, w)) return FROT_NAN;
  frot_rest_in_rounding(m, s, w, t, q, v, d);
  if (late) {
    status = frot_solve_late(m, s, w, t, q, v, d);
    if (status != FROT_OK) return status;
  }
  if (m->n_sensed > 0 && !sense(m, s, w, t, q, v, d)) return FROT_NAN;
  return frot_late_rates(m, s, w, t, q, v, d);
}

int frot_derivatives(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
                     const double *d, const frot_contact_mode *modes, const double *frozen,
                     double *slope) {
  const frot_awake_lists *now = w->awake.now;
  const double *v = z + m->nq;
  const double *along = w->reactions.follow ? NULL : s->data + w->layout.along;
  int status = frot_solution(m, s, w, t, z, v, d, modes, frozen, along, 0);
  if (status != FROT_OK) return status;
  int states = now->n - FROT_QUADRATURES, k = 0;
  for (; k < states && now->states[k] < m->nq; k++) slope[k] = w->core.qd[now->states[k]];
  for (; k < states; k++) slope[k] = w->core.a[now->states[k] - m->nq];
  double dissipated = 0;
  for (int i = 0; i < now->n_elements; i++) {
    int e = now->elements[i];
    const frot_element *element = &m->elements[e];
    if (modes[element->contact].closed && frot_element_mode(m, modes, e)->friction > FROT_STICK)
      dissipated -= w->core.lam[element->row] * w->core.rate[element->row];
  }
  slope[states] = dissipated;
  slope[states + 1] = w->core.power[0];
  frot_guards(m, s, w, z, v, d, modes, slope + now->n, NULL);
  return FROT_OK;
}

int frot_slope(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
               double *slope) {
  const frot_layout *l = &w->layout;
  const frot_contact_mode *modes = (const void *)(s->data + l->modes);
  return frot_derivatives(m, s, w, t, z, s->data + l->d, modes, s->data + l->frozen, slope);
}
