#include "methods/dormand_prince.h"

#include <string.h>

#include "model/sleeping.h"
#include "singular/singular_posture.h"
#include "methods/rodas.h"
#include "methods/right_hand_side.h"
#include "reactions/friction_predictor.h"
#include "constraints/projection.h"
#include "model/segment.h"
#include "constraints/redundant_rows.h"

#define TAKE(field, count) FROT_TAKE(a, field, count)

/* z <- z0 + h * (sum of coefficient[k] times stage k < count), for the awake states. */
static void move(const frot_work *w, const double *coefficient, int count, double h, double *z) {
  const int *states = w->awake.now->states;
  int end = w->awake.n;
  for (int from = 0; from < end; from += FROT_CHUNK) {
    double sum[FROT_CHUNK];
    int size = end - from < FROT_CHUNK ? end - from : FROT_CHUNK;
    frot_weigh_stages(w, coefficient, count, from, size, sum);
    for (int j = 0; j < size; j++) {
      int at = states[from + j];
      z[at] = w->step.z0[at] + h * sum[j];
    }
  }
}

/* f <- h * (sum of coefficient[k] times stage k < count), packed, from the value `from` on. */
static void weigh(const frot_work *w, const double *coefficient, int count, double h, int from,
                  double *f) {
  int end = frot_width(w);
  for (; from < end; from += FROT_CHUNK) {
    double sum[FROT_CHUNK];
    int size = end - from < FROT_CHUNK ? end - from : FROT_CHUNK;
    frot_weigh_stages(w, coefficient, count, from, size, sum);
    for (int j = 0; j < size; j++) f[from + j] = h * sum[j];
  }
}

int frot_has_jammed(const frot_state *s, frot_work *w) {
  for (int i = 0; i < w->awake.now->n_groups; i++) {
    int k = w->awake.now->groups[i];
    if (w->reactions.sign[k] * s->data[w->layout.sign + k] < 0) return w->reactions.jammed = k, 1;
  }
  return 0;
}

/* Stage i at the values z, which are put onto the relations first where that matters. */
static int evaluate(const frot_model *m, frot_state *s, frot_work *w, double t, double *z, int i) {
  int moved;
  if (s->tied > 0 && !(i <= DP_STAGES && w->step.near[i])) {
    const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
    int status =
        frot_project(m, s, w, t, z, z + m->nq, s->data + w->layout.d, modes, NULL, NULL, &moved);
    if (status != FROT_OK) return status;
  }
  int status = frot_slope(m, s, w, t, z, frot_stage(w, i));
  return status == FROT_OK && frot_has_jammed(s, w) ? FROT_DIVERGE : status;
}

/* Stages 1 .. DP_STAGES, and the last that could be evaluated. */
static int run_once(const frot_model *m, frot_state *s, frot_work *w, double t, double h, int loops,
                    int *reached) {
  int before = *reached;
  memcpy(w->blocks.y, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
  memset(w->step.doubt, 0, sizeof(double) * (size_t)frot_width(w));
  if (loops && w->step.near[0]) frot_interpolate_stage(m, w, 0, before);
  for (int i = 1; i <= DP_STAGES; i++) {
    double *z = i == DP_STAGES ? w->step.z1 : w->step.z;
    move(w, dp_a[i], i, h, z);
    int status = evaluate(m, s, w, i == DP_STAGES ? t + h : t + dp_c[i] * h, z, i);
    if (loops) frot_note_rows(m, s, w, i);
    *reached = i;
    if (loops && w->step.near[i])
      frot_interpolate_stage(m, w, i, before > i ? before : i);
    else if (status != FROT_OK) {
      for (int k = 0; k < w->awake.n; k++) { /* where it happened */
        int at = w->awake.now->states[k];
        w->step.z1[at] = z[at];
      }
      return status;
    }
  }
  memcpy(w->step.y_end, w->blocks.y, sizeof(double) * (size_t)m->ny);
  return FROT_OK;
}

/* Evaluations follow each other from the instant t on: where to begin to look for the directions of
 * pins' reactions, and the friction there. */
static void follow_from(frot_work *w, double t, const double *along, const double *heading,
                        const double *friction) {
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_elements; k++) {
    int at = FROT_BOUNDING * now->elements[k];
    memcpy(w->reactions.along + at, along + at, FROT_BOUNDING * sizeof(double));
    w->reactions.heading[now->elements[k]] = heading[now->elements[k]];
  }
  w->reactions.follow = 1, w->reactions.warm = 0;
  frot_begin_friction_history(w, t, friction);
}

