/* The equations that hold at the start: the statements of the section `initial`, then the contacts
 * that are to touch. */
#ifndef FROT_STATEMENTS_H
#define FROT_STATEMENTS_H

#include "work.h"

/* One system to solve: for coordinates, or for speeds. */
typedef struct {
  const frot_model *m;
  frot_state *s;
  frot_work *w;
  double t, *q, *v;
  const double *d;
  unsigned char *use;   /* per contact: its gap or its normal speed is to be zero */
  int velocity, n;      /* for speeds; equations of the last evaluation */
  const double *factor; /* of the metric of the changes that have a speed, of the given order */
  const double *basis;  /* the coordinates from which changes are counted (changes.h) */
  int order, attached;
  int part, n_own, n_rows; /* what is put together, its unknowns and equations: parts.h */
  double scene;            /* largest value, term and residual where the search begins */
  int wide;                /* the search may begin elsewhere too */
  int guessed;             /* the guesses of places are equations too, after the others */
  int alike;    /* what holds by one liaison counts alike, by the arms of the angles (damped.h) */
  int aim;      /* they are no equations, but what is to be missed least (descend.h) */
  int direct;   /* of the statements those alone that hold where the search begins */
  int timeless; /* of the statements those alone that hold at any time */
  double left;  /* the part of w->opening.left that may still be missed (gradual.h) */
  int ways;     /* speeds are to begin a motion in singular postures too (ways.h) */
} frot_opening;

static inline double *frot_opening_unknown(const frot_opening *p) {
  return p->velocity ? p->v : p->q;
}
static inline int frot_opening_count(const frot_opening *p) {
  return p->velocity ? p->m->nv : p->m->nq;
}
/* The speed that moves change k, -1 where there is none. */
static inline int frot_speed_behind(const frot_opening *p, int k) {
  return p->velocity ? k : p->w->opening.behind[k];
}
/* The coordinate that is the angle which speed j turns, -1 where it turns none. */
static inline int frot_angle_of(const frot_model *m, int j) {
  return m->speed_turns[j] ? m->speed_coordinate[j] : -1;
}
static inline int frot_is_attached(const frot_opening *p, int k) {
  return frot_speed_behind(p, k) >= 0;
}

/* Residuals (w->relations.residual), the rows of the Jacobian (w->relations.jacobian) and the sizes
 * of the terms (w->relations.size); sets p->n. FROT_OK or the status of a failed evaluation. */
int frot_evaluate_statements(frot_opening *p);

/* v and y, if they are not NULL, <- where the search for speeds and for the unknowns of the blocks
 * begins at the places as they are; of those of other parts nothing. */
void frot_begin_values(const frot_opening *p, double *v, double *y);

/* Take the liaisons that cannot part for equations, with the sides of the place as it is. */
void frot_take_liaisons(const frot_opening *p);

/* Whether equation i, which no unknown moves, holds: to rounding of lengths `reach`. */
int frot_is_still(const frot_opening *p, int i, double reach);

/* Size of the terms of equation i at the present values. */
double frot_statement_size(const frot_opening *p, int i);
/* The unknown that equation i alone speaks of, -1 if it speaks of several or none. */
int frot_only_unknown(const frot_opening *p, int i);

/* Whether equation i holds, against the sizes of its terms and its residual before. */
int frot_statement_agrees(const frot_opening *p, int i, double before);

/* Size of the terms of a contact's gap, of those too that cancel out. */
double frot_length_size(const frot_model *m, const frot_work *w, int contact, const double *q);

/* Record as a fault the statement with the largest residual and the one most at odds with it. */
int frot_contradiction(const frot_opening *p);
/* Record that an initial statement, or a load at the start, is no number. */
int frot_no_number(const frot_opening *p, int status);
/* Forget the fault: the search goes on elsewhere. */
void frot_clear_opening(const frot_opening *p);

#endif
