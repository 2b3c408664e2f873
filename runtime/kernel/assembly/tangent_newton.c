#include "assembly/tangent_newton.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "assembly/nearest_solution.h"
#include "numerics/dense.h"
#include "numerics/basis.h"
#include "assembly/gauss_newton.h"
#include "assembly/start_parts.h"
#include "numerics/tolerances.h"

#define STEPS 60    /* of conjugate gradients */
#define LITTLE 1e-5 /* part of the values by which rows are moved to see how they turn */
#define NEAR 1e-3   /* part of a value that a way to it is as long as at least */

/* The problem is: |y|^2 least, or |g(y)|^2, at c(y) = 0, where y is the change in units in which
 * its length is that of the metric. With multipliers l such that the slope less C'l lies along the
 * relations, its Hessian along them is that of the Lagrangian, whose products with directions are
 * differences of C'l at places on both sides: relations are differentiated once only. */

typedef struct {
  int nx, ny, rank, *row; /* coordinates, own changes; the rows of the basis, as equations */
  double *basis;          /* rank x ny, orthonormal */
  double *multiplier;     /* rank */
  double *x, *turned, *slope, *left, *search, *image; /* nx each: coordinates, a row; changes */
} descent;

static descent begin(const frot_opening *p) {
  frot_work *w = p->w;
  int nx = p->n_own;
  double *at = w->opening.descent;
  return (descent){
      nx, p->n_own, 0,           w->linear.pivot, w->linear.matrix, w->opening.multiplier,
      at, at + nx,  at + 2 * nx, at + 3 * nx,     at + 4 * nx,      at + 5 * nx};
}

/* row <- what the guesses missed and the relations turn by, over the unknowns: what is missed times
 * its slopes, less the multipliers times the rows of the first `rank` relations. */
static void turn_rows(const frot_opening *p, const descent *s, int rank, double *row) {
  const double *slopes = p->w->relations.jacobian, *weight = p->w->opening.row_weight;
  memset(row, 0, sizeof(double) * (size_t)s->nx);
  for (int i = 0; i < rank; i++) {
    const double *own = slopes + s->nx * s->row[i];
    double by = s->multiplier[i] * weight[s->row[i]];
    for (int k = 0; k < s->nx; k++) row[k] -= by * own[k];
  }
  for (int j = 0; p->aim && j < p->part->n_guessed; j++) {
    int i = p->n + j;
    double unit = p->w->opening.guess_weight[p->part->guessed[j]],
           by = p->w->relations.residual[i] * unit * unit;
    for (int k = 0; k < s->nx && by != 0; k++) row[k] += by * slopes[s->nx * i + k];
  }
}

/* An orthonormal basis of the rows of the relations, the longest rest first. */
static void span_rows(const frot_opening *p, descent *s) {
  double *weight = p->w->opening.row_weight;
  int n = 0, ny = s->ny;
  frot_weigh_rows(p);
  for (int j = 0; j < p->n_rows; j++) {
    int i = p->w->opening.rows[j];
    double *y = s->basis + ny * n;
    if (weight[i] == 0) continue;
    frot_row_in_metric(p, p->w->relations.jacobian + s->nx * i, y);
    for (int k = 0; k < ny; k++) y[k] *= weight[i];
    s->row[n++] = i;
  }
  for (s->rank = 0; s->rank < n && s->rank < ny; s->rank++) {
    int best = s->rank;
    double longest = -1;
    for (int i = s->rank; i < n; i++) {
      double rest = frot_dot(s->basis + ny * i, s->basis + ny * i, ny);
      if (rest > longest) longest = rest, best = i;
    }
    if (!(longest > FROT_RANK * FROT_RANK)) break;
    int row = s->row[best];
    s->row[best] = s->row[s->rank], s->row[s->rank] = row;
    frot_take_row(s->basis, n, ny, s->rank, best);
  }
}

/* Multipliers for which the rows make all of the slope that lies across the relations: the rows are
 * R Q with the basis Q, so that R'l = Q slope. */
static void find_multipliers(const frot_opening *p, descent *s) {
  int n = s->rank;
  double *r = p->w->linear.scratch, *l = s->multiplier;
  for (int i = 0; i < n; i++) {
    double weight = p->w->opening.row_weight[s->row[i]];
    frot_row_in_metric(p, p->w->relations.jacobian + s->nx * s->row[i], s->image);
    for (int j = 0; j <= i; j++)
      r[n * i + j] = weight * frot_dot(s->basis + s->ny * j, s->image, s->ny);
    l[i] = frot_dot(s->basis + s->ny * i, s->slope, s->ny);
  }
  for (int i = n - 1; i >= 0; i--) {
    for (int k = i + 1; k < n; k++) l[i] -= r[n * k + i] * l[k];
    l[i] /= r[n * i + i];
  }
}

/* Leave of a change what lies along the relations. */
static void put_along(const descent *s, double *y) {
  for (int again = 0; again < 2; again++)
    for (int i = 0; i < s->rank; i++) {
      const double *q = s->basis + s->ny * i;
      double part = frot_dot(q, y, s->ny);
      for (int k = 0; k < s->ny; k++) y[k] -= part * q[k];
    }
}

/* How far a way moves what it moves most: angles in radians, the rest in parts of how far that has
 * come. */
