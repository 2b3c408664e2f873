/* Where a place that is followed goes beyond the end of a figure, or comes back from there.
 *
 * Such a condition is none of the text. While a contact is open its side is the one on which it
 * comes back; a closed one goes round the end with its normal, and a point that slides over it,
 * whose normal turns to where it goes, has left. */
#ifndef FROT_FEATURE_EDGES_H
#define FROT_FEATURE_EDGES_H

#include "model/workspace.h"

/* Whether figures of the model have ends from which contacts may part. */
int frot_has_edges(const frot_model *m);

/* Note the normals of the contacts, before conditions change. */
void frot_note_normals(const frot_model *m, frot_work *w);

/* Choose the sides of the contacts whose places have passed an end since w->events.before, and open
 * those that leave there; kinematics are those of now, also afterwards. */
int frot_pass_edges(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, frot_recorder *recorder);

/* Fire the ends by which open contacts pass that meet something now: a corner that meets another
 * one and passes it. Moves t and (q, v) on to where they are passed, nearer than events are
 * located. FROT_OK or the status of the fault recorded. */
int frot_fire_ends(const frot_model *m, frot_state *s, frot_work *w, double *t, double *q,
                   double *v);

#endif
