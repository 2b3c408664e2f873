#include "stepping/time_resolution.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "numerics/tolerances.h"

#define SAMPLES 20000 /* in a run */
#define PART 0.1      /* longest step, in runs */
#define GROWTH 0.25   /* longest step, in the time already run: rest, no speeds, or no `stop` */
#define BEYOND 2      /* rates are seen when those at the stages come up to this part of them */
#define FAINT 1e-3    /* part of the largest rate in the step that nobody looks at */
#define LONG_REST 1e9 /* longest step where nothing depends on time, in longest steps */

static const double *experiment_of(const frot_state *s, const frot_work *w) {
  return s->data + w->layout.experiment;
}

/* The run as the text has it, zero where it is silent. */
static double told_run(const frot_state *s, const frot_work *w) {
  const double *experiment = experiment_of(s, w);
  double start = isnan(experiment[0]) ? 0 : experiment[0];
  return experiment[1] > start ? experiment[1] - start : 0;
}

/* A step below every scale of time, and above the rounding of times. */
static double finest_step(const frot_state *s) {
  return fmax(FROT_FINEST_TIME, 1e3 * DBL_EPSILON * fabs(s->began));
}

double frot_longest_step(const frot_model *m, const frot_state *s, const frot_work *w, double t,
                         int still) {
  double longest = s->h_max, most = experiment_of(s, w)[4];
  double told = told_run(s, w), been = t - s->began;
  if (m->time_dependent) {
    double grown = still || told == 0 ? GROWTH * been : PART * been;
    longest = fmax(fmax(PART * told, grown), finest_step(s));
  } else if (still || s->implicit) {
    longest *= LONG_REST; /* nothing can be passed over */
  } else if (told == 0 || m->nv == 0) {
    longest = fmax(longest, GROWTH * been);
  }
  return most > 0 ? fmin(longest, most) : longest;
}

double frot_finest_step(const frot_model *m, const frot_state *s, const frot_work *w, double h) {
  if (!m->time_dependent || told_run(s, w) > 0) return h;
  return fmin(h, finest_step(s));
}

/* Sizes into w->pace and rates behind them. */
static double *rates_at(const frot_model *m, frot_state *s, frot_work *w, double t) {
  const double *d = s->data + w->layout.d;
  frot_inputs(s, w, &t, w->step.z0, w->step.z0 + m->nq, d);
  w->call.res[0] = w->pace, w->call.res[1] = w->pace + m->n_paced;
  frot_call(w, &m->pace);
  return w->pace + m->n_paced;
}

/* largest <- the larger of itself and the rates at t. */
static void note_rates(const frot_model *m, frot_state *s, frot_work *w, double t,
                       double *largest) {
  const double *rate = rates_at(m, s, w, t);
  for (int i = 0; i < m->n_paced; i++)
    if (fabs(rate[i]) > largest[i] && isfinite(rate[i])) largest[i] = fabs(rate[i]);
}

double frot_resolve_time(const frot_model *m, frot_state *s, frot_work *w, double t, double h) {
  double spacing = fmax(told_run(s, w), t - s->began) / SAMPLES;
  if (m->n_paced == 0 || !(h > spacing)) return h;
  int count = (int)fmin(ceil(h / spacing), SAMPLES);
  double *seen = w->pace + 2 * m->n_paced, *most = seen + m->n_paced;
  memset(seen, 0, 2 * sizeof(double) * (size_t)m->n_paced);
  memcpy(w->blocks.y, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
  for (int k = 0; k <= DP_STAGES; k++)
    if (dp_e5[k] != 0 || dp_e3[k] != 0) note_rates(m, s, w, t + dp_c[k] * h, seen);
  for (int k = 1; k < count; k++) note_rates(m, s, w, t + k * spacing, most);
  int passed = 0;
  for (int i = 0; i < m->n_paced; i++) {
    int matters = most[i] * h > FROT_STEADY * w->pace[i] && most[i] > BEYOND * seen[i];
    most[i] = matters ? fmax(BEYOND * seen[i], FAINT * most[i]) : INFINITY;
    passed |= matters;
  }
  if (!passed) return h;
  for (int k = 1; k < count; k++) {
    const double *rate = rates_at(m, s, w, t + k * spacing);
    for (int i = 0; i < m->n_paced; i++)
      if (fabs(rate[i]) > most[i]) return fmax(k - 1, 1) * spacing;
  }
  return h;
}
