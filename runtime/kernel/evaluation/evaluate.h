/* The core system A z = h + E lam and its rows, at one place of the motion, group after group. */
#ifndef FROT_EVALUATE_H
#define FROT_EVALUATE_H

#include "model/indexing.h"
#include "inertia/mass_matrix.h"
#include "model/calls.h"

/* Kinetic and potential energy at (t, q, v, d), and the size of the terms that they are made of;
 * zero where the model has none. */
int frot_energies(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, double energy[3]);

/* Solve the blocks, evaluate the generated `dynamics` at (t, q, v, d), factor A and form for the
 * rows wanted of the contacts that are closed in `modes`: w->core.free, the acceleration (of a
 * reading: the reaction) without reactions of other rows, and w->core.delassus, what these do to
 * it; where nothing can part or slip, and no reading is wanted, or friction follows readings alone
 * (friction_fixed_point.c), only when frot_effects needs it. FROT_OK or a status that is
 * not recorded as a fault. */
int frot_dynamics(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, const frot_contact_mode *modes, int wanted);

/* The metric of the speeds alone, and its factors: A may be singular, and where a body has no
 * inertia in this place its entries are no numbers. FROT_OK or a status that is not recorded as a
 * fault. */
int frot_inertia(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                 const double *v, const double *d);

/* How much of that is there of a group. */
enum frot_formed { FROT_FACTOR, FROT_ROWS, FROT_EFFECTS };

/* What the rows wanted of a group do to each other, into w->core.delassus, with all that goes
 * before it, if it is not there. */
void frot_effects(const frot_model *m, frot_work *w, const frot_group *g);
/* The rows wanted by themselves: L^-1 J' and w->core.free. */
void frot_rows(const frot_model *m, frot_work *w, const frot_group *g);

/* Solve the blocks and evaluate `kinematics` alone: gap, rows, rate, condition. */
int frot_kinematics(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, const double *d);

/* Note the lengths that the gaps are made of, which rounding of rows is measured by; after
 * frot_kinematics there. They are held from event to event: as sizes they stay. */
void frot_note_reaches(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                       const double *v, const double *d);

/* Cholesky factors of the metrics of speeds into w->core.factor, after frot_dynamics; they are
 * there already where a group is a mass matrix. FROT_OK or FROT_SINGULAR. */
int frot_metric(const frot_model *m, frot_work *w);

/* Entry of the metric for two speeds, after frot_dynamics. */
double frot_metric_entry(const frot_model *m, frot_work *w, int a, int b);

/* The solution w->core.a of the core from w->core.lam; accelerations of frozen speeds are exactly
 * zero. */
void frot_accelerations(const frot_model *m, frot_work *w, const double *frozen);

/* change (nw) <- what the impulses w->core.lam do to the speeds, after frot_dynamics. */
void frot_speed_changes(const frot_model *m, frot_work *w, double *change);

/* Half the square of the speeds in the metric, after frot_dynamics. */
double frot_kinetic(const frot_model *m, const frot_work *w, const double *v);

#endif
