/* An instance behind FMI 2.0. */
#ifndef FROT_FMI2_INSTANCE_H
#define FROT_FMI2_INSTANCE_H

#include "fmi2Functions.h"
#include "instance.h"

typedef struct {
  frot_fmu fmu; /* first: an fmi2Component points to it */
  fmi2CallbackLogger logger;
} frot_fmi2;

#endif
