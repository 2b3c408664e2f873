#include "statements.h"

#include <math.h>
#include <string.h>

#include "blocks.h"
#include "core.h"
#include "inertia.h"
#include "linear.h"
#include "orthogonal.h"
#include "parts.h"
#include "terms.h"
#include "tolerances.h"
#include "turns.h"
#include "ways.h"

/* The statements depend on the unknowns of the blocks too, and these on the states:
 * J <- J - J_y (dr/dy)^-1 dr/dx. */
static int through_blocks(const frot_opening *p, int n) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int early = frot_layout_of(m).early, nx = frot_opening_count(p);
  if (early == 0 || n == 0 || p->direct || !m->block_slopes.call) return FROT_OK;
  double *slopes_q = w->opening.slopes, *slopes_v = slopes_q + m->nq * early;
  double *lu = w->opening.slopes_y, *scale = lu + early * early, *part = scale + 2 * early;
  frot_inputs(m, p->s, w, &p->t, p->q, p->v, p->d);
  w->call.res[0] = part, w->call.res[1] = slopes_q, w->call.res[2] = slopes_v, w->call.res[3] = lu;
  frot_call(w, &m->block_slopes);
  if (!frot_all_finite(lu, early * early) ||
      !frot_all_finite(w->opening.slopes, (m->nq + m->nv) * early))
    return FROT_NAN;
  if (frot_lu(lu, early, w->opening.slopes_pivot, scale)) return FROT_NAN;
  const double *slopes = p->velocity ? slopes_v : slopes_q;
  for (int i = 0; i < n; i++) {
    memcpy(part, w->opening.residual_y + m->ny * i, sizeof(double) * (size_t)early);
    frot_lu_apply(lu, early, w->opening.slopes_pivot, scale, part);
    for (int j = 0; j < early; j++)
      for (int k = 0; part[j] != 0 && k < nx; k++)
        w->relations.jacobian[nx * i + k] -= slopes[nx * j + k] * part[j];
  }
  return FROT_OK;
}

double frot_length_size(const frot_model *m, const frot_work *w, int contact, const double *q) {
  return fabs(w->core.gap[contact]) + w->opening.reach[contact] +
         frot_gap_size(m, w, m->contacts[contact].row_n, q);
}

/* Note between which unknowns the slopes of equation i stand. */
static void bound(const frot_opening *p, int i) {
  int nx = frot_opening_count(p), *bounds = p->w->relations.bounds + 2 * i;
  frot_support(p->w->relations.jacobian + nx * i, nx, &bounds[0], &bounds[1]);
}

/* What unknowns of their usual sizes, at least 1 in SI, change in equation i. An angle that is zero
 * but for rounding leaves that much of it. */
static double reach_of(const frot_opening *p, int i) {
  const int *bounds = p->w->relations.bounds + 2 * i;
  const double *slope = p->w->relations.jacobian + frot_opening_count(p) * i;
  const double *x = frot_opening_unknown(p);
  double sum = 0;
  for (int k = bounds[0]; k < bounds[1]; k++)
    if (slope[k] != 0) sum += fabs(slope[k]) * fmax(fabs(x[k]), 1);
  return sum;
}

/* What equation i could change in a second, were all kinetic energy of the bodies it speaks of in
 * the motion along it: what is stated of a body at rest, in a scene that moves, agrees with the
 * rest of the scene to the digits of that. */
static double speed_along(const frot_opening *p, int i) {
  frot_work *w = p->w;
  const double *row = w->relations.jacobian + frot_opening_count(p) * i;
  double *half = w->core.rest, length = 0, motion = 0;
  for (int k = 0; k < p->m->n_groups; k++) {
    const frot_group *g = &p->m->groups[k];
    int any = 0;
    for (int j = 0; j < g->n_speeds; j++) half[j] = row[g->unknowns[j]], any |= half[j] != 0;
    if (!any) continue;
    frot_inwards(w, g, half);
    length += frot_dot(half, half, g->n_speeds), motion += frot_square_of(w, g, p->v);
  }
  return sqrt(length * motion);
}

