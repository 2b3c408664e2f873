/* FMI 3.0: arrays. The value reference of one stands for all its elements, which lie behind it in
 * the table of variables, row by row. */
#include <stdlib.h>

#include "fmi3_instance.h"

/* The number of elements behind a reference; one that there is not is refused when it is used. */
static size_t size_of(fmi3ValueReference reference) {
  return reference < frot_fmu_variable_count ? (size_t)frot_fmu_variables[reference].size : 1;
}

static int count_elements(const frot_fmu *fmu, const char *function,
                          const fmi3ValueReference *references, size_t count, size_t *total) {
  *total = 0;
  if (count > 0 && references == NULL)
    return frot_fmu_refuse(fmu, function, "the value references are NULL");
  for (size_t i = 0; i < count; i++) {
    const size_t size = size_of(references[i]);
    if (size == 0)
      return frot_fmu_say(fmu, FROT_FMU_ERROR,
                          "%s: value reference %u is none: '%s' is an element of an array.",
                          function, references[i], frot_fmu_variables[references[i]].name);
    *total += size;
  }
  return FROT_FMU_OK;
}

static int expand(frot_fmu *fmu, const char *function, const fmi3ValueReference *references,
                  size_t count, size_t total, int list) {
  if (fmu->elements_room[list] < total) {
    free(fmu->elements[list]);
    fmu->elements[list] = frot_fmu_memory(total * sizeof(unsigned));
    fmu->elements_room[list] = fmu->elements[list] == NULL ? 0 : total;
  }
  if (fmu->elements[list] == NULL)
    return frot_fmu_refuse(fmu, function, "there is not enough memory");
  for (size_t i = 0, at = 0; i < count; i++)
    for (size_t k = 0; k < size_of(references[i]); k++)
      fmu->elements[list][at++] = references[i] + (unsigned)k;
  return FROT_FMU_OK;
}

int frot_fmi3_elements(frot_fmu *fmu, const char *function, int list,
                       const fmi3ValueReference *references, size_t count,
                       const unsigned **elements, size_t *total) {
  int status = count_elements(fmu, function, references, count, total);
  *elements = references;
  if (status != FROT_FMU_OK || *total == count) return status;
  status = expand(fmu, function, references, count, *total, list);
  *elements = fmu->elements[list];
  return status;
}

int frot_fmi3_one_each(frot_fmu *fmu, const char *function, int list,
                       const fmi3ValueReference *references, size_t count, size_t n_values,
                       const unsigned **elements) {
  size_t total;
  const int status = frot_fmi3_elements(fmu, function, list, references, count, elements, &total);
  if (status != FROT_FMU_OK || total == n_values) return status;
  return frot_fmu_say(fmu, FROT_FMU_ERROR,
                      "%s: there are %lu values, and %lu numbers behind the value references.",
                      function, (unsigned long)n_values, (unsigned long)total);
}
