/* The mass matrix of a large tree of bodies, which is never formed: A = L L' along its steps.
 *
 * Towards the ground each step keeps the inertia P that what is beyond it shows while its speeds
 * are free (articulated bodies: R. Featherstone, Rigid Body Dynamics Algorithms, 2008, sect. 7.2).
 * With the column S of a speed, D = S' P S and Y = P S / sqrt(D), its freedom leaves P - Y Y'. That
 * is the factor L (innovations: G. Rodriguez, K. Kreutz-Delgado, IEEE Trans. Robot. Autom. 8, 1992,
 * 65-75): L^-1 goes inwards and carries forces, L'^-1 goes outwards and carries motions, each in
 * time proportional to the number of steps. Of P only one triangle is kept, so that it stays
 * symmetric: from some twenty links on rounding would grow without bound else.
 *
 * Twists and wrenches are about the origin of their step, along ground axes: what turns, then what
 * moves; three components in the plane (g->width = 3: about z, x, y), six in space. Data of a step:
 * columns (width each), the vector from the step before (2 or 3), mass, moment (2 or 3), inertia
 * (1, or xx xy xz yy yz zz), the wrench that keeps its motion (width). Of the factor a step has,
 * for each speed, Y (width) and 1 / sqrt(D); an auxiliary one, which reads what passes there, P and
 * the wrench (width) of the forces of the speeds beyond. */
#ifndef FROT_ARTICULATED_H
#define FROT_ARTICULATED_H

#include "frot.h"

/* Numbers of scratch that a step takes: `inertia` (packed by triangle) and `twist`. */
#define FROT_STEP_INERTIA 21
#define FROT_STEP_TWIST 6

/* The factor, and in place of the generalized forces `force` (n_speeds): L^-1 (force - what the
 * wrenches do). Returns 0, or 1 when the inertia of a speed is nothing but rounding. */
int frot_tree_factor(const frot_group *g, const double *data, double *factor, double *inertia,
                     double *twist, double *force);

/* x <- L^-1 x and x <- L'^-1 x (n_speeds). */
void frot_tree_forward(const frot_group *g, const double *data, const double *factor, double *twist,
                       double *x);
void frot_tree_backward(const frot_group *g, const double *data, const double *factor,
                        double *twist, double *x);

/* x (n) <- the accelerations that the factor's `force` and forces x make together, and of auxiliary
 * unknowns what they make of these. `wrench` and `motion`: scratch, as `twist`. */
void frot_tree_respond(const frot_group *g, const double *data, const double *factor,
                       double *wrench, double *motion, const double *force, double *x);

/* x <- M x (n): what unknowns, auxiliary ones among them, make of momenta. */
void frot_tree_times(const frot_group *g, const double *data, double *twist, double *x);

/* The diagonal of M (n). */
void frot_tree_diagonal(const frot_group *g, const double *data, double *inertia, double *diagonal);

/* v' M v of speeds (nv, at their places in the model). */
double frot_tree_square(const frot_group *g, const double *data, double *twist, const double *v);

#endif
