#include "constraints/projection.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "constraints/invariants.h"
#include "numerics/dense.h"
#include "evaluation/row_order.h"
#include "numerics/basis.h"
#include "constraints/redundant_rows.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"
#include "evaluation/quaternions.h"

#define TAKE(field, count) FROT_TAKE(a, field, count)

#define PASSES 4 /* of Newton's method: it starts next to the solution */
/* Rows from which on it costs more to make them orthonormal than another pass, and what a pass must
 * leave of what was missed at most where it is made with those of the last. */
#define MANY 10
#define FASTER 0.02
/* Part of a row that sticks which the rows before it must leave: what would be moved far by keeping
 * it slips as little as it can. */
#define FREE 0.1

static int is_kept(const frot_model *m, const frot_contact_mode *modes, int contact) {
  const frot_contact *c = &m->contacts[contact];
  return modes[contact].closed && c->row_n >= 0 && !c->reduced;
}

static int keeps_place(const frot_model *m, const frot_contact_mode *modes, int contact) {
  return is_kept(m, modes, contact) && !m->contacts[contact].kinematic;
}

static int is_stuck(const frot_model *m, const frot_contact_mode *modes, const unsigned char *stuck,
                    int element) {
  if (!modes[m->elements[element].contact].closed) return 0;
  return frot_element_mode(m, modes, element)->friction == FROT_STICK || (stuck && stuck[element]);
}

int frot_rows_of_group(const frot_model *m, const frot_group *g, const frot_contact_mode *modes,
                       const unsigned char *stuck, int normals_only, int *rows) {
  int n = 0;
  for (int i = 0; i < g->n_contacts; i++) {
    int c = g->contacts[i];
    if (normals_only ? keeps_place(m, modes, c) : is_kept(m, modes, c))
      rows[n++] = m->contacts[c].row_n;
  }
  for (int i = 0; i < g->n_elements && !normals_only; i++)
    if (is_stuck(m, modes, stuck, g->elements[i])) rows[n++] = m->elements[g->elements[i]].row;
  return n;
}

int frot_holding_rows(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                      const unsigned char *stuck, int normals_only) {
  int n = 0;
  for (int k = 0; k < w->awake.now->n_groups; k++)
    n += frot_rows_of_group(m, &m->groups[w->awake.now->groups[k]], modes, stuck, normals_only,
                            w->relations.rows + n);
  return n;
}

/* What rounding makes of a gap: of what the coordinates do in it, and of the lengths that it is
 * made of, which cancel. */
static double rounding_of_gap(const frot_model *m, const frot_state *s, const frot_work *w,
                              int contact, const double *q) {
  double moved = frot_gap_size(m, w, m->contacts[contact].row_n, q);
  return FROT_ROUNDING * moved + DBL_EPSILON * s->data[w->layout.reach + contact];
}

/* What is missed over what rounding may miss. */
static double miss(double value, double bound) {
  return fabs(value) > bound ? (bound > 0 ? fabs(value) / bound : DBL_MAX) : 0;
}

/* What is known of the rows of the group that were made orthonormal last, `n` of them, in
 * w->span.basis: they serve as long as what is missed falls to a small part of what was before. */
typedef struct {
  const frot_group *group;
  int n, kept;
  double missed;
} frame;

/* Whether a row moves nothing that is not frozen: no more than can hold is asked of it. */
static int is_frozen(const frot_model *m, const frot_work *w, const frot_group *g, int row,
                     const double *frozen) {
  const double *entries = frot_entries(m, w->core.rows, row);
  for (int i = 0; i < g->n_speeds; i++)
    if (entries[i] != 0 && frozen[g->unknowns[i]] == 0) return 0;
  return 1;
}

void frot_orthonormal_rows(const frot_model *m, frot_work *w, const frot_group *g, int n, int kept,
                           const double *frozen) {
  int ns = g->n_speeds, rank = 0, *order = w->span.order;
  for (int i = 0; i < n; i++) order[i] = i;
  for (int at = 0, last = kept; at < n; at++) {
    int i = order[at], row = w->relations.rows[i];
    double *x = w->span.basis + ns * rank, *parts = w->linear.matrix + n * i;
    w->linear.pivot[i] = -1;
    if (frot_is_redundant(w, row)) continue;
    memcpy(x, frot_entries(m, w->core.rows, row), sizeof(double) * (size_t)ns);
    frot_inwards(w, g, x);
    double length = frot_length(x, ns);
    double rest = frot_reject(x, w->span.basis, rank, ns, parts);
    int certain = i < kept || (frozen && is_frozen(m, w, g, row, frozen));
    double least = certain ? frot_least_length(m, w, row, length) : FREE * length;
    if (!(rest > least)) continue;
    if (at < last - 1 && frot_row_is_deferred(m, w, row, rest, length)) {
      frot_defer_row(order, at--, --last);
      continue;
    }
    for (int k = 0; k < ns; k++) x[k] /= rest;
    parts[rank] = rest;
    w->linear.pivot[i] = rank++;
  }
}

/* w->relations.step (n_speeds) <- the least change of the group's speeds, in the metric, that takes
 * w->relations.residual from the n rows: L'^-1 Q R'^-1 residual. */
static void correction(frot_work *w, const frot_group *g, int n) {
  int ns = g->n_speeds;
  double *step = w->relations.step;
  memset(step, 0, sizeof(double) * (size_t)ns);
  for (int at = 0; at < n; at++) {
    int i = w->span.order[at], own = w->linear.pivot[i];
    if (own < 0) continue;
    const double *parts = w->linear.matrix + n * i, *x = w->span.basis + ns * own;
    double part = w->relations.residual[i];
    for (int k = 0; k < own; k++) part -= parts[k] * w->span.bias[k];
    const double along = w->span.bias[own] = part / parts[own];
    for (int k = 0; k < ns; k++) step[k] += along * x[k];
  }
  frot_outwards(w, g, step);
}

