/* The slopes of the motion in its mode: how its rates change with its states.
 *
 * The equations of an instant are
 *   A z = h + E lam,   J z + c = 0 on rows that are held,   lam_t = ratio * bounding on those that
 *   slip,
 * and the same system, with other right sides, gives the derivatives of z and lam: the generated
 * function gives those of each line at fixed z and lam, and one factor serves all states. Where
 * rows depend on each other, the derivatives of least reactions are taken; those of the motion are
 * the same for all. */
#ifndef FROT_LINEARIZE_H
#define FROT_LINEARIZE_H

#include "methods/linearize_workspace.h"

/* Derivatives at (t, z, d) in the current modes into work->rates and work->residual; the unknowns
 * of the blocks are guessed in w->blocks.y, `slope` (nz) is scratch. FROT_OK or a status that is
 * not recorded as a fault. */
int frot_linearize(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
                   const double *d, const frot_linearize_work *work, double *slope);

#endif
