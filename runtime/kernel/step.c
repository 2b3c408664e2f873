#include "step.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "awake.h"
#include "blame.h"
#include "conditions.h"
#include "core.h"
#include "blur.h"
#include "crossing.h"
#include "ends.h"
#include "error.h"
#include "falls.h"
#include "groups.h"
#include "implicit.h"
#include "jacobian.h"
#include "locate.h"
#include "lost.h"
#include "pace.h"
#include "passage.h"
#include "probe.h"
#include "projection.h"
#include "segment.h"
#include "sizes.h"
#include "spare.h"
#include "stages.h"
#include "stiffness.h"
#include "tolerances.h"

/* Part of the way to where a condition seems to be zero, beyond which there is no value, or a guard
 * comes near zero. */
#define NEARLY 0.9
#define LEAST_STEP (16 * DBL_EPSILON)
/* Time from which on steps are measured by its resolution, in longest steps. */
#define LEAST_TIME 1e-12
/* The first step, in longest steps: what starts from rest shows its size only as it moves. */
#define FIRST_PART 1e-3
/* Part of a value by which the first step may change it, and its length at least. */
#define FIRST_CHANGE 0.01
#define FIRST_LEAST 1e-6
/* Rejections of one step after which the rounding of its derivatives is measured, and what is left
 * of that measure a step later. */
#define PATIENCE 2
#define FORGET 0.99
/* Part of an error from which on what is left of an older measure is measured again at once. */
#define NOISY 0.01
/* Rejections after which the sizes of states no longer shrink with the step. */
#define HOLD 6
#define LOOKS 7 /* at a guard that seems to dip, in ever shorter steps */
/* Change of the step's length: at most, at least, after no value, and what of it is taken. */
#define MOST_GROWTH 6
#define LEAST_PART (1.0 / 3)
#define CUT 0.25
#define HALF 0.5 /* of the implicit method, whose stages were not found */
#define SAFETY 0.9
#define SAFETY_OF_MOTION 0.7
/* Part of its length at least to which a step is shortened in which a guard seems to fall and does
 * not. */
#define SHORTER 0.25
/* Part of the step by which its end may be found after where it was looked for: further on, other
 * guards may have fallen before. */
#define STRAY 0.01
/* Time beyond which events no longer crowd, in longest steps. */
#define CROWDED 1e-9

/* The speeds that no permanent row holds, after an evaluation: those that depend on others are
 * none.
 */
static long long free_speeds(const frot_model *m, const frot_state *s, const frot_work *w) {
  long long held = 0;
  for (int i = 0; i < m->n_contacts; i++) {
    int row = m->contacts[i].row_n;
    if (row < 0 || m->contacts[i].reduced || s->data[w->layout.unilateral + i] != 0) continue;
    held += !w->reactions.carried[row];
  }
  return m->nv - held;
}

int frot_first_step(const frot_model *m, frot_state *s, frot_work *w) {
  int status = frot_start_slope(m, s, w, s->t);
  if (status != FROT_OK) return frot_fail_step(m, s, w, status, s->t, 0);
  s->statistics.free = free_speeds(m, s, w);
  double h = FIRST_PART * s->h_max;
  int lost = frot_starts_singular(m, s, w, s->t, h);
  if (lost >= 0) return frot_fail(s, FROT_POSTURE, s->t, lost, -1, -1, 0);
  for (int j = 0; j < m->nq + m->nv; j++) {
    double slope = fabs(frot_stage(w, 0)[j]), size = fabs(w->step.z0[j]);
    if (slope > 0 && size > 0) h = fmin(h, FIRST_CHANGE * size / slope);
  }
  h = frot_probe_step(m, s, w, s->t, fmax(h, FIRST_LEAST * s->h_max));
  s->h = frot_finest_step(m, s, h);
  return FROT_OK;
}

/* Whether nothing moves, nor starts to. */
static int is_still(const frot_work *w) {
  for (int j = 0; j < w->awake.n - FROT_QUADRATURES; j++)
    if (w->step.k[j] != 0) return 0;
  return 1;
}

