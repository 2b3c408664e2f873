/* The slip s = rho d of an element of n >= 2 components. Its direction has the rate (friction over
 * rho): on the way to a stop every digit of d is wanted, so the error of s is measured in parts of
 * rho, down to the rounding of the terms of s. Zero is rho no larger than some of that rounding
 * while rho falls. */
#include "guards/vanishing_slips.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "evaluation/slip_frames.h"
#include "evaluation/term_sizes.h"
#include "evaluation/evaluate.h"
#include "inertia/mass_matrix.h"
#include "methods/dormand_prince.h"
#include "methods/radau.h"
#include "model/indexing.h"
#include "model/segment.h"
#include "model/stage_slopes.h"
#include "reactions/reactions.h"
#include "numerics/dense.h"
#include "numerics/dormand_prince_table.h"
#include "numerics/tolerances.h"

/* How much larger than the rounding of an acceleration that of the slip may be in the step. */
#define NOISE 8
/* Cosine of the largest turn in a step, and the error that a larger one counts as: the step is
 * shortened to 0.44 of itself. */
#define TURN 0.3
#define TURNED 300.0
/* Part of a slip that vanishes with another one that it has at most as that one is zero. */
#define LEFT 0.2
/* Of a speed with the energy that friction can take from a slip: what matters of it. */
#define PART 1e-3
/* Part of the usual time that the first step of a slip takes, over the root of the tolerance; where
 * it begins without acceleration (beside that of its loads) friction puts its direction right at
 * once, and its size is off by the third power of the step: over the cube root. */
#define BEGINNING 0.1
#define FINEST 1e-3 /* of which the third power, a tenth of it, is no error */
/* Part of the longest step that the usual time is at least: a jam shortens steps without end. */
#define SHORTEST 0.1

enum { SIZE, ALONG, ACROSS, TERMS, FROT_SLIP_ITEMS = 4 };

static int slips(const frot_model *m, const frot_contact_mode *modes, int e) {
  return frot_is_vector(m, e) && modes[m->elements[e].contact].closed &&
         frot_element_mode(m, modes, e)->friction > FROT_STICK;
}

static const frot_contact_mode *modes_of(const frot_state *s, const frot_work *w) {
  return (const frot_contact_mode *)(const void *)(s->data + w->layout.modes);
}

/* J a + c of a row. */
static double acceleration_of(const frot_model *m, const frot_work *w, int row) {
  const frot_group *g = frot_group_of(m, row);
  const double *entries = frot_entries(m, w->core.rows, row);
  double sum = w->core.c[row];
  for (int k = 0; k < g->n_speeds; k++) sum += entries[k] * w->core.a[g->unknowns[k]];
  return sum;
}

void frot_measure_slips(const frot_model *m, const frot_state *s, frot_work *w) {
  const frot_awake_lists *now = w->awake.now;
  const frot_contact_mode *modes = modes_of(s, w);
  const double *usual = s->data + w->layout.scale_x + m->nq; /* largest speeds so far */
  for (int i = 0; i < now->n_elements && w->core.frame; i++) {
    int e = now->elements[i], row = m->elements[e].row;
    if (!slips(m, modes, e)) continue;
    double *own = w->guards.end_slip + FROT_SLIP_ITEMS * e, across = 0;
    const double *frame = w->core.frame + FROT_MOST_PARTS * FROT_MOST_PARTS * e;
    own[SIZE] = w->core.rate[row];
    own[ALONG] = acceleration_of(m, w, row);
    for (int k = 1; k < m->elements[e].parts; k++) {
      double one = acceleration_of(m, w, row + k);
      across += one * one;
    }
    own[ACROSS] = sqrt(across);
    own[TERMS] = 0; /* terms across the slip, which may cancel, turn it by their rounding */
    for (int k = 0; k < m->elements[e].parts; k++) {
      double now_size = frot_row_size(m, w, row + k, w->core.v);
      own[TERMS] = fmax(own[TERMS], fmax(now_size, frot_row_size(m, w, row + k, usual)));
      w->guards.end_direction[e + k] = frame[k];
    }
    if (frot_element_mode(m, modes, e)->starts) /* its direction is not quite the one given */
      own[SIZE] = frot_turned_slip(m, w, e, w->guards.end_direction + e);
  }
}

