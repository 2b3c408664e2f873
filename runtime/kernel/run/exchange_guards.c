#include "run/exchange_guards.h"

#include <math.h>

#include "evaluation/slip_frames.h"
#include "evaluation/term_sizes.h"
#include "guards/conditions.h"
#include "guards/vanishing_slips.h"
#include "model/indexing.h"
#include "numerics/dense.h"
#include "numerics/tolerances.h"
#include "reactions/switching_functions.h"
#include "run/exchange_falls.h"

/* Part of its size below zero within which a slip is zero. */
#define NEAR 1e-4
/* Tolerances below zero at which a guard is so clearly. */
#define DRIFT 100
/* Part of its usual speed below which a slip of several components is none, in tolerances; above
 * which one that has begun goes where its speed says. */
#define ENDS 100
#define BEGUN 3
/* Depth at which a flight ends that is not met, over its duration times its last speed. */
#define DEEP 0.01
/* How much longer others are that are not met either. */
#define LONGER 2
/* How much larger than when it was noted a slip of several components grows until the next event.
 */
#define GROWN 10
/* Cosine of the angle to its heading beyond which it has turned. */
#define TURNED 0.8
/* How much larger a slip is at most that ends with another one. */
#define TOGETHER 10
/* Part of the time within which an instant of the text is the one set from outside. */
#define ROUNDING 1e-9

int frot_slips_outside(const frot_model *m, const frot_contact_mode *modes, int e) {
  const frot_element *element = &m->elements[e];
  return element->parts > 1 && element->part == 0 && modes[element->contact].closed &&
         frot_element_mode(m, modes, e)->friction > FROT_STICK;
}

/* The size of a row where all speeds have their usual ones of 1. */
static double nominal_size(const frot_model *m, const frot_work *w, int row) {
  const frot_group *g = frot_group_of(m, row);
  const double *entries = frot_entries(m, w->core.rows, row);
  double sum = 0;
  for (int k = 0; k < g->n_speeds; k++) sum += fabs(entries[k]);
  return sum;
}

/* The tolerance of the other integrator, which need not say it: no less than the error that one of
 * its steps has been seen to make in the relations. */
static double outside_tolerance(const frot_state *s) {
  return fmax(s->tolerance, fmin(s->step_drift, FROT_LOOSEST_OUTSIDE));
}

/* Below which the slip of an element of several components is none; not zero where nothing has
 * moved yet, for a guard that begins at zero is seen by nobody to leave it. */
static double least_slip(const frot_model *m, const frot_state *s, const frot_work *w, int e) {
  const double *usual = s->data + w->layout.scale_x + m->nq;
  int row = m->elements[e].row;
  double size = frot_row_size(m, w, row, usual);
  return ENDS * outside_tolerance(s) * (size > 0 ? size : nominal_size(m, w, row));
}

double frot_guard_in_space(const frot_model *m, const frot_state *s, const frot_work *w,
                           const frot_contact_mode *modes, int e) {
  double slip = w->core.rate[m->elements[e].row], least = least_slip(m, s, w, e);
  double noted = s->data[w->layout.slip + e];
  if (frot_element_mode(m, modes, e)->starts) return BEGUN * least - slip;
  return slip - (noted > 0 ? fmin(least, noted / GROWN) : least);
}

/* How much of its size a slip of several components has along its heading, above the part that is
 * left of it there as it has turned. Its rows are turned along it or along the heading. */
static double turn_left(const frot_model *m, const frot_state *s, const frot_work *w, int e) {
  const double *heading = s->data + w->layout.heading + e;
  int n = m->elements[e].parts;
  double d[FROT_MOST_PARTS], slip = frot_turned_slip(m, w, e, d), size = frot_length(heading, n);
  return slip * (size > 0 ? frot_dot(d, heading, n) / size - TURNED : 1);
}

int frot_has_vanished(const frot_model *m, const frot_work *w, int e) {
  return w->core.rate[m->elements[e].row] <= 0 || frot_shrinks_to_zero(w, e);
}

