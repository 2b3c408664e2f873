/* Inputs that change inside a step: their rates, and points in between where the environment gives
 * them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "instance.h"

/* Points of a step at which the environment is called: inputs are linear between two of them. */
#define POINTS 8

static const frot_fmu_variable *input_of(const frot_fmu *fmu, const char *function,
                                         unsigned reference) {
  const frot_fmu_variable *v =
      reference < frot_fmu_variable_count ? &frot_fmu_variables[reference] : NULL;
  if (v != NULL && v->role == FROT_FMU_INPUT && v->type == FROT_REAL) return v;
  frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: value reference %u is no real input.", function,
               reference);
  return NULL;
}

int frot_fmu_set_input_rates(frot_fmu *fmu, const char *function, const unsigned *references,
                             size_t count, const int *orders, const double *values) {
  int status = frot_fmu_arrays(fmu, function, references, values, count);
  if (status != FROT_FMU_OK) return status;
  if (count > 0 && orders == NULL) return frot_fmu_refuse(fmu, function, "the orders are NULL");
  if (fmu->exchanges)
    return frot_fmu_refuse(fmu, function, "the instance was made for model exchange");
  if (fmu->life.phase != FROT_FMU_STEPPING && !fmu->life.refused)
    return frot_fmu_misplaced(fmu, function);
  for (size_t i = 0; i < count; i++) {
    const frot_fmu_variable *v = input_of(fmu, function, references[i]);
    if (v == NULL) return FROT_FMU_ERROR;
    if (orders[i] != 1)
      return frot_fmu_say(fmu, FROT_FMU_ERROR,
                          "%s: the derivative of order %d of '%s' is not taken, the first is.",
                          function, orders[i], v->name);
    if (!isfinite(values[i]))
      return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: the derivative of '%s' is not a finite number.",
                          function, v->name);
  }
  for (size_t i = 0; i < count; i++) {
    frot_fmu_note_change(fmu);
    frot_set_input_rate(fmu->model, fmu->state, (int)references[i] - 1 - fmu->model->np, values[i]);
    fmu->values_valid = fmu->motion_valid = 0;
  }
  return FROT_FMU_OK;
}

int frot_fmu_call_in_between(frot_fmu *fmu, const char *function, frot_fmu_caller caller,
                             const unsigned *references, size_t count) {
  if (count > 0 && references == NULL)
    return frot_fmu_refuse(fmu, function, "the value references are NULL");
  if (count > 0 && caller == NULL)
    return frot_fmu_refuse(fmu, function, "variables are required, but the callback is NULL");
  fmu->caller = caller;
  if (count == 0) return FROT_FMU_OK;
  fmu->in_between = frot_fmu_memory(frot_fmu_variable_count);
  fmu->asked = frot_fmu_memory((size_t)fmu->model->nu * sizeof(double));
  if (fmu->in_between == NULL || fmu->asked == NULL)
    return frot_fmu_refuse(fmu, function, "there is not enough memory");
  for (size_t i = 0; i < count; i++) {
    if (references[i] >= frot_fmu_variable_count)
      return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: there is no value reference %u.", function,
                          references[i]);
    fmu->in_between[references[i]] = 1;
  }
  return FROT_FMU_OK;
}

void frot_fmu_give(frot_fmu *fmu, unsigned reference, double value) {
  fmu->asked[(int)reference - 1 - fmu->model->np] = value;
}

int frot_fmu_points(const frot_fmu *fmu) { return fmu->in_between != NULL ? POINTS : 1; }

/* Inputs are linear from the values that they have to those given for the time t. */
void frot_fmu_ask_inputs(frot_fmu *fmu, double t) {
  const frot_model *model = fmu->model;
  if (fmu->in_between == NULL) return;
  for (int i = 0; i < model->nu; i++) fmu->asked[i] = frot_get_input(model, fmu->state, i);
  fmu->life.phase = FROT_FMU_ASKED;
  fmu->caller(fmu, FROT_FMU_GIVE, t);
  fmu->life.phase = FROT_FMU_STEPPING;
  for (int i = 0; i < model->nu; i++) {
    const double now = frot_get_input(model, fmu->state, i);
    if (fmu->asked[i] != now)
      frot_set_input_rate(model, fmu->state, i, (fmu->asked[i] - now) / (t - fmu->life.t));
  }
}

int frot_fmu_ends_at(frot_fmu *fmu, double t) {
  if (fmu->in_between == NULL) return 0;
  fmu->life.phase = FROT_FMU_SHOWN;
  fmu->returned = fmu->caller(fmu, FROT_FMU_SHOW, t);
  fmu->life.phase = FROT_FMU_STEPPING;
  return fmu->returned;
}
