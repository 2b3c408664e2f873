/* Scratch and sizes of the linearization: linearize.h. */
#ifndef FROT_LINEARIZE_WORKSPACE_H
#define FROT_LINEARIZE_WORKSPACE_H

#include "model/workspace.h"

/* Sizes: columns (q, v, y), lines and entries of the generated function; most that a group has of
 * equations, unknowns, columns and lines. */
typedef struct {
  int columns, lines, entries;
  int equations, unknowns, most_columns, most_lines;
} frot_line_extent;

frot_line_extent frot_line_extent_of(const frot_model *m);

/* Lines of a group: its unknowns, rows, and coefficients of friction with the slips of motions of
 * several components. */
int frot_lines_of_group(const frot_model *m, const frot_group *g);

typedef struct {
  double *rates;    /* derivatives of q' and v': entries of the pattern, or in q, v and the unknowns
                       y of the early blocks, by columns of nq + nv items */
  double *residual; /* those of the residuals of these blocks, by columns */
  double *partial;  /* results of the generated function */
  double *seed;     /* its direction */
  double *block;    /* derivatives of the lines of a group, by columns */
  double *matrix, *lu, *right, *least, *scale;
  int *pivot, *unknown;
  int *place; /* of each column among those of the group */
} frot_linearize_work;

/* Its scratch in memory that may be NULL, and how much that takes, without rates and residual. */
frot_linearize_work frot_linearize_scratch(const frot_model *m, double *doubles, int *integers,
                                           size_t *n_doubles, size_t *n_integers);

#endif
