#include "singular/tangent_cone.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "singular/singular_posture.h"
#include "model/indexing.h"
#include "inertia/mass_matrix.h"
#include "numerics/dense.h"
#include "numerics/basis.h"
#include "constraints/projection.h"
#include "constraints/redundant_rows.h"
#include "numerics/tolerances.h"
#include "evaluation/quaternions.h"

/* Angle by which a loop is moved to see how its rows turn, and how what they say changes: central
 * differences of order four, at these points. */
#define LITTLE 1e-3
#define POINTS 4
static const double at[POINTS] = {-2, -1, 1, 2};
static const double weight[POINTS] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12};
/* The least size of the rate of a row, in what its longest like would turn by: central differences
 * have rounding of some 1e-13 of that. */
#define LEAST_RATE 1e-4

/* The rows of loops of a group into w->relations.rows, their number; 0 where anything else than
 * these acts, for it would follow reactions that have no limit in the posture. */
static int list_rows(const frot_model *m, const frot_state *s, const frot_work *w,
                     const frot_group *g) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  int n = 0;
  if (g->general || g->n_elements > 0) return 0;
  for (int i = 0; i < g->n_contacts; i++) {
    int contact = g->contacts[i];
    if (frot_is_loop(m, s, w, contact))
      w->relations.rows[n++] = m->contacts[contact].row_n;
    else if (modes[contact].closed && !m->contacts[contact].reduced)
      return 0;
  }
  return n;
}

double frot_time_of_turn(const frot_model *m, const frot_state *s, const frot_group *g,
                         const double *v) {
  frot_layout l = frot_layout_of(m);
  double reach = 0, pace = 0;
  for (int i = 0; i < g->n_contacts; i++)
    if (!m->contacts[g->contacts[i]].turns) reach = fmax(reach, s->data[l.reach + g->contacts[i]]);
  for (int i = 0; i < g->n_speeds; i++) {
    int speed = g->unknowns[i];
    double by = m->speed_turns[speed] ? 1 : reach > 0 ? 1 / reach : 0;
    pace = fmax(pace, by * fabs(v[speed]));
  }
  return pace > 0 ? 1 / pace : INFINITY;
}

/* Of the values of n rows, w->reactions.solution, what is left of those of the dependent ones
 * without the others, into w->span.bias_size, after frot_orthonormal_rows. With `sizes` the values
 * are sizes, and so is what is left: that of its terms. */
static void leave_over(const frot_work *w, int n, int sizes) {
  double *own = w->span.bias, *left = w->span.bias_size;
  for (int i = 0, rank = 0; i < n; i++) {
    const double *parts = w->linear.matrix + n * i;
    double rest = w->reactions.solution[i];
    for (int k = 0; k < rank; k++) rest += sizes ? fabs(parts[k]) * own[k] : -parts[k] * own[k];
    left[i] = rest;
    if (w->linear.pivot[i] < 0) continue;
    own[rank] = rest / (sizes ? fabs(parts[rank]) : parts[rank]);
    rank++;
  }
}

/* The rates of the rows along the motion v, into w->step.motion. */
static int turn_rows(const frot_model *m, frot_state *s, frot_work *w, const frot_group *g,
                     double t, const double *q, const double *v, const double *d, int n) {
  double *moved = w->opening.found, time = LITTLE * frot_time_of_turn(m, s, g, v);
  for (int point = 0; point < POINTS; point++) {
    memcpy(moved, q, sizeof(double) * (size_t)m->nq);
    frot_coordinates_after(m, g, v, NULL, at[point] * time, w->core.rest, moved);
    int status = frot_kinematics(m, s, w, t + at[point] * time, moved, v, d);
    if (status != FROT_OK) return status;
    for (int i = 0; i < n; i++) {
      double *rate = frot_entries(m, w->step.motion, w->relations.rows[i]);
      const double *row = frot_entries(m, w->core.rows, w->relations.rows[i]);
      for (int k = 0; k < g->n_speeds; k++)
        rate[k] = (point == 0 ? 0 : rate[k]) + weight[point] / time * row[k];
    }
  }
  return frot_kinematics(m, s, w, t, q, v, d);
}

/* longest[k] <- the length, times L^-1, of the longest of the rows of loops between places (k = 0)
 * and between directions (k = 1). */
static void measure_rows(const frot_model *m, const frot_state *s, frot_work *w,
                         const frot_group *g, double longest[2]) {
  double *half = w->core.rest;
  longest[0] = longest[1] = 0;
  for (int i = 0; i < g->n_contacts; i++) {
    const frot_contact *contact = &m->contacts[g->contacts[i]];
    if (!frot_is_loop(m, s, w, g->contacts[i])) continue;
    memcpy(half, frot_entries(m, w->core.rows, contact->row_n),
           sizeof(double) * (size_t)g->n_speeds);
    frot_inwards(w, g, half);
    double *own = &longest[contact->turns != 0];
    *own = fmax(*own, sqrt(frot_dot(half, half, g->n_speeds)));
  }
}

