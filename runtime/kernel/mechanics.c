#include "mechanics.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "linear.h"

#define FRICTION_WEIGHT 1e-5

void frot_inputs(const frot_model *m, frot_state *s, frot_work *w, const double *t, const double *q,
                 const double *v, const double *d) {
  frot_layout l = frot_layout_of(m);
  w->arg[0] = t, w->arg[1] = q, w->arg[2] = v;
  w->arg[3] = s->data + l.u, w->arg[4] = s->data + l.p, w->arg[5] = d, w->arg[6] = w->y;
}

static int all_finite(const double *x, int n) {
  double sum = 0;
  for (int i = 0; i < n; i++) sum += x[i] - x[i];
  return sum == 0;
}

int frot_dynamics(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, const frot_contact_mode *modes) {
  int nw = m->nv + m->na + m->nc, nr = m->n_rows;
  frot_inputs(m, s, w, &t, q, v, d);
  double *res[] = {w->qd,   w->mass, w->h,         w->rows,        w->c,
                   w->rate, w->gap,  w->condition, w->coefficient, w->power};
  memcpy(w->res, res, sizeof res);
  m->dynamics.call(w->arg, w->res, w->iw, w->w, 0);
  s->statistics.evaluations++;
  w->t = t;
  if (!all_finite(w->mass, nw * nw) || !all_finite(w->h, nw) || !all_finite(w->rows, nw * nr) ||
      !all_finite(w->c, nr) || !all_finite(w->qd, m->nq) ||
      !all_finite(w->coefficient, 3 * m->n_contacts) ||
      !all_finite(w->condition, m->n_conditions) || !all_finite(w->gap, m->n_contacts) ||
      !all_finite(w->power, 1))
    return FROT_NAN;
  memcpy(w->factor, w->mass, sizeof(double) * (size_t)(nw * nw));
  if (frot_cholesky(w->factor, nw)) return FROT_SINGULAR;
  memcpy(w->force, w->h, sizeof(double) * (size_t)nw);
  frot_forward(w->factor, nw, nw, w->force);
  for (int i = 0; i < m->n_contacts; i++) {
    if (!modes[i].closed) continue;
    const frot_contact *contact = &m->contacts[i];
    int rows[3] = {contact->row_n, contact->row_t, contact->row_r};
    for (int k = 0; k < 3; k++) {
      int r = rows[k];
      if (r < 0) continue;
      double *half = w->half_rows + nw * r;
      memcpy(half, w->rows + nw * r, sizeof(double) * (size_t)nw);
      frot_forward(w->factor, nw, nw, half);
      w->free[r] = frot_dot(half, w->force, nw) + w->c[r];
    }
  }
  for (int i = 0; i < m->n_contacts; i++) {
    if (!modes[i].closed) continue;
    for (int j = 0; j < m->n_contacts; j++) {
      if (!modes[j].closed) continue;
      int a[3] = {m->contacts[i].row_n, m->contacts[i].row_t, m->contacts[i].row_r};
      int b[3] = {m->contacts[j].row_n, m->contacts[j].row_t, m->contacts[j].row_r};
      for (int k = 0; k < 9; k++) {
        int r = a[k / 3], c = b[k % 3];
        if (r < 0 || c < 0 || r < c) continue;
        double value = frot_dot(w->half_rows + nw * r, w->half_rows + nw * c, nw);
        w->delassus[r * nr + c] = w->delassus[c * nr + r] = value;
      }
    }
  }
  return FROT_OK;
}

void frot_kinematics(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                     const double *v, const double *d) {
  frot_inputs(m, s, w, &t, q, v, d);
  double *res[] = {w->gap, w->rows, w->rate, w->condition, w->distance};
  memcpy(w->res, res, sizeof res);
  m->kinematics.call(w->arg, w->res, w->iw, w->w, 0);
}

