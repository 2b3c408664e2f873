/* The conditions of the text: which hold at an instant, and when time alone changes them.
 *
 * A condition by motion changes where its value passes through zero inside a step: the guards
 * follow it, and its flag says its value right after. One by time changes at an instant known
 * before; one by events follows the discrete values and the other conditions. */
#ifndef FROT_CONDITIONS_H
#define FROT_CONDITIONS_H

#include "model/workspace.h"

/* What does not settle, in the value of a fault FROT_CHATTER of the text: conditions that have no
 * truth together, events that follow each other ever sooner; else how many rounds it took. */
#define FROT_NO_TRUTH (-1)
#define FROT_EVER_SOONER 0

/* The values of all conditions at (t, q, v), into w->core.condition; those that read the solution
 * in the present modes. FROT_OK or a status that is not recorded as a fault. */
int frot_evaluate_conditions(const frot_model *m, frot_state *s, frot_work *w, double t,
                             const double *q, const double *v);

/* Note the values of the conditions at (t, q, v), before anything happens at this instant: as long
 * as a value stays, so does what is known of its condition. */
int frot_note_conditions(const frot_model *m, frot_state *s, frot_work *w, double t,
                         const double *q, const double *v);

/* Move t and (q, v) on by a rounding of time, until the located conditions that fire have passed
 * through zero: so they hold truly after it, and no root or logarithm is left on the wrong side of
 * its switch. What the switch itself changes in their values may need a little more: as long as
 * before it they are zero to rounding, the instant is not known better. */
int frot_pass_conditions(const frot_model *m, frot_state *s, frot_work *w, double *t, double *q,
                         double *v);

/* Change the conditions that fire. One that is still as near to zero as events are located stays
 * what it has become until its value changes. */
int frot_change_conditions(const frot_model *m, frot_state *s, frot_work *w, double t,
                           const double *q, const double *v);

/* Look at every condition anew with the values at (t, q, v), until none changes. Leaves what
 * `frot_evaluate_conditions` gives there in w. FROT_OK or the status of the fault recorded:
 * conditions that change each other without end are FROT_CHATTER. */
int frot_settle_conditions(const frot_model *m, frot_state *s, frot_work *w, double t,
                           const double *q, const double *v);

/* Find the instant at which time next changes a condition, into s->due. */
void frot_find_time_event(const frot_model *m, frot_state *s, frot_work *w);

/* Fire the conditions that time changes at s->due. */
void frot_fire_time_event(const frot_model *m, frot_state *s);

/* Scratch of events from the arena; `edges`: figures have ends. */
void frot_bind_events(const frot_model *m, int edges, frot_event_work *w, frot_arena *a);

#endif
