#include "core.h"

#include <math.h>
#include <string.h>

#include "blocks.h"
#include "linear.h"

void frot_inputs(const frot_model *m, frot_state *s, frot_work *w, const double *t, const double *q,
                 const double *v, const double *d) {
  (void)m;
  w->arg[0] = t, w->arg[1] = q, w->arg[2] = v;
  w->arg[3] = s->data + w->layout.u, w->arg[4] = s->data + w->layout.p;
  w->arg[5] = d, w->arg[6] = w->y;
}

/* Rows of the closed contacts into w->row_of; returns their number. */
static int active_rows(const frot_model *m, frot_work *w, const frot_contact_mode *modes) {
  int n = 0;
  for (int i = 0; i < m->n_contacts; i++) {
    int rows[FROT_ROWS];
    if (!modes[i].closed) continue;
    frot_rows_of(&m->contacts[i], rows);
    for (int k = 0; k < FROT_ROWS; k++)
      if (rows[k] >= 0) w->row_of[n++] = rows[k];
  }
  return n;
}

/* A is the mass matrix L L', E = J': W and the free accelerations from L^-1 J' and L^-1 h. */
static int symmetric_core(const frot_model *m, frot_work *w, int n) {
  int nw = m->nv + m->na, nr = m->n_rows;
  memcpy(w->factor, w->mass, sizeof(double) * (size_t)(nw * nw));
  if (frot_cholesky(w->factor, nw)) return FROT_SINGULAR;
  memcpy(w->force, w->h, sizeof(double) * (size_t)nw);
  frot_forward(w->factor, nw, nw, w->force);
  for (int i = 0; i < n; i++) {
    int r = w->row_of[i];
    double *half = w->half_rows + nw * r;
    memcpy(half, w->rows + nw * r, sizeof(double) * (size_t)nw);
    frot_forward(w->factor, nw, nw, half);
    w->free[r] = frot_dot(half, w->force, nw) + w->c[r];
  }
  for (int i = 0; i < n; i++)
    for (int j = 0; j <= i; j++) {
      int r = w->row_of[i], c = w->row_of[j];
      double value = frot_dot(w->half_rows + nw * r, w->half_rows + nw * c, nw);
      w->delassus[r * nr + c] = w->delassus[c * nr + r] = value;
    }
  return FROT_OK;
}

/* A is any matrix: W = J Z and free = J z0 + c from Z = A^-1 E and z0 = A^-1 h. */
static int general_core(const frot_model *m, frot_work *w, int n) {
  frot_layout l = w->layout;
  int nw = l.nw, nr = m->n_rows;
  w->res[0] = w->effect, w->res[1] = w->metric;
  m->spread.call(w->arg, w->res, w->iw, w->w, 0);
  if (!frot_all_finite(w->effect, nw * nr) || !frot_all_finite(w->metric, l.nm * l.nm))
    return FROT_NAN;
  memcpy(w->lu, w->mass, sizeof(double) * (size_t)(nw * nw));
  if (frot_lu(w->lu, nw, w->lu_pivot, w->lu_scale)) return FROT_SINGULAR;
  double *z = w->free_motion, *rest = z + nw;
  memcpy(z, w->h, sizeof(double) * (size_t)nw);
  frot_lu_apply(w->lu, nw, w->lu_pivot, w->lu_scale, z);
  memcpy(rest, w->h, sizeof(double) * (size_t)nw); /* one step of refinement */
  for (int k = 0; k < nw; k++)
    for (int i = 0; i < nw; i++) rest[i] -= w->mass[k * nw + i] * z[k];
  frot_lu_apply(w->lu, nw, w->lu_pivot, w->lu_scale, rest);
  for (int i = 0; i < nw; i++) z[i] += rest[i];
  for (int i = 0; i < n; i++) {
    int r = w->row_of[i];
    double *response = w->response + nw * r;
    memcpy(response, w->effect + nw * r, sizeof(double) * (size_t)nw);
    frot_lu_apply(w->lu, nw, w->lu_pivot, w->lu_scale, response);
    w->free[r] = frot_dot(w->rows + nw * r, z, nw) + w->c[r];
  }
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      int r = w->row_of[i], c = w->row_of[j];
      w->delassus[r * nr + c] = frot_dot(w->rows + nw * r, w->response + nw * c, nw);
    }
  return FROT_OK;
}

