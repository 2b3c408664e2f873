/* Right sides of the contact problem along the motion, order by order. */
#ifndef FROT_TAYLOR_H
#define FROT_TAYLOR_H

#include "motions/contact_instant.h"

/* z (orders of nw), lam (orders of n_rows), force (orders of nw: L^-1 h, or A^-1 h where a group is
 * general): derivatives along the motion. given: results of the function `orders`, of nw + n_rows +
 * 2 n_elements for each order. */
typedef struct frot_taylor {
  frot_contact_instant *of;
  double *z, *lam, *force, *given, *nothing;
} frot_taylor;

/* As frot_right_side says, of a frot_taylor. */
int frot_taylor_right_side(void *context, int k, const double *x, double *b, double *size,
                           double *coefficient);

/* taylor->lam and taylor->z of order j from the reactions x (n) and the right side b (places) of
 * that order: accelerations, and the reactions of all rows. */
void frot_taylor_motion(frot_taylor *taylor, int j, const double *x, const double *b);

#endif
