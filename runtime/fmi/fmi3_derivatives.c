/* FMI 3.0: derivatives of outputs and in a direction, and the intermediate update. */
#include "fmi3_instance.h"

static int one_each(const frot_fmu *fmu, const char *function, size_t references, size_t values) {
  if (references == values) return FROT_FMU_OK;
  return frot_fmu_refuse(fmu, function, "all variables are scalars: there is one number for each");
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                        size_t nUnknowns, const fmi3ValueReference knowns[],
                                        size_t nKnowns, const fmi3Float64 seed[], size_t nSeed,
                                        fmi3Float64 sensitivity[], size_t nSensitivity) {
  if (instance == NULL) return fmi3Error;
  int status = one_each(instance, __func__, nUnknowns, nSensitivity);
  if (status == FROT_FMU_OK) status = one_each(instance, __func__, nKnowns, nSeed);
  if (status == FROT_FMU_OK)
    status = frot_fmu_derive(instance, __func__, unknowns, nUnknowns, knowns, nKnowns, seed,
                             sensitivity);
  return (fmi3Status)status;
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance,
                                    const fmi3ValueReference valueReferences[],
                                    size_t nValueReferences, const fmi3Int32 orders[],
                                    fmi3Float64 values[], size_t nValues) {
  if (instance == NULL) return fmi3Error;
  int status = one_each(instance, __func__, nValueReferences, nValues);
  if (status == FROT_FMU_OK)
    status = frot_fmu_derive_outputs(instance, __func__, valueReferences, nValueReferences, orders,
                                     values);
  return (fmi3Status)status;
}

static int call_update(const frot_fmu *fmu, int call, double t) {
  const frot_fmi3 *instance = (const frot_fmi3 *)fmu;
  const fmi3Boolean shows = call == FROT_FMU_SHOW;
  const fmi3Boolean returns = instance->may_return_early && call != FROT_FMU_GIVE;
  fmi3Boolean ends = fmi3False;
  fmi3Float64 when = t;
  instance->update(fmu->environment, t, call == FROT_FMU_GIVE, shows, shows, returns, &ends, &when);
  return returns && ends;
}

int frot_fmi3_call_in_between(frot_fmi3 *instance, const char *function,
                              fmi3IntermediateUpdateCallback update,
                              const fmi3ValueReference *required, size_t count) {
  instance->update = update;
  /* without variables the environment is called only to end a step */
  const int called = update != NULL && (count > 0 || instance->may_return_early);
  return frot_fmu_call_in_between(&instance->fmu, function, called ? call_update : NULL, required,
                                  count);
}
