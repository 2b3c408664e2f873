/* How far apart the places of a liaison stay at best where a mechanism cannot be put together. */
#ifndef FROT_CLOSURE_FAULT_H
#define FROT_CLOSURE_FAULT_H

#include "assembly/start_equations.h"

/* After a search for positions that found none and blamed a liaison alone: blame the one that is
 * left farthest open in the best place that is found, and tell how far: the fault's value, a length
 * in m, or with where[0] = 1 between directions, in rad. Leaves the fault where there is no such
 * place. */
void frot_tell_apart(frot_opening *p);

/* After a step that cannot be made: say that what time drives goes beyond the reach of a loop,
 * where the relations cannot hold shortly after, near the states as they are. Returns the status.
 */
int frot_report_unreachable(const frot_model *m, frot_state *s, frot_work *w, int status);

#endif
