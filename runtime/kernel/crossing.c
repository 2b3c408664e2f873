#include "crossing.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core.h"
#include "dormand_prince.h"
#include "groups.h"
#include "inertia.h"
#include "linear.h"
#include "reactions.h"
#include "stages.h"
#include "tolerances.h"

/* Stages at different instants, in their order. */
enum { COUNT = 11 };
static const int in_order[COUNT] = {1, 2, 3, 6, 4, 7, 5, 9, 8, 10, 12};
/* Part of a step up to which a stage is too near a posture. */
#define NEAR 0.1
/* In steps, how far before its start and beyond its end a posture is looked for, and up to where it
 * makes relations weak. */
#define BEHIND (-1.0)
#define AHEAD 2.0
#define AROUND 0.6
/* In steps, how near one makes the next step weak. */
#define FOLLOWS 2
/* Part of what is left of a row elsewhere below which a stage shows no more than rounding. */
#define LITTLE 0.1
/* Passes over a step that has stages too near. */
#define PASSES 3
/* The widest gap between two stages, but for what is too near them, and its middle. */
#define GAP_BEGINS 0.4334
#define GAP 0.4667
#define GAP_ENDS 0.4999
/* Room that a step leaves before a posture, at least, in those that follow. */
#define LEAST_ROOM 0.3
/* In steps, where a posture is as good as passed. */
#define LATE 0.04
/* How much longer and shorter steps are laid, and in what parts. */
#define LONGER 1.15
#define SHORTER 0.98
#define SHORTEST 0.05
/* What rounding of a gap makes of the error of a speed, but for the posture's distance. */
#define NOISE 5.0
#define BESIDE 0.1 /* of what may be there, that is */
/* Sine of the angle by which the direction of a weak row may turn in a step. */
#define MOST_TURN 0.6
/* Angle by which rounding may turn the direction of a weak row. */
#define MOST_TILT 1e-6
/* Slopes that a polynomial goes through. */
#define POINTS 6

static int is_loop(const frot_model *m, const frot_state *s, const frot_work *w, int contact) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  return s->data[w->layout.unilateral + contact] == 0 && frot_is_loaded(m, modes, contact) &&
         !frot_group_of(m, m->contacts[contact].row_n)->general;
}

int frot_has_loops(const frot_model *m, const frot_state *s, const frot_work *w) {
  for (int k = 0; k < w->awake.now->n_contacts; k++)
    if (is_loop(m, s, w, w->awake.now->contacts[k])) return 1;
  return 0;
}

void frot_note_rows(const frot_model *m, const frot_state *s, frot_work *w, int stage) {
  for (int k = 0; k < w->awake.now->n_contacts; k++) {
    int i = w->awake.now->contacts[k];
    if (!is_loop(m, s, w, i)) continue;
    int row = m->contacts[i].row_n, ns = frot_group_of(m, row)->n_speeds;
    double left = w->span.left[row], along = 0;
    const double *direction = frot_entries(m, w->span.direction, row);
    double *first = frot_entries(m, w->step.direction, row);
    if (stage == 1) {
      double *motion = frot_entries(m, w->step.motion, row);
      memcpy(first, direction, sizeof(double) * (size_t)ns);
      memcpy(motion, direction, sizeof(double) * (size_t)ns);
      if (s->weak) frot_outwards(w, frot_group_of(m, row), motion);
    }
    along = frot_dot(first, direction, ns);
    w->step.left[m->n_rows * stage + row] = along < 0 ? -left : left;
  }
}

/* The last stage up to `reached` that shows what is left of a row: beyond one where that is little
 * and which was evaluated, there may be anything. */
static int last_sound(const frot_model *m, const frot_work *w, int row, int reached) {
  double most = 0;
  for (int i = 1; i <= reached; i++) {
    double left = fabs(w->step.left[m->n_rows * i + row]);
    if (left < LITTLE * most && !w->step.near[i]) return i;
    most = fmax(most, left);
  }
  return reached;
}

/* Where a row becomes dependent, as a part of the step; NAN if nowhere. What is left of it goes to
 * zero and on, with its sign, in a straight line. */
static double find_zero(const frot_model *m, const frot_work *w, int row, int reached) {
  double time[COUNT], left[COUNT];
  int n = 0, last = last_sound(m, w, row, reached);
  for (int k = 0; k < COUNT; k++) {
    if (in_order[k] > last) continue;
    time[n] = dp_c[in_order[k]], left[n] = w->step.left[m->n_rows * in_order[k] + row];
    n++;
  }
  if (n < 3) return NAN;
  for (int k = 1; k < n; k++)
    if (left[k - 1] * left[k] <= 0 && left[k - 1] != left[k])
      return time[k - 1] +
             (time[k] - time[k - 1]) * fabs(left[k - 1]) / (fabs(left[k - 1]) + fabs(left[k]));
  double ahead = fabs(left[n - 2]) - fabs(left[n - 1]), behind = fabs(left[2]) - fabs(left[0]);
  if (ahead > 0) {
    double at = time[n - 1] + (time[n - 1] - time[n - 2]) * fabs(left[n - 1]) / ahead;
    if (at < AHEAD) return at;
  }
  if (behind > 0) {
    double at = time[0] - (time[2] - time[0]) * fabs(left[0]) / behind;
    if (at > BEHIND) return at;
  }
  return NAN;
}

