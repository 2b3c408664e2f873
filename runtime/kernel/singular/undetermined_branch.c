#include "singular/undetermined_branch.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "singular/singular_posture.h"
#include "numerics/dormand_prince_table.h"
#include "model/indexing.h"
#include "inertia/mass_matrix.h"
#include "constraints/projection.h"
#include "model/stage_slopes.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"
#include "evaluation/quaternions.h"

/* Part of the longest that is left of a row at a start next to a posture, and how many times that
 * much a little later: speeds that are given there are known with an error of rounding over the
 * square of this part. */
#define CLOSE 5e-4
#define MORE 5

int frot_posture_at(const frot_model *m, const frot_state *s, const frot_work *w, double t) {
  int nearest = -1;
  double least = INFINITY;
  for (int k = 0; k < w->awake.now->n_contacts && s->weak; k++) {
    int i = w->awake.now->contacts[k];
    if (!frot_is_loop(m, s, w, i)) continue;
    double away = fabs(s->data[w->layout.posture + m->contacts[i].row_n] - t);
    if (away < least) least = away, nearest = i;
  }
  return nearest;
}

/* Whether rounding turns the direction of a row of which so much is left, so far from a posture. */
static int is_turned(double gap, double left, double way, double most) {
  return left > 0 && gap > most * left * way;
}

/* The speed of a group in the step, in the metric of its mass: the larger of those at its ends, one
 * of which may be rest. */
static double fastest(const frot_model *m, const frot_work *w, const frot_group *g) {
  return sqrt(
      fmax(frot_square_of(w, g, w->step.z0 + m->nq), frot_square_of(w, g, w->step.z1 + m->nq)));
}

int frot_undetermined_row(const frot_model *m, const frot_state *s, const frot_work *w, double t,
                          double h) {
  for (int k = 0; k < w->awake.now->n_contacts && s->weak; k++) {
    int i = w->awake.now->contacts[k];
    if (!frot_is_loop(m, s, w, i)) continue;
    int row = m->contacts[i].row_n;
    double at = (s->data[w->layout.posture + row] - t) / h;
    double way = h * fastest(m, w, frot_group_of(m, row));
    double gap = FROT_ROUNDING * frot_gap_size(m, w, row, w->step.z1);
    const double *left = w->step.left + row;
    if (isnan(at)) continue;
    double start = fabs(left[m->n_rows * DP_STAGES] * at / (1 - at));
    if (is_turned(gap, start, way * fabs(at), FROT_MOST_TILT_AT_START)) return i;
    for (int j = 1; j <= DP_STAGES; j++) {
      double distance = way * fabs(dp_c[j] - at);
      if (!w->step.near[j] && is_turned(gap, fabs(left[m->n_rows * j]), distance, FROT_MOST_TILT))
        return i;
    }
  }
  return -1;
}

/* What those before it leave of each row of a loop at (t, z), 0 where it depends on them (then it
 * is marked as `carried`), into `left` (n_rows; INFINITY of other rows): of the rows alone, for
 * friction that follows their reactions may have no value next to a posture. Returns whether that
 * was to be had. */
static int measure_loops(const frot_model *m, frot_state *s, frot_work *w, double t,
                         const double *z, double *left) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  for (int row = 0; row < m->n_rows; row++) left[row] = INFINITY, w->reactions.carried[row] = 0;
  if (frot_dynamics(m, s, w, t, z, z + m->nq, s->data + w->layout.d, modes, FROT_INERTIA)) return 0;
  for (int k = 0; k < m->n_groups; k++) {
    const frot_group *g = &m->groups[k];
    int n = 0;
    for (int i = 0; i < g->n_contacts; i++)
      if (frot_is_loop(m, s, w, g->contacts[i]))
        w->relations.rows[n++] = m->contacts[g->contacts[i]].row_n;
    frot_orthonormal_rows(m, w, g, n, n, NULL);
    for (int i = 0; i < n; i++) {
      int own = w->linear.pivot[i];
      w->reactions.carried[w->relations.rows[i]] = own < 0;
      left[w->relations.rows[i]] = own < 0 ? 0 : w->linear.matrix[n * i + own];
    }
  }
  return 1;
}

void frot_starts_singular(const frot_model *m, frot_state *s, frot_work *w, double t, double h,
                          unsigned char *lost) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  double *z = w->step.z, *left = w->step.left, *later = left + m->n_rows, longest = 0;
  int moved;
  memset(lost, 0, (size_t)m->n_contacts);
  if (!frot_has_loops(m, s, w)) return;
  memcpy(z, w->step.z0, sizeof(double) * (size_t)w->layout.nx);
  for (int k = 0; k < m->n_groups; k++)
    frot_coordinates_after(m, &m->groups[k], w->step.z0 + m->nq, w->core.a, h, w->relations.step,
                           z);
  if (!measure_loops(m, s, w, t, w->step.z0, left)) return;
  for (int row = 0; row < m->n_rows; row++)
    if (isfinite(left[row])) longest = fmax(longest, left[row]);
  if (frot_project(m, s, w, t + h, z, z + m->nq, s->data + w->layout.d, modes, NULL, NULL, &moved))
    return;
  if (!measure_loops(m, s, w, t + h, z, later)) return;
  for (int k = 0; k < m->n_groups; k++) {
    const frot_group *g = &m->groups[k];
    for (int j = 0, found = 0; j < g->n_contacts && !found; j++) {
      int i = g->contacts[j], row = m->contacts[i].row_n;
      if (!frot_is_loop(m, s, w, i) || !(left[row] < CLOSE * longest)) continue;
      found = later[row] > MORE * left[row];
      lost[i] = (unsigned char)found;
    }
  }
}