/* Error of the speed `at` by the estimate `of` of the slopes, or the one of the implicit method. */
static double error_of_speed(const frot_model *m, const frot_state *s, const frot_work *w, int at,
                             const double *of, double h) {
  if (s->implicit) return frot_stage(w, FROT_RADAU_ERROR)[m->nq + at];
  int place = w->awake.now->place[m->nq + at];
  double one = 0;
  if (place >= 0) frot_weigh_stages(w, of, DP_STAGES + 1, place, 1, &one);
  return h * one;
}

/* Length of the error of a slip in the rows of the end. */
static double length_of_error(const frot_model *m, const frot_state *s, const frot_work *w, int e,
                              const double *of, double h) {
  double square = 0;
  for (int k = 0; k < m->elements[e].parts; k++) {
    int row = m->elements[e].row + k;
    const frot_group *g = frot_group_of(m, row);
    const double *entries = frot_entries(m, w->core.rows, row);
    double sum = 0;
    for (int j = 0; j < g->n_speeds; j++) {
      if (entries[j] != 0) sum += entries[j] * error_of_speed(m, s, w, g->unknowns[j], of, h);
    }
    square += sum * sum;
  }
  return sqrt(square);
}

double frot_slip_error(const frot_model *m, const frot_state *s, const frot_work *w, double h,
                       double tolerance) {
  const frot_awake_lists *now = w->awake.now;
  const frot_contact_mode *modes = modes_of(s, w);
  double worst = 0;
  for (int i = 0; i < now->n_elements && w->core.frame; i++) {
    int e = now->elements[i];
    if (!slips(m, modes, e) || frot_element_mode(m, modes, e)->starts) continue;
    const double *own = w->guards.end_slip + FROT_SLIP_ITEMS * e;
    double before = s->data[w->layout.slip + e], cosine = 0;
    for (int k = 0; k < m->elements[e].parts; k++)
      cosine += s->data[w->layout.heading + e + k] * w->guards.end_direction[e + k];
    if (cosine < TURN && before > 0) worst = fmax(worst, TURNED);
    if (s->implicit && own[ALONG] > 0) continue; /* its direction is held: no zero is near */
    double fifth = length_of_error(m, s, w, e, dp_e5, h), third = fifth;
    if (!s->implicit) third = length_of_error(m, s, w, e, dp_e3, h);
    double joint = sqrt(fifth * fifth + 0.01 * third * third);
    double error = joint > 0 && !s->implicit ? fifth * fifth / joint : fifth;
    double noise = NOISE * h * frot_row_rounding(m, w, m->elements[e].row);
    double bound = tolerance * fmin(before, own[SIZE]) + FROT_SLIP_FLOOR * own[TERMS] + noise;
    if (error > 0) worst = fmax(worst, error / bound);
  }
  return worst;
}

/* Speeds that friction on a slip acts on count no less than by what the impulse of it brings them
 * that would stop the slip, and than a small part of the speed that has the energy of that impulse:
 * one that stays zero beside the others is rounding. The same of places, where a step of length h
 * is the first. */
static void size_speeds(const frot_model *m, frot_state *s, frot_work *w, int e, double slip,
                        double h) {
  int row = m->elements[e].row;
  const frot_group *g = frot_group_of(m, row);
  if (g->general || w->core.formed[g - m->groups] == FROT_FACTOR) return;
  const double *half = frot_entries(m, w->core.half, row);
  double *z = w->core.rest, own = frot_dot(half, half, g->n_speeds);
  double *scale = s->data + w->layout.scale_x + m->nq;
  memcpy(z, half, sizeof(double) * (size_t)g->n_speeds);
  frot_outwards(w, g, z);
  for (int k = 0; k < g->n_speeds && own > 0; k++) {
    double *one = scale + g->unknowns[k];
    double inertia = frot_metric_entry(m, w, g->unknowns[k], g->unknowns[k]);
    double alike = inertia > 0 ? PART * slip / sqrt(own * inertia) : 0;
    *one = fmax(*one, fmax(fabs(z[k]) / own * slip, alike));
  }
  for (int j = 0; j < m->nq && h > 0; j++) {
    double *place = s->data + w->layout.scale_x + j;
    if (m->q_speed[j] >= 0) *place = fmax(*place, h * scale[m->q_speed[j]]);
  }
}

static void fire(const frot_model *m, frot_state *s, const frot_work *w, int e) {
  s->data[w->layout.fired + frot_element_guard(m, e)] = FROT_SLIP_ENDED;
  s->pending = 1;
}