int frot_dynamics(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, const frot_contact_mode *modes) {
  int nw = m->nv + m->na + m->nc, nr = m->n_rows;
  s->statistics.evaluations++;
  w->t = t;
  int status = frot_solve_blocks(m, s, w, t, q, v, d);
  if (status != FROT_OK) return status;
  frot_inputs(m, s, w, &t, q, v, d);
  double *res[] = {w->qd,   w->mass, w->h,         w->rows,        w->c,
                   w->rate, w->gap,  w->condition, w->coefficient, w->power};
  memcpy(w->res, res, sizeof res);
  m->dynamics.call(w->arg, w->res, w->iw, w->w, 0);
  if (!frot_all_finite(w->mass, nw * nw) || !frot_all_finite(w->h, nw) ||
      !frot_all_finite(w->rows, nw * nr) || !frot_all_finite(w->c, nr) ||
      !frot_all_finite(w->qd, m->nq) || !frot_all_finite(w->coefficient, 3 * m->n_contacts) ||
      !frot_all_finite(w->condition, m->n_located) || !frot_all_finite(w->gap, m->n_contacts) ||
      !frot_all_finite(w->power, 1))
    return FROT_NAN;
  int n = active_rows(m, w, modes);
  return m->general ? general_core(m, w, n) : symmetric_core(m, w, n);
}

int frot_kinematics(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, const double *d) {
  int status = frot_solve_blocks(m, s, w, t, q, v, d);
  if (status != FROT_OK) return status;
  frot_inputs(m, s, w, &t, q, v, d);
  double *res[] = {w->gap, w->rows, w->rate, w->condition};
  memcpy(w->res, res, sizeof res);
  m->kinematics.call(w->arg, w->res, w->iw, w->w, 0);
  return FROT_OK;
}

int frot_metric(const frot_model *m, frot_work *w) {
  int nm = m->nv + m->na;
  if (!m->general) return FROT_OK;
  memcpy(w->factor, w->metric, sizeof(double) * (size_t)(nm * nm));
  return frot_cholesky(w->factor, nm) ? FROT_SINGULAR : FROT_OK;
}

void frot_accelerations(const frot_model *m, frot_work *w, const double *frozen) {
  int nw = m->nv + m->na + m->nc;
  const double *response = m->general ? w->response : w->half_rows;
  memcpy(w->a, m->general ? w->free_motion : w->force, sizeof(double) * (size_t)nw);
  for (int r = 0; r < m->n_rows; r++)
    if (w->lam[r] != 0)
      for (int k = 0; k < nw; k++) w->a[k] += w->lam[r] * response[nw * r + k];
  if (!m->general) frot_backward(w->factor, nw, nw, w->a);
  for (int k = 0; k < m->nv; k++)
    if (frozen[k] != 0) w->a[k] = 0;
}

double frot_row_size(const frot_model *m, const frot_work *w, int row, const double *v) {
  const double *entries = w->rows + (m->nv + m->na + m->nc) * row;
  double sum = 0;
  for (int k = 0; k < m->nv; k++) sum += fabs(entries[k] * v[k]);
  return sum;
}

double frot_gap_size(const frot_model *m, const frot_work *w, int row, const double *q) {
  const double *entries = w->rows + (m->nv + m->na + m->nc) * row;
  double sum = 0;
  for (int k = 0; k < m->nq; k++)
    if (m->q_speed[k] >= 0) sum += fabs(entries[m->q_speed[k]] * q[k]);
  return sum;
}

