#include "model/segment.h"

#include <string.h>

#include "model/sleeping.h"

void frot_interpolate(const frot_model *m, const frot_segment *g, double t, double *x) {
  int nx = m->nq + m->nv + FROT_QUADRATURES;
  double theta = *g->h > 0 ? (t - *g->t0) / *g->h : 0, one = 1 - theta;
  for (int j = 0; j < nx; j++) {
    double sum = 0;
    for (int i = DP_DENSE - 1; i >= 0; i--) {
      sum += g->f[i * nx + j];
      sum *= i % 2 == 0 ? theta : one;
    }
    x[j] = g->x0[j] + sum;
  }
}

void frot_guess_unknowns(const frot_model *m, frot_work *w, const frot_segment *g, double t) {
  double theta = *g->h > 0 ? (t - *g->t0) / *g->h : 0;
  for (int k = 0; k < m->ny; k++) w->blocks.y[k] = g->y0[k] + theta * (g->y1[k] - g->y0[k]);
}

static void copy_state(const frot_model *m, frot_state *s, const frot_layout *l,
                       const frot_segment *g) {
  memcpy(g->modes, s->data + l->modes, sizeof *g->modes * (size_t)(m->n_contacts + m->n_elements));
  memcpy(g->along, s->data + l->along, sizeof(double) * 2 * (size_t)m->n_elements);
  memcpy(g->friction, s->data + l->friction, sizeof(double) * (size_t)m->n_elements);
  memcpy(g->d, s->data + l->d, sizeof(double) * (size_t)l->nd);
  memcpy(g->frozen, s->data + l->frozen, sizeof(double) * (size_t)m->nv);
  memcpy(g->sizes, s->data + l->scale_x, sizeof(double) * (size_t)(g->x0 - g->sizes));
}

void frot_make_instant(const frot_model *m, frot_state *s, frot_work *w, double t,
                       const double *x) {
  frot_layout l = frot_layout_of(m);
  frot_segment g = frot_segment_at(m, s->data + l.segment);
  frot_wake_all_islands(m, s, w);
  s->last_ratio = s->failed_h = 0, s->noise_shown = 0, s->noise_level = 1;
  *g.t0 = *g.t1 = t;
  *g.h = 0;
  copy_state(m, s, &l, &g);
  memset(g.spare, 0, sizeof(double) * (size_t)m->n_rows);
  memcpy(s->data + l.y, w->blocks.y, sizeof(double) * (size_t)m->ny);
  memcpy(g.y0, w->blocks.y, sizeof(double) * (size_t)m->ny);
  memcpy(g.y1, w->blocks.y, sizeof(double) * (size_t)m->ny);
  memcpy(g.x0, x, sizeof(double) * (size_t)l.nx);
  memset(g.f, 0, sizeof(double) * DP_DENSE * (size_t)l.nx);
  memmove(s->data + l.x, x, sizeof(double) * (size_t)l.nx);
  s->has_slope = 0;
}

void frot_keep_step(const frot_model *m, frot_state *s, const frot_work *w, double t, double h,
                    double end) {
  frot_segment g = frot_segment_at(m, s->data + w->layout.segment);
  *g.t0 = t, *g.t1 = end, *g.h = h;
  const double *spare = s->data + w->layout.spare;
  if (s->asleep == 0 || s->naps != s->kept_naps) { /* what wakes changes modes */
    copy_state(m, s, &w->layout, &g);
    memcpy(g.spare, spare, sizeof(double) * (size_t)m->n_rows);
    if (s->asleep > 0) {
      memcpy(g.x0, s->data + w->layout.x, sizeof(double) * (size_t)w->layout.nx);
      memset(g.f, 0, sizeof(double) * DP_DENSE * (size_t)w->layout.nx);
    }
    s->kept_naps = s->naps;
  }
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_groups; k++) {
    const frot_group *group = &m->groups[now->groups[k]];
    for (int i = 0; i < group->n_rows; i++) g.spare[group->rows[i]] = spare[group->rows[i]];
  }
  for (int i = 0; i < now->n_elements; i++) {
    int e = now->elements[i];
    memcpy(g.along + FROT_BOUNDING * e, s->data + w->layout.along + FROT_BOUNDING * e,
           FROT_BOUNDING * sizeof(double));
    g.heading[e] = s->data[w->layout.heading + e];
    g.friction[e] = s->data[w->layout.friction + e];
  }
  memcpy(g.y0, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
  memcpy(g.y1, w->step.y_end, sizeof(double) * (size_t)m->ny);
  frot_copy_awake(w, w->step.z0, g.x0);
  frot_keep_dense(w, &g);
}

void frot_keep_dense(const frot_work *w, const frot_segment *g) {
  for (int i = 0; i < DP_DENSE; i++)
    frot_unpack_awake(w, w->step.f + i * w->layout.nz, g->f + i * w->layout.nx);
}
