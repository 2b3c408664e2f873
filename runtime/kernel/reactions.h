/* Reactions in a given mode. */
#ifndef FROT_REACTIONS_H
#define FROT_REACTIONS_H

#include "state.h"

/* Reactions w->lam of the rows in `modes`, after frot_dynamics. Where at_rest (n_contacts, may be
 * NULL) is nonzero, slip is resisted by the coefficient of rest mu_s. Where they are not unique,
 * those of least friction are taken, within the bounds of rest if they can be. Returns 1 when no
 * finite reactions exist. */
int frot_reactions(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                   const unsigned char *at_rest);

/* What friction (rolling = 0) or rolling resistance (1) of contact i can resist at rest, from the
 * coefficients w->coefficient and the reactions w->lam. */
double frot_bound_of_rest(const frot_model *m, const frot_work *w, int i,
                          const frot_contact_mode *mode, int rolling);

/* Size of the terms of a row's acceleration without reactions. */
double frot_free_size(const frot_model *m, const frot_work *w, int row);

#endif
