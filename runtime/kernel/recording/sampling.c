/* Values of the variables: at the time reached, and anywhere in recorded segments. */
#include <string.h>

#include "evaluation/slip_frames.h"
#include "evaluation/fault_source.h"
#include "evaluation/algebraic_loops.h"
#include "constraints/invariants.h"
#include "evaluation/evaluate.h"
#include "methods/right_hand_side.h"
#include "constraints/projection.h"
#include "model/workspace.h"
#include "model/segment.h"
#include "constraints/redundant_rows.h"
#include "recording/segment_store.h"
#include "evaluation/quaternions.h"
#include "singular/tangent_cone.h"

/* Whether a mode holds anything that coordinates do not. */
static int holds_anything(const frot_model *m, frot_work *w, const frot_contact_mode *modes) {
  return m->n_rows > 0 && frot_holding_rows(m, w, modes, NULL, 0) > 0;
}

/* A motion that the mode holds is zero to the last bit. */
static void rest_exactly(const frot_model *m, const frot_contact_mode *modes, double *values) {
  for (int i = 0; i < m->n_contacts; i++) {
    int held = modes[i].closed, laws = 0;
    for (int e = 0; e < m->n_elements; e++) {
      if (m->elements[e].contact != i) continue;
      int rests = modes[i].closed && frot_element_mode(m, modes, e)->friction == FROT_STICK;
      for (int k = 0; k < 2; k++)
        if (rests && m->elements[e].shown[k] >= 0) values[m->elements[e].shown[k]] = 0;
      held &= rests, laws++;
    }
    if (held && laws > 0 && m->contacts[i].power >= 0) values[m->contacts[i].power] = 0;
  }
}

/* Slips that begin in a segment do so in its directions, not in those that the state has by now. */
static void exchange_headings(const frot_model *m, frot_state *s, const frot_work *w,
                              const frot_segment *g) {
  double *now = s->data + w->layout.heading;
  for (int e = 0; e < m->n_elements; e++) {
    double kept = now[e];
    now[e] = g->heading[e], g->heading[e] = kept;
  }
}

static int evaluate_values(const frot_model *m, frot_state *s, frot_work *w, const frot_segment *g,
                           double t, double *values) {
  double *x = w->step.z1;
  frot_interpolate(m, g, t, x);
  frot_guess_unknowns(m, w, g, t);
  double *q = x, *v = x + m->nq;
  long long evaluations = s->statistics.evaluations;
  int status = FROT_OK, moved;
  frot_normalise(m, q);
  /* relations between the states hold at every instant looked at, not only at the ends of steps */
  if (m->n_invariants > 0) {
    frot_use_redundant_rows(m, w, g->spare);
    status =
        frot_project_jointly(m, s, w, t, q, v, g->d, g->modes, NULL, g->sizes, g->frozen, &moved);
  } else if (holds_anything(m, w, g->modes)) {
    status = frot_dynamics(m, s, w, t, q, v, g->d, g->modes, FROT_MOTION);
    frot_use_redundant_rows(m, w, g->spare);
    if (status == FROT_OK)
      status = frot_project(m, s, w, t, q, v, g->d, g->modes, NULL, g->frozen, &moved);
  }
  if (status == FROT_OK)
    status = frot_solution(m, s, w, t, q, v, g->d, g->modes, g->frozen, g->along, 1);
  if (status == FROT_OK && w->reactions.dependent)
    status = frot_accelerations_on_branch(m, s, w, t, q, v, g->d, g->modes, g->spare);
  frot_forget_redundant_rows(w);
  s->statistics.evaluations = evaluations; /* looking on is not part of the run */
  if (status != FROT_OK) return status;
  frot_inputs(s, w, &t, q, v, g->d);
  w->call.arg[7] = w->core.a, w->call.arg[8] = frot_lam_of_text(m, w),
  w->call.arg[9] = x + m->nq + m->nv;
  w->call.res[0] = values;
  frot_call(w, &m->variables);
  for (int i = 0; i < m->n_contacts; i++)
    if (m->contacts[i].mode >= 0) values[m->contacts[i].mode] = frot_mode_value(m, g->modes, i);
  rest_exactly(m, g->modes, values);
  return frot_all_finite(values, m->n_variables) ? FROT_OK : FROT_NAN;
}

static int values_in(const frot_model *m, frot_state *s, frot_work *w, const frot_segment *g,
                     double t, double *values) {
  exchange_headings(m, s, w, g);
  int status = evaluate_values(m, s, w, g, t, values);
  exchange_headings(m, s, w, g);
  return status;
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
  frot_segment g = frot_read_record(m, s, w, segment);
  return values_in(m, s, w, &g, t, values);
}

int frot_sample(const frot_model *m, frot_state *s, frot_work *w, const double *segments,
                long long size, const double *times, long long count, double *values) {
  const double *at = segments, *end_of_all = segments + size, *held = NULL;
  frot_segment g;
  if (size <= 0) return FROT_MISUSE;
  frot_bind_work(m, w);
  for (long long i = 0; i < count; i++) {
    /* a segment begins with its first time */
    double end = times[i] + FROT_SAME_INSTANT(times[i]);
    for (const double *next = at + frot_record_length(at);
         next < end_of_all && frot_record_begin(next) <= end; next += frot_record_length(next))
      at = next;
    double t = fmax(times[i], frot_record_begin(at));
    if (at != held) g = frot_read_record(m, s, w, at), held = at;
    int status = values_in(m, s, w, &g, t, values + i * m->n_variables);
    if (status != FROT_OK) return frot_name_singular_figure_at(m, s, w, status, t);
  }
  return FROT_OK;
}
