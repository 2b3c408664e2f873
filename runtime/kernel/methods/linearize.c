#include "methods/linearize.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "evaluation/slip_frames.h"
#include "inertia/mass_matrix.h"
#include "numerics/dense.h"
#include "numerics/basis.h"
#include "methods/right_hand_side.h"
#include "reactions/reactions.h"
#include "constraints/redundant_rows.h"
#include "numerics/tolerances.h"

/* The system of one group. Unknowns: those of the group, with readings in the places of auxiliary
 * ones, then the reactions that are not known; unknown[i]: the place of the reaction of its row i,
 * or -1. Columns of the matrix have `rows` items, the most there may be. */
typedef struct {
  const frot_model *m;
  frot_work *w;
  const frot_group *g;
  const frot_contact_mode *modes;
  const frot_linearize_work *scratch;
  const int *columns; /* on which the group depends */
  int n_columns, lines;
  int rows, equations, unknowns;
} problem;

static double *entry(const problem *p, int equation, int unknown) {
  return p->scratch->matrix + (size_t)unknown * (size_t)p->rows + equation;
}

static double *right_of(const problem *p, int column) {
  return p->scratch->right + (size_t)column * (size_t)p->rows;
}

/* Derivative of a line of the group in its column. */
static double *partial_of(const problem *p, int line, int column) {
  return p->scratch->block + (size_t)column * (size_t)p->lines + line;
}

/* Whether the row is left to others that it depends on. */
static int is_left(const problem *p, int row) {
  return !p->g->general && p->w->reactions.carried[row];
}

/* The number in the group of the element of a row, or -1 for the row of a normal. */
static int number_of(const problem *p, int row) {
  for (int i = 0; i < p->g->n_elements; i++)
    if (p->m->elements[p->g->elements[i]].row == row) return i;
  return -1;
}

/* The element itself. */
static int element_of(const problem *p, int row) {
  int number = number_of(p, row);
  return number < 0 ? -1 : p->g->elements[number];
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
    if (g->general || k < g->n_speeds) {
      frot_whole_column(w, g, k, column);
      continue;
    }
    memset(column, 0, sizeof(double) * (size_t)n);
    column[k] = -1;
  }
  for (int i = 0; i < g->n_rows; i++) {
    int at = p->scratch->unknown[i];
    if (at < 0) continue;
    const double *effect = (g->general ? w->core.effect : w->core.rows) + g->entries + i * n;
    for (int k = 0; k < n; k++) *entry(p, k, at) = -effect[k];
  }
  for (int c = 0; c < p->n_columns; c++)
    for (int k = 0; k < n; k++) right_of(p, c)[k] = -*partial_of(p, k, c);
  p->equations = n;
}

/* Friction along the direction d of a slip s of several components turns with it: its change is lam
 * (I - d d') ds/|s|, along the rows that are turned to be across d. `line` is that of the first
 * component of s. */
static void turn_friction(problem *p, int e, int line) {
  const frot_model *m = p->m;
  const frot_group *g = p->g;
  const frot_work *w = p->w;
  int row = m->elements[e].row, parts = m->elements[e].parts;
  const double *frame = w->core.frame + FROT_MOST_PARTS * FROT_MOST_PARTS * e;
  double per_slip = w->core.lam[row] / w->core.rate[row];
  for (int i = 1; i < parts; i++) {
    const double *effect = frot_entries(m, g->general ? w->core.effect : w->core.rows, row + i);
    for (int c = 0; c < p->n_columns; c++) {
      double across = 0;
      for (int k = 0; k < parts; k++) across += frame[i * parts + k] * *partial_of(p, line + k, c);
      if (across == 0) continue;
      for (int k = 0; k < g->n; k++) right_of(p, c)[k] += effect[k] * across * per_slip;
    }
  }
}

/* That of all elements of the group that slip so. */
static void turn_frictions(problem *p) {
  const frot_group *g = p->g;
  int line = g->n + g->n_rows + 2 * g->n_elements;
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    const frot_element *element = &p->m->elements[e];
    if (element->parts == 1) continue;
    const frot_contact_mode *mode = frot_element_mode(p->m, p->modes, e);
    int slips = p->modes[element->contact].closed && mode->friction > FROT_STICK;
    if (element->part == 0 && slips && !mode->starts && p->w->core.rate[element->row] > 0)
      turn_friction(p, e, line);
    line++;
  }
}

