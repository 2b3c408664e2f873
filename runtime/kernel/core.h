/* The core system A z = h + E lam and its rows, at one place of the motion. */
#ifndef FROT_CORE_H
#define FROT_CORE_H

#include "state.h"

/* Kinetic and potential energy at (t, q, v, d); zero where the model has none. */
int frot_energies(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, double energy[2]);

/* Point w->arg at the arguments that all functions of the state begin with. */
void frot_inputs(const frot_model *m, frot_state *s, frot_work *w, const double *t, const double *q,
                 const double *v, const double *d);

/* Solve the blocks, evaluate the generated `dynamics` at (t, q, v, d), factor A and form the
 * responses W = J A^-1 E and the free accelerations J A^-1 h + c of the rows of the contacts that
 * are closed in `modes`. FROT_OK or a status that is not recorded as a fault. */
int frot_dynamics(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                  const double *v, const double *d, const frot_contact_mode *modes);

/* Solve the blocks and evaluate `kinematics` alone: gap, rows, rate, condition. */
int frot_kinematics(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, const double *d);

/* Cholesky factor of the metric of speeds into w->factor (order nm), after frot_dynamics; it is
 * there already where the core is symmetric. FROT_OK or FROT_SINGULAR. */
int frot_metric(const frot_model *m, frot_work *w);

/* The solution w->a of the core from w->lam; accelerations of frozen speeds are exactly zero. */
void frot_accelerations(const frot_model *m, frot_work *w, const double *frozen);

/* Sizes of the terms of J v in a row and of the motion of a gap by all coordinates, for the
 * comparison with zero; after frot_kinematics. */
double frot_row_size(const frot_model *m, const frot_work *w, int row, const double *v);
double frot_gap_size(const frot_model *m, const frot_work *w, int row, const double *q);

/* Speed of a row if all motion went into it: for the comparison of a speed with zero. Uses w->rows
 * and the metric of the last frot_dynamics, factored. */
double frot_row_speed(const frot_model *m, frot_work *w, int row, const double *v);

/* What all loads could do to the rows of closed contacts (w->row_load), after frot_dynamics at the
 * same place: accelerations that their sum is compared with, for it may cancel. */
void frot_row_loads(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                    const double *v, const double *d, const frot_contact_mode *modes);

/* Note how large loads have been, after frot_dynamics. */
void frot_note_push(const frot_model *m, frot_state *s, const frot_work *w);
/* Acceleration of a speed that is large against rounding by all loads so far. */
double frot_push_on(const frot_model *m, const frot_state *s, const frot_work *w, int speed);

/* Whether the relative speed of a row follows from no speed: both sides are prescribed. */
int frot_is_prescribed(const frot_model *m, const frot_work *w, int row);
/* Prescribed rates and their rates below this are rest (SI): there is nothing to compare with. */
#define FROT_PRESCRIBED_REST 1e-12

/* Whether all numbers are finite. */
static inline int frot_all_finite(const double *x, int n) {
  double sum[4] = {0, 0, 0, 0}; /* so that no addition waits for the one before */
  int i = 0;
  for (; i + 4 <= n; i += 4)
    for (int k = 0; k < 4; k++) sum[k] += x[i + k] - x[i + k];
  for (; i < n; i++) sum[0] += x[i] - x[i];
  return sum[0] + sum[1] + sum[2] + sum[3] == 0;
}

#endif
