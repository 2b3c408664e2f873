/* Evaluation of the generated functions, and the inertia: one factor of each group, then responses.
 *
 * In the place of an auxiliary acceleration, which is zero, stands the reaction it brings to light
 * (T. Kane, D. Levinson, Dynamics: Theory and Applications, 1985, sect. 4.9). With the speeds v and
 * the auxiliary unknowns x of a mass matrix
 *   M_vv v' = h_v + J_v' lam,   reaction = M_xv v' - h_x - J_x' lam,
 * so that with M_vv = L L', f = L^-1 h_v, H = L^-1 J_v', K = L^-1 M_vx nothing larger than M_vv is
 * factored: the rows' free accelerations are H' f + c, the readings K' f - h_x. */
#include "evaluation/evaluate.h"

#include <math.h>
#include <string.h>

#include "evaluation/algebraic_loops.h"
#include "inertia/mass_matrix.h"
#include "model/island_calls.h"
#include "numerics/dense.h"
#include "evaluation/row_order.h"
#include "evaluation/slip_frames.h"
#include "numerics/basis.h"
#include "evaluation/held_modes.h"
#include "evaluation/row_rounding.h"
#include "numerics/tolerances.h"
#include "inertia/extended_inertia.h"

/* Note the rows of a group to look at in w->core.wanted. */
static void want_rows(const frot_model *m, frot_work *w, const frot_group *g,
                      const frot_contact_mode *modes, int wanted) {
  unsigned char all = wanted >= FROT_READING || m->general;
  for (int i = 0; i < g->n_rows; i++)
    w->core.wanted[g->rows[i]] = all && frot_is_reading(m, g->rows[i]);
  for (int i = 0; i < g->n_contacts; i++) {
    const frot_contact *contact = &m->contacts[g->contacts[i]];
    if (contact->row_n >= 0 && !contact->reduced)
      w->core.wanted[contact->row_n] = modes[g->contacts[i]].closed != 0;
  }
  for (int i = 0; i < g->n_elements; i++) {
    const frot_element *element = &m->elements[g->elements[i]];
    int friction = frot_element_mode(m, modes, g->elements[i])->friction;
    int acts = modes[element->contact].closed && (wanted == FROT_LAWS || friction != FROT_NONE);
    w->core.wanted[element->row] = (unsigned char)acts;
    for (int k = 0; acts && k < FROT_BOUNDING; k++)
      if (element->bounded_by[k] >= 0) w->core.wanted[element->bounded_by[k]] = 1;
  }
}

/* What is wanted of a group: first the rows that act (their number is returned), then readings. */
static int list_wanted(const frot_model *m, frot_work *w, const frot_group *g, int *count) {
  int *list = w->core.listed, acting = 0;
  for (int i = 0; i < g->n_rows; i++)
    if (w->core.wanted[g->rows[i]] && !frot_is_reading(m, g->rows[i])) list[acting++] = i;
  *count = acting;
  for (int i = 0; i < g->n_rows; i++)
    if (w->core.wanted[g->rows[i]] && frot_is_reading(m, g->rows[i])) list[(*count)++] = i;
  return acting;
}

/* L^-1 of what is listed from `first` on, four abreast, and each into its place in w->core.half. */
static void halve_four(const frot_model *m, frot_work *w, const frot_group *g, int first, int count,
                       double *four) {
  int ns = g->n_speeds, size = count - first < FROT_ABREAST ? count - first : FROT_ABREAST;
  int alone = size == 1 || g->n_links > 0;
  if (size < FROT_ABREAST) memset(four, 0, sizeof(double) * (size_t)(FROT_ABREAST * ns));
  for (int c = 0; c < size; c++) {
    int i = w->core.listed[first + c], reads = m->row_reads[g->rows[i]];
    double *half = w->core.half + g->entries + i * g->n;
    const double *from = half;
    if (reads < 0)
      from = w->core.rows + g->entries + i * g->n;
    else
      frot_mass_column(w, g, reads, half);
    if (alone && reads < 0) memcpy(half, from, sizeof(double) * (size_t)ns);
    if (alone) frot_inwards(w, g, half), from = half;
    double *to = four + c;
    for (int k = 0; k < ns; k++) to[FROT_ABREAST * k] = from[k];
  }
  if (alone) return;
  frot_forward_four(w->core.factor + g->metric, ns, four);
  for (int c = 0; c < size; c++) {
    double *half = w->core.half + g->entries + w->core.listed[first + c] * g->n;
    const double *from = four + c;
    for (int k = 0; k < ns; k++) half[k] = from[FROT_ABREAST * k];
  }
}

