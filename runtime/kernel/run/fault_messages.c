/* Faults in words. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "guards/conditions.h"
#include "model/state.h"
#include "events/parameter_change.h"
#include "numerics/tolerances.h"
#include "run/message_names.h"

/* The unit of what is left of a relation of a liaison, between positions or speeds. */
static const char *unit_of_gap(const frot_model *m, int contact, int speeds) {
  int turns = contact >= 0 && m->contacts[contact].turns;
  return speeds ? (turns ? "rad/s" : "m/s") : turns ? "rad" : "m";
}

static void initial_text(const frot_model *m, const frot_fault *f, char *text, size_t size) {
  const char *one = f->item >= 0 ? m->statements[f->item].text : "";
  const char *unit = f->contact >= 0 || f->item < 0 ? unit_of_gap(m, f->contact, f->other == -2)
                                                    : m->statements[f->item].unit;
  char by[64];
  snprintf(by, sizeof by, strcmp(unit, "1") == 0 ? "by %.3g" : "by %.3g %s", f->value, unit);
  if (f->value != f->value)
    snprintf(text, size, "the initial statement `%s` gives no finite number", one);
  else if (f->contact >= 0 && f->item < 0 && f->other != -3)
    snprintf(text, size,
             "no %s were found at which liaison '%s' holds together with the others: at the last "
             "ones tried %.3g %s are left",
             f->other == -2 ? "speeds" : "positions", frot_contact_name(m, f->contact), f->value,
             unit);
  else if (f->contact >= 0 && f->item < 0)
    snprintf(text, size,
             "no positions were found at which liaison '%s' holds together with the others: at "
             "best its %s stay %.3g %s apart",
             frot_contact_name(m, f->contact), f->where[0] != 0 ? "directions" : "places", f->value,
             f->where[0] != 0 ? "rad" : "m");
  else if (f->contact >= 0)
    snprintf(text, size,
             "the initial values contradict liaison '%s': `%s` puts the bodies into each other or "
             "off the liaison (%s)",
             frot_contact_name(m, f->contact), one, by);
  else if (f->other >= 0)
    snprintf(text, size, "the initial values contradict each other: `%s` and `%s` (%s)", one,
             m->statements[f->other].text, by);
  else
    snprintf(text, size,
             "the initial statement `%s` cannot hold together with the liaisons and the other "
             "statements (%s)",
             one, by);
}

/* A block of equations without a solution. */
static void block_text(const frot_model *m, const frot_fault *f, char *text, size_t size) {
  const char *name = f->item >= 0 && f->item < m->n_blocks ? m->blocks[f->item].name : "a block";
  if (f->value != 0)
    snprintf(text, size,
             "the equations for %s are singular at t = %.17g: they do not determine these unknowns "
             "there; look for an equation that says the same as another, or for a factor that is "
             "zero",
             name, f->t);
  else
    snprintf(text, size,
             "no solution of the equations for %s was found at t = %.17g: there is none near the "
             "last values; give start values nearer to one, or keep the motion away from there",
             name, f->t);
}

/* A figure without a tangent or a normal. */
static void vanished_text(const frot_model *m, const frot_fault *f, char *text, size_t size) {
  const frot_vanishing *lost = &m->vanishings[f->item];
  char where[128];
  snprintf(where, sizeof where, lost->where, f->where[0], f->where[1], f->where[2]);
  snprintf(text, size, "%s%s at t = %.17g", lost->text, where, f->t);
}

/* Words of a condition or, counted on from them, of a value that depends on what it was before. */
static const char *cause_name(const frot_model *m, int item) {
  if (item < m->n_conditions) return m->conditions[item].text;
  return item < m->n_conditions + m->n_held ? m->held[item - m->n_conditions].of : "";
}

static const char *cause_place(const frot_model *m, int item) {
  const char *place = item < m->n_conditions               ? m->conditions[item].place
                      : item < m->n_conditions + m->n_held ? m->held[item - m->n_conditions].place
                                                           : NULL;
  return place ? place : "";
}

