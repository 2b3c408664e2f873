#include "assembly/start_equations.h"

#include <math.h>
#include <string.h>

#include "evaluation/fault_source.h"
#include "evaluation/algebraic_loops.h"
#include "evaluation/evaluate.h"
#include "inertia/mass_matrix.h"
#include "numerics/dense.h"
#include "numerics/basis.h"
#include "assembly/start_parts.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"
#include "evaluation/quaternions.h"
#include "singular/tangent_cone.h"

/* The statements depend on the unknowns of the blocks too, and these on the states:
 * J <- J - J_y (dr/dy)^-1 dr/dx. */
static int through_blocks(const frot_opening *p, int n) {
  const frot_part *part = p->part;
  frot_work *w = p->w;
  int own = part->n_own, nx = p->n_own;
  if (own == 0 || n == 0 || p->direct || !part->slopes.call) return FROT_OK;
  double *slopes = w->opening.slopes, *lu = w->opening.slopes_y;
  double *scale = lu + own * own, *by = scale + 2 * own;
  w->call.res[0] = slopes, w->call.res[1] = lu;
  frot_evaluate_part(p, &part->slopes);
  if (!frot_all_finite(lu, own * own) || !frot_all_finite(slopes, nx * own)) return FROT_NAN;
  if (frot_lu(lu, own, 1, w->opening.slopes_pivot, scale)) return FROT_NAN;
  for (int i = 0; i < n; i++) {
    memcpy(by, w->opening.residual_y + own * i, sizeof(double) * (size_t)own);
    frot_lu_apply(lu, own, w->opening.slopes_pivot, scale, by);
    for (int j = 0; j < own; j++)
      for (int k = 0; by[j] != 0 && k < nx; k++)
        w->relations.jacobian[nx * i + k] -= slopes[nx * j + k] * by[j];
  }
  return FROT_OK;
}

double frot_length_size(const frot_model *m, const frot_work *w, int contact, const double *q) {
  return fabs(w->core.gap[contact]) + w->opening.reach[contact] +
         frot_gap_size(m, w, m->contacts[contact].row_n, q);
}

/* Note between which unknowns the slopes of equation i stand. */
static void bound(const frot_opening *p, int i) {
  int nx = p->n_own, *bounds = p->w->relations.bounds + 2 * i;
  frot_support(p->w->relations.jacobian + nx * i, nx, &bounds[0], &bounds[1]);
}

/* What unknowns of their usual sizes, at least 1 in SI, change in equation i. An angle that is zero
 * but for rounding leaves that much of it. */
static double reach_of(const frot_opening *p, int i) {
  const int *bounds = p->w->relations.bounds + 2 * i;
  const double *slope = p->w->relations.jacobian + p->n_own * i;
  double sum = 0;
  for (int k = bounds[0]; k < bounds[1]; k++)
    if (slope[k] != 0) sum += fabs(slope[k]) * fmax(fabs(p->x[k]), 1);
  return sum;
}

/* What equation i could change in a second, were all kinetic energy of the bodies it speaks of in
 * the motion along it: what is stated of a body at rest, in a scene that moves, agrees with the
 * rest of the scene to the digits of that. */
