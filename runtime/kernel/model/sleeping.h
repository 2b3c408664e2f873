/* Islands (tables.h) that are awake: those that evaluations and steps look at.
 *
 * Outside frot_step all are. In a step those sleep that stand still at its start, or whose states
 * have stood still through the step before: they depend on nothing that moves, so that they stand
 * still until an event or a change from outside, after which all are awake. */
#ifndef FROT_SLEEPING_H
#define FROT_SLEEPING_H

#include "model/workspace.h"

/* Number all islands awake in w->awake; once for a block of scratch memory. */
void frot_list_all_islands(const frot_model *m, frot_work *w);

/* Let those of s that sleep sleep from here on, and all be awake again. */
void frot_enter_sleep(const frot_model *m, const frot_state *s, frot_work *w);
void frot_leave_sleep(frot_work *w);

/* Evaluations look at these islands and groups alone, until all are awake again. */
void frot_restrict_to_islands(frot_work *w, const int *islands, int n_islands, const int *groups,
                              int n_groups);

/* Nothing sleeps in the steps that follow. */
void frot_wake_all_islands(const frot_model *m, frot_state *s, frot_work *w);

/* The same from inside a step: implicit ones are of all states. */
void frot_wake_within_step(const frot_model *m, frot_state *s, frot_work *w);

/* With the slopes at the start of a step in w->step.k: note the islands that stand still there and
 * have no guard that is zero, nor conditions. Returns their number. */
int frot_note_resting_islands_at_start(const frot_model *m, frot_state *s, frot_work *w);

/* After an accepted step without an event, with its slopes in w->step.k and its end in x: note the
 * islands that stood still. Returns their number. */
int frot_note_resting_islands(const frot_model *m, frot_state *s, frot_work *w, const double *x);

/* Let those sleep that `asleep` (n_islands) says, where no step runs, until frot_leave_sleep. */
void frot_restore_sleep(const frot_model *m, frot_work *w, const double *asleep);

/* Awake states from one vector of all to another; from packed ones (dormand_prince.h) into all; and
 * back. What sleeps is left as it is. */
void frot_copy_awake(const frot_work *w, const double *from, double *to);
void frot_unpack_awake(const frot_work *w, const double *packed, double *all);
void frot_pack_awake(const frot_work *w, const double *all, double *packed);

/* Its scratch from the arena. */
void frot_bind_awake(const frot_model *m, const frot_layout *l, frot_awake_work *w, frot_arena *a);

#endif
