/* What rounding of the rates has made of the states so far, carried from step to step. Where a sum
 * that the rates keep is much larger than a state in it, that may come to all digits of this state,
 * and no tolerance shows it. For models of equations alone. */
#ifndef FROT_RATE_ROUNDING_H
#define FROT_RATE_ROUNDING_H

#include "model/workspace.h"

/* Carry the errors along a step h that is kept, by its factored matrix, and add those made in it.
 * The largest, over the size of its state, is noted in the statistics where it is far above the
 * tolerance. An explicit step has no
 * matrix: there an error only fades with its state. Uses rows of w->step.k behind the stages. */
void frot_follow_rate_rounding(const frot_model *m, frot_state *s, frot_work *w, double h);

/* The states have jumped: the errors begin anew. */
void frot_forget_rate_rounding(const frot_model *m, frot_state *s, const frot_work *w);

#endif
