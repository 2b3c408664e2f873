/* The text's equations that no explicit formula solves, block after block. */
#ifndef FROT_ALGEBRAIC_LOOPS_H
#define FROT_ALGEBRAIC_LOOPS_H

#include "model/workspace.h"

/* Solve the blocks that are not late for w->blocks.y at (t, q, v, d): linear ones by elimination,
 * the others by Newton's method from the values w->blocks.y has, along its path as far as that
 * leads, rows scaled by the sizes of their terms. Conditions are as d says; where there is no
 * solution, those on a block's own unknowns as these say, so that what passes zero with a slope
 * without end has values beyond. `within` a step what belongs to another branch is none. FROT_OK,
 * FROT_ALGEBRAIC or FROT_NAN, with w->blocks.failed and w->blocks.singular; w->blocks.y is then of
 * no use. */
int frot_solve_blocks(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                      const double *v, const double *d);

/* The same for the late blocks, which read w->core.a and w->core.lam. */
int frot_solve_late(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, const double *d);

#endif
