/* The step that is being tried: step.c, passage.c. */
#ifndef FROT_ATTEMPT_H
#define FROT_ATTEMPT_H

typedef struct {
  double t, h, longest;
  double first;  /* its length at first */
  double stable; /* most that the next one may be */
  double ratio;  /* of its error to the bound */
  double loose;  /* the same before its stages were put onto the relations of loops, or 0 */
  int to_due;    /* it ends where time changes a condition */
  int passed;    /* condition beyond which the last try had no value, or -1 */
  int rejections, changed, stiff;
  int blurred, forced; /* its best length is tried again, and was, though that error is too large */
  double best, best_ratio;
  int laid;          /* times that it was laid anew between singular postures */
  double want, most; /* its length but for them, and what it may be at most */
  int guard,
      looks; /* the guard that falls first, or -1, at theta; looks at one that seems to dip */
  double theta;
} frot_attempt;

#endif