static double speed_along(const frot_opening *p, int i) {
  frot_work *w = p->w;
  const double *row = w->relations.jacobian + p->n_own * i;
  double *half = w->core.rest, length = 0, motion = 0;
  for (int k = 0; k < p->part->n_groups; k++) {
    const frot_group *g = &p->m->groups[p->part->groups[k]];
    int any = 0;
    for (int j = 0; j < g->n_speeds; j++)
      half[j] = row[frot_number_here(p, g->unknowns[j])], any |= half[j] != 0;
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
static void size_vectors(frot_opening *p, int n) {
  double *size = p->w->relations.size;
  for (int first = 0, end; first < n; first = end) {
    double largest = 0;
    int own = frot_statement_of(p, first);
    for (end = first; end < n && frot_statement_of(p, end) == own; end++)
      largest = fmax(largest, size[end]);
    for (int i = first; i < end; i++) size[i] = largest;
  }
}

/* The size of the terms in which the unknowns of statement i cancel out. All of a residual of
 * velocities that nothing moves yet is what is stated. */
static double terms_of(const frot_opening *p, int i) {
  const double *off = p->w->relations.residual;
  int own = frot_statement_of(p, i), first = i;
  double stated = 0;
  while (first > 0 && frot_statement_of(p, first - 1) == own) first--;
  for (int k = first; p->velocity && k < p->part->n_stated && frot_statement_of(p, k) == own; k++)
    stated = fmax(stated, fabs(off[k]));
  return p->w->relations.size[i] - stated;
}

/* What speeds are to meet in singular postures, as equations from n on; returns their end. */
static int append_ways(const frot_opening *p, int n) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  const frot_contact_mode *modes = (const void *)(p->s->data + w->layout.modes);
  if (frot_dynamics(m, p->s, w, p->t, p->q, p->v, p->d, modes, FROT_INERTIA) != FROT_OK) return n;
  for (int k = 0; k < p->part->n_groups; k++) {
    const frot_group *g = &m->groups[p->part->groups[k]];
    int count = frot_find_branches(m, p->s, w, g, p->t, p->q, p->v, p->d);
    for (int i = 0; i < count; i++, n++) {
      double *row = w->linear.scratch + g->n_speeds * i, *whole = w->core.column;
      double *equation = w->relations.jacobian + p->n_own * n;
      frot_outwards(w, g, row);
      frot_momenta(w, g, row, whole);
      memset(equation, 0, sizeof(double) * (size_t)p->n_own);
      for (int j = 0; j < g->n_speeds; j++)
        equation[frot_number_here(p, g->unknowns[j])] = whole[j];
      w->relations.residual[n] = w->linear.right[i];
      w->relations.size[n] = fabs(w->linear.right[i]);
      bound(p, n);
    }
  }
  return n;
}

/* Whether equation i, a statement, is left out. */
static int is_left_out(const frot_opening *p, int i) {
  int statement = frot_statement_of(p, i);
  int kind = p->velocity ? FROT_PLAIN : p->m->position_kind[p->part->stated[i]];
  if (p->fewest && kind == FROT_OPTIONAL) return 1;
  if (p->unbalanced && (kind == FROT_BALANCE || kind == FROT_OPTIONAL)) return 1;
  if (p->direct && !p->m->position_direct[p->part->stated[i]]) return 1;
  return p->timeless && statement >= 0 && statement < p->m->n_statements - p->m->n_invariants;
}

/* The statements. */
static int evaluate_stated(frot_opening *p) {
  frot_work *w = p->w;
  frot_relation_work *r = &w->relations;
  int nx = p->n_own, n = p->part->n_stated;
  w->call.res[0] = r->residual, w->call.res[1] = r->jacobian, w->call.res[2] = r->size;
  w->call.res[3] = w->opening.residual_y;
  frot_evaluate_part(p, &p->part->stating);
  int status = through_blocks(p, n);
  if (status != FROT_OK) return status;
  size_vectors(p, n);
  for (int i = 0; i < n; i++) {
    double *row = r->jacobian + nx * i;
    bound(p, i);
    w->opening.left_out[i] = (unsigned char)is_left_out(p, i);
    if (w->opening.left_out[i]) r->residual[i] = r->size[i] = 0;
    /* slopes that are rounding of what cancels out tell no way */
    if (w->opening.left_out[i] || reach_of(p, i) <= FROT_CONSTANT * terms_of(p, i))
      memset(row, 0, sizeof(double) * (size_t)nx);
  }
  return FROT_OK;
}

/* row <- that over the unknowns which gives every displacement of a group what `entries`, over its
 * speeds, give it. It is orthogonal to each quaternion itself. */
static void over_unknowns(const frot_opening *p, int group, const double *entries, double *row) {
  const frot_model *m = p->m;
  const frot_group *g = &m->groups[group];
  memset(row, 0, sizeof(double) * (size_t)p->n_own);
  for (int i = 0; i < g->n_speeds; i++) {
    int speed = g->unknowns[i], own = p->velocity ? speed : m->speed_coordinate[speed];
    if (own >= 0) row[frot_number_here(p, own)] = entries[i];
  }
  for (int i = 0; i < p->part->n_turns && !p->velocity; i++) {
    const frot_turn *turn = &p->w->opening.turns[i];
    if (m->speed_group[turn->speed[2]] == group)
      frot_over_turn(m, turn, entries, p->x + turn->at, row + turn->at);
  }
}

int frot_is_follower(const frot_opening *p, int i) {
  if (p->velocity || i >= p->part->n_stated) return 0;
  if (p->m->position_kind[p->part->stated[i]] != FROT_COUNTER) return 0;
  int counter = frot_only_unknown(p, i);
  for (int k = 0; k < p->n && counter >= 0; k++)
    if (k != i && p->w->relations.jacobian[p->n_own * k + counter] != 0) return 0;
  return 1;
}

int frot_are_items(const frot_opening *p, int i, int k) {
  const frot_part *part = p->part;
  const int *contact = p->w->opening.contact_of;
  int own = part->n_stated, guesses = own + p->n_contacts;
  if (i == k) return 1;
  if (i < own || k < own)
    return i < own && k < own && frot_statement_of(p, i) == frot_statement_of(p, k);
  if (i < guesses && k < guesses) return frot_are_alike(p, contact[i - own], contact[k - own]);
  if (i < guesses || k < guesses || !p->guessed) return 0;
  return part->vectors[i - guesses] == part->vectors[k - guesses];
}

/* The contact i as equation n. */
static void append_contact(frot_opening *p, int i, int n) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  frot_relation_work *r = &w->relations;
  int row = m->contacts[i].row_n, nx = p->n_own;
  double *equation = r->jacobian + nx * n, steepest = 0;
  r->residual[n] = p->velocity ? w->core.rate[row] : w->core.gap[i];
  over_unknowns(p, m->row_group[row], frot_entries(m, w->core.rows, row), equation);
  r->size[n] = p->velocity ? fabs(r->residual[n]) : frot_length_size(m, w, i, p->q);
  for (int k = 0; k < nx; k++) steepest = fmax(steepest, fabs(equation[k]));
  if (steepest <= FROT_CONSTANT * w->opening.reach[i]) {
    /* the lengths cancel out: no unknown moves this gap, and none is moved for it */
    memset(equation, 0, sizeof(double) * (size_t)nx);
    if (p->velocity && frot_is_still(p, n, w->opening.reach[i])) r->residual[n] = r->size[n] = 0;
  }
  bound(p, n);
}

