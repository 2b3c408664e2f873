/* The FMI 2.0 face of a model for co-simulation; the functions it refuses are in fmi2_refused.c. */
#include "fmi2_instance.h"

#include <string.h>

static void send(const frot_fmu *fmu, int status, const char *category, const char *message) {
  const frot_fmi2 *instance = (const frot_fmi2 *)fmu;
  const char *name = fmu->name == NULL ? "" : fmu->name;
  /* The environment formats like printf: the message must not be the format. */
  instance->logger(fmu->environment, name, (fmi2Status)status, category, "%s", message);
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return fmi2Version; }

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID,
                              fmi2String fmuResourceLocation,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean loggingOn) {
  frot_fmi2 draft;
  (void)fmuResourceLocation;
  (void)visible;
  if (functions == NULL) return NULL;
  memset(&draft, 0, sizeof draft);
  draft.logger = functions->logger;
  draft.fmu.sink = functions->logger == NULL ? NULL : send;
  draft.fmu.name = instanceName;
  draft.fmu.environment = functions->componentEnvironment;
  draft.fmu.categories = FROT_FMU_LOG_ALL;
  draft.fmu.exchanges = fmuType == fmi2ModelExchange;
  if (fmuType != fmi2CoSimulation && !(draft.fmu.exchanges && frot_fmu_exchange)) {
    frot_fmu_refuse(&draft.fmu, __func__, "this model is for co-simulation only");
    return NULL;
  }
  return frot_fmu_open(&draft.fmu, sizeof draft, __func__, instanceName, fmuGUID, loggingOn);
}

void fmi2FreeInstance(fmi2Component c) { frot_fmu_close(c); }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[]) {
  if (c == NULL) return fmi2Error;
  return (fmi2Status)frot_fmu_set_logging(c, __func__, loggingOn, nCategories, categories);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance,
                               fmi2Real startTime, fmi2Boolean stopTimeDefined, fmi2Real stopTime) {
  if (c == NULL) return fmi2Error;
  return (fmi2Status)frot_fmu_setup(c, __func__, toleranceDefined, tolerance, startTime,
                                    stopTimeDefined, stopTime);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return c == NULL ? fmi2Error : (fmi2Status)frot_fmu_enter_initialization(c, __func__);
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return c == NULL ? fmi2Error : (fmi2Status)frot_fmu_exit_initialization(c, __func__);
}

fmi2Status fmi2Terminate(fmi2Component c) {
  return c == NULL ? fmi2Error : (fmi2Status)frot_fmu_terminate(c, __func__);
}

fmi2Status fmi2Reset(fmi2Component c) {
  return c == NULL ? fmi2Error : (fmi2Status)frot_fmu_begin_anew(c, __func__);
}

/* Defines fmi2Get<name> and fmi2Set<name> for values of `type` that stand for the types of `set`;
 * `from` makes a value from a number, `to` the reverse. */
#define ACCESS(name, type, set, from, to)                                              \
  fmi2Status fmi2Get##name(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, \
                           type value[]) {                                             \
    if (c == NULL) return fmi2Error;                                                   \
    int status = frot_fmu_arrays(c, __func__, vr, value, nvr);                         \
    for (size_t i = 0; i < nvr && status == FROT_FMU_OK; i++) {                        \
      double x = 0.0;                                                                  \
      status = frot_fmu_get(c, __func__, vr[i], set, &x);                              \
      if (status == FROT_FMU_OK) value[i] = from(x);                                   \
    }                                                                                  \
    return (fmi2Status)status;                                                         \
  }                                                                                    \
  fmi2Status fmi2Set##name(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, \
                           const type value[]) {                                       \
    if (c == NULL) return fmi2Error;                                                   \
    int status = frot_fmu_arrays(c, __func__, vr, value, nvr);                         \
    for (size_t i = 0; i < nvr && status == FROT_FMU_OK; i++)                          \
      status = frot_fmu_settable(c, __func__, vr[i], set, to(value[i]));               \
    for (size_t i = 0; i < nvr && status == FROT_FMU_OK; i++)                          \
      frot_fmu_set(c, vr[i], to(value[i]));                                            \
    return (fmi2Status)status;                                                         \
  }

#define SAME(x) (x)
#define TO_INTEGER(x) ((fmi2Integer)(x))
#define FROM_INTEGER(i) ((double)(i))
#define TO_BOOLEAN(x) ((x) != 0.0 ? fmi2True : fmi2False)
#define FROM_BOOLEAN(b) ((b) != 0 ? 1.0 : 0.0)

ACCESS(Real, fmi2Real, FROT_FMU_TYPE(FROT_REAL), SAME, SAME)
ACCESS(Integer, fmi2Integer, FROT_FMU_TYPE(FROT_INTEGER) | FROT_FMU_TYPE(FROT_MODE), TO_INTEGER,
       FROM_INTEGER)
ACCESS(Boolean, fmi2Boolean, FROT_FMU_TYPE(FROT_BOOLEAN), TO_BOOLEAN, FROM_BOOLEAN)

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
  return c == NULL ? fmi2Error : (fmi2Status)frot_fmu_save(c, __func__, FMUstate);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate) {
  return c == NULL ? fmi2Error : (fmi2Status)frot_fmu_restore(c, __func__, FMUstate);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
  return c == NULL ? fmi2Error : (fmi2Status)frot_fmu_drop(c, __func__, FMUstate);
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size) {
  return c == NULL ? fmi2Error : (fmi2Status)frot_fmu_serialized_size(c, __func__, FMUstate, size);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte serializedState[],
                                 size_t size) {
  if (c == NULL) return fmi2Error;
  return (fmi2Status)frot_fmu_serialize(c, __func__, FMUstate, serializedState, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[], size_t size,
                                   fmi2FMUstate *FMUstate) {
  if (c == NULL) return fmi2Error;
  return (fmi2Status)frot_fmu_deserialize(c, __func__, serializedState, size, FMUstate);
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint,
                      fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint) {
  (void)noSetFMUStatePriorToCurrentPoint;
  if (c == NULL) return fmi2Error;
  return (fmi2Status)frot_fmu_step(c, __func__, currentCommunicationPoint, communicationStepSize);
}

/* What can be asked of a step that is over; nothing is ever pending. */
static int askable(const frot_fmu *fmu, const char *function, const void *value) {
  if (value == NULL) return frot_fmu_refuse(fmu, function, "the pointer to the value is NULL");
  if (fmu->life.phase < FROT_FMU_STEPPING) return frot_fmu_misplaced(fmu, function);
  return FROT_FMU_OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value) {
  const frot_fmu *fmu = c;
  if (c == NULL || askable(fmu, __func__, value) != FROT_FMU_OK) return fmi2Error;
  if (s != fmi2LastSuccessfulTime)
    return (fmi2Status)frot_fmu_refuse(fmu, __func__, "only the last successful time is a number");
  *value = fmu->life.t;
  return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean *value) {
  const frot_fmu *fmu = c;
  if (c == NULL || askable(fmu, __func__, value) != FROT_FMU_OK) return fmi2Error;
  if (s != fmi2Terminated)
    return (fmi2Status)frot_fmu_refuse(fmu, __func__, "only 'terminated' is true or false");
  *value = fmu->life.phase == FROT_FMU_DISCARDED || fmu->life.phase == FROT_FMU_ENDED ? fmi2True
                                                                                      : fmi2False;
  return fmi2OK;
}
