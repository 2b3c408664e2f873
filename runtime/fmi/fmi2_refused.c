/* The functions of FMI 2.0 that belong to abilities the description does not declare. */
#include "fmi2_instance.h"

static fmi2Status refuse(const frot_fmu *fmu, const char *function, const char *reason) {
  return fmu == NULL ? fmi2Error : (fmi2Status)frot_fmu_refuse(fmu, function, reason);
}

#define NOT_EXCHANGE "model exchange is not offered, only co-simulation"
#define NOT_PENDING "steps are never pending"

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                         fmi2String value[]) {
  (void)vr;
  (void)value;
  if (c != NULL && nvr == 0) return fmi2OK;
  return refuse(c, __func__, "no variable is a string");
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                         const fmi2String value[]) {
  (void)vr;
  (void)value;
  if (c != NULL && nvr == 0) return fmi2OK;
  return refuse(c, __func__, "no variable is a string");
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[],
                                        size_t nUnknown, const fmi2ValueReference vKnown_ref[],
                                        size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[]) {
  (void)vUnknown_ref;
  (void)nUnknown;
  (void)vKnown_ref;
  (void)nKnown;
  (void)dvKnown;
  (void)dvUnknown;
  return refuse(c, __func__, "directional derivatives are not offered");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[]) {
  (void)vr;
  (void)order;
  (void)value;
  if (c != NULL && nvr == 0) return fmi2OK;
  return refuse(c, __func__, "inputs are constant over a step");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[]) {
  (void)vr;
  (void)order;
  (void)value;
  if (c != NULL && nvr == 0) return fmi2OK;
  return refuse(c, __func__, "derivatives of outputs are not offered");
}

fmi2Status fmi2CancelStep(fmi2Component c) { return refuse(c, __func__, NOT_PENDING); }

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value) {
  (void)s;
  (void)value;
  return refuse(c, __func__, NOT_PENDING);
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s, fmi2Integer *value) {
  (void)s;
  (void)value;
  return refuse(c, __func__, "no status is an integer");
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s, fmi2String *value) {
  (void)s;
  (void)value;
  return refuse(c, __func__, NOT_PENDING);
}

fmi2Status fmi2EnterEventMode(fmi2Component c) { return refuse(c, __func__, NOT_EXCHANGE); }

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *fmi2eventInfo) {
  (void)fmi2eventInfo;
  return refuse(c, __func__, NOT_EXCHANGE);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
  return refuse(c, __func__, NOT_EXCHANGE);
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c,
                                       fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode,
                                       fmi2Boolean *terminateSimulation) {
  (void)noSetFMUStatePriorToCurrentPoint;
  (void)enterEventMode;
  (void)terminateSimulation;
  return refuse(c, __func__, NOT_EXCHANGE);
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) {
  (void)time;
  return refuse(c, __func__, NOT_EXCHANGE);
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx) {
  (void)x;
  (void)nx;
  return refuse(c, __func__, NOT_EXCHANGE);
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx) {
  (void)derivatives;
  (void)nx;
  return refuse(c, __func__, NOT_EXCHANGE);
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real eventIndicators[], size_t ni) {
  (void)eventIndicators;
  (void)ni;
  return refuse(c, __func__, NOT_EXCHANGE);
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx) {
  (void)x;
  (void)nx;
  return refuse(c, __func__, NOT_EXCHANGE);
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[], size_t nx) {
  (void)x_nominal;
  (void)nx;
  return refuse(c, __func__, NOT_EXCHANGE);
}
