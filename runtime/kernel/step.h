/* One accepted step of the integrator: a new segment. */
#ifndef FROT_STEP_H
#define FROT_STEP_H

#include "state.h"

/* Advance from the end of the current segment by one step in the current modes, to the next event
 * at most. Replaces the current segment; s->pending says that an event waits at its end (or, when
 * no progress was possible, at its start: then the segment is left as it is). Returns FROT_OK or
 * the status of the fault recorded. */
int frot_step(const frot_model *m, frot_state *s, frot_work *w);

/* Coordinates, speeds and quadratures (nx) of a segment at time t. */
void frot_interpolate(const frot_model *m, const frot_segment *segment, double t, double *x);

/* Make the current segment the single instant t with the values x and the current modes. */
void frot_make_instant(const frot_model *m, frot_state *s, double t, const double *x);

/* A first step size from the sizes of the values and their derivatives. */
int frot_first_step(const frot_model *m, frot_state *s, frot_work *w);

#endif
