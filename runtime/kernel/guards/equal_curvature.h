/* Where figures that touch come to bend alike.
 *
 * The place where two figures touch is the solution of a few equations. Their Jacobian K is regular
 * while the gap has a least or a largest value there along both figures. Where det K changes sign a
 * curvature of one figure has become that of the other: beyond it the gap is negative beside the
 * place, and nothing determines where they touch. The run ends there (E0911). */
#ifndef FROT_EQUAL_CURVATURE_H
#define FROT_EQUAL_CURVATURE_H

#include "model/workspace.h"

/* Examine the step h from t that has run, from w->step.z0 to w->step.z1, with w->step.y_end there.
 * *part <- the part of it after which det K of a closed contact, or of one that cannot part, first
 * changes sign; 1 where none does. FROT_OK or the status of what failed. */
int frot_find_equal_curvature(const frot_model *m, frot_state *s, frot_work *w, double t, double h,
                              double *part);

#endif