int frot_is_still(const frot_opening *p, int i, double reach) {
  return fabs(p->w->relations.residual[i]) <= FROT_MOVED_BY_TIME * (reach + 1);
}

/* Components of one vector are sized together: in axes that stand askew by a rounding, one of them
 * is rounding of the others. */
static void size_vectors(frot_opening *p, const int *statement, int n) {
  double *size = p->w->relations.size;
  for (int first = 0, end; first < n; first = end) {
    double largest = 0;
    for (end = first; end < n && statement[end] == statement[first]; end++)
      largest = fmax(largest, size[end]);
    for (int i = first; i < end; i++) size[i] = largest;
  }
}

/* What speeds are to meet in singular postures, as equations from n on; returns their end. */
static int append_ways(const frot_opening *p, int n) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  const frot_contact_mode *modes = (const void *)(p->s->data + w->layout.modes);
  if (frot_dynamics(m, p->s, w, p->t, p->q, p->v, p->d, modes, FROT_INERTIA) != FROT_OK) return n;
  for (int k = 0; k < m->n_groups; k++) {
    const frot_group *g = &m->groups[k];
    int count = frot_find_ways(m, p->s, w, g, p->t, p->q, p->v, p->d);
    for (int i = 0; i < count; i++, n++) {
      double *row = w->linear.scratch + g->n_speeds * i, *whole = w->core.column;
      double *equation = w->relations.jacobian + m->nv * n;
      frot_outwards(w, g, row);
      frot_momenta(w, g, row, whole);
      memset(equation, 0, sizeof(double) * (size_t)m->nv);
      for (int j = 0; j < g->n_speeds; j++) equation[g->unknowns[j]] = whole[j];
      w->relations.residual[n] = w->linear.right[i];
      w->relations.size[n] = fabs(w->linear.right[i]);
      w->opening.row_part[n] = 0;
      bound(p, n);
    }
  }
  return n;
}

/* Whether equation i is a statement of the text, and none of what holds at any time. */
static int is_of_start(const frot_opening *p, int i) {
  const int *statement = p->velocity ? p->m->velocity_statement : p->m->position_statement;
  return statement[i] >= 0 && statement[i] < p->m->n_statements - p->m->n_invariants;
}

