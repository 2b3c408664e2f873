/* The functions of FMI 2.0 that belong to abilities the description does not declare. */
#include "fmi2_instance.h"

static fmi2Status refuse(const frot_fmu *fmu, const char *function, const char *reason) {
  return fmu == NULL ? fmi2Error : (fmi2Status)frot_fmu_refuse(fmu, function, reason);
}

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
