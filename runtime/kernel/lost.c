#include "lost.h"

#include <math.h>
#include <string.h>

#include "core.h"
#include "crossing.h"
#include "dormand_prince.h"
#include "groups.h"
#include "inertia.h"
#include "mechanics.h"
#include "projection.h"
#include "stages.h"
#include "terms.h"
#include "tolerances.h"
#include "turns.h"

/* Angle by which rounding may turn the direction of a weak row. */
#define MOST_TILT 1e-7
/* The same at the start of a step, whose speeds were put onto the relations there. */
#define MOST_TILT_AT_START 1e-8
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

int frot_lost_row(const frot_model *m, const frot_state *s, const frot_work *w, double t,
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
    if (is_turned(gap, start, way * fabs(at), MOST_TILT_AT_START)) return i;
    for (int j = 1; j <= DP_STAGES; j++) {
      double distance = way * fabs(dp_c[j] - at);
      if (!w->step.near[j] && is_turned(gap, fabs(left[m->n_rows * j]), distance, MOST_TILT))
        return i;
    }
  }
  return -1;
}

/* Note the rows of loops that depend on others at the last evaluation, in `carried`, and what is
 * left of those that nearly do. Returns whether there are any. */
static int note_weak(const frot_model *m, const frot_state *s, frot_work *w,
                     unsigned char *carried) {
  int any = 0;
  double longest = 0;
  for (int i = 0; i < m->n_contacts; i++)
    if (frot_is_loop(m, s, w, i)) longest = fmax(longest, w->span.left[m->contacts[i].row_n]);
  for (int i = 0; i < m->n_contacts; i++) {
    if (!frot_is_loop(m, s, w, i)) continue;
    int row = m->contacts[i].row_n;
    double left = w->span.left[row];
    carried[row] = w->reactions.carried[row];
    w->step.left[row] = carried[row] || left < CLOSE * longest ? left : INFINITY;
    any |= isfinite(w->step.left[row]);
  }
  return any;
}

void frot_starts_singular(const frot_model *m, frot_state *s, frot_work *w, double t, double h,
                          unsigned char *lost) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  double *z = w->step.z, *step = w->relations.step;
  unsigned char *carried = w->span.spare;
  int moved;
  memset(lost, 0, (size_t)m->n_contacts);
  if (!note_weak(m, s, w, carried)) return;
  memcpy(z, w->step.z0, sizeof(double) * (size_t)w->layout.nx);
  for (int k = 0; k < m->n_groups; k++) {
    const frot_group *g = &m->groups[k];
    for (int i = 0; i < g->n_speeds; i++) {
      int speed = g->unknowns[i];
      step[i] = h * (z[m->nq + speed] + 0.5 * h * w->core.a[speed]);
    }
    frot_displace(m, g, z, step, 1);
  }
  if (frot_project(m, s, w, t + h, z, z + m->nq, s->data + w->layout.d, modes, NULL, &moved))
    return;
  memset(w->reactions.carried, 0, (size_t)m->n_rows);
  if (frot_slope(m, s, w, t + h, z, frot_stage(w, 1)) != FROT_OK) return;
  for (int k = 0; k < m->n_groups; k++) {
    const frot_group *g = &m->groups[k];
    for (int j = 0, found = 0; j < g->n_contacts && !found; j++) {
      int i = g->contacts[j], row = m->contacts[i].row_n;
      if (!frot_is_loop(m, s, w, i)) continue;
      double now = w->reactions.carried[row] ? 0 : w->span.left[row];
      found = carried[row] ? now > 0 : now > MORE * w->step.left[row];
      lost[i] = (unsigned char)found;
    }
  }
}
