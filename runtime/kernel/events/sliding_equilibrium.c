#include "events/sliding_equilibrium.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "model/sleeping.h"
#include "guards/conditions.h"
#include "model/indexing.h"
#include "methods/right_hand_side.h"
#include "methods/dormand_prince.h"
#include "numerics/tolerances.h"

/* Each pass leaves a rounding of the value before: so many go from 1 to below all numbers. */
#define PASSES 24
/* How far along the slope zero may be, in roundings of time. */
#define NEAR 64

typedef struct {
  const frot_model *m;
  frot_state *s;
  frot_work *w;
  double t, moved; /* a rounding of time */
  double *place;
} rest;

/* The first located condition that fires and is not zero at z, -1 if none, -2 if nobody can say. */
static int first_off_zero(const rest *r, const double *z) {
  const frot_model *m = r->m;
  const double *fired = r->s->data + r->w->layout.fired + frot_condition_guard(m);
  if (frot_evaluate_conditions(m, r->s, r->w, r->t, z, z + m->nq) != FROT_OK) return -2;
  for (int j = 0; j < m->n_located; j++)
    if (fired[j] != 0 && r->w->core.condition[j] != 0) return j;
  return -1;
}

/* The states, a rounding of time further along these rates, into w->step.z. */
static double *further(const rest *r, const double *rates) {
  double *z = r->w->step.z;
  for (int k = 0; k < r->m->nq + r->m->nv; k++) z[k] = r->place[k] + r->moved * rates[k];
  return z;
}

/* Go along the slope at the event to where all that fires is zero. */
static int go_to_zero(const rest *r) {
  const double *slope = r->s->data + r->w->layout.slope, *value = r->w->core.condition;
  for (int pass = 0; pass < PASSES; pass++) {
    int j = first_off_zero(r, r->place);
    if (j < 0) return j == -1;
    double here = value[j];
    if (first_off_zero(r, further(r, slope)) == -2) return 0;
    double way = here / (here - value[j]);
    if (!(fabs(way) <= NEAR)) return 0;
    for (int k = 0; k < r->m->nq + r->m->nv; k++) r->place[k] += way * r->moved * slope[k];
  }
  return 0;
}

/* Whether what fires stays zero as things are. */
static int stays(const rest *r) {
  double *rates = r->w->step.z;
  if (frot_slope(r->m, r->s, r->w, r->t, r->place, frot_stage(r->w, 0)) != FROT_OK) return 0;
  frot_unpack_awake(r->w, frot_stage(r->w, 0), rates);
  return first_off_zero(r, further(r, rates)) == -1;
}

static void flip(const rest *r) {
  const frot_model *m = r->m;
  double *d = r->s->data + r->w->layout.d;
  const double *fired = r->s->data + r->w->layout.fired + frot_condition_guard(m);
  for (int j = 0; j < m->n_located; j++)
    if (fired[j] != 0) d[j] = 1 - d[j];
}

/* Put at zero the states, of those that are no coordinates, that come to it within a few roundings
 * of time: what empties together is empty together. */
static void vanish(const rest *r) {
  const double *slope = r->s->data + r->w->layout.slope;
  for (int k = 0; k < r->m->nq; k++)
    if (r->m->q_speed[k] < 0 && fabs(r->place[k]) <= NEAR * r->moved * fabs(slope[k]))
      r->place[k] = 0;
}

/* Whether what fires is zero at the place, and stays so whichever side it is on. */
static int stays_on_both(const rest *r) {
  if (!stays(r)) return 0;
  flip(r);
  int both = stays(r);
  flip(r);
  return both;
}

int frot_find_sliding_equilibrium(const frot_model *m, frot_state *s, frot_work *w, double t,
                                  double *x) {
  double moved = DBL_EPSILON * frot_size_of_time(t, s->h_max);
  rest r = {m, s, w, t, moved, w->step.z1};
  size_t size = sizeof(double) * (size_t)w->layout.nx;
  memcpy(r.place, x, size);
  int found = go_to_zero(&r) && stays_on_both(&r);
  if (!found) {
    memcpy(r.place, x, size);
    vanish(&r);
    found = first_off_zero(&r, r.place) == -1 && stays_on_both(&r);
  }
  if (found) memcpy(x, r.place, sizeof(double) * (size_t)(m->nq + m->nv));
  return found;
}
