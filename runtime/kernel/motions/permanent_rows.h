/* Rows that hold whatever happens, eliminated from the others in the metric of the speeds. */
#ifndef FROT_PERMANENT_ROWS_H
#define FROT_PERMANENT_ROWS_H

#include "motions/contact_instant.h"

/* one->turned (n x width) <- of permanent rows an orthonormal basis, of the others what these leave
 * of them: with the permanent rows they say the same, and the condition of the problem is that of
 * the rows, not of their Gram matrix. one->parts (n x n_permanent): of each row those along the
 * basis, of a basis row how it is made. After frot_list_metric. */
void frot_turn_permanent_rows(frot_contact_instant *one);

/* turned (n) <- biases c of the rows, likewise; size (n) <- of their terms. */
void frot_turn_biases(const frot_contact_instant *one, const double *c, double *turned,
                      double *size);

#endif
