/* The slopes of the stages of a step, and sums of them. */
#ifndef FROT_STAGE_SLOPES_H
#define FROT_STAGE_SLOPES_H

#include "model/workspace.h"

#define FROT_CHUNK 4 /* values summed together, in registers */

/* The slope (nz) of stage i. */
static inline double *frot_stage(const frot_work *w, int i) { return w->step.k + i * w->layout.nz; }

/* Values integrated together: the awake states (sleeping.h) and, from w->awake.n on, the guards
 * listed. Slopes and vectors of the dense output hold these, packed. */
static inline int frot_width(const frot_work *w) { return w->awake.n + w->guards.count; }

/* sum[j] <- sum of coefficient[k] times stage k < count of the value from + j, j < size <=
 * FROT_CHUNK. */
void frot_weigh_stages(const frot_work *w, const double *coefficient, int count, int from, int size,
                       double sum[FROT_CHUNK]);

#endif
