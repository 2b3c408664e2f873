/* Arguments of the generated functions, and whether their results are numbers. */
#ifndef FROT_CALLS_H
#define FROT_CALLS_H

#include "model/workspace.h"

/* Which rows frot_dynamics looks at. */
enum frot_wanted {
  FROT_MOTION,  /* those that act in the modes, and the readings that bound them */
  FROT_INERTIA, /* the same, of which the inertia alone is wanted: loads may be no numbers */
  FROT_READING, /* the same and all readings */
  FROT_LAWS     /* every row of a closed contact, and all readings */
};

/* The inputs at time t: those of the state, or where there are ramps a copy in w->call.inputs. */
static inline const double *frot_inputs_at(const frot_state *s, frot_work *w, double t) {
  const double *u = s->data + w->layout.u;
  if (!s->ramps) return u;
  const double *rate = s->data + w->layout.ramp;
  int n = w->layout.experiment - w->layout.ramp;
  for (int i = 0; i < n; i++) w->call.inputs[i] = u[i] + rate[i] * (t - s->ramps_from);
  return w->call.inputs;
}

/* Point w->call.arg at the arguments that all functions of the state begin with. */
static inline void frot_inputs(frot_state *s, frot_work *w, const double *t, const double *q,
                               const double *v, const double *d) {
  w->call.arg[0] = t, w->call.arg[1] = q, w->call.arg[2] = v;
  w->call.arg[3] = frot_inputs_at(s, w, *t), w->call.arg[4] = s->data + w->layout.p;
  w->call.arg[5] = d, w->call.arg[6] = w->blocks.y;
}

/* Whether all numbers are finite. */
static inline int frot_all_finite(const double *x, int n) {
  double a = 0, b = 0, c = 0, d = 0; /* so that no addition waits for the one before */
  int i = 0;
  for (; i + 4 <= n; i += 4) {
    a += x[i] - x[i], b += x[i + 1] - x[i + 1];
    c += x[i + 2] - x[i + 2], d += x[i + 3] - x[i + 3];
  }
  for (; i < n; i++) a += x[i] - x[i];
  return a + b + c + d == 0;
}

#endif
