/* The length of a step: the first one's, a shorter one where that tried is too long, and the next
 * one's. */
#ifndef FROT_STEP_LENGTH_H
#define FROT_STEP_LENGTH_H

#include <float.h>

#include "stepping/attempt.h"
#include "model/workspace.h"

/* Part of the way to where a condition seems to be zero, beyond which there is no value, or a guard
 * comes near zero. */
#define FROT_NEARLY 0.9

/* A first step size from the sizes of the values and their derivatives. */
int frot_first_step(const frot_model *m, frot_state *s, frot_work *w);

/* The shortest step whose end differs from its start. */
double frot_least_step(const frot_state *s, const frot_attempt *a);

/* Whether the step is so short that its end does not differ from its start. */
int frot_is_too_short(const frot_state *s, const frot_attempt *a);

/* Shorten the step that was tried: by its error, or to before where it has no value. */
void frot_shorten(const frot_model *m, frot_state *s, const frot_work *w, frot_attempt *a);

/* s->h <- the next step's length, after one that was good; `planned`: what this one was to have. */
void frot_plan_next(const frot_model *m, frot_state *s, const frot_work *w, const frot_attempt *a,
                    double planned);

#endif