/* Where row becomes dependent, as a part of the step, found now or known from before; NAN if
 * nowhere. */
static double locate(const frot_model *m, frot_state *s, const frot_work *w, int row, int reached,
                     double t, double h) {
  double *posture = s->data + w->layout.posture + row, at = find_zero(m, w, row, reached);
  double known = (*posture - t) / h;
  if (isnan(at) && !(known > 0 && known < 1)) at = known;
  *posture = t + at * h;
  return at;
}

int frot_find_crossings(const frot_model *m, frot_state *s, frot_work *w, double t, double h,
                        int reached, int pass) {
  int weak = 0, again = 0, any = 0;
  unsigned char near[DP_STAGES + 1] = {0};
  for (int k = 0; k < w->awake.now->n_contacts; k++) {
    int i = w->awake.now->contacts[k];
    if (!is_loop(m, s, w, i)) continue;
    double at = locate(m, s, w, m->contacts[i].row_n, reached, t, h);
    weak |= at > -AROUND && at < 1 + AROUND;
    for (int j = 0; j <= DP_STAGES; j++) near[j] |= fabs(dp_c[j] - at) < NEAR;
  }
  for (int k = 0; k <= DP_STAGES; k++) {
    again |= near[k] != w->step.near[k], any |= near[k];
    w->step.near[k] = near[k];
  }
  again |= weak && !s->weak;
  s->weak |= weak;
  return pass < PASSES && (again || (any && pass < PASSES - 1));
}

/* Whether a posture at `distance` is well placed in a step of this length, about h. Before the
 * first one, room is left to pass it in the next step. */
static int fits(double distance, double length, double h, int is_first, double room) {
  if (!(distance > LATE * h)) return 1;
  if (distance - length >= (is_first ? room * h : NEAR * length)) return 1;
  return distance >= GAP_BEGINS * length && distance <= GAP_ENDS * length;
}

static int all_fit(const frot_model *m, const frot_state *s, const frot_work *w, double t,
                   double length, double h, double room) {
  const double *posture = s->data + w->layout.posture;
  double first = INFINITY;
  for (int row = 0; row < m->n_rows; row++)
    if (posture[row] - t > LATE * h) first = fmin(first, posture[row] - t);
  for (int row = 0; row < m->n_rows; row++)
    if (!fits(posture[row] - t, length, h, posture[row] - t <= first + NEAR * h, room)) return 0;
  return 1;
}

int frot_is_laid(const frot_model *m, const frot_state *s, const frot_work *w, double t, double h,
                 double wanted) {
  return all_fit(m, s, w, t, h, wanted, LEAST_ROOM);
}

double frot_lay_step(const frot_model *m, const frot_state *s, const frot_work *w, double t,
                     double h, double longest) {
  if (all_fit(m, s, w, t, fmin(h, longest), h, GAP)) return fmin(h, longest);
  for (double length = fmin(LONGER * h, longest); length > SHORTEST * h; length *= SHORTER)
    if (all_fit(m, s, w, t, length, h, GAP)) return length;
  return fmin(h, longest);
}

void frot_interpolate_stage(const frot_model *m, frot_work *w, int stage, int reached) {
  int point[POINTS], n = 0;
  double part[POINTS];
  const double at = dp_c[stage];
  for (int k = 0; k <= COUNT; k++) {
    int i = k < COUNT ? in_order[k] : 0, to = n;
    if (i > reached || w->step.near[i] || i == 2) continue;
    for (; to > 0 && fabs(dp_c[point[to - 1]] - at) > fabs(dp_c[i] - at); to--)
      if (to < POINTS) point[to] = point[to - 1];
    if (to < POINTS) point[to] = i, n += n < POINTS;
  }
  for (int a = 0; a < n; a++) {
    part[a] = 1;
    for (int b = 0; b < n; b++)
      if (b != a) part[a] *= (at - dp_c[point[b]]) / (dp_c[point[a]] - dp_c[point[b]]);
  }
  /* the last of them is the farthest: without it the polynomial would be of a degree less */
  double *slope = frot_stage(w, stage), without = 0;
  double last = n > 1 ? part[n - 1] : 0;
  for (int j = 0; j < frot_width(w); j++) {
    if (j < w->awake.n && w->awake.now->states[j] < m->nq) continue;
    double sum = 0, lower = 0;
    for (int a = 0; a < n; a++) sum += part[a] * frot_stage(w, point[a])[j];
    for (int a = 0; a < n - 1; a++) {
      without = part[a] * (dp_c[point[a]] - dp_c[point[n - 1]]) / (at - dp_c[point[n - 1]]);
      lower += without * frot_stage(w, point[a])[j];
    }
    slope[j] = sum;
    w->step.doubt[j] += last == 0 ? 0 : fabs(sum - lower);
  }
}