/* What the rows that act, listed from `other` on, do to those listed from `first` on. */
static void effects_of_four(const frot_model *m, frot_work *w, const frot_group *g, int first,
                            int count, int other, int acting) {
  const int *listed = w->core.listed;
  double product[FROT_ABREAST * FROT_ABREAST];
  const double *fours = w->core.abreast;
  const int *one = w->core.support + 2 * (first / FROT_ABREAST),
            *two = w->core.support + 2 * (other / FROT_ABREAST);
  int ns = g->n_speeds, from = one[0] > two[0] ? one[0] : two[0];
  int to = one[1] < two[1] ? one[1] : two[1], at = FROT_ABREAST * from;
  frot_dot_fours(fours + first * ns + at, fours + other * ns + at, to - from, product);
  int rows = count - first < FROT_ABREAST ? count - first : FROT_ABREAST;
  int columns = acting - other < FROT_ABREAST ? acting - other : FROT_ABREAST;
  const int *column = listed + other;
  for (int a = 0; a < rows; a++) {
    int i = listed[first + a], reads = m->row_reads[g->rows[i]];
    double *effects = w->core.delassus + g->square + i * g->n_rows;
    const double *row = product + FROT_ABREAST * a;
    if (reads < 0) {
      for (int b = 0; b < columns; b++) effects[column[b]] = row[b];
    } else {
      const double *read = w->core.rows + g->entries + reads;
      for (int b = 0; b < columns; b++) effects[column[b]] = row[b] - read[column[b] * g->n];
    }
  }
}

/* Whether nothing of a group can part or slip: its rows hold by themselves (held_rows.c), and what
 * they do to each other is asked for where they depend on each other alone. */
static int holds_for_good(const frot_state *s, const frot_work *w, const frot_group *g) {
  const double *unilateral = s->data + w->layout.unilateral;
  if (g->n_elements > 0) return 0;
  for (int i = 0; i < g->n_contacts; i++)
    if (unilateral[g->contacts[i]] != 0) return 0;
  return 1;
}

/* Rows and readings by themselves: L^-1 of each, and its value without reactions. Of these the
 * first *acting are rows that act; returns how many there are. */
static int form_rows(const frot_model *m, frot_work *w, const frot_group *g, int *acting) {
  int ns = g->n_speeds, count;
  *acting = list_wanted(m, w, g, &count);
  for (int first = 0; first < count; first += FROT_ABREAST) {
    double *four = w->core.abreast + first * ns, free[FROT_ABREAST];
    halve_four(m, w, g, first, count, four);
    int *support = w->core.support + 2 * (first / FROT_ABREAST);
    frot_support(four, FROT_ABREAST * ns, &support[0], &support[1]);
    support[0] /= FROT_ABREAST, support[1] = (support[1] + FROT_ABREAST - 1) / FROT_ABREAST;
    frot_dot_four(w->core.force + g->vector, four, ns, free);
    for (int c = 0; c < FROT_ABREAST && first + c < count; c++) {
      int r = g->rows[w->core.listed[first + c]], reads = m->row_reads[r];
      w->core.free[r] = free[c] + (reads >= 0 ? -w->core.h[g->unknowns[reads]] : w->core.c[r]);
    }
  }
  return count;
}