/* Part of its size that is left of a slip after the time dt. */
static double part_left(const double *own, double dt) {
  return hypot(own[SIZE] + dt * own[ALONG], dt * own[ACROSS]) / own[SIZE];
}

double frot_time_to_vanish(const frot_work *w, int e) {
  const double *own = w->guards.end_slip + FROT_SLIP_ITEMS * e;
  return own[ALONG] < 0 ? -own[SIZE] / own[ALONG] : 0;
}

int frot_shrinks_to_zero(const frot_work *w, int e) {
  double dt = frot_time_to_vanish(w, e);
  return dt > 0 && part_left(w->guards.end_slip + FROT_SLIP_ITEMS * e, dt) <= LEFT;
}

void frot_end_slips_with(const frot_model *m, frot_state *s, const frot_work *w, double dt,
                         double small) {
  const frot_awake_lists *now = w->awake.now;
  for (int i = 0; i < now->n_elements && w->core.frame; i++) {
    int e = now->elements[i];
    if (!slips(m, modes_of(s, w), e)) continue;
    if (s->data[w->layout.fired + frot_element_guard(m, e)] != 0) continue;
    const double *own = w->guards.end_slip + FROT_SLIP_ITEMS * e;
    double usual = frot_row_size(m, w, m->elements[e].row, s->data + w->layout.scale_x + m->nq);
    if (own[SIZE] <= small * usual && part_left(own, dt) <= LEFT) fire(m, s, w, e);
  }
}

int frot_end_slips(const frot_model *m, frot_state *s, frot_work *w) {
  const frot_awake_lists *now = w->awake.now;
  frot_contact_mode *modes = (frot_contact_mode *)(void *)(s->data + w->layout.modes);
  double dt = -1, t = *frot_segment_at(m, s->data + w->layout.segment).t1;
  int begun = 0;
  for (int i = 0; i < now->n_elements && w->core.frame; i++) {
    int e = now->elements[i];
    if (!slips(m, modes, e)) continue;
    const double *own = w->guards.end_slip + FROT_SLIP_ITEMS * e;
    int shrinks = own[ALONG] < 0 || own[SIZE] < s->data[w->layout.slip + e];
    s->data[w->layout.slip + e] = own[SIZE];
    size_speeds(m, s, w, e, own[SIZE], 0);
    for (int k = 0; k < m->elements[e].parts; k++)
      s->data[w->layout.heading + e + k] = w->guards.end_direction[e + k];
    if (modes[m->n_contacts + e].starts) {
      modes[m->n_contacts + e].starts = 0, begun = 1;
      continue;
    }
    double resolved = fmax(FROT_SLIP_ZERO * own[TERMS], FROT_SLIP_INSTANT * fabs(t) * -own[ALONG]);
    if (own[SIZE] <= resolved && shrinks) {
      fire(m, s, w, e);
      dt = fmax(dt, frot_time_to_vanish(w, e));
    }
  }
  if (dt >= 0) frot_end_slips_with(m, s, w, dt, FROT_SLIP_SMALL);
  return begun;
}

/* Size of the terms of a row's acceleration: what loads and what reactions bring it. */
static double size_of_terms(const frot_model *m, const frot_work *w, int row) {
  double size;
  frot_acceleration(m, w, row, &size);
  return size + w->core.row_load[row];
}

double frot_begin_slips(const frot_model *m, frot_state *s, frot_work *w) {
  const frot_awake_lists *now = w->awake.now;
  const frot_contact_mode *modes = modes_of(s, w);
  double longest = INFINITY, usual = fmax(fmax(s->calm, s->h), SHORTEST * s->h_max);
  for (int i = 0; i < now->n_elements && w->core.frame; i++) {
    int e = now->elements[i], row = m->elements[e].row;
    if (!slips(m, modes, e)) continue;
    if (!frot_element_mode(m, modes, e)->starts) {
      if (!s->has_slope) size_speeds(m, s, w, e, s->data[w->layout.slip + e], 0);
      continue;
    }
    double size = size_of_terms(m, w, row);
    int grows = fabs(acceleration_of(m, w, row)) <= FROT_SLIP_GROWS * size;
    double part = grows ? fmax(cbrt(s->tolerance), FINEST) : sqrt(s->tolerance);
    longest = fmin(longest, BEGINNING * part * usual);
    size_speeds(m, s, w, e, size * longest, longest);
    s->explicit_step = 0; /* how long explicit steps were before tells nothing */
  }
  return longest;
}
