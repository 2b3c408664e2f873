/* How a step passes a singular posture (singular_posture.h), or does not.
 *
 * Near a posture rounding makes an error of the step that does not fall with its length: the step
 * is laid so that no stage is too near, and taken with what rounding makes of it while that leaves
 * digits enough. */
#ifndef FROT_POSTURE_PASSAGE_H
#define FROT_POSTURE_PASSAGE_H

#include "stepping/attempt.h"
#include "model/workspace.h"

/* Whether no stage of the step that ran is too near a singular posture; else it is laid anew. */
int frot_step_avoids_posture(const frot_model *m, const frot_state *s, const frot_work *w,
                             frot_attempt *a);

/* Shorten the step h, in which rows are weak, to about a->h. Where a shorter one is no better than
 * the best so far, its error is all rounding: the best is taken, if that leaves
 * digits enough. */
void frot_shorten_passage(const frot_model *m, frot_state *s, const frot_work *w, frot_attempt *a,
                          double h);

/* Take the best step that frot_shorten_passage had run again, if its error is what it was. */
void frot_take_forced(frot_state *s, frot_attempt *a);

/* What rounding does to a step across a posture grows as the step begins nearer to it; all else
 * shrinks. So where one is no better than the last that was tried from farther off, no other will
 * be: it is taken if it leaves digits enough, else the run ends here. */
void frot_judge_passage(const frot_model *m, frot_state *s, const frot_work *w, frot_attempt *a);

/* The liaison of a posture near the end of the step, or of a loop, if putting the speeds onto the
 * relations has taken more of the kinetic energy than errors within the tolerance make, -1 if not:
 * the projection is orthogonal in the metric of the mass, so that it takes what they amount to
 * squared. What rounding alone moves in a step of length h is none (an equilibrium). */
int frot_projection_loses_energy(const frot_model *m, const frot_state *s, frot_work *w, double t,
                                 double h);

#endif
