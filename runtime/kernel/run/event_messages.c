/* Events in words. */
#include <stdio.h>
#include <string.h>

#include "model/state.h"
#include "numerics/tolerances.h"
#include "run/message_names.h"

static const char *mode_name(int mode) {
  return mode == FROT_MODE_OPEN ? "open" : mode == FROT_MODE_STICK ? "stick" : "slip";
}

static const char *rolling_name(int mode) {
  return mode == FROT_STICK ? "held" : mode == FROT_NONE ? "free" : "rolling";
}

static const char *outcome_text(const frot_model *m, int outcome) {
  return outcome >= 0 && outcome < m->n_outcomes ? m->outcomes[outcome].text : "";
}

void frot_event_text(const frot_model *m, const frot_event *e, char *text, size_t size) {
  const char *name = frot_contact_name(m, e->contact);
  switch (e->kind) {
    case FROT_EVENT_CONDITION:
      snprintf(text, size,
               m->conditions[e->contact].told == FROT_TOLD_RISING ? "%s at t = %.17g"
               : e->after ? "%s: false -> true at t = %.17g"
                          : "%s: true -> false at t = %.17g",
               m->conditions[e->contact].text, e->t);
      return;
    case FROT_EVENT_REVERSAL:
      snprintf(text, size, "%s: slip reverses at t = %.17g", name, e->t);
      return;
    case FROT_EVENT_REACTION:
      snprintf(text, size, "%s: the reaction changes sides at t = %.17g", name, e->t);
      return;
    case FROT_EVENT_SEVERAL:
      snprintf(text, size, "%s: %s%d motions are admissible at t = %.17g; taken: %s", name,
               frot_at_least(e->solutions), e->solutions, e->t, mode_name(e->after));
      return;
    case FROT_EVENT_IMPACT:
    case FROT_EVENT_LAST_IMPACT:
    case FROT_EVENT_TANGENTIAL_IMPACT:
      snprintf(text, size, "%s: %simpact of %.6g %s at t = %.17g, %.6g J lost", name,
               e->kind == FROT_EVENT_TANGENTIAL_IMPACT ? "tangential " : "", e->impulse,
               m->contacts[e->contact].turns ? "N.m.s" : "N.s", e->t, e->lost);
      if (e->kind == FROT_EVENT_LAST_IMPACT)
        snprintf(text + strlen(text), size - strlen(text), "; further impacts end at t = %.17g",
                 e->until);
      return;
    case FROT_EVENT_PERCUSSION:
      snprintf(text, size, "%s at t = %.17g: %.6g N.s", outcome_text(m, e->contact), e->t,
               e->impulse);
      if (e->together > 0)
        snprintf(text + strlen(text), size - strlen(text), ", %.6g J of work", -e->lost);
      return;
    case FROT_EVENT_WARNING:
      snprintf(text, size, "warning: %s at t = %.17g", outcome_text(m, e->contact), e->t);
      return;
    case FROT_EVENT_TERMINATE:
      snprintf(text, size, "terminate: %s at t = %.17g", outcome_text(m, e->contact), e->t);
      return;
    case FROT_EVENT_ROLL_STOP:
    case FROT_EVENT_ROLL_START:
      snprintf(text, size, "%s: %s -> %s at t = %.17g", name, rolling_name(e->before),
               rolling_name(e->after), e->t);
      return;
    case FROT_EVENT_ROLL_REVERSAL:
      snprintf(text, size, "%s: rolling reverses at t = %.17g", name, e->t);
      return;
    default:
      snprintf(text, size, "%s: %s -> %s at t = %.17g", name, mode_name(e->before),
               mode_name(e->after), e->t);
  }
}
