/* Sizes of the terms of what may cancel: with them a sum is compared to say whether it is zero, and
 * rounding is measured by them. */
#ifndef FROT_TERM_SIZES_H
#define FROT_TERM_SIZES_H

#include "evaluation/evaluate.h"

/* Sizes of the terms of J v in a row and of the motion of a gap by all coordinates, for the
 * comparison with zero; after frot_kinematics. */
double frot_row_size(const frot_model *m, const frot_work *w, int row, const double *v);
double frot_gap_size(const frot_model *m, const frot_work *w, int row, const double *q);

/* Size of the gap of contact i: of its motion by all coordinates, and of its lengths. */
double frot_size_of_gap(const frot_model *m, const frot_state *s, const frot_work *w, int i,
                        const double *q);

/* Whether the gap of contact i is zero to rounding; after frot_kinematics and frot_note_reaches. */
int frot_is_flush(const frot_model *m, const frot_state *s, const frot_work *w, int i,
                  const double *q);

/* Speed of a row if all motion of its group went into it: for the comparison of a speed with zero.
 * Uses w->core.rows and the metric of the last frot_dynamics, factored. */
double frot_row_speed(const frot_model *m, frot_work *w, int row, const double *v);

/* Length of the row L^-1 J', whose own length is `own`, that it is measured by: a slip beside the
 * motion along its normal, for in a dead centre nothing moves it, and its row is rounding. Uses the
 * mass and the metric of the last frot_dynamics. */
double frot_length_beside(const frot_model *m, frot_work *w, int row, double own);
/* Length of it outside the rows before it below which it depends on them. */
double frot_least_length(const frot_model *m, frot_work *w, int row, double own);

/* What all loads could do to the rows that frot_dynamics has formed, into w->core.row_load:
 * sizes that their sum is compared with, for it may cancel. After frot_dynamics at the same place.
 */
void frot_row_loads(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, const double *d);

/* Sizes of the terms of each acceleration (nv): |A^-1| of all loads, and of all reactions
 * w->core.lam.
 * After frot_solution at the same place. */
void frot_acceleration_sizes(const frot_model *m, frot_state *s, frot_work *w, double t,
                             const double *q, const double *v, const double *d, double *size);

/* A group without speed whose accelerations w->core.a are no more than rounding of their terms is
 * in equilibrium: they become zero. In frot_solution, after frot_accelerations. */
void frot_rest_in_rounding(const frot_model *m, frot_state *s, frot_work *w, double t,
                           const double *q, const double *v, const double *d);

#endif
