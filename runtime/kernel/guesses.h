/* Guesses of places: which of several places is meant.
 *
 * A loop goes together in several ways, and a chain that is guessed to reach a point bends to
 * either side. Where the search from the beginning comes to a place that misses the guesses, one
 * near them is looked for by following guesses, statements and liaisons all at once. */
#ifndef FROT_GUESSES_H
#define FROT_GUESSES_H

#include "statements.h"

/* Mean square of what guesses are missed by, in parts, at which they are met; and how much less a
 * place, or a way on from it, must miss them than another to be meant rather. */
#define FROT_GUESS_MET 1e-18
#define FROT_GUESS_LESS 0.06

/* Mean square of what the guesses of places are missed by at p->q, INFINITY if that is no number.
 */
double frot_guesses_missed(frot_opening *p);

/* p->q <- a place at which guesses, statements and liaisons hold as far as they can together; a
 * fault is forgotten. The unknowns of the blocks begin as in w->opening.first. Returns 0 if none is
 * found.
 */
int frot_near_guesses(frot_opening *p);

/* The guesses of speeds at p->v: what they are missed by (w->relations.residual), the sizes of that
 * (w->relations.size); slopes and those of all items (w->relations.jacobian), which speeds may
 * follow (w->opening.scratch). Returns whether all are finite. */
int frot_look_at_guessed_speeds(const frot_opening *p);

/* Move speeds, all at p->velocity, so that they miss the guesses of what follows from them least,
 * with the least kinetic energy; what they would have to be far larger for says nothing, and so
 * does what is no number. FROT_OK or a status with a fault. */
int frot_follow_guessed_speeds(frot_opening *p);

#endif
