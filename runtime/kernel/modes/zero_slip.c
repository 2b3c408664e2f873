#include "modes/zero_slip.h"

#include <float.h>
#include <math.h>

#include "evaluation/evaluate.h"
#include "evaluation/slip_frames.h"
#include "guards/vanishing_slips.h"
#include "reactions/switching_functions.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

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
