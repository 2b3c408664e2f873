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

/* First guess w->y of the unknowns of the blocks in a segment at time t. */
void frot_guess_unknowns(const frot_model *m, frot_work *w, const frot_segment *segment, double t);

/* Make the current segment the single instant t with the values x, the current modes and the
 * unknowns w->y of the blocks. */
void frot_make_instant(const frot_model *m, frot_state *s, const frot_work *w, double t,
                       const double *x);

/* A first step size from the sizes of the values and their derivatives. */
int frot_first_step(const frot_model *m, frot_state *s, frot_work *w);

#endif