static double most_moved(const frot_opening *p, const descent *s, const double *moved) {
  double way = 0, size = 0, turned = 0, most = 0;
  for (int a = 0; a < p->n_own; a++) {
    int k = p->w->opening.own[a], speed = frot_speed_behind(p, k);
    if (speed >= 0 && p->m->speed_turns[speed]) {
      turned = fmax(turned, fabs(moved[k]));
      continue;
    }
    most = fmax(most, fabs(moved[k])), size = fmax(size, fabs(s->x[k]));
    way = fmax(way, fabs(s->x[k] - p->w->opening.begin[k]));
  }
  way = fmax(way, NEAR * size);
  return fmax(turned, way > 0 ? most / way : most);
}

/* image <- the Hessian times `search`, along the relations. */
static int curve(frot_opening *p, const descent *s) {
  double *moved = p->w->opening.apart, *other = p->w->opening.next_way, none;
  int nx = s->nx;
  memcpy(s->image, s->search, sizeof(double) * (size_t)s->ny);
  frot_backward(p->factor, p->order, p->attached, s->image);
  frot_move_opening(p, s->image, s->x, 1, moved, &none);
  for (int k = 0; k < nx; k++) moved[k] -= s->x[k];
  double most = most_moved(p, s, moved), part = most > 0 ? LITTLE / most : 0;
  for (int side = 1; side >= -1 && part > 0; side -= 2) {
    for (int k = 0; k < nx; k++) p->x[k] = s->x[k] + side * part * moved[k];
    int status = frot_evaluate_statements(p);
    if (status != FROT_OK) return status;
    turn_rows(p, s, s->rank, side > 0 ? other : s->turned);
  }
  for (int k = 0; k < nx; k++) s->turned[k] = part > 0 ? (other[k] - s->turned[k]) / (2 * part) : 0;
  frot_row_in_metric(p, s->turned, s->image);
  for (int k = 0; k < s->ny && !p->aim; k++) s->image[k] += s->search[k];
  put_along(s, s->image);
  return FROT_OK;
}

/* d <- the way that conjugate gradients find, the first of them `left`: down, along the relations.
 */
static int follow(frot_opening *p, descent *s, double *d) {
  int ny = s->ny, status = FROT_OK;
  double now = frot_dot(s->left, s->left, ny), first = now;
  memset(d, 0, sizeof(double) * (size_t)s->nx);
  memcpy(s->search, s->left, sizeof(double) * (size_t)ny);
  for (int step = 0; step < STEPS && now > FROT_SLOPE_FOLLOWED * FROT_SLOPE_FOLLOWED * first;
       step++) {
    status = curve(p, s);
    if (status != FROT_OK) break;
    double length = frot_dot(s->search, s->search, ny);
    double along = frot_dot(s->search, s->image, ny);
    if (!(along > FROT_NO_CURVATURE * length)) {
      double by = p->aim && along != 0 ? now / fabs(along) : 1;
      for (int k = 0; k < ny && step == 0; k++) d[k] = by * s->search[k];
      break;
    }
    double by = now / along, before = now;
    for (int k = 0; k < ny; k++) d[k] += by * s->search[k], s->left[k] -= by * s->image[k];
    now = frot_dot(s->left, s->left, ny);
    for (int k = 0; k < ny; k++) s->search[k] = s->left[k] + now / before * s->search[k];
  }
  return status;
}

/* slope <- that of half the square of the change from the beginning, or of what is missed. */
static void find_slope(frot_opening *p, const descent *s) {
  double *apart = p->w->opening.apart;
  if (p->aim) {
    turn_rows(p, s, 0, s->turned);
    frot_row_in_metric(p, s->turned, s->slope);
    return;
  }
  for (int k = 0; k < s->nx; k++) apart[k] = p->x[k] - p->w->opening.begin[k];
  frot_measure_change(p, apart, s->slope);
}

int frot_way_down(frot_opening *p, double *slope) {
  frot_work *w = p->w;
  descent s = begin(p);
  double *d = w->opening.way, *apart = w->opening.apart, none;
  size_t bytes = sizeof(double) * (size_t)s.nx;
  int status = frot_evaluate_statements(p);
  if (status != FROT_OK) return status;
  memcpy(s.x, p->x, bytes);
  frot_keep_blocks(p, w->step.y_end);
  frot_measure_by_beginning(p);
  span_rows(p, &s);
  find_slope(p, &s);
  find_multipliers(p, &s);
  for (int k = 0; k < s.ny; k++) s.left[k] = -s.slope[k];
  put_along(&s, s.left);
  /* where nothing is left open what there is of a way is rounding */
  *slope = s.rank < s.ny ? sqrt(frot_dot(s.left, s.left, s.ny)) : 0;
  if (*slope == 0) return FROT_OK;
  status = follow(p, &s, d);
  memcpy(p->x, s.x, bytes);
  frot_return_blocks(p, w->step.y_end);
  if (status != FROT_OK) return status;
  frot_backward(p->factor, p->order, p->attached, d);
  frot_move_opening(p, d, s.x, 1, apart, &none);
  for (int k = 0; k < s.nx; k++) d[k] = apart[k] - s.x[k];
  return frot_evaluate_statements(p);
}