/* Events of the text that do not settle. */
static void chatter_text(const frot_model *m, const frot_fault *f, char *text, size_t size) {
  const char *name = cause_name(m, f->item), *other = f->other >= 0 ? cause_name(m, f->other) : "";
  const char *what = f->value == FROT_NO_TRUTH ? "no truth of it agrees with what follows from it"
                     : f->value == FROT_EVER_SOONER
                         ? "it comes ever sooner, without end"
                         : "its events bring each other about without end";
  const char *mark = name[0] ? "`" : "", *mark2 = other[0] ? "`" : "";
  snprintf(
      text, size,
      "the events of the text do not settle at t = %.17g: %s%s%s%s%s%s%s%s%s; let the text end "
      "the run or change what it does there",
      f->t, mark, name, mark, other[0] ? " and " : "", mark2, other, mark2, name[0] ? ": " : "",
      what);
}

/* What a speed is the rate of, or else its own name. */
static const char *rated(const frot_model *m, int speed) {
  int of = m->speed_coordinate[speed];
  return m->states[of >= 0 ? of : m->nq + speed].name;
}

/* A loop that begins in a singular posture with speeds that do not say how it goes on
 * (start_branch.h).
 */
static void posture_text(const frot_model *m, const frot_fault *f, char *text, size_t size) {
  const char *name = frot_contact_name(m, f->contact);
  if (f->other >= 0 && m->states)
    snprintf(text, size,
             "liaison '%s': at the start, t = %.17g, the loop that it closes is in a singular "
             "posture, and several motions begin there: the rate of %s may be %.6g or %.6g",
             name, f->t, rated(m, f->other), f->where[0], f->where[1]);
  else
    snprintf(text, size,
             "liaison '%s': at the start, t = %.17g, the loop that it closes is in a singular "
             "posture, and no motion begins there with the speeds that are stated",
             name, f->t);
}

/* That a loop cannot stay closed: what is missed soon, of its places or of what is driven. */
static void reach_text(const frot_model *m, const frot_fault *f, char *text, size_t size) {
  char beyond[128];
  snprintf(beyond, sizeof beyond,
           "what time drives goes beyond the reach of the loop that it closes: from t = %.17g on",
           f->t);
  if (f->other >= 0)
    snprintf(text, size,
             "liaison '%s': %s `%s` is missed by at least %.3g in SI units %.3g s later",
             frot_contact_name(m, f->contact), beyond, m->statements[f->other].text, f->value,
             f->where[0]);
  else
    snprintf(text, size, "liaison '%s': %s its %s stay at least %.3g %s apart %.3g s later",
             frot_contact_name(m, f->contact), beyond, f->where[1] != 0 ? "directions" : "places",
             f->value, f->where[1] != 0 ? "rad" : "m", f->where[0]);
}

const char *frot_state_name(const frot_model *m, int state) {
  return m->states && state >= 0 && state < m->nq + m->nv ? m->states[state].name : "";
}

