/* A step of the environment: what was set takes effect or is refused, then the kernel runs. */
#include "instance.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define SENTENCE 1536
/* Communication points are sums of steps made by the environment: they differ by rounding. */
#define ROUNDING 1e-9

int frot_fmu_say_fault(const frot_fmu *fmu, int status, const char *function) {
  char sentence[SENTENCE];
  frot_fault_text(fmu->model, fmu->state, sentence, sizeof sentence);
  if (sentence[0] == '\0')
    return frot_fmu_say(fmu, status, "%s: the values at t = %.15g s cannot be computed.", function,
                        fmu->life.t);
  return frot_fmu_say(fmu, status, "%s: %s", function, sentence);
}

/* The text itself ended the run: a good end. FMI 2.0 has no other word for it than a step
 * discarded. */
static int say_end(const frot_fmu *fmu, const char *function) {
  char sentence[SENTENCE];
  snprintf(sentence, sizeof sentence, "%s: the model has ended the run at t = %.15g s.", function,
           fmu->life.t);
  frot_fmu_say_event(fmu, sentence);
  return FROT_FMU_DISCARD;
}

/* Faults that leave the motion up to their instant right. */
static int ends_early(int fault) {
  switch (fault) {
    case FROT_IMPACT:
    case FROT_IMPASSE:
    case FROT_SEVERAL:
    case FROT_CHATTER:
    case FROT_NAN:
    case FROT_DIVERGE:
    case FROT_POSTURE:
    case FROT_ALGEBRAIC:
    case FROT_ASSERT:
    case FROT_NO_NORMAL:
    case FROT_JUMP:
    case FROT_EVENT_FAULT:
      return 1;
    default:
      return 0;
  }
}

static int stop_at_end(frot_fmu *fmu, const char *function) {
  fmu->life.phase = FROT_FMU_ENDED;
  fmu->life.status = FROT_FMU_DISCARD;
  fmu->life.t = fmax(fmu->life.t, frot_time(fmu->state));
  fmu->values_valid = fmu->motion_valid = 0;
  return say_end(fmu, function);
}

/* Ends the motion with the kernel's fault. */
static int stop_at_fault(frot_fmu *fmu, const char *function, int fault) {
  if (fault == FROT_TERMINATED) return stop_at_end(fmu, function);
  /* The fault may lie in a step that was only tried: values end where the kernel stands. */
  const double t = frot_time(fmu->state);
  if (ends_early(fault)) {
    fmu->life.phase = FROT_FMU_DISCARDED;
    fmu->life.status = FROT_FMU_DISCARD;
    if (t > fmu->life.t) fmu->life.t = t;
  } else {
    fmu->life.phase = FROT_FMU_FAILED;
    fmu->life.status = FROT_FMU_ERROR;
  }
  fmu->values_valid = fmu->motion_valid = 0;
  return frot_fmu_say_fault(fmu, fmu->life.status, function);
}

void frot_fmu_note_change(frot_fmu *fmu) {
  frot_fmu_life *life = &fmu->life;
  if (life->refused) life->phase = life->refused;
  life->refused = 0;
  if (life->phase != FROT_FMU_STEPPING && life->phase != FROT_FMU_EVENT) return;
  if (fmu->unsettled != FROT_FMU_SETTLED) return;
  memcpy(fmu->accepted, fmu->state, fmu->state_size);
  fmu->unsettled = FROT_FMU_REVOCABLE;
}

/* The kernel itself goes back from a value that the model cannot have. */
static int taken_back(int fault) { return fault == FROT_CHECK || fault == FROT_REFUSED; }

/* What was set is refused: the former values hold, and others may be set. An error even so: after
 * a step discarded some environments try the same again, for ever. */
static int refuse_change(frot_fmu *fmu, const char *function, int fault) {
  char sentence[SENTENCE];
  frot_fmu_life *life = &fmu->life;
  frot_fault_text(fmu->model, fmu->state, sentence, sizeof sentence);
  if (!taken_back(fault)) memcpy(fmu->state, fmu->accepted, fmu->state_size);
  life->refused = life->phase;
  life->phase = ends_early(fault) ? FROT_FMU_DISCARDED : FROT_FMU_FAILED;
  life->status = ends_early(fault) ? FROT_FMU_DISCARD : FROT_FMU_ERROR;
  return frot_fmu_say(fmu, life->status,
                      "%s: %s. What was set at t = %.15g s is refused, the former values hold.",
                      function, sentence, life->t);
}

