/* Rows are scaled to length 1 in the units of the unknowns. The equations are made orthonormal, the
 * longest remainder first, and the inequalities are read in the directions that they leave free. */
#include "motion_search/polyhedron_point.h"

#include <math.h>
#include <string.h>

#include "numerics/basis.h"
#include "numerics/nonnegative.h"

/* Remainder of a row of length 1 below which it depends on those before it. */
#define RANK 1e-12
/* Part of its terms by which such a row may miss its right side. */
#define AGREES 1e-10
/* Remainder below which an inequality says nothing of what is free. */
#define CONSTANT 1e-12
/* Remainder of the least squares below which there is no point within 1e7 of the size. */
#define EMPTY 1e-7
/* The same below which there is none at all. */
#define NONE 1e-12
/* Part of its terms by which the point may miss an inequality, and the slack of all. */
#define MISSES 2e-12
#define SLACK 1e-13
/* Remainder below which multipliers take an inequality away. */
#define TAKEN_AWAY 1e-9

int frot_polyhedron_doubles(int n, int equations, int inequalities) {
  int columns = inequalities > 0 ? inequalities : 1;
  return n * equations + 3 * equations + 2 * n * n + 2 * n + inequalities * (2 * n + 6) + 2 * n +
         (n + 1) * columns + frot_nonnegative_doubles(n + 1, columns) + 8 * n + n * n + columns +
         16;
}
int frot_polyhedron_integers(int n, int inequalities) {
  return frot_nonnegative_integers(inequalities + 1) + 2 * inequalities + 2 * n + 4;
}

/* x0 + Z y, Z' by rows (free_count x n). */
typedef struct {
  double *rows, *right, *terms; /* equations, scaled; made orthonormal in place */
  double *basis, *x0;
  int rank, free_count;
} reduced;

/* Take row k's part out of row i of n unknowns, with its right side. */
static void take_out(double *row, double *right, double *terms, const double *unit,
                     double unit_right, double unit_terms, int n) {
  for (int pass = 0; pass < 2; pass++) {
    double part = frot_dot(row, unit, n);
    if (part == 0) return;
    for (int j = 0; j < n; j++) row[j] -= part * unit[j];
    if (!right) continue;
    *right -= part * unit_right, *terms += fabs(part) * unit_terms;
  }
}

static void swap_rows(double *rows, int n, int i, int k) {
  for (int j = 0; j < n && i != k; j++) {
    double kept = rows[i * n + j];
    rows[i * n + j] = rows[k * n + j], rows[k * n + j] = kept;
  }
}

static void swap(double *x, int i, int k) {
  double kept = x[i];
  x[i] = x[k], x[k] = kept;
}

/* The longest of rows k .. count. */
static int longest_row(const double *rows, int n, int k, int count, double *length) {
  int best = k;
  *length = -1;
  for (int i = k; i < count; i++) {
    double own = frot_length(rows + i * n, n);
    if (own > *length) *length = own, best = i;
  }
  return best;
}

/* Returns 1 where the equations contradict each other. */
static int reduce_equations(const frot_polyhedron *p, reduced *r) {
  int n = p->n, m = p->equations;
  for (int i = 0; i < m; i++) {
    double *row = r->rows + i * n;
    for (int j = 0; j < n; j++) row[j] = p->a[i * n + j] * p->unit[j];
    double length = frot_length(row, n), scale = length > 0 ? 1 / length : 1;
    for (int j = 0; j < n; j++) row[j] *= scale;
    r->right[i] = p->b[i] * scale / p->size;
    r->terms[i] = 1 + fabs(r->right[i]);
  }
  int k = 0;
  for (double length; k < m && k < n; k++) {
    int best = longest_row(r->rows, n, k, m, &length);
    if (!(length > RANK)) break;
    swap_rows(r->rows, n, best, k), swap(r->right, best, k), swap(r->terms, best, k);
    double *unit = r->rows + k * n;
    for (int j = 0; j < n; j++) unit[j] /= length;
    r->right[k] /= length, r->terms[k] /= length;
    for (int i = k + 1; i < m; i++)
      take_out(r->rows + i * n, &r->right[i], &r->terms[i], unit, r->right[k], r->terms[k], n);
  }
  r->rank = k;
  for (int i = k; i < m; i++)
    if (fabs(r->right[i]) > AGREES * r->terms[i]) return 1;
  memset(r->x0, 0, sizeof(double) * (size_t)n);
  for (int i = 0; i < k; i++)
    for (int j = 0; j < n; j++) r->x0[j] += r->right[i] * r->rows[i * n + j];
  return 0;
}

