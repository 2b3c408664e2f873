#include "stepping/attempt.h"

#include <math.h>
#include <string.h>

#include "model/sleeping.h"
#include "evaluation/fault_source.h"
#include "singular/posture_rounding.h"
#include "singular/singular_posture.h"
#include "stepping/step_ends.h"
#include "stepping/error_estimate.h"
#include "guards/guard_crossing.h"
#include "guards/vanishing_slips.h"
#include "methods/rodas.h"
#include "methods/jacobian.h"
#include "stepping/step_length.h"
#include "singular/undetermined_branch.h"
#include "methods/right_hand_side.h"
#include "stepping/time_resolution.h"
#include "stepping/posture_passage.h"
#include "methods/error_scales.h"
#include "constraints/redundant_rows.h"
#include "methods/dormand_prince.h"
#include "methods/method_choice.h"
#include "numerics/tolerances.h"

/* Rejections of one step after which the rounding of its derivatives is measured. */
#define PATIENCE 2
/* Part of an error from which on what is left of an older measure is measured again at once. */
#define NOISY 0.01
/* Rejections after which the sizes of states and guards no longer shrink with the step, if the
 * error has not fallen by so much beside its bound: of what grows as a high power of time it never
 * does. */
#define HOLD 6
#define HARDLY 0.1
/* Shrinking of steps after which rounding of a guard is asked for, though none was rejected, where
 * its error is this part of the bound: errors of order eight would have vanished. */
#define UNHEARD 8
#define AUDIBLE 0.01
/* Power of the step's length that an error of order eight shrinks with at least. */
#define SHRINKS 4
#define LOUDEST 16 /* times that rounding may be larger than measured */
#define HALF 0.5
/* Part of an error that its halved step leaves at least where rounding made it. */
#define LEFT 0.125
#define TRIED                                                                                    \
  2             /* times the least length: where a step begins that leaves no room, one is tried \
                 */
#define LOOKS 7 /* at a guard that seems to dip, in ever shorter steps */

frot_attempt frot_attempt_from(double t) {
  return (frot_attempt){
      .t = t, .passed = -1, .guard = -1, .best_ratio = INFINITY, .stubborn = INFINITY};
}

/* Whether nothing moves, nor starts to, at a stage. */
static int is_still(const frot_work *w, int stage) {
  for (int j = 0; j < w->awake.n - FROT_QUADRATURES; j++)
    if (frot_stage(w, stage)[j] != 0) return 0;
  return 1;
}

/* The same of a whole step. */
static int rests(const frot_work *w) { return is_still(w, 0) && is_still(w, DP_STAGES); }

/* Whether anything in a group can slip or part. */
static int has_modes(const frot_model *m, const frot_state *s, const frot_work *w, int group) {
  const frot_group *g = &m->groups[group];
  const double *unilateral = s->data + w->layout.unilateral;
  int any = g->n_elements > 0;
  for (int k = 0; k < g->n_contacts; k++) any |= unilateral[g->contacts[k]] != 0;
  return any;
}

/* End the modes of a group that has no reactions in them, once at an instant: others are looked
 * for. Returns whether it has. */
static int end_modes(const frot_model *m, frot_state *s, const frot_work *w, double t) {
  int group = w->reactions.jammed;
  if (group < 0 || s->jammed_at == t || !has_modes(m, s, w, group)) return 0;
  s->jammed_at = t, s->jammed = group;
  s->h = fmax(s->h, s->calm); /* steps that led here were short for the modes that end */
  s->pending = 1;
  return 1;
}

