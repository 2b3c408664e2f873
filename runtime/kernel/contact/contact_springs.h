/* Redundant normal reactions of a motion: those of equal springs at the contacts that bear. */
#ifndef FROT_CONTACT_SPRINGS_H
#define FROT_CONTACT_SPRINGS_H

#include "contact/contact_newton.h"

/* Doubles of scratch. */
int frot_contact_springs_doubles(int rows);

/* W (rows x rows) with a give of each row that presses, a part of the largest W, and with `all` of
 * each law. Returns that give. */
double frot_soften(const frot_contact_equations *problem, double part, int all, double *w);

/* x and a (rows each) of a solution <- those in which rows that press give like equal springs: the
 * proximal point method (R. Rockafellar 1976), whose springs begin at the forces of the pass before
 * and are the more rigid with each. Returns 1 where they are not found; then x and a are scratch.
 */
int frot_contact_springs(const frot_contact_equations *problem, double *x, double *a,
                         double *doubles, int *integers);

#endif
