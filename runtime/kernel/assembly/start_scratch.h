/* Scratch of the search for a start, from the arena. */
#ifndef FROT_START_SCRATCH_H
#define FROT_START_SCRATCH_H

#include "model/workspace.h"

/* Relations and their linear system; a projection uses them too. */
void frot_bind_relations(const frot_model *m, const frot_layout *l, const frot_extent *e,
                         frot_work *w, frot_arena *a);

/* `largest`: the largest number of each kind that a part of the scene has; its reads.nq is the
 * number of arguments. */
void frot_bind_opening(const frot_model *m, const frot_part *largest, const frot_extent *e,
                       frot_opening_work *w, frot_arena *a);

#endif