int frot_begin_step(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a) {
  a->longest = frot_longest_step(m, s, w, a->t, 0);
  a->h = fmin(fmax(s->h, TRIED * frot_least_step(s, a)), a->longest);
  frot_forget_redundant_rows(w);
  memset(w->guards.shown, 0, sizeof(double) * (size_t)w->layout.ng);
  w->reactions.jammed = -1;
  int known = s->has_slope, status = frot_start_slope(m, s, w, a->t);
  if (status == FROT_OK && !known && frot_note_resting_islands_at_start(m, s, w)) {
    frot_enter_sleep(m, s, w);
    status = frot_start_slope(m, s, w, a->t);
  }
  if (status == FROT_OK && is_still(w, 0)) {
    a->longest = frot_longest_step(m, s, w, a->t, 1);
    a->h = m->time_dependent || s->ramps ? fmin(s->h, a->longest) : a->longest;
  }
  memcpy(w->step.first, frot_stage(w, 0), sizeof(double) * (size_t)frot_width(w));
  frot_copy_awake(w, w->step.z0, w->step.z1);
  if (status == FROT_OK && s->implicit) status = frot_implicit_begin(m, s, w, a->t);
  double begins = frot_begin_slips(m, s, w);
  if (begins < INFINITY) a->h = fmin(begins, a->longest); /* whatever the steps before were */
  a->want = a->h, a->most = a->longest;
  if (s->weak) a->h = frot_place_between_postures(m, s, w, a->t, a->h, a->most);
  a->to_due = a->h >= s->due - a->t;
  if (a->to_due) a->h = s->due - a->t;
  a->first = a->h;
  if (status == FROT_OK) frot_use_redundant_rows(m, w, s->data + w->layout.spare);
  if (status == FROT_DIVERGE && end_modes(m, s, w, a->t)) return FROT_OK;
  return status;
}

/* Next to a posture that the step comes from there is far more of it than where the step leads. */
static int measure_noise(const frot_model *m, frot_state *s, frot_work *w, double t, int deep) {
  if (s->from_posture) return 0;
  s->heard = s->h;
  return frot_measure_rounding(m, s, w, t, deep);
}

/* Whether a guard has made the steps ever shorter, each with an error that was within its bound,
 * and still does. What rounding makes of a guard is as large in the shortest: of its integral over
 * the step the error is looked at, whose bound shrinks with the step. */
static int shrinks_unheard(const frot_state *s, const frot_work *w, const frot_attempt *a) {
  return !s->implicit && w->step.worst < 0 && a->ratio > AUDIBLE && UNHEARD * s->h < s->heard;
}

/* The error of the step that ran, over its bound, by rounding that is measured now. */
static double hear(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  if (!measure_noise(m, s, w, t + h, 0)) { /* the end is read later */
    memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)m->ny);
    frot_slope(m, s, w, t + h, w->step.z1, frot_stage(w, DP_STAGES + 1));
  }
  return frot_error_ratio(m, s, w, t, h);
}

/* Whether a guard falls where the step begins though nobody knows yet what rounding does: what has
 * just begun, and is moved by nothing at the instant, is rounding at first. */
static int falls_unheard(const frot_state *s, const frot_attempt *a) {
  return a->guard >= 0 && a->theta * a->h <= FROT_LEAST_STEP * fmax(fabs(a->t), a->h) &&
         s->noise_measured <= 0 && a->looks == 0;
}

/* Take a guard that seems to dip for what it is: first by what rounding does to it, then by a
 * shorter step. */
static int look_closer(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a) {
  if (a->looks++ == 0)
    measure_noise(m, s, w, a->t + a->h, 0);
  else
    a->h *= FROT_EARLY, a->to_due = 0;
  s->statistics.rejected++;
  return FROT_DIVERGE;
}

/* An error that hardly shrinks with the step is rounding, and more of it than was measured: samples
 * near each other may all be rounded alike. What is no number, and passes that are laid, say
 * nothing. */
static void see_noise(frot_state *s, frot_attempt *a) {
  double part = a->tried_h > 0 ? a->h / a->tried_h : 1;
  if (!s->implicit && !s->weak && part < 1 && a->ratio > pow(part, SHRINKS) * a->tried_ratio) {
    s->noise_level = fmin(2 * s->noise_level, LOUDEST);
    s->noise_shown = 1;
  }
  a->tried_h = a->ratio > 0 && a->ratio < 1e300 ? a->h : 0, a->tried_ratio = a->ratio;
}