/* What those that act do to each other and to readings, right after form_rows. */
static void form_effects(const frot_model *m, frot_work *w, const frot_group *g, int count,
                         int acting) {
  for (int first = 0; first < count; first += FROT_ABREAST)
    for (int other = 0; other < acting; other += FROT_ABREAST)
      effects_of_four(m, w, g, first, count, other, acting);
}

/* A is a mass matrix, and factored. */
static void form_group(const frot_model *m, const frot_state *s, frot_work *w, const frot_group *g,
                       const frot_contact_mode *modes, int wanted) {
  unsigned char *formed = &w->core.formed[g - m->groups];
  int acting;
  *formed = FROT_FACTOR;
  if (wanted != FROT_LAWS && !s->implicit && frot_only_follows(m, g, modes)) return;
  int count = form_rows(m, w, g, &acting);
  *formed = wanted == FROT_LAWS || acting < count || !holds_for_good(s, w, g);
  *formed = *formed ? FROT_EFFECTS : FROT_ROWS;
  if (*formed == FROT_EFFECTS) form_effects(m, w, g, count, acting);
}

/* The same in wide numbers, in which all is formed at once. */
static void form_masked(const frot_model *m, frot_work *w, const frot_group *g) {
  int count, acting = list_wanted(m, w, g, &count);
  frot_wide_rows(m, w, g, count, acting);
  w->core.formed[g - m->groups] = FROT_EFFECTS;
}

void frot_rows(const frot_model *m, frot_work *w, const frot_group *g) {
  unsigned char *formed = &w->core.formed[g - m->groups];
  int acting;
  if (g->general || *formed != FROT_FACTOR) return;
  form_rows(m, w, g, &acting);
  *formed = FROT_ROWS;
}

void frot_effects(const frot_model *m, frot_work *w, const frot_group *g) {
  unsigned char *formed = &w->core.formed[g - m->groups];
  if (g->general || *formed == FROT_EFFECTS) return;
  int acting, count = form_rows(m, w, g, &acting);
  form_effects(m, w, g, count, acting);
  *formed = FROT_EFFECTS;
}

/* Part of a row (n entries) in the motion z: the auxiliary unknowns, in whose places reactions
 * stand, do not move. */
static double motion_of(const frot_group *g, const double *row, const double *z) {
  int after = g->n_speeds + g->n_auxiliary;
  return frot_dot(row, z, g->n_speeds) + frot_dot(row + after, z + after, g->n - after);
}

/* A is any matrix. Its columns of auxiliary accelerations become those of the reactions there. */
static int general_group(const frot_model *m, frot_work *w, const frot_group *g) {
  int n = g->n;
  double *matrix = w->core.mass + g->matrix, *lu = w->core.lu + g->matrix,
         *scale = w->core.lu_scale + 2 * g->vector;
  int *pivot = w->core.lu_pivot + g->vector;
  for (int i = 0; i < g->n_rows; i++) {
    int reads = m->row_reads[g->rows[i]];
    if (reads < 0) continue;
    const double *effect = w->core.effect + g->entries + i * n;
    for (int k = 0; k < n; k++) matrix[reads * n + k] = -effect[k];
  }
  memcpy(lu, matrix, sizeof(double) * (size_t)(n * n));
  if (frot_lu(lu, n, 1, pivot, scale)) return FROT_SINGULAR;
  double *z = w->core.force + g->vector, *rest = w->core.rest;
  for (int k = 0; k < n; k++) z[k] = rest[k] = w->core.h[g->unknowns[k]];
  frot_lu_apply(lu, n, pivot, scale, z);
  for (int k = 0; k < n; k++) /* one step of refinement */
    for (int i = 0; i < n; i++) rest[i] -= matrix[k * n + i] * z[k];
  frot_lu_apply(lu, n, pivot, scale, rest);
  for (int k = 0; k < n; k++) z[k] += rest[k];
  for (int i = 0; i < g->n_rows; i++) {
    int r = g->rows[i], reads = m->row_reads[r];
    if (!w->core.wanted[r]) continue;
    w->core.free[r] =
        reads >= 0 ? z[reads] : motion_of(g, w->core.rows + g->entries + i * n, z) + w->core.c[r];
    if (reads >= 0) continue;
    double *response = w->core.half + g->entries + i * n;
    memcpy(response, w->core.effect + g->entries + i * n, sizeof(double) * (size_t)n);
    frot_lu_apply(lu, n, pivot, scale, response);
  }
  double *effects = w->core.delassus + g->square;
  for (int i = 0; i < g->n_rows; i++) {
    int r = g->rows[i], reads = m->row_reads[r];
    if (!w->core.wanted[r]) continue;
    for (int j = 0; j < g->n_rows; j++) {
      if (!w->core.wanted[g->rows[j]] || frot_is_reading(m, g->rows[j])) continue;
      const double *response = w->core.half + g->entries + j * n;
      effects[i * g->n_rows + j] =
          reads >= 0 ? response[reads] : motion_of(g, w->core.rows + g->entries + i * n, response);
    }
  }
  return FROT_OK;
}

