/* Scratch of an evaluation, from the arena. */
#ifndef FROT_EVALUATION_WORKSPACE_H
#define FROT_EVALUATION_WORKSPACE_H

#include "model/workspace.h"

void frot_bind_core(const frot_model *m, const frot_layout *l, frot_core_work *w, frot_arena *a);
void frot_bind_blocks(const frot_model *m, const frot_extent *e, frot_block_work *w, frot_arena *a);

#endif
