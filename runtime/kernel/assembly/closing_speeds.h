/* Speeds at the start into contacts that touch. */
#ifndef FROT_CLOSING_SPEEDS_H
#define FROT_CLOSING_SPEEDS_H

#include "assembly/start_equations.h"

/* p->x <- the speeds nearest to p->x that meet the statements and the liaisons and approach no
 * contact of the part that is closed in `modes`; contacts that separate are opened there. Where the
 * statements themselves close contacts, the speeds that they say: the run begins with an impact.
 * FROT_OK or the status of the fault. */
int frot_stop_approach(frot_opening *p, frot_contact_mode *modes);

#endif