void frot_keep_crossings(const frot_model *m, frot_state *s, const frot_work *w, double t,
                         double h) {
  const double *posture = s->data + w->layout.posture;
  int passed = 0;
  s->weak = 0;
  for (int row = 0; row < m->n_rows; row++) {
    passed |= posture[row] > t && posture[row] <= t + h;
    s->weak |= fabs(posture[row] - (t + h)) <= FOLLOWS * s->h;
  }
  s->statistics.crossings += passed;
}

/* y (n_speeds) <- L' v, by the mass matrix A = L L'. */
static void into_metric(frot_work *w, const frot_group *g, const double *v, double *y) {
  double *column = w->relations.step;
  memset(y, 0, sizeof(double) * (size_t)g->n_speeds);
  for (int k = 0; k < g->n_speeds; k++) {
    frot_mass_column(w, g, k, column);
    for (int i = 0; i < g->n_speeds; i++) y[i] += v[k] * column[i];
  }
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
  for (int i = 1; i <= DP_STAGES; i++) {
    double left = fabs(w->step.left[m->n_rows * i + row]), distance = fabs(dp_c[i] - at) * h;
    if (w->step.near[i] || !(left > 0)) continue;
    double noise = gap * h / (left * distance * distance);
    along = fmax(along, noise), beside = fmax(beside, noise * fmin(1, turn + bend * distance));
  }
  *across += BESIDE * beside;
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
    if (!is_loop(m, s, w, contact)) continue;
    double at = (s->data[w->layout.posture + row] - t) / h;
    if (isnan(at) || w->span.left[row] == 0) continue;
    const double *direction = frot_entries(m, w->span.direction, row);
    double noise = noise_of(m, w, row, at, h, bend, &across),
           along = frot_dot(direction, error, ns);
    along = fmin(fmax(along, -noise), noise), weak = 1;
    for (int k = 0; k < ns; k++) rest[k] -= along * direction[k];
  }
  if (!weak) return;
  double length = sqrt(frot_dot(rest, rest, ns));
  double part = length > across ? 1 - across / length : 0;
  for (int k = 0; k < ns; k++) error[k] -= part * rest[k];
  frot_outwards(w, g, error);
  for (int k = 0; k < ns; k++) excused[g->unknowns[k]] = error[k];
}

void frot_excuse_noise(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  memset(w->step.excused, 0, sizeof(double) * 2 * (size_t)m->nv);
  for (int k = 0; k < w->awake.now->n_groups && frot_has_loops(m, s, w); k++) {
    const frot_group *g = &m->groups[w->awake.now->groups[k]];
    excuse(m, s, w, g, dp_e5, t, h, w->step.excused);
    excuse(m, s, w, g, dp_e3, t, h, w->step.excused + m->nv);
  }
}

double frot_turning(const frot_model *m, const frot_state *s, frot_work *w, double t, double h) {
  double most = 0;
  for (int k = 0; k < w->awake.now->n_contacts && s->weak; k++) {
    int i = w->awake.now->contacts[k];
    if (!is_loop(m, s, w, i)) continue;
    int row = m->contacts[i].row_n;
    double at = (s->data[w->layout.posture + row] - t) / h;
    if (at > -AROUND && at < 1 + AROUND && w->span.left[row] > 0)
      most = fmax(most, turn_of(m, w, row) / MOST_TURN);
  }
  return most;
}

int frot_posture_at(const frot_model *m, const frot_state *s, const frot_work *w, double t) {
  int nearest = -1;
  double least = INFINITY;
  for (int k = 0; k < w->awake.now->n_contacts && s->weak; k++) {
    int i = w->awake.now->contacts[k];
    if (!is_loop(m, s, w, i)) continue;
    double away = fabs(s->data[w->layout.posture + m->contacts[i].row_n] - t);
    if (away < least) least = away, nearest = i;
  }
  return nearest;
}

int frot_lost_row(const frot_model *m, const frot_state *s, const frot_work *w, double t,
                  double h) {
  for (int k = 0; k < w->awake.now->n_contacts && s->weak; k++) {
    int i = w->awake.now->contacts[k];
    if (!is_loop(m, s, w, i)) continue;
    int row = m->contacts[i].row_n;
    double at = (s->data[w->layout.posture + row] - t) / h;
    double speed = sqrt(frot_square_of(w, frot_group_of(m, row), w->step.z1 + m->nq));
    double gap = FROT_ROUNDING * frot_gap_size(m, w, row, w->step.z1);
    for (int j = 1; j <= DP_STAGES; j++) {
      double way = speed * fabs(dp_c[j] - at) * h;
      double left = fabs(w->step.left[m->n_rows * j + row]);
      if (!w->step.near[j] && left > 0 && gap > MOST_TILT * left * way) return i;
    }
  }
  return -1;
}
