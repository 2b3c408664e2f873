/* The rows that hold: J z + c = 0.
 *
 * Of a mass matrix the held rows H = L^-1 J' are made orthonormal, in their order, H = Q R, and the
 * conditions taken as Q' u + R'^-1 c = 0 with u = f + sum of H lam: the condition of the system is
 * that of H, not of its Gram matrix. What depends on the rows before it is left out, if it agrees
 * with them. */
#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "numerics/dense.h"
#include "evaluation/row_order.h"
#include "numerics/basis.h"
#include "reactions/force_problem.h"
#include "reactions/reactions.h"
#include "constraints/redundant_rows.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

/* Row k of those of a contact that is kept without a reaction of its own, then of its elements that
 * are: -1 for the others. */
static int row_without_reaction(const frot_problem *p, int contact, int k) {
  const frot_model *m = p->m;
  const frot_contact_mode *mode = &p->modes[contact];
  const frot_contact *c = &m->contacts[contact];
  if (mode->unloaded == FROT_BY_SPRINGS) return -1; /* it depends on rows that are held */
  if (k < 0) return mode->closed && mode->unloaded && c->row_n >= 0 && !c->reduced ? c->row_n : -1;
  const frot_contact_mode *law = frot_element_mode(m, p->modes, k);
  int kept = m->elements[k].contact == contact && mode->closed && !m->elements[k].prescribed &&
             law->friction == FROT_STICK && (mode->unloaded || law->at_bound != 0);
  return kept ? m->elements[k].row : -1;
}

/* Whether anything of the group is at its bound or carries nothing. */
static int leaves_to_others(const frot_problem *p) {
  const frot_group *g = p->g;
  for (int i = 0; i < g->n_contacts; i++)
    if (p->modes[g->contacts[i]].unloaded) return 1;
  for (int i = 0; i < g->n_elements; i++)
    if (frot_element_mode(p->m, p->modes, g->elements[i])->at_bound != 0) return 1;
  return 0;
}

/* What is at its bound or carries nothing is kept by the others: where several friction forces at
 * their bounds hold a row together, none of them has a row of its own. Appends those rows to the
 * orthonormal ones. */
static void add_kept_rows(frot_problem *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int ns = p->g->n_speeds, some = leaves_to_others(p);
  for (int i = 0; some && i < p->g->n_rows; i++) w->span.kept[p->g->rows[i]] = 0;
  for (int i = 0; some && i < p->g->n_contacts; i++)
    for (int law = -1; law < p->g->n_elements; law++) {
      int e = law < 0 ? -1 : p->g->elements[law], rank = w->span.rank;
      int row = row_without_reaction(p, p->g->contacts[i], e);
      if (row < 0 || rank == ns) continue;
      double *x = w->span.basis + ns * rank, *parts = w->span.parts, bias = w->core.c[row];
      memcpy(x, frot_entries(m, w->core.half, row), sizeof(double) * (size_t)ns);
      double length = frot_length(x, ns), size = w->core.bias_size[row];
      double rest = frot_reject(x, w->span.basis, rank, ns, parts);
      if (!(rest > frot_least_length(m, w, row, length))) continue;
      for (int k = 0; k < rank; k++)
        bias -= parts[k] * w->span.bias[k], size += fabs(parts[k]) * w->span.bias_size[k];
      for (int k = 0; k < ns; k++) x[k] /= rest;
      w->span.bias[rank] = bias / rest, w->span.bias_size[rank] = size / rest;
      w->span.kept[row] = 1, w->span.rank++;
    }
  p->kept = w->span.rank - p->equations;
  p->equations = w->span.rank;
}

enum { TAKEN, CONTRADICTS, WAITS };

/* Make the held row k orthonormal to the w->span.rank before it, which it joins unless it depends
 * on them; one of which these leave little WAITS where it `may`. */
