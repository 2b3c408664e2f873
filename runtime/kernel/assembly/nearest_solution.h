/* The least change: from values at which the statements hold to those nearest to the beginning. */
#ifndef FROT_NEAREST_SOLUTION_H
#define FROT_NEAREST_SOLUTION_H

#include "assembly/start_equations.h"

/* Note the masses at w->opening.begin: what changes are measured by. FROT_OK or a status without a
 * fault; p->q stays. */
int frot_note_beginning(frot_opening *p);

/* Measure changes by the masses noted there. */
void frot_measure_by_beginning(frot_opening *p);

/* Size of the change from w->opening.begin to p->q, by the masses there. */
double frot_change_size(frot_opening *p);

/* Bring coordinates within half a turn of w->opening.begin where no equation notices: whole turns
 * are of the way to a place, not of the place. */
void frot_unwind(frot_opening *p);

/* Go on from a place that is found to the nearest one to w->opening.begin or, with p->aim, to one
 * that misses the guesses least, as far as it can be followed. FROT_OK, or the status of a place
 * that cannot be found again. */
int frot_come_closest(frot_opening *p);

#endif
