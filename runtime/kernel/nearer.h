/* Where the figures of an open contact are nearest, seen as a whole.
 *
 * The place where two figures touch is followed: the solution of its equations near the last one.
 * Of a closed contact that is all there is. While one is open, another place may come to be nearer,
 * as for a ball thrown across a bowl, and the followed one may end. So at the end of each step the
 * nearest is looked for along the whole figures. What may touch next is always the nearest then. */
#ifndef FROT_NEARER_H
#define FROT_NEARER_H

#include "work.h"

/* Look at the end of the step [t, end] that has run, from w->step.z0 to w->step.z1, with
 * w->step.y_end there, for nearer places of the open contacts. Returns -1 where one passed through
 * a figure there since t: the step is too long; else how many are nearer. Their blocks then stand
 * in w->nearer; kinematics are those of the end. */
int frot_look_nearer(const frot_model *m, frot_state *s, frot_work *w, double t, double end);

/* The blocks of w->nearer into y (ny). */
void frot_take_nearer(const frot_model *m, const frot_work *w, double *y);

#endif
