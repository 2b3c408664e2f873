/* The contact problem of an instant, order by order: reactions x (n), accelerations b_k + W x_k.
 *
 * At each order k of the time after the instant, the unknowns are the k-th derivatives of the
 * reactions. The matrix W is the same at every order, the right side b_k follows from the lower
 * orders (P. Loetstedt 1982; W. Heemels, J. Schumacher, S. Weiland 2000). */
#ifndef FROT_MOTION_PROBLEM_H
#define FROT_MOTION_PROBLEM_H

/* Highest order at which an inequality is decided. */
enum { FROT_HIGHEST_ORDER = 3, FROT_ORDERS = FROT_HIGHEST_ORDER + 1 };

/* A contact that may part, or a law of friction on one relative motion. */
enum frot_item_kind { FROT_ITEM_CONTACT, FROT_ITEM_LAW };

/* What bounds a law: coefficient times a normal reaction that is not negative; times one of either
 * sign; times the length of two components; or the coefficient itself. */
enum frot_item_bound { FROT_BOUND_PRESSING, FROT_BOUND_SIDED, FROT_BOUND_LENGTH, FROT_BOUND_VALUE };

/* `row`: its unknown. Of a law: the item of its contact, or -1 where that cannot part; the places
 * of the reactions that bound it; +1 or -1 of a slip, 0 of one at rest. `off`: what an event that
 * was located leaves of an inequality of the item, whose zero it is; side_off: of a normal of
 * either sign. */
typedef struct {
  int kind, row;
  int contact, bound, reads[2];
  int moving;
  double mu, mu_s, off, side_off;
} frot_motion_item;

/* b (places): accelerations of the unknowns' rows without reactions, then readings without
 * reactions; size: of the terms of b; coefficient (2 a law item): derivatives of those of motion
 * and of rest. Of order k, after the orders below in turn, whose reactions are x (n each). Returns
 * 1 where that order is not known. */
typedef int (*frot_right_side)(void *context, int k, const double *x, double *b, double *size,
                               double *coefficient);

/* Of w the rows that are permanent are turned among themselves and taken out of the others.
 * `places`: n rows with unknowns, then readings, which follow from these. w: places x n by rows. */
typedef struct {
  int n, places, n_items, n_permanent;
  const frot_motion_item *items;
  const int *permanent; /* rows that hold whatever happens */
  const double *w;
  const double *gram;         /* n x n: w before permanent rows were eliminated from it */
  const double *unit;         /* n: units in which squares of reactions compare */
  int width;                  /* rows in the metric (n x width), w = rows rows'; 0: not known */
  const double *rows, *force; /* what loads are there (width) */
  int moves;                  /* whether a speed is not zero */
  int orders;                 /* highest order that is known */
  double rate;                /* 1/s: how fast loads usually change */
  frot_right_side right_side;
  void *context;
} frot_motion_problem;

enum frot_item_mode {
  FROT_ITEM_OPEN_QUESTION, /* not decided */
  FROT_ITEM_HELD,          /* closed, or at rest */
  FROT_ITEM_FORWARD,
  FROT_ITEM_BACKWARD,
  FROT_ITEM_OPEN
};

/* What an item may become at the next order, where a slack of it is zero in all reactions. */
enum frot_doubt { FROT_MAY_OPEN = 1, FROT_MAY_GO_FORWARD = 2, FROT_MAY_GO_BACKWARD = 4 };

/* `since`: the order at which its motion first differs from zero. `side`: sign of a normal of
 * either sign, 0: not decided. Of two components: sector of their direction about `angle`, of the
 * half width `half`, 0: not decided. */
typedef struct {
  signed char mode, since, side, doubt;
  float half;
  double angle;
} frot_item_state;

#endif
