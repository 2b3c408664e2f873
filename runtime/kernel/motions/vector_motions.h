/* Motions of a part with slips of several components at rest: Newton's method in given modes. */
#ifndef FROT_VECTOR_MOTIONS_H
#define FROT_VECTOR_MOTIONS_H

#include "contact/contact_springs.h"
#include "motions/contact_instant.h"

enum { FROT_MOST_VECTOR_MOTIONS = 24, FROT_MOST_VECTOR_ITEMS = 12 };

/* A contact that may part (element -1) or a law of a part; `at`, n: its rows; normal: the place of
 * the reaction that bounds it, or -1. */
typedef struct {
  int contact, element, block, at, n, normal;
} frot_vector_item;

/* Modes by bits of the items: which contacts are open and which laws at rest begin to slip, and
 * which of these have the coefficient of motion; reactions and accelerations of the rows. */
typedef struct {
  unsigned open, departs, kinetic;
  double *x, *a;
} frot_vector_motion;

/* The rows of the problem (n, of all rows that act and of the readings that bound), its matrix and
 * right side; the items; the motions found. */
typedef struct {
  const frot_contact_instant *one;
  int n, n_items, n_blocks, count, complete;
  int *row_of;
  double *w, *b, *scratch;
  frot_contact_block *blocks, *tried;
  int *integers;
  frot_vector_item items[2 * FROT_MOST_VECTOR_ITEMS];
  frot_vector_motion found[FROT_MOST_VECTOR_MOTIONS];
} frot_vector_problem;

/* Doubles, integers and blocks of a problem with so many rows. */
long long frot_vector_doubles(int rows);
int frot_vector_integers(int rows);
int frot_vector_blocks(int rows);

/* Fill the problem of a part, after frot_pose_contact_problem. */
void frot_pose_vector_problem(const frot_contact_instant *one, double *doubles, int *integers,
                              frot_contact_block *blocks, frot_vector_problem *problem);

/* List the motions of the problem: every combination of modes, each from several starts. complete:
 * 0 where there are too many items. */
void frot_list_vector_motions(frot_vector_problem *problem);

/* Painleve's coefficient of the slip of an item, as frot_painleve_coefficient says. */
double frot_vector_painleve(frot_vector_problem *problem, const frot_vector_motion *motion,
                            int item);

#endif