double frot_indicator_in_space(const frot_model *m, const frot_state *s, const frot_work *w,
                               const frot_contact_mode *modes, int e) {
  double guard = frot_guard_in_space(m, s, w, modes, e), noted = s->data[w->layout.slip + e];
  if (frot_element_mode(m, modes, e)->starts || !(noted > 0)) return guard;
  double slip = w->core.rate[m->elements[e].row], grown = GROWN * noted - slip;
  /* the direction of one that is no larger than the error of its components says nothing */
  double turn = fmax(turn_left(m, s, w, e), least_slip(m, s, w, e) - slip);
  return fmin(guard, fmin(grown, turn));
}

void frot_mark_beyond(const frot_model *m, const frot_work *w, const frot_contact_mode *modes,
                      double *values) {
  if (w->reactions.beyond < 0) return;
  const frot_group *g = &m->groups[w->reactions.beyond];
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    if (frot_is_held(m, modes, e)) values[frot_element_guard(m, e)] = -1;
  }
  for (int i = 0; i < g->n_contacts; i++)
    if (modes[g->contacts[i]].closed) values[g->contacts[i]] = -1;
}

int frot_end_beyond(frot_state *s, const frot_work *w) {
  if (w->reactions.beyond < 0 || s->jammed_at == s->t) return 0;
  s->jammed_at = s->t, s->jammed = w->reactions.beyond;
  return 1;
}

/* Not zero for a guard that was not above zero after the last event: of what has just changed only
 * its rounding is below. Where the measured rounding of a guard is kept, which has no use here. */
static double *below_of(const frot_model *m, frot_state *s, const frot_work *w, int j) {
  return s->data + w->layout.noise + m->nq + m->nv + j;
}

/* How far a guard that was not above zero after the last event is from being below again: until it
 * is so clearly, or is a gap that clearly closes. In a short flight the other integrator makes no
 * step. */
static double above_again(const frot_model *m, const frot_state *s, frot_work *w, int j,
                          double value) {
  const frot_layout *l = &w->layout;
  const frot_contact_mode *modes = (const void *)(s->data + l->modes);
  double size = s->data[l->scale_g + j], part = DRIFT * outside_tolerance(s), closes = INFINITY;
  if (j < m->n_contacts && !modes[j].closed) {
    int row = m->contacts[j].row_n;
    double usual = frot_row_size(m, w, row, s->data + l->scale_x + m->nq);
    /* one that closes more slowly meets nothing */
    double slow = FROT_TOUCH * frot_row_speed(m, w, row, s->data + l->x + m->nq);
    double faster = w->core.rate[row] + fmax(part * usual, slow);
    closes = value <= 0 ? faster : fmax(value, faster);
    size = fmax(size, s->data[l->reach + j]);
  }
  return fmin(value + part * size, closes);
}

static int is_below_again(const frot_model *m, const frot_state *s, frot_work *w, int j,
                          double value) {
  return above_again(m, s, w, j, value) < 0;
}

double frot_indicator(const frot_model *m, frot_state *s, frot_work *w, int j, double value) {
  return *below_of(m, s, w, j) == 0 ? value : above_again(m, s, w, j, value);
}

int frot_has_just_parted(const frot_model *m, frot_state *s, const frot_work *w, int i) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  return !modes[i].closed && m->contacts[i].row_n >= 0 && *below_of(m, s, w, i) != 0;
}

int frot_is_inside_by_error(const frot_model *m, frot_state *s, frot_work *w, int i) {
  double gap = w->core.gap[i];
  return frot_has_just_parted(m, s, w, i) && gap < 0 && !is_below_again(m, s, w, i, gap);
}

/* Up to which a guard is zero: a reaction that bears nothing does not end by its rounding. */
static double rounding_of(const frot_model *m, const frot_state *s, const frot_work *w, int j) {
  if (j >= m->n_contacts) return 0;
  return FROT_GUARD_FLOOR * s->data[w->layout.scale_g + j];
}

void frot_see_above(const frot_model *m, frot_state *s, const frot_work *w, const double *values) {
  for (int k = 0; k < w->guards.count; k++)
    if (values[k] > rounding_of(m, s, w, w->guards.list[k]))
      *below_of(m, s, w, w->guards.list[k]) = 0;
}

int frot_has_fallen_on(const frot_model *m, frot_state *s, frot_work *w, const double *values) {
  for (int k = 0; k < w->guards.count; k++) {
    int j = w->guards.list[k];
    if (*below_of(m, s, w, j) != 0 && is_below_again(m, s, w, j, values[k])) return 1;
  }
  return 0;
}