int frot_run_stages(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  w->reactions.jammed = -1;
  if (s->implicit) return frot_implicit_stages(m, s, w, t, h);
  int loops = frot_has_loops(m, s, w), reached = 0, status;
  memset(w->step.near, 0, DP_STAGES + 1);
  follow_from(w, t, s->data + w->layout.along, s->data + w->layout.heading,
              s->data + w->layout.friction);
  memcpy(frot_stage(w, 0), w->step.first, sizeof(double) * (size_t)frot_width(w));
  for (int pass = 0;; pass++) {
    int measured = s->measured;
    w->step.little = 0;
    status = run_once(m, s, w, t, h, loops, &reached);
    if (!loops || !frot_find_singular_postures(m, s, w, t, h, reached, pass)) return status;
    if (s->measured != measured) pass = -1;
    memcpy(frot_stage(w, 0), w->step.first, sizeof(double) * (size_t)frot_width(w));
  }
}

void frot_make_cubic(const frot_work *w, double h) {
  const double *start = frot_stage(w, 0), *end = frot_stage(w, DP_STAGES);
  int nz = w->layout.nz;
  weigh(w, dp_a[DP_STAGES], DP_STAGES, h, w->awake.n, w->step.f); /* integrals of the guards */
  for (int j = 0; j < w->awake.n; j++) {
    int at = w->awake.now->states[j];
    w->step.f[j] = w->step.z1[at] - w->step.z0[at];
  }
  for (int j = 0; j < frot_width(w); j++) {
    double step = w->step.f[j];
    w->step.f[nz + j] = h * start[j] - step;
    w->step.f[2 * nz + j] = 2 * step - h * (end[j] + start[j]);
  }
  for (int i = 3; i < DP_DENSE; i++)
    memset(w->step.f + i * nz, 0, sizeof(double) * (size_t)frot_width(w));
}

/* All vectors, with the last stages. */
static void make_vectors(const frot_work *w, double h) {
  frot_make_cubic(w, h);
  for (int i = 0; i < 4; i++) weigh(w, dp_d[i], DP_ALL, h, 0, w->step.f + (3 + i) * w->layout.nz);
}

int frot_make_dense(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  if (s->implicit) return frot_implicit_dense(m, s, w, t, h);
  memcpy(w->blocks.y, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
  for (int i = DP_STAGES + 1; i < DP_ALL; i++) {
    move(w, dp_a[i], i, h, w->step.z);
    int status = evaluate(m, s, w, t + dp_c[i] * h, w->step.z, i);
    if (status != FROT_OK) return status;
  }
  make_vectors(w, h);
  return FROT_OK;
}

int frot_needs_inside(const frot_model *m, const frot_state *s) {
  return s->implicit || s->tied > 0 || s->weak || m->ny > 0;
}

/* The slopes of the last stages, in the modes of the segment. */
static int run_last(const frot_model *m, frot_state *s, frot_work *w, const frot_segment *g) {
  double *z = w->step.z;
  for (int i = DP_STAGES + 1; i < DP_ALL; i++) {
    double t = *g->t0 + dp_c[i] * *g->h;
    move(w, dp_a[i], i, *g->h, z);
    int status = frot_derivatives(m, s, w, t, z, g->d, g->modes, g->frozen, frot_stage(w, i));
    if (status != FROT_OK) return status;
  }
  return FROT_OK;
}

void frot_complete_dense_output(const frot_model *m, frot_state *s, frot_work *w,
                                const frot_segment *g) {
  int implicit = s->implicit, guards = w->guards.count;
  long long evaluations = s->statistics.evaluations;
  s->implicit = w->guards.count = 0;
  follow_from(w, *g->t0, g->along, g->heading, g->friction);
  frot_use_redundant_rows(m, w, g->spare);
  frot_make_cubic(w, *g->h);
  if (run_last(m, s, w, g) == FROT_OK) make_vectors(w, *g->h);
  frot_keep_dense(w, g);
  frot_forget_redundant_rows(w);
  w->reactions.follow = 0;
  s->implicit = implicit, w->guards.count = guards, s->statistics.evaluations = evaluations;
}

void frot_bind_step(const frot_model *m, const frot_layout *l, frot_step_work *w, frot_arena *a) {
  TAKE(w->k, DP_ALL * l->nz), TAKE(w->f, DP_DENSE * l->nz), TAKE(w->first, l->nz);
  TAKE(w->z0, l->nz), TAKE(w->z1, l->nz), TAKE(w->z, l->nz), TAKE(w->y_end, m->ny);
  TAKE(w->doubt, l->nz), TAKE(w->excused, 2 * m->nv), TAKE(w->beyond, m->nv);
  TAKE(w->parameters, m->np);
}
