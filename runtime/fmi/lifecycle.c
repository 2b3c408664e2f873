/* The state machine of an instance around its steps: experiment, initialization, end. */
#include "instance.h"

#include <math.h>

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
    case FROT_FMU_EVENT:
      return "in event mode";
    case FROT_FMU_CONTINUOUS:
      return "in continuous-time mode";
    case FROT_FMU_ASKED:
    case FROT_FMU_SHOWN:
    case FROT_FMU_PAUSED:
      return "in an intermediate update";
    case FROT_FMU_ENDED:
      return "after the model has ended the run";
    default:
      return "after the end of the simulation";
  }
}

int frot_fmu_misplaced(const frot_fmu *fmu, const char *function) {
  return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s must not be called %s.", function,
                      phase_name(fmu->life.phase));
}

int frot_fmu_is_called(const frot_fmu *fmu) { return fmu->life.phase >= FROT_FMU_ASKED; }

void frot_fmu_reset(frot_fmu *fmu) {
  const frot_fmu_life fresh = {FROT_FMU_INSTANTIATED, 0, 0, 0, 0, 0, 0, 0.0, 0.0, 0.0, 0.0};
  frot_state_clear(fmu->model, fmu->state);
  fmu->life = fresh;
  fmu->unsettled = FROT_FMU_SETTLED;
  fmu->values_valid = fmu->motion_valid = 0;
}

int frot_fmu_begin_anew(frot_fmu *fmu, const char *function) {
  if (frot_fmu_is_called(fmu)) return frot_fmu_misplaced(fmu, function);
  frot_fmu_reset(fmu);
  return FROT_FMU_OK;
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
  fmu->values_valid = fmu->motion_valid = 0;
  return FROT_FMU_OK;
}

/* The parameters that follow from others, and the initial values. */
static int solve_start(frot_fmu *fmu, const char *function) {
  const frot_options options = {fmu->life.tolerance, frot_fmu_on_indeterminate,
                                frot_fmu_on_impasse};
  if (fmu->life.started) return FROT_FMU_OK;
  if (frot_start(fmu->model, fmu->state, fmu->work, fmu->life.start, &options) != FROT_OK)
    return frot_fmu_say_fault(fmu, FROT_FMU_ERROR, function);
  fmu->life.started = 1;
  fmu->values_valid = fmu->motion_valid = 0;
  return FROT_FMU_OK;
}

int frot_fmu_exit_initialization(frot_fmu *fmu, const char *function) {
  if (fmu->life.phase != FROT_FMU_INITIALIZATION) return frot_fmu_misplaced(fmu, function);
  const int status = solve_start(fmu, function);
  if (status == FROT_FMU_OK && fmu->exchanges)
    frot_exchange_begin(fmu->model, fmu->state, fmu->work);
  if (status == FROT_FMU_OK)
    fmu->life.phase = fmu->watches_events || fmu->exchanges ? FROT_FMU_EVENT : FROT_FMU_STEPPING;
  return status;
}

int frot_fmu_ready(frot_fmu *fmu, const char *function, int role) {
  int status = FROT_FMU_OK;
  if (role < FROT_FMU_VARIABLE && role != FROT_FMU_DEPENDENT) return FROT_FMU_OK;
  if (role > FROT_FMU_VARIABLE ? fmu->motion_valid : fmu->values_valid) return FROT_FMU_OK;
  if (fmu->life.phase == FROT_FMU_INSTANTIATED) return frot_fmu_misplaced(fmu, function);
  if (fmu->life.phase == FROT_FMU_INITIALIZATION)
    status = solve_start(fmu, function);
  else if (fmu->life.phase == FROT_FMU_STEPPING || fmu->life.phase == FROT_FMU_EVENT)
    status = frot_fmu_settle(fmu, function);
  else if (fmu->life.phase == FROT_FMU_CONTINUOUS)
    status = frot_fmu_take_inputs(fmu, function);
  /* The call is an error even where the step it belongs to would be one that ends early. */
  if (status != FROT_FMU_OK) return FROT_FMU_ERROR;
  if (role > FROT_FMU_VARIABLE) return frot_fmu_find_motion(fmu, function);
  if (role != FROT_FMU_VARIABLE) return FROT_FMU_OK;
  const int found = fmu->exchanges
                        ? frot_exchange_values(fmu->model, fmu->state, fmu->work, fmu->values)
                        : frot_values(fmu->model, fmu->state, fmu->work, fmu->values);
  if (found != FROT_OK) return frot_fmu_say_fault(fmu, FROT_FMU_ERROR, function);
  fmu->values_valid = 1;
  return FROT_FMU_OK;
}

int frot_fmu_terminate(frot_fmu *fmu, const char *function) {
  switch (fmu->life.phase) {
    case FROT_FMU_STEPPING:
    case FROT_FMU_EVENT:
    case FROT_FMU_CONTINUOUS:
    case FROT_FMU_DISCARDED:
    case FROT_FMU_FAILED:
    case FROT_FMU_ENDED:
      break;
    default:
      return frot_fmu_misplaced(fmu, function);
  }
  /* Values stay readable after the end, those set since the last step included. */
  const int settles = fmu->life.phase == FROT_FMU_STEPPING || fmu->life.phase == FROT_FMU_EVENT;
  if (settles && !fmu->values_valid) {
    /* What is refused now no longer matters. */
    const int status = frot_fmu_settle(fmu, function);
    if (status == FROT_FMU_ERROR && !fmu->life.refused) return FROT_FMU_ERROR;
  }
  fmu->life.refused = 0;
  fmu->life.phase = FROT_FMU_TERMINATED;
  return FROT_FMU_OK;
}
