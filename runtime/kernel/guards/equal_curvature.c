#include "guards/equal_curvature.h"

#include <string.h>

#include "evaluation/evaluate.h"
#include "guards/closest_features.h"
#include "methods/dormand_prince.h"
#include "numerics/dense.h"

#define HALVINGS 45

/* The sign of det K of a block at the states x and the places in w->blocks.y; 0 where K is singular
 * to rounding. */
static int sign_of(const frot_model *m, frot_state *s, frot_work *w, const frot_block *block,
                   double t, const double *x) {
  int n = block->count, sign = 1;
  frot_inputs(s, w, &t, x, x + m->nq, s->data + w->layout.d);
  w->call.res[0] = w->blocks.r, w->call.res[1] = w->blocks.j, w->call.res[2] = w->blocks.size;
  frot_call(w, &block->residual);
  memcpy(w->blocks.lu, w->blocks.j, sizeof(double) * (size_t)(n * n));
  if (frot_lu(w->blocks.lu, n, 1, w->blocks.pivot, w->blocks.scale)) return 0;
  for (int k = 0; k < n; k++) {
    if (w->blocks.pivot[k] != k) sign = -sign;
    if (w->blocks.lu[k * n + k] < 0) sign = -sign;
  }
  return sign;
}

/* The same after the part theta of the step; 0 also where there is no place. */
static int sign_inside(const frot_model *m, frot_state *s, frot_work *w, const frot_block *block,
                       double t, double h, double theta) {
  const double *y0 = s->data + w->layout.y;
  double *x = w->step.z;
  frot_values_inside(w, theta, x);
  for (int k = 0; k < m->ny; k++) w->blocks.y[k] = y0[k] + theta * (w->step.y_end[k] - y0[k]);
  double now = t + theta * h;
  if (frot_kinematics(m, s, w, now, x, x + m->nq, s->data + w->layout.d) != FROT_OK) return 0;
  return sign_of(m, s, w, block, now, x);
}

/* Whether the sign changes in the step. */
static int changes(const frot_model *m, frot_state *s, frot_work *w, const frot_block *block,
                   double t, double h) {
  memcpy(w->blocks.y, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
  int first = sign_of(m, s, w, block, t, w->step.z0);
  memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)m->ny);
  return first != 0 && sign_of(m, s, w, block, t + h, w->step.z1) != first;
}

/* The part of the step after which it has changed, at most `high`. */
static double first_change(const frot_model *m, frot_state *s, frot_work *w,
                           const frot_block *block, double t, double h, double high) {
  double low = 0;
  int first = sign_inside(m, s, w, block, t, h, 0);
  if (high < 1 && sign_inside(m, s, w, block, t, h, high) == first) return high;
  for (int k = 0; k < HALVINGS; k++) {
    double middle = 0.5 * (low + high);
    if (sign_inside(m, s, w, block, t, h, middle) == first)
      low = middle;
    else
      high = middle;
  }
  return high;
}

int frot_find_equal_curvature(const frot_model *m, frot_state *s, frot_work *w, double t, double h,
                              double *part) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  const double *unilateral = s->data + w->layout.unilateral, *end = w->step.z1;
  int status = FROT_OK, dense = 0;
  *part = 1;
  for (int k = 0; k < w->awake.now->n_contacts && status == FROT_OK; k++) {
    int i = w->awake.now->contacts[k], followed = m->contacts[i].followed;
    if (followed < 0 || (unilateral[i] != 0 && !modes[i].closed)) continue;
    if (!changes(m, s, w, &m->blocks[followed], t, h)) continue;
    if (!dense) status = frot_make_dense(m, s, w, t, h), dense = 1;
    if (status == FROT_OK) *part = first_change(m, s, w, &m->blocks[followed], t, h, *part);
    memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)m->ny);
  }
  if (!dense) return FROT_OK;
  int back = frot_kinematics(m, s, w, t + h, end, end + m->nq, s->data + w->layout.d);
  return status == FROT_OK ? back : status;
}
