#include "singular/singular_posture.h"

#include <math.h>
#include <string.h>

#include "numerics/dormand_prince_table.h"
#include "model/indexing.h"
#include "inertia/mass_matrix.h"
#include "numerics/dense.h"
#include "numerics/basis.h"
#include "reactions/reactions.h"
#include "numerics/bernstein.h"
#include "constraints/redundant_rows.h"
#include "model/stage_slopes.h"

#define TAKE(field, count) FROT_TAKE(a, field, count)

/* Stages at different instants, in their order. */
enum { COUNT = 11 };
static const int in_order[COUNT] = {1, 2, 3, 6, 4, 7, 5, 9, 8, 10, 12};
/* Part of a step up to which a stage is too near a posture. */
#define NEAR 0.1
/* In steps, how far before its start and beyond it a posture is looked for, and how far one is
 * foreseen: stages off the relations show it from there, which shortens steps. */
#define BEHIND (-1.0)
#define AHEAD 2.0
#define FAR 20.0
/* Part of its error at most that a step keeps where that is so, and steps until it is tried again
 * where it is not. */
#define HELPS 0.5
#define PAUSE 8
/* For a step made another way: what is left of a weak row, and how soon it becomes dependent. */
#define WEAK 0.1
#define SOON 0.5
/* In steps, how near one makes the next step weak. */
#define FOLLOWS 2
/* Part of the longest left of a row from which on it is measured beside all others. */
#define SHORT 0.25
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
/* Slopes that a polynomial goes through. */
#define POINTS 6

int frot_has_loops(const frot_model *m, const frot_state *s, const frot_work *w) {
  for (int k = 0; k < w->awake.now->n_contacts; k++)
    if (frot_is_loop(m, s, w, w->awake.now->contacts[k])) return 1;
  return 0;
}

/* The length by which rows of lengths are measured beside those of angles: the longest of a group.
 */
static double arm_of(const frot_model *m, const frot_state *s, const frot_work *w,
                     const frot_group *g) {
  const double *reach = s->data + w->layout.reach;
  double longest = 0;
  for (int i = 0; i < g->n_contacts; i++)
    if (!m->contacts[g->contacts[i]].turns && frot_is_loop(m, s, w, g->contacts[i]))
      longest = fmax(longest, reach[g->contacts[i]]);
  return longest > 0 ? longest : 1;
}

/* The rows of loops of a group that are not left to others, in the order in which the others leave
 * most of them at the first stage: what is weak comes last, and what is left of it is its distance
 * from all others. */
static void order_rows(const frot_model *m, const frot_state *s, frot_work *w, const frot_group *g,
                       int *order, int *count) {
  int ns = g->n_speeds, n = 0;
  double *rest = w->span.basis, arm = arm_of(m, s, w, g);
  for (int i = 0; i < g->n_contacts; i++) {
    if (!frot_is_loop(m, s, w, g->contacts[i])) continue;
    int row = m->contacts[g->contacts[i]].row_n;
    if (frot_is_redundant(w, row)) continue;
    const double *half = frot_entries(m, w->core.half, row);
    double unit = m->contacts[g->contacts[i]].turns ? arm : 1;
    for (int j = 0; j < ns; j++) rest[ns * n + j] = unit * half[j];
    order[n++] = row;
  }
  *count = n;
  for (int k = 0; k < n; k++) {
    int best = k;
    double most = -1;
    for (int i = k; i < n; i++) {
      double length = frot_dot(rest + ns * i, rest + ns * i, ns);
      if (length > most) most = length, best = i;
    }
    int row = order[best];
    order[best] = order[k], order[k] = row;
    frot_take_row(rest, n, ns, k, best);
  }
}

/* What those before each row in this order leave of it, and in which direction. */
static void measure_rows(const frot_model *m, frot_work *w, const frot_group *g, const int *order,
                         int n) {
  int ns = g->n_speeds, rank = 0;
  for (int i = 0; i < n; i++) {
    double *x = w->span.basis + ns * rank;
    memcpy(x, frot_entries(m, w->core.half, order[i]), sizeof(double) * (size_t)ns);
    double rest = frot_reject(x, w->span.basis, rank, ns, w->span.parts);
    w->span.left[order[i]] = rest;
    if (!(rest > 0)) continue;
    for (int k = 0; k < ns; k++) x[k] /= rest;
    memcpy(frot_entries(m, w->span.direction, order[i]), x, sizeof(double) * (size_t)ns);
    rank++;
  }
}

/* Whether little is left of a row, beside the longest: then how much is measured in order. In that
 * of the reactions one may vanish before others, and turn as it does. */
