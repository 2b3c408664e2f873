#include "methods/method_choice.h"

#include <math.h>

#include "methods/rodas.h"
#include "methods/jacobian.h"
#include "methods/error_scales.h"
#include "methods/dormand_prince.h"

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
/* Size of h lambda below which the implicit method is not worth its price, for so many steps. Nor
 * is it where its steps are not longer by that price than the explicit ones were: what limits
 * both is then the motion itself, or the explicit one is not held up by its stability for much. */
#define EASY 3.0
#define EASY_STEPS 10
/* Change of a pass of Newton's method over that of the one before that is best for its price; it
 * grows with the square of the step. */
#define GOOD_RATE 0.2
/* Growth of the step where the first guess was so good that no rate was seen. */
#define UNTRIED 2
/* Explicit steps past what the implicit method cannot pass, where the text wants that. */
#define PASSING_STEPS 8
/* Steps of the implicit method after which it was right to change. */
#define LONG_STAY 50

static int is_chosen(const frot_model *m) { return m->has_jacobian && m->method == FROT_AUTO; }

void frot_choose_first(const frot_model *m, frot_state *s) {
  s->implicit = m->has_jacobian && m->method == FROT_IMPLICIT;
  s->patience = STIFF_STEPS;
}

void frot_see_other_system(frot_state *s) { s->patience = STIFF_STEPS; }

/* Squares of lengths of a difference, each state in units of its size: of coordinates with a speed,
 * of speeds, of all other states. */
typedef struct {
  double place, speed, other;
} lengths;

/* A speed that moves its place by the tolerance in the step, or by less, says nothing of what
 * limits the step: one that others hold at zero is rounding, and its changes as large as itself. */
static void raise_idle_speeds(const frot_model *m, const frot_state *s, frot_work *w, double h) {
  double *own = w->sizes.own;
  for (int j = 0; j < m->nq; j++)
    if (m->q_speed[j] >= 0)
      own[m->nq + m->q_speed[j]] = fmax(own[m->nq + m->q_speed[j]], s->tolerance * own[j] / h);
}

/* `packed`: x and y hold the awake states alone. */
static lengths distance(const frot_model *m, const frot_work *w, const double *x, const double *y,
                        int packed) {
  lengths sum = {0, 0, 0};
  for (int k = 0; k < w->awake.n - FROT_QUADRATURES; k++) {
    int j = w->awake.now->states[k], at = packed ? k : j;
    if (w->sizes.own[j] == 0) continue;
    double part = (x[at] - y[at]) / w->sizes.own[j];
    double *of = j >= m->nq ? &sum.speed : m->q_speed[j] >= 0 ? &sum.place : &sum.other;
    *of += part * part;
  }
  return sum;
}

/* The rate that turns a difference of states into that of their slopes. Places and speeds have
 * sizes of their own, by which a spring would seem as fast as it is stiff beside a slow motion:
 * places are weighed so that both ways, of speeds into rates of places and of places into
 * accelerations, count alike. */
static double rate_of(lengths slope, lengths state) {
  double weight = 0;
  if (state.place > 0 && slope.place > 0)
    weight = sqrt(slope.speed / state.place * (state.speed / slope.place));
  double values = weight * state.place + state.speed + state.other;
  double rates = weight * slope.place + slope.speed + slope.other;
  return values > 0 ? sqrt(rates / values) : 0;
}

/* The fastest rate that is felt in an explicit step: its last two arguments are both of the end, so
 * that their slopes differ by the Jacobian alone. */
static double felt_rate(const frot_model *m, const frot_work *w) {
  const double *last = frot_stage(w, DP_STAGES - 1), *end = frot_stage(w, DP_STAGES);
  return rate_of(distance(m, w, end, last, 1), distance(m, w, w->step.z1, w->step.z, 0));
}

double frot_stable_step(const frot_model *m, frot_state *s, const frot_work *w, double h) {
  if (s->implicit && frot_has_motion(m))
    return h * (w->implicit.rate > 0 ? sqrt(GOOD_RATE / w->implicit.rate) : UNTRIED);
  if (!is_chosen(m) || s->implicit) return INFINITY;
  s->felt = fmax(REMEMBERED * s->felt, felt_rate(m, w));
  return s->felt > 0 ? STABLE / s->felt : INFINITY;
}

int frot_is_stiff(const frot_model *m, frot_state *s, frot_work *w, double h) {
  if (!is_chosen(m)) return 0;
  if (s->implicit)
    return h >= m->implicit_price * s->explicit_step && h * frot_implicit_rate(m, w) >= EASY;
  s->explicit_step = fmax(REMEMBERED * s->explicit_step, h);
  const double *start = frot_stage(w, 0), *end = frot_stage(w, DP_STAGES);
  frot_motion_sizes(m, s, w, h, start, 0);
  raise_idle_speeds(m, s, w, h);
  double fastest = h * felt_rate(m, w);
  lengths way = distance(m, w, w->step.z1, w->step.z0, 0);
  if (!(way.place + way.speed + way.other > 0)) return 0;
  double own = h * rate_of(distance(m, w, end, start, 1), way);
  return fastest > NEAR_LIMIT || (fastest > FELT && fastest > APART * own);
}

static void change_to(frot_state *s, int implicit) {
  s->implicit = implicit;
  s->stiff_steps = s->calm_steps = s->stay = 0;
}

int frot_change_method(const frot_model *m, frot_state *s) {
  if (!is_chosen(m) || s->weak) return 0;
  change_to(s, !s->implicit);
  return 1;
}

void frot_pass_explicitly(frot_state *s) { change_to(s, 0); }

void frot_choose_next(const frot_model *m, frot_state *s, int stiff) {
  if (!s->implicit && m->has_jacobian && m->method == FROT_IMPLICIT && !s->weak)
    if (++s->stay > PASSING_STEPS) change_to(s, 1);
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
    if (s->stiff_steps >= s->patience && !s->weak) change_to(s, 1);
  }
}
