/* The event mode of FMI 3.0. */
#include <math.h>

#include "fmi3_instance.h"

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
  if (instance == NULL) return fmi3Error;
  return (fmi3Status)(((const frot_fmu *)instance)->exchanges
                          ? frot_fmu_enter_exchange_event(instance, __func__)
                          : frot_fmu_enter_event_mode(instance, __func__));
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
  if (instance == NULL) return fmi3Error;
  return (fmi3Status)frot_fmu_enter_step_mode(instance, __func__);
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
  if (instance == NULL) return fmi3Error;
  return (fmi3Status)frot_fmu_update_discrete(instance, __func__);
}

/* What was set takes effect at once, with all that follows from it: a second call finds nothing. */
fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation,
                                    fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged,
                                    fmi3Boolean *nextEventTimeDefined, fmi3Float64 *nextEventTime) {
  frot_fmu *fmu = instance;
  if (fmu == NULL) return fmi3Error;
  if (discreteStatesNeedUpdate == NULL || terminateSimulation == NULL ||
      nominalsOfContinuousStatesChanged == NULL || valuesOfContinuousStatesChanged == NULL ||
      nextEventTimeDefined == NULL || nextEventTime == NULL)
    return (fmi3Status)frot_fmu_refuse(fmu, __func__, "a pointer to an answer is NULL");
  int moved = 0;
  const int status = fmu->exchanges ? frot_fmu_exchange_update(fmu, __func__, &moved)
                                    : frot_fmu_update_discrete(fmu, __func__);
  const double next = frot_next_instant(fmu->state);
  *discreteStatesNeedUpdate = fmi3False;
  *terminateSimulation = fmu->life.phase == FROT_FMU_ENDED;
  *nominalsOfContinuousStatesChanged = fmi3False;
  *valuesOfContinuousStatesChanged = moved != 0;
  *nextEventTimeDefined = isfinite(next);
  *nextEventTime = isfinite(next) ? next : 0.0;
  return (fmi3Status)status;
}
