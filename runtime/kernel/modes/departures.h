/* Motions of a component at an instant: enumeration.h, and again as what departs asks for. */
#ifndef FROT_DEPARTURES_H
#define FROT_DEPARTURES_H

#include "modes/enumeration.h"

/* Look for motions of the component `chosen`; the modes of the one preferred into w->search.best,
 * and whether it lasts into w->search.lasts. Returns how many there are; *unsearched: whether
 * others were not looked for.
 *
 * Friction that follows the size of pins' reactions may have several solutions in the same modes:
 * where those that go on from before lead nowhere others are looked for, from directions all
 * around. */
int frot_look_for_motions(const frot_instant *in, const int *chosen, int count, int *unsearched);

/* The same with the frictions of in->resists alone, and with nothing that has departed. */
int frot_search_lasting(const frot_instant *in, const int *chosen, int count, int *unsearched);

/* contact_search.c. Whether a component has slips of several components, whose motion is found by
 * Newton's method. */
int frot_slips_in_space(const frot_instant *in, const int *chosen, int count);

/* Give them the modes in which the instant is evaluated, into w->search.best: rest where they are
 * zero, else the slip that they have. */
void frot_begin_slips_in_space(const frot_instant *in);

/* The motion of such a component: its modes into w->search.best, directions of slips that begin
 * into the state's `heading`. Returns 1, or 0 where none is found. */
int frot_find_contact_motion(const frot_instant *in, const int *chosen, int count);

#endif