int frot_fmu_settle(frot_fmu *fmu, const char *function) {
  const int status = frot_settle(fmu->model, fmu->state, fmu->work);
  const int revocable = fmu->unsettled == FROT_FMU_REVOCABLE || taken_back(status);
  fmu->unsettled = FROT_FMU_SETTLED;
  if (status == FROT_OK) return FROT_FMU_OK;
  fmu->values_valid = fmu->motion_valid = 0;
  if (status == FROT_TERMINATED || !revocable) return stop_at_fault(fmu, function, status);
  return refuse_change(fmu, function, status);
}

void frot_fmu_take_events(frot_recorder *recorder, void *context) {
  frot_fmu *fmu = context;
  const int logs = (fmu->categories & FROT_FMU_LOG_EVENTS) != 0;
  char sentence[SENTENCE];
  for (long long i = 0; i < recorder->event_count; i++) {
    frot_fmu_see_event(fmu, &recorder->events[i]);
    if (!logs) continue;
    frot_event_text(fmu->model, &recorder->events[i], sentence, sizeof sentence);
    frot_fmu_say_event(fmu, sentence);
  }
  recorder->event_count = 0;
}

/* Runs the kernel to time t and logs the events on the way. */
static int advance(frot_fmu *fmu, double t, frot_fmu_budget *budget) {
  const int logs = (fmu->categories & FROT_FMU_LOG_EVENTS) != 0;
  frot_recorder *recorder = logs || fmu->watches_events ? &fmu->recorder : NULL;
  if (recorder == NULL)
    return frot_advance(fmu->model, fmu->state, fmu->work, t, NULL, frot_fmu_spent, budget);
  recorder->drain = frot_fmu_take_events, recorder->context = fmu;
  int status, drained;
  do {
    status = frot_advance(fmu->model, fmu->state, fmu->work, t, recorder, frot_fmu_spent, budget);
    drained = recorder->event_count > 0;
    frot_fmu_take_events(recorder, fmu);
  } while (status == FROT_FULL && drained);
  return status;
}

/* Runs to time t; an instant of the text that differs from it by the rounding of communication
 * points belongs to it, so that a value sampled there is seen there. */
static int advance_to_point(frot_fmu *fmu, double t, double scale, frot_fmu_budget *budget) {
  const int status = advance(fmu, fmax(t, frot_time(fmu->state)), budget);
  const double next = frot_next_instant(fmu->state);
  if (status != FROT_OK || next > t + ROUNDING * scale) return status;
  return advance(fmu, next, budget);
}

/* The same, or to the first event on the way where the environment wants to be there; *t is the
 * time reached. What a step tries beyond an event is not logged. */
static int advance_to_event(frot_fmu *fmu, double *t, double scale, frot_fmu_budget *budget) {
  const unsigned categories = fmu->categories;
  frot_fmu_begin_watch(fmu);
  if (!fmu->watches_events || !fmu->returns_early) {
    const int status = advance_to_point(fmu, *t, scale, budget);
    fmu->event = fmu->watches_events && fmu->first_event <= *t + ROUNDING * scale;
    return status;
  }
  fmu->categories &= ~(unsigned)FROT_FMU_LOG_EVENTS;
  budget->until_event = 1;
  const int status = advance_to_point(fmu, *t, scale, budget);
  const double reached = status == FROT_OK ? *t : frot_time(fmu->state);
  const double near = fmin(scale, fmax(fabs(fmu->life.t), fabs(fmu->first_event)));
  fmu->categories = categories;
  fmu->event = fmu->first_event <= reached + ROUNDING * near;
  if (!fmu->seen && !fmu->event) return status;
  const int early = fmu->event && fmu->first_event < *t - ROUNDING * near;
  if (early) *t = fmu->first_event;
  frot_fmu_go_back(fmu);
  *budget = frot_fmu_begin_budget(fmu, *t);
  return advance_to_point(fmu, *t, early ? near : scale, budget);
}

