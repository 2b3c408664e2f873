/* Relations between states that index reduction brought to light. */
#ifndef FROT_INVARIANTS_H
#define FROT_INVARIANTS_H

#include "state.h"

/* frot_project where the model has invariants: onto these and the relations of the contacts
 * together, by Gauss-Newton steps that change each state least in units of its size so far. */
int frot_project_jointly(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                         double *v, const double *d, const frot_contact_mode *modes,
                         const unsigned char *stuck, int *moved);

#endif
