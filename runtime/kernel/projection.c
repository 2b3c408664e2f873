#include "projection.h"

#include <math.h>
#include <string.h>

#include "core.h"
#include "invariants.h"
#include "linear.h"
#include "spare.h"
#include "terms.h"
#include "tolerances.h"
#include "turns.h"

#define PASSES 3 /* of Newton's method: it starts next to the solution */

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

/* w->relations.step (n_speeds) <- the least change of the group's speeds, in the metric, that takes
 * `error` from the n rows of w->relations.rows: with the rows H = L^-1 J' made orthonormal, H = Q
 * R, it is L'^-1 Q R'^-1 error. A row that depends on those before it is left to them. */
static void correction(const frot_model *m, frot_work *w, const frot_group *g, int n,
                       const double *error) {
  int ns = g->n_speeds, rank = 0;
  double *step = w->relations.step;
  memset(step, 0, sizeof(double) * (size_t)ns);
  for (int i = 0; i < n; i++) {
    double *x = w->span.basis + ns * rank, *parts = w->span.parts;
    if (frot_is_spare(w, w->relations.rows[i])) continue;
    memcpy(x, frot_entries(m, w->core.rows, w->relations.rows[i]), sizeof(double) * (size_t)ns);
    frot_inwards(w, g, x);
    double length = sqrt(frot_dot(x, x, ns)), part = error[i];
    double rest = frot_reject(x, w->span.basis, rank, ns, parts);
    if (!(rest > frot_least_length(m, w, w->relations.rows[i], length))) continue;
    for (int k = 0; k < rank; k++) part -= parts[k] * w->span.bias[k];
    for (int k = 0; k < ns; k++) x[k] /= rest;
    w->span.bias[rank] = part / rest;
    for (int k = 0; k < ns; k++) step[k] += w->span.bias[rank] * x[k];
    rank++;
  }
  frot_outwards(w, g, step);
}

/* Coordinates onto the gaps that are closed. */
static int project_positions(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                             const double *v, const double *d, const frot_contact_mode *modes,
                             int *moved) {
  for (int pass = 0; pass < PASSES; pass++) {
    int status = frot_kinematics(m, s, w, t, q, v, d), any = 0;
    if (status != FROT_OK) return status;
    for (int k = 0; k < w->awake.now->n_groups; k++) {
      const frot_group *g = &m->groups[w->awake.now->groups[k]];
      int n = frot_rows_of_group(m, g, modes, NULL, 1, w->relations.rows), off = 0, at = 0;
      for (int i = 0; i < g->n_contacts; i++) {
        int c = g->contacts[i];
        if (!keeps_place(m, modes, c)) continue;
        w->relations.residual[at++] = w->core.gap[c];
        off |= fabs(w->core.gap[c]) > FROT_ROUNDING * frot_gap_size(m, w, m->contacts[c].row_n, q);
      }
      if (!off) continue;
      correction(m, w, g, n, w->relations.residual);
      frot_displace(m, g, q, w->relations.step, -1);
      any = *moved = 1;
    }
    if (!any) break;
  }
  return FROT_OK;
}

static int project_speeds(const frot_model *m, frot_state *s, frot_work *w, double t,
                          const double *q, double *v, const double *d,
                          const frot_contact_mode *modes, const unsigned char *stuck, int *moved) {
  for (int pass = 0; pass < PASSES; pass++) {
    int status = frot_kinematics(m, s, w, t, q, v, d), any = 0;
    if (status != FROT_OK) return status;
    for (int k = 0; k < w->awake.now->n_groups; k++) {
      const frot_group *g = &m->groups[w->awake.now->groups[k]];
      int n = frot_rows_of_group(m, g, modes, stuck, 0, w->relations.rows), off = 0;
      for (int i = 0; i < n; i++) {
        int row = w->relations.rows[i];
        w->relations.residual[i] = w->core.rate[row];
        off |= fabs(w->core.rate[row]) > 0.5 * FROT_ROUNDING * frot_row_size(m, w, row, v);
      }
      if (!off) continue;
      correction(m, w, g, n, w->relations.residual);
      for (int i = 0; i < g->n_speeds; i++) v[g->unknowns[i]] -= w->relations.step[i];
      any = *moved = 1;
    }
    if (!any) break;
  }
  return FROT_OK;
}

int frot_project(const frot_model *m, frot_state *s, frot_work *w, double t, double *q, double *v,
                 const double *d, const frot_contact_mode *modes, const unsigned char *stuck,
                 int *moved) {
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
  int status = frot_metric(m, w);
  if (status == FROT_OK) status = project_positions(m, s, w, t, q, v, d, modes, moved);
  if (status == FROT_OK) status = project_speeds(m, s, w, t, q, v, d, modes, stuck, moved);
  return status;
}
