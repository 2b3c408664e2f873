/* The point of least norm of a polyhedron, and the inequalities that are zero all over it. */
#ifndef FROT_POLYHEDRON_POINT_H
#define FROT_POLYHEDRON_POINT_H

/* A x = b, G x >= g: `equations` rows of a and `inequalities` rows of g_rows, n each, by rows. The
 * unknown j is measured in units unit[j] * size. slack[i]: how far inequality i may be missed. */
typedef struct {
  int n, equations, inequalities;
  const double *a, *b, *g_rows, *g, *slack;
  const double *unit;
  double size;
} frot_polyhedron;

/* Doubles and integers of scratch that a polyhedron with up to so many rows takes. */
int frot_polyhedron_doubles(int n, int equations, int inequalities);
int frot_polyhedron_integers(int n, int inequalities);

/* Why a polyhedron has no point: NEAR, none within 1e7 of its size. */
enum { FROT_NO_POINT = 1, FROT_NO_POINT_NEAR = 2 };

/* x <- the point of least norm in those units: least distance programming by one nonnegative least
 * squares (C. Lawson, R. Hanson 1974, chapter 23). *redundant: equations that depend on others.
 * Returns 0, or why there is none, but for slack. */
int frot_polyhedron_point(const frot_polyhedron *p, double *x, int *redundant, double *doubles,
                          int *integers);

/* Of the inequalities that are zero at the point x (zero[i] = 1), keep those that are zero at every
 * point: multipliers that are not negative take them away (A. Tucker 1956). */
void frot_implicit_equalities(const frot_polyhedron *p, const double *x, unsigned char *zero,
                              double *doubles, int *integers);

/* basis (n x n, by rows) <- orthonormal directions in which the equations leave x free. Returns
 * their number. */
int frot_free_directions(const frot_polyhedron *p, double *basis, double *doubles);

#endif
