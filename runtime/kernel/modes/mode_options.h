/* The modes that a contact and its elements may take at an instant. */
#ifndef FROT_MODE_OPTIONS_H
#define FROT_MODE_OPTIONS_H

#include "modes/enumeration.h"

#define FROT_OPTIONS 40 /* of one contact: two elements with four modes each, two sides, open */
#define FROT_LAWS_OF_CONTACT 3 /* elements of one contact at most */

/* Modes of a contact and of its elements. */
typedef struct {
  frot_contact_mode contact, element[FROT_LAWS_OF_CONTACT];
} frot_option;

/* Elements of a contact; returns how many. */
int frot_laws_of(const frot_model *m, int contact, int own[FROT_LAWS_OF_CONTACT]);

/* What contact i may do; `forced` as in frot_search. Returns how many there are. */
int frot_contact_options(const frot_instant *in, int i, int forced, frot_option *list);

/* Into w->search.trial. */
void frot_take_option(const frot_instant *in, int i, const frot_option *option);

#endif