/* Whether the step is followed inside, though nobody looks: where a guard may fall too. */
static int needs_dense(const frot_model *m, const frot_state *s, const frot_work *w) {
  return frot_needs_inside(m, s) || frot_guard_may_cross(s, w, rests(w));
}

/* Whether the step that ran is none for what rounding, beyond the bound, brings to it: too much of
 * what moves, as next to a pole of reactions. It is halved, and where that leaves nearly as much no
 * step is any good (a->h == 0): rounding decides where the motion goes. Passages have a rule of
 * their own. */
static int drowns(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a) {
  if (s->implicit || s->weak || !w->step.rounded) return 0;
  double part = frot_part_of_motion(m, s, w, a->h);
  int stays = a->drowned > 0 && part > LEFT * a->drowned;
  if (!(part > FROT_DROWNED) && !stays) {
    if (part > frot_step_tolerance(s)) s->statistics.blurred = fmax(s->statistics.blurred, part);
    return 0;
  }
  a->drowned = part, a->to_due = 0;
  a->h *= stays ? 0 : HALF;
  s->statistics.rejected++;
  return 1;
}

/* Try the step once: FROT_OK if it is good, with its dense output if it needs that; then s->h is
 * the next one's length. */
static int try_step(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a) {
  double t = a->t, h = a->h;
  int status = frot_run_stages(m, s, w, t, h);
  if (status == FROT_POSTURE) {
    frot_pass_explicitly(s);
    return FROT_DIVERGE;
  }
  a->passed = status == FROT_NAN ? frot_condition_passed(m, s, w, t, h, &a->part) : -1;
  a->ratio = status == FROT_OK ? frot_error_ratio(m, s, w, t, h) : NAN;
  see_noise(s, a);
  if (a->ratio <= 1 && (shrinks_unheard(s, w, a) || (w->step.pardoned && s->heard_at != t) ||
                        (!s->implicit && s->noise_measured < 0)))
    a->tried_ratio = a->ratio = hear(m, s, w, t, h);
  if (a->loose > 0) frot_judge_projected_stages(s, a->ratio, a->loose), a->loose = 0;
  a->forced = a->blurred;
  if (a->forced) frot_take_forced(s, a);
  if (s->weak && a->ratio <= 1) a->ratio = fmax(a->ratio, pow(w->step.turning, 8));
  if (status == FROT_OK && !frot_step_avoids_posture(m, s, w, a)) {
    s->statistics.rejected++;
    return FROT_DIVERGE;
  }
  if (s->weak) frot_judge_passage(m, s, w, a);
  if (a->h == 0 || (a->ratio <= 1 && drowns(m, s, w, a))) return FROT_DIVERGE;
  if (a->ratio <= 1) {
    a->stiff = frot_is_stiff(m, s, w, h);
    a->stable = frot_stable_step(m, s, w, h);
    frot_copy_awake(w, w->step.z1, w->step.z);
    if (!frot_redundant_rows_hold(m, s, w, t + h, w->step.z)) {
      frot_restore_redundant_rows(m, s, w);
      s->statistics.rejected++;
      return FROT_DIVERGE;
    }
    frot_measure_end(m, s, w, t + h, w->step.z1);
    a->dense = needs_dense(m, s, w);
    if (!a->dense) return frot_make_cubic(w, h), a->guard = -1, FROT_OK;
    status = frot_make_dense(m, s, w, t, h);
    int followed = s->implicit ? frot_implicit_follows_guards(m, s, w)
                               : !rests(w) || frot_guards_fit_stages(s, w, h);
    if (status == FROT_OK && !followed) status = FROT_DIVERGE;
    if (status == FROT_OK) {
      a->guard = frot_first_crossing(m, s, w, t, h, &a->theta);
      int closer = falls_unheard(s, a) || frot_may_be_dip(m, s, w, a->guard, a->theta, t, h);
      if (a->looks == LOOKS || !closer) return FROT_OK;
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
  int unfound = s->implicit && status == FROT_DIVERGE && frot_has_motion(m);
  if (status == FROT_OK && a->ratio > 1 && w->step.worst < 0 && a->rejections % PATIENCE == 0)
    frot_measure_end(m, s, w, t + h, w->step.z1); /* a guard: of what size its terms are now */
  if ((a->ratio > 1 && (w->step.noisy > NOISY)) ||
      ((a->ratio > 1 || unfound) && a->rejections % PATIENCE == 0))
    measure_noise(m, s, w, t + h, a->rejections > HOLD);
  if (a->rejections % HOLD == 0) {
    if (a->ratio > HARDLY * a->stubborn) frot_keep_state_sizes(s, w), frot_keep_guard_sizes(s, w);
    a->stubborn = isfinite(a->ratio) ? a->ratio : INFINITY;
  }
  frot_shorten(m, s, w, a);
  if (s->weak && a->passed < 0) frot_shorten_passage(m, s, w, a, h);
  return status == FROT_OK ? FROT_DIVERGE : status;
}

/* Whether no step is possible because the stages, however near, have no reactions in the modes of a
 * group with friction, or because those of a slip grow without bound: then other modes are looked
 * for. */
static int step_ends_modes(const frot_model *m, frot_state *s, frot_work *w,
                           const frot_attempt *a) {
  if (a->passed >= 0) return 0;
  if (!isnan(a->ratio) && w->reactions.jammed < 0)
    w->reactions.jammed = frot_group_of_jamming_slip(m, s, w);
  if (!end_modes(m, s, w, a->t)) return 0;
  frot_unpack_awake(w, frot_stage(w, 0), s->data + w->layout.slope);
  return 1;
}

/* The step has become too short. FROT_OK where it can go on with the other method, or an event is
 * at its start (s->pending), else the status of the fault. */
static int give_up(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a, int status) {
  int ends = frot_condition_at_zero(m, s, w, a->passed, a->t, frot_least_step(s, a));
  int over = a->passed >= 0 && ends >= 0; /* no method has a value beyond it */
  if (ends < 0 && step_ends_modes(m, s, w, a)) return FROT_OK;
  if (!over && !a->changed && frot_change_method(m, s)) {
    if (s->implicit) frot_wake_within_step(m, s, w);
    int begun = s->implicit ? frot_begin_step(m, s, w, a) : FROT_OK;
    a->changed = 1, a->h = a->first;
    if (begun == FROT_OK) return FROT_OK;
  }
  int weak = frot_posture_at(m, s, w, a->t);
  double tried = s->statistics.steps > 0; /* else the run begins there: fault_messages.c */
  if (ends < 0 && weak >= 0) return frot_fail(s, FROT_POSTURE, a->t, weak, -1, -1, tried);
  if (ends < 0)
    return frot_fail_step(m, s, w, status == FROT_OK ? FROT_DIVERGE : status, a->t, a->h,
                          w->step.z1, w->step.z1 + m->nq);
  frot_fire_at_start(s, w, ends);
  return FROT_OK;
}

static int find_length(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a) {
  double planned = s->h;
  for (int status = FROT_OK;;) {
    double paced = frot_resolve_time(m, s, w, a->t, a->h);
    if (paced < a->h) a->h = paced, a->to_due = 0;
    if (!a->to_due && frot_is_too_short(s, a)) {
      int over = give_up(m, s, w, a, status);
      if (over != FROT_OK || s->pending) return over;
      continue;
    }
    status = try_step(m, s, w, a);
    if (status == FROT_OK) break;
  }
  frot_plan_next(m, s, w, a, planned);
  return FROT_OK;
}

int frot_find_length(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a) {
  w->blocks.within = 1;
  int status = find_length(m, s, w, a);
  w->blocks.within = 0;
  return status;
}
