/* One step of a large tree (articulated.h): its data, inertias and wrenches carried towards the
 * ground, motions away from it, and what the freedom of its speeds lets go.
 *
 * Written for a width that the compiler knows where they are used, and for numbers `real`: ordinary
 * ones, or where FROT_IN_WIDE is defined wide ones. */
#ifndef FROT_ARTICULATED_STEP_H
#define FROT_ARTICULATED_STEP_H

#include <float.h>
#include <math.h>
#include <string.h>

#include "inertia/articulated.h"
#include "numerics/extended_precision.h"

#ifdef FROT_IN_WIDE
typedef frot_wide real;
#define REAL_EPSILON FROT_WIDE_EPSILON
#define root_of(x) frot_wide_root(x)
#else
typedef double real;
#define REAL_EPSILON DBL_EPSILON
#define root_of(x) sqrt(x)
#endif

#define PLANE 3
#define SPACE 6

static inline int arm_size(int width) { return width == PLANE ? 2 : 3; }

/* Where in the data of a step its vector from the step before begins, its mass, its wrench. */
static inline const real *arm_of(int width, const frot_link *s, const real *data) {
  return data + s->data + width * s->count;
}
static inline const real *mass_of(int width, const frot_link *s, const real *data) {
  return arm_of(width, s, data) + arm_size(width);
}
static inline const real *wrench_of(int width, const frot_link *s, const real *data) {
  return mass_of(width, s, data) + (width == PLANE ? 4 : 10);
}

static inline real dot(int width, const real *a, const real *b) {
  real sum = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  if (width == SPACE) sum += a[3] * b[3] + a[4] * b[4] + a[5] * b[5];
  return sum;
}

static inline void add_times(int width, real *x, real k, const real *y) {
  for (int i = 0; i < width; i++) x[i] += k * y[i];
}

/* P is kept by triangles. In the plane: of the rows z, x, y what stands up to the diagonal. In
 * space: the block I of what turns (xx xy xz yy yz zz), H (turns by moves, by rows), M of what
 * moves. */
enum { TRIANGLE = 6, H = 6, M = 15 };

static inline int inertia_size(int width) { return width == PLANE ? TRIANGLE : FROT_STEP_INERTIA; }

static inline void times_triangle(const real *a, const real *x, real *y) {
  y[0] += a[0] * x[0] + a[1] * x[1] + a[2] * x[2];
  y[1] += a[1] * x[0] + a[3] * x[1] + a[4] * x[2];
  y[2] += a[2] * x[0] + a[4] * x[1] + a[5] * x[2];
}

/* y <- P x. */
static inline void times(int width, const real *p, const real *x, real *y) {
  if (width == PLANE) {
    y[0] = p[0] * x[0] + p[1] * x[1] + p[3] * x[2];
    y[1] = p[1] * x[0] + p[2] * x[1] + p[4] * x[2];
    y[2] = p[3] * x[0] + p[4] * x[1] + p[5] * x[2];
    return;
  }
  const real *h = p + H;
  y[0] = y[1] = y[2] = 0;
  y[3] = h[0] * x[0] + h[3] * x[1] + h[6] * x[2];
  y[4] = h[1] * x[0] + h[4] * x[1] + h[7] * x[2];
  y[5] = h[2] * x[0] + h[5] * x[1] + h[8] * x[2];
  times_triangle(p, x, y);
  if (x[3] == 0 && x[4] == 0 && x[5] == 0) return; /* a turn */
  y[0] += h[0] * x[3] + h[1] * x[4] + h[2] * x[5];
  y[1] += h[3] * x[3] + h[4] * x[4] + h[5] * x[5];
  y[2] += h[6] * x[3] + h[7] * x[4] + h[8] * x[5];
  times_triangle(p + M, x + 3, y + 3);
}

static inline void take_square(real *a, real k, const real *u) {
  real x = k * u[0], y = k * u[1], z = k * u[2];
  a[0] -= x * u[0], a[1] -= x * u[1], a[2] -= x * u[2];
  a[3] -= y * u[1], a[4] -= y * u[2], a[5] -= z * u[2];
}