/* An orthonormal basis of what the rows of the equations leave. */
static void complete(const frot_polyhedron *p, reduced *r) {
  int n = p->n;
  r->free_count = n - r->rank;
  memset(r->basis, 0, sizeof(double) * (size_t)(n * n));
  for (int i = 0; i < n; i++) {
    r->basis[i * n + i] = 1;
    for (int k = 0; k < r->rank; k++)
      take_out(r->basis + i * n, NULL, NULL, r->rows + k * n, 0, 0, n);
  }
  double length;
  for (int k = 0; k < r->free_count; k++) {
    int best = longest_row(r->basis, n, k, n, &length);
    swap_rows(r->basis, n, best, k);
    double *unit = r->basis + k * n;
    for (int j = 0; j < n; j++) unit[j] /= length;
    for (int i = k + 1; i < n; i++) take_out(r->basis + i * n, NULL, NULL, unit, 0, 0, n);
  }
}

static double *begin(const frot_polyhedron *p, reduced *r, double *doubles) {
  int n = p->n, m = p->equations;
  r->rows = doubles, r->right = r->rows + n * m, r->terms = r->right + m;
  r->basis = r->terms + m, r->x0 = r->basis + n * n;
  return r->x0 + n;
}

/* Row i of G in the free directions: h (free_count) h y >= *e. Returns its length in x. */
static double reduce_inequality(const frot_polyhedron *p, const reduced *r, int i, double *h,
                                double *e) {
  int n = p->n;
  const double *row = p->g_rows + i * n;
  double length = 0, at = 0;
  for (int j = 0; j < n; j++) length += row[j] * p->unit[j] * row[j] * p->unit[j];
  length = length > 0 ? sqrt(length) : 1;
  for (int j = 0; j < n; j++) at += row[j] * p->unit[j] / length * r->x0[j];
  for (int k = 0; k < r->free_count; k++) {
    h[k] = 0;
    for (int j = 0; j < n; j++) h[k] += row[j] * p->unit[j] / length * r->basis[k * n + j];
  }
  *e = p->g[i] / length / p->size - at - p->slack[i] / length / p->size - SLACK;
  return length;
}

/* Whether y misses any of the inequalities by more than rounding. */
static int misses(const double *h, const double *e, int count, int nz, const double *y) {
  for (int c = 0; c < count; c++) {
    double value = frot_dot(h + c * nz, y, nz), size = 1 + fabs(e[c]);
    for (int k = 0; k < nz; k++) size += fabs(h[c * nz + k] * y[k]);
    if (value - e[c] < -MISSES * size) return 1;
  }
  return 0;
}

/* y <- the point of least norm with h y = e where multipliers u are positive: far from zero the
 * least distance keeps half of the digits alone. */
static void polish(const double *h, const double *e, int count, int nz, const double *u,
                   double *matrix, double *scratch, double *y, int *pivot) {
  double *right = scratch, *work = right + count;
  int rows = 0, at = 0;
  for (int c = 0; c < count; c++) rows += u[c] > 0;
  for (int c = 0; c < count; c++) {
    if (!(u[c] > 0)) continue;
    for (int k = 0; k < nz; k++) matrix[k * rows + at] = h[c * nz + k];
    right[at++] = e[c];
  }
  frot_least_norm(matrix, right, rows, nz, CONSTANT, y, work, pivot);
}

/* y <- the point of least norm with h y >= e, `count` rows of nz. Returns 0, or why there is none.
 */
