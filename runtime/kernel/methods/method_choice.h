/* Which of the two integrators takes the next step.
 *
 * The explicit method is left when, for steps on end, its steps are as long as its stability allows
 * (E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, sect. IV.2), or the fastest
 * rate of the model shows in them while the solution itself changes much more slowly. The
 * implicit one is left when, for steps on end, its steps are so short that the explicit one would
 * be stable with them, or not longer than the explicit ones were by what they cost more; if it was
 * not of use for long, more evidence is required next time. The
 * counts are part of the state. Nothing is computed for a model that has no Jacobian. */
#ifndef FROT_METHOD_CHOICE_H
#define FROT_METHOD_CHOICE_H

#include "model/workspace.h"

/* The method of the first step. */
void frot_choose_first(const frot_model *m, frot_state *s);

/* Something has happened: how long the implicit method was of use before says nothing about the
 * equations that hold now. */
void frot_see_other_system(frot_state *s);

/* Whether the step h just accepted speaks for the implicit method. The explicit method's last
 * argument before the end is still in w->step.z. 0 where the text gives the method. */
int frot_is_stiff(const frot_model *m, frot_state *s, frot_work *w, double h);

/* The longest step that should be tried after the one just accepted, of length h: of the explicit
 * method by its stability, of the implicit one by how its stages were found. */
double frot_stable_step(const frot_model *m, frot_state *s, const frot_work *w, double h);

/* Where one method fails, the other is to be tried: takes it; 0 where the text gives the method. */
int frot_change_method(const frot_model *m, frot_state *s);

/* The implicit method cannot pass what is ahead: the explicit one takes some steps, whatever the
 * text says. */
void frot_pass_explicitly(frot_state *s);

/* The method of the step after that one. */
void frot_choose_next(const frot_model *m, frot_state *s, int stiff);

#endif
