/* What is to blame where a step cannot be made. */
#ifndef FROT_FAULT_SOURCE_H
#define FROT_FAULT_SOURCE_H

#include "model/workspace.h"

/* Record the fault `status` of a step h at t, with what is to blame: a block of equations, the
 * contact of a coefficient or the force that is no number (at q, v, those of the last evaluation)
 * or, when the step goes to zero, the state whose error forced it, or the contact that
 * time takes apart, or that with the largest reaction where that is a coordinate or a speed.
 * Returns the status. */
int frot_fail_step(const frot_model *m, frot_state *s, frot_work *w, int status, double t, double h,
                   const double *q, const double *v);

/* The group that keeps a step from being any longer, where something slips in it; -1 otherwise. */
int frot_group_of_jamming_slip(const frot_model *m, const frot_state *s, const frot_work *w);

/* Record the fault `status` of an evaluation at t with the block to blame, if one is. */
int frot_fail_evaluation(const frot_model *m, frot_state *s, frot_work *w, int status, double t);

/* The closed contact whose bodies time takes apart most in the run after t, where the values q and
 * v stay and no speed moves them along it; -1 if none. */
int frot_contact_opened_by_time(const frot_model *m, frot_state *s, frot_work *w, double t,
                                const double *q, const double *v);

/* Say instead which figure has lost its tangent or normal, where that is what a failed start or
 * step comes from: so it is at the states x of the instance, or at `z`, the last that were
 * evaluated. Returns the status. */
int frot_name_singular_figure(const frot_model *m, frot_state *s, frot_work *w, int status,
                              const double *z);

/* The same where values to be output at t are no numbers, at the states w->step.z1 of a
 * recorded segment: the run continues or has ended as it did. */
int frot_name_singular_figure_at(const frot_model *m, frot_state *s, frot_work *w, int status,
                                 double t);

#endif