static int least_distance(const double *h, const double *e, int count, int nz, double *y,
                          double *doubles, int *integers) {
  int rows = nz + 1;
  double *matrix = doubles, *f = matrix + rows * count, *rest = f + rows, *u = rest + rows,
         *scratch = u + count;
  for (int c = 0; c < count; c++) {
    memcpy(matrix + c * rows, h + c * nz, sizeof(double) * (size_t)nz);
    matrix[c * rows + nz] = e[c];
  }
  memset(f, 0, sizeof(double) * (size_t)rows);
  f[nz] = 1;
  if (frot_nonnegative(matrix, f, rows, count, u, rest, scratch, integers)) return FROT_NO_POINT;
  double length = frot_length(rest, rows);
  if (length < NONE) return FROT_NO_POINT;
  if (length < EMPTY || rest[nz] < EMPTY * EMPTY) return FROT_NO_POINT_NEAR;
  for (int k = 0; k < nz; k++) y[k] = -rest[k] / rest[nz];
  double *polished = f; /* nz + 1 */
  polish(h, e, count, nz, u, matrix, scratch, polished, integers);
  if (!misses(h, e, count, nz, polished)) memcpy(y, polished, sizeof(double) * (size_t)nz);
  return misses(h, e, count, nz, y) ? FROT_NO_POINT : 0;
}

static void place(const frot_polyhedron *p, const reduced *r, const double *y, double *x) {
  int n = p->n;
  for (int j = 0; j < n; j++) {
    x[j] = r->x0[j];
    for (int k = 0; k < r->free_count; k++) x[j] += r->basis[k * n + j] * y[k];
    x[j] *= p->unit[j] * p->size;
  }
}

int frot_polyhedron_point(const frot_polyhedron *p, double *x, int *redundant, double *doubles,
                          int *integers) {
  int n = p->n, count = 0;
  reduced r;
  double *h = begin(p, &r, doubles), *e = h + n * p->inequalities, *y = e + p->inequalities,
         *scratch = y + n;
  int contradicts = reduce_equations(p, &r);
  *redundant = p->equations - r.rank;
  if (contradicts) return FROT_NO_POINT;
  complete(p, &r);
  int nz = r.free_count;
  for (int i = 0; i < p->inequalities; i++) {
    reduce_inequality(p, &r, i, h + count * nz, e + count);
    if (frot_length(h + count * nz, nz) >= CONSTANT)
      count++;
    else if (e[count] > 0)
      return FROT_NO_POINT;
  }
  for (int k = 0; k < nz; k++) y[k] = 0;
  int outside = 0, why = 0;
  for (int c = 0; c < count; c++) outside |= e[c] > 0;
  if (outside) why = least_distance(h, e, count, nz, y, scratch, integers);
  if (!why) place(p, &r, y, x);
  return why;
}

void frot_implicit_equalities(const frot_polyhedron *p, const double *x, unsigned char *zero,
                              double *doubles, int *integers) {
  int n = p->n, count = 0, *which = integers, *rest_of = integers + p->inequalities;
  reduced r;
  double *h = begin(p, &r, doubles), *e = h + n * p->inequalities, *matrix = e + 1;
  (void)x;
  reduce_equations(p, &r);
  complete(p, &r);
  int nz = r.free_count;
  if (nz == 0) return;
  for (int i = 0; i < p->inequalities; i++) {
    if (!zero[i]) continue;
    double *own = h + count * nz;
    reduce_inequality(p, &r, i, own, e);
    double length = frot_length(own, nz);
    if (length < CONSTANT) continue;
    for (int k = 0; k < nz; k++) own[k] /= length;
    which[count++] = i;
  }
  double *f = matrix + nz * count, *rest = f + nz, *u = rest + nz, *scratch = u + count + 1;
  for (int c = 0; c < count; c++) {
    for (int k = 0, at = 0; k < count; k++)
      if (k != c) memcpy(matrix + nz * at++, h + k * nz, sizeof(double) * (size_t)nz);
    for (int k = 0; k < nz; k++) f[k] = -h[c * nz + k];
    int failed = frot_nonnegative(matrix, f, nz, count - 1, u, rest, scratch, rest_of);
    zero[which[c]] = (unsigned char)(!failed && frot_length(rest, nz) < TAKEN_AWAY);
  }
}

int frot_free_directions(const frot_polyhedron *p, double *basis, double *doubles) {
  reduced r;
  begin(p, &r, doubles);
  reduce_equations(p, &r);
  complete(p, &r);
  for (int k = 0; k < r.free_count; k++)
    for (int j = 0; j < p->n; j++) basis[k * p->n + j] = r.basis[k * p->n + j] * p->unit[j];
  return r.free_count;
}
