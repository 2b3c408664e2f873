/* The implicit step of models with accelerations: Radau IIA of 5 stages, whose stages are solved
 * together by Newton's method with the Jacobian at the start of the step.
 *
 * What a stiff spring holds turns with the bodies, and a linear solve along the directions at the
 * start of a step misses it by the square of the way: Rosenbrock methods then take steps as short
 * as those of order two. Stages that are solved for keep their order (C. Lubich, Integration of
 * stiff mechanical systems by Runge-Kutta methods, ZAMP 44, 1993, p. 1022). The iteration ends
 * where what is left is a thousandth of the error the step may have, or rounding. */
#ifndef FROT_RADAU_H
#define FROT_RADAU_H

#include "model/workspace.h"

/* Rows of w->step.k: what the stages have moved, their slopes, the estimate of the error. */
#define FROT_RADAU_MOVED 1
#define FROT_RADAU_SLOPES 6
#define FROT_RADAU_ERROR 11

/* Doubles and integers of scratch. */
size_t frot_radau_doubles(const frot_model *m);
size_t frot_radau_integers(const frot_model *m);

/* The step h with the Jacobian in place. FROT_OK, FROT_POSTURE where rows of a loop become
 * dependent in it or soon after, so that the explicit method has to pass (singular_posture.h), or a
 * status for which a shorter step is the remedy. */
int frot_radau_stages(const frot_model *m, frot_state *s, frot_work *w, double t, double h);

/* Vectors of the dense output of states and energies into w->step.f.
 *
 * The polynomial through the stages is off between them, and what is stiff makes much of that: a
 * speed that a damper holds may be right to 1e-8 and its acceleration to 5 %. So it is corrected at
 * two places there by what its rate misses. FROT_OK or the status of an evaluation. */
int frot_radau_dense(const frot_model *m, frot_state *s, frot_work *w, double t, double h);

#endif
