/* Reactions that mechanics does not determine: the point of least norm among the admissible ones.
 */
#ifndef FROT_CONE_POINT_H
#define FROT_CONE_POINT_H

/* A bound on `n` of the unknowns: |x[at .. at + n)| <= ratio * (its bounding unknown), or <= ratio
 * where nothing bounds it. */
typedef struct {
  int at, n;
  int bounding; /* a cone by its place, or -1: `ratio` is the bound */
  double ratio;
} frot_ball;

/* An unknown x[at] that is not negative, and bounds the balls that name it. */
typedef struct {
  int at;
} frot_cone;

/* minimise |x|^2 / 2  over  A x = b  and the balls and cones. A is rows x n by rows; each unknown
 * belongs to at most one ball or cone, others are free. The unknowns are in units in which their
 * squares compare. */
typedef struct {
  int n, rows, n_cones, n_balls;
  const double *a, *b;
  const frot_cone *cones;
  const frot_ball *balls;
  double tolerance; /* by which a row of A x = b may be missed, over |b| + |row| |x| */
} frot_cone_problem;

/* Doubles of scratch that a problem takes. */
int frot_cone_scratch(int n, int rows);

/* x (n) <- the point of least norm. x = P(A' y), P the projection onto the convex set of the balls
 * and cones, y the multipliers, from the value in y on (rows): Newton's method on A P(A' y) = b,
 * the gradient of a concave function (J.-B. Hiriart-Urruty, J.-J. Strodiot, V. Nguyen 1984).
 * Returns 0, or 1 where no point is found: the set is empty, or no wider than rounding. `scratch`:
 * frot_cone_scratch doubles. */
int frot_cone_point(const frot_cone_problem *problem, double *x, double *y, double *scratch);

/* x <- its projection onto the balls and cones. */
void frot_project_cones(const frot_cone_problem *problem, double *x);

#endif
