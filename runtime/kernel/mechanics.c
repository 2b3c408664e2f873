#include "mechanics.h"

#include <math.h>
#include <string.h>

#include "blocks.h"
#include "core.h"
#include "guards.h"
#include "reactions.h"

int frot_solution(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, const frot_contact_mode *modes,
                  const double *frozen, const double *along, int late) {
  int status =
      frot_dynamics(m, s, w, t, q, v, d, modes, late || m->late_rates ? FROT_READING : FROT_MOTION);
  if (status != FROT_OK) return status;
  memcpy(w->reactions.along, along, sizeof(double) * 2 * (size_t)m->n_elements);
  if (frot_reactions(m, w, modes, NULL)) return FROT_DIVERGE;
  frot_accelerations(m, w, frozen);
  if (!frot_all_finite(w->core.a, m->nv + m->na + m->nc)) return FROT_NAN;
  if (late || m->late_rates) {
    status = frot_solve_late(m, s, w, t, q, v, d);
    if (status != FROT_OK) return status;
  }
  if (!m->late_rates) return FROT_OK;
  frot_inputs(m, s, w, &t, q, v, d);
  w->call.arg[7] = w->core.a, w->call.arg[8] = w->core.lam;
  w->call.res[0] = w->core.qd, w->call.res[1] = w->core.power;
  frot_call(w, &m->rates);
  return frot_all_finite(w->core.qd, m->nq) && frot_all_finite(w->core.power, 1) ? FROT_OK
                                                                                 : FROT_NAN;
}

int frot_derivatives(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
                     const double *d, const frot_contact_mode *modes, const double *frozen,
                     double *slope) {
  int nx = m->nq + m->nv + FROT_QUADRATURES;
  const double *v = z + m->nq;
  int status = frot_solution(m, s, w, t, z, v, d, modes, frozen, s->data + w->layout.along, 0);
  if (status != FROT_OK) return status;
  memcpy(slope, w->core.qd, sizeof(double) * (size_t)m->nq);
  memcpy(slope + m->nq, w->core.a, sizeof(double) * (size_t)m->nv);
  double dissipated = 0;
  for (int e = 0; e < m->n_elements; e++) {
    const frot_element *element = &m->elements[e];
    if (modes[element->contact].closed && frot_element_mode(m, modes, e)->friction > FROT_STICK)
      dissipated -= w->core.lam[element->row] * w->core.rate[element->row];
  }
  slope[m->nq + m->nv] = dissipated;
  slope[m->nq + m->nv + 1] = w->core.power[0];
  frot_guards(m, s, w, z, v, d, modes, slope + nx, NULL);
  return FROT_OK;
}

int frot_slope(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
               double *slope) {
  const frot_layout *l = &w->layout;
  const frot_contact_mode *modes = (const void *)(s->data + l->modes);
  return frot_derivatives(m, s, w, t, z, s->data + l->d, modes, s->data + l->frozen, slope);
}
