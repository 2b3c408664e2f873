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
  double *force;  /* n_blocks: F of each contact */
  double *scale;  /* rows: sizes of speeds; those of impulses are scale / W_ii */
  double *stages; /* impact_springs.c */
  double *newton;
  int *pivot;
  frot_contact_block *now; /* n_blocks */
  frot_impact_part *parts; /* n_blocks */
  double stiffness;
  int phases;
} frot_impact;

/* Part of its size below which a speed within an impact is zero. */
#define FROT_IMPACT_ZERO 1e-12

static inline int frot_is_driven(const frot_impact_part *part) {
  return part->state == FROT_PART_LOADING || part->state == FROT_PART_UNLOADING;
}

/* Whether an element has no slip. One whose contact has parted may have any. */
int frot_sticks(const frot_impact *impact, int k);

/* x, a <- impulses and speeds per unit of time at the speeds u and the forces `force`, with the
 * states as they are. Returns 1 where there are none. */
int frot_impact_rates(frot_impact *impact, const double *u);

/* Decide which slips begin or stay zero, and which contacts at rest part, with `force` as it is.
 * Returns 1 where no modes are found. */
int frot_decide_impact(frot_impact *impact);

/* Size of the slip of a block at the speeds u, and its direction d. */
double frot_impact_slip(const frot_impact_block *block, const double *u, double d[3]);

/* Size by which the speeds of a block are measured. */
double frot_impact_scale(const frot_impact *impact, const frot_impact_block *block);

/* A contact ends its compression, or its restitution, or begins another compression. */
void frot_end_compression(frot_impact *impact, int k);
void frot_end_restitution(frot_impact *impact, int k);
void frot_begin_compression(frot_impact *impact, int k);
/* The slip of an element, or the speed of a contact at rest, is zero now. */
void frot_put_at_rest(frot_impact *impact, int k);

/* One phase by the impulse of the contact `driver` alone, in which all rates are constant. Returns
 * 1 where it has no end. */
int frot_constant_phase(frot_impact *impact, int driver);

/* One phase by springs. Returns 1 where it has no end. */
int frot_spring_phase(frot_impact *impact);
int frot_spring_doubles(int rows, int blocks);

#endif
