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

#endif
