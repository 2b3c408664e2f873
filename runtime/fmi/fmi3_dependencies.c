/* FMI 3.0: what each element of an output or a rate depends on, of archives with arrays. */
#include "fmi3_instance.h"

/* The variable that the element with this reference lies in. */
static unsigned variable_of(unsigned reference) {
  while (frot_fmu_variables[reference].size == 0) reference--;
  return reference;
}

/* Whether the row of the table is of an element of this variable. */
static int is_of(const frot_fmu_dependency *row, fmi3ValueReference variable) {
  return variable_of(row->dependent) == variable;
}

static int check(const frot_fmu *fmu, const char *function, fmi3ValueReference variable) {
  if (!frot_fmu_lists_dependencies)
    return frot_fmu_refuse(fmu, function,
                           "dependencies of elements are not offered, only those of variables");
  if (variable >= frot_fmu_variable_count || frot_fmu_variables[variable].size == 0)
    return frot_fmu_refuse(fmu, function, "the value reference is that of no variable");
  for (unsigned i = 0; i < frot_fmu_dependency_count; i++)
    if (is_of(&frot_fmu_dependencies[i], variable) &&
        frot_fmu_dependencies[i].independent == FROT_FMU_ANY)
      return frot_fmu_refuse(fmu, function, "an element may depend on any: none are listed");
  return FROT_FMU_OK;
}

static size_t count_of(fmi3ValueReference variable) {
  size_t count = 0;
  for (unsigned i = 0; i < frot_fmu_dependency_count; i++)
    count += is_of(&frot_fmu_dependencies[i], variable) != 0;
  return count;
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance,
                                               fmi3ValueReference valueReference,
                                               size_t *nDependencies) {
  if (instance == NULL) return fmi3Error;
  const int status = check(instance, __func__, valueReference);
  if (status != FROT_FMU_OK) return (fmi3Status)status;
  if (nDependencies == NULL)
    return (fmi3Status)frot_fmu_refuse(instance, __func__, "the pointer to the answer is NULL");
  *nDependencies = count_of(valueReference);
  return fmi3OK;
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                       size_t elementIndicesOfDependent[],
                                       fmi3ValueReference independents[],
                                       size_t elementIndicesOfIndependents[],
                                       fmi3DependencyKind dependencyKinds[], size_t nDependencies) {
  if (instance == NULL) return fmi3Error;
  const int status = check(instance, __func__, dependent);
  if (status != FROT_FMU_OK) return (fmi3Status)status;
  const size_t own = count_of(dependent);
  if (nDependencies != own)
    return (fmi3Status)frot_fmu_say(instance, FROT_FMU_ERROR,
                                    "%s: there are %lu dependencies, not %lu.", __func__,
                                    (unsigned long)own, (unsigned long)nDependencies);
  if (own > 0 && (elementIndicesOfDependent == NULL || independents == NULL ||
                  elementIndicesOfIndependents == NULL || dependencyKinds == NULL))
    return (fmi3Status)frot_fmu_refuse(instance, __func__, "a pointer to an answer is NULL");
  size_t at = 0;
  for (unsigned i = 0; i < frot_fmu_dependency_count; i++) {
    const frot_fmu_dependency *row = &frot_fmu_dependencies[i];
    if (!is_of(row, dependent)) continue;
    elementIndicesOfDependent[at] = row->dependent - dependent + 1;
    independents[at] = variable_of(row->independent);
    elementIndicesOfIndependents[at] = row->independent - independents[at] + 1;
    dependencyKinds[at++] = fmi3Dependent;
  }
  return fmi3OK;
}
