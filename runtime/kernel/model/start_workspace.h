/* Scratch of the search for a consistent start: assembly/ and starts/. */
#ifndef FROT_START_WORKSPACE_H
#define FROT_START_WORKSPACE_H

#include "model/tables.h"

/* Sizes below are those of the largest part of the scene (frot_part): `nx` unknowns, `own`
 * unknowns of blocks that follow from them, `ny` unknowns of blocks. `equations` are statements,
 * rows of liaisons and guesses together. Lengths are in m, angles in rad, speeds in m/s, rad/s. */
typedef struct {
  unsigned char *use;       /* n_contacts: the contact is an equation: start_equations.h */
  double *witness;          /* 3 n_contacts: what chooses the side of a contact: contact_sides.c */
  double *reach;            /* n_contacts: lengths that its gap is made of beside the coordinates */
  double *sides;            /* 4 contacts: the same two, as a part's function gives them */
  double *residual_y;       /* own x stated: slopes of the statements in unknowns of blocks */
  double *slopes;           /* nx x own: of the equations of the blocks in the unknowns */
  double *slopes_y;         /* own x own, and 3 own: the same in their own unknowns; LU scratch */
  int *slopes_pivot;        /* own: rows of that LU */
  double *factor;           /* nx x nx: Cholesky factor of the metric at the place reached */
  double *first_factor;     /* nx x nx: the same at `begin` */
  double *first_unit;       /* nx: units of the unknowns at `begin` */
  double *row_weight;       /* equations: weight of each residual, one over its size */
  double *off_at_first;     /* equations: residuals before the first change */
  double *begin;            /* states: the place from which changes are counted */
  double *here;             /* nx: the place from which the present change is counted */
  double *found;            /* states: the solution before the search for the nearest one */
  double *way;              /* nx: a direction along the solutions; the place of a damped step */
  double *next_way;         /* nx: the next direction; the last place of a homotopy */
  double *apart;            /* states: the distance from `begin`; a change tried */
  double *scratch;          /* 3 nx, and nv at least */
  double *left;             /* equations: residuals that a homotopy lets be missed: homotopy.h */
  double *nearest;          /* nx + ny: the best solution; the first of two branches */
  double *near;             /* nx + ny: the place nearest to the guesses: guesses.h */
  double *met;              /* nq: the coordinates at which guesses are met: guesses.h */
  double *guess_weight;     /* 2 n_guessed: weights of the guesses, then their squares */
  double *begin_y;          /* ny: unknowns of the blocks at `begin` */
  double *fresh;            /* n_y of the model: unknowns of the blocks as it begins them */
  double *other;            /* 2 (nx + ny): two places compared: part_places.c */
  double *first;            /* nx + ny + contacts, nq at least: the place and sides found first */
  unsigned char *first_use; /* contacts: `use` there */
  double *outside;          /* 2 (nx + ny): places outside of a curve: contact_sides.c */
  double *x;                /* nx: the unknowns of the part */
  double *read;             /* arguments of the part's functions: coordinates, speeds, inputs, y */
  int *behind;              /* nx: the speed of each change of an unknown: unknowns.h */
  int *own;                 /* nx: unknowns in the order of elimination: start_parts.c */
  int *rows;                /* equations: those of the linear problem being solved */
  int *number;             /* nq, nv at least: number in the part of each state: frot_number_here */
  frot_turn *turns;        /* orientations of the part, by the numbers of its unknowns */
  unsigned char *state;    /* nx: free, moving or taken (unknowns.h) while guesses are met */
  unsigned char *chosen;   /* equations: takes part while guesses are met: sequential_guesses.c */
  unsigned char *left_out; /* stated: the statement is left out: start_equations.c */
  unsigned char *kept;     /* nx: the unknown is determined, or not: gauss_newton.c */
  double *descent;         /* 6 nx: vectors of the tangent method: tangent_newton.c */
  double *multiplier;      /* equations: its Lagrange multipliers */
  int *contact_of;         /* contacts: the contact of each equation that is one's relation */
  double *start;           /* nv: speeds at the start: start_branch.c, closing_speeds.c */
  double *second;          /* nx: the second of two branches: start_branch.c */
} frot_opening_work;

#endif
