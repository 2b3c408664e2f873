/* Projection of a motion onto its relations. */
#ifndef FROT_PROJECTION_H
#define FROT_PROJECTION_H

#include "model/workspace.h"

/* Move coordinates and speeds onto the relations that hold in `modes` and onto the invariants, by
 * the least change: in the metric of the speeds or, where there are invariants, in units of each
 * state's size. `stuck` (n_elements, may be NULL): elements whose motion is to be zero whatever
 * their mode. What is `frozen` (nv, may be NULL) does not move: other rows would move it by
 * rounding. *moved: whether anything moved. FROT_OK or a status that is not recorded as a fault.
 */
int frot_project(const frot_model *m, frot_state *s, frot_work *w, double t, double *q, double *v,
                 const double *d, const frot_contact_mode *modes, const unsigned char *stuck,
                 const double *frozen, int *moved);

/* Rows that hold in `modes` and act on the speeds themselves, into w->relations.rows; returns their
 * number. With `normals_only`, the relations between positions. */
int frot_holding_rows(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                      const unsigned char *stuck, int normals_only);

/* The same rows of one group into `rows`. */
int frot_rows_of_group(const frot_model *m, const frot_group *g, const frot_contact_mode *modes,
                       const unsigned char *stuck, int normals_only, int *rows);

/* The n rows H = L^-1 J' of a group in w->relations.rows made orthonormal, H = Q R, Q into
 * w->span.basis: into row i of w->linear.matrix the column i of R, into w->linear.pivot which of
 * them it is, or -1. A row that depends on those before it is left to them; of those after the
 * first `kept` also one that depends on them nearly, unless all that it moves is `frozen` (nv, may
 * be NULL). */
void frot_orthonormal_rows(const frot_model *m, frot_work *w, const frot_group *g, int n, int kept,
                           const double *frozen);

/* Scratch of orthonormal rows from the arena. */
void frot_bind_span(const frot_model *m, const frot_extent *e, frot_span_work *w, frot_arena *a);

#endif
