/* What a change of parameters or inputs in a run does to the relations that hold.
 *
 * Values change at once, bodies do not: where they are and how fast they move stays. A contact
 * whose line is taken away opens. A change that would carry a body along, take apart what cannot
 * part, or put a body into a line, is refused. What moves by rounding only is mended by projection.
 */
#ifndef FROT_PARAMETER_CHANGE_H
#define FROT_PARAMETER_CHANGE_H

#include "model/workspace.h"

/* Note what is given now: the values to which a refused change goes back. */
void frot_accept_parameters(const frot_model *m, frot_state *s);
/* Exchange the inputs given now with those held: what was before a change is evaluated with these.
 * Parameters need none of it, for they take effect when they are settled. */
void frot_swap_inputs(const frot_model *m, frot_state *s);
/* Go back to the values noted last. */
void frot_restore_parameters(const frot_model *m, frot_state *s, frot_work *w);

/* Note where the relations stand at (t, q, v), before the values change. */
int frot_note_contacts_before_change(const frot_model *m, frot_state *s, frot_work *w, double t,
                                     const double *q, const double *v);
/* After the change, at the same values of the states: open what has opened, and note in `fired`
 * what touches. FROT_REFUSED, with the fault recorded, where the change cannot be. */
int frot_check_contacts_after_change(const frot_model *m, frot_state *s, frot_work *w, double t,
                                     const double *q, const double *v, frot_recorder *recorder);

/* After conditions have changed, at the same states: FROT_JUMP, with the fault recorded, where a
 * relation of the text between states no longer holds. */
int frot_check_switch(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                      const double *v);

/* The sentence of a refusal, and the place of what it is about where that is no contact. */
void frot_refusal_text(const frot_model *m, const frot_fault *f, char *text, size_t size);
const char *frot_refusal_place(const frot_model *m, const frot_fault *f);

#endif
