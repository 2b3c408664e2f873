/* Guesses met one after the other, each by the unknowns that those before leave. */
#ifndef FROT_SEQUENTIAL_GUESSES_H
#define FROT_SEQUENTIAL_GUESSES_H

#include "assembly/start_equations.h"

/* p->x, from w->opening.begin on <- where the guesses of the part are met in turn: the vector that
 * follows from the fewest unknowns first, by these alone and from several beginnings, then the one
 * that follows from the fewest others. What is guessed of each body of a tree is met so from the
 * ground outwards. One that is not met is missed least by its own unknowns; other beginnings are
 * then tried for none of those after it.
 */
void frot_meet_guesses_in_sequence(frot_opening *p);

#endif
