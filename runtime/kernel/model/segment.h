/* The current segment: one step with its dense output in one mode, or one instant. */
#ifndef FROT_SEGMENT_H
#define FROT_SEGMENT_H

#include "model/workspace.h"

/* Coordinates, speeds and quadratures (nx) of a segment at time t. */
void frot_interpolate(const frot_model *m, const frot_segment *segment, double t, double *x);

/* First guess w->blocks.y of the unknowns of the blocks in a segment at time t. */
void frot_guess_unknowns(const frot_model *m, frot_work *w, const frot_segment *segment, double t);

/* Make the current segment the single instant t with the values x, the current modes and the
 * unknowns w->blocks.y of the blocks. */
void frot_make_instant(const frot_model *m, frot_state *s, frot_work *w, double t, const double *x);

/* Make it the step h from t that is in the scratch memory, with its dense output in w->step.f; it
 * ends at `end`, which is t + h but for rounding. */
void frot_keep_step(const frot_model *m, frot_state *s, const frot_work *w, double t, double h,
                    double end);
/* Its dense output alone. */
void frot_keep_dense(const frot_work *w, const frot_segment *segment);

#endif
