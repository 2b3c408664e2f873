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

#include "model/workspace.h"

typedef struct {
  double *rates;    /* derivatives of q' and v': entries of the pattern, or in q, v and the unknowns
                       y of the early blocks, by columns of nq + nv items */
  double *residual; /* those of the residuals of these blocks, by columns */
  double *partial;  /* results of the generated function */
  double *seed;     /* its direction */
  double *block;    /* derivatives of the lines of a group, by columns */
  double *matrix, *lu, *right, *least, *scale;
  int *pivot, *unknown;
  int *place; /* of each column among those of the group */
} frot_linearize_work;

/* Its scratch in memory that may be NULL, and how much that takes, without rates and residual. */
frot_linearize_work frot_linearize_scratch(const frot_model *m, double *doubles, int *integers,
                                           size_t *n_doubles, size_t *n_integers);

/* Derivatives at (t, z, d) in the current modes into work->rates and work->residual; the unknowns
 * of the blocks are guessed in w->blocks.y, `slope` (nz) is scratch. FROT_OK or a status that is
 * not recorded as a fault. */
int frot_linearize(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
                   const double *d, const frot_linearize_work *work, double *slope);

#endif
