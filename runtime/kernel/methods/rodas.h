/* The implicit step, in one mode. Of models of equations alone a Rosenbrock method of order 5 with
 * dense output of order 4; of those with accelerations radau.h. It takes the place of the stages of
 * the explicit step, in the same scratch: w->step.z0 is the start, stage 0 of w->step.k the slope
 * there; w->step.z1 becomes the end, stage DP_STAGES of w->step.k the slope there. */
#ifndef FROT_RODAS_H
#define FROT_RODAS_H

#include "model/workspace.h"

/* Doubles and integers of scratch (w->implicit.items, w->implicit.pivot). */
size_t frot_implicit_doubles(const frot_model *m);
size_t frot_implicit_integers(const frot_model *m);

/* The Jacobian at the start (t, w->step.z0) of a step. FROT_OK, FROT_NAN or FROT_SINGULAR. */
int frot_implicit_begin(const frot_model *m, frot_state *s, frot_work *w, double t);

/* The step h. FROT_OK, or a status for which a shorter step is the remedy; FROT_POSTURE: radau.h.
 */
int frot_implicit_stages(const frot_model *m, frot_state *s, frot_work *w, double t, double h);

/* Estimate of the local error over its bound, after frot_implicit_stages. */
double frot_implicit_error(const frot_model *m, frot_state *s, frot_work *w, double h);

/* Vectors of the dense output into w->step.f; those of a guard are the Bernstein coefficients of
 * the polynomial of degree 6 through its values in the step. FROT_OK or the status of an
 * evaluation. */
int frot_implicit_dense(const frot_model *m, frot_state *s, frot_work *w, double t, double h);

/* Whether the polynomials of the guards follow them in the step made. */
int frot_implicit_follows_guards(const frot_model *m, const frot_state *s, const frot_work *w);

/* Bound of the largest size of an eigenvalue of the Jacobian, see frot_jacobian_bound. After
 * frot_implicit_error. */
double frot_implicit_rate(const frot_model *m, const frot_work *w);

/* Scratch of implicit methods from the arena. */
void frot_bind_implicit(const frot_model *m, frot_implicit_work *w, frot_arena *a);

#endif
