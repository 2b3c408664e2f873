#include "modes/zero_slip.h"

#include <float.h>
#include <math.h>

#include "evaluation/evaluate.h"
#include "evaluation/slip_frames.h"
#include "guards/vanishing_slips.h"
#include "reactions/switching_functions.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

/* Part of the motion in its row that no projection leaves of the speed of a contact. */
#define ELSEWHERE 1e-3

/* The largest speed of a row so far. */
static double met_speed(const frot_instant *in, int row) {
  return frot_row_size(in->m, in->w, row, in->s->data + in->l.scale_x + in->m->nq);
}

double frot_typical_speed(const frot_instant *in, int row) {
  double met = met_speed(in, row);
  return met > 0 ? met : fabs(in->s->h) * in->w->core.row_load[row];
}

/* The speed that the loads bring what has never moved in a rounding of time: no instant is known
 * better, and at a start there is no step yet. */
static double speed_unresolved(const frot_instant *in, int row) {
  if (met_speed(in, row) > 0) return 0;
  return DBL_EPSILON * frot_size_of_time(in->t, in->s->h_max) * in->w->core.row_load[row];
}

double frot_zero_rate(const frot_instant *in, int e, const double *v) {
  int row = in->m->elements[e].row, guard = frot_element_guard(in->m, e);
  double size = fmax(frot_row_size(in->m, in->w, row, v), in->s->data[in->l.scale_g + guard]);
  return FROT_ZERO * fmax(size, frot_typical_speed(in, row)) +
         FROT_ZERO_OF_MOTION * frot_row_speed(in->m, in->w, row, v) + speed_unresolved(in, row);
}

int frot_is_zero_rate(const frot_instant *in, int e, const double *v, int friction) {
  int row = in->m->elements[e].row, guard = frot_element_guard(in->m, e);
  if (frot_is_later_part(in->m, e)) return in->zero[e - in->m->elements[e].part];
  if (in->m->elements[e].parts > 1)
    return friction == FROT_STICK || in->fired[guard] == FROT_SLIP_ENDED ||
           frot_slip_of(in->m, in->w->core.rate, e, NULL) <= frot_zero_rate(in, e, v);
  if (in->fired[guard] == FROT_SLIP_PASSES) return 0;
  int slipped = friction > FROT_STICK, way = friction == FROT_SLIP_FORWARD ? 1 : -1;
  double size = fmax(frot_row_size(in->m, in->w, row, v), in->s->data[in->l.scale_g + guard]);
  double located = FROT_LOCATED * size;
  if (slipped && in->fired[guard] != 0 && fabs(in->w->core.rate[row]) <= located) return 1;
  if (slipped && in->fired[guard] == FROT_AT_START && way * in->w->core.rate[row] >= 0) return 1;
  if (in->m->elements[e].prescribed && fabs(in->w->core.rate[row]) <= FROT_PRESCRIBED_REST)
    return 1;
  if (fabs(in->w->core.rate[row]) <= in->slight * frot_typical_speed(in, row)) return 1;
  return fabs(in->w->core.rate[row]) <= frot_zero_rate(in, e, v);
}

frot_instant frot_instant_at(const frot_model *m, frot_state *s, frot_work *w, double t,
                             const double *q, const double *v) {
  frot_layout l = frot_layout_of(m);
  return (frot_instant){m,
                        s,
                        w,
                        l,
                        s->data + l.fired,
                        s->data + l.unilateral,
                        s->data + l.left,
                        s->data + l.vanished,
                        w->search.zero,
                        w->search.at_rest,
                        w->search.at_rest,
                        t,
                        q,
                        v,
                        0,
                        NULL,
                        NULL};
}

/* The speed of the row of an open contact that is none: beside its usual speeds, and what rounding
 * leaves of the motion as a whole. */
static double no_speed(const frot_instant *in, int row) {
  double fastest = frot_row_speed(in->m, in->w, row, in->v);
  return FROT_TOUCH * frot_typical_speed(in, row) + FROT_ZERO * fastest;
}

/* Whether an open contact touches: without normal speed, as a corner that bears nothing on a plane
 * on which others rest, where its acceleration decides whether it parts; or by its speed within the
 * instant, for symmetric corners land at times that differ by rounding. */
static int touches(const frot_instant *in, int i) {
  int row = in->m->contacts[i].row_n;
  if (in->unilateral[i] == 0 || !frot_has_normal(&in->m->contacts[i])) return 0;
  double rate = in->w->core.rate[row], none = no_speed(in, row);
  if (fabs(rate) <= none) return frot_is_flush(in->m, in->s, in->w, i, in->q);
  double room = -rate * FROT_ONE_INSTANT * frot_size_of_time(in->t, in->s->h_max);
  double size = frot_size_of_gap(in->m, in->s, in->w, i, in->q);
  return rate < 0 && in->w->core.gap[i] <= room + FROT_ROUNDING * size;
}

void frot_list_closable(const frot_instant *in, int first) {
  for (int i = 0; i < in->m->n_contacts; i++) {
    in->w->search.best[i] = in->w->search.before[i];
    if (!in->w->search.before[i].closed && !first && (in->fired[i] != 0 || touches(in, i)))
      in->w->search.best[i].closed = 1;
  }
}

/* Whether the motion so far bends the gap of contact i open before it is none. */
static int grazes(const frot_instant *in, int i, double rate) {
  const frot_model *m = in->m;
  const frot_work *w = in->w;
  int row = m->contacts[i].row_n;
  const frot_group *g = frot_group_of(m, row);
  const double *slope = in->s->data + in->l.slope + m->nq,
               *entries = frot_entries(m, w->core.rows, row);
  double bends = w->core.c[row];
  for (int k = 0; k < g->n_speeds; k++) bends += entries[k] * slope[g->unknowns[k]];
  double gap = w->core.gap[i] + FROT_ROUNDING * frot_size_of_gap(m, in->s, w, i, in->q);
  return bends > 0 && rate * rate <= 2 * (1 + FROT_TOUCH) * bends * gap;
}

enum frot_approach frot_approach_of(const frot_instant *in, int i, double *rate) {
  const frot_model *m = in->m;
  int row = m->contacts[i].row_n, closed = in->w->search.before[i].closed;
  *rate = 0;
  if (!in->w->search.best[i].closed || (closed && (in->unilateral[i] == 0 || row < 0)))
    return FROT_STAYS;
  *rate = in->w->core.rate[row];
  double fastest = frot_row_speed(m, in->w, row, in->v);
  double least = FROT_TOUCH * frot_typical_speed(in, row);
  double none = closed ? fmax(ELSEWHERE * fastest, least) : no_speed(in, row);
  if (*rate > none || (*rate < -none && !closed && grazes(in, i, *rate))) return FROT_LEAVES;
  return *rate < -none ? FROT_CLOSES : FROT_STAYS;
}
