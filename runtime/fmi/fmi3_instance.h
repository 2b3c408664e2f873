/* An instance behind FMI 3.0. */
#ifndef FROT_FMI3_INSTANCE_H
#define FROT_FMI3_INSTANCE_H

#include "fmi3Functions.h"
#include "instance.h"

typedef struct {
  frot_fmu fmu; /* first: an fmi3Instance points to it */
  fmi3LogMessageCallback log;
  int may_return_early;
} frot_fmi3;

/* A draft that can log, for an instantiation that may fail. */
void frot_fmi3_draft(frot_fmi3 *draft, fmi3String name, fmi3InstanceEnvironment environment,
                     fmi3LogMessageCallback log);

#endif
