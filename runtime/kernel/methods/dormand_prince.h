/* The evaluations of one explicit step of order 8, with its dense output of order 7.
 *
 * Beside coordinates, speeds and the energies, the integrals of the listed guards are integrated.
 * In the scratch memory w->step.z0 is the start, stage 0 of w->step.k the slope there; w->step.z1
 * becomes the end, stage DP_STAGES the slope there. Where s->implicit is set, the implicit step is
 * made instead, in the same places. */
#ifndef FROT_DORMAND_PRINCE_H
#define FROT_DORMAND_PRINCE_H

#include "model/stage_slopes.h"

/* Stages 1 .. DP_STAGES of the step h, stage 0 being there; w->step.y_end becomes the unknowns of
 * the blocks at the end. Where a stage fails, w->step.z1 is its argument. FROT_OK or a status that
 * is not recorded as a fault. */
int frot_run_stages(const frot_model *m, frot_state *s, frot_work *w, double t, double h);

/* Whether the determinant that gives the reactions has another sign than at the start of the step:
 * it was zero between, where they grow without bound (jamming): then w->reactions.jammed is the
 * group. */
int frot_has_jammed(const frot_state *s, frot_work *w);

/* Vectors of the dense output of the step h into w->step.f (DP_DENSE x nz). Takes three
 * evaluations; the cubic between its ends alone takes none. */
int frot_make_dense(const frot_model *m, frot_state *s, frot_work *w, double t, double h);
void frot_make_cubic(const frot_work *w, double h);

/* Whether what is evaluated inside a step depends on more than its segment tells: then its dense
 * output is made with it. */
int frot_needs_inside(const frot_model *m, const frot_state *s);

/* The same of a step inside which nothing is decided, after it: the vectors of the segment g from
 * the ends z0 and z1 and the stages dp_inside that are in the scratch memory. Looking on is no part
 * of the run: neither these evaluations are counted nor does the motion depend on them. Next to a
 * place beyond which there is no motion they may lie beyond that: then the cubic has to do, which
 * is as short there as its ends are near. */
void frot_complete_dense_output(const frot_model *m, frot_state *s, frot_work *w,
                                const frot_segment *g);

/* Scratch of a step from the arena. */
void frot_bind_step(const frot_model *m, const frot_layout *l, frot_step_work *w, frot_arena *a);

#endif
