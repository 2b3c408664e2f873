/* Groups in which light bodies carry far heavier ones: their inertia in wide numbers.
 *
 * In the entries of A inertias of bodies add up. What a light body resists by itself is the rest
 * of those of heavy ones when all that these can follow is eliminated: their ratio is lost in
 * digits, in A as in articulated inertias. So where it is large, A, h and the rows are generated
 * and eliminated in wide numbers. After that nothing cancels any more: the factor, L^-1 h, L^-1 J'
 * and what rows and readings are made of are rounded to ordinary numbers, and all that follows
 * (modes, reactions, accelerations) is as everywhere. */
#ifndef FROT_EXTENDED_INERTIA_H
#define FROT_EXTENDED_INERTIA_H

#include "model/workspace.h"

/* Whether the inertia of a group loses digits that the model can give in wide numbers, after
 * frot_factor, which gave `status`. */
int frot_is_masked(const frot_model *m, const frot_state *s, const frot_work *w,
                   const frot_group *g, int status);

/* At the beginning of an evaluation: no island is evaluated, no group found in wide numbers. */
void frot_begin_wide(const frot_model *m, frot_work *w);

/* In wide numbers, at (t, q, v, d): the factor of the group and L^-1 h, rounded into w->core.
 * FROT_OK or FROT_SINGULAR. */
int frot_wide_factor(const frot_model *m, frot_state *s, frot_work *w, const frot_group *g,
                     double t, const double *q, const double *v, const double *d);

/* Then L^-1 J' of the `count` rows listed, of which `acting` act, their values without reactions
 * and what these do to each other: w->core.half, free and delassus. */
void frot_wide_rows(const frot_model *m, frot_work *w, const frot_group *g, int count, int acting);

/* Whether the last evaluation found a group so. */
static inline int frot_in_wide(const frot_model *m, const frot_work *w, const frot_group *g) {
  return w->wide.mass && w->wide.of[g - m->groups];
}

/* The inertia that acts at a reading of such a group while all speeds are free: the rest of all
 * that it carries. */
double frot_felt_inertia(const frot_model *m, frot_work *w, const frot_group *g, int row);

/* Its scratch from the arena, where a function in extended precision exists. */
void frot_bind_wide(const frot_model *m, const frot_layout *l, frot_wide_work *w, frot_arena *a);

#endif
