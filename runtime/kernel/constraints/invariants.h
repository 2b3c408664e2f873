/* Relations between states that index reduction brought to light. */
#ifndef FROT_INVARIANTS_H
#define FROT_INVARIANTS_H

#include "model/workspace.h"

/* frot_project where the model has invariants: onto these and the relations of the contacts
 * together, by Gauss-Newton steps that change each state least in units of its size: the larger of
 * that in `sizes` (nq + nv, may be NULL) and its own. Speeds that are `frozen` (nv) stay. */
int frot_project_jointly(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                         double *v, const double *d, const frot_contact_mode *modes,
                         const unsigned char *stuck, const double *sizes, const double *frozen,
                         int *moved);

/* Adds to the sizes of the invariants' terms what their rows, in w->relations.jacobian, make of the
 * sizes of the states: terms may vanish where states do not. */
void frot_add_sizes(const frot_model *m, frot_work *w, const double *q, const double *v,
                    double *size);

#endif
