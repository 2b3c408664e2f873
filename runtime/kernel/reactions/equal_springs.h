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

/* Hold a row again that is left out as redundant, where `contact` bears nothing from now on and
 * held it: inside a step it is decided which rows are left out. */
void frot_hold_in_place_of(const frot_problem *p, const unsigned char *at_rest, int contact);

/* The contact whose modes say that its reactions are `shared` and whose spring is stretched most,
 * to less than `least`, by the reactions lam (n_rows), or -1. */
int frot_stretched_spring(const frot_problem *p, const double *lam, double least);

/* The same by w->core.lam beyond rounding; else the contact that bears nothing though its spring is
 * pressed most, or -1. */
int frot_misplaced_spring(const frot_problem *p, const unsigned char *at_rest);

/* Of a closed contact that bears nothing: others hold it, but none that slides is connected to it
 * by redundancy; one is; or it parts, for the rows of the others do not hold its own. */
enum frot_unloaded_spring { FROT_SPRING_ALONE, FROT_SPRING_BESIDE_SLIDING, FROT_SPRING_PARTS };

/* *force <- what the spring of such a contact would bear by those of the others, from w->core.lam:
 * above zero where it is pressed; 0 where it is not beside one that slides. */
enum frot_unloaded_spring frot_spring_of_unloaded(const frot_model *m, frot_work *w,
                                                  const frot_contact_mode *modes,
                                                  const unsigned char *at_rest, int contact,
                                                  double *force);

#endif