static int reactions_bound(const frot_model *m) {
  for (int e = 0; e < m->n_elements; e++)
    if (m->elements[e].bound != FROT_BY_VALUE) return 1;
  return 0;
}

/* Change of the step's length that brings its error near the bound. More is kept back where a
 * motion that reactions bound is what limits it: reactions that pass near zero bend it at once, and
 * in a method of high order it costs little length, and saves most of the rejections. */
static double change_of_length(const frot_model *m, const frot_state *s, const frot_work *w,
                               double ratio) {
  int j = w->step.worst;
  int moves = reactions_bound(m) && (j < 0 || j >= m->nq || m->q_speed[j] >= 0);
  if (s->implicit) return SAFETY * pow(ratio, frot_has_motion(m) ? -1.0 / 6 : -1.0 / 5);
  return (moves ? SAFETY_OF_MOTION : SAFETY) * pow(ratio, -1.0 / 8);
}

/* Everything at the start of the step, and the length to try first. */
static int begin(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a) {
  a->longest = frot_longest_step(m, s, a->t, 0);
  a->h = fmin(s->h, a->longest);
  frot_see_anew(w);
  int status = frot_start_slope(m, s, w, a->t);
  if (status == FROT_OK && is_still(w)) {
    a->longest = frot_longest_step(m, s, a->t, 1);
    a->h = m->time_dependent ? fmin(s->h, a->longest) : a->longest;
  }
  memcpy(w->step.first, frot_stage(w, 0), sizeof(double) * (size_t)w->layout.nz);
  if (status == FROT_OK && s->implicit) status = frot_implicit_begin(m, s, w, a->t);
  a->want = a->h, a->most = a->longest;
  if (s->weak) a->h = frot_lay_step(m, s, w, a->t, a->h, a->most);
  a->to_due = a->h >= s->due - a->t;
  if (a->to_due) a->h = s->due - a->t;
  a->first = a->h;
  if (status == FROT_OK) frot_follow_spare(m, s, w);
  return status;
}

/* Take a guard that seems to dip for what it is: first by what rounding does to it, then by a
 * shorter step. */
static int look_closer(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a) {
  if (a->looks++ == 0)
    frot_measure_noise(m, s, w, a->t + a->h);
  else
    a->h *= FROT_EARLY, a->to_due = 0;
  s->statistics.rejected++;
  return FROT_DIVERGE;
}

/* Try the step once: FROT_OK if it is good, with its dense output; then s->h is the next one's
 * length. */
static int try_step(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a) {
  double part = 1, t = a->t, h = a->h;
  int status = frot_run_stages(m, s, w, t, h);
  if (status == FROT_POSTURE) {
    frot_pass_explicitly(s);
    return FROT_DIVERGE;
  }
  a->passed = status == FROT_NAN ? frot_condition_passed(m, s, w, t, h, &part) : -1;
  a->ratio = status == FROT_OK ? frot_error_ratio(m, s, w, t, h) : NAN;
  if (a->loose > 0) frot_judge_tie(s, a->ratio, a->loose), a->loose = 0;
  a->forced = a->blurred;
  if (a->forced) frot_take_forced(s, a);
  if (s->weak && a->ratio <= 1) a->ratio = fmax(a->ratio, pow(frot_turning(m, s, w, t, h), 8));
  if (status == FROT_OK && !frot_passage_is_laid(m, s, w, a)) {
    s->statistics.rejected++;
    return FROT_DIVERGE;
  }
  if (s->weak) frot_judge_passage(m, s, w, a);
  if (a->h == 0) return FROT_DIVERGE;
  if (a->ratio <= 1) {
    a->stiff = frot_is_stiff(m, s, w, h);
    a->stable = frot_stable_step(m, s, w, h);
    memcpy(w->step.z, w->step.z1, sizeof(double) * (size_t)(m->nq + m->nv));
    if (!frot_spare_rows_hold(m, s, w, t + h, w->step.z)) {
      frot_spare_nothing(m, s, w);
      s->statistics.rejected++;
      return FROT_DIVERGE;
    }
    frot_measure_end(m, s, w, t + h, w->step.z1);
    status = frot_make_dense(m, s, w, t, h);
    if (status == FROT_OK && s->implicit && !frot_implicit_follows_guards(m, s, w))
      status = FROT_DIVERGE;
    if (status == FROT_OK) {
      a->guard = frot_falling_guard(m, s, w, t, h, &a->theta);
      if (a->looks == LOOKS || !frot_seems_to_dip(m, s, w, a->guard, a->theta, h)) return FROT_OK;
      return look_closer(m, s, w, a);
    }
    a->ratio = NAN;
  }
  s->statistics.rejected++;
  if (a->passed < 0 && frot_foresees_posture(m, s, w, t, h)) {
    s->tied = 1, a->loose = a->ratio > 1 ? a->ratio : INFINITY;
    return FROT_DIVERGE;
  }
  a->to_due = 0;
  a->rejections++;
  if (a->ratio > 1 && (a->rejections % PATIENCE == 0 || w->step.noisy > NOISY))
    frot_measure_noise(m, s, w, t + h);
  if (a->rejections % HOLD == 0) frot_hold_worth(s, w);
  if (a->ratio > 1 && a->ratio < 1e300)
    a->h *= fmax(change_of_length(m, s, w, a->ratio), LEAST_PART);
  else
    a->h *= a->passed >= 0                      ? fmin(fmax(NEARLY * part, 0.01), NEARLY)
            : s->implicit && frot_has_motion(m) ? HALF
                                                : CUT;
  if (s->weak && a->passed < 0) frot_shorten_passage(m, s, w, a, h);
  return status == FROT_OK ? FROT_DIVERGE : status;
}