/* sizes (n) <- the least sizes of the rates of the rows of loops, at this pace of the angles. */
static void size_rates(const frot_model *m, const frot_state *s, frot_work *w, const frot_group *g,
                       double pace, double *sizes) {
  double longest[2];
  measure_rows(m, s, w, g, longest);
  for (int i = 0, n = 0; i < g->n_contacts; i++)
    if (frot_is_loop(m, s, w, g->contacts[i]))
      sizes[n++] = LEAST_RATE * pace * longest[m->contacts[g->contacts[i]].turns != 0];
}

/* The rates of the combinations that leave nothing of the dependent rows, times L^-1, one after the
 * other into w->linear.scratch, and the sizes of their terms into w->reactions.weight. */
static void turn_combinations(const frot_model *m, const frot_state *s, frot_work *w,
                              const frot_group *g, double pace, int n) {
  int ns = g->n_speeds;
  double *all = w->linear.scratch, *values = w->reactions.solution;
  for (int k = 0; k < ns; k++) {
    for (int i = 0; i < n; i++)
      values[i] = frot_entries(m, w->step.motion, w->relations.rows[i])[k];
    leave_over(w, n, 0);
    for (int i = 0, row = 0; i < n; i++)
      if (w->linear.pivot[i] < 0) all[ns * row++ + k] = w->span.bias_size[i];
  }
  size_rates(m, s, w, g, pace, values);
  for (int i = 0, row = 0; i < n; i++) {
    double *rate = frot_entries(m, w->step.motion, w->relations.rows[i]);
    frot_inwards(w, g, rate);
    values[i] = fmax(values[i], frot_length(rate, ns));
    if (w->linear.pivot[i] < 0) frot_inwards(w, g, all + ns * row++);
  }
  leave_over(w, n, 1);
  for (int i = 0, row = 0; i < n; i++)
    if (w->linear.pivot[i] < 0) w->reactions.weight[row++] = w->span.bias_size[i];
}

/* Of these combinations the ones that say something of their own, made orthonormal beside the rows:
 * their number. Triangular parts after them in w->linear.scratch, their rows in w->span.way. */
static int keep_own(frot_work *w, const frot_group *g, int n) {
  int ns = g->n_speeds, rank = 0, count = 0;
  for (int i = 0; i < n; i++) rank += w->linear.pivot[i] >= 0;
  double *all = w->linear.scratch, *triangle = all + n * ns;
  for (int i = 0, row = 0; i < n; i++) {
    if (w->linear.pivot[i] >= 0) continue;
    const double *turned = all + ns * row;
    double *x = all + ns * count, least = FROT_TURNS_NOT * w->reactions.weight[row++];
    for (int k = 0; k < ns; k++) x[k] = turned[k];
    frot_reject(x, w->span.basis, rank, ns, w->span.parts);
    double rest = frot_reject(x, all, count, ns, triangle + n * count);
    if (!(rest > least)) continue;
    for (int k = 0; k < ns; k++) x[k] /= rest;
    triangle[n * count + count] = rest;
    w->span.way[count++] = i;
  }
  return count;
}

/* w->linear.right <- what the combinations kept make of the values of the rows, over what turns
 * them: how far to go along each of them. */
static void solve_along(const frot_work *w, const frot_group *g, int n, int count) {
  const double *triangle = w->linear.scratch + n * g->n_speeds;
  double *right = w->linear.right;
  leave_over(w, n, 0);
  for (int i = 0; i < count; i++) {
    double rest = w->span.bias_size[w->span.way[i]];
    for (int k = 0; k < i; k++) rest -= triangle[n * i + k] * right[k];
    right[i] = rest / triangle[n * i + i];
  }
}

/* The combinations of the rows of a group that its speeds turn, ready for solve_along: their
 * number. *n: that of the rows. */
static int turning(const frot_model *m, frot_state *s, frot_work *w, const frot_group *g, double t,
                   const double *q, const double *v, const double *d, int *n) {
  *n = list_rows(m, s, w, g);
  if (*n == 0) return 0;
  frot_orthonormal_rows(m, w, g, *n, *n, NULL);
  int dependent = 0;
  for (int i = 0; i < *n; i++) dependent += w->linear.pivot[i] < 0;
  if (dependent == 0 || isinf(frot_time_of_turn(m, s, g, v))) return 0;
  if (turn_rows(m, s, w, g, t, q, v, d, *n) != FROT_OK) return 0;
  turn_combinations(m, s, w, g, 1 / frot_time_of_turn(m, s, g, v), *n);
  return keep_own(w, g, *n);
}

int frot_has_loops_alone(const frot_model *m, const frot_state *s, const frot_work *w,
                         const frot_group *g) {
  return list_rows(m, s, w, g) > 0;
}

int frot_find_branches(const frot_model *m, frot_state *s, frot_work *w, const frot_group *g,
                       double t, const double *q, const double *v, const double *d) {
  if (list_rows(m, s, w, g) > 0) frot_note_reaches(m, s, w, t, q, v, d);
  int n, count = turning(m, s, w, g, t, q, v, d, &n);
  if (count == 0) return 0;
  /* the slope of k'c by the speeds is twice what turns k'J */
  for (int i = 0; i < n; i++) w->reactions.solution[i] = 0.5 * w->core.c[w->relations.rows[i]];
  solve_along(w, g, n, count);
  for (int i = 0; i < count; i++) w->span.way[i] = w->relations.rows[w->span.way[i]];
  return count;
}

