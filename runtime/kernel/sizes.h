/* Sizes of states against which their errors are measured. */
#ifndef FROT_SIZES_H
#define FROT_SIZES_H

#include "state.h"

/* Sizes of the states that are no coordinates into w->own_size (nq), from what a step brings them,
 * w->change (nq): the largest each has had or gets, and at least a hundredth of the largest among
 * those of its dimension. A current of a microampere beside one of an ampere is followed by itself;
 * what is just leaving zero is not. Returns 1 when a size is zero. */
int frot_state_sizes(const frot_model *m, const frot_state *s, frot_work *w);

#endif
