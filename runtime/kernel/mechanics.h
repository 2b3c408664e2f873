/* The motion in a given mode: its derivatives, and the guards that say when the mode ends. */
#ifndef FROT_MECHANICS_H
#define FROT_MECHANICS_H

#include "core.h"
#include "reactions.h"
#include "state.h"

/* Guards (ng) of the modes after frot_reactions: positive while the mode lasts. For contact i, from
 * FROT_GUARDS*i: normal (gap when open, reaction when closed), friction (2), rolling (2); then the
 * conditions. Guards that cannot end a mode are 1. `scale` (may be NULL): the size of their terms.
 */
void frot_guards(const frot_model *m, const frot_state *s, frot_work *w, const double *q,
                 const double *v, const double *d, const frot_contact_mode *modes, double *guard,
                 double *scale);

/* Turn the reference directions of the pins' reactions to what they are in w->lam. The size of a
 * reaction has a corner where it passes through zero: while a pin slips, its first guard is its
 * reaction along the reference, so that no step goes over the corner. */
void frot_turn_references(const frot_model *m, frot_state *s, const frot_work *w);

/* Solve everything at (t, q, v, d) in the given mode: w->a, w->lam, w->qd and w->power, and with
 * `late` all the unknowns w->y. FROT_OK or a status that is not recorded as a fault. */
int frot_solution(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, const frot_contact_mode *modes,
                  const double *frozen, int late);

/* Derivatives (nz) of coordinates, speeds, quadratures and of the integrals of the guards. */
int frot_derivatives(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
                     const double *d, const frot_contact_mode *modes, const double *frozen,
                     double *slope);

#endif
