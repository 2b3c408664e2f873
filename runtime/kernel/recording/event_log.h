/* Events into the caller's recorder. */
#ifndef FROT_EVENT_LOG_H
#define FROT_EVENT_LOG_H

#include "model/state.h"

/* Count an event and record it, if there is a recorder. A full one is drained first; what finds no
 * room is counted as lost. */
void frot_record_whole_event(frot_recorder *recorder, frot_state *s, const frot_event *event);
void frot_record_event(frot_recorder *recorder, frot_state *s, double t, int kind, int contact,
                       int before, int after, int solutions);

/* Record that a percussion acts, with its impulse and what is known of its work: state->data at
 * layout.blows has the impulses (3 n_percussions), then the works (n_percussions), no number where
 * another one of the instant has them. */
void frot_record_percussion(const frot_model *m, frot_recorder *recorder, frot_state *s, double t,
                            int percussion);

/* Note that a condition of the text changes, if that is an event to the author. */
void frot_record_condition(const frot_model *m, frot_recorder *recorder, frot_state *s, double t,
                           int condition, int holds);

/* Note what differs between the modes before and after an instant. */
void frot_record_mode_changes(const frot_model *m, frot_state *s, double t,
                              const frot_contact_mode *before, const frot_contact_mode *after,
                              frot_recorder *recorder);

/* Record the contacts whose infinitely many impacts end by t, at their limits. That of `contact`
 * (-1: none) is recorded at t: another event of it comes before its limit. */
void frot_record_settled_contacts(const frot_model *m, frot_state *s, double t, int contact,
                                  frot_recorder *recorder);

/* Record what is still untold: several admissible motions at the start, outcomes of the text. */
void frot_record_pending_events(const frot_model *m, frot_state *s, frot_recorder *recorder);

#endif