int frot_evaluate_statements(frot_opening *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int nx = frot_opening_count(p);
  int n = p->velocity ? m->n_velocity : m->n_position;
  const frot_callable *call = p->velocity ? &m->initial_velocity : &m->initial_position;
  p->n = 0;
  int status = frot_kinematics(m, p->s, w, p->t, p->q, p->v, p->d);
  if (status != FROT_OK) return status;
  if (n > 0) {
    frot_inputs(m, p->s, w, &p->t, p->q, p->v, p->d);
    w->call.res[0] = w->relations.residual, w->call.res[1] = w->relations.jacobian,
    w->call.res[2] = w->relations.size;
    w->call.res[3] = w->opening.residual_y;
    frot_call(w, call);
    status = through_blocks(p, n);
    if (status != FROT_OK) return status;
    size_vectors(p, p->velocity ? m->velocity_statement : m->position_statement, n);
    /* slopes that are rounding of what cancels out tell no way */
    for (int i = 0; i < n; i++) {
      bound(p, i);
      w->opening.row_part[i] = p->velocity ? 0 : m->position_part[i];
      if (p->direct && !m->position_direct[i]) w->opening.row_part[i] = FROT_NO_PART;
      if (p->timeless && is_of_start(p, i)) w->opening.row_part[i] = FROT_NO_PART;
      if (reach_of(p, i) <= FROT_CONSTANT * w->relations.size[i])
        memset(w->relations.jacobian + nx * i, 0, sizeof(double) * (size_t)nx);
    }
  }
  for (int i = 0; i < m->n_contacts; i++) {
    if (!p->use[i] || (m->contacts[i].kinematic && !p->velocity)) continue;
    int row = m->contacts[i].row_n;
    const frot_group *group = frot_group_of(m, row);
    const double *entries = frot_entries(m, w->core.rows, row);
    double *equation = w->relations.jacobian + nx * n;
    w->relations.residual[n] = p->velocity ? w->core.rate[row] : w->core.gap[i];
    memset(equation, 0, sizeof(double) * (size_t)nx);
    for (int k = 0; p->velocity && k < group->n_speeds; k++)
      equation[group->unknowns[k]] = entries[k];
    if (!p->velocity) frot_over_coordinates(m, group, entries, p->q, equation);
    w->relations.size[n] =
        p->velocity ? fabs(w->relations.residual[n]) : frot_length_size(m, w, i, p->q);
    double steepest = 0;
    for (int k = 0; k < nx; k++) steepest = fmax(steepest, fabs(equation[k]));
    if (steepest <= FROT_CONSTANT * w->opening.reach[i]) {
      /* the lengths cancel out: no unknown moves this gap, and none is moved for it */
      memset(equation, 0, sizeof(double) * (size_t)nx);
      if (p->velocity && frot_is_still(p, n, w->opening.reach[i]))
        w->relations.residual[n] = w->relations.size[n] = 0;
    }
    w->opening.row_part[n] = m->contact_part[i];
    bound(p, n++);
  }
  int guesses = 0;
  if ((p->guessed || p->aim) && !p->velocity) {
    frot_inputs(m, p->s, w, &p->t, p->q, p->v, p->d);
    w->call.res[0] = w->relations.residual + n, w->call.res[1] = w->relations.jacobian + nx * n;
    w->call.res[2] = w->relations.size + n;
    frot_call(w, &m->guessed);
    for (int i = 0; i < m->n_guessed; i++) {
      w->opening.row_part[n + i] = m->guess_part[i];
      bound(p, n + i);
    }
    if (p->guessed)
      n += m->n_guessed;
    else
      guesses = m->n_guessed;
  }
  if (p->ways && p->velocity) n = append_ways(p, n);
  for (int i = 0; i < n && p->left > 0; i++)
    w->relations.residual[i] -= p->left * w->opening.left[i];
  p->n = n;
  frot_leave_others(p, n + guesses);
  n += guesses;
  int finite =
      frot_all_finite(w->relations.residual, n) && frot_all_finite(w->relations.jacobian, n * nx);
  return finite ? FROT_OK : FROT_NAN;
}

void frot_begin_values(const frot_opening *p, double *v, double *y) {
  frot_work *w = p->w;
  frot_inputs(p->m, p->s, w, &p->t, p->q, p->v, p->d);
  w->call.res[0] = v ? v : w->opening.scratch, w->call.res[1] = w->opening.fresh;
  frot_call(w, &p->m->beginning);
  for (int k = 0; k < p->m->ny && y; k++)
    if (p->m->y_part[k] < 0 || frot_is_of_part(p, p->m->y_part[k])) y[k] = w->opening.fresh[k];
}

void frot_take_liaisons(const frot_opening *p) {
  const frot_model *m = p->m;
  const double *unilateral = p->s->data + frot_layout_of(m).unilateral;
  for (int i = 0; i < m->n_contacts; i++)
    if (frot_is_of_part(p, m->contact_part[i]))
      p->use[i] = frot_has_normal(&m->contacts[i]) && !m->contacts[i].reduced && unilateral[i] == 0;
}

double frot_statement_size(const frot_opening *p, int i) {
  double sum = p->w->relations.size[i];
  const int *bounds = p->w->relations.bounds + 2 * i;
  const double *x = frot_opening_unknown(p);
  const double *slope = p->w->relations.jacobian + frot_opening_count(p) * i;
  for (int k = bounds[0]; k < bounds[1]; k++) sum += fabs(slope[k] * x[k]);
  return sum;
}

