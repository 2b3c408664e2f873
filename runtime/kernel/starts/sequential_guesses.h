/* Guesses met one after the other, each by the unknowns that those before leave. */
#ifndef FROT_SEQUENTIAL_GUESSES_H
#define FROT_SEQUENTIAL_GUESSES_H

#include "assembly/start_equations.h"

/* States of the unknowns meanwhile, w->opening.state: free (0), taken, and moved now. */
enum { FROT_TAKEN = 1, FROT_MOVES_NOW = 2 };

/* p->x, from w->opening.begin on <- where the guesses of the part are met in turn: the vector that
 * follows from the fewest unknowns first, by these alone and from several beginnings, then the one
 * that follows from the fewest others. What is guessed of each body of a tree is met so from the
 * ground outwards. Returns 0 where one is not met: what contradicts itself is missed least
 * together.
 */
int frot_meet_in_turn(frot_opening *p);

#endif
