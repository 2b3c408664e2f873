/* The equations that hold at the start: the statements of the section `initial`, then the contacts
 * that are to touch. */
#ifndef FROT_START_EQUATIONS_H
#define FROT_START_EQUATIONS_H

#include <string.h>

#include "model/workspace.h"

/* One system to solve: for coordinates, or for speeds, of a part of the scene (start_parts.h). */
typedef struct frot_opening frot_opening;
struct frot_opening {
  const frot_model *m;
  frot_state *s;
  frot_work *w;
  double t, *q, *v; /* of the scene */
  double *x;        /* the unknowns of the part */
  const frot_part *part;
  const double *d;
  unsigned char *use;   /* per contact of the scene: its gap or its normal speed is to be zero */
  int velocity, n;      /* for speeds; equations of the last evaluation */
  int n_contacts;       /* of them, after those that are stated, relations of contacts */
  const double *factor; /* of the metric of the changes that have a speed, of the given order */
  const double *basis;  /* the coordinates from which changes are counted (unknowns.h) */
  int order, attached;
  int n_own, n_rows; /* unknowns; equations that are not left out */
  double scene;      /* largest value, term and residual where the search begins */
  int wide;          /* the search may begin elsewhere too */
  int guessed;       /* the guesses of places are equations too, after the others */
  int alike;         /* relations of one liaison count alike, by the arms of the angles
                        (levenberg_marquardt.h) */
  int aim;           /* they are no equations, but what is to be missed least (tangent_newton.h) */
  double (*missed)(frot_opening *p); /* by how much they are missed: guesses.c */
  int some;       /* of unknowns and equations those alone that sequential_guesses.c says
                     (levenberg_marquardt.h) */
  int fewest;     /* of the statements those alone that are not optional */
  int unbalanced; /* of the statements those alone that are not on accelerations */
  int direct;     /* of the statements those alone that hold where the search begins */
  int timeless;   /* of the statements those alone that hold at any time */
  double left;    /* the part of w->opening.left that may still be missed (homotopy.h) */
  int ways;       /* speeds are to begin a motion in singular postures too (tangent_cone.h) */
};

/* The speed of the scene that moves change k, -1 where there is none. */
static inline int frot_speed_behind(const frot_opening *p, int k) {
  return p->w->opening.behind[k];
}
/* The coordinate that is the angle which speed j turns, -1 where it turns none. */
static inline int frot_angle_of(const frot_model *m, int j) {
  return m->speed_turns[j] ? m->speed_coordinate[j] : -1;
}

/* Residuals (w->relations.residual), the rows of the Jacobian (w->relations.jacobian) and the sizes
 * of the terms (w->relations.size), of the part, at p->x; sets p->n. FROT_OK or the status of a
 * failed evaluation. */
int frot_evaluate_statements(frot_opening *p);

/* The unknowns of the blocks of the part <- where the search for them begins at the places as they
 * are. */
void frot_begin_blocks(const frot_opening *p);

/* Take the liaisons of the part that cannot part for equations, with the sides of the place as it
 * is. */
void frot_take_liaisons(const frot_opening *p);

/* Whether contact i of the scene is an equation. */
static inline int frot_is_equation(const frot_opening *p, int i) {
  return p->use[i] && (p->velocity || !p->m->contacts[i].kinematic);
}

/* Whether contacts i and k are equations between lengths, or between directions, of one liaison. */
static inline int frot_are_alike(const frot_opening *p, int i, int k) {
  const frot_contact *a = &p->m->contacts[i], *b = &p->m->contacts[k];
  return frot_is_equation(p, i) && frot_is_equation(p, k) && a->turns == b->turns &&
         strcmp(a->name, b->name) == 0;
}

/* Whether equation i gives a counter that no other equation speaks of: the counter follows from
 * where the rest is, and says nothing of the way there. */
int frot_is_follower(const frot_opening *p, int i);

/* Whether equations i and k are items of one vector: of a statement, a guess, or of the lengths or
 * the directions of a liaison. */
int frot_are_items(const frot_opening *p, int i, int k);

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
/* Forget the fault: the search continues elsewhere. */
void frot_clear_opening(const frot_opening *p);

#endif
