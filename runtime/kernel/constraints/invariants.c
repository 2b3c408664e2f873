#include "constraints/invariants.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "numerics/dense.h"
#include "numerics/basis.h"
#include "constraints/projection.h"
#include "constraints/redundant_rows.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"
#include "evaluation/quaternions.h"

#define PASSES 5

/* Units in which the changes of the states are measured, into w->relations.unit (nq + nv): their
 * sizes. What is `frozen` (NULL: nothing) does not change. */
static void find_units(const frot_model *m, frot_work *w, const double *q, const double *v,
                       const double *sizes, const double *frozen) {
  int first = 0, ends[2] = {m->nq, m->nq + m->nv};
  for (int kind = 0; kind < 2; first = ends[kind], kind++) {
    double largest = 0;
    for (int k = first; k < ends[kind]; k++) {
      w->relations.unit[k] = fabs(kind == 0 ? q[k] : v[k - m->nq]);
      if (sizes) w->relations.unit[k] = fmax(w->relations.unit[k], sizes[k]);
      largest = fmax(largest, w->relations.unit[k]);
    }
    for (int k = first; k < ends[kind]; k++) {
      w->relations.unit[k] =
          largest > 0 ? fmax(w->relations.unit[k], FROT_LEAST_SIZE * largest) : 1;
      if (kind == 1 && frozen && frozen[k - m->nq] != 0) w->relations.unit[k] = 0;
    }
  }
}

void frot_add_sizes(const frot_model *m, frot_work *w, const double *q, const double *v,
                    double *size) {
  int nx = m->nq + m->nv;
  find_units(m, w, q, v, NULL, NULL);
  for (int i = 0; i < m->n_invariants; i++)
    for (int k = 0; k < nx; k++)
      size[i] += fabs(w->relations.jacobian[nx * i + k]) * w->relations.unit[k];
}

/* One more equation, its row (nq + nv) in `row`: scaled by the units and to length 1. Returns
 * whether it is off by more than rounding; an equation that nothing can change is left out. */
static int add(const frot_model *m, frot_work *w, int *n, double residual, double size) {
  int nx = m->nq + m->nv;
  double *row = w->relations.jacobian + nx * *n;
  for (int k = 0; k < nx; k++) row[k] *= w->relations.unit[k];
  double length = frot_length(row, nx);
  if (!(length > 0)) return 0;
  for (int k = 0; k < nx; k++) row[k] /= length;
  w->relations.residual[(*n)++] = residual / length;
  return fabs(residual) > FROT_ROUNDING * size;
}

/* The equations into w->relations.jacobian, by rows, and w->relations.residual, without those of
 * rows that are left to others; returns whether one is off. */
static int list_equations(const frot_model *m, frot_state *s, frot_work *w, double t,
                          const double *q, const double *v, const double *d,
                          const frot_contact_mode *modes, const unsigned char *stuck, int *n) {
  int nx = m->nq + m->nv, off = 0;
  double *g = w->linear.right, *size = w->relations.size;
  *n = 0;
  frot_inputs(s, w, &t, q, v, d);
  w->call.res[0] = g, w->call.res[1] = w->relations.jacobian, w->call.res[2] = size;
  frot_call(w, &m->invariants);
  for (int i = 0; i < m->n_invariants; i++) {
    double *row = w->relations.jacobian + nx * *n;
    memmove(row, w->relations.jacobian + nx * i, sizeof(double) * (size_t)nx);
    off |= add(m, w, n, g[i], size[i]);
  }
  for (int i = 0; i < m->n_contacts; i++) {
    const frot_contact *contact = &m->contacts[i];
    if (!modes[i].closed || contact->reduced || contact->row_n < 0 || contact->kinematic) continue;
    if (frot_is_redundant(w, contact->row_n)) continue;
    double *row = w->relations.jacobian + nx * *n;
    memset(row, 0, sizeof(double) * (size_t)nx);
    const frot_group *group = frot_group_of(m, contact->row_n);
    const double *entries = frot_entries(m, w->core.rows, contact->row_n);
    frot_over_coordinates(m, group, entries, q, row);
    off |= add(m, w, n, w->core.gap[i], frot_gap_size(m, w, contact->row_n, q));
  }
  int held = frot_holding_rows(m, w, modes, stuck, 0);
  for (int i = 0; i < held; i++) {
    if (frot_is_redundant(w, w->relations.rows[i])) continue;
    double *row = w->relations.jacobian + nx * *n;
    memset(row, 0, sizeof(double) * (size_t)nx);
    const frot_group *group = frot_group_of(m, w->relations.rows[i]);
    const double *entries = frot_entries(m, w->core.rows, w->relations.rows[i]);
    for (int k = 0; k < group->n_speeds; k++) row[m->nq + group->unknowns[k]] = entries[k];
    off |= add(m, w, n, w->core.rate[w->relations.rows[i]],
               frot_row_size(m, w, w->relations.rows[i], v));
  }
  return off;
}

int frot_project_jointly(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                         double *v, const double *d, const frot_contact_mode *modes,
                         const unsigned char *stuck, const double *sizes, const double *frozen,
                         int *moved) {
  int nx = m->nq + m->nv;
  *moved = 0;
  find_units(m, w, q, v, sizes, frozen);
  for (int pass = 0; pass < PASSES; pass++) {
    int n, status = frot_kinematics(m, s, w, t, q, v, d);
    if (status != FROT_OK) return status;
    int off = list_equations(m, s, w, t, q, v, d, modes, stuck, &n);
    if (!frot_all_finite(w->relations.residual, n) ||
        !frot_all_finite(w->relations.jacobian, n * nx))
      return FROT_NAN;
    if (!off) return FROT_OK;
    for (int i = 0; i < n; i++)
      for (int j = 0; j <= i; j++)
        w->linear.matrix[j * n + i] = w->linear.matrix[i * n + j] =
            frot_dot(w->relations.jacobian + nx * i, w->relations.jacobian + nx * j, nx);
    double *lam = w->relations.step;
    frot_least_norm(w->linear.matrix, w->relations.residual, n, n, FROT_RANK, lam,
                    w->linear.scratch, w->linear.pivot);
    for (int i = 0; i < n; i++)
      for (int k = 0; k < nx; k++) {
        double change = lam[i] * w->relations.unit[k] * w->relations.jacobian[nx * i + k];
        if (k < m->nq)
          q[k] -= change;
        else
          v[k - m->nq] -= change;
      }
    *moved = 1;
  }
  return FROT_OK;
}
