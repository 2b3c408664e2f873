/* Where the figures of a contact that may part are nearest, seen as a whole.
 *
 * The place where two figures touch is followed: the solution of its equations near the last one.
 * While a contact is open, another place may come to be nearer, as for a ball thrown across a bowl,
 * and the followed one may end. So in each step the nearest is looked for along the whole figures,
 * and the step ends where it is another one. What may touch next is always the nearest then. Where
 * figures that touch meet at another place too, as a wheel in a trough, the run ends: a liaison has
 * one place. */
#ifndef FROT_CLOSEST_FEATURES_H
#define FROT_CLOSEST_FEATURES_H

#include "model/workspace.h"

/* Look at the end of the step h from t that has run, from w->step.z0 to w->step.z1, with
 * w->step.y_end there, for nearer places of the contacts. Returns the part of the step after which
 * the first is nearer, or touches beside a closed one (1 where none does before its end). Those
 * that are at the end stand in w->nearer, `count` of them; kinematics are those of the end. FROT_OK
 * or the status of what failed. */
int frot_find_closer_features(const frot_model *m, frot_state *s, frot_work *w, double t, double h,
                              double *part);

/* Take the places found, with the sides on which they are and the ends beyond which they lie. One
 * beside a closed contact is a fault, s->second, reported at the end of the step. */
void frot_take_closer_features(const frot_model *m, frot_state *s, frot_work *w);

/* x (states) <- their values after the part theta of the step, from its dense output. */
void frot_values_inside(const frot_work *w, double theta, double *x);

/* Its scratch from the arena. */
void frot_bind_nearer(const frot_model *m, frot_nearer_work *w, frot_arena *a);

#endif
