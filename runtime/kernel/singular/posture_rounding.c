#include "singular/posture_rounding.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "singular/singular_posture.h"
#include "numerics/dormand_prince_table.h"
#include "model/indexing.h"
#include "inertia/mass_matrix.h"
#include "numerics/dense.h"
#include "model/stage_slopes.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

/* What rounding of a gap makes of the error of a speed, but for the posture's distance. */
#define NOISE 5.0
/* Sine of the angle by which the direction of a weak row may turn in a step. */
#define MOST_TURN 0.6

/* y (n_speeds) <- L' v, by the mass matrix A = L L'. */
static void into_metric(frot_work *w, const frot_group *g, const double *v, double *y) {
  frot_momenta(w, g, v, y);
  frot_inwards(w, g, y);
}

/* Sine of the angle by which the motion along a row turns in the step. */
static double turn_of(const frot_model *m, frot_work *w, int row) {
  const frot_group *g = frot_group_of(m, row);
  double *y = w->core.load_size;
  into_metric(w, g, frot_entries(m, w->step.motion, row), y);
  double along = frot_dot(frot_entries(m, w->span.direction, row), y, g->n_speeds);
  double square = frot_dot(y, y, g->n_speeds);
  return square > 0 ? sqrt(fmax(0, 1 - along * along / square)) : 0;
}

/* The error of speeds along the direction of a weak row that rounding of its gap may make; *across:
 * beside it, as the direction turns and is itself known to rounding. */
static double noise_of(const frot_model *m, frot_work *w, int row, double at, double h, double bend,
                       double *across) {
  double along = 0, beside = 0, turn = turn_of(m, w, row);
  double gap = NOISE * FROT_ROUNDING * frot_gap_size(m, w, row, w->step.z1);
  if (at > -FROT_AROUND && at < 1 + FROT_AROUND && w->span.left[row] > 0)
    w->step.turning = fmax(w->step.turning, turn / MOST_TURN);
  for (int i = 1; i <= DP_STAGES; i++) {
    double left = fabs(w->step.left[m->n_rows * i + row]), distance = fabs(dp_c[i] - at) * h;
    if (w->step.near[i] || !(left > 0)) continue;
    double noise = gap * h / (left * distance * distance);
    along = fmax(along, noise), beside = fmax(beside, noise * fmin(1, turn + bend * distance));
  }
  *across += beside;
  return along;
}

/* y <- L' times the estimate, by these weights, of the error of the group's speeds. */
static void estimate(const frot_model *m, frot_work *w, const frot_group *g, const double *weights,
                     double h, double *y) {
  double *error = w->core.load_size;
  for (int k = 0; k < g->n_speeds; k++) {
    double sum[FROT_CHUNK];
    int at = w->awake.now->place[m->nq + g->unknowns[k]];
    frot_weigh_stages(w, weights, DP_STAGES + 1, at, 1, sum);
    error[k] = h * sum[0];
  }
  into_metric(w, g, error, y);
}

/* Leave out of the estimate what is noise of the group's weak rows: along their directions, and, as
 * these turn, a little across. */
static void excuse(const frot_model *m, const frot_state *s, frot_work *w, const frot_group *g,
                   const double *weights, double t, double h, double *excused) {
  int ns = g->n_speeds, weak = 0;
  double *error = w->core.rest, *rest = w->core.column, across = 0;
  double bend = sqrt(frot_square_of(w, g, w->core.a) /
                     fmax(frot_square_of(w, g, w->step.z1 + m->nq), DBL_MIN));
  estimate(m, w, g, weights, h, error);
  memcpy(rest, error, sizeof(double) * (size_t)ns);
  for (int i = 0; i < g->n_contacts; i++) {
    int contact = g->contacts[i], row = m->contacts[contact].row_n;
    if (!frot_is_loop(m, s, w, contact)) continue;
    double at = (s->data[w->layout.posture + row] - t) / h;
    if (isnan(at) || w->span.left[row] == 0) continue;
    const double *direction = frot_entries(m, w->span.direction, row);
    double noise = noise_of(m, w, row, at, h, bend, &across),
           along = frot_dot(direction, error, ns);
    along = fmin(fmax(along, -noise), noise), weak = 1;
    for (int k = 0; k < ns; k++) rest[k] -= along * direction[k];
  }
  if (!weak) return;
  double length = frot_length(rest, ns);
  double part = length > across ? 1 - across / length : 0;
  for (int k = 0; k < ns; k++) error[k] -= part * rest[k];
  frot_outwards(w, g, error);
  for (int k = 0; k < ns; k++) excused[g->unknowns[k]] = error[k];
}

void frot_excuse_rounding(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  const frot_awake_lists *now = w->awake.now;
  w->step.turning = 0;
  for (int k = 0; k < now->n - FROT_QUADRATURES; k++) {
    int speed = now->states[k] - m->nq;
    if (speed >= 0) w->step.excused[speed] = w->step.excused[m->nv + speed] = 0;
  }
  for (int k = 0; k < now->n_groups && frot_has_loops(m, s, w); k++) {
    const frot_group *g = &m->groups[now->groups[k]];
    excuse(m, s, w, g, dp_e5, t, h, w->step.excused);
    excuse(m, s, w, g, dp_e3, t, h, w->step.excused + m->nv);
  }
}

/* Whether friction follows reactions in the group, so that they may have a pole. */
static int slips(const frot_model *m, const frot_state *s, const frot_work *w,
                 const frot_group *g) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  for (int k = 0; k < g->n_elements; k++) {
    const frot_element *e = &m->elements[g->elements[k]];
    int friction = frot_element_mode(m, modes, g->elements[k])->friction;
    int moves = friction == FROT_SLIP_FORWARD || friction == FROT_SLIP_BACKWARD;
    if (moves && e->bound != FROT_BY_VALUE && modes[e->contact].closed) return 1;
  }
  return 0;
}

/* The speed, in the metric of the mass, that is rest beside errors: where one that drowns it moves
 * the group's places in a longest step by no more than FROT_TOUCH of what they are. */
static double slowest(const frot_model *m, const frot_state *s, frot_work *w, const frot_group *g) {
  double *place = w->core.load_size;
  for (int k = 0; k < g->n_speeds; k++) {
    int speed = g->unknowns[k], at = m->speed_coordinate[speed];
    double own = at >= 0 ? fabs(w->step.z1[at]) : 0;
    place[k] = m->speed_turns[speed] ? fmax(own, 1) : own;
  }
  into_metric(w, g, place, w->core.rest);
  return FROT_TOUCH / (FROT_DROWNED * s->h_max) *
         sqrt(frot_dot(w->core.rest, w->core.rest, g->n_speeds));
}

double frot_part_of_motion(const frot_model *m, const frot_state *s, frot_work *w, double h) {
  double most = 0;
  for (int i = 0; i < w->awake.now->n_groups; i++) {
    const frot_group *g = &m->groups[w->awake.now->groups[i]];
    if (g->general || !slips(m, s, w, g)) continue;
    const double *force = w->core.force + g->vector;
    double motion = sqrt(frot_square_of(w, g, w->step.z1 + m->nq)) +
                    h * sqrt(frot_dot(force, force, g->n_speeds)) + slowest(m, s, w, g);
    if (motion > 0) most = fmax(most, sqrt(frot_square_of(w, g, w->step.beyond)) / motion);
  }
  return most;
}
