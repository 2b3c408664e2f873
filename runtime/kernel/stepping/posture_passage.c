#include "stepping/posture_passage.h"

#include <math.h>

#include "evaluation/evaluate.h"
#include "singular/singular_posture.h"
#include "stepping/error_estimate.h"
#include "singular/undetermined_branch.h"
#include "reactions/reactions.h"
#include "numerics/tolerances.h"

/* Ratio of the errors of a step and of its repetition within which they are the same. */
#define SLACK 1.5
/* Power of the length with which an error falls that is none of rounding. */
#define LEAST_ORDER 2
#define LESS 0.95 /* of the length of a step that was rejected, most that it may be then */
/* Times in a row that no step across a posture is better, until no other is tried: one that is long
 * may find the posture in another place than the next. */
#define PATIENCE 4
#define LAYS 8 /* times that a step is laid anew */

int frot_step_avoids_posture(const frot_model *m, const frot_state *s, const frot_work *w,
                             frot_attempt *a) {
  if (!s->weak || a->laid == LAYS || a->to_due) return 1;
  if (frot_length_avoids_posture(m, s, w, a->t, a->h, a->want)) return 1;
  double h = a->h;
  a->h = frot_place_between_postures(m, s, w, a->t, a->want, a->most), a->laid++;
  return a->h == h; /* no other is better laid */
}

void frot_shorten_passage(const frot_model *m, frot_state *s, const frot_work *w, frot_attempt *a,
                          double h) {
  int better = !(a->ratio >= a->best_ratio * pow(h / a->best, LEAST_ORDER));
  a->want = a->h, a->most = LESS * h;
  if (a->ratio > 1 && a->ratio < a->best_ratio) a->best = h, a->best_ratio = a->ratio;
  a->h = frot_place_between_postures(m, s, w, a->t, a->h, a->most);
  if (better || a->forced || a->best_ratio * frot_step_tolerance(s) > FROT_MOST_BLUR) return;
  a->h = a->want = a->best, a->blurred = 1, a->laid = LAYS;
}

/* Take the step though its error is beyond its bound: rounding is all that is left of it. */
static void take_blurred(frot_state *s, frot_attempt *a) {
  s->statistics.blurred = fmax(s->statistics.blurred, a->ratio * frot_step_tolerance(s));
  a->ratio = 1;
}

void frot_take_forced(frot_state *s, frot_attempt *a) {
  /* from a posture no step is better: the nearer to it one ends, the more rounding there is */
  int as_good = s->from_posture ? a->ratio * frot_step_tolerance(s) <= FROT_MOST_BLUR
                                : a->ratio <= SLACK * a->best_ratio;
  if (a->ratio > 1 && as_good) take_blurred(s, a);
}

void frot_judge_passage(const frot_model *m, frot_state *s, const frot_work *w, frot_attempt *a) {
  if (!(a->ratio > 1) || !frot_passes(m, s, w, a->t, a->h)) return;
  int no_better = a->ratio >= s->across,
      enough = a->ratio * frot_step_tolerance(s) <= FROT_MOST_BLUR;
  s->across = a->ratio;
  s->no_better = no_better ? s->no_better + 1 : 0;
  if (!no_better) return;
  if (enough)
    take_blurred(s, a);
  else if (s->no_better > PATIENCE)
    a->h = a->to_due = 0;
}

/* Kinetic energy that rounding of loads and reactions which hold each other gives in a step. */
static double energy_of_rounding(const frot_model *m, frot_work *w, double h) {
  double sum = 0;
  for (int k = 0; k < w->awake.now->n_groups; k++) {
    const frot_group *g = &m->groups[w->awake.now->groups[k]];
    frot_rows(m, w, g);
    double size = frot_size_of_motion(m, w, g);
    sum += 0.5 * pow(FROT_ZERO * h * size, 2);
  }
  return sum;
}

int frot_projection_loses_energy(const frot_model *m, const frot_state *s, frot_work *w, double t,
                                 double h) {
  if (!frot_has_loops(m, s, w)) return -1;
  double before = frot_kinetic(m, w, w->step.z1 + m->nq);
  double after = frot_kinetic(m, w, s->data + w->layout.x + m->nq);
  double allowed = (FROT_MOST_LOST + s->tolerance) * s->energy_scale;
  if (fabs(after - before) <= allowed + energy_of_rounding(m, w, h)) return -1;
  int lost = frot_posture_at(m, s, w, t);
  for (int i = 0; lost < 0 && i < m->n_contacts; i++)
    if (frot_is_loop(m, s, w, i)) lost = i;
  return lost;
}
