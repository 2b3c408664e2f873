/* What rounding does to a step: near singular postures (singular_posture.h) an error along weak
 * rows, which is none of the motion, elsewhere one of the motion. */
#ifndef FROT_POSTURE_ROUNDING_H
#define FROT_POSTURE_ROUNDING_H

#include "model/workspace.h"

/* What rounding makes of the error of the speeds along weak rows in the step h that ran: no error
 * of the motion. w->step.excused (2 nv) <- what is to be left out of their estimates by the weights
 * dp_e5 and dp_e3. w->step.turning <- how much the directions of weak rows turn, over what they
 * may: a motion that leaves its way, or one that the step is too long for, is more than 1. After
 * frot_run_stages. */
void frot_excuse_rounding(const frot_model *m, frot_state *s, frot_work *w, double t, double h);

/* The errors beyond their bounds of the explicit step h that ran, over what moves in a group and
 * what its loads bring in the step, both in the metric of its mass: of the group where that is
 * most, among those in which friction follows reactions. What is small beside others counts as
 * little as it does in them; what would move the places by rounding alone for the longest step, as
 * where a mechanism stands in its dead centre, is rest and no motion. */
double frot_part_of_motion(const frot_model *m, const frot_state *s, frot_work *w, double h);

#endif
