#include "record.h"

#include <math.h>

long long frot_events_at_once(const frot_model *m) {
  return 8 * m->n_contacts + 8 * m->n_conditions + m->n_outcomes + 8;
}

void frot_note(frot_recorder *recorder, frot_state *s, double t, int kind, int contact, int before,
               int after, int solutions) {
  s->statistics.events++;
  if (!recorder || recorder->event_count >= recorder->event_capacity) return;
  recorder->events[recorder->event_count++] =
      (frot_event){t, kind, contact, before, after, solutions, 0};
}

void frot_note_condition(const frot_model *m, frot_recorder *recorder, frot_state *s, double t,
                         int condition, int holds) {
  int told = m->conditions[condition].told;
  if (told == FROT_TOLD_ALWAYS || (told == FROT_TOLD_RISING && holds))
    frot_note(recorder, s, t, FROT_EVENT_CONDITION, condition, !holds, holds, 1);
}

void frot_note_changes(const frot_model *m, frot_state *s, double t,
                       const frot_contact_mode *before, const frot_contact_mode *after,
                       frot_recorder *recorder) {
  const double *unilateral = s->data + frot_layout_of(m).unilateral;
  for (int i = 0; i < m->n_contacts; i++) {
    const frot_contact_mode *a = &before[i], *b = &after[i];
    int from = frot_mode_value(a), to = frot_mode_value(b);
    if (from != to) {
      int kind = to == FROT_MODE_OPEN     ? FROT_EVENT_SEPARATION
                 : from == FROT_MODE_OPEN ? FROT_EVENT_CONTACT
                 : to == FROT_MODE_STICK  ? FROT_EVENT_STICK
                                          : FROT_EVENT_SLIP;
      frot_note(recorder, s, t, kind, i, from, to, 1);
    } else if (a->closed && a->friction != b->friction && a->friction > FROT_STICK &&
               b->friction > FROT_STICK) {
      frot_note(recorder, s, t, FROT_EVENT_REVERSAL, i, from, to, 1);
    }
    if (!a->closed || !b->closed) continue;
    if (a->rolling != b->rolling && a->rolling != FROT_NONE && b->rolling != FROT_NONE) {
      int kind = b->rolling == FROT_STICK   ? FROT_EVENT_ROLL_STOP
                 : a->rolling == FROT_STICK ? FROT_EVENT_ROLL_START
                                            : FROT_EVENT_ROLL_REVERSAL;
      frot_note(recorder, s, t, kind, i, a->rolling, b->rolling, 1);
    }
    if (a->side != b->side && unilateral[i] == 0)
      frot_note(recorder, s, t, FROT_EVENT_REACTION, i, from, to, 1);
  }
}

void frot_tell(const frot_model *m, frot_state *s, frot_recorder *recorder) {
  if (s->several) {
    frot_segment g = frot_segment_at(m, s->data + frot_layout_of(m).segment);
    int mode = frot_mode_value(&g.modes[s->several_at]);
    frot_note(recorder, s, *g.t0, FROT_EVENT_SEVERAL, s->several_at, mode, mode, s->several);
    s->several = 0;
  }
  if (!s->untold || !recorder) return;
  double *asked = s->data + frot_layout_of(m).asked;
  for (int i = 0; i < m->n_outcomes; i++) {
    if (isnan(asked[i])) continue;
    int ends = m->outcomes[i].kind == FROT_OUTCOME_TERMINATE;
    frot_note(recorder, s, asked[i], ends ? FROT_EVENT_TERMINATE : FROT_EVENT_WARNING, i, 0, 0, 1);
    asked[i] = NAN;
  }
  s->untold = 0;
}
