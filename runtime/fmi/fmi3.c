/* The FMI 3.0 face of a model for co-simulation; the functions it refuses are in fmi3_refused.c and
 * fmi3_refused_types.c. */
#include "fmi3_instance.h"

#include <string.h>

static void send(const frot_fmu *fmu, int status, const char *category, const char *message) {
  const frot_fmi3 *instance = (const frot_fmi3 *)fmu;
  instance->log(fmu->environment, (fmi3Status)status, category, message);
}

void frot_fmi3_draft(frot_fmi3 *draft, fmi3String name, fmi3InstanceEnvironment environment,
                     fmi3LogMessageCallback log) {
  memset(draft, 0, sizeof *draft);
  draft->log = log;
  draft->fmu.sink = log == NULL ? NULL : send;
  draft->fmu.name = name;
  draft->fmu.environment = environment;
  draft->fmu.categories = FROT_FMU_LOG_ALL;
}

const char *fmi3GetVersion(void) { return fmi3Version; }

fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
    fmi3Boolean visible, fmi3Boolean loggingOn, fmi3Boolean eventModeUsed,
    fmi3Boolean earlyReturnAllowed, const fmi3ValueReference requiredIntermediateVariables[],
    size_t nRequiredIntermediateVariables, fmi3InstanceEnvironment instanceEnvironment,
    fmi3LogMessageCallback logMessage, fmi3IntermediateUpdateCallback intermediateUpdate) {
  frot_fmi3 draft;
  (void)resourcePath;
  (void)visible;
  frot_fmi3_draft(&draft, instanceName, instanceEnvironment, logMessage);
  draft.may_return_early = earlyReturnAllowed;
  frot_fmu *fmu = frot_fmu_open(&draft.fmu, sizeof draft, __func__, instanceName,
                                instantiationToken, loggingOn);
  if (fmu == NULL) return NULL;
  int status =
      frot_fmi3_call_in_between((frot_fmi3 *)fmu, __func__, intermediateUpdate,
                                requiredIntermediateVariables, nRequiredIntermediateVariables);
  if (status == FROT_FMU_OK && eventModeUsed && !frot_fmu_watch_events(fmu, earlyReturnAllowed))
    status = frot_fmu_refuse(fmu, __func__, "there is not enough memory");
  if (status == FROT_FMU_OK) return fmu;
  frot_fmu_close(fmu);
  return NULL;
}

void fmi3FreeInstance(fmi3Instance instance) { frot_fmu_close(instance); }

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[]) {
  if (instance == NULL) return fmi3Error;
  return (fmi3Status)frot_fmu_set_logging(instance, __func__, loggingOn, nCategories, categories);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined,
                                       fmi3Float64 tolerance, fmi3Float64 startTime,
                                       fmi3Boolean stopTimeDefined, fmi3Float64 stopTime) {
  if (instance == NULL) return fmi3Error;
  const int status = frot_fmu_setup(instance, __func__, toleranceDefined, tolerance, startTime,
                                    stopTimeDefined, stopTime);
  if (status != FROT_FMU_OK) return (fmi3Status)status;
  return (fmi3Status)frot_fmu_enter_initialization(instance, __func__);
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  if (instance == NULL) return fmi3Error;
  return (fmi3Status)frot_fmu_exit_initialization(instance, __func__);
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
  return instance == NULL ? fmi3Error : (fmi3Status)frot_fmu_terminate(instance, __func__);
}

fmi3Status fmi3Reset(fmi3Instance instance) {
  return instance == NULL ? fmi3Error : (fmi3Status)frot_fmu_begin_anew(instance, __func__);
}

/* Defines fmi3Get<name> and fmi3Set<name> for values of `type` that stand for the types of `set`;
 * `from` makes a value from a number, `to` the reverse. */
#define ACCESS(name, type, set, from, to)                                                     \
  fmi3Status fmi3Get##name(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                           size_t nValueReferences, type values[], size_t nValues) {          \
    if (instance == NULL) return fmi3Error;                                                   \
    const unsigned *references;                                                               \
    int status = frot_fmi3_one_each(instance, __func__, 0, valueReferences, nValueReferences, \
                                    nValues, &references);                                    \
    if (status == FROT_FMU_OK)                                                                \
      status = frot_fmu_arrays(instance, __func__, references, values, nValues);              \
    for (size_t i = 0; i < nValues && status == FROT_FMU_OK; i++) {                           \
      double x = 0.0;                                                                         \
      status = frot_fmu_get(instance, __func__, references[i], set, &x);                      \
      if (status == FROT_FMU_OK) values[i] = from(x);                                         \
    }                                                                                         \
    return (fmi3Status)status;                                                                \
  }                                                                                           \
  fmi3Status fmi3Set##name(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                           size_t nValueReferences, const type values[], size_t nValues) {    \
    if (instance == NULL) return fmi3Error;                                                   \
    const unsigned *references;                                                               \
    int status = frot_fmi3_one_each(instance, __func__, 0, valueReferences, nValueReferences, \
                                    nValues, &references);                                    \
    if (status == FROT_FMU_OK)                                                                \
      status = frot_fmu_arrays(instance, __func__, references, values, nValues);              \
    for (size_t i = 0; i < nValues && status == FROT_FMU_OK; i++)                             \
      status = frot_fmu_settable(instance, __func__, references[i], set, to(values[i]));      \
    for (size_t i = 0; i < nValues && status == FROT_FMU_OK; i++)                             \
      frot_fmu_set(instance, references[i], to(values[i]));                                   \
    return (fmi3Status)status;                                                                \
  }

