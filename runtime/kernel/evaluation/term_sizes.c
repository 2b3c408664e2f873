#include "evaluation/term_sizes.h"

#include <math.h>
#include <string.h>

#include "model/island_calls.h"
#include "numerics/dense.h"
#include "numerics/tolerances.h"
#include "inertia/extended_inertia.h"

/* Loads that are spread one by one. Of more unknowns those that are far apart go together: far
 * loads do less to each other, and the sizes of a thousand would cost a thousand solutions. */
#define MOST_ALONE 32

double frot_row_size(const frot_model *m, const frot_work *w, int row, const double *v) {
  const frot_group *g = frot_group_of(m, row);
  const double *entries = frot_entries(m, w->core.rows, row);
  double sum = 0;
  for (int k = 0; k < g->n_speeds; k++) sum += fabs(entries[k] * v[g->unknowns[k]]);
  return sum;
}

double frot_gap_size(const frot_model *m, const frot_work *w, int row, const double *q) {
  const frot_group *g = frot_group_of(m, row);
  const double *entries = frot_entries(m, w->core.rows, row);
  double sum = 0;
  for (int k = 0; k < g->n_speeds; k++) {
    int coordinate = m->speed_coordinate[g->unknowns[k]];
    if (coordinate >= 0)
      sum += fabs(entries[k] * q[coordinate]);
    else if (m->n_turns > 0 && m->speed_turns[g->unknowns[k]])
      sum += fabs(entries[k]); /* an orientation has the size of a radian */
  }
  return sum;
}

double frot_size_of_gap(const frot_model *m, const frot_state *s, const frot_work *w, int i,
                        const double *q) {
  return frot_gap_size(m, w, m->contacts[i].row_n, q) + s->data[w->layout.reach + i];
}

int frot_is_flush(const frot_model *m, const frot_state *s, const frot_work *w, int i,
                  const double *q) {
  return fabs(w->core.gap[i]) <= FROT_FLUSH * frot_size_of_gap(m, s, w, i, q);
}

double frot_row_speed(const frot_model *m, frot_work *w, int row, const double *v) {
  const frot_group *g = frot_group_of(m, row);
  int ns = g->n_speeds;
  double *half = w->core.rest;
  memcpy(half, frot_entries(m, w->core.rows, row), sizeof(double) * (size_t)ns);
  frot_inwards(w, g, half);
  return sqrt(frot_square_of(w, g, v) * frot_dot(half, half, ns));
}

/* The inertia that is felt at a reading of a group while all speeds are free. */
static double felt_inertia(const frot_model *m, frot_work *w, const frot_group *g, int row) {
  if (frot_in_wide(m, w, g)) return frot_felt_inertia(m, w, g, row);
  double *half = w->core.rest, own = frot_mass_column(w, g, m->row_reads[row], half);
  frot_inwards(w, g, half);
  return own - frot_dot(half, half, g->n_speeds);
}

double frot_length_beside(const frot_model *m, frot_work *w, int row, double own) {
  int normal = m->row_beside[row];
  if (normal < 0) return own;
  const frot_group *g = frot_group_of(m, normal);
  int ns = g->n_speeds;
  double *half = w->core.rest, beside;
  if (!frot_is_reading(m, normal)) {
    memcpy(half, frot_entries(m, w->core.rows, normal), sizeof(double) * (size_t)ns);
    frot_inwards(w, g, half);
    beside = frot_length(half, ns);
  } else if (!g->general) {
    double inertia = felt_inertia(m, w, g, normal);
    beside = inertia > 0 ? 1 / sqrt(inertia) : 0;
  } else {
    beside = own;
  }
  return fmax(own, beside);
}

double frot_least_length(const frot_model *m, frot_work *w, int row, double own) {
  return FROT_DEPENDENT * frot_length_beside(m, w, row, own);
}

/* column (n) <- the loads of every MOST_ALONE-th unknown from `first` on. What sums of them cancel
 * by is no rounding: their signs are those of the Thue-Morse sequence, which repeats in no period.
 * Returns whether there are any. */
