/* Reading and setting values by reference. */
#include "instance.h"

#include <math.h>
#include <stdint.h>

static const char *type_name(int types) {
  if (types & FROT_FMU_TYPE(FROT_REAL)) return "real number";
  if (types & FROT_FMU_TYPE(FROT_BOOLEAN)) return "boolean";
  if (types & FROT_FMU_TYPE(FROT_INTEGER)) return "integer";
  if (types & FROT_FMU_TYPE(FROT_MODE)) return "value of an enumeration";
  return "value of this type";
}

int frot_fmu_arrays(const frot_fmu *fmu, const char *function, const unsigned *references,
                    const void *values, size_t count) {
  if (count == 0 || (references != NULL && values != NULL)) return FROT_FMU_OK;
  return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: the value references or the values are NULL.",
                      function);
}

static const frot_fmu_variable *find(const frot_fmu *fmu, const char *function, unsigned reference,
                                     int types) {
  if (reference >= frot_fmu_variable_count) {
    frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: there is no value reference %u.", function, reference);
    return NULL;
  }
  if (!(types & FROT_FMU_TYPE(frot_fmu_variables[reference].type))) {
    frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: '%s' (value reference %u) is not a %s.", function,
                 frot_fmu_variables[reference].name, reference, type_name(types));
    return NULL;
  }
  return &frot_fmu_variables[reference];
}

/* A state, a rate or a guard by its number after the variables. */
static double motion_value(const frot_fmu *fmu, int role, int index) {
  const int states = frot_exchange_states(fmu->model);
  if (role == FROT_FMU_STATE) return fmu->states[index];
  return role == FROT_FMU_RATE ? fmu->rates[index - states] : fmu->guards[index - 2 * states];
}

int frot_fmu_get(frot_fmu *fmu, const char *function, unsigned reference, int types,
                 double *value) {
  const frot_model *model = fmu->model;
  const frot_fmu_variable *variable = find(fmu, function, reference, types);
  if (variable == NULL) return FROT_FMU_ERROR;
  if (fmu->life.phase == FROT_FMU_SHOWN ? !fmu->in_between[reference] : frot_fmu_is_called(fmu))
    return frot_fmu_misplaced(fmu, function);
  const int status = frot_fmu_ready(fmu, function, variable->role);
  if (status != FROT_FMU_OK) return status;
  const int index = (int)reference - 1;
  switch (variable->role) {
    case FROT_FMU_TIME:
      *value = fmu->life.t;
      break;
    case FROT_FMU_PARAMETER:
    case FROT_FMU_DEPENDENT:
      *value = frot_get_parameter(model, fmu->state, index);
      break;
    case FROT_FMU_INPUT:
      *value = frot_get_input(model, fmu->state, index - model->np);
      break;
    case FROT_FMU_VARIABLE:
      *value = fmu->values[index - model->np - model->nu];
      break;
    default:
      *value =
          motion_value(fmu, variable->role, index - model->np - model->nu - model->n_variables);
      break;
  }
  if (variable->type == FROT_INTEGER && !(fabs(*value) <= INT32_MAX))
    return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: the whole number '%s' has more than 32 bits.",
                        function, variable->name);
  return FROT_FMU_OK;
}

int frot_fmu_settable(const frot_fmu *fmu, const char *function, unsigned reference, int types,
                      double value) {
  switch (fmu->life.phase) {
    case FROT_FMU_INSTANTIATED:
    case FROT_FMU_INITIALIZATION:
    case FROT_FMU_STEPPING:
    case FROT_FMU_EVENT:
    case FROT_FMU_CONTINUOUS:
    case FROT_FMU_ASKED:
      break;
    default:
      if (!fmu->life.refused) return frot_fmu_misplaced(fmu, function);
  }
  const frot_fmu_variable *variable = find(fmu, function, reference, types);
  if (variable == NULL) return FROT_FMU_ERROR;
  if (variable->role != FROT_FMU_PARAMETER && variable->role != FROT_FMU_INPUT)
    return frot_fmu_say(fmu, FROT_FMU_ERROR,
                        "%s: '%s' cannot be set: it is neither a parameter nor an input.", function,
                        variable->name);
  if (fmu->life.phase == FROT_FMU_ASKED &&
      (variable->role != FROT_FMU_INPUT || variable->type != FROT_REAL ||
       !fmu->in_between[reference]))
    return frot_fmu_say(
        fmu, FROT_FMU_ERROR,
        "%s: '%s' cannot be set in an intermediate update: it is no real input that "
        "was required for it.",
        function, variable->name);
  if (fmu->life.phase == FROT_FMU_CONTINUOUS &&
      (variable->role != FROT_FMU_INPUT || variable->type != FROT_REAL))
    return frot_fmu_say(fmu, FROT_FMU_ERROR,
                        "%s: '%s' cannot be set in continuous-time mode, only in event mode.",
                        function, variable->name);
  if (variable->fixed && fmu->life.phase != FROT_FMU_INSTANTIATED &&
      fmu->life.phase != FROT_FMU_INITIALIZATION)
    return frot_fmu_say(fmu, FROT_FMU_ERROR,
                        "%s: '%s' cannot be set now: it acts at the start alone.", function,
                        variable->name);
  if (variable->literals > 0 && !(value >= 1.0 && value <= variable->literals))
    return frot_fmu_say(fmu, FROT_FMU_ERROR,
                        "%s: '%s' has no value %.0f, only the whole numbers from 1 to %d.",
                        function, variable->name, value, variable->literals);
  if (!isfinite(value))
    return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: the value for '%s' is not a finite number.",
                        function, variable->name);
  return FROT_FMU_OK;
}

void frot_fmu_set(frot_fmu *fmu, unsigned reference, double value) {
  const int index = (int)reference - 1;
  if (fmu->life.phase == FROT_FMU_ASKED) {
    frot_fmu_give(fmu, reference, value);
    return;
  }
  frot_fmu_note_change(fmu);
  if (frot_fmu_variables[reference].role == FROT_FMU_INPUT)
    frot_set_input(fmu->model, fmu->state, index - fmu->model->np, value);
  else
    frot_set_parameter(fmu->model, fmu->state, index, value);
  fmu->life.started = 0;
  fmu->values_valid = fmu->motion_valid = 0;
}
