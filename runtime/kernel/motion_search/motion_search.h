/* All motions of bodies in contact at an instant: branch and bound, order by order. */
#ifndef FROT_MOTION_SEARCH_H
#define FROT_MOTION_SEARCH_H

#include "motion_search/motion_problem.h"

/* Motions that are kept, at most. */
enum { FROT_MOST_FOUND = 64 };
/* Nodes of a search, unless said otherwise. */
enum { FROT_NODES = 20000 };

/* A motion: modes (items), reactions x (order + 1 times n), right sides b (order + 1 times
 * places). `decided`: 0 where slacks are zero up to the highest order, or `late`: what rests may
 * begin to move at orders above it. `family`: accelerations that reactions leave open in these
 * modes, of which those of least reactions are given, or FROT_FAMILY_OF_SPRINGS. `hardly`: it
 * begins by no more than rounding. `same`: the motion before it with equal accelerations, whose
 * reactions differ, or -1. */
enum { FROT_FAMILY_OF_SPRINGS = 2 };

typedef struct {
  frot_item_state *states;
  unsigned char *kinetic;
  double *x, *b;
  int order, decided, late, family, hardly, same;
} frot_found_motion;

typedef struct {
  frot_found_motion found[FROT_MOST_FOUND];
  int count, nodes, complete;
} frot_motion_list;

long long frot_motion_doubles(int n, int places, int width, int n_permanent, int n_items);
long long frot_motion_integers(int n, int n_permanent, int n_items);

/* List the motions of a problem. What departs is found with the coefficient of rest, then has that
 * of motion, and the rest is found again (P. Painleve 1895, p. 41-43). `budget`: of nodes.
 * complete: 0 where it ended. */
void frot_list_motions(const frot_motion_problem *problem, int budget, frot_motion_list *list,
                       double *doubles, int *integers);

/* Painleve's coefficient of a law that slips in a motion: the acceleration along the normal that a
 * unit of the normal reaction makes together with its friction, all else held as in the motion.
 * Where the normal is a reading, that over the same without friction. NAN where it is not
 * determined or nothing that is a normal bounds the law. The scratch is that of a list. */
double frot_painleve_coefficient(const frot_motion_problem *problem,
                                 const frot_found_motion *motion, int law, double *doubles,
                                 int *integers);

#endif
