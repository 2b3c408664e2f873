/* The part of a scene that is being put together: nothing outside of it is moved or read.
 *
 * Its unknowns are p->x, numbered in the part; what the scene has of them, p->q or p->v, is what
 * they were when they were put there last. Equations are numbered in the part too: its statements,
 * its contacts that are to touch, its guesses. */
#ifndef FROT_START_PARTS_H
#define FROT_START_PARTS_H

#include "assembly/start_equations.h"

/* Take a part of the places or, with p->velocity, of the speeds; or leave it: of the whole scene
 * nothing is unknown, and all of it is evaluated. */
void frot_take_part(frot_opening *p, const frot_part *part);
void frot_leave_parts(frot_opening *p);

/* Put the unknowns into the scene. */
void frot_put(const frot_opening *p);

/* frot_kinematics of the part, at its unknowns. */
int frot_look_at_part(const frot_opening *p);

/* The number of a coordinate or speed of the scene in the part. */
static inline int frot_number_here(const frot_opening *p, int k) { return p->w->opening.number[k]; }
/* Whether unknown k is an angle that a speed turns. */
static inline int frot_is_angle(const frot_opening *p, int k) {
  int speed = p->w->opening.behind[k];
  return !p->velocity && speed >= 0 && frot_angle_of(p->m, speed) == p->part->reads.q[k];
}
/* The statement of equation i, ~s of one that is none of the text. */
static inline int frot_statement_of(const frot_opening *p, int i) {
  const int *of = p->velocity ? p->m->velocity_statement : p->m->position_statement;
  return of[p->part->stated[i]];
}

/* Keep the unknowns of the blocks of the part, or take them again. */
void frot_keep_blocks(const frot_opening *p, double *kept);
void frot_return_blocks(const frot_opening *p, const double *kept);

/* Evaluate a function of the part where the unknowns were put, the results of which are set. */
void frot_evaluate_part(const frot_opening *p, const frot_callable *function);

#endif
