/* FMI 3.0: access to types that no variable of a model has. No values at all is no error. */
#include "fmi3_instance.h"

static fmi3Status no_such_type(const frot_fmu *fmu, const char *function, size_t count) {
  if (fmu == NULL) return fmi3Error;
  if (count == 0) return fmi3OK;
  return (fmi3Status)frot_fmu_refuse(fmu, function, "no variable is of this type");
}

#define REFUSED(name, type)                                                                   \
  fmi3Status fmi3Get##name(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                           size_t nValueReferences, type values[], size_t nValues) {          \
    (void)valueReferences;                                                                    \
    (void)values;                                                                             \
    (void)nValues;                                                                            \
    return no_such_type(instance, __func__, nValueReferences);                                \
  }                                                                                           \
  fmi3Status fmi3Set##name(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                           size_t nValueReferences, const type values[], size_t nValues) {    \
    (void)valueReferences;                                                                    \
    (void)values;                                                                             \
    (void)nValues;                                                                            \
    return no_such_type(instance, __func__, nValueReferences);                                \
  }

REFUSED(Float32, fmi3Float32)
REFUSED(Int8, fmi3Int8)
REFUSED(UInt8, fmi3UInt8)
REFUSED(Int16, fmi3Int16)
REFUSED(UInt16, fmi3UInt16)
REFUSED(UInt32, fmi3UInt32)
REFUSED(UInt64, fmi3UInt64)
REFUSED(String, fmi3String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, size_t valueSizes[], fmi3Binary values[],
                         size_t nValues) {
  (void)valueReferences;
  (void)valueSizes;
  (void)values;
  (void)nValues;
  return no_such_type(instance, __func__, nValueReferences);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, const size_t valueSizes[],
                         const fmi3Binary values[], size_t nValues) {
  (void)valueReferences;
  (void)valueSizes;
  (void)values;
  (void)nValues;
  return no_such_type(instance, __func__, nValueReferences);
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, fmi3Clock values[]) {
  (void)valueReferences;
  (void)values;
  return no_such_type(instance, __func__, nValueReferences);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, const fmi3Clock values[]) {
  (void)valueReferences;
  (void)values;
  return no_such_type(instance, __func__, nValueReferences);
}
