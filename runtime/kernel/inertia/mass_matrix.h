/* The mass matrix of a group, and its factor A = L L': dense, or along the steps of a tree. */
#ifndef FROT_MASS_MATRIX_H
#define FROT_MASS_MATRIX_H

#include "model/workspace.h"

/* Factor the matrix in w->core.mass of a group that is not general; w->core.force gets L^-1 h.
 * FROT_OK or FROT_SINGULAR. */
int frot_factor(frot_work *w, const frot_group *g);

/* x <- L^-1 x and x <- L'^-1 x (n_speeds), with the factor of the metric. */
void frot_inwards(const frot_work *w, const frot_group *g, double *x);
void frot_outwards(const frot_work *w, const frot_group *g, double *x);

/* x <- A^-1 (h + x) (n_speeds), of a group that is not general, and behind them what auxiliary
 * unknowns make of their momenta; one after the other, after frot_begin_responses. */
void frot_begin_responses(frot_work *w, const frot_group *g);
void frot_respond(const frot_work *w, const frot_group *g, double *x);

/* column (n_speeds) <- entries of the speeds in the column of the unknown k; returns that of k. */
double frot_mass_column(const frot_work *w, const frot_group *g, int k, double *column);

/* column (n) <- that of the unknown k in the whole matrix; of any group, of a mass matrix k is a
 * speed. */
void frot_whole_column(const frot_work *w, const frot_group *g, int k, double *column);

/* y <- A x for speeds x (n_speeds), and the diagonal of the whole matrix (n), of a group that is
 * not general. */
void frot_momenta(const frot_work *w, const frot_group *g, const double *x, double *y);
void frot_own_inertias(const frot_work *w, const frot_group *g, double *own);

/* Part of an acceleration of the group, which is not general, that rounding of its inertias may
 * make: a speed whose own inertia, where the others are free, is far below what its joint carries
 * loses the digits between them. */
double frot_masked_part(const frot_model *m, frot_work *w, const frot_group *g);

/* The column of the speed k of a group in the metric (n_speeds), until the next call. */
const double *frot_metric_column(frot_work *w, const frot_group *g, int k);

/* Square of speeds or accelerations (nv) of a group in the metric. */
double frot_square_of(const frot_work *w, const frot_group *g, const double *v);

#endif