int frot_dynamics(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, const frot_contact_mode *modes, int wanted) {
  s->statistics.evaluations++;
  w->core.t = t, w->core.q = q, w->core.v = v, w->core.d = d;
  int status = frot_solve_blocks(m, s, w, t, q, v, d);
  if (status != FROT_OK) return status;
  if (!frot_call_dynamics(m, s, w, t, q, v, d, wanted)) return FROT_NAN;
  frot_size_drives(m, s, w, t, q, v, d);
  if (w->core.frame) frot_turn_slip_rows(m, s, w, modes);
  frot_begin_wide(m, w);
  frot_note_unilateral_rows(s, w);
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_groups && status == FROT_OK; k++) {
    const frot_group *g = &m->groups[now->groups[k]];
    want_rows(m, w, g, modes, wanted);
    frot_clean_rows(m, s, w, g, v);
    frot_size_biases(m, s, w, g, v);
    if (g->general) {
      status = general_group(m, w, g);
      continue;
    }
    status = frot_factor(w, g);
    if (frot_is_masked(m, s, w, g, status)) {
      status = frot_wide_factor(m, s, w, g, t, q, v, d);
      if (status == FROT_OK) form_masked(m, w, g);
    } else if (status == FROT_OK) {
      frot_drop_loads(m, s, w, g, v);
      form_group(m, s, w, g, modes, wanted);
    }
  }
  return status;
}

int frot_inertia(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                 const double *v, const double *d) {
  int status = frot_solve_blocks(m, s, w, t, q, v, d);
  if (status != FROT_OK) return status;
  s->statistics.evaluations++;
  frot_call_dynamics(m, s, w, t, q, v, d, FROT_INERTIA);
  for (int k = 0; k < w->awake.now->n_groups; k++) {
    int group = w->awake.now->groups[k];
    w->core.formed[group] = FROT_FACTOR;
    if (!m->groups[group].general) frot_factor(w, &m->groups[group]);
  }
  frot_metric(m, w);
  return FROT_OK;
}

int frot_kinematics(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, const double *d) {
  int status = frot_solve_blocks(m, s, w, t, q, v, d);
  if (status != FROT_OK) return status;
  frot_call_kinematics(m, s, w, t, q, v, d);
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_groups; k++) frot_clean_rows(m, s, w, &m->groups[now->groups[k]], v);
  return FROT_OK;
}

void frot_note_reaches(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                       const double *v, const double *d) {
  double *reach = s->data + w->layout.reach;
  for (int k = 0; k < m->n_parts; k++)
    frot_call_sides(s, w, &m->parts[k], t, q, v, d, w->opening.witness, reach);
}

