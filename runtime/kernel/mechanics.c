#include "mechanics.h"

#include <math.h>
#include <string.h>

#include "blocks.h"

#define VANISHED 1e-9 /* part of its largest size below which a reaction has no direction */

/* Guards of one bounded relative motion: of friction (bound mu_s N) or of rolling (bound delta N).
 */
static void bounded(int mode, double rate, double rate_scale, double lam, double bound,
                    double *guard, double *scale) {
  if (mode == FROT_STICK) {
    guard[0] = bound - lam, guard[1] = bound + lam;
    scale[0] = scale[1] = fabs(bound) + fabs(lam);
  } else if (mode != FROT_NONE) {
    guard[0] = mode == FROT_SLIP_FORWARD ? rate : -rate;
    scale[0] = rate_scale;
  }
}

/* Guards of the friction (rolling = 0) or of the rolling resistance (1) of contact i. */
static void bounded_motion(const frot_model *m, const frot_work *w, const double *v, int i,
                           const frot_contact_mode *mode, int rolling, double *g, double *size) {
  const frot_contact *contact = &m->contacts[i];
  int row = rolling ? contact->row_r : contact->row_t;
  int kind = rolling ? mode->rolling : mode->friction;
  if (kind == FROT_NONE) return;
  if (kind == FROT_STICK && frot_is_prescribed(m, w, row)) {
    /* rest lasts as long as the prescribed motion rests */
    g[0] = FROT_PRESCRIBED_REST - fabs(w->c[row]);
    size[0] = FROT_PRESCRIBED_REST;
    return;
  }
  bounded(kind, w->rate[row], frot_row_size(m, w, row, v), w->lam[row],
          frot_bound_of_rest(m, w, i, mode, rolling), g, size);
}

void frot_turn_references(const frot_model *m, frot_state *s, const frot_work *w) {
  for (int i = 0; i < m->n_contacts && w->pins > 0; i++) {
    const frot_contact *contact = &m->contacts[i];
    if (contact->bound != FROT_BY_PIN) continue;
    double *along = s->data + w->layout.along + 2 * i;
    double first = w->lam[contact->row_n], second = w->lam[contact->row_n2];
    double size = hypot(first, second), largest = s->data[w->layout.scale_g + FROT_GUARDS * i];
    if (size > VANISHED * largest)
      along[0] = first / size, along[1] = second / size;
    else
      along[0] = -along[0], along[1] = -along[1]; /* it passes through zero */
  }
}

void frot_guards(const frot_model *m, const frot_state *s, frot_work *w, const double *q,
                 const double *v, const double *d, const frot_contact_mode *modes, double *guard,
                 double *scale) {
  const double *unilateral = s->data + w->layout.unilateral;
  for (int i = 0; i < m->n_contacts; i++) {
    const frot_contact *contact = &m->contacts[i];
    const frot_contact_mode *mode = &modes[i];
    double g[FROT_GUARDS] = {1, 1, 1, 1, 1}, size[FROT_GUARDS] = {1, 1, 1, 1, 1};
    if (!mode->closed) {
      g[0] = w->gap[i];
      size[0] = fabs(w->gap[i]) + frot_gap_size(m, w, contact->row_n, q);
    } else {
      int bounds = mode->friction != FROT_NONE || mode->rolling != FROT_NONE;
      if (frot_has_normal(contact) && (unilateral[i] != 0 || bounds)) {
        g[0] = mode->side * w->lam[contact->row_n];
        size[0] = fabs(w->lam[contact->row_n]);
      }
      if (contact->bound == FROT_BY_PIN && mode->friction > FROT_STICK) {
        const double *along = s->data + w->layout.along + 2 * i;
        double first = w->lam[contact->row_n], second = w->lam[contact->row_n2];
        g[0] = along[0] * first + along[1] * second;
        size[0] = fabs(first) + fabs(second);
      }
      bounded_motion(m, w, v, i, mode, 0, g + 1, size + 1);
      bounded_motion(m, w, v, i, mode, 1, g + 3, size + 3);
    }
    memcpy(guard + FROT_GUARDS * i, g, sizeof g);
    if (scale) memcpy(scale + FROT_GUARDS * i, size, sizeof size);
  }
  for (int j = 0; j < m->n_located; j++) {
    int at = FROT_GUARDS * m->n_contacts + j;
    guard[at] = d[j] != 0 ? w->condition[j] : -w->condition[j];
    if (scale) scale[at] = fabs(guard[at]);
  }
}

int frot_solution(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, const frot_contact_mode *modes,
                  const double *frozen, int late) {
  int status = frot_dynamics(m, s, w, t, q, v, d, modes);
  if (status != FROT_OK) return status;
  if (frot_reactions(m, w, modes, NULL)) return FROT_DIVERGE;
  frot_accelerations(m, w, frozen);
  if (!frot_all_finite(w->a, m->nv + m->na + m->nc)) return FROT_NAN;
  if (late || m->late_rates) {
    status = frot_solve_late(m, s, w, t, q, v, d);
    if (status != FROT_OK) return status;
  }
  if (!m->late_rates) return FROT_OK;
  frot_inputs(m, s, w, &t, q, v, d);
  w->arg[7] = w->a, w->arg[8] = w->lam;
  w->res[0] = w->qd, w->res[1] = w->power;
  m->rates.call(w->arg, w->res, w->iw, w->w, 0);
  return frot_all_finite(w->qd, m->nq) && frot_all_finite(w->power, 1) ? FROT_OK : FROT_NAN;
}

int frot_derivatives(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
                     const double *d, const frot_contact_mode *modes, const double *frozen,
                     double *slope) {
  int nx = m->nq + m->nv + FROT_QUADRATURES;
  const double *v = z + m->nq;
  int status = frot_solution(m, s, w, t, z, v, d, modes, frozen, 0);
  if (status != FROT_OK) return status;
  memcpy(slope, w->qd, sizeof(double) * (size_t)m->nq);
  memcpy(slope + m->nq, w->a, sizeof(double) * (size_t)m->nv);
  double dissipated = 0;
  for (int i = 0; i < m->n_contacts; i++) {
    const frot_contact *contact = &m->contacts[i];
    if (!modes[i].closed) continue;
    if (modes[i].friction > FROT_STICK)
      dissipated -= w->lam[contact->row_t] * w->rate[contact->row_t];
    if (modes[i].rolling > FROT_STICK)
      dissipated -= w->lam[contact->row_r] * w->rate[contact->row_r];
  }
  slope[m->nq + m->nv] = dissipated;
  slope[m->nq + m->nv + 1] = w->power[0];
  frot_guards(m, s, w, z, v, d, modes, slope + nx, NULL);
  return FROT_OK;
}
