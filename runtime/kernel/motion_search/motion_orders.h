/* The reactions of given modes at all orders up to one, and the scratch of a search. */
#ifndef FROT_MOTION_ORDERS_H
#define FROT_MOTION_ORDERS_H

#include "motion_search/mode_inequalities.h"
#include "motion_search/motion_search.h"

/* x (orders of n), b, size (orders of places), coefficient (orders of 2 items): of the modes looked
 * at last. length: orders of the length of each reaction of two components (items). held (items):
 * tags that are zero at all orders so far. Of order 0: equations that depend on others, and
 * whether the reactions that are open move anything. far: none were found within 1e7 of the loads,
 * but there may be some beyond. */
typedef struct {
  const frot_motion_problem *p;
  double *x, *b, *size, *coefficient, *length, *known, *direction, *turned, *span, *whole;
  unsigned char *held, *zero, *kinetic;
  double force, strict; /* usual reaction over its unit; 1, or 0: begins by rounding too */
  int redundant, family, far;
  frot_mode_rows rows;
  double *doubles, *spring_doubles;
  int *integers, *spring_integers; /* of sliding_springs.h */
  /* motion_search.c: nodes that wait, and the order of each */
  frot_item_state *stack, *child;
  int *order, room, waiting;
} frot_searcher;

/* How modes are evaluated: `directed`: in the directions that frot_find_directions has left;
 * `doubtful`: items in doubt are left undecided at order `top`; `sectors`: those directions stay in
 * their sectors. */
typedef struct {
  int top, directed, doubtful, sectors;
} frot_look;

/* Doubles that one motion of a list takes; a list has 2 FROT_MOST_FOUND + 1 of them, before the
 * scratch of a searcher. */
long long frot_found_doubles(int n, int places, int n_items);

/* Carve a searcher out of scratch memory; with the right side of order 0. */
void frot_begin_search(const frot_motion_problem *problem, frot_searcher *s, double *doubles,
                       int *integers);

/* The usual size of a reaction over its unit, by loads and values that bound friction; 0 where
 * there are none at the instant. */
double frot_usual_force(const frot_searcher *s);

/* Reactions of the orders 0 .. top. Returns -1, or the order at which there are none. */
int frot_find_orders(frot_searcher *s, const frot_item_state *states, frot_look look);

/* Directions of reactions of two components by Newton's method from those of s->x, within their
 * sectors: all items at order 0. Returns -1 where they are found, or no sector is wide enough to
 * be halved, else the item whose sector is to be. */
int frot_find_directions(frot_searcher *s, const frot_item_state *states);

/* Whether the reactions of s->x that friction follows have the directions that their laws read. Of
 * several redundant reactions the least may have others. */
int frot_follows_its_reaction(const frot_searcher *s, const frot_item_state *states);

/* Whether the accelerations of the orders so far, or a speed, are not zero. */
int frot_anything_moves(const frot_searcher *s, int top);

#endif
