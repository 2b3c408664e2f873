#include "linearize.h"

#include <math.h>
#include <string.h>

#include "core.h"
#include "inertia.h"
#include "linear.h"
#include "mechanics.h"
#include "reactions.h"
#include "spare.h"

/* Lines of the generated derivatives, in the order of frot.h. */
typedef struct {
  int rates, balance, motion, law, residual, count;
  int columns; /* q, v, y */
} lines;

static lines lines_of(const frot_model *m) {
  int early = frot_layout_of(m).early;
  lines l = {.columns = m->nq + m->nv + early};
  l.balance = m->nq;
  l.motion = l.balance + m->nv + m->na + m->nc;
  l.law = l.motion + m->n_rows;
  l.residual = l.law + 2 * m->n_elements;
  l.count = l.residual + early;
  return l;
}

/* The largest system of a group: its equations and its unknowns. */
static void extent_of(const frot_model *m, int *equations, int *unknowns) {
  *equations = *unknowns = 0;
  for (int k = 0; k < m->n_groups; k++) {
    const frot_group *g = &m->groups[k];
    int rows = g->n + 2 * g->n_rows, columns = g->n + g->n_rows;
    if (rows > *equations) *equations = rows;
    if (columns > *unknowns) *unknowns = columns;
  }
}

static double *take(double *base, size_t *used, int count) {
  double *at = base ? base + *used : NULL;
  *used += (size_t)count;
  return at;
}

frot_linearize_work frot_linearize_scratch(const frot_model *m, double *doubles, int *integers,
                                           size_t *n_doubles, size_t *n_integers) {
  lines l = lines_of(m);
  int rows, columns;
  extent_of(m, &rows, &columns);
  size_t used = 0;
  frot_linearize_work w;
  int early = frot_layout_of(m).early;
  w.rates = take(doubles, &used, (m->nq + m->nv) * l.columns);
  w.residual = take(doubles, &used, early * l.columns);
  w.entries = take(doubles, &used, m->pattern.entries > 0 ? m->pattern.entries : l.columns);
  w.partial = take(doubles, &used, l.count * l.columns);
  w.matrix = take(doubles, &used, rows * columns);
  w.lu = take(doubles, &used, rows * columns);
  w.right = take(doubles, &used, rows * l.columns);
  w.least = take(doubles, &used, rows + (rows > columns ? rows : columns) * (columns + 6));
  w.scale = take(doubles, &used, 2 * columns);
  w.pivot = integers;
  w.unknown = integers ? integers + columns : NULL;
  *n_doubles = used, *n_integers = (size_t)(columns + m->n_rows);
  return w;
}

/* The system of one group. Unknowns: those of the group, with readings in the places of auxiliary
 * ones, then the reactions that are not known; unknown[i]: the place of the reaction of its row i,
 * or -1. Columns of the matrix have `rows` items, the most there may be. */
typedef struct {
  const frot_model *m;
  frot_work *w;
  const frot_group *g;
  const frot_contact_mode *modes;
  const frot_linearize_work *scratch;
  lines l;
  int rows, equations, unknowns;
} problem;

static double *entry(const problem *p, int equation, int unknown) {
  return p->scratch->matrix + (size_t)unknown * (size_t)p->rows + equation;
}

static double *right_of(const problem *p, int column) {
  return p->scratch->right + (size_t)column * (size_t)p->rows;
}

static const double *partial_of(const problem *p, int line, int column) {
  return p->scratch->partial + (size_t)column * (size_t)p->l.count + line;
}

/* Whether the row is left to others that it depends on. */
static int is_left(const problem *p, int row) {
  return !p->g->general && p->w->reactions.carried[row];
}

/* The element of a row, or -1 for the row of a normal. */
static int element_of(const problem *p, int row) {
  for (int i = 0; i < p->g->n_elements; i++)
    if (p->m->elements[p->g->elements[i]].row == row) return p->g->elements[i];
  return -1;
}

static int contact_of(const problem *p, int row) {
  for (int i = 0; i < p->g->n_contacts; i++)
    if (p->m->contacts[p->g->contacts[i]].row_n == row) return p->g->contacts[i];
  return -1;
}

/* Sign and coefficient (0: of motion, 1: of rest) with which the friction of an element follows
 * what bounds it; 0 where it does not. */
static int follows(const problem *p, int e, int *which) {
  const frot_contact_mode *contact = &p->modes[p->m->elements[e].contact];
  const frot_contact_mode *mode = frot_element_mode(p->m, p->modes, e);
  *which = 0;
  if (!contact->closed || contact->unloaded) return 0;
  if (mode->friction == FROT_STICK) {
    *which = 1;
    return mode->at_bound * contact->side;
  }
  if (mode->friction == FROT_SLIP_FORWARD) return -contact->side;
  return mode->friction == FROT_SLIP_BACKWARD ? contact->side : 0;
}

