/* The state machine of an instance, and the kernel behind it. */
#include "instance.h"

#include <math.h>

#define SENTENCE 1536
/* Communication points are sums of steps made by the environment: they differ by rounding. */
#define ROUNDING 1e-9
/* An environment suggests a tolerance; beyond these the integrator gains or holds nothing. */
#define TIGHTEST 1e-14
#define LOOSEST 1e-1

static const char *phase_name(int phase) {
  switch (phase) {
    case FROT_FMU_INSTANTIATED:
      return "before the initialization mode";
    case FROT_FMU_INITIALIZATION:
      return "in initialization mode";
    case FROT_FMU_STEPPING:
      return "between steps";
    case FROT_FMU_DISCARDED:
      return "after a step that ended early";
    case FROT_FMU_FAILED:
      return "after an error";
    default:
      return "after the end of the simulation";
  }
}

int frot_fmu_misplaced(const frot_fmu *fmu, const char *function) {
  return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s must not be called %s.", function,
                      phase_name(fmu->life.phase));
}

static int say_fault(const frot_fmu *fmu, int status, const char *function) {
  char sentence[SENTENCE];
  frot_fault_text(fmu->model, fmu->state, sentence, sizeof sentence);
  if (sentence[0] == '\0')
    return frot_fmu_say(fmu, status, "%s: the values at t = %.15g s cannot be computed.", function,
                        fmu->life.t);
  return frot_fmu_say(fmu, status, "%s: %s", function, sentence);
}

static int say_end(const frot_fmu *fmu, const char *function) {
  return frot_fmu_say(fmu, FROT_FMU_DISCARD, "%s: the model has ended the run at t = %.15g s.",
                      function, fmu->life.t);
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
    case FROT_ALGEBRAIC:
    case FROT_ASSERT:
      return 1;
    default:
      return 0;
  }
}

/* The text itself ended the run: a good end, which the environment learns as a step discarded. */
static int stop_at_end(frot_fmu *fmu, const char *function) {
  fmu->life.phase = FROT_FMU_DISCARDED;
  fmu->life.status = FROT_FMU_DISCARD;
  fmu->life.t = fmax(fmu->life.t, frot_time(fmu->state));
  fmu->values_valid = 0;
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
  fmu->values_valid = 0;
  return say_fault(fmu, fmu->life.status, function);
}

void frot_fmu_reset(frot_fmu *fmu) {
  const frot_fmu_life fresh = {FROT_FMU_INSTANTIATED, 0, 0, 0, 0, 0, 0.0, 0.0, 0.0, 0.0};
  frot_state_clear(fmu->model, fmu->state);
  fmu->life = fresh;
  fmu->values_valid = 0;
}

int frot_fmu_setup(frot_fmu *fmu, const char *function, int has_tolerance, double tolerance,
                   double start, int has_stop, double stop) {
  if (fmu->life.phase != FROT_FMU_INSTANTIATED) return frot_fmu_misplaced(fmu, function);
  if (!isfinite(start))
    return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: the start time is not a number.", function);
  if (has_tolerance && !(isfinite(tolerance) && tolerance > 0.0))
    return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: the tolerance %g is not positive.", function,
                        tolerance);
  if (has_stop && !(isfinite(stop) && stop >= start))
    return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: the stop time %.15g lies before the start %.15g.",
                        function, stop, start);
  fmu->life.has_tolerance = has_tolerance != 0;
  fmu->life.tolerance = has_tolerance ? fmin(fmax(tolerance, TIGHTEST), LOOSEST) : 0.0;
  fmu->life.has_stop = has_stop != 0;
  fmu->life.stop = has_stop ? stop : 0.0;
  fmu->life.start = start;
  fmu->life.t = start;
  return FROT_FMU_OK;
}

int frot_fmu_enter_initialization(frot_fmu *fmu, const char *function) {
  if (fmu->life.phase != FROT_FMU_INSTANTIATED) return frot_fmu_misplaced(fmu, function);
  fmu->life.phase = FROT_FMU_INITIALIZATION;
  fmu->life.started = 0;
  fmu->values_valid = 0;
  return FROT_FMU_OK;
}

/* The parameters that follow from others, and the initial values. */
static int solve_start(frot_fmu *fmu, const char *function) {
  const frot_options options = {fmu->life.tolerance, frot_fmu_on_indeterminate, 0};
  if (fmu->life.started) return FROT_FMU_OK;
  if (frot_start(fmu->model, fmu->state, fmu->work, fmu->life.start, &options) != FROT_OK)
    return say_fault(fmu, FROT_FMU_ERROR, function);
  fmu->life.started = 1;
  fmu->values_valid = 0;
  return FROT_FMU_OK;
}

