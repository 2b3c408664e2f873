#include "stiffness.h"

#include <math.h>

#include "implicit.h"

/* Size of h lambda beyond which the explicit method is near its limit, about 6. */
#define NEAR_LIMIT 5.0
/* And beyond which no step is tried: what lies inside it would be off before its end is. */
#define STABLE 7.0
/* What a step leaves of the memory of a rate that was felt: a mode that is damped hides. */
#define REMEMBERED 0.8
/* Below that, h lambda at least so large, and so much larger than h times the solution's rate. */
#define FELT 0.5
#define APART 10.0
/* Steps that speak for the implicit method, with fewer than CALM on end that do not between. */
#define STIFF_STEPS 8
#define MOST_STIFF_STEPS 2048
#define CALM_STEPS 4
/* Size of h lambda below which the implicit method is not worth its price, for so many steps. */
#define EASY 3.0
#define EASY_STEPS 10
/* Steps of the implicit method after which it was right to change. */
#define LONG_STAY 50

static int is_chosen(const frot_model *m) { return m->has_jacobian && m->method == FROT_AUTO; }

void frot_choose_first(const frot_model *m, frot_state *s) {
  s->implicit = m->has_jacobian && m->method == FROT_IMPLICIT;
  s->stiff_steps = s->calm_steps = s->stay = 0;
  s->felt = 0;
  s->patience = STIFF_STEPS;
}

/* Square of the length of x - y, each state in units of its size. */
static double distance(const frot_model *m, const frot_work *w, const double *x, const double *y) {
  double sum = 0;
  for (int j = 0; j < m->nq; j++) {
    if (w->sizes.own[j] == 0) continue;
    double part = (x[j] - y[j]) / w->sizes.own[j];
    sum += part * part;
  }
  return sum;
}

/* The fastest rate that is felt in an explicit step: its last two arguments are both of the end, so
 * that their slopes differ by the Jacobian alone. */
static double felt_rate(const frot_model *m, const frot_work *w) {
  int nz = frot_layout_of(m).nz;
  const double *last = w->step.k + (DP_STAGES - 1) * nz, *end = w->step.k + DP_STAGES * nz;
  double values = distance(m, w, w->step.z1, w->step.z);
  return values > 0 ? sqrt(distance(m, w, end, last) / values) : 0;
}

double frot_stable_step(const frot_model *m, frot_state *s, const frot_work *w) {
  if (!is_chosen(m) || s->implicit) return INFINITY;
  s->felt = fmax(REMEMBERED * s->felt, felt_rate(m, w));
  return s->felt > 0 ? STABLE / s->felt : INFINITY;
}

int frot_is_stiff(const frot_model *m, const frot_state *s, const frot_work *w, double h) {
  if (!is_chosen(m)) return 0;
  if (s->implicit) return h * frot_implicit_rate(m, w) >= EASY;
  int nz = frot_layout_of(m).nz;
  const double *start = w->step.k, *end = w->step.k + DP_STAGES * nz;
  double way = distance(m, w, w->step.z1, w->step.z0), fastest = h * felt_rate(m, w);
  if (!(way > 0)) return 0;
  double own = h * sqrt(distance(m, w, end, start) / way);
  return fastest > NEAR_LIMIT || (fastest > FELT && fastest > APART * own);
}

static void change_to(frot_state *s, int implicit) {
  s->implicit = implicit;
  s->stiff_steps = s->calm_steps = s->stay = 0;
}

int frot_change_method(const frot_model *m, frot_state *s) {
  if (!is_chosen(m)) return 0;
  change_to(s, !s->implicit);
  return 1;
}

void frot_choose_next(const frot_model *m, frot_state *s, int stiff) {
  if (!is_chosen(m)) return;
  s->calm_steps = stiff ? 0 : s->calm_steps + 1;
  if (s->implicit) {
    if (s->stay < LONG_STAY) s->stay++;
    if (s->calm_steps < EASY_STEPS) return;
    if (s->stay == LONG_STAY)
      s->patience = STIFF_STEPS;
    else if (s->patience < MOST_STIFF_STEPS)
      s->patience *= 2;
    change_to(s, 0);
  } else {
    s->stiff_steps += stiff;
    if (s->calm_steps >= CALM_STEPS) s->stiff_steps = 0;
    if (s->stiff_steps >= s->patience) change_to(s, 1);
  }
}