/* J z + c = 0. */
static void keep(problem *p, int i) {
  const frot_group *g = p->g;
  int line = p->equations++, after = g->n_speeds + g->n_auxiliary;
  const double *own = p->w->core.rows + g->entries + i * g->n;
  for (int k = 0; k < g->n; k++)
    if (k < g->n_speeds || k >= after) *entry(p, line, k) = own[k];
  for (int c = 0; c < p->n_columns; c++) right_of(p, c)[line] = -*partial_of(p, g->n + i, c);
}

/* Takes `by` times the derivative of the reaction of a row from the equation `line`. */
static void take_reaction(problem *p, int line, int row, double by) {
  int local = p->m->row_local[row], reads = p->m->row_reads[row];
  int at = reads >= 0 ? reads : p->scratch->unknown[local];
  if (at >= 0) *entry(p, line, at) -= by;
}

/* lam = ratio * bounding, for the row i of the group and its element number k, e of the model. */
static void follow(problem *p, int i, int k, int sign, int which) {
  int e = p->g->elements[k];
  const frot_element *element = &p->m->elements[e];
  const double *lam = p->w->core.lam;
  int line = p->equations++, law = p->g->n + p->g->n_rows + 2 * k + which;
  double ratio = sign * p->w->core.coefficient[2 * e + which], bounding = 1;
  *entry(p, line, p->scratch->unknown[i]) = 1;
  if (element->bound == FROT_BY_NORMAL) {
    bounding = lam[element->bounded_by[0]];
    take_reaction(p, line, element->bounded_by[0], ratio);
  } else if (element->bound == FROT_BY_PIN) {
    bounding = 0;
    for (int j = 0; j < FROT_NORMS && element->norm[j] > 0; j++) {
      double size = frot_norm_length(element, lam, j);
      const int *by = element->bounded_by + frot_norm_first(element, j);
      for (int i = 0; i < element->norm[j] && size > 0; i++)
        take_reaction(p, line, by[i], ratio * lam[by[i]] / size);
      bounding += size;
    }
  }
  for (int c = 0; c < p->n_columns; c++)
    right_of(p, c)[line] = sign * bounding * *partial_of(p, law, c);
}

/* Solve for all columns; the solutions stand in the places of the right sides. */
static void solve(problem *p) {
  const frot_linearize_work *scratch = p->scratch;
  int n = p->unknowns, rows = p->equations;
  if (rows == n) {
    for (int k = 0; k < n; k++)
      memcpy(scratch->lu + n * k, entry(p, 0, k), sizeof(double) * (size_t)n);
    if (!frot_lu(scratch->lu, n, 1, scratch->pivot, scratch->scale)) {
      for (int c = 0; c < p->n_columns; c++)
        frot_lu_apply(scratch->lu, n, scratch->pivot, scratch->scale, right_of(p, c));
      return;
    }
  }
  double *x = scratch->least, *work = x + n;
  for (int c = 0; c < p->n_columns; c++) {
    for (int k = 0; k < n; k++)
      memcpy(scratch->lu + rows * k, entry(p, 0, k), sizeof(double) * (size_t)rows);
    frot_least_norm(scratch->lu, right_of(p, c), rows, n, FROT_RANK, x, work, scratch->pivot);
    memcpy(right_of(p, c), x, sizeof(double) * (size_t)n);
  }
}

static void solve_group(problem *p) {
  const frot_group *g = p->g;
  number_unknowns(p);
  for (int k = 0; k < p->unknowns; k++) memset(entry(p, 0, k), 0, sizeof(double) * (size_t)p->rows);
  balance(p);
  turn_frictions(p);
  for (int i = 0; i < g->n_rows; i++) {
    int row = g->rows[i], e = element_of(p, row), which = 0;
    if (frot_is_reading(p->m, row) || is_left(p, row)) continue;
    int sign = e >= 0 ? follows(p, e, &which) : 0;
    if (sign != 0) follow(p, i, number_of(p, row), sign, which);
    if (is_kept(p, row, e)) keep(p, i);
  }
  solve(p);
}

