/* FMI 3.0: model exchange; its event mode is in fmi3_events.c. */
#include "fmi3_instance.h"

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken,
                                          fmi3String resourcePath, fmi3Boolean visible,
                                          fmi3Boolean loggingOn,
                                          fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage) {
  frot_fmi3 draft;
  (void)resourcePath;
  (void)visible;
  frot_fmi3_draft(&draft, instanceName, instanceEnvironment, logMessage);
  if (!frot_fmu_exchange) {
    frot_fmu_refuse_exchange(&draft.fmu, __func__);
    return NULL;
  }
  draft.fmu.exchanges = 1;
  return frot_fmu_open(&draft.fmu, sizeof draft, __func__, instanceName, instantiationToken,
                       loggingOn);
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) {
  return instance == NULL ? fmi3Error : (fmi3Status)frot_fmu_enter_continuous(instance, __func__);
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance,
                                       fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi3Boolean *enterEventMode,
                                       fmi3Boolean *terminateSimulation) {
  int event;
  (void)noSetFMUStatePriorToCurrentPoint;
  if (instance == NULL) return fmi3Error;
  if (enterEventMode == NULL || terminateSimulation == NULL)
    return (fmi3Status)frot_fmu_refuse(instance, __func__, "a pointer to an answer is NULL");
  const int status = frot_fmu_complete_step(instance, __func__, &event);
  *enterEventMode = event != 0;
  *terminateSimulation = fmi3False;
  return (fmi3Status)status;
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time) {
  return instance == NULL ? fmi3Error : (fmi3Status)frot_fmu_set_time(instance, __func__, time);
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[],
                                   size_t nContinuousStates) {
  if (instance == NULL) return fmi3Error;
  return (fmi3Status)frot_fmu_set_states(instance, __func__, continuousStates, nContinuousStates);
}

static fmi3Status motion(fmi3Instance instance, const char *function, int what,
                         fmi3Float64 values[], size_t count) {
  if (instance == NULL) return fmi3Error;
  return (fmi3Status)frot_fmu_get_motion(instance, function, what, values, count);
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[],
                                             size_t nContinuousStates) {
  return motion(instance, __func__, FROT_FMU_RATE, derivatives, nContinuousStates);
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[],
                                  size_t nEventIndicators) {
  return motion(instance, __func__, FROT_FMU_GUARD, eventIndicators, nEventIndicators);
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[],
                                   size_t nContinuousStates) {
  return motion(instance, __func__, FROT_FMU_STATE, continuousStates, nContinuousStates);
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[],
                                             size_t nContinuousStates) {
  if (instance == NULL) return fmi3Error;
  return (fmi3Status)frot_fmu_get_nominals(instance, __func__, nominals, nContinuousStates);
}

static fmi3Status number(const frot_fmu *fmu, const char *function, int own, size_t *count) {
  if (!fmu->exchanges) return (fmi3Status)frot_fmu_refuse_exchange(fmu, function);
  if (count == NULL)
    return (fmi3Status)frot_fmu_refuse(fmu, function, "the pointer to the number is NULL");
  *count = (size_t)own;
  return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators) {
  const frot_fmu *fmu = instance;
  if (fmu == NULL) return fmi3Error;
  return number(fmu, __func__, frot_exchange_guards(fmu->model), nEventIndicators);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates) {
  const frot_fmu *fmu = instance;
  if (fmu == NULL) return fmi3Error;
  return number(fmu, __func__, frot_exchange_states(fmu->model), nContinuousStates);
}
