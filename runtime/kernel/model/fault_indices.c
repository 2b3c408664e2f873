#include "model/fault_indices.h"

#include <limits.h>

/* The smallest and the largest index. */
typedef struct {
  int from, to;
} range;

static int contains(range r, int index) { return r.from <= index && index <= r.to; }

/* Entries of a table of so many, or -1 for none. */
static range entry(int count) { return (range){-1, count - 1}; }

/* Entries of a table that the sentence reads without asking whether there is one. */
static range required(int count) { return (range){0, count - 1}; }

/* Marks that are no index: the sentence only compares them. */
static range unread(void) { return (range){INT_MIN, INT_MAX}; }

int frot_fault_is_valid(const frot_model *m, const frot_fault *f) {
  const int causes = m->n_conditions + m->n_held, states = m->states ? m->nq + m->nv : 0;
  range item = unread(), other = unread();
  switch (f->status) {
    case FROT_CHECK:
      item = required(m->n_checks);
      break;
    case FROT_INITIAL:
      item = entry(m->n_statements), other = (range){-3, m->n_statements - 1};
      break;
    case FROT_CHATTER:
      item = other = entry(causes);
      break;
    case FROT_ALGEBRAIC:
      item = entry(m->n_blocks);
      break;
    case FROT_ASSERT:
    case FROT_NO_NORMAL:
    case FROT_EVENT_FAULT:
      item = required(m->n_outcomes);
      break;
    case FROT_INDEX:
      item = (range){m->n_loads, m->n_loads + m->n_watched - 1};
      break;
    case FROT_NAN:
      item = entry(m->n_loads + m->n_watched + causes), other = entry(m->n_blocks);
      break;
    case FROT_DIVERGE:
      other = f->item == 1            ? entry(m->n_statements)
              : f->item == FROT_GROWS ? required(states)
                                      : entry(m->nq + m->nv);
      break;
    case FROT_VANISHED:
      item = required(m->n_vanishing);
      break;
    case FROT_POSTURE:
      other = entry(m->nv);
      break;
    default: /* other sentences read no index, or ask first whether it is one */
      break;
  }
  return contains(entry(m->n_contacts), f->contact) && contains(item, f->item) &&
         contains(other, f->other);
}