/* Whether a row does not accelerate, by a reaction of its own or without. */
static int is_kept(const problem *p, int row, int element) {
  const frot_model *m = p->m;
  int contact = element < 0 ? contact_of(p, row) : m->elements[element].contact;
  if (contact < 0 || !p->modes[contact].closed) return 0;
  if (element < 0) return !m->contacts[contact].reduced;
  return frot_element_mode(m, p->modes, element)->friction == FROT_STICK &&
         !m->elements[element].prescribed;
}

/* Number the reactions that are unknown. */
static void number_unknowns(problem *p) {
  const frot_group *g = p->g;
  p->unknowns = g->n;
  for (int i = 0; i < g->n_rows; i++) {
    int row = g->rows[i], e = element_of(p, row), which, own;
    p->scratch->unknown[i] = -1;
    if (frot_is_reading(p->m, row) || is_left(p, row)) continue;
    if (e < 0) {
      int contact = contact_of(p, row);
      own = contact >= 0 && frot_is_loaded(p->m, p->modes, contact);
    } else {
      own = frot_is_held(p->m, p->modes, e) || follows(p, e, &which) != 0;
    }
    if (own) p->scratch->unknown[i] = p->unknowns++;
  }
}

/* A z - E lam = h, for the unknowns of the group. */
static void balance(problem *p) {
  const frot_group *g = p->g;
  frot_work *w = p->w;
  int n = g->n;
  for (int k = 0; k < n; k++) {
    double *column = entry(p, 0, k);
    frot_whole_column(w, g, k, column);
    int auxiliary = k >= g->n_speeds && k < g->n_speeds + g->n_auxiliary;
    if (!auxiliary || g->general) continue;
    memset(column, 0, sizeof(double) * (size_t)n);
    column[k] = -1;
  }
  for (int i = 0; i < g->n_rows; i++) {
    int at = p->scratch->unknown[i];
    if (at < 0) continue;
    const double *effect = (g->general ? w->core.effect : w->core.rows) + g->entries + i * n;
    for (int k = 0; k < n; k++) *entry(p, k, at) = -effect[k];
  }
  for (int c = 0; c < p->l.columns; c++)
    for (int k = 0; k < n; k++)
      right_of(p, c)[k] = -*partial_of(p, p->l.balance + g->unknowns[k], c);
  p->equations = n;
}

/* J z + c = 0. */
static void keep(problem *p, int i) {
  const frot_group *g = p->g;
  int line = p->equations++, row = g->rows[i], after = g->n_speeds + g->n_auxiliary;
  const double *own = p->w->core.rows + g->entries + i * g->n;
  for (int k = 0; k < g->n; k++)
    if (k < g->n_speeds || k >= after) *entry(p, line, k) = own[k];
  for (int c = 0; c < p->l.columns; c++)
    right_of(p, c)[line] = -*partial_of(p, p->l.motion + row, c);
}

/* Takes `by` times the derivative of the reaction of a row from the equation `line`. */
static void take_reaction(problem *p, int line, int row, double by) {
  int local = p->m->row_local[row], reads = p->m->row_reads[row];
  int at = reads >= 0 ? reads : p->scratch->unknown[local];
  if (at >= 0) *entry(p, line, at) -= by;
}

/* lam = ratio * bounding. */
static void follow(problem *p, int i, int e, int sign, int which) {
  const frot_element *element = &p->m->elements[e];
  const double *lam = p->w->core.lam;
  int line = p->equations++;
  double ratio = sign * p->w->core.coefficient[2 * e + which], bounding = 1;
  *entry(p, line, p->scratch->unknown[i]) = 1;
  if (element->bound == FROT_BY_NORMAL) {
    bounding = lam[element->bounded_by[0]];
    take_reaction(p, line, element->bounded_by[0], ratio);
  } else if (element->bound == FROT_BY_PIN) {
    double first = lam[element->bounded_by[0]], second = lam[element->bounded_by[1]];
    bounding = hypot(first, second);
    if (bounding > 0) {
      take_reaction(p, line, element->bounded_by[0], ratio * first / bounding);
      take_reaction(p, line, element->bounded_by[1], ratio * second / bounding);
    }
  }
  for (int c = 0; c < p->l.columns; c++)
    right_of(p, c)[line] = sign * bounding * *partial_of(p, p->l.law + 2 * e + which, c);
}