/* Direction of friction on the body: against the slip, times the side of the reaction. */
static double opposed(const frot_contact_mode *mode, int friction) {
  if (friction == FROT_SLIP_FORWARD) return -mode->side;
  if (friction == FROT_SLIP_BACKWARD) return mode->side;
  return 0;
}

/* Rows that follow the normal reaction in sliding: ratio of the row's reaction to lam_n. */
typedef struct {
  double friction, rolling;
} ratios;

static ratios ratios_of(const frot_work *w, const frot_contact_mode *mode, int i, int at_rest) {
  const double *k = w->coefficient + 3 * i; /* mu, mu_s, delta */
  return (ratios){opposed(mode, mode->friction) * (at_rest ? k[1] : k[0]),
                  opposed(mode, mode->rolling) * k[2]};
}

static int is_normal(const frot_model *m, int row) {
  for (int i = 0; i < m->n_contacts; i++)
    if (m->contacts[i].row_n == row) return 1;
  return 0;
}

int frot_reactions(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                   const unsigned char *at_rest) {
  int nr = m->n_rows, nw = m->nv + m->na + m->nc, n = 0;
  memset(w->lam, 0, sizeof(double) * (size_t)nr);
  for (int i = 0; i < m->n_contacts; i++) {
    if (!modes[i].closed) continue;
    const frot_contact *contact = &m->contacts[i];
    w->row_of[n++] = contact->row_n;
    if (modes[i].friction == FROT_STICK) w->row_of[n++] = contact->row_t;
    if (modes[i].rolling == FROT_STICK) w->row_of[n++] = contact->row_r;
  }
  if (n == 0) return 0;
  /* Column of an active row: its reaction and those that follow it. */
  int column = 0;
  for (int i = 0; i < m->n_contacts; i++) {
    if (!modes[i].closed) continue;
    const frot_contact *contact = &m->contacts[i];
    ratios follow = ratios_of(w, &modes[i], i, at_rest && at_rest[i]);
    for (int r = 0; r < n; r++) {
      const double *wr = w->delassus + w->row_of[r] * nr;
      double value = wr[contact->row_n];
      if (follow.friction != 0) value += follow.friction * wr[contact->row_t];
      if (follow.rolling != 0) value += follow.rolling * wr[contact->row_r];
      w->active[column * n + r] = value;
    }
    column++;
    int stuck[2] = {modes[i].friction == FROT_STICK ? contact->row_t : -1,
                    modes[i].rolling == FROT_STICK ? contact->row_r : -1};
    for (int k = 0; k < 2; k++) {
      if (stuck[k] < 0) continue;
      for (int r = 0; r < n; r++)
        w->active[column * n + r] = w->delassus[w->row_of[r] * nr + stuck[k]];
      column++;
    }
  }
  for (int r = 0; r < n; r++) w->right[r] = -w->free[w->row_of[r]];
  double *copy = w->lstsq, *work = w->lstsq + n * n;
  memcpy(copy, w->active, sizeof(double) * (size_t)(n * n));
  memcpy(work, w->right, sizeof(double) * (size_t)n);
  double *x = work;
  if (frot_lu_solve(copy, x, n)) {
    /* Dependent rows (hyperstatic): reactions of least friction, if the rows do not contradict.
     * Friction weighs so much more than normal reactions that rest is not lost for want of it. */
    double *b = work, *scratch = work + n;
    double push = sqrt(frot_dot(w->force, w->force, nw));
    x = w->step;
    for (int c = 0; c < n; c++) {
      double weight = is_normal(m, w->row_of[c]) ? 1 : FRICTION_WEIGHT;
      for (int r = 0; r < n; r++) copy[c * n + r] = weight * w->active[c * n + r];
    }
    memcpy(b, w->right, sizeof(double) * (size_t)n);
    frot_least_norm(copy, b, n, n, x, scratch, w->pivot);
    for (int c = 0; c < n; c++)
      if (!is_normal(m, w->row_of[c])) x[c] *= FRICTION_WEIGHT;
    for (int r = 0; r < n; r++) {
      int row = w->row_of[r];
      double sum = -w->right[r], size = push * sqrt(w->delassus[row * nr + row]) + fabs(w->c[row]);
      for (int c = 0; c < n; c++) {
        sum += w->active[c * n + r] * x[c];
        size += fabs(w->active[c * n + r] * x[c]);
      }
      if (!(fabs(sum) <= 1e-9 * size)) return 1;
    }
  }
  for (int r = 0; r < n; r++) w->lam[w->row_of[r]] = x[r];
  for (int i = 0; i < m->n_contacts; i++) {
    if (!modes[i].closed) continue;
    const frot_contact *contact = &m->contacts[i];
    ratios follow = ratios_of(w, &modes[i], i, at_rest && at_rest[i]);
    if (follow.friction != 0) w->lam[contact->row_t] = follow.friction * w->lam[contact->row_n];
    if (follow.rolling != 0) w->lam[contact->row_r] = follow.rolling * w->lam[contact->row_n];
  }
  return !all_finite(w->lam, nr);
}