/* values <- what the accelerations of n rows change by in time, along the motion with accelerations
 * a. */
static int change_rows(const frot_model *m, frot_state *s, frot_work *w, const frot_group *g,
                       double t, const double *q, const double *v, const double *a, const double *d,
                       const frot_contact_mode *modes, int n, double *values) {
  double *there = w->opening.found, *speeds = w->opening.begin;
  double time = LITTLE * frot_time_of_turn(m, s, g, v);
  for (int i = 0; i < n; i++) values[i] = 0;
  for (int k = 0; k < POINTS; k++) {
    double later = at[k] * time;
    memcpy(there, q, sizeof(double) * (size_t)m->nq);
    frot_coordinates_after(m, g, v, a, later, w->core.rest, there);
    for (int i = 0; i < m->nv; i++) speeds[i] = v[i] + later * a[i];
    int status = frot_dynamics(m, s, w, t + later, there, speeds, d, modes, FROT_INERTIA);
    if (status != FROT_OK) return status;
    for (int i = 0; i < n; i++) {
      int row = w->relations.rows[i];
      const double *entries = frot_entries(m, w->core.rows, row);
      double sum = w->core.c[row];
      for (int j = 0; j < g->n_speeds; j++) sum += entries[j] * a[g->unknowns[j]];
      values[i] += weight[k] / time * sum;
    }
  }
  return frot_dynamics(m, s, w, t, q, v, d, modes, FROT_INERTIA);
}

/* Whether a row of the group depends on others that does not do so for good. */
static int is_in_posture(const frot_model *m, const frot_state *s, const frot_work *w,
                         const frot_group *g, const double *spare) {
  for (int i = 0; i < g->n_contacts; i++) {
    int row = m->contacts[g->contacts[i]].row_n;
    if (row >= 0 && frot_is_loop(m, s, w, g->contacts[i]) && w->reactions.carried[row] &&
        spare[row] == 0)
      return 1;
  }
  return 0;
}

int frot_accelerations_on_branch(const frot_model *m, frot_state *s, frot_work *w, double t,
                                 const double *q, const double *v, const double *d,
                                 const frot_contact_mode *modes, const double *spare) {
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_groups; k++) {
    const frot_group *g = &m->groups[now->groups[k]];
    if (!is_in_posture(m, s, w, g, spare)) continue;
    frot_forget_redundant_rows(w);
    int n, count = turning(m, s, w, g, t, q, v, d, &n);
    if (count == 0) continue;
    int status = change_rows(m, s, w, g, t, q, v, w->core.a, d, modes, n, w->reactions.solution);
    if (status != FROT_OK) return status;
    solve_along(w, g, n, count);
    double *more = w->core.rest;
    memset(more, 0, sizeof(double) * (size_t)g->n_speeds);
    for (int i = 0; i < count; i++)
      for (int j = 0; j < g->n_speeds; j++)
        more[j] -= w->linear.right[i] / 3 * w->linear.scratch[g->n_speeds * i + j];
    frot_outwards(w, g, more);
    for (int j = 0; j < g->n_speeds; j++) w->core.a[g->unknowns[j]] += more[j];
  }
  return FROT_OK;
}

/* Speeds that are zero there, or small, are known no better than the others of their kind. */
static void size_speeds(const frot_model *m, frot_state *s, const frot_work *w, const frot_group *g,
                        const double *v) {
  double *scale = s->data + w->layout.scale_x + m->nq, largest[2] = {0, 0};
  for (int i = 0; i < g->n_speeds; i++) {
    double *of_kind = &largest[m->speed_turns[g->unknowns[i]] != 0];
    *of_kind = fmax(*of_kind, fabs(v[g->unknowns[i]]));
  }
  for (int i = 0; i < g->n_speeds; i++) {
    int speed = g->unknowns[i];
    scale[speed] = fmax(scale[speed], FROT_LEAST_SIZE * largest[m->speed_turns[speed] != 0]);
  }
}

int frot_begins_on_branch(const frot_model *m, frot_state *s, frot_work *w, double t, int contact) {
  const frot_group *g = frot_group_of(m, m->contacts[contact].row_n);
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  const double *q = w->step.z0, *v = q + m->nq, *d = s->data + w->layout.d;
  frot_find_redundant_rows(m, s, w);
  if (frot_dynamics(m, s, w, t, q, v, d, modes, FROT_INERTIA) != FROT_OK) return 0;
  int count = frot_find_branches(m, s, w, g, t, q, v, d);
  for (int i = 0; i < count; i++) s->data[w->layout.posture + w->span.way[i]] = t;
  if (count == 0) return 0;
  size_speeds(m, s, w, g, v);
  s->from_posture = s->weak = s->tied = 1;
  return 1;
}
