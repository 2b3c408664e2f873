/* With c = cos(theta), s = sin(theta), d = (c, s), and den = W_nn - mu w_tn . d,
 *   den (d x s') = cc c^2 + ss s^2 + cs c s + l1 c + l2 s.
 * With u = tan(theta/2) it is a quartic over (1 + u^2)^2. Its roots with |u| <= 1 are directions
 * with c >= 0; the others are those of the quartic for -d. */
#include "contact/slip_directions.h"

#include <float.h>
#include <math.h>

#define DEGREE 4
#define BISECTIONS 60
#define POLISHING 4
/* Part of the sum of its terms below which the polynomial is zero in every direction. */
#define NO_POLYNOMIAL 1e-14
/* Part of the sum of its terms up to which a turning point that does not reach zero is a double
 * root, and the angle within which two roots are one. */
#define TOUCHES 1e-13
#define ONE_ROOT 1e-7

typedef struct {
  double cc, ss, cs, l1, l2, size;
} frot_turning;

static frot_turning turning_of(const frot_slip_contact *k) {
  const double *h = k->load_t, *w = k->w_tn, *tt = k->w_tt;
  double n = k->load_n, mu = k->mu;
  frot_turning g;
  g.l1 = k->w_nn * h[1] - n * w[1];
  g.l2 = -k->w_nn * h[0] + n * w[0];
  g.cc = -mu * w[0] * h[1] + mu * n * tt[1];
  g.ss = mu * w[1] * h[0] - mu * n * tt[2];
  g.cs = mu * (w[0] * h[0] - w[1] * h[1]) + mu * n * (tt[3] - tt[0]);
  double load = fabs(h[0]) + fabs(h[1]), across = fabs(w[0]) + fabs(w[1]);
  double sliding = fabs(tt[0]) + fabs(tt[1]) + fabs(tt[2]) + fabs(tt[3]);
  g.size = (fabs(k->w_nn) + fabs(mu) * across) * load + fabs(n) * (across + fabs(mu) * sliding);
  return g;
}

static double value_at(const frot_turning *g, double angle) {
  double c = cos(angle), s = sin(angle);
  return g->cc * c * c + g->ss * s * s + g->cs * c * s + g->l1 * c + g->l2 * s;
}

static double slope_at(const frot_turning *g, double angle) {
  double c = cos(angle), s = sin(angle);
  return 2 * (g->ss - g->cc) * c * s + g->cs * (c * c - s * s) - g->l1 * s + g->l2 * c;
}

static double polynomial(const double *p, int degree, double u) {
  double sum = p[degree];
  for (int k = degree - 1; k >= 0; k--) sum = sum * u + p[k];
  return sum;
}

/* Zeros of a polynomial in [-1, 1], ascending: between two zeros of its slope there is at most one.
 * Turning points within `touches` of zero count. */
static int real_roots(const double *p, int degree, double touches, double *roots) {
  if (degree == 0) return 0;
  double slope[DEGREE + 1] = {0}, turns[DEGREE + 1];
  for (int k = 0; k < degree; k++) slope[k] = (k + 1) * p[k + 1];
  int n_turns = real_roots(slope, degree - 1, 0, turns), n = 0;
  turns[n_turns] = 1;
  double lo = -1, at_lo = polynomial(p, degree, lo);
  if (at_lo == 0) roots[n++] = lo;
  for (int k = 0; k <= n_turns; k++) {
    double hi = turns[k], at_hi = polynomial(p, degree, hi);
    if ((at_lo > 0) != (at_hi > 0) && at_lo != 0 && at_hi != 0) {
      double a = lo, b = hi;
      for (int i = 0; i < BISECTIONS; i++) {
        double mid = 0.5 * (a + b);
        if ((polynomial(p, degree, mid) > 0) == (at_lo > 0))
          a = mid;
        else
          b = mid;
      }
      roots[n++] = 0.5 * (a + b);
    } else if (at_hi == 0 || (k < n_turns && fabs(at_hi) <= touches)) {
      if (n < degree) roots[n++] = hi;
    }
    lo = hi, at_lo = at_hi;
  }
  return n;
}

static double polish(const frot_turning *g, double angle) {
  for (int k = 0; k < POLISHING; k++) {
    double slope = slope_at(g, angle), value = value_at(g, angle);
    if (fabs(slope) <= ONE_ROOT * g->size) break; /* near a double root bisection is as good */
    double change = value / slope;
    if (!(fabs(change) < 0.1)) break;
    angle -= change;
  }
  return angle;
}

void frot_slip_motion(const frot_slip_contact *k, const double d[2], double *normal,
                      double acceleration[2]) {
  double den = k->w_nn - k->mu * (k->w_tn[0] * d[0] + k->w_tn[1] * d[1]);
  *normal = -k->load_n / den;
  for (int i = 0; i < 2; i++)
    acceleration[i] =
        k->load_t[i] + *normal * (k->w_tn[i] - k->mu * (k->w_tt[i] * d[0] + k->w_tt[2 + i] * d[1]));
}

/* Add the direction of an angle unless it is there. Returns their number. */
static int add_direction(const frot_slip_contact *k, const frot_turning *g, double angle,
                         frot_slip_direction *found, int n) {
  frot_slip_direction one = {{cos(angle), sin(angle)}, 0, 0, 0};
  for (int i = 0; i < n; i++)
    if (hypot(found[i].d[0] - one.d[0], found[i].d[1] - one.d[1]) < ONE_ROOT) return n;
  double den = k->w_nn - k->mu * (k->w_tn[0] * one.d[0] + k->w_tn[1] * one.d[1]), s[2];
  if (n == FROT_MOST_SLIP_DIRECTIONS || den == 0) return n;
  frot_slip_motion(k, one.d, &one.normal, s);
  one.rate = one.d[0] * s[0] + one.d[1] * s[1];
  one.turning = slope_at(g, angle) / den;
  found[n] = one;
  return n + 1;
}

int frot_slip_directions(const frot_slip_contact *contact,
                         frot_slip_direction found[FROT_MOST_SLIP_DIRECTIONS]) {
  const frot_turning g = turning_of(contact);
  double most = fmax(fmax(fabs(g.cc), fabs(g.ss)), fmax(fabs(g.cs), fmax(fabs(g.l1), fabs(g.l2))));
  int n = 0;
  if (!(most > NO_POLYNOMIAL * g.size)) return FROT_ANY_DIRECTION;
  for (int side = 1; side >= -1; side -= 2) {
    double l1 = side * g.l1, l2 = side * g.l2, roots[DEGREE + 1];
    double p[DEGREE + 1] = {g.cc + l1, 2 * (g.cs + l2), 4 * g.ss - 2 * g.cc, 2 * (l2 - g.cs),
                            g.cc - l1};
    int count = real_roots(p, DEGREE, TOUCHES * g.size, roots);
    for (int k = 0; k < count; k++) {
      double angle = 2 * atan(roots[k]) + (side < 0 ? acos(-1.0) : 0);
      n = add_direction(contact, &g, polish(&g, angle), found, n);
    }
  }
  return n;
}