static int stop_at_limit(frot_fmu *fmu, const char *function, const frot_fmu_budget *budget) {
  fmu->life.phase = FROT_FMU_DISCARDED;
  fmu->life.status = FROT_FMU_DISCARD;
  fmu->life.t = fmax(fmu->life.t, frot_time(fmu->state));
  return frot_fmu_say_spent(fmu, function, budget);
}

/* The answer to a step after one that could not be done. */
static int say_again(const frot_fmu *fmu, const char *function) {
  const frot_fmu_life *life = &fmu->life;
  if (life->phase == FROT_FMU_ENDED) return say_end(fmu, function);
  if (life->refused)
    return frot_fmu_say(fmu, life->status,
                        "%s: what was set at t = %.15g s was refused: other values must be set "
                        "before the motion goes on.",
                        function, life->t);
  if (frot_last_fault(fmu->state)->status == FROT_OK)
    return frot_fmu_say(fmu, life->status, "%s: the last step has ended early at t = %.15g s.",
                        function, life->t);
  return frot_fmu_say_fault(fmu, life->status, function);
}

/* From point to point, where the environment gives and reads values; *t is the time reached. */
static int advance_by_points(frot_fmu *fmu, double *t, double scale, frot_fmu_budget *budget) {
  const double begin = fmu->life.t, step = *t - begin;
  const int points = frot_fmu_points(fmu);
  for (int k = 1; k <= points; k++) {
    double next = k == points ? begin + step : begin + step * k / points;
    frot_fmu_ask_inputs(fmu, next);
    const int status = advance_to_event(fmu, &next, scale, budget);
    if (status == FROT_STOPPED && budget->spent == FROT_FMU_CANCELLED) {
      next = frot_time(fmu->state), fmu->returned = 1;
    } else if (status != FROT_OK) {
      return status;
    }
    frot_hold_inputs(fmu->model, fmu->state);
    *t = fmu->life.t = next;
    fmu->values_valid = 0;
    if (fmu->returned || frot_fmu_ends_at(fmu, next) || fmu->event) break;
  }
  return FROT_OK;
}

int frot_fmu_step(frot_fmu *fmu, const char *function, double point, double step) {
  frot_fmu_life *life = &fmu->life;
  fmu->event = fmu->returned = 0;
  if (life->phase == FROT_FMU_DISCARDED || life->phase == FROT_FMU_FAILED ||
      life->phase == FROT_FMU_ENDED)
    return say_again(fmu, function);
  if (life->phase != FROT_FMU_STEPPING) return frot_fmu_misplaced(fmu, function);
  if (!(isfinite(step) && step > 0.0))
    return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: the step %g s is not positive.", function, step);
  const double scale = fmax(fabs(life->t), step);
  if (!(fabs(point - life->t) <= ROUNDING * scale))
    return frot_fmu_say(fmu, FROT_FMU_ERROR,
                        "%s: the step begins at %.15g s, but the instance is at %.15g s.", function,
                        point, life->t);
  const double t = point + step;
  if (!(isfinite(t) && t > life->t))
    return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: the step %g s is lost in rounding at %.15g s.",
                        function, step, life->t);
  if (life->has_stop && t > life->stop + ROUNDING * fmax(fabs(life->stop), scale))
    return frot_fmu_say(fmu, FROT_FMU_ERROR,
                        "%s: the step to %.15g s passes the stop time %.15g s.", function, t,
                        life->stop);
  int status = frot_fmu_settle(fmu, function);
  if (status != FROT_FMU_OK) return status;
  fmu->values_valid = fmu->motion_valid = 0;
  frot_fmu_budget budget = frot_fmu_begin_budget(fmu, t);
  double reached = t;
  status = advance_by_points(fmu, &reached, scale, &budget);
  if (status == FROT_STOPPED) return stop_at_limit(fmu, function, &budget);
  if (status != FROT_OK) return stop_at_fault(fmu, function, status);
  life->t = reached;
  return FROT_FMU_OK;
}