void frot_row_loads(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, const double *d, const frot_contact_mode *modes) {
  int nw = m->nv + m->na + m->nc;
  double *load = w->step;
  frot_inputs(m, s, w, &t, q, v, d);
  w->res[0] = load, w->res[1] = w->values;
  m->sizes.call(w->arg, w->res, w->iw, w->w, 0);
  for (int i = 0; i < nw; i++) { /* |L^-1| load */
    for (int k = 0; k < i; k++) load[i] += fabs(w->factor[k * nw + i]) * load[k];
    load[i] /= w->factor[i * nw + i];
  }
  s->push = fmax(s->push, sqrt(frot_dot(load, load, nw)));
  for (int i = 0; i < m->n_contacts; i++) {
    if (!modes[i].closed) continue;
    const frot_contact *contact = &m->contacts[i];
    int rows[3] = {contact->row_n, contact->row_t, contact->row_r};
    for (int r = 0; r < 3; r++) {
      if (rows[r] < 0) continue;
      double sum = fabs(w->c[rows[r]]);
      for (int k = 0; k < nw; k++) sum += fabs(w->half_rows[nw * rows[r] + k]) * load[k];
      w->row_load[rows[r]] = sum;
    }
  }
}

double frot_row_speed(const frot_model *m, frot_work *w, int row, const double *v) {
  int nv = m->nv, nw = m->nv + m->na + m->nc;
  double energy = 0, *half = w->step;
  for (int i = 0; i < nv; i++)
    for (int k = 0; k < nv; k++) energy += v[i] * w->mass[k * nw + i] * v[k];
  memcpy(half, w->rows + nw * row, sizeof(double) * (size_t)nv);
  frot_forward(w->factor, nw, nv, half);
  return sqrt(fmax(energy, 0) * frot_dot(half, half, nv));
}

void frot_accelerations(const frot_model *m, frot_work *w, const double *frozen) {
  int nw = m->nv + m->na + m->nc;
  memcpy(w->a, w->force, sizeof(double) * (size_t)nw);
  for (int r = 0; r < m->n_rows; r++)
    if (w->lam[r] != 0)
      for (int k = 0; k < nw; k++) w->a[k] += w->lam[r] * w->half_rows[nw * r + k];
  frot_backward(w->factor, nw, nw, w->a);
  for (int k = 0; k < m->nv; k++)
    if (frozen[k] != 0) w->a[k] = 0;
}

/* Guards of one bounded relative motion: of friction (bound mu_s N) or of rolling (bound delta N).
 */
static void bounded(int mode, double rate, double rate_scale, double lam, double bound,
                    double *guard, double *scale) {
  if (mode == FROT_STICK) {
    guard[0] = bound - lam, guard[1] = bound + lam;
    scale[0] = scale[1] = fabs(bound) + fabs(lam);
  } else if (mode != FROT_NONE) {
    guard[0] = mode == FROT_SLIP_FORWARD ? rate : -rate;
    scale[0] = rate_scale;
  }
}