/* Implicit steps are of all states: nothing sleeps in them. */
static void wake_all(const frot_model *m, frot_state *s, frot_work *w) {
  if (s->asleep == 0) return;
  frot_wake_state(m, s, w);
  frot_wake(w);
  s->has_slope = 0; /* other guards are listed */
}

/* The step has become too short. FROT_OK where it can go on with the other method, or an event is
 * at its start (s->pending), else the status of the fault. */
static int give_up(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a, int status) {
  int ends = frot_condition_at_zero(m, s, w);
  int over = a->passed >= 0 && ends >= 0; /* no method has a value beyond it */
  if (!over && !a->changed && frot_change_method(m, s)) {
    if (s->implicit) wake_all(m, s, w);
    int begun = s->implicit ? begin(m, s, w, a) : FROT_OK;
    a->changed = 1, a->h = a->first;
    if (begun == FROT_OK) return FROT_OK;
  }
  int weak = frot_posture_at(m, s, w, a->t);
  double tried = s->statistics.steps > 0 ? a->h : 0; /* the run begins there: text.c */
  if (ends < 0 && weak >= 0) return frot_fail(s, FROT_POSTURE, a->t, weak, -1, -1, tried);
  if (ends < 0)
    return frot_fail_step(m, s, w, status == FROT_OK ? FROT_DIVERGE : status, a->t, a->h);
  frot_fire_at_start(s, w, ends);
  return FROT_OK;
}

/* Change of the step's length that its error will bear if it goes on as it went from the step
 * before to this one (K. Gustafsson, ACM Trans. Math. Softw. 20, 1994, p. 496). */
static double trend(const frot_model *m, frot_state *s, const frot_attempt *a) {
  double change = INFINITY;
  if (reactions_bound(m) && s->last_ratio > 0 && a->ratio > 0)
    change = SAFETY * a->h / s->last_h * pow(s->last_ratio / (a->ratio * a->ratio), 1.0 / 8);
  s->last_h = a->h, s->last_ratio = a->ratio;
  return change;
}

/* Shorten the step until its error is within its bound. FROT_OK with s->pending where there is
 * none but an event at its start. */
