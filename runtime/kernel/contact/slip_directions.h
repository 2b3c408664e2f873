/* The directions in which the slip of one contact with a plane of slips can begin or end. */
#ifndef FROT_SLIP_DIRECTIONS_H
#define FROT_SLIP_DIRECTIONS_H

/* One closed contact whose normal acceleration stays zero. Its normal reaction is N, its friction
 * f = -mu N d in the direction d of the slip, |d| = 1:
 *   0  = load_n + W_nn N + w_tn . f
 *   s' = load_t + w_tn N + W_tt f
 * A friction that a value b bounds has load_n = -1, W_nn = 1, w_tn = 0 and mu = b. A bilateral
 * contact with N < 0 has -mu. */
typedef struct {
  double load_n, load_t[2];      /* accelerations without N and f */
  double w_nn, w_tn[2], w_tt[4]; /* the Delassus matrix, w_tt by columns */
  double mu;
} frot_slip_contact;

/* A direction in which the slip keeps its direction: s' = rate d. */
typedef struct {
  double d[2];
  double rate;    /* above zero: a departure; below: an arrival */
  double normal;  /* N */
  double turning; /* of the angle of d off this direction, in the time dt/|s|: stable below zero */
} frot_slip_direction;

enum { FROT_MOST_SLIP_DIRECTIONS = 4, FROT_ANY_DIRECTION = -1 };

/* All directions in which s' is parallel to d: at most four, the roots of d x s' = 0, a
 * trigonometric polynomial of degree two in the angle of d. Returns their number, or
 * FROT_ANY_DIRECTION where each direction is one. Directions in which W_nn - mu w_tn . d is zero
 * are left out. */
int frot_slip_directions(const frot_slip_contact *contact,
                         frot_slip_direction found[FROT_MOST_SLIP_DIRECTIONS]);

/* N and s' of a slip in the direction d. */
void frot_slip_motion(const frot_slip_contact *contact, const double d[2], double *normal,
                      double acceleration[2]);

#endif
