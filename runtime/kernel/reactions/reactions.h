/* Reactions in given modes. */
#ifndef FROT_REACTIONS_H
#define FROT_REACTIONS_H

#include "model/workspace.h"

/* Reactions w->core.lam of the rows of a group in `modes`, after frot_dynamics. Where at_rest
 * (n_elements, may be NULL) is nonzero, slip is resisted by the coefficient of rest. Where they are
 * not unique, those of least friction are taken and w->reactions.dependent is set. Returns 1 when
 * no finite reactions keep what `modes` says. */
int frot_group_reactions(const frot_model *m, frot_work *w, const frot_group *g,
                         const frot_contact_mode *modes, const unsigned char *at_rest);

/* The same where all reactions that are not unique weigh alike, but so that no two are weighed in a
 * simple ratio. */
int frot_even_reactions(const frot_model *m, frot_work *w, const frot_group *g,
                        const frot_contact_mode *modes, const unsigned char *at_rest);

/* The same for all groups. Directions of pins' reactions are looked for from w->reactions.along on.
 */
int frot_reactions(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                   const unsigned char *at_rest);

/* What an element can resist at rest, from the coefficients w->core.coefficient and w->core.lam. */
double frot_bound_of_rest(const frot_model *m, const frot_work *w, int element,
                          const frot_contact_mode *modes);

/* Acceleration of a row (of a reading: its reaction) by w->core.lam, and the size of its reactions'
 * terms. */
double frot_acceleration(const frot_model *m, const frot_work *w, int row, double *size);

/* Length of what loads and each of the reactions w->core.lam do to the group, in the metric of its
 * speeds: what its accelerations are the sum of. */
double frot_size_of_motion(const frot_model *m, const frot_work *w, const frot_group *g);

/* What rounding can do to a row's acceleration where loads and reactions cancel: a few units of the
 * last place of all that moves the group, without reactions and by each of them. */
double frot_row_rounding(const frot_model *m, const frot_work *w, int row);
/* The same where all that moves the group is known to have that length. */
double frot_rounding_of_motion(const frot_model *m, const frot_work *w, int row, double motion);
/* The same without reactions, of a row of that length. */
double frot_free_rounding(const frot_work *w, const frot_group *g, double length);

/* Size of the terms of a row's acceleration without reactions. */
double frot_free_size(const frot_model *m, const frot_work *w, int row);

/* Its scratch from the arena. */
void frot_bind_reactions(const frot_model *m, frot_reaction_work *r, frot_arena *a);

#endif