int frot_evaluate_statements(frot_opening *p) {
  const frot_part *part = p->part;
  frot_work *w = p->w;
  int nx = p->n_own, n = part->n_stated, guesses = 0;
  p->n = p->n_rows = 0;
  int status = frot_look_at_part(p);
  if (status == FROT_OK && n > 0) status = evaluate_stated(p);
  if (status != FROT_OK) return status;
  for (int i = 0; i < n; i++)
    if (!w->opening.left_out[i]) w->opening.rows[p->n_rows++] = i;
  for (int i = 0; i < part->n_contacts; i++)
    if (frot_is_equation(p, part->contacts[i])) {
      w->opening.contact_of[n - part->n_stated] = part->contacts[i];
      append_contact(p, part->contacts[i], n++);
    }
  p->n_contacts = n - part->n_stated;
  if ((p->guessed || p->aim) && !p->velocity && part->n_guessed > 0) {
    w->call.res[0] = w->relations.residual + n, w->call.res[1] = w->relations.jacobian + nx * n;
    w->call.res[2] = w->relations.size + n;
    frot_evaluate_part(p, &part->guessing);
    for (int i = 0; i < part->n_guessed; i++) bound(p, n + i);
    *(p->guessed ? &n : &guesses) += part->n_guessed;
  }
  if (p->ways && p->velocity) n = append_ways(p, n);
  for (int i = 0; i < n && p->left > 0; i++)
    w->relations.residual[i] -= p->left * w->opening.left[i];
  for (int i = part->n_stated; i < n; i++) w->opening.rows[p->n_rows++] = i;
  p->n = n, n += guesses;
  int finite =
      frot_all_finite(w->relations.residual, n) && frot_all_finite(w->relations.jacobian, n * nx);
  return finite ? FROT_OK : FROT_NAN;
}

void frot_begin_blocks(const frot_opening *p) {
  frot_work *w = p->w;
  const frot_part *part = p->part;
  if (part->ny == 0) return;
  frot_put(p);
  frot_inputs(p->s, w, &p->t, p->q, p->v, p->d);
  w->call.res[0] = w->opening.scratch, w->call.res[1] = w->opening.fresh;
  w->call.res[2] = w->core.condition;
  frot_call(w, &p->m->beginning);
  for (int k = 0; k < part->ny; k++) w->blocks.y[part->y[k]] = w->opening.fresh[part->y[k]];
}

void frot_take_liaisons(const frot_opening *p) {
  const frot_model *m = p->m;
  const double *unilateral = p->s->data + p->w->layout.unilateral;
  for (int k = 0; k < p->part->n_contacts; k++) {
    int i = p->part->contacts[k];
    p->use[i] = frot_has_normal(&m->contacts[i]) && !m->contacts[i].reduced && unilateral[i] == 0;
  }
}

