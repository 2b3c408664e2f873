#include "initial.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "linear.h"
#include "mechanics.h"

#define PASSES 60
#define AGREES 1e-9 /* largest residual, relative to the terms, of statements that agree */
#define TOUCHES 1e-9
#define ROUNDING 1e-14

/* One system to solve: statements, then contact rows. */
typedef struct {
  const frot_model *m;
  frot_state *s;
  frot_work *w;
  double t, *q, *v;
  const double *d;
  unsigned char *use; /* per contact: its gap or its normal speed is to be zero */
  int velocity, n;
} problem;

static double *unknown(const problem *p) { return p->velocity ? p->v : p->q; }

/* Residuals (w->residual) and the rows of the Jacobian over L (w->jacobian); sets p->n. */
static int evaluate(problem *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int nv = m->nv, nw = m->nv + m->na + m->nc, n = p->velocity ? m->n_velocity : m->n_position;
  const frot_callable *call = p->velocity ? &m->initial_velocity : &m->initial_position;
  frot_inputs(m, p->s, w, &p->t, p->q, p->v, p->d);
  w->res[0] = w->residual, w->res[1] = w->jacobian, w->res[2] = w->size;
  w->res[3] = w->residual_y;
  call->call(w->arg, w->res, w->iw, w->w, 0);
  frot_kinematics(m, p->s, w, p->t, p->q, p->v, p->d);
  for (int i = 0; i < m->n_contacts; i++) {
    if (!p->use[i]) continue;
    int row = m->contacts[i].row_n;
    w->residual[n] = p->velocity ? w->rate[row] : w->gap[i];
    memcpy(w->jacobian + nv * n, w->rows + nw * row, sizeof(double) * (size_t)nv);
    w->size[n] = fabs(w->residual[n]);
    n++;
  }
  p->n = n;
  double sum = 0;
  for (int i = 0; i < n; i++) sum += w->residual[i] - w->residual[i];
  for (int i = 0; i < n * nv; i++) sum += w->jacobian[i] - w->jacobian[i];
  return sum == 0 ? FROT_OK : FROT_NAN;
}

/* Size of the terms of equation i at the present values. */
static double size_of(const problem *p, int i) {
  double sum = p->w->size[i];
  const double *x = unknown(p);
  for (int k = 0; k < p->m->nv; k++) sum += fabs(p->w->jacobian[p->m->nv * i + k] * x[k]);
  return sum;
}

static int agrees(const problem *p, int i, double before) {
  return fabs(p->w->residual[i]) <= AGREES * fmax(size_of(p, i), before);
}

/* The contradiction: the statement with the largest residual and the one most at odds with it. */
static int contradiction(const problem *p) {
  const frot_model *m = p->m;
  const int *statement = p->velocity ? m->velocity_statement : m->position_statement;
  int own = p->velocity ? m->n_velocity : m->n_position, worst = 0, other = -1, contact = -1;
  for (int i = 1; i < p->n; i++)
    if (fabs(p->w->residual[i]) > fabs(p->w->residual[worst])) worst = i;
  for (int i = 0; i < p->n; i++) {
    if (i == worst || agrees(p, i, 0)) continue;
    if (i < own && worst < own && statement[i] == statement[worst]) continue;
    if (other < 0 || fabs(p->w->residual[i]) > fabs(p->w->residual[other])) other = i;
  }
  int rows[2] = {worst, other}, items[2] = {-1, -1};
  for (int k = 0; k < 2; k++) {
    if (rows[k] < 0) continue;
    if (rows[k] < own) {
      items[k] = statement[rows[k]];
      continue;
    }
    int at = own;
    for (int i = 0; i < m->n_contacts; i++)
      if (p->use[i] && at++ == rows[k]) contact = i;
  }
  if (items[0] < 0) items[0] = items[1], items[1] = -1;
  /* the least-squares solution shares the contradiction out among the equations */
  double apart = fabs(p->w->residual[worst]) + (other < 0 ? 0 : fabs(p->w->residual[other]));
  return frot_fail(p->s, FROT_INITIAL, p->t, contact, items[0], items[1], apart);
}

/* Record that an initial statement, or a load at the start, is no number. */
static int no_number(const problem *p, int status) {
  const frot_model *m = p->m;
  const int *statement = p->velocity ? m->velocity_statement : m->position_statement;
  int own = p->velocity ? m->n_velocity : m->n_position;
  for (int i = 0; i < own && p->n > 0; i++)
    if (!isfinite(p->w->residual[i]))
      return frot_fail(p->s, FROT_INITIAL, p->t, -1, statement[i], -1, NAN);
  return frot_fail(p->s, status, p->t, -1, -1, -1, 0);
}