int frot_fmu_exit_initialization(frot_fmu *fmu, const char *function) {
  if (fmu->life.phase != FROT_FMU_INITIALIZATION) return frot_fmu_misplaced(fmu, function);
  const int status = solve_start(fmu, function);
  if (status == FROT_FMU_OK) fmu->life.phase = FROT_FMU_STEPPING;
  return status;
}

/* A change that the kernel takes back is discarded: the instance goes on with the old values. */
static int settle(frot_fmu *fmu, const char *function) {
  const int status = frot_settle(fmu->model, fmu->state, fmu->work);
  if (status == FROT_CHECK || status == FROT_REFUSED)
    return say_fault(fmu, FROT_FMU_DISCARD, function);
  return status == FROT_OK ? FROT_FMU_OK : stop_at_fault(fmu, function, status);
}

int frot_fmu_ready(frot_fmu *fmu, const char *function, int role) {
  int status = FROT_FMU_OK;
  if (role != FROT_FMU_VARIABLE && role != FROT_FMU_DEPENDENT) return FROT_FMU_OK;
  if (fmu->values_valid) return FROT_FMU_OK;
  if (fmu->life.phase == FROT_FMU_INSTANTIATED) return frot_fmu_misplaced(fmu, function);
  if (fmu->life.phase == FROT_FMU_INITIALIZATION)
    status = solve_start(fmu, function);
  else if (fmu->life.phase == FROT_FMU_STEPPING)
    status = settle(fmu, function);
  /* The call is an error even where the step it belongs to would be one that ends early. */
  if (status != FROT_FMU_OK) return fmu->life.phase == FROT_FMU_STEPPING ? status : FROT_FMU_ERROR;
  if (role != FROT_FMU_VARIABLE) return FROT_FMU_OK;
  if (frot_values(fmu->model, fmu->state, fmu->work, fmu->values) != FROT_OK)
    return say_fault(fmu, FROT_FMU_ERROR, function);
  fmu->values_valid = 1;
  return FROT_FMU_OK;
}

/* Runs the kernel to time t and logs the events on the way. */
static int advance(frot_fmu *fmu, double t) {
  frot_recorder *recorder = fmu->categories & FROT_FMU_LOG_EVENTS ? &fmu->recorder : NULL;
  char sentence[SENTENCE];
  int status;
  do {
    if (recorder != NULL) recorder->event_count = 0;
    status = frot_advance(fmu->model, fmu->state, fmu->work, t, recorder, NULL, NULL);
    for (long long i = 0; recorder != NULL && i < recorder->event_count; i++) {
      frot_event_text(fmu->model, &recorder->events[i], sentence, sizeof sentence);
      frot_fmu_say_event(fmu, sentence);
    }
  } while (status == FROT_FULL && recorder != NULL && recorder->event_count > 0);
  return status;
}

/* Runs to time t; an instant of the text that differs from it by the rounding of communication
 * points belongs to it, so that a value sampled there is seen there. */
static int advance_to_point(frot_fmu *fmu, double t, double scale) {
  const int status = advance(fmu, fmax(t, frot_time(fmu->state)));
  const double next = frot_next_instant(fmu->state);
  if (status != FROT_OK || next > t + ROUNDING * scale) return status;
  return advance(fmu, next);
}

int frot_fmu_step(frot_fmu *fmu, const char *function, double point, double step) {
  frot_fmu_life *life = &fmu->life;
  if (life->phase == FROT_FMU_DISCARDED && frot_last_fault(fmu->state)->status == FROT_OK) {
    say_end(fmu, function);
    return FROT_FMU_DISCARD;
  }
  if (life->phase == FROT_FMU_DISCARDED || life->phase == FROT_FMU_FAILED)
    return say_fault(fmu, life->status, function);
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
  int status = settle(fmu, function);
  if (status != FROT_FMU_OK) return status;
  fmu->values_valid = 0;
  status = advance_to_point(fmu, t, scale);
  if (status != FROT_OK) return stop_at_fault(fmu, function, status);
  life->t = t;
  return FROT_FMU_OK;
}

int frot_fmu_terminate(frot_fmu *fmu, const char *function) {
  switch (fmu->life.phase) {
    case FROT_FMU_STEPPING:
    case FROT_FMU_DISCARDED:
    case FROT_FMU_FAILED:
      break;
    default:
      return frot_fmu_misplaced(fmu, function);
  }
  /* Values stay readable after the end, those set since the last step included. */
  if (fmu->life.phase == FROT_FMU_STEPPING && !fmu->values_valid) {
    if (settle(fmu, function) != FROT_FMU_OK && fmu->life.phase != FROT_FMU_STEPPING)
      return FROT_FMU_ERROR;
  }
  fmu->life.phase = FROT_FMU_TERMINATED;
  return FROT_FMU_OK;
}