/* P -= k u u'. */
static inline void take(int width, real *p, real k, const real *u) {
  if (width == PLANE) {
    real z = k * u[0], x = k * u[1];
    p[0] -= z * u[0], p[1] -= z * u[1], p[3] -= z * u[2];
    p[2] -= x * u[1], p[4] -= x * u[2], p[5] -= k * u[2] * u[2];
    return;
  }
  take_square(p, k, u);
  take_square(p + M, k, u + 3);
  for (int i = 0; i < 3; i++) {
    real part = k * u[i], *h = p + H + 3 * i;
    h[0] -= part * u[3], h[1] -= part * u[4], h[2] -= part * u[5];
  }
}

/* P of the bodies of a step by itself. */
static inline void own_inertia(int width, const real *mass, real *p) {
  if (width == PLANE) {
    p[0] = mass[3];
    p[1] = -mass[2], p[2] = mass[0];
    p[3] = mass[1], p[4] = 0, p[5] = mass[0];
    return;
  }
  const real *moment = mass + 1;
  real *h = p + H, *m = p + M;
  memcpy(p, mass + 4, sizeof(real) * TRIANGLE);
  h[0] = h[4] = h[8] = 0;
  h[1] = -moment[2], h[2] = moment[1], h[3] = moment[2];
  h[5] = -moment[0], h[6] = -moment[1], h[7] = moment[0];
  m[0] = m[3] = m[5] = mass[0];
  m[1] = m[2] = m[4] = 0;
}

/* `to` += the wrench `from` of what is at `arm`; what keeps its orientation gives no couple. */
static inline void add_wrench(int width, int as_point, const real *arm, const real *from,
                              real *to) {
  if (width == PLANE) {
    real couple = arm[0] * from[2] - arm[1] * from[1];
    to[0] += as_point ? couple : from[0] + couple;
    to[1] += from[1], to[2] += from[2];
    return;
  }
  const real *force = from + 3;
  real couple[3] = {arm[1] * force[2] - arm[2] * force[1], arm[2] * force[0] - arm[0] * force[2],
                    arm[0] * force[1] - arm[1] * force[0]};
  for (int i = 0; i < 3; i++) {
    to[i] += as_point ? couple[i] : from[i] + couple[i];
    to[3 + i] += force[i];
  }
}

/* `to` <- the twist at `arm` of what moves by `from`. */
static inline void carry(int width, int as_point, const real *arm, const real *from, real *to) {
  if (width == PLANE) {
    real turning = from[0];
    to[0] = as_point ? 0 : turning;
    to[1] = from[1] - turning * arm[1], to[2] = from[2] + turning * arm[0];
    return;
  }
  to[3] = from[3] + (from[1] * arm[2] - from[2] * arm[1]);
  to[4] = from[4] + (from[2] * arm[0] - from[0] * arm[2]);
  to[5] = from[5] + (from[0] * arm[1] - from[1] * arm[0]);
  for (int i = 0; i < 3; i++) to[i] = as_point ? 0 : from[i];
}

/* The twist that step k gets from the one before it, the ground at rest; where it stands. */
static inline real *carry_to(int width, const frot_link *s, int k, const real *data, real *twist) {
  static const real still[SPACE] = {0, 0, 0, 0, 0, 0};
  const real *before = s->above < 0 ? still : twist + width * s->above;
  real *motion = twist + width * k;
  carry(width, s->faces_ground, arm_of(width, s, data), before, motion);
  return motion;
}

/* `to` += X' P X, where X is `carry`: with the blocks I H M of P, what turns and what moves, and
 * [r] of the arm, H becomes H + [r] M and I becomes I + [r] H' + ([r] (H + [r] M)')'. */