/* Solve for all columns; the solutions stand in the places of the right sides. */
static void solve(problem *p) {
  const frot_linearize_work *scratch = p->scratch;
  int n = p->unknowns, rows = p->equations;
  if (rows == n) {
    for (int k = 0; k < n; k++)
      memcpy(scratch->lu + n * k, entry(p, 0, k), sizeof(double) * (size_t)n);
    if (!frot_lu(scratch->lu, n, scratch->pivot, scratch->scale)) {
      for (int c = 0; c < p->l.columns; c++)
        frot_lu_apply(scratch->lu, n, scratch->pivot, scratch->scale, right_of(p, c));
      return;
    }
  }
  double *x = scratch->least, *work = x + n;
  for (int c = 0; c < p->l.columns; c++) {
    for (int k = 0; k < n; k++)
      memcpy(scratch->lu + rows * k, entry(p, 0, k), sizeof(double) * (size_t)rows);
    frot_least_norm(scratch->lu, right_of(p, c), rows, n, x, work, scratch->pivot);
    memcpy(right_of(p, c), x, sizeof(double) * (size_t)n);
  }
}

static void solve_group(problem *p) {
  const frot_group *g = p->g;
  number_unknowns(p);
  for (int k = 0; k < p->unknowns; k++) memset(entry(p, 0, k), 0, sizeof(double) * (size_t)p->rows);
  balance(p);
  for (int i = 0; i < g->n_rows; i++) {
    int row = g->rows[i], e = element_of(p, row), which = 0;
    if (frot_is_reading(p->m, row) || is_left(p, row)) continue;
    int sign = e >= 0 ? follows(p, e, &which) : 0;
    if (sign != 0) follow(p, i, e, sign, which);
    if (is_kept(p, row, e)) keep(p, i);
  }
  solve(p);
}

/* Derivatives of the lines: all entries at once, or direction after direction. */
static int find_partials(const frot_model *m, frot_work *w, const frot_linearize_work *scratch,
                         const lines *l) {
  const frot_pattern *pattern = &m->pattern;
  double *partial = scratch->partial, *entries = scratch->entries;
  if (pattern->entries > 0) {
    w->call.res[0] = entries;
    frot_call(w, &m->jacobian);
    memset(partial, 0, sizeof(double) * (size_t)(l->count * l->columns));
    for (int e = 0; e < pattern->entries; e++)
      partial[pattern->entry_column[e] * l->count + pattern->entry_row[e]] = entries[e];
  } else {
    memset(entries, 0, sizeof(double) * (size_t)l->columns);
    for (int c = 0; c < l->columns; c++) {
      w->call.arg[9] = entries, w->call.res[0] = partial + l->count * c;
      entries[c] = 1;
      frot_call(w, &m->jacobian);
      entries[c] = 0;
    }
  }
  return frot_all_finite(partial, l->count * l->columns);
}

int frot_linearize(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
                   const double *d, const frot_linearize_work *scratch, double *slope) {
  memset(w->reactions.carried, 0, (size_t)m->n_rows);
  int status = frot_slope(m, s, w, t, z, slope);
  if (status != FROT_OK) return status;
  problem p = {.m = m, .w = w, .scratch = scratch, .l = lines_of(m)};
  int order = m->nq + m->nv, early = w->layout.early, unknowns;
  p.modes = (const void *)(s->data + w->layout.modes);
  frot_inputs(m, s, w, &t, z, z + m->nq, d);
  w->call.arg[7] = w->core.a, w->call.arg[8] = w->core.lam;
  if (!find_partials(m, w, scratch, &p.l)) return FROT_NAN;
  memset(scratch->rates, 0, sizeof(double) * (size_t)(order * p.l.columns));
  for (int c = 0; c < p.l.columns; c++) {
    memcpy(scratch->rates + order * c, partial_of(&p, p.l.rates, c),
           sizeof(double) * (size_t)m->nq);
    memcpy(scratch->residual + early * c, partial_of(&p, p.l.residual, c),
           sizeof(double) * (size_t)early);
  }
  extent_of(m, &p.rows, &unknowns);
  const double *frozen = s->data + w->layout.frozen;
  for (int k = 0; k < m->n_groups; k++) {
    const frot_group *g = p.g = &m->groups[k];
    solve_group(&p);
    for (int c = 0; c < p.l.columns; c++)
      for (int i = 0; i < g->n_speeds; i++)
        if (frozen[g->unknowns[i]] == 0)
          scratch->rates[order * c + m->nq + g->unknowns[i]] = right_of(&p, c)[i];
  }
  return frot_all_finite(scratch->rates, order * p.l.columns) ? FROT_OK : FROT_NAN;
}
