/* Equations and inequalities of given modes at one order. */
#ifndef FROT_MODE_INEQUALITIES_H
#define FROT_MODE_INEQUALITIES_H

#include "motion_search/motion_problem.h"
#include "motion_search/polyhedron_point.h"

/* Part of the size of its terms by which an inequality may be missed. */
#define FROT_MISSED 2e-12

/* Which inequality of an item a row of G is. Those that begin a motion are strict. */
enum frot_tag {
  FROT_TAG_NORMAL = 1,
  FROT_TAG_FORWARD = 2,  /* bound + f >= 0: zero where f may oppose a slip forward */
  FROT_TAG_BACKWARD = 4, /* bound - f >= 0 */
  FROT_TAG_SIDE = 8,
  FROT_TAG_BEGINS = 16,
  FROT_TAG_SECTOR = 32,
  FROT_ALL_TAGS = 63
};

/* The problem at one order. b, size (places), coefficient (2 items) as of frot_right_side; `scale`:
 * of the unknowns over their units; `known` (2 items): what the lower orders and values give of
 * each bound, of motion and of rest. held (items): the tags that are zero in the orders below; NULL
 * at order 0. */
typedef struct {
  int k;
  const double *b, *size;
  double scale;
  const double *known;
  const unsigned char *held;
} frot_order;

/* Rows with room for `most_equations` and `most_inequalities`; tag and item of each inequality. */
typedef struct {
  frot_polyhedron p;
  double *a, *b, *g_rows, *g, *slack, *own_size, *unit;
  unsigned char *tag;
  int *item;
} frot_mode_rows;

int frot_most_equations(const frot_motion_problem *problem);
int frot_most_inequalities(const frot_motion_problem *problem);

/* How modes are read: kinetic (items): slips take the coefficient of motion, else that of rest;
 * strict: part of the least beginning that counts, 1 or 0; direction (2 items): of reactions of two
 * components, which bounds are linear about, or NULL: sectors; doubtful: whether items that are in
 * doubt are left undecided, or held. */
typedef struct {
  const unsigned char *kinetic;
  const double *direction;
  double strict;
  int doubtful, sectors;
} frot_reading;

/* Fill the rows of the modes `states` at an order. */
void frot_list_inequalities(const frot_motion_problem *problem, const frot_item_state *states,
                            const frot_order *order, const frot_reading *reading,
                            frot_mode_rows *rows);

/* Give friction that follows reactions no weight of its own in their least norm. */
void frot_weigh_followers(const frot_motion_problem *problem, const frot_item_state *states,
                          frot_mode_rows *rows);

/* Multiple of FROT_MISSED up to which a value is zero: with n inequalities missed by it, one may
 * rise by n times it. */
double frot_apart(const frot_motion_problem *problem);

/* r <- the reaction of two components whose length bounds a law, at the reactions x. */
void frot_bounding_reaction(const frot_motion_problem *problem, const frot_motion_item *item,
                            const double *b, const double *x, double r[2]);

/* The value whose length bounds a law, at reactions x: along `direction` of two components. */
double frot_bound_value(const frot_motion_problem *problem, const frot_motion_item *item,
                        const double *b, const double *x, const double *direction);

#endif
