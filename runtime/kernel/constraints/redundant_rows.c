#include "constraints/redundant_rows.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "evaluation/held_modes.h"
#include "model/indexing.h"
#include "numerics/dense.h"
#include "numerics/basis.h"
#include "constraints/projection.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

/* How much more must be left of a row that was left out for it to take the place of another. */
#define STEADY 2.0

/* The normals of a group that hold, into `list` from place n on, what they do into w->span.basis:
 * those of loops that are not `spare` (may be NULL), or those of what may part. The length of the
 * list. */
static int list_rows(const frot_model *m, const frot_state *s, frot_work *w, const frot_group *g,
                     int loops, const double *spare, int *list, int n) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  int ns = g->n_speeds;
  for (int i = 0; i < g->n_contacts; i++) {
    int c = g->contacts[i], row = m->contacts[c].row_n;
    if (g->general || !frot_is_loaded(m, modes, c)) continue;
    if (frot_is_loop(m, s, w, c) != loops || (spare && spare[row] != 0)) continue;
    const double *own = frot_entries(m, w->core.half, row);
    memcpy(w->span.basis + ns * n, own, sizeof(double) * (size_t)ns);
    list[n++] = row;
  }
  return n;
}

/* Of the rows listed, after the `first` that stay, `count` say what the others do. Which are left
 * out is free: those of which the others leave least. Else a kept one may vanish beside one that is
 * left out, as the rows of a point that rolls in turn do where its path is curved, or two kept ones
 * become one inside the step, where a corner comes to an edge. They come last in the list. Returns
 * whether the others say it alone, without what rests. */
static int sort_spare(const frot_model *m, const frot_state *s, const frot_work *w,
                      const frot_group *g, int *list, int first, int n, int count) {
  const double *spare = s->data + w->layout.spare;
  int ns = g->n_speeds;
  for (int kept = 0; kept < n - count; kept++) {
    int best = -1;
    double most = 0;
    for (int i = kept; i < (kept < first ? kept + 1 : n); i++) {
      const double *x = w->span.basis + ns * i;
      double left = frot_length(x, ns) * (spare[list[i]] != 0 ? 1 : STEADY);
      if (left > most) most = left, best = i;
    }
    if (best < 0) return 0;
    int row = list[best];
    list[best] = list[kept], list[kept] = row;
    frot_take_row(w->span.basis, n, ns, kept, best);
  }
  for (int i = n - count; i < n; i++) {
    const double *own = frot_entries(m, w->core.half, list[i]), *left = w->span.basis + ns * i;
    double length = frot_length(own, ns);
    if (frot_length(left, ns) > FROT_DEPENDENT * length) return 0;
  }
  return 1;
}

/* Decide for the rows listed after the `first`, `count` of which are too many. Returns whether
 * others may be left out than those that were. */
static int decide(const frot_model *m, frot_state *s, const frot_work *w, const frot_group *g,
                  int *list, int first, int n, int count) {
  double *spare = s->data + w->layout.spare;
  if (count == 0 || !sort_spare(m, s, w, g, list, first, n, count)) return 0;
  for (int i = first; i < n; i++) spare[list[i]] = i >= n - count;
  return 1;
}

/* The same after the evaluation that found so many of them to depend on others. */
static int decide_anew(const frot_model *m, frot_state *s, const frot_work *w, const frot_group *g,
                       int *list, int first, int n) {
  double *spare = s->data + w->layout.spare;
  int count = 0;
  for (int i = first; i < n; i++) count += w->reactions.carried[list[i]];
  int sorted = decide(m, s, w, g, list, first, n, count);
  for (int i = first; i < n && !sorted; i++) spare[list[i]] = w->reactions.carried[list[i]];
  return sorted;
}

/* The rows of a general group that hold into `list`, normals first; *normals is their number. */
static int list_held(const frot_model *m, const frot_state *s, const frot_group *g,
                     const frot_layout *l, int *list, int *normals) {
  const frot_contact_mode *modes = (const void *)(s->data + l->modes);
  int n = 0;
  for (int i = 0; i < g->n_contacts; i++)
    if (frot_is_loaded(m, modes, g->contacts[i])) list[n++] = m->contacts[g->contacts[i]].row_n;
  *normals = n;
  for (int i = 0; i < g->n_elements; i++)
    if (frot_is_held(m, modes, g->elements[i])) list[n++] = m->elements[g->elements[i]].row;
  return n;
}

/* The largest entry left of row i of n, with its column. */
static double largest_of(const double *matrix, int n, int i, int *column) {
  double largest = 0;
  for (int c = 0; c < n; c++)
    if (fabs(matrix[n * i + c]) > largest) largest = fabs(matrix[n * i + c]), *column = c;
  return largest;
}

/* Take column c of the pivot row i from the others. */
static void eliminate(double *matrix, int n, int i, int c) {
  const double *pivot = matrix + n * i;
  for (int r = 0; r < n; r++) {
    double part = r == i ? 0 : matrix[n * r + c] / pivot[c];
    for (int k = 0; k < n && part != 0; k++) matrix[n * r + k] -= part * pivot[k];
    if (r != i) matrix[n * r + c] = 0;
  }
}

/* Mark the rows of a general group that depend on others by w->reactions.carried: those that no
 * pivot is left for in what the reactions of the rows do to the rows, scaled. Normals are taken
 * before friction, and the largest first. */