double frot_row_size(const frot_model *m, const frot_work *w, int row, const double *x) {
  double sum = 0;
  for (int k = 0; k < m->nv; k++) sum += fabs(w->rows[(m->nv + m->na + m->nc) * row + k] * x[k]);
  return sum;
}

void frot_guards(const frot_model *m, const frot_state *s, frot_work *w, const double *q,
                 const double *v, const double *d, const frot_contact_mode *modes, double *guard,
                 double *scale) {
  frot_layout l = frot_layout_of(m);
  const double *unilateral = s->data + l.unilateral;
  for (int i = 0; i < m->n_contacts; i++) {
    const frot_contact *contact = &m->contacts[i];
    const frot_contact_mode *mode = &modes[i];
    double g[FROT_GUARDS] = {1, 1, 1, 1, 1}, size[FROT_GUARDS] = {1, 1, 1, 1, 1};
    if (!mode->closed) {
      g[0] = w->gap[i];
      size[0] = fabs(w->gap[i]) + frot_row_size(m, w, contact->row_n, q);
    } else {
      const double *k = w->coefficient + 3 * i;
      double lam_n = w->lam[contact->row_n];
      if (unilateral[i] != 0 || mode->friction != FROT_NONE || mode->rolling != FROT_NONE) {
        g[0] = mode->side * lam_n;
        size[0] = fabs(lam_n);
      }
      if (mode->friction != FROT_NONE)
        bounded(mode->friction, w->rate[contact->row_t], frot_row_size(m, w, contact->row_t, v),
                w->lam[contact->row_t], k[1] * mode->side * lam_n, g + 1, size + 1);
      if (mode->rolling != FROT_NONE)
        bounded(mode->rolling, w->rate[contact->row_r], frot_row_size(m, w, contact->row_r, v),
                w->lam[contact->row_r], k[2] * mode->side * lam_n, g + 3, size + 3);
    }
    memcpy(guard + FROT_GUARDS * i, g, sizeof g);
    if (scale) memcpy(scale + FROT_GUARDS * i, size, sizeof size);
  }
  for (int j = 0; j < m->n_conditions; j++) {
    int at = FROT_GUARDS * m->n_contacts + j;
    guard[at] = d[j] != 0 ? w->condition[j] : -w->condition[j];
    if (scale) scale[at] = fabs(guard[at]);
  }
}

int frot_derivatives(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
                     const double *d, const frot_contact_mode *modes, const double *frozen,
                     double *slope) {
  frot_layout l = frot_layout_of(m);
  const double *v = z + m->nq;
  int status = frot_dynamics(m, s, w, t, z, v, d, modes);
  if (status != FROT_OK) return status;
  if (frot_reactions(m, w, modes, NULL)) return FROT_DIVERGE;
  frot_accelerations(m, w, frozen);
  if (!all_finite(w->a, l.nw)) return FROT_NAN;
  memcpy(slope, w->qd, sizeof(double) * (size_t)m->nq);
  memcpy(slope + m->nq, w->a, sizeof(double) * (size_t)m->nv);
  double dissipated = 0;
  for (int i = 0; i < m->n_contacts; i++) {
    if (!modes[i].closed) continue;
    const frot_contact *contact = &m->contacts[i];
    if (modes[i].friction > FROT_STICK)
      dissipated -= w->lam[contact->row_t] * w->rate[contact->row_t];
    if (modes[i].rolling > FROT_STICK)
      dissipated -= w->lam[contact->row_r] * w->rate[contact->row_r];
  }
  slope[m->nq + m->nv] = dissipated;
  slope[m->nq + m->nv + 1] = w->power[0];
  frot_guards(m, s, w, z, v, d, modes, slope + l.nx, NULL);
  return FROT_OK;
}
