/* The Jacobian of the rates of the states (q, v), and the matrix I/(h gamma) - J of an implicit
 * step. */
#ifndef FROT_JACOBIAN_H
#define FROT_JACOBIAN_H

#include "methods/linearize.h"
#include "model/workspace.h"

/* Scratch of the implicit step, in w->implicit.items and w->implicit.pivot. */
typedef struct {
  double *entries; /* of J: those of the pattern, or n x n */
  double *rate;    /* n: rates of the rates by time; of a motion nobody asks */
  double *factors; /* of I/(h gamma) - J */
  double *scale;   /* 2 x n: of a dense matrix */
  double *scratch; /* 2 x n */
  double *misfit;  /* guards: how far their polynomials are from them */
  double *slope_y, *block_q, *block_t, *block_y, *block_scale; /* with blocks */
  int *growth;                                                 /* 1: solutions are to be checked */
  int *pivot, *block_pivot;
  int *raised_by;                /* n: scratch of error_scales.c */
  frot_linearize_work linearize; /* of a motion */
} frot_jacobian;

/* The number of states: coordinates and speeds. */
static inline int frot_order(const frot_model *m) { return m->nq + m->nv; }

/* Whether there are accelerations or reactions. */
static inline int frot_has_motion(const frot_model *m) { return m->nv > 0 || m->n_rows > 0; }

/* The parts of the scratch; sizes in *doubles and *integers (may be NULL). */
frot_jacobian frot_jacobian_of(const frot_model *m, const frot_work *w, size_t *doubles,
                               size_t *integers);

/* Evaluate at (t, z, d) with the unknowns w->blocks.y of the blocks there; `slope` (nz) is scratch.
 * FROT_OK or the status of what fails. */
int frot_jacobian_at(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z,
                     const double *d, double *slope);

/* Factor shift I - J. Returns 0, or 1 when that is singular to rounding. */
int frot_jacobian_factor(const frot_model *m, frot_work *w, double shift);

/* x <- (shift I - J)^-1 b. */
void frot_jacobian_solve(const frot_model *m, const frot_work *w, const double *b, double *x);

/* Largest error of a solution in a row, in units of the size of the row's terms; 0 where pivots are
 * chosen by size. */
double frot_jacobian_error(const frot_model *m, const frot_work *w, double shift, const double *b,
                           const double *x);

/* For each state the part by which an implicit step h lets an error of its rate act less: one
 * more than the change by damping, and of a speed by stiffness, in the step. In scratch. */
const double *frot_jacobian_damping(const frot_model *m, const frot_work *w, double h);

/* y <- |J| x. */
void frot_jacobian_spread(const frot_model *m, const frot_work *w, const double *x, double *y);

/* A bound of the eigenvalues' sizes: the least norm by rows that is found with states in units of
 * size[j] and of sizes that follow from these by |J| (L. Collatz, H. Wielandt). */
double frot_jacobian_bound(const frot_model *m, const frot_work *w, const double *size);

#endif