static int pick_loads(const frot_group *g, const double *load, int first, int n, double *column) {
  int any = 0, place = 0;
  memset(column, 0, sizeof(double) * (size_t)n);
  for (int k = first; k < n; k += MOST_ALONE, place++) {
    int odd = 0;
    for (int bits = place; bits > 0; bits >>= 1) odd ^= bits & 1;
    double own = load[g->unknowns[k]];
    column[k] = odd ? -own : own, any |= own != 0;
  }
  return any;
}

/* size <- |L^-1| load (n_speeds), column after column of the inverse. */
static void spread_along_tree(frot_work *w, const frot_group *g, const double *load, double *size) {
  int ns = g->n_speeds;
  double *column = w->core.rest;
  memset(size, 0, sizeof(double) * (size_t)ns);
  for (int k = 0; k < ns && k < MOST_ALONE; k++) {
    if (!pick_loads(g, load, k, ns, column)) continue;
    frot_inwards(w, g, column);
    for (int i = 0; i < ns; i++) size[i] += fabs(column[i]);
  }
}

/* size <- |L^-1| load (n_speeds), or a bound of it. */
static void spread_in_factor(frot_work *w, const frot_group *g, const double *load, double *size) {
  const double *factor = w->core.factor + g->metric;
  int ns = g->n_speeds;
  if (g->n_links > 0) {
    spread_along_tree(w, g, load, size);
    return;
  }
  for (int i = 0; i < ns; i++) {
    double sum = load[g->unknowns[i]];
    for (int k = 0; k < i; k++) sum += fabs(factor[k * ns + i]) * size[k];
    size[i] = sum / factor[i * ns + i];
  }
}

/* size <- |A^-1| load (n; of a mass matrix n_speeds), column after column of the inverse. Of a load
 * that is `eliminated`, behind L^-1, it is |L'^-1| load. */
static void spread_in_inverse(frot_work *w, const frot_group *g, const double *load, int eliminated,
                              double *size) {
  int n = g->general ? g->n : g->n_speeds;
  double *column = w->core.rest;
  memset(size, 0, sizeof(double) * (size_t)n);
  for (int k = 0; k < n && k < MOST_ALONE; k++) {
    if (!pick_loads(g, load, k, n, column)) continue;
    if (g->general) {
      frot_lu_apply(w->core.lu + g->matrix, n, w->core.lu_pivot + g->vector,
                    w->core.lu_scale + 2 * g->vector, column);
    } else {
      if (!eliminated) frot_inwards(w, g, column);
      frot_outwards(w, g, column);
    }
    for (int i = 0; i < n; i++) size[i] += fabs(column[i]);
  }
}

/* Add to the loads of a group what the reaction in a row makes of them. An entry is a sum of
 * products that may cancel: what is left may be rounding of the largest of its kind in the row, or
 * of the lengths and places that it is made of. One that is zero to the last digit is zero by
 * structure. */
static void load_row(const frot_model *m, const frot_work *w, const frot_group *g, int row,
                     double reach, const double *q, double *load) {
  double lam = fabs(w->core.lam[row]), size[2] = {0, 0};
  if (lam == 0 || frot_is_reading(m, row)) return;
  if (reach > 0) size[1] = reach + frot_gap_size(m, w, row, q);
  const double *entries = frot_entries(m, w->core.rows, row);
  for (int k = 0; k < g->n_speeds; k++) {
    int turns = m->speed_turns[g->unknowns[k]] != 0;
    size[turns] = fmax(size[turns], fabs(entries[k]));
  }
  if (reach > 0 && size[0] <= FROT_CANCELS) size[0] = 1;
  for (int k = 0; k < g->n_speeds; k++)
    if (entries[k] != 0) load[g->unknowns[k]] += lam * size[m->speed_turns[g->unknowns[k]] != 0];
}

static void load_reactions(const frot_model *m, const frot_state *s, const frot_work *w,
                           const frot_group *g, const double *q, double *load) {
  const double *reach = s->data + w->layout.reach;
  for (int i = 0; i < g->n_contacts; i++) {
    int row = m->contacts[g->contacts[i]].row_n;
    if (row >= 0) load_row(m, w, g, row, reach[g->contacts[i]], q, load);
  }
  for (int i = 0; i < g->n_elements; i++) {
    const frot_element *e = &m->elements[g->elements[i]];
    load_row(m, w, g, e->row, e->rolling ? 0 : reach[e->contact], q, load);
  }
}