static int find_length(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a) {
  double planned = s->h;
  for (int status = FROT_OK;;) {
    double paced = frot_pace_step(m, s, w, a->t, a->h);
    if (paced < a->h) a->h = paced, a->to_due = 0;
    if (!a->to_due && !(a->h > LEAST_STEP * fmax(fabs(a->t), LEAST_TIME * s->h_max))) {
      int over = give_up(m, s, w, a, status);
      if (over != FROT_OK || s->pending) return over;
      continue;
    }
    status = try_step(m, s, w, a);
    if (status == FROT_OK) break;
  }
  double factor = a->ratio > 0 ? change_of_length(m, s, w, a->ratio) : MOST_GROWTH;
  factor = fmin(factor, trend(m, s, a));
  factor = fmin(fmax(factor, LEAST_PART), a->rejections ? 1 : MOST_GROWTH);
  if (factor < 1 && !a->to_due && frot_foresees_posture(m, s, w, a->t, a->h))
    factor = 1; /* a tied step need not be shorter */
  if (w->step.noisy >= 1)
    factor = fmax(factor, 1); /* noise grows with the step as its bound does */
  s->h = fmin(a->h * factor, fmin(a->longest, a->stable));
  if (s->weak) s->h = fmax(a->h, a->want); /* noise does not show how long it may be */
  if (a->to_due) s->h = fmax(s->h, planned);
  return FROT_OK;
}

/* Run the step again with the length h, with its dense output. */
static int run_again(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a, double h) {
  a->h = h, a->to_due = 0;
  int status = frot_run_stages(m, s, w, a->t, h);
  if (status != FROT_OK) return status;
  frot_measure_end(m, s, w, a->t + h, w->step.z1);
  return frot_make_dense(m, s, w, a->t, h);
}

/* End the step where the first guard falls inside it. *guard is the one that does, or -1. A guard
 * may seem to fall, in a step that is long for it, where it only comes near zero: a step that ends
 * before it, or is much shorter, shows that it does not, and hides no other guard's fall. */
static int cut_at_event(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a,
                        int *guard) {
  for (*guard = -1; a->guard >= 0;) {
    double longest = a->h;
    int falls;
    if (a->theta * a->h <= LEAST_STEP * fmax(fabs(a->t), a->h)) {
      frot_fire_at_start(s, w, a->guard);
      return FROT_OK;
    }
    int status = frot_locate(m, s, w, a->t, a->guard, a->theta, &a->h, &falls);
    falls &= a->h <= (a->theta + STRAY) * longest;
    double part = fmin(fmax(NEARLY * a->theta, SHORTER), NEARLY);
    if (status == FROT_OK && falls) {
      *guard = a->guard, a->to_due = 0;
      frot_measure_end(m, s, w, a->t + a->h, w->step.z1);
      return frot_make_dense(m, s, w, a->t, a->h);
    }
    if (status == FROT_OK) status = run_again(m, s, w, a, part * longest);
    if (status != FROT_OK) return status;
    a->guard = frot_falling_guard(m, s, w, a->t, a->h, &a->theta);
  }
  return FROT_OK;
}

/* Rounding that was measured is measured anew before long. */
static void forget_noise(const frot_model *m, frot_state *s, const frot_work *w) {
  const frot_awake_lists *now = w->awake.now;
  double *noise = s->data + w->layout.noise, *guards = noise + m->nq + m->nv;
  for (int k = 0; k < now->n - FROT_QUADRATURES; k++) noise[now->states[k]] *= FORGET;
  for (int k = 0; k < now->n_contacts; k++) guards[now->contacts[k]] *= FORGET;
  for (int k = 0; k < now->n_elements; k++)
    for (int i = 0; i < 2; i++) guards[frot_element_guard(m, now->elements[k]) + i] *= FORGET;
  for (int k = 0; k < now->n_located; k++)
    guards[frot_condition_guard(m) + now->located[k]] *= FORGET;
}

/* Take the step: it becomes the current segment. Its end goes onto the relations; the slope there
 * serves the next step if nothing moved. */