double frot_statement_size(const frot_opening *p, int i) {
  double sum = p->w->relations.size[i];
  const int *bounds = p->w->relations.bounds + 2 * i;
  const double *slope = p->w->relations.jacobian + p->n_own * i;
  for (int k = bounds[0]; k < bounds[1]; k++) sum += fabs(slope[k] * p->x[k]);
  return sum;
}

int frot_only_unknown(const frot_opening *p, int i) {
  const int *bounds = p->w->relations.bounds + 2 * i;
  int nx = p->n_own, only = -1;
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
 * statement; of the text and of contacts, or of neither; by more than rounding unless `rounding`.
 * -1 where there is none. */
static int most_missed(const frot_opening *p, int beside, int of_text, int rounding) {
  int own = p->part->n_stated, most = -1;
  const double *residual = p->w->relations.residual;
  for (int i = 0; i < p->n; i++) {
    if (i == beside || (i >= own || frot_statement_of(p, i) >= 0) != of_text) continue;
    if (!rounding && frot_statement_agrees(p, i, 0)) continue;
    if (beside >= 0 && i < own && beside < own &&
        frot_statement_of(p, i) == frot_statement_of(p, beside))
      continue;
    if (most < 0 || fabs(residual[i]) > fabs(residual[most])) most = i;
  }
  return most;
}

/* What contacts are missed by where the statements hold, over what they are missed by here. The
 * least squares sum of (w r)^2 has no slope: of the change d that puts the statements right,
 * J_s d = -r_s, sum over contacts of w^2 g (J_g d) = sum over statements of (w r)^2. So contacts
 * are missed there by g + J_g d, in one ratio to g where there is one or all are missed alike. */
static double unshared(const frot_opening *p) {
  double of_contacts = 0, of_all = 0;
  for (int i = 0; i < p->n; i++) {
    double change = p->w->relations.residual[i] * p->w->opening.row_weight[i];
    of_all += change * change;
    if (i >= p->part->n_stated) of_contacts += change * change;
  }
  return of_contacts > 0 ? of_all / of_contacts : 1;
}

int frot_contradiction(const frot_opening *p) {
  int own = p->part->n_stated, contact = -1;
  int worst = most_missed(p, -1, 1, 0);
  if (worst < 0) worst = most_missed(p, -1, 0, 0);
  for (int of_text = 1; of_text >= 0 && worst < 0; of_text--)
    worst = most_missed(p, -1, of_text, 1);
  int other = most_missed(p, worst, 1, 0);
  /* what keeps a quaternion a turn is told beside a statement alone, not beside a liaison */
  if (other < 0 && worst < own) other = most_missed(p, worst, 0, 0);
  int rows[2] = {worst, other}, items[2] = {-1, -1};
  double off[2] = {0, 0}, gap = 0;
  for (int k = 0; k < 2; k++) {
    if (rows[k] < 0) continue;
    off[k] = fabs(p->w->relations.residual[rows[k]]);
    if (rows[k] < own) {
      int s = frot_statement_of(p, rows[k]);
      items[k] = s < 0 ? ~s : s;
      continue;
    }
    if (rows[k] < own + p->n_contacts)
      contact = p->w->opening.contact_of[rows[k] - own], gap = off[k];
  }
  if (items[0] < 0) items[0] = items[1], items[1] = -1;
  /* without statements bodies could rest, but for what time moves */
  for (int i = 0; i < own && items[0] < 0 && p->velocity; i++)
    if (frot_statement_of(p, i) >= 0 && !frot_statement_agrees(p, i, 0))
      items[0] = frot_statement_of(p, i);
  if (items[0] < 0 && p->velocity) items[1] = -2;
  /* the least-squares solution shares the contradiction out among equations of one unit */
  const frot_statement *told = p->m->statements;
  int alike = items[1] >= 0 && strcmp(told[items[0]].unit, told[items[1]].unit) == 0;
  double apart = contact >= 0 ? gap * unshared(p) : alike ? off[0] + off[1] : off[0];
  return frot_fail(p->s, FROT_INITIAL, p->t, contact, items[0], items[1], apart);
}

int frot_no_number(const frot_opening *p, int status) {
  for (int i = 0; i < p->part->n_stated && p->n > 0 && status == FROT_NAN; i++)
    if (frot_statement_of(p, i) >= 0 && !isfinite(p->w->relations.residual[i]))
      return frot_fail(p->s, FROT_INITIAL, p->t, -1, frot_statement_of(p, i), -1, NAN);
  return frot_fail_evaluation(p->m, p->s, p->w, status, p->t);
}

void frot_clear_opening(const frot_opening *p) {
  p->s->fault = frot_no_fault(p->t);
  p->s->phase = FROT_CLEARED;
}
