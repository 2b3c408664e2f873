/* The modes that text and laws read: the first discrete values. */
#ifndef FROT_MODES_READ_H
#define FROT_MODES_READ_H

#include "model/state.h"

/* Put the modes that are read among the discrete values; whether one that acts changed. *turned: a
 * contact whose law begins or ceases to act, else as it was. */
int frot_read_modes(const frot_model *model, frot_state *state, int *turned);

/* Let a law of a contact whose reaction has come to zero act no more: that the contact opens is
 * decided by what is located at zero, once, and not by rounding of the same number later. Where it
 * closes all the same the law acts again. */
void frot_expect_openings(const frot_model *model, frot_state *state);

#endif