void frot_fault_text(const frot_model *m, const frot_state *s, char *text, size_t size) {
  const frot_fault *f = &s->fault;
  const char *name = frot_contact_name(m, f->contact);
  if (size == 0) return;
  switch (f->status) {
    case FROT_OK:
      text[0] = 0;
      return;
    case FROT_CHECK: {
      const frot_check *check = &m->checks[f->item];
      const char *rule =
          !isfinite(f->value)                   ? "it must be a finite number"
          : fabs(f->value) > FROT_LARGEST_GIVEN ? "that is more than can be computed with"
          : check->rule == FROT_POSITIVE        ? "it must be positive"
          : check->rule == FROT_NOT_NEGATIVE    ? "it must not be negative"
          : check->rule == FROT_NOT_ZERO ? "it must not be zero, for an equation is divided by it"
          : check->rule == FROT_NOT_BELOW_PREVIOUS
              ? "it must not be below the coefficient of motion"
          : check->rule == FROT_NOT_BELOW_MIN ? "it must not be below that"
          : check->rule == FROT_NOT_ABOVE_MAX ? "it must not be above that"
                                              : "it must be a finite number";
      snprintf(text, size, "the %s is %.15g: %s", check->subject, f->value, rule);
      return;
    }
    case FROT_INITIAL:
      initial_text(m, f, text, size);
      return;
    case FROT_IMPACT:
      if (f->item >= 0) {
        snprintf(text, size,
                 "liaison '%s': its figures, which touch, meet at a second place too at t = %.17g; "
                 "a liaison holds one place, so the run ends here",
                 name, f->t);
        return;
      }
      snprintf(
          text, size,
          "liaison '%s': the bodies meet at t = %.17g with a normal speed of %.6g m/s; no impulses "
          "satisfy the laws of the contacts that take part, so the run ends here",
          name, f->t, -f->value);
      return;
    case FROT_IMPASSE:
      snprintf(text, size,
               "liaison '%s': no admissible motion at t = %.17g (impasse), %s, so the run ends "
               "here; a smaller friction coefficient avoids it",
               name, f->t,
               s->options.on_impasse == FROT_IMPASSE_ENDS ? "and on_impasse = stop"
                                                          : "and no contact that its friction "
                                                            "presses");
      return;
    case FROT_SEVERAL:
      snprintf(text, size,
               "liaison '%s': %s%d motions are admissible at t = %.17g and on_indeterminate = stop",
               name, frot_at_least((int)f->value), (int)f->value, f->t);
      return;
    case FROT_CHATTER:
      if (f->item >= 0)
        chatter_text(m, f, text, size);
      else
        snprintf(text, size,
                 "the modes do not settle at t = %.17g (%d events at one instant): %s; change a "
                 "coefficient or the starting values a little",
                 f->t, (int)f->value,
                 m->n_contacts > 0 ? "conditions or laws of friction switch each other"
                                   : "conditions switch each other");
      return;
    case FROT_ALGEBRAIC:
      block_text(m, f, text, size);
      return;
    case FROT_EVENT_FAULT:
      snprintf(text, size, "%s (at t = %.17g)", m->outcomes[f->item].text, f->t);
      return;
    case FROT_NO_NORMAL:
      snprintf(text, size, "%s at t = %.17g", m->outcomes[f->item].text, f->t);
      return;
    case FROT_ASSERT:
      snprintf(text, size, "%s (assertion failed at t = %.17g)", m->outcomes[f->item].text, f->t);
      return;
    case FROT_REFUSED:
    case FROT_JUMP:
      frot_refusal_text(m, f, text, size);
      return;
    case FROT_INDEX: {
      const frot_watched *equation = &m->equations[f->item - m->n_loads];
      snprintf(
          text, size,
          "the branch that is taken at t = %.17g in the place of `%s` does not hold '%s', which "
          "the equation is solved for: the index of the equations changes with the branch",
          f->t, equation->name, equation->lacks);
      return;
    }
    case FROT_NAN:
      if (f->other >= 0) {
        snprintf(text, size, "the equations for %s give no finite number at t = %.17g",
                 m->blocks[f->other].name, f->t);
        return;
      }
      if (f->item >= m->n_loads + m->n_watched) {
        snprintf(text, size, "what follows from `%s` at t = %.17g is no finite number",
                 cause_name(m, f->item - m->n_loads - m->n_watched), f->t);
        return;
      }
      if (f->item >= m->n_loads) {
        snprintf(text, size,
                 "the equation `%s` gives no finite number at t = %.17g: look for a division by "
                 "zero, a root or a logarithm of a negative value",
                 m->equations[f->item - m->n_loads].name, f->t);
        return;
      }
      if (f->item >= 0) {
        snprintf(text, size, "force '%s' gives no finite number at t = %.17g",
                 m->loads[f->item].name, f->t);
        return;
      }
      if (f->contact >= 0) {
        snprintf(
            text, size,
            "'%s': a coefficient or a bound of friction is negative, below that of motion or no "
            "number at t = %.17g: give it an expression that stays positive",
            name, f->t);
        return;
      }
      snprintf(
          text, size,
          "a force, a coefficient or an output gives no finite number at t = %.17g: look for a "
          "division by zero, a root or a logarithm of a negative value",
          f->t);
      return;
    case FROT_DIVERGE:
      if (f->item == 1) {
        reach_text(m, f, text, size);
        return;
      }
      if (f->item == FROT_GROWS) {
        snprintf(text, size,
                 "'%s' grows without limit: it is %.3g at t = %.17g, and farther it cannot be "
                 "followed",
                 m->states ? m->states[f->other].name : "a state", f->value, f->t);
        return;
      }
      if (f->item >= 0) {
        snprintf(text, size,
                 "liaison '%s': time takes apart what it joins from t = %.17g on, and no body that "
                 "could follow is free to",
                 name, f->t);
        return;
      }
      if (f->other >= 0 && m->states) {
        snprintf(text, size,
                 "'%s' cannot be followed beyond t = %.17g: the step goes to zero, for its rate "
                 "grows without bound or jumps there",
                 m->states[f->other].name, f->t);
        return;
      }
      snprintf(text, size,
               "%s%s%s: the step goes to zero at t = %.17g: the reaction grows without bound "
               "(jamming) or a force is singular there",
               f->contact >= 0 ? "liaison '" : "", name, f->contact >= 0 ? "'" : "", f->t);
      return;
    case FROT_VANISHED:
      vanished_text(m, f, text, size);
      return;
    case FROT_POSTURE:
      if (f->item >= 0) {
        posture_text(m, f, text, size);
        return;
      }
      if (f->value == 0) { /* no step has been taken */
        snprintf(text, size,
                 "liaison '%s': at the start, t = %.17g, relations of the loop that it closes "
                 "depend on each other, and several motions begin there",
                 name, f->t);
        return;
      }
      snprintf(
          text, size,
          "liaison '%s': next to t = %.17g relations of the loop that it closes depend on each "
          "other, and they do not tell to rounding how it goes on",
          name, f->t);
      return;
    case FROT_SINGULAR:
      if (m->general) {
        snprintf(text, size,
                 "the equations of the motion are singular at t = %.17g: they do not determine the "
                 "accelerations and the unknowns that go with them; give every part that can move "
                 "a mass or an inertia, and look for an equation that says the same as another",
                 f->t);
        return;
      }
      snprintf(text, size,
               "the mass matrix is singular at t = %.17g: a motion is possible that moves no mass",
               f->t);
      return;
    case FROT_TOO_LARGE:
      snprintf(text, size,
               "liaison '%s': %d coupled liaisons change at once at t = %.17g, which is more than "
               "can be examined yet",
               name, (int)f->value, f->t);
      return;
    default:
      snprintf(text, size, "fault %d at t = %.17g", f->status, f->t);
  }
}