double frot_row_speed(const frot_model *m, frot_work *w, int row, const double *v) {
  int nv = m->nv, nm = nv + m->na;
  const double *metric = m->general ? w->metric : w->mass;
  double energy = 0, *half = w->step;
  for (int i = 0; i < nv; i++)
    for (int k = 0; k < nv; k++) energy += v[i] * metric[k * nm + i] * v[k];
  memcpy(half, w->rows + (nm + m->nc) * row, sizeof(double) * (size_t)nv);
  frot_forward(w->factor, nm, nv, half);
  return sqrt(fmax(energy, 0) * frot_dot(half, half, nv));
}

/* |A^-1| load into `size`, column after column of the inverse. */
static void spread_sizes(const frot_model *m, frot_work *w, const double *load, double *size) {
  int nw = m->nv + m->na + m->nc;
  double *column = w->free_motion + nw;
  memset(size, 0, sizeof(double) * (size_t)nw);
  for (int k = 0; k < nw; k++) {
    memset(column, 0, sizeof(double) * (size_t)nw);
    column[k] = load[k];
    frot_lu_apply(w->lu, nw, w->lu_pivot, w->lu_scale, column);
    for (int i = 0; i < nw; i++) size[i] += fabs(column[i]);
  }
}

void frot_row_loads(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, const double *d, const frot_contact_mode *modes) {
  frot_layout l = w->layout;
  int nw = l.nw;
  double *load = w->step;
  const double *rows = m->general ? w->rows : w->half_rows;
  if (!m->sizes.call) return;
  memset(load, 0, sizeof(double) * (size_t)nw);
  frot_inputs(m, s, w, &t, q, v, d);
  w->res[0] = load, w->res[1] = w->values;
  m->sizes.call(w->arg, w->res, w->iw, w->w, 0);
  if (m->general) {
    double *size = w->unit;
    spread_sizes(m, w, load, size);
    memcpy(load, size, sizeof(double) * (size_t)nw);
    for (int k = 0; k < m->nv; k++) s->data[l.push_v + k] = fmax(s->data[l.push_v + k], load[k]);
  } else {
    for (int i = 0; i < nw; i++) { /* |L^-1| load */
      for (int k = 0; k < i; k++) load[i] += fabs(w->factor[k * nw + i]) * load[k];
      load[i] /= w->factor[i * nw + i];
    }
    s->push = fmax(s->push, sqrt(frot_dot(load, load, nw)));
  }
  int n = active_rows(m, w, modes);
  for (int i = 0; i < n; i++) {
    int r = w->row_of[i];
    double sum = fabs(w->c[r]);
    for (int k = 0; k < nw; k++) sum += fabs(rows[nw * r + k]) * load[k];
    w->row_load[r] = sum;
  }
}

void frot_note_push(const frot_model *m, frot_state *s, const frot_work *w) {
  frot_layout l = w->layout;
  if (!m->general) {
    s->push = fmax(s->push, sqrt(frot_dot(w->force, w->force, l.nw)));
    return;
  }
  for (int k = 0; k < m->nv; k++)
    s->data[l.push_v + k] = fmax(s->data[l.push_v + k], fabs(w->free_motion[k]));
}

double frot_push_on(const frot_model *m, const frot_state *s, const frot_work *w, int speed) {
  if (m->general) return s->data[w->layout.push_v + speed];
  return s->push / w->factor[speed * (m->nv + m->na + 1)];
}

int frot_is_prescribed(const frot_model *m, const frot_work *w, int row) {
  int nw = m->nv + m->na + m->nc;
  for (int k = 0; k < nw; k++)
    if (w->rows[nw * row + k] != 0) return 0;
  return 1;
}

int frot_energies(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, double energy[2]) {
  energy[0] = energy[1] = 0;
  if (!m->energy.call) return FROT_OK;
  int status = frot_solve_blocks(m, s, w, t, q, v, d);
  if (status != FROT_OK) return status;
  frot_inputs(m, s, w, &t, q, v, d);
  w->res[0] = energy, w->res[1] = energy + 1;
  m->energy.call(w->arg, w->res, w->iw, w->w, 0);
  return FROT_OK;
}
