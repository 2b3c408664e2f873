/* A first step for a model whose states begin at rest or at zero. */
#ifndef FROT_SLOPE_PROBE_H
#define FROT_SLOPE_PROBE_H

#include "model/workspace.h"

/* A step h at most, in which the slopes at (t, w->step.z0), which are in stage 0 of w->step.k,
 * change by a part only. For models whose states are all q and no coordinates; h itself for others.
 */
double frot_probe_slopes(const frot_model *m, frot_state *s, frot_work *w, double t, double h);

#endif
