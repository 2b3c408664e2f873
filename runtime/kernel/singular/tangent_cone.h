/* The ways on from a singular posture (singular_posture.h).
 *
 * Where rows J of a loop depend on each other, k'J = 0, J v = 0 does not say all of its speeds: the
 * relations J a + c = 0 leave k'c = 0, which is quadratic in v. Of a parallelogram that is flat it
 * is a pair of lines, the two ways on. On such a way the relations, once more differentiated, say
 * k'(3 J^ a + ...) = 0 with the rates J^ of the rows: what the rows themselves leave open of the
 * accelerations. Where a combination keeps nothing wherever the loop goes (a planar loop in space),
 * k'J^ lies among the rows and says nothing new. Looked for in groups of loops alone. */
#ifndef FROT_TANGENT_CONE_H
#define FROT_TANGENT_CONE_H

#include "model/workspace.h"

/* Whether rows of loops act in a group, and nothing else: others have no ways to find. */
int frot_has_loops_alone(const frot_model *m, const frot_state *s, const frot_work *w,
                         const frot_group *g);

/* The conditions k'c = 0 that speeds v meet beside the rows of the loops of a group, as equations
 * for a change of v: their number. Of each an orthonormal row, times L^-1, in w->linear.scratch
 * (n_speeds each), what it is missed by in w->linear.right, one of its rows in w->span.way. After
 * frot_dynamics at the same place; leaves the rows there. 0 where nothing moves. */
int frot_find_branches(const frot_model *m, frot_state *s, frot_work *w, const frot_group *g,
                       double t, const double *q, const double *v, const double *d);

/* Accelerations w->core.a, solved for in a singular posture: add to them what the way on says.
 * Rows that depend on others in every posture are marked in `redundant` (n_rows). */
int frot_accelerations_on_branch(const frot_model *m, frot_state *s, frot_work *w, double t,
                                 const double *q, const double *v, const double *d,
                                 const frot_contact_mode *modes, const double *spare);

/* The run begins in a posture in which the row of a liaison depends on others, and shortly after,
 * where the rows were evaluated last, does not: returns whether its speeds determine its motion,
 * and then notes the posture. */
int frot_begins_on_branch(const frot_model *m, frot_state *s, frot_work *w, double t, int contact);

/* Time in which a group, at speeds v, turns by an angle of 1; INFINITY at rest. */
double frot_time_of_turn(const frot_model *m, const frot_state *s, const frot_group *g,
                         const double *v);

#endif
