/* Which contacts act on each other at an instant. */
#ifndef FROT_CONTACT_COMPONENTS_H
#define FROT_CONTACT_COMPONENTS_H

#include "modes/enumeration.h"

/* Of each contact that is closed in w->search.best, into w->search.component, a number that it
 * shares with those that its reactions act on through the masses, itself or by others; of the rest
 * -1. */
void frot_find_components(const frot_instant *in);

/* What acts in the group of a component beside it, in the modes of w->search.best: of those that
 * are examined after it what they did until now. */
void frot_note_others(const frot_instant *in, const int *chosen, int count);

/* The accelerations w->core.a of w->core.lam of the component in the group, and of what acts beside
 * it: other contacts do nothing to its rows, but what drives these moves by them. Other groups
 * with rows move as they did until now. */
void frot_move_beside_others(const frot_instant *in, const frot_group *g);

#endif