static inline void add_inertia(int width, int as_point, const real *arm, const real *p, real *to) {
  if (width == PLANE) {
    real x = -arm[1], y = arm[0];
    real h0 = as_point ? 0 : p[1], h1 = as_point ? 0 : p[3];
    real n0 = h0 + p[2] * x + p[4] * y, n1 = h1 + p[4] * x + p[5] * y;
    to[0] += (as_point ? 0 : p[0]) + (h0 * x + h1 * y) + (n0 * x + n1 * y);
    to[1] += n0, to[2] += p[2], to[3] += n1, to[4] += p[4], to[5] += p[5];
    return;
  }
  real x = arm[0], y = arm[1], z = arm[2], h[9], n[9];
  const real *m = p + M;
  if (as_point)
    memset(h, 0, sizeof h);
  else
    memcpy(h, p + H, sizeof h);
  n[0] = h[0] + (y * m[2] - z * m[1]);
  n[1] = h[1] + (y * m[4] - z * m[3]);
  n[2] = h[2] + (y * m[5] - z * m[4]);
  n[3] = h[3] + (z * m[0] - x * m[2]);
  n[4] = h[4] + (z * m[1] - x * m[4]);
  n[5] = h[5] + (z * m[2] - x * m[5]);
  n[6] = h[6] + (x * m[1] - y * m[0]);
  n[7] = h[7] + (x * m[3] - y * m[1]);
  n[8] = h[8] + (x * m[4] - y * m[2]);
  /* entry ij: the vector products of the arm with row j of H, item i, and with row i of N, item j
   */
  to[0] += (y * h[2] - z * h[1]) + (y * n[2] - z * n[1]);
  to[1] += (y * h[5] - z * h[4]) + (z * n[0] - x * n[2]);
  to[2] += (y * h[8] - z * h[7]) + (x * n[1] - y * n[0]);
  to[3] += (z * h[3] - x * h[5]) + (z * n[3] - x * n[5]);
  to[4] += (z * h[6] - x * h[8]) + (x * n[4] - y * n[3]);
  to[5] += (x * h[7] - y * h[6]) + (x * n[7] - y * n[6]);
  for (int i = 0; i < 9; i++) to[H + i] += n[i];
  for (int i = 0; i < TRIANGLE; i++) to[M + i] += m[i];
  for (int i = 0; i < TRIANGLE && !as_point; i++) to[i] += p[i];
}

/* Sizes of the diagonal of P: of what turns, of what moves. */
static inline void sizes_of(int width, const real *p, real whole[2]) {
  if (width == PLANE) {
    whole[0] = p[0], whole[1] = p[2] + p[5];
    return;
  }
  whole[0] = p[0] + p[3] + p[5];
  whole[1] = p[M] + p[M + 3] + p[M + 5];
}

/* The same of a turn in the plane (s: 1 or -1), which leaves no resistance to turning at all, nor a
 * couple but that of its own force. */
static inline int turn_freely(real s, const real *whole, real *p, real *wrench, real *y,
                              real *force) {
  real inertia = p[0], x = p[1], z = p[3];
  if (!(inertia > PLANE * REAL_EPSILON * whole[0])) return 1;
  real share = 1 / inertia, root = root_of(share), rest = *force - s * wrench[0];
  real along_x = share * x, along_z = share * z, own = s * rest;
  p[2] -= along_x * x, p[4] -= along_z * x, p[5] -= along_z * z;
  p[0] = p[1] = p[3] = 0;
  wrench[0] = s * *force, wrench[1] += own * along_x, wrench[2] += own * along_z;
  y[0] = root * s * inertia, y[1] = root * s * x, y[2] = root * s * z;
  y[3] = root;
  *force = root * rest;
  return 0;
}

/* Takes from P what the freedom along a column lets go, and from the wrench the force of the speed,
 * which becomes that of the factor; y gets the column of the factor, after it 1 / sqrt(D). Returns
 * 1 when D is nothing but rounding of the terms of P, of whose diagonal `whole` has the sizes. */
static inline int let_go(int width, const real *s, const real *whole, real *p, real *wrench,
                         real *y, real *force) {
  if (width == PLANE && s[0] * s[0] == 1 && s[1] == 0 && s[2] == 0)
    return turn_freely(s[0], whole, p, wrench, y, force);
  real u[SPACE], size = 0;
  int turning = width == PLANE ? 1 : 3;
  times(width, p, s, u);
  real inertia = dot(width, s, u);
  for (int i = 0; i < width; i++) size += s[i] * s[i] * whole[i >= turning];
  if (!(inertia > width * REAL_EPSILON * size)) return 1;
  real share = 1 / inertia, root = root_of(share), rest = *force - dot(width, s, wrench);
  take(width, p, share, u);
  add_times(width, wrench, share * rest, u);
  for (int i = 0; i < width; i++) y[i] = root * u[i];
  y[width] = root;
  *force = root * rest;
  return 0;
}

#endif
