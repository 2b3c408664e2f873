/* FMI 2.0: derivatives of inputs and outputs, and in a direction. */
#include "fmi2_instance.h"

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[],
                                        size_t nUnknown, const fmi2ValueReference vKnown_ref[],
                                        size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[]) {
  if (c == NULL) return fmi2Error;
  return (fmi2Status)frot_fmu_derive(c, __func__, vUnknown_ref, nUnknown, vKnown_ref, nKnown,
                                     dvKnown, dvUnknown);
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[]) {
  if (c == NULL) return fmi2Error;
  return (fmi2Status)frot_fmu_set_input_rates(c, __func__, vr, nvr, order, value);
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[]) {
  if (c == NULL) return fmi2Error;
  return (fmi2Status)frot_fmu_derive_outputs(c, __func__, vr, nvr, order, value);
}