/* In place of the loads of a group what is left of them and of its reactions behind L^-1: in wide
 * numbers nothing was lost before. */
static void load_eliminated(const frot_model *m, frot_work *w, const frot_group *g, double *load) {
  const double *force = w->core.force + g->vector;
  for (int k = 0; k < g->n_speeds; k++) load[g->unknowns[k]] = fabs(force[k]);
  for (int i = 0; i < g->n_rows; i++) {
    double lam = w->core.lam[g->rows[i]];
    if (lam == 0 || frot_is_reading(m, g->rows[i])) continue;
    const double *half = w->core.half + g->entries + i * g->n;
    for (int k = 0; k < g->n_speeds; k++) load[g->unknowns[k]] += fabs(lam * half[k]);
  }
}

/* Add to sizes of accelerations (n_speeds) what the reaction in a row that holds makes of them:
 * they are such that J a + c = 0 to their rounding, also where no reaction is needed. A wheel's
 * rounding about its axis is that of its way. */
static void hold_sizes(const frot_model *m, const frot_work *w, const frot_group *g, int row,
                       const double *before, double *sizes) {
  const double *entries = frot_entries(m, w->core.rows, row);
  double *response = w->core.rest, sum = fabs(w->core.c[row]);
  memcpy(response, entries, sizeof(double) * (size_t)g->n_speeds);
  for (int k = 0; k < g->n_speeds; k++) sum += fabs(entries[k]) * before[k];
  frot_inwards(w, g, response);
  double own = frot_dot(response, response, g->n_speeds);
  if (!(own > 0)) return;
  frot_outwards(w, g, response);
  for (int k = 0; k < g->n_speeds; k++) sizes[k] += fabs(response[k]) * sum / own;
}

/* The same of all rows of a group that hold. */
static void hold_all_sizes(const frot_model *m, const frot_state *s, const frot_work *w,
                           const frot_group *g, double *sizes) {
  double *before = w->relations.step;
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  memcpy(before, sizes, sizeof(double) * (size_t)g->n_speeds);
  for (int i = 0; i < g->n_contacts && !g->general; i++) {
    const frot_contact *contact = &m->contacts[g->contacts[i]];
    if (contact->row_n >= 0 && !contact->reduced && modes[g->contacts[i]].closed)
      hold_sizes(m, w, g, contact->row_n, before, sizes);
  }
  for (int i = 0; i < g->n_elements && !g->general; i++) {
    int e = g->elements[i];
    if (modes[m->elements[e].contact].closed &&
        frot_element_mode(m, modes, e)->friction == FROT_STICK)
      hold_sizes(m, w, g, m->elements[e].row, before, sizes);
  }
}

/* Sizes of the terms of a group's accelerations into w->core.load_size, after frot_call_sizes. */
static void size_accelerations(const frot_model *m, const frot_state *s, frot_work *w,
                               const frot_group *g, const double *q) {
  int wide = frot_in_wide(m, w, g);
  if (wide)
    load_eliminated(m, w, g, w->core.load);
  else
    load_reactions(m, s, w, g, q, w->core.load);
  spread_in_inverse(w, g, w->core.load, wide, w->core.load_size);
  hold_all_sizes(m, s, w, g, w->core.load_size);
}

void frot_acceleration_sizes(const frot_model *m, frot_state *s, frot_work *w, double t,
                             const double *q, const double *v, const double *d, double *size) {
  memset(size, 0, sizeof(double) * (size_t)m->nv);
  if (!m->sizes.call) return;
  frot_call_sizes(m, s, w, t, q, v, d);
  for (int k = 0; k < w->awake.now->n_groups; k++) {
    const frot_group *g = &m->groups[w->awake.now->groups[k]];
    size_accelerations(m, s, w, g, q);
    for (int j = 0; j < g->n_speeds; j++) size[g->unknowns[j]] = w->core.load_size[j];
  }
}

