/* The indices that a fault may hold: what its sentence looks up in the tables of the model. */
#ifndef FROT_FAULT_INDICES_H
#define FROT_FAULT_INDICES_H

#include "model/state.h"

/* Whether `contact`, `item` and `other` of a fault lie inside the tables that its sentence and its
 * places read. A state from outside (a serialised FMU state) may be damaged. */
int frot_fault_is_valid(const frot_model *model, const frot_fault *fault);

#endif
