/* FMI 2.0: model exchange. */
#include <math.h>

#include "fmi2_instance.h"

fmi2Status fmi2EnterEventMode(fmi2Component c) {
  return c == NULL ? fmi2Error : (fmi2Status)frot_fmu_enter_exchange_event(c, __func__);
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *fmi2eventInfo) {
  const frot_fmu *fmu = c;
  int moved;
  if (c == NULL) return fmi2Error;
  if (fmi2eventInfo == NULL)
    return (fmi2Status)frot_fmu_refuse(fmu, __func__, "the pointer to the answer is NULL");
  const int status = frot_fmu_exchange_update(c, __func__, &moved);
  const double next = frot_next_instant(fmu->state);
  fmi2eventInfo->newDiscreteStatesNeeded = fmi2False;
  fmi2eventInfo->terminateSimulation = fmu->life.phase == FROT_FMU_ENDED ? fmi2True : fmi2False;
  fmi2eventInfo->nominalsOfContinuousStatesChanged = fmi2False;
  fmi2eventInfo->valuesOfContinuousStatesChanged = moved ? fmi2True : fmi2False;
  fmi2eventInfo->nextEventTimeDefined = isfinite(next) ? fmi2True : fmi2False;
  fmi2eventInfo->nextEventTime = isfinite(next) ? next : 0.0;
  return (fmi2Status)status;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
  return c == NULL ? fmi2Error : (fmi2Status)frot_fmu_enter_continuous(c, __func__);
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c,
                                       fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode,
                                       fmi2Boolean *terminateSimulation) {
  int event;
  (void)noSetFMUStatePriorToCurrentPoint;
  if (c == NULL) return fmi2Error;
  if (enterEventMode == NULL || terminateSimulation == NULL)
    return (fmi2Status)frot_fmu_refuse(c, __func__, "a pointer to an answer is NULL");
  const int status = frot_fmu_complete_step(c, __func__, &event);
  *enterEventMode = event ? fmi2True : fmi2False;
  *terminateSimulation = fmi2False;
  return (fmi2Status)status;
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) {
  return c == NULL ? fmi2Error : (fmi2Status)frot_fmu_set_time(c, __func__, time);
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx) {
  return c == NULL ? fmi2Error : (fmi2Status)frot_fmu_set_states(c, __func__, x, nx);
}

static fmi2Status motion(fmi2Component c, const char *function, int what, fmi2Real values[],
                         size_t count) {
  return c == NULL ? fmi2Error : (fmi2Status)frot_fmu_get_motion(c, function, what, values, count);
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx) {
  return motion(c, __func__, FROT_FMU_RATE, derivatives, nx);
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real eventIndicators[], size_t ni) {
  return motion(c, __func__, FROT_FMU_GUARD, eventIndicators, ni);
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx) {
  return motion(c, __func__, FROT_FMU_STATE, x, nx);
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[], size_t nx) {
  return c == NULL ? fmi2Error : (fmi2Status)frot_fmu_get_nominals(c, __func__, x_nominal, nx);
}
