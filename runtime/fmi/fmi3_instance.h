/* An instance behind FMI 3.0. */
#ifndef FROT_FMI3_INSTANCE_H
#define FROT_FMI3_INSTANCE_H

#include "fmi3Functions.h"
#include "instance.h"

typedef struct {
  frot_fmu fmu; /* first: an fmi3Instance points to it */
  fmi3LogMessageCallback log;
  fmi3IntermediateUpdateCallback update;
  int may_return_early;
} frot_fmi3;

/* fmi3_derivatives.c: let steps call `update`, where the variables required are given and read.
 * The answer is a frot_fmu_status. */
int frot_fmi3_call_in_between(frot_fmi3 *instance, const char *function,
                              fmi3IntermediateUpdateCallback update,
                              const fmi3ValueReference *required, size_t count);

/* fmi3_elements.c: the variables behind references, of which some are arrays, in one of two lists
 * that is good until the next call for it. The answer is a frot_fmu_status. */
int frot_fmi3_elements(frot_fmu *fmu, const char *function, int list,
                       const fmi3ValueReference *references, size_t count,
                       const unsigned **elements, size_t *total);
/* The same where there is to be a value for each. */
int frot_fmi3_one_each(frot_fmu *fmu, const char *function, int list,
                       const fmi3ValueReference *references, size_t count, size_t n_values,
                       const unsigned **elements);

/* A draft that can log, for an instantiation that may fail. */
void frot_fmi3_draft(frot_fmi3 *draft, fmi3String name, fmi3InstanceEnvironment environment,
                     fmi3LogMessageCallback log);

#endif
