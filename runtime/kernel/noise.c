/* What rounding does to derivatives: see error.h. */
#include <math.h>
#include <string.h>

#include "core.h"
#include "error.h"
#include "groups.h"
#include "mechanics.h"
#include "stages.h"
#include "tolerances.h"

/* Accelerations that are nothing but rounding of their terms, at the place z, in all stages of the
 * step: what they bring is noise, however small the values moved (a value that is zero shows none
 * by being moved). */
static void add_rounding(const frot_model *m, frot_state *s, frot_work *w, double t,
                         const double *z, const double *largest) {
  double *noise = s->data + w->layout.noise, *size = w->relations.residual;
  if (frot_slope(m, s, w, t, z, frot_stage(w, 1)) != FROT_OK) return;
  frot_acceleration_sizes(m, s, w, t, z, z + m->nq, s->data + w->layout.d, size);
  for (int j = 0; j < w->awake.n - FROT_QUADRATURES; j++) {
    int state = w->awake.now->states[j];
    if (state < m->nq) continue;
    double rounding = FROT_ROUNDING * size[state - m->nq];
    if (largest[j] <= FROT_NOISE_MARGIN * rounding) noise[state] = fmax(noise[state], rounding);
  }
}

static int slope_from_start(const frot_model *m, frot_state *s, frot_work *w, double t,
                            const double *z, double *slope) {
  memcpy(w->blocks.y, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
  return frot_slope(m, s, w, t, z, slope);
}

double frot_guard_noise(const frot_model *m, const frot_state *s, const frot_work *w, int j,
                        double h) {
  const double *noise = s->data + w->layout.noise;
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  double own = noise[m->nq + m->nv + j];
  int e = (j - m->n_contacts) / 2;
  if (j < m->n_contacts || j >= frot_condition_guard(m) || j != frot_element_guard(m, e))
    return own;
  if (frot_element_mode(m, modes, e)->friction <= FROT_STICK) return own;
  return own + h * frot_row_size(m, w, m->elements[e].row, noise + m->nq);
}

void frot_measure_noise(const frot_model *m, frot_state *s, frot_work *w, double t) {
  double *base = frot_stage(w, 1), *forth = frot_stage(w, 2), *back = frot_stage(w, 3);
  double *noise = s->data + w->layout.noise, *largest = w->step.f;
  double *guards = noise + m->nq + m->nv;
  const int *states = w->awake.now->states;
  int n = m->nq + m->nv, packed = w->awake.n, moving = packed - FROT_QUADRATURES;
  for (int j = 0; j < moving; j++) {
    largest[j] = 0;
    /* of an implicit step only the slopes at its ends are there */
    for (int i = 0; i <= DP_STAGES; i += s->implicit ? DP_STAGES : 1)
      largest[j] = fmax(largest[j], fabs(frot_stage(w, i)[j]));
  }
  if (slope_from_start(m, s, w, t, w->step.z0, base) != FROT_OK) return;
  memset(noise, 0, sizeof(double) * (size_t)(n + w->layout.ng));
  for (int pattern = 0; pattern < 2; pattern++) {
    for (int side = 0; side < 2; side++) {
      double moved = (side ? -1 : 1) * FROT_APART, *there = side ? back : forth;
      memcpy(w->step.z, w->step.z0, sizeof(double) * (size_t)w->layout.nx);
      for (int j = 0; j < n; j++) w->step.z[j] *= 1 + (((j >> pattern) & 1) != 0 ? moved : -moved);
      if (slope_from_start(m, s, w, t * (1 + moved), w->step.z, there) != FROT_OK) return;
    }
    for (int j = 0; j < frot_width(w); j++) {
      if (j >= moving && j < packed) continue; /* energies follow */
      double *own = j < packed ? noise + states[j] : guards + w->guards.list[j - packed];
      double sensitivity = 0.5 * fabs(forth[j] - back[j]) * (FROT_NUDGE / FROT_APART);
      double rounding = 0.5 * fabs(forth[j] - 2 * base[j] + back[j]);
      *own = fmax(*own, sensitivity + rounding);
    }
  }
  add_rounding(m, s, w, t, w->step.z0, largest);
  add_rounding(m, s, w, t, w->step.z1, largest); /* where the terms no longer vanish by symmetry */
  /* a position can be no better than its speed */
  for (int j = 0; j < m->nq; j++) {
    if (m->q_speed[j] < 0) continue;
    int speed = m->nq + m->q_speed[j];
    noise[j] =
        fmax(noise[j], fmax(FROT_NUDGE * fabs(w->step.z0[speed]), fabs(s->h) * noise[speed]));
  }
}
