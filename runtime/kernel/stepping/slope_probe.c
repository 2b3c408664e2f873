#include "stepping/slope_probe.h"

#include <math.h>
#include <string.h>

#include "methods/right_hand_side.h"

#define PROBES 3
/* Part by which slopes may change, in units of the largest of their dimension. */
#define CHANGE 0.1
/* A probe that meets no number has gone too far. */
#define BACK 1e-3

/* Largest change of a slope, in units of the largest slope of its dimension at the start. */
static double change_of_slopes(const frot_model *m, frot_work *w, const double *from,
                               const double *to) {
  double *largest = w->sizes.alike, change = 0;
  memset(largest, 0, sizeof(double) * (size_t)m->nq);
  for (int j = 0; j < m->nq; j++)
    largest[m->q_alike[j]] = fmax(largest[m->q_alike[j]], fabs(from[j]));
  for (int j = 0; j < m->nq; j++) {
    double size = largest[m->q_alike[j]];
    if (size > 0) change = fmax(change, fabs(to[j] - from[j]) / size);
  }
  return change;
}

double frot_probe_slopes(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  frot_layout l = frot_layout_of(m);
  if (m->nv > 0 || m->nq == 0) return h;
  const double *start = w->step.k;
  double *there = w->step.k + l.nz;
  memcpy(w->step.z, w->step.z0, sizeof(double) * (size_t)l.nz);
  for (int probe = 0; probe < PROBES; probe++) {
    for (int j = 0; j < m->nq; j++) w->step.z[j] = w->step.z0[j] + h * start[j];
    memcpy(w->blocks.y, s->data + l.y, sizeof(double) * (size_t)m->ny);
    int status = frot_slope(m, s, w, t + h, w->step.z, there);
    double change = status == FROT_OK ? change_of_slopes(m, w, start, there) : INFINITY;
    if (change <= CHANGE) break;
    h *= fmax(CHANGE / change, BACK);
  }
  return h;
}