/* Gauss-Newton to the nearest values in the metric of the mass. */
static int solve(problem *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  frot_layout l = frot_layout_of(m);
  const frot_contact_mode *modes = (const void *)(p->s->data + l.modes);
  int nv = m->nv, nw = m->nv + m->na + m->nc;
  double start = -1, last = INFINITY;
  double *x = unknown(p);
  for (int pass = 0; pass < PASSES; pass++) {
    int status = frot_dynamics(m, p->s, w, p->t, p->q, p->v, p->d, modes);
    if (status == FROT_OK) status = evaluate(p);
    if (status != FROT_OK) return no_number(p, status);
    int good = 1;
    double largest = 0;
    for (int i = 0; i < p->n; i++) {
      largest = fmax(largest, fabs(w->residual[i]));
      if (fabs(w->residual[i]) > 2 * DBL_EPSILON * size_of(p, i)) good = 0;
    }
    if (start < 0) start = largest;
    if (good || p->n == 0) return FROT_OK;
    if (pass > 3 && largest >= last && largest <= AGREES * start) return FROT_OK;
    last = largest;
    /* least y with (L^-1 J')' y = -residual, then x += L'^-1 y */
    double *a = w->active, *b = w->right, *y = w->step;
    for (int i = 0; i < p->n; i++) {
      memcpy(y, w->jacobian + nv * i, sizeof(double) * (size_t)nv);
      frot_forward(w->factor, nw, nv, y);
      for (int k = 0; k < nv; k++) a[k * p->n + i] = y[k];
      b[i] = -w->residual[i];
    }
    frot_least_norm(a, b, p->n, nv, y, w->lstsq, w->pivot);
    frot_backward(w->factor, nw, nv, y);
    double step = 0, size = 0;
    for (int k = 0; k < nv; k++) {
      x[k] += y[k];
      step = fmax(step, fabs(y[k])), size = fmax(size, fabs(x[k]));
    }
    if (step <= 4 * DBL_EPSILON * size || pass == PASSES - 1) {
      if (evaluate(p) != FROT_OK) return frot_fail(p->s, FROT_NAN, p->t, -1, -1, -1, 0);
      for (int i = 0; i < p->n; i++)
        if (!agrees(p, i, start)) return contradiction(p);
      return FROT_OK;
    }
  }
  return FROT_OK;
}

static double length_size(const frot_model *m, const frot_work *w, int contact, const double *q) {
  return fabs(w->distance[contact]) + fabs(w->distance[contact] - w->gap[contact]) +
         frot_row_size(m, w, m->contacts[contact].row_n, q);
}

static void set_conditions(const frot_model *m, const frot_work *w, double *d) {
  for (int j = 0; j < m->n_conditions; j++)
    d[j] = m->condition_strict[j] ? w->condition[j] > 0 : w->condition[j] >= 0;
}

int frot_initial_values(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                        double *v) {
  frot_layout l = frot_layout_of(m);
  int nc = m->n_contacts;
  double *d = s->data + l.d, *side = d + m->n_conditions;
  const double *unilateral = s->data + l.unilateral;
  frot_contact_mode *modes = (void *)(s->data + l.modes);
  unsigned char *use = (unsigned char *)w->choice;
  problem p = {m, s, w, t, q, v, d, use, 0, 0};

  memset(s->data + l.modes, 0, sizeof *modes * (size_t)nc);
  memset(d, 0, sizeof(double) * (size_t)l.nd);
  for (int i = 0; i < nc; i++) side[i] = 1;
  w->arg[0] = &t, w->arg[1] = s->data + l.u, w->arg[2] = s->data + l.p;
  w->res[0] = q, w->res[1] = v, w->res[2] = w->y, w->res[3] = side + nc;
  m->start.call(w->arg, w->res, w->iw, w->w, 0);

  /* Positions by the statements alone show on which side of its line each body is meant to be. */
  memset(use, 0, (size_t)nc);
  int status = solve(&p);
  if (status != FROT_OK) return status;
  frot_kinematics(m, s, w, t, q, v, d);
  for (int i = 0; i < nc; i++)
    side[i] = w->distance[i] < -TOUCHES * length_size(m, w, i, q) ? -1 : 1;
  for (int i = 0; i < nc; i++) use[i] = !m->contacts[i].reduced && unilateral[i] == 0;
  for (;;) {
    status = solve(&p);
    if (status != FROT_OK) return status;
    frot_kinematics(m, s, w, t, q, v, d);
    int added = 0;
    for (int i = 0; i < nc; i++) {
      if (use[i] || m->contacts[i].reduced) continue;
      if (w->gap[i] < -TOUCHES * length_size(m, w, i, q)) use[i] = 1, added = 1;
    }
    if (!added) break;
  }
  set_conditions(m, w, d);

  for (int i = 0; i < nc; i++) {
    int touches =
        unilateral[i] == 0 || use[i] || fabs(w->gap[i]) <= TOUCHES * length_size(m, w, i, q);
    modes[i].closed = (signed char)touches;
    modes[i].side = 1;
    use[i] = touches && unilateral[i] == 0 && !m->contacts[i].reduced;
  }
  p.velocity = 1;
  for (;;) {
    status = solve(&p);
    if (status != FROT_OK) return status;
    frot_kinematics(m, s, w, t, q, v, d);
    int added = 0;
    for (int i = 0; i < nc; i++) {
      int row = m->contacts[i].row_n;
      if (use[i] || m->contacts[i].reduced || !modes[i].closed) continue;
      double size =
          DBL_EPSILON * frot_row_size(m, w, row, v) + ROUNDING * frot_row_speed(m, w, row, v);
      if (w->rate[row] > size)
        modes[i].closed = 0; /* it leaves */
      else if (w->rate[row] < -size)
        use[i] = 1, added = 1;
    }
    if (!added) break;
  }
  set_conditions(m, w, d);
  return FROT_OK;
}
