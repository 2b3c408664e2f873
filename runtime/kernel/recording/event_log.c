#include "recording/event_log.h"

#include <math.h>

#include "model/indexing.h"

long long frot_events_at_once(const frot_model *m) {
  return 8 * m->n_contacts + 8 * m->n_conditions + m->n_outcomes + 8;
}

void frot_record_whole_event(frot_recorder *recorder, frot_state *s, const frot_event *event) {
  s->statistics.events++;
  if (!recorder) return;
  if (recorder->event_count >= recorder->event_capacity && recorder->drain)
    recorder->drain(recorder, recorder->context);
  if (recorder->event_count >= recorder->event_capacity) {
    recorder->lost++;
    return;
  }
  recorder->events[recorder->event_count++] = *event;
}

void frot_record_event(frot_recorder *recorder, frot_state *s, double t, int kind, int contact,
                       int before, int after, int solutions) {
  frot_event event = {.t = t,
                      .kind = kind,
                      .contact = contact,
                      .before = before,
                      .after = after,
                      .solutions = solutions};
  frot_record_whole_event(recorder, s, &event);
}

/* Record that the motion of an element begins, ends or reverses. */
static void record_element(frot_recorder *recorder, frot_state *s, double t, int kind, int contact,
                           int e, int before, int after) {
  frot_event event = {.t = t,
                      .kind = kind,
                      .contact = contact,
                      .before = before,
                      .after = after,
                      .solutions = 1,
                      .element = e + 1};
  frot_record_whole_event(recorder, s, &event);
}

/* The first sliding element of a contact that begins or ends to slip, -1: none. */
static int first_changed(const frot_model *m, const frot_contact_mode *before,
                         const frot_contact_mode *after, int contact) {
  for (int e = 0; e < m->n_elements; e++) {
    const frot_element *own = &m->elements[e];
    if (own->contact != contact || own->rolling || own->part > 0) continue;
    if ((frot_element_mode(m, before, e)->friction == FROT_STICK) !=
        (frot_element_mode(m, after, e)->friction == FROT_STICK))
      return e;
  }
  return -1;
}

void frot_record_condition(const frot_model *m, frot_recorder *recorder, frot_state *s, double t,
                           int condition, int holds) {
  int told = m->conditions[condition].told;
  if (told == FROT_TOLD_ALWAYS || (told == FROT_TOLD_RISING && holds))
    frot_record_event(recorder, s, t, FROT_EVENT_CONDITION, condition, !holds, holds, 1);
}

/* A change of an element's motion that its liaison's mode does not tell; `told`: that changes. */
static void note_element(const frot_model *m, frot_state *s, double t, int e, int before, int after,
                         int told, frot_recorder *recorder) {
  int i = m->elements[e].contact;
  if (before == after || before == FROT_NONE || after == FROT_NONE) return;
  if (m->elements[e].rolling) {
    int kind = after == FROT_STICK    ? FROT_EVENT_ROLL_STOP
               : before == FROT_STICK ? FROT_EVENT_ROLL_START
                                      : FROT_EVENT_ROLL_REVERSAL;
    record_element(recorder, s, t, kind, i, e, before, after);
  } else if (before > FROT_STICK && after > FROT_STICK) {
    record_element(recorder, s, t, FROT_EVENT_REVERSAL, i, e, FROT_MODE_SLIP, FROT_MODE_SLIP);
  } else if (!told &&
             m->elements[e].part == 0) { /* one of the axes of a liaison that has several */
    int stops = after == FROT_STICK;
    record_element(recorder, s, t, stops ? FROT_EVENT_STICK : FROT_EVENT_SLIP, i, e,
                   stops ? FROT_MODE_SLIP : FROT_MODE_STICK,
                   stops ? FROT_MODE_STICK : FROT_MODE_SLIP);
  }
}

/* The settled contact whose event is due first by t, that of `contact` at t itself; -1: none. */
static int first_settled(const frot_model *m, frot_state *s, double t, int contact) {
  frot_layout l = frot_layout_of(m);
  int first = -1;
  double soonest = INFINITY;
  for (int i = 0; i < m->n_contacts; i++) {
    const double *flight = frot_flight_of(s, &l, i);
    if (flight[FROT_UNTOLD] == 0 || !(flight[FROT_ENDS_AT] <= t || i == contact)) continue;
    double due = fmin(flight[FROT_ENDS_AT], t);
    if (first < 0 || due < soonest) first = i, soonest = due;
  }
  return first;
}

void frot_record_settled_contacts(const frot_model *m, frot_state *s, double t, int contact,
                                  frot_recorder *recorder) {
  if (s->settled == 0) return;
  frot_layout l = frot_layout_of(m);
  for (int i; (i = first_settled(m, s, t, contact)) >= 0;) {
    double *flight = frot_flight_of(s, &l, i);
    int mode = (int)flight[FROT_UNTOLD] - 1;
    flight[FROT_UNTOLD] = 0, s->settled--;
    frot_record_event(recorder, s, fmin(flight[FROT_ENDS_AT], t), FROT_EVENT_CONTACT, i,
                      FROT_MODE_OPEN, mode, 1);
  }
}

