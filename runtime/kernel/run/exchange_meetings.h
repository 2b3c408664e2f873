/* Contacts that meet where another integrator steps the motion. */
#ifndef FROT_EXCHANGE_MEETINGS_H
#define FROT_EXCHANGE_MEETINGS_H

#include "model/workspace.h"

/* Put open contacts whose guards have fired to the gap zero, by the least change of the coordinates
 * q (nq) that keeps the relations; v (nv) stays. The other integrator has gone a little beyond: the
 * next flight would begin below, and each would be lower than it is. Coordinates stay where there
 * is no such place. *moved: whether they have moved. */
void frot_put_meetings(const frot_model *m, frot_state *s, frot_work *w, double *q, const double *v,
                       int *moved);

/* The same with those that are in each other by the error of the other integrator: figures of which
 * one is a little inside the other touch with other features than those that are. FROT_OK or a
 * status that is not recorded as a fault. */
int frot_put_out(const frot_model *m, frot_state *s, frot_work *w, double *q, const double *v,
                 int *moved);

#endif