/* Note whether the other integrator has gone through the flight of contact j without a step in it
 * that ends above, and without meeting its end: it is shorter than what that one tells from none.
 */
static void note_unseen(const frot_model *m, frot_state *s, const frot_work *w, int j, double gap) {
  const double *flight = frot_flight_of(s, &w->layout, j);
  if (*below_of(m, s, w, j) == 0 || flight[FROT_HAS_MET] == 0 || m->contacts[j].row_n < 0) return;
  double length = (flight[FROT_MET] - s->t) * w->core.rate[m->contacts[j].row_n];
  double size = fmax(flight[FROT_FLIGHT_SIZE], s->data[w->layout.scale_g + j]);
  if (length > 0 && -gap > DEEP * length) s->unseen = fmax(s->unseen, LONGER * length / size);
}

void frot_fire_below(const frot_model *m, frot_state *s, frot_work *w, const double *values) {
  double *fired = s->data + w->layout.fired;
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  frot_see_above(m, s, w, values);
  for (int k = 0; k < w->guards.count; k++) {
    int j = w->guards.list[k], e = frot_slip_of_guard(m, s, w, j);
    double value = values[k];
    int zero =
        j < m->n_contacts && !modes[j].closed ? frot_meets_now(m, s, w, j, value) : value <= 0;
    fired[j] = zero && (*below_of(m, s, w, j) == 0 || is_below_again(m, s, w, j, value));
    if (j < m->n_contacts) note_unseen(m, s, w, j, value);
    if (e >= 0 && m->elements[e].parts == 1)
      w->search.zero[e] = fired[j] != 0 && -value <= NEAR * s->data[w->layout.scale_g + j];
  }
}

void frot_fire_at_once(const frot_model *m, frot_state *s, frot_work *w, const double *values) {
  for (int k = 0; k < w->guards.count; k++) {
    int j = w->guards.list[k];
    if (is_below_again(m, s, w, j, values[k])) s->data[w->layout.fired + j] = FROT_AT_START;
  }
}

void frot_note_below(const frot_model *m, frot_state *s, const frot_work *w, const double *values) {
  for (int k = 0; k < w->guards.count; k++)
    *below_of(m, s, w, w->guards.list[k]) =
        values[k] <= rounding_of(m, s, w, w->guards.list[k]) ? -1 : 0;
}

void frot_fire_in_space(const frot_model *m, frot_state *s, const frot_work *w) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  double dt = -1;
  for (int e = 0; e < m->n_elements; e++) {
    if (!frot_slips_outside(m, modes, e) || modes[m->n_contacts + e].starts) continue;
    if (frot_guard_in_space(m, s, w, modes, e) > 0 || !frot_has_vanished(m, w, e)) continue;
    s->data[w->layout.fired + frot_element_guard(m, e)] = FROT_SLIP_ENDED;
    dt = fmax(dt, frot_time_to_vanish(w, e));
  }
  if (dt >= 0) frot_end_slips_with(m, s, w, dt, TOGETHER * ENDS * outside_tolerance(s));
  for (int e = 0; e < m->n_elements; e++)
    w->search.zero[e] = frot_slips_outside(m, modes, e) &&
                        s->data[w->layout.fired + frot_element_guard(m, e)] == FROT_SLIP_ENDED;
}

int frot_fire_others(const frot_model *m, frot_state *s, frot_work *w) {
  const frot_layout *l = &w->layout;
  const double *x = s->data + l->x, *d = s->data + l->d;
  double *fired = s->data + l->fired + frot_condition_guard(m);
  int count = 0;
  if (s->due <= s->t + ROUNDING * frot_size_of_time(s->t, s->h_max)) {
    frot_fire_time_event(m, s);
    count++;
  }
  if (m->n_conditions == m->n_located + m->n_timed) return count;
  if (frot_evaluate_conditions(m, s, w, s->t, x, x + m->nq) != FROT_OK) return count;
  for (int j = m->n_located + m->n_timed; j < m->n_conditions; j++) {
    double value = w->core.condition[j];
    int holds = m->condition_strict[j] ? value > 0 : value >= 0;
    if (holds != (d[j] != 0)) fired[j] = 1, count++;
  }
  return count;
}
