/* Combinations of the rows of springs that vanish beside rows that are rigid. */
#ifndef FROT_SPRING_ROWS_H
#define FROT_SPRING_ROWS_H

/* Rows of length 1, made orthogonal in turn: x (n x width), each the combination z (n x n) of the
 * rows given. `slides` (n): 1 for a spring whose force moves something. */
typedef struct {
  int n, width;
  double *x, *z;
  int *kind, *part, *slides;
} frot_spring_rows;

int frot_spring_rows_doubles(int n, int width);
int frot_spring_rows_integers(int n);

void frot_begin_springs(frot_spring_rows *c, int n, int width, double *doubles, int *integers);

/* The row i (width), of a spring or rigid. */
void frot_add_spring_row(frot_spring_rows *c, int i, const double *row, int spring, int slides);

/* Find the combinations of springs that vanish: what is shorter than `least` depends on the rows
 * before it; with rank >= 0 as many rows as it says are independent. `last`: row taken after all
 * others, or -1. Springs in one combination are connected. */
void frot_combine_springs(frot_spring_rows *c, double least, int rank, int last);

/* Whether row k is the remainder of a combination that vanishes, of several springs, connected to
 * one that slides; beside rigid rows alone a spring would bear nothing. Then c->z + k c->n is the
 * combination. */
int frot_is_compatible(const frot_spring_rows *c, int k);

/* Whether row k is the remainder of a combination that vanishes. */
int frot_remains(const frot_spring_rows *c, int k);

int frot_is_spring(const frot_spring_rows *c, int i);

#endif
