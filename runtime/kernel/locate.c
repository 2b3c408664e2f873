#include "locate.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "falls.h"
#include "groups.h"
#include "jacobian.h"
#include "mechanics.h"
#include "projection.h"
#include "roots.h"
#include "stages.h"

#define PASSES 12
/* Part of the step on either side of a root over which the guard's slope is taken. */
#define SPAN 1e-4
/* Part of its size below which a guard that is no condition is rounding, and what a pass must leave
 * of it at most while it is not. */
#define RESOLVED (64 * DBL_EPSILON)
#define STALLS 0.1

/* Move the end of the step onto the relations and evaluate there: a guard is read where the motion
 * will go on. */
static int land(const frot_model *m, frot_state *s, frot_work *w, double t) {
  const frot_layout *l = &w->layout;
  const frot_contact_mode *modes = (const void *)(s->data + l->modes);
  int moved;
  if (s->weak && w->step.near[DP_STAGES]) return FROT_OK; /* no place there is better: crossing.h */
  memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)m->ny);
  int status =
      frot_project(m, s, w, t, w->step.z1, w->step.z1 + m->nq, s->data + l->d, modes, NULL, &moved);
  if (status != FROT_OK || !moved) return status;
  status = frot_slope(m, s, w, t, w->step.z1, frot_stage(w, DP_STAGES));
  memcpy(w->step.y_end, w->blocks.y, sizeof(double) * (size_t)m->ny);
  return status;
}

int frot_locate(const frot_model *m, frot_state *s, frot_work *w, double t, int guard, double theta,
                double *h, int *falls) {
  double longest = *h, g[7];
  frot_guard_polynomial(s, w, guard, *h, g);
  double left = fmax(theta - SPAN, 0), right = fmin(theta + SPAN, 1);
  double slope = (frot_bernstein(g, right) - frot_bernstein(g, left)) / ((right - left) * longest);
  double at = theta * longest, last_at = 0, last = 0, value = 0;
  /* what reactions decide is read no better than this: nothing is gained by the steps beyond */
  int j = w->guards.list[guard];
  double resolved = j < frot_condition_guard(m) ? RESOLVED * s->data[w->layout.scale_g + j] : 0;
  for (int pass = 0;; pass++) {
    int status = frot_run_stages(m, s, w, t, at);
    if (status == FROT_OK && !(s->implicit && !frot_has_motion(m))) status = land(m, s, w, t + at);
    if (status != FROT_OK) return status;
    value = frot_stage(w, DP_STAGES)[w->awake.n + guard];
    if (pass > 0 && at != last_at && value != last) {
      double secant = (value - last) / (at - last_at);
      if (secant < 0) slope = secant;
    }
    if (value == 0 || !(slope < 0) || pass == PASSES) break;
    if (resolved > 0 && fabs(value) <= resolved) break;
    if (resolved > 0 && pass > 0 && fabs(value) > STALLS * fabs(last)) break;
    last_at = at, last = value;
    double next = at - value / slope;
    if (!(next > 0)) next = 0.5 * at;
    if (next > longest) next = longest;
    if (fabs(next - at) <= 2 * DBL_EPSILON * fmax(fabs(t + at), at) || next == at) break;
    at = next;
  }
  *h = at;
  *falls = value <= frot_close_to_fall(m, s, w, guard, t, slope);
  return FROT_OK;
}