#define SAME(x) (x)
#define TO_INT32(x) ((fmi3Int32)(x))
#define TO_INT64(x) ((fmi3Int64)(x))
#define FROM_INTEGER(i) ((double)(i))
#define TO_BOOLEAN(x) ((x) != 0.0)
#define FROM_BOOLEAN(b) ((b) ? 1.0 : 0.0)

ACCESS(Float64, fmi3Float64, FROT_FMU_TYPE(FROT_REAL), SAME, SAME)
ACCESS(Int32, fmi3Int32, FROT_FMU_TYPE(FROT_INTEGER), TO_INT32, FROM_INTEGER)
/* FMI 3.0 accesses enumerations as 64-bit integers. */
ACCESS(Int64, fmi3Int64, FROT_FMU_TYPE(FROT_MODE), TO_INT64, FROM_INTEGER)
ACCESS(Boolean, fmi3Boolean, FROT_FMU_TYPE(FROT_BOOLEAN), TO_BOOLEAN, FROM_BOOLEAN)

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
  return instance == NULL ? fmi3Error : (fmi3Status)frot_fmu_save(instance, __func__, FMUState);
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState) {
  return instance == NULL ? fmi3Error : (fmi3Status)frot_fmu_restore(instance, __func__, FMUState);
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
  return instance == NULL ? fmi3Error : (fmi3Status)frot_fmu_drop(instance, __func__, FMUState);
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size) {
  if (instance == NULL) return fmi3Error;
  return (fmi3Status)frot_fmu_serialized_size(instance, __func__, FMUState, size);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState,
                                 fmi3Byte serializedState[], size_t size) {
  if (instance == NULL) return fmi3Error;
  return (fmi3Status)frot_fmu_serialize(instance, __func__, FMUState, serializedState, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[],
                                   size_t size, fmi3FMUState *FMUState) {
  if (instance == NULL) return fmi3Error;
  return (fmi3Status)frot_fmu_deserialize(instance, __func__, serializedState, size, FMUState);
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint,
                      fmi3Float64 communicationStepSize,
                      fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                      fmi3Boolean *eventHandlingNeeded, fmi3Boolean *terminateSimulation,
                      fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime) {
  frot_fmu *fmu = instance;
  (void)noSetFMUStatePriorToCurrentPoint;
  if (eventHandlingNeeded != NULL) *eventHandlingNeeded = fmi3False;
  if (terminateSimulation != NULL) *terminateSimulation = fmi3False;
  if (earlyReturn != NULL) *earlyReturn = fmi3False;
  if (lastSuccessfulTime != NULL) *lastSuccessfulTime = fmu == NULL ? 0.0 : fmu->life.t;
  if (fmu == NULL) return fmi3Error;
  if (eventHandlingNeeded == NULL || terminateSimulation == NULL || earlyReturn == NULL ||
      lastSuccessfulTime == NULL)
    return (fmi3Status)frot_fmu_refuse(fmu, __func__, "a pointer to an answer is NULL");
  int status = frot_fmu_step(fmu, __func__, currentCommunicationPoint, communicationStepSize);
  /* The motion cannot go on, with any step. */
  *terminateSimulation = fmu->life.phase == FROT_FMU_DISCARDED;
  *lastSuccessfulTime = fmu->life.t;
  *eventHandlingNeeded = fmu->event != 0;
  if (status == FROT_FMU_OK && (fmu->event || fmu->returned))
    *earlyReturn = fmu->life.t < currentCommunicationPoint + communicationStepSize;
  if (fmu->life.phase == FROT_FMU_ENDED) {
    /* The text has ended the run, which is no fault; the environment may not want to know where. */
    status = FROT_FMU_OK;
    *terminateSimulation = fmi3True;
    *earlyReturn = ((const frot_fmi3 *)instance)->may_return_early &&
                   fmu->life.t < currentCommunicationPoint + communicationStepSize;
  }
  return (fmi3Status)status;
}
