/* Guesses of places: which of several places is meant.
 *
 * A loop goes together in several ways, and a chain that is guessed to reach a point bends to
 * either side. Where the search from the beginning comes to a place that misses the guesses, one
 * near them is looked for by following guesses, statements and liaisons all at once. */
#ifndef FROT_GUESSES_H
#define FROT_GUESSES_H

#include "assembly/start_equations.h"

/* How much less, squared, a place, or a way on from it, must miss guesses than another to be meant
 * rather. */
#define FROT_GUESS_LESS 0.06

/* The places of all parts, where the search begins <- those nearest to them at which the guesses
 * hold, whatever the liaisons and the statements on several values; of guesses that do not hold
 * together one that misses them least, the items of a vector weighed alike. So neither the axes
 * that guesses are written in nor their order matter. Faults are forgotten. */
void frot_meet_guesses(frot_opening *p);

/* Whether a place is guessed in the part. */
int frot_has_guesses(const frot_opening *p);

/* What the guesses of the part are missed by at p->x, as changes that would remove them; INFINITY
 * if that is no number. And whether they are met, but for rounding. */
double frot_guesses_missed(frot_opening *p);
int frot_are_guesses_met(frot_opening *p);

/* On from p->x, where the equations hold, to the place near it that misses the guesses of the part
 * least; by how much, 0 but for rounding. */
double frot_least_missed(frot_opening *p);

/* w->opening.begin <- w->opening.met, where the guesses of the part are met; the rest stays. */
void frot_begin_as_met(const frot_opening *p);

/* p->x <- the place, of some that are found from w->opening.met and from elsewhere, at which the
 * equations of the part hold and its guesses are missed least; a fault is forgotten. Returns 0 if
 * none is found. */
int frot_find_other(frot_opening *p);

/* The guesses of speeds of the part at p->x: what they are missed by (w->relations.residual), the
 * sizes of that (w->relations.size); slopes and those of all items (w->relations.jacobian), which
 * speeds may follow (w->opening.scratch). Returns whether all are finite. */
int frot_look_at_guessed_speeds(const frot_opening *p);

/* Move the speeds of the part so that they miss the guesses of what follows from them least,
 * with the least kinetic energy; what they would have to be far larger for says nothing, and so
 * does what is no number. FROT_OK or a status with a fault. */
int frot_follow_guessed_speeds(frot_opening *p);

#endif