int frot_only_unknown(const frot_opening *p, int i) {
  const int *bounds = p->w->relations.bounds + 2 * i;
  int nx = frot_opening_count(p), only = -1;
  for (int k = bounds[0]; k < bounds[1]; k++) {
    if (p->w->relations.jacobian[nx * i + k] == 0) continue;
    if (only >= 0) return -1;
    only = k;
  }
  return only;
}

int frot_statement_agrees(const frot_opening *p, int i, double before) {
  double off = fabs(p->w->relations.residual[i]);
  return off <= FROT_AGREES * fmax(frot_statement_size(p, i), before) ||
         off <= FROT_NO_DIGIT * reach_of(p, i) ||
         (p->velocity && off <= FROT_AGREES * speed_along(p, i));
}

/* The equation that is missed by most, beside equation `beside` (-1: none) and what says the same
 * statement; of the text and of contacts, or of neither. -1 where there is none. */
static int most_missed(const frot_opening *p, int beside, int of_text) {
  const int *statement = p->velocity ? p->m->velocity_statement : p->m->position_statement;
  int own = p->velocity ? p->m->n_velocity : p->m->n_position, most = -1;
  const double *residual = p->w->relations.residual;
  for (int i = 0; i < p->n; i++) {
    if (i == beside || (i >= own || statement[i] >= 0) != of_text) continue;
    if (beside >= 0 && frot_statement_agrees(p, i, 0)) continue;
    if (beside >= 0 && i < own && beside < own && statement[i] == statement[beside]) continue;
    if (most < 0 || fabs(residual[i]) > fabs(residual[most])) most = i;
  }
  return most;
}

int frot_contradiction(const frot_opening *p) {
  const frot_model *m = p->m;
  const int *statement = p->velocity ? m->velocity_statement : m->position_statement;
  int own = p->velocity ? m->n_velocity : m->n_position, contact = -1;
  int worst = most_missed(p, -1, 1), other = most_missed(p, worst, 1);
  if (worst < 0) worst = most_missed(p, -1, 0);
  /* what keeps a quaternion a turn is told beside a statement alone, not beside a liaison */
  if (other < 0 && worst < own) other = most_missed(p, worst, 0);
  int rows[2] = {worst, other}, items[2] = {-1, -1};
  for (int k = 0; k < 2; k++) {
    if (rows[k] < 0) continue;
    if (rows[k] < own) {
      int s = statement[rows[k]];
      items[k] = s < 0 ? ~s : s;
      continue;
    }
    int at = own;
    for (int i = 0; i < m->n_contacts; i++)
      if (p->use[i] && !(m->contacts[i].kinematic && !p->velocity) && at++ == rows[k]) contact = i;
  }
  if (items[0] < 0) items[0] = items[1], items[1] = -1;
  /* without statements bodies could rest, but for what time moves */
  for (int i = 0; i < own && items[0] < 0 && p->velocity; i++)
    if (statement[i] >= 0 && !frot_statement_agrees(p, i, 0)) items[0] = statement[i];
  if (items[0] < 0 && p->velocity) items[1] = -2;
  /* the least-squares solution shares the contradiction out among the equations */
  double apart = fabs(p->w->relations.residual[worst]) +
                 (other < 0 ? 0 : fabs(p->w->relations.residual[other]));
  return frot_fail(p->s, FROT_INITIAL, p->t, contact, items[0], items[1], apart);
}

int frot_no_number(const frot_opening *p, int status) {
  const frot_model *m = p->m;
  const int *statement = p->velocity ? m->velocity_statement : m->position_statement;
  int own = p->velocity ? m->n_velocity : m->n_position;
  for (int i = 0; i < own && p->n > 0 && status == FROT_NAN; i++)
    if (statement[i] >= 0 && !isfinite(p->w->relations.residual[i]))
      return frot_fail(p->s, FROT_INITIAL, p->t, -1, statement[i], -1, NAN);
  return frot_fail_evaluation(p->m, p->s, p->w, status, p->t);
}

void frot_clear_opening(const frot_opening *p) {
  p->s->fault = frot_no_fault(p->t);
  p->s->phase = FROT_CLEARED;
}
