/* The pattern of a sparse matrix and of its factors. */
#ifndef FROT_SPARSE_PATTERN_H
#define FROT_SPARSE_PATTERN_H

/* Pattern of a Jacobian J (n x n) and of the factors L + U of shift I - J, whose row and column k
 * are those of state order[k]. Row k of the factors has the columns column[start[k]] .. up to
 * start[k + 1], ascending; its diagonal stands at diagonal[k]. Entry e of J is in row entry_row[e]
 * and column entry_column[e], and goes to place[e] of the factors. n = 0: the matrix is dense. */
typedef struct {
  int n, entries;
  const int *order, *start, *column, *diagonal;
  const int *entry_row, *entry_column, *place;
} frot_pattern;

#endif
