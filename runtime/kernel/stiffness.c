#include "stiffness.h"

#include <math.h>

#include "implicit.h"

/* Size of h lambda beyond which the explicit method is near its limit, about 6. */
#define NEAR_LIMIT 5.0
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
  s->patience = STIFF_STEPS;
}

/* Square of the length of x - y, each state in units of its size. */
static double distance(const frot_model *m, const frot_work *w, const double *x, const double *y) {
  double sum = 0;
  for (int j = 0; j < m->nq; j++) {
    if (w->own_size[j] == 0) continue;
    double part = (x[j] - y[j]) / w->own_size[j];
    sum += part * part;
  }
  return sum;
}

int frot_is_stiff(const frot_model *m, const frot_state *s, const frot_work *w, double h) {
  if (!is_chosen(m)) return 0;
  if (s->implicit) return h * frot_implicit_rate(m, w) >= EASY;
  int nz = frot_layout_of(m).nz;
  const double *start = w->k, *last = w->k + (DP_STAGES - 1) * nz, *end = w->k + DP_STAGES * nz;
  double values = distance(m, w, w->z1, w->ztry), way = distance(m, w, w->z1, w->z0);
  if (!(values > 0) || !(way > 0)) return 0;
  /* both arguments are of the end of the step: their slopes differ by the Jacobian alone */
  double fastest = h * sqrt(distance(m, w, end, last) / values);
  double own = h * sqrt(distance(m, w, end, start) / way);
  return fastest > NEAR_LIMIT || (fastest > FELT && fastest > APART * own);
}

static void change_to(frot_state *s, int implicit) {
  s->implicit = implicit;
  s->stiff_steps = s->calm_steps = s->stay = 0;
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
