/* Model exchange: the environment steps the motion, the kernel gives rates and handles events. */
#include <math.h>
#include <string.h>

#include "instance.h"

int frot_fmu_refuse_exchange(const frot_fmu *fmu, const char *function) {
  return frot_fmu_refuse(fmu, function,
                         frot_fmu_exchange ? "the instance was made for co-simulation"
                                           : "model exchange is not offered, only co-simulation");
}

int frot_fmu_make_exchange(frot_fmu *fmu) {
  const frot_model *model = fmu->model;
  const size_t states = (size_t)frot_exchange_states(model);
  fmu->states = frot_fmu_memory(states * sizeof(double));
  fmu->rates = frot_fmu_memory(states * sizeof(double));
  fmu->guards = frot_fmu_memory((size_t)frot_exchange_guards(model) * sizeof(double));
  return fmu->states != NULL && fmu->rates != NULL && fmu->guards != NULL;
}

/* Whether the instance is for model exchange and in one of two phases. */
static int is_in(const frot_fmu *fmu, const char *function, int phase, int other) {
  if (!fmu->exchanges) return frot_fmu_refuse_exchange(fmu, function);
  if (fmu->life.phase == phase || fmu->life.phase == other) return FROT_FMU_OK;
  return frot_fmu_misplaced(fmu, function);
}

int frot_fmu_find_motion(frot_fmu *fmu, const char *function) {
  if (fmu->motion_valid) return FROT_FMU_OK;
  frot_exchange_read(fmu->model, fmu->state, fmu->states);
  const int status =
      frot_exchange_rates(fmu->model, fmu->state, fmu->work, fmu->rates, fmu->guards);
  /* No fault of the run: the step that the environment tries may be too long. */
  if (status != FROT_OK)
    return frot_fmu_say(fmu, FROT_FMU_DISCARD,
                        "%s: there is no motion in this mode at the states set for t = %.15g s.",
                        function, fmu->life.t);
  fmu->motion_valid = 1;
  return FROT_FMU_OK;
}

int frot_fmu_set_time(frot_fmu *fmu, const char *function, double t) {
  const int status = is_in(fmu, function, FROT_FMU_CONTINUOUS, FROT_FMU_EVENT);
  if (status != FROT_FMU_OK) return status;
  if (!isfinite(t)) return frot_fmu_refuse(fmu, function, "the time is not a number");
  if (t == fmu->life.t) return FROT_FMU_OK;
  frot_exchange_place(fmu->model, fmu->state, fmu->work, t, NULL);
  fmu->life.t = t;
  fmu->life.moved = 1;
  fmu->values_valid = fmu->motion_valid = 0;
  return FROT_FMU_OK;
}

/* The number of values the environment takes or gives. */
static int is_count(const frot_fmu *fmu, const char *function, const void *values, size_t count,
                    int own) {
  if (count != (size_t)own)
    return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: there are %d values, not %lu.", function, own,
                        (unsigned long)count);
  if (own > 0 && values == NULL)
    return frot_fmu_refuse(fmu, function, "the pointer to the values is NULL");
  return FROT_FMU_OK;
}

int frot_fmu_set_states(frot_fmu *fmu, const char *function, const double *x, size_t count) {
  const int states = frot_exchange_states(fmu->model);
  int status = is_in(fmu, function, FROT_FMU_CONTINUOUS, FROT_FMU_CONTINUOUS);
  if (status == FROT_FMU_OK) status = is_count(fmu, function, x, count, states);
  for (int i = 0; i < states && status == FROT_FMU_OK; i++)
    if (!isfinite(x[i]))
      status = frot_fmu_say(fmu, FROT_FMU_DISCARD, "%s: state %d is not a finite number.", function,
                            i + 1);
  if (status != FROT_FMU_OK) return status;
  frot_exchange_place(fmu->model, fmu->state, fmu->work, fmu->life.t, x);
  fmu->life.moved = 1;
  fmu->values_valid = fmu->motion_valid = 0;
  return FROT_FMU_OK;
}

