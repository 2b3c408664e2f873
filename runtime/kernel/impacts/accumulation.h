/* Infinitely many impacts in a finite time: their limit, and the contact after it. */
#ifndef FROT_ACCUMULATION_H
#define FROT_ACCUMULATION_H

#include "modes/enumeration.h"

/* Note how long the contacts that meet (w->impacts.meets) have been open, and whether that ends:
 * flights that grow shorter, each in the ratio r to the last T, end after T r/(1 - r). Once a
 * flight is no higher than what rounding tells from contact, or the tolerance, its contact stays
 * closed; so it does where another integrator goes
 * through longer flights without a step. Returns whether one of them is settled. */
int frot_note_flights(const frot_instant *in, const int *chosen, int count);

/* Whether a contact that parts with the speed u beside one that has settled has settled too. */
int frot_is_settled_beside(const frot_instant *in, int contact, double u);

#endif
