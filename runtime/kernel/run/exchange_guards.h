/* Guards where another integrator steps the motion: which fire at the instant of an event.
 *
 * `values`: those of the guards listed. Of what has just changed only its rounding is below zero: a
 * guard that was not above zero after an event fires again once it has been, or once it is below by
 * more than a hundred tolerances; a gap once it closes. */
#ifndef FROT_EXCHANGE_GUARDS_H
#define FROT_EXCHANGE_GUARDS_H

#include "model/workspace.h"

/* Whether an element is the first of a slip of several components. */
int frot_slips_outside(const frot_model *m, const frot_contact_mode *modes, int e);
/* Its guard: how far it is from where it may end, or from where its beginning does. One that was
 * smaller than that and turned may end at a tenth of what it was. */
double frot_guard_in_space(const frot_model *m, const frot_state *s, const frot_work *w,
                           const frot_contact_mode *modes, int e);

/* Whether one that is so small, after frot_measure_slips, comes to zero and does not turn there, or
 * has passed it. */
int frot_has_vanished(const frot_model *m, const frot_work *w, int e);

/* The same, or how far it is from ten times its last size, or from 37 degrees beside its heading.
 * The friction turns with a slip at a rate in inverse proportion to it: what another integrator
 * knows of that is to be found anew. */
double frot_indicator_in_space(const frot_model *m, const frot_state *s, const frot_work *w,
                               const frot_contact_mode *modes, int e);

/* What tells where guard j with this value fires. Of one that was not above zero after the last
 * event its rounding is below: it changes sign where it is clearly below again. */
double frot_indicator(const frot_model *m, frot_state *s, frot_work *w, int j, double value);

/* Where reactions that are not unique have left their bounds (w->reactions.beyond), no guard tells
 * by itself that the modes end: those of the group's contacts and of its elements at rest do, among
 * `values` of all. */
void frot_mark_beyond(const frot_model *m, const frot_work *w, const frot_contact_mode *modes,
                      double *values);
/* End the modes of that group, once at an instant. Returns whether it has. */
int frot_end_beyond(frot_state *s, const frot_work *w);

/* Note the guards that are not above zero after what has happened, and those that are now. */
void frot_note_below(const frot_model *m, frot_state *s, const frot_work *w, const double *values);
void frot_see_above(const frot_model *m, frot_state *s, const frot_work *w, const double *values);
/* Whether one that was not above zero after the last event is clearly below. */
int frot_has_fallen_on(const frot_model *m, frot_state *s, frot_work *w, const double *values);

/* Whether contact i is open and has not been above zero since it parted. */
int frot_has_just_parted(const frot_model *m, frot_state *s, const frot_work *w, int i);
/* Whether such a gap, which the last evaluation tells, is below zero by nothing but the error of
 * the other integrator: it has not closed. */
int frot_is_inside_by_error(const frot_model *m, frot_state *s, frot_work *w, int i);

/* Fire those below zero. A slip that has come to zero as near as the other integrator can tell is
 * to be put at zero exactly: into w->search.zero. */
void frot_fire_below(const frot_model *m, frot_state *s, frot_work *w, const double *values);
/* Fire those that are clearly below zero after what has happened at this instant. */
void frot_fire_at_once(const frot_model *m, frot_state *s, frot_work *w, const double *values);
/* Fire the slips of several components that have come to zero, and those that do with them: into
 * w->search.zero, as above. */
void frot_fire_in_space(const frot_model *m, frot_state *s, const frot_work *w);
/* Fire the conditions that time changes now, and those that only inputs change. Returns how many.
 */
int frot_fire_others(const frot_model *m, frot_state *s, frot_work *w);

#endif