static void rank_general(const frot_model *m, const frot_state *s, frot_work *w,
                         const frot_group *g) {
  int *list = w->reactions.unknown, *taken = w->linear.pivot, normals;
  int n = list_held(m, s, g, &w->layout, list, &normals);
  double *matrix = w->linear.matrix, *unit = w->linear.right;
  for (int i = 0; i < n; i++) {
    double own = fabs(frot_effect(m, w, list[i], list[i]));
    unit[i] = own > 0 ? 1 / sqrt(own) : 1, taken[i] = 0;
  }
  for (int i = 0; i < n; i++)
    for (int c = 0; c < n; c++)
      matrix[n * i + c] = unit[i] * unit[c] * frot_effect(m, w, list[i], list[c]);
  for (int end = normals, kept = 0; kept < n; kept++) {
    int best = -1, column = 0, at = 0;
    double most = FROT_RANK;
    for (int i = 0; i < end; i++) {
      double left = taken[i] ? 0 : largest_of(matrix, n, i, &at);
      if (left > most) most = left, best = i, column = at;
    }
    if (best < 0 && end == n) break;
    if (best < 0) {
      end = n, kept--;
      continue;
    }
    taken[best] = 1;
    eliminate(matrix, n, best, column);
  }
  for (int i = 0; i < n; i++) w->reactions.carried[list[i]] = (unsigned char)!taken[i];
}

/* Rows that are not listed depend on others as the evaluation found. */
static void note_others(const frot_model *m, frot_state *s, const frot_work *w,
                        const frot_group *g) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  double *spare = s->data + w->layout.spare;
  for (int i = 0; i < g->n_contacts; i++) {
    int c = g->contacts[i], row = m->contacts[c].row_n;
    if (row >= 0 && (g->general || !frot_is_loaded(m, modes, c)))
      spare[row] = w->reactions.carried[row];
  }
  for (int i = 0; i < g->n_elements; i++) {
    int row = m->elements[g->elements[i]].row;
    spare[row] = w->reactions.carried[row];
  }
}

int frot_find_redundant_rows(const frot_model *m, frot_state *s, frot_work *w) {
  const frot_awake_lists *now = w->awake.now;
  double *spare = s->data + w->layout.spare;
  int others = 0;
  s->spare_loops = 0;
  for (int k = 0; k < now->n_groups; k++) {
    const frot_group *g = &m->groups[now->groups[k]];
    if (g->general) rank_general(m, s, w, g);
    int *list = w->reactions.unknown, n = list_rows(m, s, w, g, 1, NULL, list, 0);
    s->spare_loops |= decide_anew(m, s, w, g, list, 0, n);
    int first = list_rows(m, s, w, g, 1, spare, list, 0);
    decide_anew(m, s, w, g, list, first, list_rows(m, s, w, g, 0, NULL, list, first));
    note_others(m, s, w, g);
    for (int i = 0; i < g->n_rows && w->reactions.sign[now->groups[k]] != 0; i++)
      others |= (spare[g->rows[i]] != 0) != w->reactions.carried[g->rows[i]];
  }
  return others;
}

int frot_update_redundant_contacts(const frot_model *m, frot_state *s, frot_work *w) {
  const frot_awake_lists *now = w->awake.now;
  double *spare = s->data + w->layout.spare;
  int changed = 0;
  for (int k = 0; k < now->n_groups && w->span.follow; k++) {
    const frot_group *g = &m->groups[now->groups[k]];
    int *list = w->reactions.unknown, count = 0;
    int first = list_rows(m, s, w, g, 1, spare, list, 0);
    int n = list_rows(m, s, w, g, 0, NULL, list, first);
    for (int i = first; i < n; i++) count += w->span.spare[list[i]];
    decide(m, s, w, g, list, first, n, count);
    for (int i = first; i < n; i++) changed |= (spare[list[i]] != 0) != w->span.spare[list[i]];
  }
  return changed;
}

void frot_use_redundant_rows(const frot_model *m, frot_work *w, const double *spare) {
  w->span.follow = 0;
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_groups; k++) {
    const frot_group *g = &m->groups[now->groups[k]];
    for (int i = 0; i < g->n_rows; i++) {
      int r = g->rows[i];
      w->span.spare[r] = spare[r] != 0;
      w->span.follow |= w->span.spare[r];
    }
  }
}

void frot_forget_redundant_rows(frot_work *w) { w->span.follow = 0; }

int frot_is_redundant(const frot_work *w, int row) { return w->span.follow && w->span.spare[row]; }

int frot_redundant_rows_hold(const frot_model *m, frot_state *s, frot_work *w, double t,
                             double *z) {
  if (!w->span.follow) return 1;
  const double *d = s->data + w->layout.d;
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  int moved;
  if (frot_project(m, s, w, t, z, z + m->nq, d, modes, NULL, NULL, &moved) != FROT_OK) return 1;
  if (frot_kinematics(m, s, w, t, z, z + m->nq, d) != FROT_OK) return 1;
  const frot_awake_lists *now = w->awake.now;
  for (int i = 0; i < now->n_contacts; i++) {
    int c = now->contacts[i], row = m->contacts[c].row_n;
    if (row < 0 || m->contacts[c].reduced || !frot_is_redundant(w, row)) continue;
    /* one that nothing moves is made of lengths all the same */
    double size = frot_size_of_gap(m, s, w, c, z);
    if (fabs(w->core.gap[c]) > FROT_DEPENDENT * size) return 0;
  }
  return 1;
}

void frot_restore_redundant_rows(const frot_model *m, frot_state *s, frot_work *w) {
  memset(s->data + w->layout.spare, 0, sizeof(double) * (size_t)m->n_rows);
  frot_forget_redundant_rows(w);
}

long long frot_count_free_speeds(const frot_model *m, const frot_state *s, const frot_work *w) {
  long long held = 0;
  for (int i = 0; i < m->n_contacts; i++) {
    int row = m->contacts[i].row_n;
    if (row < 0 || m->contacts[i].reduced || s->data[w->layout.unilateral + i] != 0) continue;
    held += frot_group_of(m, row)->general || !w->reactions.carried[row];
  }
  return m->nv - held;
}
