/* The motion in a given mode: its solution at an instant, and its derivatives. */
#ifndef FROT_RIGHT_HAND_SIDE_H
#define FROT_RIGHT_HAND_SIDE_H

#include "evaluation/evaluate.h"
#include "model/workspace.h"

/* Solve everything at (t, q, v, d) in the given mode: w->core.a, w->core.lam, w->core.qd and
 * w->core.power, and with `late`, or where a condition reads them, all the unknowns w->blocks.y,
 * all reactions and those conditions. `along` (2 n_elements): where to begin to look for the
 * directions of pins' reactions. FROT_OK or a status that is not recorded as a fault. */
int frot_solution(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, const frot_contact_mode *modes,
                  const double *frozen, const double *along, int late);

/* The rates of coordinates and the power, where they depend on the solution. */
int frot_late_rates(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, const double *d);

/* Derivatives of coordinates, speeds, quadratures and of the integrals of the guards listed. */
int frot_derivatives(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
                     const double *d, const frot_contact_mode *modes, const double *frozen,
                     double *slope);

/* The same at z in the current modes of the state. */
int frot_slope(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
               double *slope);

#endif
