/* The step that is being tried: from the length planned until its error is within its bound. */
#ifndef FROT_ATTEMPT_H
#define FROT_ATTEMPT_H

#include "model/workspace.h"

typedef struct {
  double t, h, longest;
  double beyond;               /* how far after that of its stages its end is */
  double first;                /* its length at first */
  double stable;               /* most that the next one may be */
  double tried_h, tried_ratio; /* the length before, and its error over the bound; 0: none */
  double ratio;                /* of its error to the bound */
  double drowned;              /* what rounding made of its error, in parts of the motion, or 0 */
  double stubborn;             /* that ratio when sizes were last measured, or INFINITY */
  double loose; /* the same before its stages were put onto the relations of loops, or 0 */
  int to_due;   /* it ends where time changes a condition */
  int passed;   /* condition beyond which the last try had no value, or -1, at this */
  double part;  /* part of the step */
  int rejections, changed, stiff;
  int blurred, forced; /* its best length is tried again, and was, though that error is too large */
  double best, best_ratio;
  int laid;          /* times that it was laid anew between singular postures */
  double want, most; /* its length but for them, and what it may be at most */
  int guard,
      looks; /* the guard that is crossed first, or -1, at theta; looks at one that seems to dip */
  double theta;
  int dense;   /* whether its dense output is made: step.c */
  int refined; /* whether its end has gone on from that of its stages: event_location.h */
} frot_attempt;

/* An attempt that begins at t. */
frot_attempt frot_attempt_from(double t);

/* Evaluate at the start of the step and plan the length to try first. FROT_OK, with s->pending
 * where modes end there, or a status that is not recorded as a fault. */
int frot_begin_step(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a);

/* Shorten the step until its error is within its bound; it is then made, with its dense output if
 * a->dense, and a->guard is crossed first in it. FROT_OK with s->pending where there is none but an
 * event at its start; else the status of the fault recorded. */
int frot_find_length(const frot_model *m, frot_state *s, frot_work *w, frot_attempt *a);

#endif
