/* The state within an impact, for the files of impact_law.h. */
#ifndef FROT_IMPACT_PARTS_H
#define FROT_IMPACT_PARTS_H

#include "contact/impact_law.h"

/* Of a contact: apart, in contact without speed, compressed further, let go. Of an element: at
 * rest, or in slip. */
enum frot_impact_state {
  FROT_PART_OPEN,
  FROT_PART_RIGID,
  FROT_PART_LOADING,
  FROT_PART_UNLOADING,
  FROT_PART_STICKS,
  FROT_PART_SLIPS
};

typedef struct {
  int state;
  double stored;     /* F^2 / 2 K */
  double approach;   /* speed before */
  double compressed; /* impulse of the compression */
  double mark;       /* impulse at the beginning of compression, or of restitution */
  double peak;       /* F at the beginning of restitution */
  double d[3];       /* direction of a slip that begins */
  int departs;       /* it has begun to slip within the impact: by the coefficient of slip */
} frot_impact_part;

typedef struct {
  const frot_impact_problem *given;
  double *u, *p;  /* rows: speeds and impulses */
  double *lost;   /* n_blocks: work taken */
  double *x, *a;  /* rows: p' and u' */
  double *b;      /* rows: u' by the springs */
  double *terms;  /* rows: sizes of what b is a sum of */
  double *soft;   /* rows x rows: W with a little give of each contact */
  double *force;  /* n_blocks: F of each contact */
  double *scale;  /* rows: sizes of speeds; those of impulses are scale / W_ii */
  double *stages; /* impact_springs.c */
  double *newton;
  int *pivot;
  frot_contact_block *now; /* n_blocks */
  frot_impact_part *parts; /* n_blocks */
  double stiffness;
  int phases, turns, steps; /* changes in all; those of contacts; steps of springs */
  int implicit;             /* 1: slips are stiff: impact_implicit.c */
  int implicit_steps;
  int alone; /* 1: one contact is pressed */
  int spent; /* 1: what is still pressed has next to no energy, and gives nothing back */
} frot_impact;

/* Part of its size below which a slip within an impact is zero. One of several components passes
 * zero at a distance, by the errors across it. */
static inline double frot_impact_zero(int components) { return components > 1 ? 1e-10 : 1e-12; }

static inline int frot_is_driven(const frot_impact_part *part) {
  return part->state == FROT_PART_LOADING || part->state == FROT_PART_UNLOADING;
}

/* Whether an element has no slip. One whose contact has parted may have any. */
int frot_sticks(const frot_impact *impact, int k);
/* Whether what bounds an element may press: its contact has not parted. */
int frot_can_rub(const frot_impact *impact, int k);

/* x, a <- impulses and speeds per unit of time at the speeds u and the forces `force`, with the
 * states as they are. Returns 1 where there are none. */
int frot_impact_rates(frot_impact *impact, const double *u);

/* Decide which slips begin or stay zero, and which contacts at rest part, with `force` as it is.
 * Returns 1 where no modes are found. */
int frot_decide_impact(frot_impact *impact);

/* The rate of a contact, which is zero where it is no more than rounding of its terms: a contact
 * that its friction holds does not move. */
double frot_impact_rate_of(const frot_impact *impact, const frot_impact_block *block);

/* Size of the slip of a block at the speeds u, and its direction d. */
double frot_impact_slip(const frot_impact_block *block, const double *u, double d[3]);

/* Size by which the speeds of a block are measured. */
double frot_impact_scale(const frot_impact *impact, const frot_impact_block *block);

/* Whether a contact gives back what it stores. Newton's rule asks it of one that approaches before
 * the impact; nothing does once the impact is spent. */
int frot_gives_back(const frot_impact *impact, int k);
/* A contact ends its compression, or its restitution, or begins another compression. */
void frot_end_compression(frot_impact *impact, int k);
void frot_end_restitution(frot_impact *impact, int k);
void frot_begin_compression(frot_impact *impact, int k);
/* The slip of an element, or the speed of a contact at rest, is zero now. */
void frot_put_at_rest(frot_impact *impact, int k);
/* Take from the speeds by the least impulses the rests of those that are zero: rows that depend
 * on each other stay so. `first`: also those that are zero before
 * the impact, of which rounding alone is taken. */
void frot_bring_to_rest(frot_impact *impact, int first);

/* One phase by the impulse of the contact `driver` alone, in which all rates are constant. Returns
 * 1 where it has no end. */
int frot_constant_phase(frot_impact *impact, int driver);

/* One phase by springs. Returns 1 where it has no end. */
int frot_spring_phase(frot_impact *impact);
int frot_spring_doubles(int rows, int blocks);

/* Numbers of the state y of springs: u (rows), p (rows), F (blocks), work taken (blocks). */
static inline int frot_impact_state_size(const frot_impact *impact) {
  return 2 * (impact->given->rows + impact->given->n_blocks);
}

/* Put the state of the impact into y, or take it over; the force of a contact, and its rate; the
 * largest force. */
void frot_impact_state_of(const frot_impact *impact, double *y);
void frot_accept_impact(frot_impact *impact, const double *y);
double frot_impact_force(const frot_impact *impact, const double *y, int k);
double frot_impact_force_rate(const frot_impact *impact, const double *y, int k);
double frot_impact_size_of_forces(const frot_impact *impact, const double *y);
/* What is positive as long as block k keeps its state, over its size: at the state y, whose rates
 * are the last found. `from`: the state at the start of the phase. */
double frot_impact_slack(const frot_impact *impact, int k, const double *from, const double *y);
/* Change the states of all blocks whose slack is used up, or nearly, at the state y. */
void frot_change_contacts(frot_impact *impact, const double *from, const double *y);

/* impact->now, ->b <- the blocks of the contact problem at the speeds y, the rates by springs. */
void frot_impact_blocks(frot_impact *impact, const double *y);
/* x, a <- its solution, from x on. Returns 1 where there is none. */
int frot_impact_solve(frot_impact *impact);

/* One phase by the implicit method. Returns 1 where it has no end. */
#define FROT_IMPLICIT_COLUMNS 8
int frot_implicit_phase(frot_impact *impact);

#endif
