/* FMI 3.0: derivatives of outputs, in a direction and adjoint, and the intermediate update. */
#include <stdlib.h>

#include "fmi3_instance.h"

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                        size_t nUnknowns, const fmi3ValueReference knowns[],
                                        size_t nKnowns, const fmi3Float64 seed[], size_t nSeed,
                                        fmi3Float64 sensitivity[], size_t nSensitivity) {
  if (instance == NULL) return fmi3Error;
  const unsigned *of, *by;
  int status = frot_fmi3_one_each(instance, __func__, 0, unknowns, nUnknowns, nSensitivity, &of);
  if (status == FROT_FMU_OK)
    status = frot_fmi3_one_each(instance, __func__, 1, knowns, nKnowns, nSeed, &by);
  if (status == FROT_FMU_OK)
    status = frot_fmu_derive(instance, __func__, of, nSensitivity, by, nSeed, seed, sensitivity);
  return (fmi3Status)status;
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                    size_t nUnknowns, const fmi3ValueReference knowns[],
                                    size_t nKnowns, const fmi3Float64 seed[], size_t nSeed,
                                    fmi3Float64 sensitivity[], size_t nSensitivity) {
  if (instance == NULL) return fmi3Error;
  const unsigned *of, *by;
  int status = frot_fmi3_one_each(instance, __func__, 0, unknowns, nUnknowns, nSeed, &of);
  if (status == FROT_FMU_OK)
    status = frot_fmi3_one_each(instance, __func__, 1, knowns, nKnowns, nSensitivity, &by);
  if (status == FROT_FMU_OK)
    status =
        frot_fmu_derive_adjoint(instance, __func__, of, nSeed, by, nSensitivity, seed, sensitivity);
  return (fmi3Status)status;
}

/* The order of each reference is that of all its elements. */
static int order_elements(frot_fmu *fmu, const char *function, const fmi3ValueReference *references,
                          const fmi3Int32 *orders, size_t count, size_t total, const int **found,
                          int **made) {
  *made = NULL, *found = orders;
  if (total == count || orders == NULL) return FROT_FMU_OK;
  *made = frot_fmu_memory(total * sizeof(int)), *found = *made;
  if (*made == NULL) return frot_fmu_refuse(fmu, function, "there is not enough memory");
  for (size_t i = 0, at = 0; i < count; i++)
    for (int k = 0; k < (int)(frot_fmu_variables[references[i]].size); k++)
      (*made)[at++] = orders[i];
  return FROT_FMU_OK;
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance,
                                    const fmi3ValueReference valueReferences[],
                                    size_t nValueReferences, const fmi3Int32 orders[],
                                    fmi3Float64 values[], size_t nValues) {
  if (instance == NULL) return fmi3Error;
  const unsigned *references;
  const int *each = orders;
  int *made = NULL;
  int status = frot_fmi3_one_each(instance, __func__, 0, valueReferences, nValueReferences, nValues,
                                  &references);
  if (status == FROT_FMU_OK)
    status = order_elements(instance, __func__, valueReferences, orders, nValueReferences, nValues,
                            &each, &made);
  if (status == FROT_FMU_OK)
    status = frot_fmu_derive_outputs(instance, __func__, references, nValues, each, values);
  free(made);
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
  const unsigned *elements;
  size_t total;
  const int status =
      frot_fmi3_elements(&instance->fmu, function, 0, required, count, &elements, &total);
  if (status != FROT_FMU_OK) return status;
  return frot_fmu_call_in_between(&instance->fmu, function, called ? call_update : NULL, elements,
                                  total);
}
