/* Accelerations and reactions in a given mode, and the guards that say when the mode ends. */
#ifndef FROT_MECHANICS_H
#define FROT_MECHANICS_H

#include "state.h"

/* Point w->arg at the arguments that all functions of the state begin with. */
void frot_inputs(const frot_model *m, frot_state *s, frot_work *w, const double *t, const double *q,
                 const double *v, const double *d);

/* Evaluate the generated `dynamics` at (t, q, v, d), factor the mass matrix and form the Delassus
 * matrix W = J M^-1 J' and the free accelerations J M^-1 h + c of the rows of the contacts that are
 * closed in `modes`. FROT_OK, FROT_NAN or FROT_SINGULAR (not recorded as a fault). */
int frot_dynamics(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, const frot_contact_mode *modes);

/* Evaluate `kinematics` alone: gap, rows, rate, condition, distance. */
void frot_kinematics(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                     const double *v, const double *d);

/* Size of the terms of J x in a row, for the comparison with zero; after frot_kinematics. */
double frot_row_size(const frot_model *m, const frot_work *w, int row, const double *x);

/* Reactions w->lam of the rows in `modes`, after frot_dynamics. Where at_rest (n_contacts, may be
 * NULL) is nonzero, slip is resisted by the coefficient of rest mu_s. Reactions of least friction
 * are taken where they are not unique. Returns 1 when no finite reactions exist. */
int frot_reactions(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                   const unsigned char *at_rest);

/* What all loads could do to the rows of closed contacts (w->row_load), after frot_dynamics at the
 * same place: accelerations that their sum is compared with, for it may cancel. */
void frot_row_loads(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, const double *d, const frot_contact_mode *modes);

/* Speed of a row if all motion went into it: for the comparison of a speed with zero. Uses w->rows
 * and the mass matrix of the last frot_dynamics. */
double frot_row_speed(const frot_model *m, frot_work *w, int row, const double *v);

/* Accelerations w->a from w->lam; those of frozen speeds are exactly zero. */
void frot_accelerations(const frot_model *m, frot_work *w, const double *frozen);

/* Guards (ng) of the modes after frot_reactions: positive while the mode lasts. For contact i, from
 * FROT_GUARDS*i: normal (gap when open, reaction when closed), friction (2), rolling (2); then the
 * conditions. Guards that cannot end a mode are 1. `scale` (may be NULL): the size of their terms.
 */
void frot_guards(const frot_model *m, const frot_state *s, frot_work *w, const double *q,
                 const double *v, const double *d, const frot_contact_mode *modes, double *guard,
                 double *scale);

/* Derivatives (nz) of coordinates, speeds, quadratures and of the integrals of the guards. */
int frot_derivatives(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
                     const double *d, const frot_contact_mode *modes, const double *frozen,
                     double *slope);

#endif