void frot_record_mode_changes(const frot_model *m, frot_state *s, double t,
                              const frot_contact_mode *before, const frot_contact_mode *after,
                              frot_recorder *recorder) {
  frot_layout l = frot_layout_of(m);
  const double *unilateral = s->data + l.unilateral;
  for (int i = 0; i < m->n_contacts; i++) {
    int from = frot_mode_value(m, before, i), to = frot_mode_value(m, after, i);
    if (from != to) {
      int kind = to == FROT_MODE_OPEN     ? FROT_EVENT_SEPARATION
                 : from == FROT_MODE_OPEN ? FROT_EVENT_CONTACT
                 : to == FROT_MODE_STICK  ? FROT_EVENT_STICK
                                          : FROT_EVENT_SLIP;
      double *flight = frot_flight_of(s, &l, i);
      if (kind == FROT_EVENT_SEPARATION) flight[FROT_MET] = t, flight[FROT_HAS_MET] = 1;
      frot_record_settled_contacts(m, s, t, i, recorder);
      if (kind == FROT_EVENT_CONTACT && flight[FROT_STAYS_CLOSED] != 0 && flight[FROT_ENDS_AT] > t)
        flight[FROT_UNTOLD] = 1 + to, s->settled++;
      else if (kind == FROT_EVENT_STICK || kind == FROT_EVENT_SLIP)
        record_element(recorder, s, t, kind, i, first_changed(m, before, after, i), from, to);
      else
        frot_record_event(recorder, s, t, kind, i, from, to, 1);
    }
    if (!before[i].closed || !after[i].closed) continue;
    int bounds = 0; /* a side that bounds nothing makes no difference, and is not followed */
    const frot_group *g = &m->groups[m->contact_group[i]];
    for (int k = 0; k < g->n_elements; k++) {
      int e = g->elements[k];
      if (m->elements[e].contact != i) continue;
      bounds = 1;
      note_element(m, s, t, e, frot_element_mode(m, before, e)->friction,
                   frot_element_mode(m, after, e)->friction, from != to, recorder);
    }
    if (bounds && before[i].side != after[i].side && unilateral[i] == 0)
      frot_record_event(recorder, s, t, FROT_EVENT_REACTION, i, from, to, 1);
  }
}

void frot_record_percussion(const frot_model *m, frot_recorder *recorder, frot_state *s, double t,
                            int percussion) {
  const double *blows = s->data + frot_layout_of(m).blows;
  const double *impulse = blows + 3 * percussion;
  double work = blows[3 * m->n_percussions + percussion];
  frot_event event = {.t = t,
                      .kind = FROT_EVENT_PERCUSSION,
                      .contact = m->percussions[percussion].outcome,
                      .solutions = 1,
                      .together = !isnan(work),
                      .impulse = hypot(hypot(impulse[0], impulse[1]), impulse[2]),
                      .lost = isnan(work) ? 0 : -work,
                      .vector = {impulse[0], impulse[1], impulse[2]}};
  frot_record_whole_event(recorder, s, &event);
}

/* The percussion of an outcome. */
static int percussion_of(const frot_model *m, int outcome) {
  int k = 0;
  while (m->percussions[k].outcome != outcome) k++;
  return k;
}

void frot_record_pending_events(const frot_model *m, frot_state *s, frot_recorder *recorder) {
  if (!s->several && (!s->untold || !recorder)) return;
  frot_layout l = frot_layout_of(m);
  frot_segment g = frot_segment_at(m, s->data + l.segment);
  for (int i = 0; i < m->n_contacts && s->several; i++) {
    int mode = frot_mode_value(m, g.modes, i), motions = (int)s->data[l.several + i];
    if (motions > 0)
      frot_record_event(recorder, s, *g.t0, FROT_EVENT_SEVERAL, i, mode, mode, motions);
    const double *start = frot_flight_of(s, &l, i);
    if (start[FROT_START_KIND] == 0) continue;
    frot_event event = {.t = *g.t0,
                        .kind = (int)start[FROT_START_KIND],
                        .contact = i,
                        .before = start[FROT_START_KIND] == FROT_EVENT_TANGENTIAL_IMPACT
                                      ? FROT_MODE_SLIP
                                      : FROT_MODE_OPEN,
                        .after = mode,
                        .together = 1,
                        .impulse = start[FROT_START_IMPULSE],
                        .lost = start[FROT_START_LOST]};
    frot_record_whole_event(recorder, s, &event);
  }
  s->several = 0;
  if (!s->untold || !recorder) return;
  double *requested = s->data + frot_layout_of(m).requested;
  for (int i = 0; i < m->n_outcomes; i++) {
    if (isnan(requested[i])) continue;
    int of = m->outcomes[i].kind;
    int kind = of == FROT_OUTCOME_TERMINATE ? FROT_EVENT_TERMINATE : FROT_EVENT_WARNING;
    if (of == FROT_OUTCOME_STRIKE)
      frot_record_percussion(m, recorder, s, requested[i], percussion_of(m, i));
    else
      frot_record_event(recorder, s, requested[i], kind, i, 0, 0, 1);
    requested[i] = NAN;
  }
  s->untold = 0;
}
