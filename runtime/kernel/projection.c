#include "projection.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "linear.h"
#include "core.h"
#include "invariants.h"

#define HELD 1e-13 /* part of a unit speed outside the span of the rows that hold it */

int frot_holding_rows(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                      const unsigned char *stuck, int normals_only) {
  int n = 0;
  for (int i = 0; i < m->n_contacts; i++) {
    if (!modes[i].closed) continue;
    const frot_contact *contact = &m->contacts[i];
    if (!contact->reduced && contact->row_n >= 0) w->row_of[n++] = contact->row_n;
    if (normals_only) continue;
    if (modes[i].friction == FROT_STICK || (stuck && (stuck[i] & 1)))
      w->row_of[n++] = contact->row_t;
    if (modes[i].rolling == FROT_STICK || (stuck && (stuck[i] & 2)))
      w->row_of[n++] = contact->row_r;
  }
  return n;
}

/* w->step <- M^-1 J' (J M^-1 J')^+ error, over the n rows of w->row_of. */
static void correction(const frot_model *m, frot_work *w, int n, const double *error) {
  int nv = m->nv, nm = nv + m->na, nw = nm + m->nc;
  for (int i = 0; i < n; i++) {
    double *half = w->jacobian + nv * i;
    memcpy(half, w->rows + nw * w->row_of[i], sizeof(double) * (size_t)nv);
    frot_forward(w->factor, nm, nv, half);
  }
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      w->active[j * n + i] = frot_dot(w->jacobian + nv * i, w->jacobian + nv * j, nv);
  double *b = w->right, *lam = w->step + nw;
  memcpy(b, error, sizeof(double) * (size_t)n);
  frot_least_norm(w->active, b, n, n, lam, w->lstsq, w->pivot);
  memset(w->step, 0, sizeof(double) * (size_t)nv);
  for (int i = 0; i < n; i++)
    for (int k = 0; k < nv; k++) w->step[k] += w->jacobian[nv * i + k] * lam[i];
  frot_backward(w->factor, nm, nv, w->step);
}

/* Coordinates onto the gaps that are closed. */
static int project_positions(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                             const double *v, const double *d, const frot_contact_mode *modes,
                             int *moved) {
  for (int pass = 0; pass < 3; pass++) {
    int status = frot_kinematics(m, s, w, t, q, v, d);
    if (status != FROT_OK) return status;
    int n = frot_holding_rows(m, w, modes, NULL, 1), off = 0, k = 0;
    for (int i = 0; i < m->n_contacts; i++) {
      const frot_contact *contact = &m->contacts[i];
      if (!modes[i].closed || contact->reduced || contact->row_n < 0) continue;
      w->residual[k++] = w->gap[i];
      if (fabs(w->gap[i]) > 4 * DBL_EPSILON * frot_gap_size(m, w, contact->row_n, q)) off = 1;
    }
    if (!off || n == 0) break;
    correction(m, w, n, w->residual);
    for (int i = 0; i < m->nq; i++)
      if (m->q_speed[i] >= 0) q[i] -= w->step[m->q_speed[i]];
    *moved = 1;
  }
  return FROT_OK;
}

static int project_speeds(const frot_model *m, frot_state *s, frot_work *w, double t,
                          const double *q, double *v, const double *d,
                          const frot_contact_mode *modes, const unsigned char *stuck, int *moved) {
  for (int pass = 0; pass < 3; pass++) {
    int status = frot_kinematics(m, s, w, t, q, v, d);
    if (status != FROT_OK) return status;
    int n = frot_holding_rows(m, w, modes, stuck, 0), off = 0;
    for (int i = 0; i < n; i++) {
      int row = w->row_of[i];
      w->residual[i] = w->rate[row];
      if (fabs(w->rate[row]) > 2 * DBL_EPSILON * frot_row_size(m, w, row, v)) off = 1;
    }
    if (!off) break;
    correction(m, w, n, w->residual);
    for (int k = 0; k < m->nv; k++) v[k] -= w->step[k];
    *moved = 1;
  }
  return FROT_OK;
}

int frot_project(const frot_model *m, frot_state *s, frot_work *w, double t, double *q, double *v,
                 const double *d, const frot_contact_mode *modes, const unsigned char *stuck,
                 int *moved) {
  *moved = 0;
  if (m->n_invariants > 0) {
    frot_layout l = frot_layout_of(m);
    return frot_project_jointly(m, s, w, t, q, v, d, modes, stuck, s->data + l.scale_x,
                                s->data + l.frozen, moved);
  }
  if (frot_holding_rows(m, w, modes, stuck, 0) == 0) return FROT_OK;
  int status = frot_metric(m, w);
  if (status == FROT_OK) status = project_positions(m, s, w, t, q, v, d, modes, moved);
  if (status == FROT_OK) status = project_speeds(m, s, w, t, q, v, d, modes, stuck, moved);
  return status;
}

/* Takes from x (n) its part in the span of the orthonormal columns and scales the rest to length 1.
 * Returns that rest's length over the length x had. */
static double normalized_outside(double *x, const double *basis, int columns, int n) {
  double before = sqrt(frot_dot(x, x, n));
  for (int pass = 0; pass < 2; pass++)
    for (int c = 0; c < columns; c++) {
      double f = frot_dot(x, basis + n * c, n);
      for (int k = 0; k < n; k++) x[k] -= f * basis[n * c + k];
    }
  double after = sqrt(frot_dot(x, x, n));
  for (int k = 0; k < n && after > 0; k++) x[k] /= after;
  return before > 0 ? after / before : 0;
}

/* Marks the speeds that the rows which depend on frozen coordinates alone hold: the unit vector of
 * such a speed lies in their span. Columns are taken in units of their largest entry, so that units
 * do not matter: masses say nothing of what holds. */
static int frozen_by_rows(const frot_model *m, frot_work *w, int n, const double *known,
                          double *frozen) {
  int nv = m->nv, nw = nv + m->na + m->nc, count = 0, columns = 0;
  double *basis = w->jacobian, *unit = w->residual, *scale = w->right;
  for (int k = 0; k < nv; k++) {
    scale[k] = 0;
    for (int i = 0; i < n; i++) scale[k] = fmax(scale[k], fabs(w->rows[nw * w->row_of[i] + k]));
  }
  for (int i = 0; i < n; i++) {
    int row = w->row_of[i], usable = !m->row_depends[row * (m->nq + 1) + m->nq];
    for (int k = 0; k < m->nq; k++)
      if (m->row_depends[row * (m->nq + 1) + k] && (m->q_speed[k] < 0 || known[m->q_speed[k]] == 0))
        usable = 0;
    if (!usable) continue;
    double *x = basis + nv * columns;
    for (int k = 0; k < nv; k++) x[k] = scale[k] > 0 ? w->rows[nw * row + k] / scale[k] : 0;
    if (normalized_outside(x, basis, columns, nv) > 1e-10) columns++;
  }
  for (int k = 0; k < nv; k++) {
    for (int i = 0; i < nv; i++) unit[i] = i == k;
    frozen[k] = known[k] != 0 && normalized_outside(unit, basis, columns, nv) < HELD;
    count += frozen[k] != 0;
  }
  return count;
}

void frot_find_frozen(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                      double *frozen) {
  int n = frot_holding_rows(m, w, modes, NULL, 0);
  double *known = w->step;
  for (int k = 0; k < m->nv; k++) known[k] = 1;
  for (int count = m->nv + 1;;) {
    int now = frozen_by_rows(m, w, n, known, frozen);
    if (now == count || now == 0) return;
    count = now;
    memcpy(known, frozen, sizeof(double) * (size_t)m->nv);
  }
}
