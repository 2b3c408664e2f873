/* Where relations of a loop do not determine its motion: a start in a singular posture
 * (singular_posture.h), or so near one that rounding decides. */
#ifndef FROT_UNDETERMINED_BRANCH_H
#define FROT_UNDETERMINED_BRANCH_H

#include "model/workspace.h"

/* The liaison of whose weak row the start or a stage of the step that ran is so near a posture that
 * rounding turns it away from its motion, -1 if none: what follows may be another motion. */
int frot_undetermined_row(const frot_model *m, const frot_state *s, const frot_work *w, double t,
                          double h);

/* Mark in `lost` (n_contacts) each liaison of a row that depends, or nearly, on others at the start
 * of a run, where the slope has just been evaluated, and much less shortly after: where it goes
 * from there is not determined. Of a group the first is marked. */
void frot_starts_singular(const frot_model *m, frot_state *s, frot_work *w, double t, double h,
                          unsigned char *lost);

/* The liaison whose posture is nearest to t, -1 where none is near. */
int frot_posture_at(const frot_model *m, const frot_state *s, const frot_work *w, double t);

#endif