int frot_metric(const frot_model *m, frot_work *w) {
  for (int k = 0; k < w->awake.now->n_groups; k++) {
    const frot_group *g = &m->groups[w->awake.now->groups[k]];
    int ns = g->n_speeds;
    if (!g->general) continue;
    memcpy(w->core.factor + g->metric, w->core.metric + g->metric,
           sizeof(double) * (size_t)(ns * ns));
    if (frot_cholesky(w->core.factor + g->metric, ns)) return FROT_SINGULAR;
  }
  return FROT_OK;
}

/* z (g->n) += what the reactions w->core.lam do to the unknowns of a group, L' z of a mass matrix.
 */
static void add_responses(const frot_model *m, const frot_work *w, const frot_group *g, double *z) {
  int active = g->general ? g->n : g->n_speeds;
  for (int i = 0; i < g->n_rows; i++) {
    double lam = w->core.lam[g->rows[i]];
    if (lam == 0 || frot_is_reading(m, g->rows[i])) continue;
    const double *response = w->core.half + g->entries + i * g->n;
    for (int j = 0; j < active; j++) z[j] += lam * response[j];
  }
}

void frot_speed_changes(const frot_model *m, frot_work *w, double *change) {
  memset(change, 0, sizeof(double) * (size_t)w->layout.nw);
  for (int k = 0; k < w->awake.now->n_groups; k++) {
    const frot_group *g = &m->groups[w->awake.now->groups[k]];
    double *z = w->core.rest;
    if (!g->general && w->core.formed[g - m->groups] == FROT_FACTOR) continue;
    memset(z, 0, sizeof(double) * (size_t)g->n);
    add_responses(m, w, g, z);
    if (!g->general) frot_outwards(w, g, z);
    for (int j = 0; j < g->n_speeds; j++) change[g->unknowns[j]] = z[j];
  }
}

void frot_accelerations(const frot_model *m, frot_work *w, const double *frozen) {
  for (int k = 0; k < w->awake.now->n_groups; k++) {
    const frot_group *g = &m->groups[w->awake.now->groups[k]];
    int n = g->n, ns = g->n_speeds, active = g->general ? n : ns;
    double *z = w->core.rest;
    if (!g->general &&
        w->core.formed[g - m->groups] == FROT_FACTOR) { /* there already: friction_fixed_point.c */
      for (int j = 0; j < n; j++) {
        int at = g->unknowns[j];
        if (j >= ns || frozen[at] != 0) w->core.a[at] = 0;
      }
      continue;
    }
    memcpy(z, w->core.force + g->vector, sizeof(double) * (size_t)active);
    add_responses(m, w, g, z);
    if (!g->general) frot_outwards(w, g, z);
    for (int j = 0; j < n; j++) {
      int at = g->unknowns[j], auxiliary = j >= ns && j < ns + g->n_auxiliary;
      w->core.a[at] = auxiliary || (j < ns && frozen[at] != 0) ? 0 : z[j];
    }
  }
}

double frot_metric_entry(const frot_model *m, frot_work *w, int a, int b) {
  const frot_group *g = &m->groups[m->speed_group[a]];
  if (m->speed_group[b] != m->speed_group[a]) return 0;
  return frot_metric_column(w, g, m->speed_local[b])[m->speed_local[a]];
}

double frot_kinetic(const frot_model *m, const frot_work *w, const double *v) {
  double sum = 0;
  for (int k = 0; k < w->awake.now->n_groups; k++)
    sum += frot_square_of(w, &m->groups[w->awake.now->groups[k]], v);
  return 0.5 * sum;
}

int frot_energies(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, double energy[3]) {
  energy[0] = energy[1] = energy[2] = 0;
  if (!m->energy.call) return FROT_OK;
  int status = frot_solve_blocks(m, s, w, t, q, v, d);
  if (status != FROT_OK) return status;
  frot_inputs(s, w, &t, q, v, d);
  w->call.res[0] = energy, w->call.res[1] = energy + 1, w->call.res[2] = energy + 2;
  frot_call(w, &m->energy);
  return FROT_OK;
}
