/* Friction in the stages of a step, and what it foretells. */
#ifndef FROT_FRICTION_PREDICTOR_H
#define FROT_FRICTION_PREDICTOR_H

#include "reactions/force_problem.h"

/* Stages begin, from the instant t with the friction (n_elements) there. */
void frot_begin_friction_history(frot_work *w, double t, const double *friction);

/* Note the friction w->core.lam of the followers of p->g at the instant of the evaluation.
 * w->reactions.instants says how many are known: 0 where a step begins. */
void frot_note_friction(const frot_problem *p);

/* The friction of the followers is what the polynomial through it at the nearest instants is now;
 * what it was where none is known. It is a beginning: nothing may depend on it but by rounding. */
void frot_extrapolate_friction(const frot_problem *p);

#endif
