/* The distribution of redundant normal reactions that friction of motion reads: equal springs.
 *
 * Contacts that can part and bear give like equal springs on rigid bodies, N = J_n u, in the limit
 * of great stiffness. That is C N = 0, the rows of C a basis of the combinations of normal rows
 * that vanish beside the rows that do not give. */
#ifndef FROT_EQUAL_SPRINGS_H
#define FROT_EQUAL_SPRINGS_H

#include "reactions/force_problem.h"

/* The equations C lam = 0 of the unknowns of p after frot_hold_rows, into w->reactions.compatible
 * (unknowns, by rows), of contacts connected by redundancy of which one slides. Returns their
 * number. */
int frot_equal_springs(const frot_problem *p);

/* Whether reactions of contacts that give are not unique in `modes`, whatever slides. */
int frot_springs_are_redundant(const frot_model *m, frot_work *w, const frot_group *g,
                               const frot_contact_mode *modes);

/* A contact that slides, or -1. */
int frot_sliding_spring(const frot_problem *p);

/* The contact whose modes say that its reactions are `shared` and whose spring is stretched most,
 * to less than `least`, by the reactions lam (n_rows), or -1. */
int frot_stretched_spring(const frot_problem *p, const double *lam, double least);

/* The same by w->core.lam beyond rounding; else the contact that bears nothing though its spring is
 * pressed most, or -1. */
int frot_misplaced_spring(const frot_problem *p, const unsigned char *at_rest);

/* *force <- what the spring of a closed contact that bears nothing would bear by those of the
 * others, from w->core.lam: above zero where it is pressed. Returns whether the contact is
 * connected by redundancy to one that slides. */
int frot_spring_of_unloaded(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                            const unsigned char *at_rest, int contact, double *force);

#endif