/* Derivatives of the lines: all entries at once, or direction after direction. */
static int find_partials(const frot_model *m, frot_work *w, const frot_linearize_work *scratch,
                         const frot_line_extent *x) {
  const frot_lines *lines = &m->lines;
  double *partial = scratch->partial, *seed = scratch->seed;
  if (lines->directions == 0) {
    w->call.res[0] = partial;
    frot_call(w, &m->jacobian);
    return frot_all_finite(partial, x->entries);
  }
  for (int k = 0; k < lines->directions; k++) {
    for (int c = 0; c < x->columns; c++) seed[c] = lines->direction[c] == k;
    w->call.arg[9] = seed, w->call.res[0] = partial + x->lines * k;
    frot_call(w, &m->jacobian);
  }
  return frot_all_finite(partial, x->lines * lines->directions);
}

static double entry_value(const frot_model *m, const frot_linearize_work *scratch,
                          const frot_line_extent *x, int e) {
  const frot_lines *lines = &m->lines;
  if (lines->directions == 0) return scratch->partial[e];
  return scratch->partial[x->lines * lines->direction[lines->column[e]] + lines->line[e]];
}

/* The derivatives of the lines of group k, the first of which is `first`. */
static void gather(problem *p, const frot_line_extent *x, int k, int first) {
  const frot_lines *lines = &p->m->lines;
  int *place = p->scratch->place;
  p->g = &p->m->groups[k], p->lines = frot_lines_of_group(p->m, p->g);
  p->columns = lines->group_column + lines->group_start[k];
  p->n_columns = lines->group_start[k + 1] - lines->group_start[k];
  memset(p->scratch->block, 0, sizeof(double) * (size_t)p->lines * (size_t)p->n_columns);
  for (int c = 0; c < p->n_columns; c++) place[p->columns[c]] = c;
  for (int e = lines->first[1 + k]; e < lines->first[2 + k]; e++)
    *partial_of(p, lines->line[e] - first, place[lines->column[e]]) =
        entry_value(p->m, p->scratch, x, e);
}

/* Entries in dense columns of `height` items, the lines beginning at `first`. */
static void spread(const frot_model *m, const frot_linearize_work *scratch,
                   const frot_line_extent *x, int owner, int first, int height, double *to) {
  for (int e = m->lines.first[owner]; e < m->lines.first[owner + 1]; e++)
    to[height * m->lines.column[e] + m->lines.line[e] - first] = entry_value(m, scratch, x, e);
}

int frot_linearize(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
                   const double *d, const frot_linearize_work *scratch, double *slope) {
  memset(w->reactions.carried, 0, (size_t)m->n_rows);
  int status = frot_slope(m, s, w, t, z, slope);
  if (status != FROT_OK) return status;
  frot_line_extent x = frot_line_extent_of(m);
  problem p = {.m = m, .w = w, .scratch = scratch, .rows = x.equations};
  int order = m->nq + m->nv, early = w->layout.early, sparse = m->pattern.n > 0, first = m->nq;
  p.modes = (const void *)(s->data + w->layout.modes);
  frot_inputs(s, w, &t, z, z + m->nq, d);
  w->call.arg[7] = w->core.a, w->call.arg[8] = frot_lam_of_text(m, w);
  if (!find_partials(m, w, scratch, &x)) return FROT_NAN;
  int count = sparse ? m->pattern.entries : order * x.columns;
  double *at = scratch->rates;
  if (!sparse) {
    memset(at, 0, sizeof(double) * (size_t)count);
    spread(m, scratch, &x, 0, 0, order, at);
  }
  for (int e = 0; sparse && e < m->lines.first[1]; e++) *at++ = entry_value(m, scratch, &x, e);
  const double *frozen = s->data + w->layout.frozen;
  for (int k = 0; k < m->n_groups; k++) {
    gather(&p, &x, k, first);
    solve_group(&p);
    for (int c = 0; c < p.n_columns; c++)
      for (int i = 0; i < p.g->n_speeds; i++) {
        int speed = p.g->unknowns[i];
        double value = frozen[speed] == 0 ? right_of(&p, c)[i] : 0;
        if (sparse)
          *at++ = value;
        else
          at[order * p.columns[c] + m->nq + speed] = value;
      }
    first += p.lines;
  }
  memset(scratch->residual, 0, sizeof(double) * (size_t)(early * x.columns));
  spread(m, scratch, &x, m->n_groups + 1, first, early, scratch->residual);
  return frot_all_finite(scratch->rates, count) &&
                 frot_all_finite(scratch->residual, early * x.columns)
             ? FROT_OK
             : FROT_NAN;
}