static int shows_little(const frot_model *m, const frot_state *s, const frot_work *w, double part) {
  double least = INFINITY, longest = 0;
  for (int k = 0; k < w->awake.now->n_contacts; k++) {
    int i = w->awake.now->contacts[k];
    if (!frot_is_loop(m, s, w, i) || frot_is_redundant(w, m->contacts[i].row_n)) continue;
    double left = w->span.left[m->contacts[i].row_n];
    least = fmin(least, left), longest = fmax(longest, left);
  }
  return least < part * longest;
}

void frot_note_rows(const frot_model *m, const frot_state *s, frot_work *w, int stage) {
  int *order = w->step.order, *count = w->step.ordered;
  for (int k = 0; s->measured && k < w->awake.now->n_groups; k++, order += *count++) {
    const frot_group *g = &m->groups[w->awake.now->groups[k]];
    if (stage == 1) order_rows(m, s, w, g, order, count);
    measure_rows(m, w, g, order, *count);
  }
  w->step.little |= shows_little(m, s, w, s->measured ? 2 * SHORT : SHORT);
  for (int k = 0; k < w->awake.now->n_contacts; k++) {
    int i = w->awake.now->contacts[k];
    if (!frot_is_loop(m, s, w, i)) continue;
    int row = m->contacts[i].row_n, ns = frot_group_of(m, row)->n_speeds;
    double left = w->span.left[row], along = 0;
    const double *direction = frot_entries(m, w->span.direction, row);
    double *first = frot_entries(m, w->step.direction, row);
    if (stage == 1) {
      double *motion = frot_entries(m, w->step.motion, row);
      memset(first, 0, sizeof(double) * (size_t)ns); /* of what is left to others there is none */
      if (left > 0) memcpy(first, direction, sizeof(double) * (size_t)ns);
      memcpy(motion, first, sizeof(double) * (size_t)ns);
      frot_outwards(w, frot_group_of(m, row), motion);
    }
    if (left > 0) along = frot_dot(first, direction, ns);
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
 * zero and on, with its sign, in a straight line. Where it is nowhere, *far is where it may be
 * further off. */
static double find_zero(const frot_model *m, const frot_work *w, int row, int reached,
                        double *far) {
  double time[COUNT], left[COUNT];
  *far = NAN;
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
    *far = time[n - 1] + (time[n - 1] - time[n - 2]) * fabs(left[n - 1]) / ahead;
    if (*far < AHEAD) return *far;
  }
  if (behind > 0) {
    double before = time[0] - (time[2] - time[0]) * fabs(left[0]) / behind;
    if (before > BEHIND) return before;
    if (isnan(*far)) *far = before;
  }
  return NAN;
}

int frot_meets_posture(const frot_model *m, const frot_state *s, const frot_work *w, int first,
                       int last, double gap) {
  int status = FROT_OK;
  for (int k = 0; k < w->awake.now->n_contacts; k++) {
    int i = w->awake.now->contacts[k], passes = 0;
    if (!frot_is_loop(m, s, w, i)) continue;
    int row = m->contacts[i].row_n, ns = frot_group_of(m, row)->n_speeds;
    const double *left = w->step.left + row, *half = frot_entries(m, w->core.half, row);
    for (int j = first + 1; j <= last; j++)
      passes |= left[m->n_rows * j] * left[m->n_rows * (j - 1)] < 0;
    double end = fabs(left[m->n_rows * last]), fall = fabs(left[m->n_rows * (last - 1)]) - end;
    int soon = fall > 0 && gap * end / fall < SOON;
    double least = fmin(end, fabs(left[m->n_rows * first]));
    if ((passes || soon) && least < WEAK * frot_length(half, ns)) return FROT_POSTURE;
    if (passes) status = FROT_DIVERGE;
  }
  return status;
}

/* Whether nothing of a group moves where the step begins. */
static int rests_at_first(const frot_model *m, const frot_work *w, const frot_group *g) {
  const double *v = w->step.z0 + m->nq;
  for (int i = 0; i < g->n_speeds; i++)
    if (v[g->unknowns[i]] != 0) return 0;
  return 1;
}

/* Where row becomes dependent, as a part of the step, found now or known from before; NAN if
 * nowhere. What has come to rest meets nothing that was foreseen of it. */
static double locate(const frot_model *m, frot_state *s, const frot_work *w, int row, int reached,
                     double t, double h) {
  double far, *posture = s->data + w->layout.posture + row;
  double at = find_zero(m, w, row, reached, &far), known = (*posture - t) / h;
  if (!s->from_posture && rests_at_first(m, w, frot_group_of(m, row))) known = NAN;
  if (s->from_posture && fabs(at) < NEAR) at = 0;
  double seen = t + h * (isnan(at) ? far : at);
  if (!(fabs(seen - t) >= fabs(s->foreseen - t))) s->foreseen = seen;
  if (isnan(at) && !(known > 0 && known < 1)) at = known;
  *posture = t + at * h;
  return at;
}

int frot_find_singular_postures(const frot_model *m, frot_state *s, frot_work *w, double t,
                                double h, int reached, int pass) {
  int weak = 0, again = 0, any = 0;
  s->foreseen = INFINITY;
  unsigned char near[DP_STAGES + 1] = {0};
  for (int k = 0; k < w->awake.now->n_contacts; k++) {
    int i = w->awake.now->contacts[k];
    if (!frot_is_loop(m, s, w, i)) continue;
    double at = locate(m, s, w, m->contacts[i].row_n, reached, t, h);
    weak |= at > -FROT_AROUND && at < 1 + FROT_AROUND;
    for (int j = 0; j <= DP_STAGES; j++) near[j] |= fabs(dp_c[j] - at) < NEAR;
  }
  if (s->from_posture) near[0] = 0; /* the slope is known there */
  for (int k = 0; k <= DP_STAGES; k++) {
    again |= near[k] != w->step.near[k], any |= near[k];
    w->step.near[k] = near[k];
  }
  again |= weak && s->tied <= 0;
  if (w->step.little && !s->measured) s->measured = again = 1;
  s->weak |= weak;
  if (weak) s->tied = 1;
  return pass < PASSES && (again || (any && pass < PASSES - 1));
}

int frot_foresees_posture(const frot_model *m, const frot_state *s, const frot_work *w, double t,
                          double h) {
  return !s->tied && !s->implicit && frot_has_loops(m, s, w) && fabs(s->foreseen - t) < FAR * h;
}

void frot_judge_projected_stages(frot_state *s, double tied, double loose) {
  if (!s->weak && !(tied <= HELPS * loose)) s->tied = -PAUSE;
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

int frot_length_avoids_posture(const frot_model *m, const frot_state *s, const frot_work *w,
                               double t, double h, double wanted) {
  return all_fit(m, s, w, t, h, wanted, LEAST_ROOM);
}

double frot_place_between_postures(const frot_model *m, const frot_state *s, const frot_work *w,
                                   double t, double h, double longest) {
  if (all_fit(m, s, w, t, fmin(h, longest), h, GAP)) return fmin(h, longest);
  for (double length = fmin(LONGER * h, longest); length > SHORTEST * h; length *= SHORTER)
    if (all_fit(m, s, w, t, length, h, GAP)) return length;
  return fmin(h, longest);
}

void frot_interpolate_stage(const frot_model *m, frot_work *w, int stage, int reached) {
  int point[POINTS], n = 0;
  double node[POINTS], part[POINTS];
  const double at = dp_c[stage];
  for (int k = 0; k <= COUNT; k++) {
    int i = k < COUNT ? in_order[k] : 0, to = n;
    if (i > reached || w->step.near[i] || i == 2) continue;
    for (; to > 0 && fabs(dp_c[point[to - 1]] - at) > fabs(dp_c[i] - at); to--)
      if (to < POINTS) point[to] = point[to - 1];
    if (to < POINTS) point[to] = i, n += n < POINTS;
  }
  for (int a = 0; a < n; a++) node[a] = dp_c[point[a]];
  frot_weigh_values(node, n, at, part);
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

int frot_passes(const frot_model *m, const frot_state *s, const frot_work *w, double t, double h) {
  const double *posture = s->data + w->layout.posture;
  const frot_awake_lists *now = w->awake.now;
  int passed = 0;
  for (int k = 0; k < now->n_contacts; k++) {
    int row = m->contacts[now->contacts[k]].row_n;
    passed |= row >= 0 && posture[row] > t && posture[row] <= t + h;
  }
  return passed;
}

void frot_keep_crossings(const frot_model *m, frot_state *s, const frot_work *w, double t,
                         double h) {
  const double *posture = s->data + w->layout.posture;
  int passed = frot_passes(m, s, w, t, h), near = fabs(s->foreseen - (t + h)) <= FAR * s->h;
  const frot_awake_lists *now = w->awake.now;
  s->weak = s->from_posture = 0;
  s->measured &= w->step.little;
  for (int k = 0; k < now->n_contacts; k++) {
    int row = m->contacts[now->contacts[k]].row_n;
    s->weak |= row >= 0 && fabs(posture[row] - (t + h)) <= FOLLOWS * s->h;
  }
  s->tied = s->weak || (s->tied > 0 && near) ? 1 : s->tied < 0 ? s->tied + 1 : 0;
  s->statistics.crossings += passed;
  if (passed) s->across = INFINITY, s->no_better = 0;
}

void frot_bind_posture(const frot_model *m, frot_step_work *w, frot_arena *a) {
  TAKE(w->left, m->n_rows * (DP_STAGES + 1)), TAKE(w->near, DP_STAGES + 1);
  TAKE(w->direction, m->n_entries), TAKE(w->motion, m->n_entries);
  TAKE(w->order, m->n_contacts), TAKE(w->ordered, m->n_groups);
}
