/* Impacts of rigid bodies with friction: impulses and speeds after, in a time without length.
 *
 * Speeds of rows change by impulses, u' = W p'. A contact that closes with speed is compressed as a
 * spring whose stiffness is the same for all contacts, and gives back a part of what it has stored:
 *   compression  F' = -K u
 *   energetic    F' = -(K/e^2) u    it gives back e^2 of the work stored (W. Stronge 1990)
 *   poisson      F as a function of the impulse since, until that is e times that of compression
 *   newton       F as a function of u, until u = -e times the speed of approach
 * Coulomb's law acts at each instant within the impact: slips may end, reverse and begin again
 * (G. Darboux 1880, J. Keller 1986). One contact alone follows the impulse as its own time, so that
 * its stiffness does not matter; several share the impulse by their stored energies (C. Liu,
 * Z. Zhao, B. Brogliato 2008). */
#ifndef FROT_IMPACT_LAW_H
#define FROT_IMPACT_LAW_H

#include "contact/contact_newton.h"

enum frot_impact_rule { FROT_ENERGETIC = 0, FROT_POISSON = 1, FROT_NEWTON = 2 };

/* What a row or an element is in an impact.
 * FROT_ROW_HELD, FROT_ROW_READS, FROT_ROW_PRESSES: one row, as in contact_newton.h.
 * FROT_ROW_BALL: friction on `n` rows, of the coefficients `slipping` and `resting`, bounded by the
 * impulses x[bounding .. bounding + n_bounding), with their `norm` as in contact_newton.h.
 * `is_zero`: it does not slip, or close, before the impact, whatever rounding makes of its speed.
 */
typedef struct {
  int rule, at, n, bounding, n_bounding;
  double slipping, resting;
  int is_zero;
  double restitution; /* of PRESSES: e, and its rule */
  int law;
  int norm[3];
} frot_impact_block;

typedef struct {
  int rows, n_blocks;
  const double *w; /* rows x rows, by rows; columns of readings are zero */
  const frot_impact_block *blocks;
} frot_impact_problem;

enum frot_impact_status {
  FROT_IMPACT_SOLVED = 0,
  FROT_IMPACT_NO_MODES = 1, /* no motion within the impact satisfies the laws */
  FROT_IMPACT_ENDLESS = 2   /* the bodies do not come apart */
};

/* Doubles and integers of scratch. */
int frot_impact_doubles(int rows, int blocks);
int frot_impact_integers(int rows);

/* u (rows): the speeds before, then those after. p (rows): the
 * impulses. lost (n_blocks): the work that each block has taken. `driver`: a block PRESSES that
 * presses though its speed is zero (an impact without collision), or -1. *phases: how often slip,
 * stick or compression changed. Returns frot_impact_status. */
int frot_solve_impact(const frot_impact_problem *problem, int driver, double *u, double *p,
                      double *lost, int *phases, double *doubles, int *integers);

/* The block PRESSES of a contact at rest that its own friction presses, the more the longer its
 * slip continues (P. Painleve's coefficient W_nn - mu W_nt d is negative), by the largest part of
 * W_nn; -1 where there is none. `ended`: steps have ended where that is zero, for reactions grow
 * without bound. Arguments as above. */
int frot_jamming_contact(const frot_impact_problem *problem, int ended, double *u, double *p,
                         double *lost, double *doubles, int *integers);

#endif