/* Whether a group has no speed and accelerates. */
static int leaves_rest(const frot_work *w, const frot_group *g, const double *v) {
  int any = 0;
  for (int j = 0; j < g->n_speeds; j++) {
    if (v[g->unknowns[j]] != 0) return 0;
    any |= w->core.a[g->unknowns[j]] != 0;
  }
  return any;
}

void frot_rest_in_rounding(const frot_model *m, frot_state *s, frot_work *w, double t,
                           const double *q, const double *v, const double *d) {
  for (int k = 0, known = 0; k < w->awake.now->n_groups && m->sizes.call; k++) {
    const frot_group *g = &m->groups[w->awake.now->groups[k]];
    if (!leaves_rest(w, g, v)) continue;
    if (!known) frot_call_sizes(m, s, w, t, q, v, d);
    known = 1;
    size_accelerations(m, s, w, g, q);
    int rests = 1;
    for (int j = 0; j < g->n_speeds; j++)
      rests &= fabs(w->core.a[g->unknowns[j]]) <= FROT_ROUNDING * w->core.load_size[j];
    for (int j = 0; j < g->n_speeds && rests; j++) w->core.a[g->unknowns[j]] = 0;
  }
}

/* Length of the motion that the loads of a group give, each to its own speed while the others stay:
 * of a light body on a heavy one, the loads of both are in its coordinates, where they cancel, and
 * |A^-1| load gives it what the heavy one's weight would do to the light one's mass. */
static double motion_by_each(frot_work *w, const frot_group *g, const double *load) {
  double *mass = w->core.rest, sum = 0;
  frot_own_inertias(w, g, mass);
  for (int k = 0; k < g->n_speeds; k++) {
    double own = load[g->unknowns[k]];
    if (own != 0 && mass[k] > 0) sum += own * own / mass[k];
  }
  return sqrt(sum);
}

/* What loads do to the rows of a group in wide numbers: of a reading what the inertia felt there
 * has of the loads on all that it carries. */
static void size_eliminated(const frot_model *m, frot_work *w, const frot_group *g,
                            const double *load) {
  const double *force = w->core.force + g->vector;
  for (int i = 0; i < g->n_rows; i++) {
    int r = g->rows[i], reads = m->row_reads[r];
    if (!w->core.wanted[r]) continue;
    const double *half = w->core.half + g->entries + i * g->n;
    double sum = fabs(w->core.c[r]);
    if (reads >= 0) {
      double all = frot_mass_column(w, g, reads, w->core.rest);
      double part = all > 0 ? frot_felt_inertia(m, w, g, r) / all : 0;
      sum = fmax(fabs(w->core.free[r]), part * load[g->unknowns[reads]]);
    }
    for (int k = 0; k < g->n_speeds && reads < 0; k++) sum += fabs(half[k] * force[k]);
    w->core.row_load[r] = sum;
  }
}

void frot_row_loads(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, const double *d) {
  double *load = w->core.load, *size = w->core.load_size;
  if (!m->sizes.call) return;
  frot_call_sizes(m, s, w, t, q, v, d);
  for (int k = 0; k < w->awake.now->n_groups; k++) {
    const frot_group *g = &m->groups[w->awake.now->groups[k]];
    int n = g->n, count = g->general ? n : g->n_speeds;
    if (g->n_rows == 0) continue;
    if (frot_in_wide(m, w, g)) {
      size_eliminated(m, w, g, load);
      continue;
    }
    if (g->general)
      spread_in_inverse(w, g, load, 0, size);
    else
      spread_in_factor(w, g, load, size);
    double motion = g->general ? INFINITY : motion_by_each(w, g, load);
    for (int i = 0; i < g->n_rows; i++) {
      int r = g->rows[i], reads = m->row_reads[r];
      if (!w->core.wanted[r]) continue;
      const double *row = (g->general ? w->core.rows : w->core.half) + g->entries + i * n;
      double sum = reads < 0    ? fabs(w->core.c[r])
                   : g->general ? size[reads]
                                : load[g->unknowns[reads]];
      double all = 0, length = 0;
      for (int j = 0; j < count && !(g->general && reads >= 0); j++)
        all += fabs(row[j]) * size[j], length += row[j] * row[j];
      w->core.row_load[r] = sum + (g->general ? all : fmin(all, sqrt(length) * motion));
    }
  }
}
