/* Changes of the unknowns at the start, in terms that masses measure: of an orientation its turn
 * and its length instead of its four items; of everything else the unknown itself. */
#ifndef FROT_UNKNOWNS_H
#define FROT_UNKNOWNS_H

#include "assembly/start_equations.h"

/* out <- what a unit of each change, from p->basis on, does to a row over the unknowns. */
void frot_over_changes(const frot_opening *p, const double *row, double *out);
/* x <- the change of the unknowns; and the other way round, of unknowns that are `apart`. */
void frot_from_changes(const frot_opening *p, const double *changes, double *x);
void frot_into_changes(const frot_opening *p, const double *apart, double *changes);

/* States of the unknowns in w->opening.state while guesses are met in turn: free (0), taken, and
 * moved now. */
enum { FROT_TAKEN = 1, FROT_MOVES_NOW = 2 };

#endif
