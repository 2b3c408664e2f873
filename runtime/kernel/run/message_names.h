/* Names in the sentences on events and faults. */
#ifndef FROT_MESSAGE_NAMES_H
#define FROT_MESSAGE_NAMES_H

#include "frot.h"
#include "model/model.h"
#include "numerics/tolerances.h"

/* The liaison's name, or "the model" for none. */
static inline const char *frot_contact_name(const frot_model *m, int contact) {
  return contact >= 0 && contact < m->n_contacts ? m->contacts[contact].name : "the model";
}

/* "at least " before a number of motions at which counting ends, else nothing. */
static inline const char *frot_at_least(int motions) {
  return motions >= FROT_MOST_MOTIONS ? "at least " : "";
}

#endif