void frot_fault_places(const frot_model *m, const frot_state *s, char *text, size_t size) {
  const frot_fault *f = &s->fault;
  const char *places[3] = {"", "", ""};
  if (f->status == FROT_CHATTER && f->item >= 0) places[0] = cause_place(m, f->item);
  if (f->status == FROT_CHATTER && f->other >= 0) places[1] = cause_place(m, f->other);
  if (f->status == FROT_CHECK && f->item >= 0) places[0] = m->checks[f->item].place;
  if (f->status == FROT_NAN && f->item >= 0) {
    int past = f->item - m->n_loads - m->n_watched;
    places[0] = f->item < m->n_loads ? m->loads[f->item].place
                : past < 0           ? m->equations[f->item - m->n_loads].place
                                     : cause_place(m, past);
  }
  if (f->status == FROT_INDEX) places[0] = m->equations[f->item - m->n_loads].place;
  if (f->status == FROT_NAN && f->other >= 0) places[0] = m->blocks[f->other].place;
  if (f->status == FROT_DIVERGE && f->other >= 0 && m->states)
    places[0] = m->states[f->other].place;
  if (f->status == FROT_ALGEBRAIC && f->item >= 0) places[0] = m->blocks[f->item].place;
  int outcome = f->status == FROT_ASSERT || f->status == FROT_EVENT_FAULT;
  if ((outcome || f->status == FROT_NO_NORMAL) && f->item >= 0)
    places[0] = m->outcomes[f->item].place;
  if (f->status == FROT_VANISHED) places[0] = m->vanishings[f->item].place;
  if (f->status == FROT_REFUSED) places[0] = frot_refusal_place(m, f);
  if (f->status == FROT_INITIAL) {
    if (f->item >= 0) places[0] = m->statements[f->item].place;
    if (f->other >= 0) places[1] = m->statements[f->other].place;
  }
  if (f->contact >= 0 && f->contact < m->n_contacts) places[2] = m->contacts[f->contact].place;
  if (size > 0) snprintf(text, size, "%s\n%s\n%s", places[0], places[1], places[2]);
}