static int keep(const frot_model *m, frot_state *s, frot_work *w, const frot_attempt *a,
                int guard) {
  const frot_layout *l = &w->layout;
  double *x = s->data + l->x, *slope = s->data + l->slope;
  double end = a->to_due ? s->due : a->t + a->h;
  const frot_contact_mode *modes = (const void *)(s->data + l->modes);
  s->statistics.steps++;
  s->statistics.implicit_steps += s->implicit;
  memset(s->data + l->fresh, 0, sizeof(double) * (size_t)m->n_conditions);
  frot_note_sizes(m, s, w, w->step.z1);
  frot_note_worth(s, w, w->step.z1);
  if (guard >= 0) s->last_ratio = 0;
  if (guard >= 0) frot_fire_guards(m, s, w, guard, a->t, a->h);
  if (a->to_due) frot_fire_due(m, s);
  forget_noise(m, s, w);
  frot_keep_step(m, s, w, a->t, a->h, end);
  frot_copy_awake(w, w->step.z1, x);
  frot_unpack(w, frot_stage(w, DP_STAGES), slope);
  memcpy(slope + l->nx, frot_stage(w, DP_STAGES) + w->awake.n,
         sizeof(double) * (size_t)w->guards.count);
  memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)m->ny);
  int moved = 0, lost = frot_lost_row(m, s, w, a->t, a->h);
  if (lost >= 0) return frot_fail(s, FROT_POSTURE, end, lost, -1, -1, a->h);
  int status = s->weak && w->step.near[DP_STAGES]
                   ? FROT_OK
                   : frot_project(m, s, w, end, x, x + m->nq, s->data + l->d, modes, NULL, &moved);
  if (status != FROT_OK) return frot_fail_step(m, s, w, status, end, a->h);
  lost = moved ? frot_speed_lost(m, s, w, end) : -1;
  if (lost >= 0) return frot_fail(s, FROT_POSTURE, end, lost, -1, -1, a->h);
  memcpy(s->data + l->y, w->blocks.y, sizeof(double) * (size_t)m->ny);
  s->has_slope = !moved && !s->pending;
  if (s->has_slope) frot_turn_at_end(m, s, w, slope);
  if (!s->implicit) frot_keep_crossings(m, s, w, a->t, a->h);
  if (!s->pending && !s->implicit && frot_note_still(m, s, w, x))
    s->has_slope = 0; /* other guards are listed */
  frot_choose_next(m, s, a->stiff);
  if (s->implicit) wake_all(m, s, w);
  if (end > s->crowded_since + CROWDED * s->h_max) {
    s->crowded_since = end, s->crowded = 0;
    s->told = s->statistics.events;
  }
  return FROT_OK;
}

/* What the implicit method cannot do here the explicit one is to do, if there is one. */
static int go_explicitly(const frot_model *m, frot_state *s) {
  if (!s->implicit || (!frot_has_motion(m) && m->method != FROT_AUTO)) return 0;
  frot_pass_explicitly(s);
  return 1;
}

/* Find the step's length and its end, and take it. */
static int take(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a) {
  int guard, status = find_length(m, s, w, a);
  if (status != FROT_OK || s->pending) return status;
  status = cut_at_event(m, s, w, a, &guard);
  if (status == FROT_DIVERGE && go_explicitly(m, s)) { /* no stages of a step that ends there */
    a->h = a->first, a->to_due = a->h >= s->due - a->t, a->guard = -1, a->looks = 0;
    status = find_length(m, s, w, a);
    if (status != FROT_OK || s->pending) return status;
    status = cut_at_event(m, s, w, a, &guard);
  }
  if (status != FROT_OK) return frot_fail_step(m, s, w, status, a->t, a->h);
  return s->pending ? FROT_OK : keep(m, s, w, a, guard);
}

static int step(const frot_model *m, frot_state *s, frot_work *w) {
  frot_attempt a = {.t = *frot_segment_at(m, s->data + w->layout.segment).t1,
                    .passed = -1,
                    .guard = -1,
                    .best_ratio = INFINITY};
  if (s->due <= a.t) {
    frot_fire_due(m, s);
    return FROT_OK;
  }
  int status = begin(m, s, w, &a);
  if (status == FROT_NAN && go_explicitly(m, s)) status = begin(m, s, w, &a); /* no Jacobian */
  if (status != FROT_OK) return frot_fail_step(m, s, w, status, a.t, 0);
  status = take(m, s, w, &a);
  frot_see_anew(w);
  w->reactions.follow = 0;
  return status;
}

int frot_step(const frot_model *m, frot_state *s, frot_work *w) {
  frot_let_sleep(m, s, w);
  int status = step(m, s, w);
  frot_wake(w);
  return status;
}
