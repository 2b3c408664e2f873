/* One search over the modes, from modes that are given. */
#ifndef FROT_BRANCH_AND_BOUND_H
#define FROT_BRANCH_AND_BOUND_H

#include "motion_search/motion_orders.h"

/* Add the motions whose modes agree with `given` (items) to the list, with the kinetic items of the
 * searcher. `budget`: nodes of the list up to which is searched; then complete is 0. */
void frot_branch(frot_searcher *s, const frot_item_state *given, int budget,
                 frot_motion_list *list);

#endif
