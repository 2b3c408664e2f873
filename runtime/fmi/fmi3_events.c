/* The event mode of FMI 3.0 in co-simulation. */
#include <math.h>

#include "fmi3_instance.h"

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
  if (instance == NULL) return fmi3Error;
  return (fmi3Status)frot_fmu_enter_event_mode(instance, __func__);
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
  const int status = frot_fmu_update_discrete(fmu, __func__);
  const double next = frot_next_instant(fmu->state);
  *discreteStatesNeedUpdate = fmi3False;
  *terminateSimulation = fmu->life.phase == FROT_FMU_ENDED;
  *nominalsOfContinuousStatesChanged = fmi3False;
  *valuesOfContinuousStatesChanged = fmi3False;
  *nextEventTimeDefined = isfinite(next);
  *nextEventTime = isfinite(next) ? next : 0.0;
  return (fmi3Status)status;
}
