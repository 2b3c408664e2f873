/* Which contacts act on each other at an instant. */
#ifndef FROT_COMPONENTS_H
#define FROT_COMPONENTS_H

#include "search.h"

/* Of each contact that is closed in w->search.best, into w->search.component, a number that it
 * shares with those that its reactions act on through the masses, itself or by others; of the rest
 * -1. */
void frot_find_components(const frot_instant *in);

#endif