/* The correction of what the first `kept` of n rows of the group miss, `missed` times what is
 * rounding at most, while the others stay where they can. */
static void correct(const frot_model *m, frot_work *w, const frot_group *g, int n, int kept,
                    double missed, const double *frozen, frame *f) {
  int serves =
      f->group == g && f->n == n && f->kept == kept && n >= MANY && missed <= FASTER * f->missed;
  if (!serves) frot_orthonormal_rows(m, w, g, n, kept, frozen);
  *f = (frame){g, n, kept, missed};
  correction(w, g, n);
  for (int i = 0; i < g->n_speeds && frozen; i++)
    if (frozen[g->unknowns[i]] != 0) w->relations.step[i] = 0;
}

/* Coordinates onto the gaps that are closed. What sticks is not moved by that: it would creep, and
 * a corner that rests on another one would come off it. */
static int project_positions(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                             const double *v, const double *d, const frot_contact_mode *modes,
                             const double *frozen, frame *f, int *moved) {
  for (int pass = 0; pass < PASSES; pass++) {
    int status = frot_kinematics(m, s, w, t, q, v, d), any = 0;
    if (status != FROT_OK) return status;
    for (int k = 0; k < w->awake.now->n_groups; k++) {
      const frot_group *g = &m->groups[w->awake.now->groups[k]];
      int n = frot_rows_of_group(m, g, modes, NULL, 1, w->relations.rows), at = 0;
      double missed = 0;
      for (int i = 0; i < g->n_contacts; i++) {
        int c = g->contacts[i];
        if (!keeps_place(m, modes, c)) continue;
        double bound = rounding_of_gap(m, s, w, c, q);
        w->relations.residual[at++] = w->core.gap[c];
        missed = fmax(missed, miss(w->core.gap[c], bound));
      }
      if (!(missed > 1)) continue;
      for (int i = 0; i < g->n_elements; i++) {
        if (!is_stuck(m, modes, NULL, g->elements[i])) continue;
        w->relations.residual[at] = 0;
        w->relations.rows[at++] = m->elements[g->elements[i]].row;
      }
      correct(m, w, g, at, n, missed, frozen, f);
      frot_displace(m, g, q, w->relations.step, -1);
      any = *moved = 1;
    }
    if (!any) break;
  }
  return FROT_OK;
}

static int project_speeds(const frot_model *m, frot_state *s, frot_work *w, double t,
                          const double *q, double *v, const double *d,
                          const frot_contact_mode *modes, const unsigned char *stuck,
                          const double *frozen, frame *f, int *moved) {
  f->missed = INFINITY;
  for (int pass = 0; pass < PASSES; pass++) {
    int status = frot_kinematics(m, s, w, t, q, v, d), any = 0;
    if (status != FROT_OK) return status;
    for (int k = 0; k < w->awake.now->n_groups; k++) {
      const frot_group *g = &m->groups[w->awake.now->groups[k]];
      int n = frot_rows_of_group(m, g, modes, stuck, 0, w->relations.rows);
      double missed = 0;
      for (int i = 0; i < n; i++) {
        int row = w->relations.rows[i];
        w->relations.residual[i] = w->core.rate[row];
        double bound = 0.5 * FROT_ROUNDING * frot_row_size(m, w, row, v);
        missed = fmax(missed, miss(w->core.rate[row], bound));
      }
      if (!(missed > 1)) continue;
      correct(m, w, g, n, n, missed, frozen, f);
      for (int i = 0; i < g->n_speeds; i++) v[g->unknowns[i]] -= w->relations.step[i];
      any = *moved = 1;
    }
    if (!any) break;
  }
  return FROT_OK;
}

int frot_project(const frot_model *m, frot_state *s, frot_work *w, double t, double *q, double *v,
                 const double *d, const frot_contact_mode *modes, const unsigned char *stuck,
                 const double *frozen, int *moved) {
  *moved = frot_normalise(m, q);
  if (m->n_invariants > 0) {
    frot_layout l = frot_layout_of(m);
    int turned = *moved;
    int done = frot_project_jointly(m, s, w, t, q, v, d, modes, stuck, s->data + l.scale_x,
                                    s->data + l.frozen, moved);
    *moved |= turned;
    return done;
  }
  if (m->n_rows == 0 || frot_holding_rows(m, w, modes, stuck, 0) == 0) return FROT_OK;
  frame f = {NULL, 0, 0, INFINITY};
  frot_note_unilateral_rows(s, w);
  int status = frot_metric(m, w);
  if (status == FROT_OK) status = project_positions(m, s, w, t, q, v, d, modes, frozen, &f, moved);
  if (status == FROT_OK)
    status = project_speeds(m, s, w, t, q, v, d, modes, stuck, frozen, &f, moved);
  return status;
}

void frot_bind_span(const frot_model *m, const frot_extent *e, frot_span_work *w, frot_arena *a) {
  int n = m->n_rows;
  TAKE(w->spare, n), TAKE(w->kept, n), TAKE(w->order, n), TAKE(w->along, n), TAKE(w->way, n);
  TAKE(w->basis, (n + 1) * e->widest), TAKE(w->parts, n + e->widest);
  TAKE(w->bias, n), TAKE(w->bias_size, n), TAKE(w->left, n), TAKE(w->direction, m->n_entries);
}
