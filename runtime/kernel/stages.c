#include "stages.h"

#include <string.h>

#include "implicit.h"
#include "mechanics.h"

void frot_weigh_stages(const frot_work *w, const double *coefficient, int count, int from, int size,
                       double sum[FROT_CHUNK]) {
  const double *slopes = w->step.k + from;
  int nz = w->layout.nz;
  if (size == FROT_CHUNK) {
    double a = 0, b = 0, c = 0, d = 0;
    for (int k = 0; k < count; k++, slopes += nz) {
      const double factor = coefficient[k];
      a += factor * slopes[0], b += factor * slopes[1];
      c += factor * slopes[2], d += factor * slopes[3];
    }
    sum[0] = a, sum[1] = b, sum[2] = c, sum[3] = d;
    return;
  }
  for (int j = 0; j < size; j++) {
    double total = 0;
    for (int k = 0; k < count; k++) total += coefficient[k] * slopes[k * nz + j];
    sum[j] = total;
  }
}

/* z <- base + h * (sum of coefficient[k] times stage k < count); base may be NULL. */
static void combine(const frot_work *w, const double *coefficient, int count, double h,
                    const double *base, double *z) {
  int end = frot_width(w);
  for (int from = 0; from < end; from += FROT_CHUNK) {
    double sum[FROT_CHUNK];
    int size = end - from < FROT_CHUNK ? end - from : FROT_CHUNK;
    frot_weigh_stages(w, coefficient, count, from, size, sum);
    for (int j = 0; j < size; j++) z[from + j] = (base ? base[from + j] : 0) + h * sum[j];
  }
}

int frot_run_stages(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  if (s->implicit) return frot_implicit_stages(m, s, w, t, h);
  memcpy(w->blocks.y, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
  for (int i = 1; i <= DP_STAGES; i++) {
    double *z = i == DP_STAGES ? w->step.z1 : w->step.z;
    combine(w, dp_a[i], i, h, w->step.z0, z);
    int status = frot_slope(m, s, w, i == DP_STAGES ? t + h : t + dp_c[i] * h, z, frot_stage(w, i));
    if (status != FROT_OK) {
      memmove(w->step.z1, z, sizeof(double) * (size_t)w->layout.nx); /* where it happened */
      return status;
    }
  }
  memcpy(w->step.y_end, w->blocks.y, sizeof(double) * (size_t)m->ny);
  return FROT_OK;
}

int frot_make_dense(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  if (s->implicit) return frot_implicit_dense(m, s, w, t, h);
  int nz = w->layout.nz;
  memcpy(w->blocks.y, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
  for (int i = DP_STAGES + 1; i < DP_ALL; i++) {
    combine(w, dp_a[i], i, h, w->step.z0, w->step.z);
    int status = frot_slope(m, s, w, t + dp_c[i] * h, w->step.z, frot_stage(w, i));
    if (status != FROT_OK) return status;
  }
  const double *start = frot_stage(w, 0), *end = frot_stage(w, DP_STAGES);
  for (int j = 0; j < frot_width(w); j++) {
    double step = w->step.z1[j] - w->step.z0[j];
    w->step.f[j] = step;
    w->step.f[nz + j] = h * start[j] - step;
    w->step.f[2 * nz + j] = 2 * step - h * (end[j] + start[j]);
  }
  for (int i = 0; i < 4; i++) combine(w, dp_d[i], DP_ALL, h, NULL, w->step.f + (3 + i) * nz);
  return FROT_OK;
}