static int take_row(const frot_problem *p, int k, int may) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int ns = p->g->n_speeds, rank = w->span.rank, row = w->reactions.unknown[k];
  w->span.along[k] = p->g->n_rows;
  if (frot_is_redundant(w, row)) {
    w->reactions.dependent = w->reactions.carried[row] = 1;
    w->span.left[row] = 0;
    return TAKEN;
  }
  double *x = w->span.basis + ns * rank, *parts = w->span.parts;
  memcpy(x, frot_entries(m, w->core.half, row), sizeof(double) * (size_t)ns);
  w->reactions.carried[row] = 0;
  double length = frot_length(x, ns), bias = w->core.c[row];
  double size = w->core.bias_size[row];
  double rest = frot_reject(x, w->span.basis, rank, ns, parts);
  for (int i = 0; i < rank; i++) {
    bias -= parts[i] * w->span.bias[i];
    size += fabs(parts[i]) * w->span.bias_size[i];
  }
  double measure = frot_length_beside(m, w, row, length);
  if (!(rest > FROT_DEPENDENT * measure)) {
    w->reactions.dependent = w->reactions.carried[row] = 1;
    w->span.left[row] = 0;
    double agrees = FROT_AGREES * (size + frot_free_size(m, w, row));
    if (w->reactions.follow) return TAKEN; /* inside a step rows are off by its error */
    int agree = fabs(bias) <= agrees + frot_free_rounding(w, p->g, measure);
    return agree ? TAKEN : CONTRADICTS;
  }
  if (may && frot_row_is_deferred(m, w, row, rest, measure)) return WAITS;
  w->span.left[row] = rest;
  for (int i = 0; i < ns; i++) x[i] /= rest;
  if (w->reactions.friction[k] == 0)
    memcpy(frot_entries(m, w->span.direction, row), x, sizeof(double) * (size_t)ns);
  w->span.bias_size[rank] = size / rest;
  w->span.bias[rank++] = bias / rest;
  w->span.along[k] = w->span.rank = rank;
  return TAKEN;
}

/* The held rows of a mass matrix, orthonormal, into w->span.basis with their biases in
 * w->span.bias; p->equations is their number. Returns 1 when a row that depends on others
 * contradicts them. */
static int orthonormalize(frot_problem *p) {
  frot_work *w = p->w;
  int *order = w->span.order, normals = 0, last, i = 0;
  for (int k = 0; k < p->held; k++) order[k] = k, normals += w->reactions.friction[k] == 0;
  w->span.rank = 0;
  for (last = normals; i < p->held;) {
    int found = take_row(p, order[i], i < last - 1);
    if (found == CONTRADICTS) return 1;
    if (found == WAITS)
      frot_defer_row(order, i, --last);
    else
      i++;
  }
  p->equations = w->span.rank;
  add_kept_rows(p);
  return 0;
}

/* The conditions of a group whose matrix is any matrix: what the unknowns do to the held rows.
 * Those that are left to others are no conditions. */
static void hold_general(frot_problem *p) {
  frot_work *w = p->w;
  int n = p->unknowns, at = 0;
  for (int c = 0; c < n; c++) {
    double size = fabs(frot_unknown_effect(p, w->reactions.unknown[c], c));
    w->reactions.unit_of[c] = size > 0 ? 1 / sqrt(size) : 1;
  }
  for (int r = 0; r < p->held; r++) {
    double scale = w->reactions.unit_of[r];
    if (frot_is_redundant(w, w->reactions.unknown[r])) continue;
    for (int c = 0; c < n; c++)
      w->linear.matrix[c * n + at] =
          scale * w->reactions.unit_of[c] * frot_unknown_effect(p, w->reactions.unknown[r], c);
    w->linear.right[at++] = -scale * frot_known_part(p, w->reactions.unknown[r]);
  }
  p->equations = at;
}

int frot_hold_rows(frot_problem *p) {
  frot_work *w = p->w;
  int n = p->unknowns, ns = p->g->n_speeds;
  if (p->g->general) {
    hold_general(p);
    return 0;
  }
  if (orthonormalize(p)) return 1;
  int own = p->equations - p->kept;
  double *x = w->core.rest;
  for (int c = -1; c < n; c++) {
    frot_places places;
    frot_unknown_column(p, c, x);
    frot_find_places(x, ns, &places);
    double length = frot_length(x, ns), unit = length > 0 ? 1 / length : 1;
    if (c >= 0) w->reactions.unit_of[c] = unit;
    /* a row by itself lies along those made of it and of the rows before it */
    int alone = c >= 0 && c < p->held && w->reactions.fold[FROT_FOLDS * c] < 0;
    int along = alone ? w->span.along[c] : p->equations;
    for (int r = 0; r < p->equations; r++) {
      const double *direction = w->span.basis + ns * r;
      double part = r < along ? frot_dot_at(&places, x, direction) : 0;
      if (c < 0) {
        w->linear.right[r] = -(part + w->span.bias[r]);
        continue;
      }
      /* no reaction of its own acts in a row that is kept by others: perhaps none does */
      int none = r >= own && fabs(unit * part) <= FROT_SINGULAR_PIVOT;
      w->linear.matrix[c * n + r] = none ? 0 : unit * part;
    }
  }
  return 0;
}
