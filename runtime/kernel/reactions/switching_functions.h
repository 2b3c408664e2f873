/* The guards that say when the modes end: positive while they last. */
#ifndef FROT_SWITCHING_FUNCTIONS_H
#define FROT_SWITCHING_FUNCTIONS_H

#include "model/workspace.h"

/* Guards are numbered: of contact i its gap while it is open, its reaction while that must keep its
 * sign; of each element what it can resist less what it does, both ways, at rest, and its
 * motion while it slips, with each reaction of its pin along a reference direction; then the
 * conditions. Those that can fall in `modes` are listed in w->guards.list, their number in
 * w->guards.count.
 */
void frot_list_guards(const frot_model *m, const frot_state *s, frot_work *w,
                      const frot_contact_mode *modes);

/* Values of the listed guards after frot_reactions. `scale` (may be NULL): the sizes of their
 * terms; those of reactions are by w->core.row_load. */
void frot_guards(const frot_model *m, const frot_state *s, frot_work *w, const double *q,
                 const double *v, const double *d, const frot_contact_mode *modes, double *guard,
                 double *scale);

/* Forget how large `count` guards from `first` on were, and what rounding did to them: in another
 * mode they are something else, in other units. */
void frot_forget_guards(const frot_model *m, frot_state *s, int first, int count);

/* Whether a listed guard is a reaction, so that `scale` needs w->core.row_load. */
int frot_guards_read_loads(const frot_model *m, const frot_work *w, const frot_contact_mode *modes);

/* Size of the terms of a row's reaction by all loads, from w->core.row_load. */
double frot_reaction_size(const frot_model *m, const frot_work *w, int row);

/* Whether the k-th reaction that bounds the pin of element e in w->core.lam is more than zero in
 * the terms it had. */
int frot_has_direction(const frot_model *m, const frot_state *s, const frot_work *w, int e, int k);

/* Turn the reference directions of the pins' reactions to what they are in w->core.lam. The size of
 * a reaction has a corner where it passes through zero: while a pin slips, its second guard is its
 * reaction along the reference, so that no step goes over the corner. */
void frot_turn_references(const frot_model *m, frot_state *s, const frot_work *w);
/* Turn those round that have fired and whose reaction passes through zero in `modes`, after
 * frot_dynamics at the event. Of one that is as small for long it is not known to pass. */
void frot_flip_pin_references(const frot_model *m, frot_state *s, frot_work *w,
                              const frot_contact_mode *modes);

/* Whether the sign of a bilateral reaction matters: friction follows it. */
int frot_sign_matters(const frot_model *m, const frot_contact_mode *modes, int contact);

/* Whether listed guard k is a force that holds: the reaction of a closed contact, the margin of a
 * bound of rest, or a pin's reaction in its direction; not a gap nor a speed. */
int frot_guard_is_force(const frot_model *m, const frot_state *s, const frot_work *w, int k);

/* The element whose slip guard j follows in the modes of the state, or -1. */
int frot_slip_of_guard(const frot_model *m, const frot_state *s, const frot_work *w, int j);

/* The guard of condition j as d says it holds, by its value at the last evaluation. */
double frot_condition_value(const frot_work *w, const double *d, int j);

/* What rounding does to guard j during a step h: to its value, and to a slip by the speeds it is
 * made of. */
double frot_guard_rounding(const frot_model *m, const frot_state *s, const frot_work *w, int j,
                           double h);

/* Scratch of guards from the arena. */
void frot_bind_guards(const frot_model *m, const frot_layout *l, frot_guard_work *w, frot_arena *a);

#endif