int frot_fmu_get_motion(frot_fmu *fmu, const char *function, int what, double *values,
                        size_t count) {
  const int guards = what == FROT_FMU_GUARD;
  const int own = guards ? frot_exchange_guards(fmu->model) : frot_exchange_states(fmu->model);
  if (!fmu->exchanges) return frot_fmu_refuse_exchange(fmu, function);
  int status = is_count(fmu, function, values, count, own);
  if (status == FROT_FMU_OK) status = frot_fmu_ready(fmu, function, what);
  if (status != FROT_FMU_OK) return status;
  const double *from = what == FROT_FMU_STATE ? fmu->states : guards ? fmu->guards : fmu->rates;
  if (count > 0) memcpy(values, from, count * sizeof(double));
  return FROT_FMU_OK;
}

int frot_fmu_get_nominals(frot_fmu *fmu, const char *function, double *values, size_t count) {
  if (!fmu->exchanges) return frot_fmu_refuse_exchange(fmu, function);
  const int status = is_count(fmu, function, values, count, frot_exchange_states(fmu->model));
  if (status == FROT_FMU_OK) frot_exchange_nominals(fmu->model, fmu->state, values);
  return status;
}

/* The run ends with the kernel's fault. */
static int fail(frot_fmu *fmu, const char *function) {
  fmu->life.phase = FROT_FMU_FAILED;
  fmu->life.status = FROT_FMU_ERROR;
  fmu->values_valid = fmu->motion_valid = 0;
  return frot_fmu_say_fault(fmu, FROT_FMU_ERROR, function);
}

int frot_fmu_complete_step(frot_fmu *fmu, const char *function, int *event) {
  int status = is_in(fmu, function, FROT_FMU_CONTINUOUS, FROT_FMU_CONTINUOUS);
  *event = 0;
  if (status == FROT_FMU_OK) status = frot_fmu_take_inputs(fmu, function);
  if (status != FROT_FMU_OK) return status;
  fmu->values_valid = fmu->motion_valid = 0;
  if (frot_exchange_accept(fmu->model, fmu->state, fmu->work, event) != FROT_OK)
    return fail(fmu, function);
  return FROT_FMU_OK;
}

int frot_fmu_take_inputs(frot_fmu *fmu, const char *function) {
  if (frot_exchange_inputs(fmu->model, fmu->state, fmu->work) == FROT_OK) return FROT_FMU_OK;
  return fail(fmu, function);
}

int frot_fmu_enter_exchange_event(frot_fmu *fmu, const char *function) {
  int status = is_in(fmu, function, FROT_FMU_CONTINUOUS, FROT_FMU_CONTINUOUS);
  if (status == FROT_FMU_OK) status = frot_fmu_take_inputs(fmu, function);
  if (status == FROT_FMU_OK) fmu->life.phase = FROT_FMU_EVENT;
  return status;
}

int frot_fmu_exchange_update(frot_fmu *fmu, const char *function, int *moved) {
  *moved = 0;
  if (!fmu->exchanges) return frot_fmu_refuse_exchange(fmu, function);
  if (fmu->life.phase == FROT_FMU_ENDED) return FROT_FMU_OK;
  if (fmu->life.phase != FROT_FMU_EVENT) return frot_fmu_misplaced(fmu, function);
  const int set = fmu->unsettled != FROT_FMU_SETTLED;
  int now = 0, status = FROT_FMU_OK;
  if (fmu->life.moved) {
    fmu->recorder.drain = frot_fmu_take_events, fmu->recorder.context = fmu;
    const int fault = frot_exchange_event(fmu->model, fmu->state, fmu->work, &now, &fmu->recorder);
    frot_fmu_take_events(&fmu->recorder, fmu);
    fmu->values_valid = fmu->motion_valid = 0;
    if (fault == FROT_TERMINATED)
      fmu->life.phase = FROT_FMU_ENDED;
    else if (fault != FROT_OK)
      return fail(fmu, function);
    fmu->life.moved = 0;
  }
  *moved = now || set;
  if (fmu->life.phase == FROT_FMU_EVENT && set) status = frot_fmu_settle(fmu, function);
  return fmu->life.phase == FROT_FMU_ENDED ? FROT_FMU_OK : status;
}

int frot_fmu_enter_continuous(frot_fmu *fmu, const char *function) {
  int status = is_in(fmu, function, FROT_FMU_EVENT, FROT_FMU_EVENT), moved;
  if (status == FROT_FMU_OK) status = frot_fmu_exchange_update(fmu, function, &moved);
  if (status == FROT_FMU_OK && fmu->life.phase == FROT_FMU_EVENT)
    fmu->life.phase = FROT_FMU_CONTINUOUS;
  return status;
}
