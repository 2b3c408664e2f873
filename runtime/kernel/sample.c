/* Values of the variables: at the time reached, and anywhere in recorded segments. */
#include <string.h>

#include "blocks.h"
#include "invariants.h"
#include "mechanics.h"
#include "state.h"
#include "step.h"

static int values_in(const frot_model *m, frot_state *s, frot_work *w, const frot_segment *g,
                     double t, double *values) {
  double *x = w->z1;
  frot_interpolate(m, g, t, x);
  frot_guess_unknowns(m, w, g, t);
  double *q = x, *v = x + m->nq;
  long long evaluations = s->statistics.evaluations;
  int status = FROT_OK, moved;
  /* relations between the states hold at every instant looked at, not only at the ends of steps */
  if (m->n_invariants > 0)
    status = frot_project_jointly(m, s, w, t, q, v, g->d, g->modes, NULL, NULL, g->frozen, &moved);
  if (status == FROT_OK)
    status = frot_solution(m, s, w, t, q, v, g->d, g->modes, g->frozen, g->along, 1);
  s->statistics.evaluations = evaluations; /* looking on is not part of the run */
  if (status != FROT_OK) return status;
  frot_inputs(m, s, w, &t, q, v, g->d);
  w->arg[7] = w->a, w->arg[8] = w->lam, w->arg[9] = x + m->nq + m->nv;
  w->res[0] = values;
  m->variables.call(w->arg, w->res, w->iw, w->w, 0);
  for (int i = 0; i < m->n_contacts; i++) values[i] = frot_mode_value(m, g->modes, i);
  return frot_all_finite(values, m->n_variables) ? FROT_OK : FROT_NAN;
}

int frot_values(const frot_model *m, frot_state *s, frot_work *w, double *values) {
  if (s->phase == FROT_CLEARED) return FROT_MISUSE;
  frot_bind_work(m, w);
  frot_segment g = frot_segment_at(m, s->data + frot_layout_of(m).segment);
  int status = values_in(m, s, w, &g, s->t, values);
  if (status != FROT_OK && s->phase == FROT_RUNNING) frot_fail_evaluation(m, s, w, status, s->t);
  return status;
}

int frot_segment_values(const frot_model *m, frot_state *s, frot_work *w, const double *segment,
                        double t, double *values) {
  frot_bind_work(m, w);
  frot_segment g = frot_segment_at(m, (double *)segment);
  return values_in(m, s, w, &g, t, values);
}

int frot_sample(const frot_model *m, frot_state *s, frot_work *w, const double *segments,
                long long segment_count, const double *times, long long count, double *values) {
  long long size = frot_segment_size(m), at = 0;
  if (segment_count <= 0) return FROT_MISUSE;
  for (long long i = 0; i < count; i++) {
    /* a segment begins with its first time */
    double end = times[i] + FROT_SAME_INSTANT(times[i]);
    while (at + 1 < segment_count && segments[(at + 1) * size] <= end) at++;
    double t = fmax(times[i], segments[at * size]);
    int status = frot_segment_values(m, s, w, segments + at * size, t, values + i * m->n_variables);
    if (status != FROT_OK) return status;
  }
  return FROT_OK;
}
