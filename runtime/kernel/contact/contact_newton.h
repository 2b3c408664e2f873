/* One motion of bodies in contact: which contacts part, which slips begin, and in which direction.
 */
#ifndef FROT_CONTACT_NEWTON_H
#define FROT_CONTACT_NEWTON_H

/* The rule of one or more rows with reactions x and accelerations a = b + W x:
 * ABSENT  x = 0
 * HELD    a = 0
 * READS   x = a: a reaction that other reactions give
 * PRESSES x >= 0, a >= 0, x a = 0
 * BALL    |x| <= bound, and x = -bound a/|a| where a is not zero: rest, or a slip that begins
 * SLIDES  x = -bound d, of a slip in the direction d already
 * The bound is ratio times the length of the reactions x[bounding .. bounding + n_bounding), or the
 * ratio itself where n_bounding is zero. With a `norm` it is a sum of lengths, of so many of these
 * reactions each. */
enum frot_contact_rule {
  FROT_ROW_ABSENT,
  FROT_ROW_HELD,
  FROT_ROW_READS,
  FROT_ROW_PRESSES,
  FROT_ROW_BALL,
  FROT_ROW_SLIDES
};

typedef struct {
  int rule;
  int at, n; /* rows */
  int bounding, n_bounding;
  double ratio;
  double d[3]; /* of SLIDES */
  int norm[3];
} frot_contact_block;

typedef struct {
  int rows, n_blocks;
  const double *w;                  /* rows x rows, by rows */
  const double *b;                  /* rows */
  const frot_contact_block *blocks; /* each row belongs to one */
  double tolerance;                 /* of each equation, over the sizes of its terms */
  const double *terms;              /* rows: sizes of what b is a sum of, or NULL: b itself */
} frot_contact_equations;

/* Contacts that give a little share what is redundant: their give, as a part of the largest W, and
 * the tolerance of their equations. Rigid ones are found from there. */
#define FROT_GIVE 1e-5
#define FROT_GIVE_TOLERANCE 1e-9

/* The bound of a block by the reactions x. */
double frot_contact_bound(const frot_contact_block *block, const double *x);

/* Doubles, and integers, of scratch. */
int frot_contact_newton_doubles(int rows);
int frot_contact_newton_integers(int rows);

/* Newton's method on the natural map x = P(x - r a) (P. Alart, A. Curnier 1991), P the projection
 * onto what bounds x, from the x given, after `sweeps` of the fixed point x <- P(x - r a), block
 * after block. x and a (rows each) are the solution. Returns 0, or 1 where it is not found. */
int frot_contact_newton(const frot_contact_equations *problem, int sweeps, double *x, double *a,
                        double *doubles, int *integers);

#endif
