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
