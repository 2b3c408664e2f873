/* Friction that follows readings.
 *
 * The size of a pin's reaction is not linear: it is replaced by its part along the direction
 * w->reactions.along of the last pass, which is Newton's method. */
#include <float.h>
#include <math.h>

#include "evaluation/evaluate.h"
#include "reactions/force_problem.h"
#include "numerics/tolerances.h"

void frot_read_bounds(const frot_problem *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int n = p->unknowns;
  double *known = w->reactions.known, *effects = w->reactions.effects;
  for (int f = p->held; f < n; f++)
    for (int k = 0; k < FROT_BOUNDING; k++, known++, effects += n) {
      int reading = m->elements[w->reactions.owner[f]].bounded_by[k];
      if (reading < 0) continue;
      *known = frot_known_part(p, reading);
      for (int c = 0; c < p->held; c++)
        effects[c] = w->reactions.unit_of[c] * frot_unknown_effect(p, reading, c);
      const double *all = frot_effect_on(m, w, reading); /* nothing goes with what follows */
      for (int c = p->held; c < n; c++)
        effects[c] = w->reactions.unit_of[c] * all[m->row_local[w->reactions.unknown[c]]];
    }
}

/* Components of the reactions that a pin's friction follows, 0 of another. */
static int components(const frot_problem *p, int e) {
  return frot_norm_first(&p->m->elements[e], FROT_NORMS);
}

void frot_follow_readings(frot_problem *p) {
  frot_work *w = p->w;
  int n = p->unknowns;
  const double *known = w->reactions.known, *effects = w->reactions.effects;
  p->equations = p->holding;
  for (int f = p->held; f < n; f++, known += FROT_BOUNDING, effects += FROT_BOUNDING * n) {
    int e = w->reactions.owner[f], line = p->equations++, count = components(p, e);
    double ratio = w->reactions.ratio[e] / w->reactions.unit_of[f];
    const double one = 1, *along = count == 0 ? &one : w->reactions.along + FROT_BOUNDING * e;
    double *entry = w->linear.matrix + line, right = along[0] * known[0];
    for (int c = 0; c < n; c++, entry += n) {
      double effect = along[0] * effects[c];
      for (int k = 1; k < count; k++) effect += along[k] * effects[k * n + c];
      *entry = (c == f) - ratio * effect;
    }
    for (int k = 1; k < count; k++) right += along[k] * known[k];
    w->linear.right[line] = ratio * right;
  }
}

/* A pin's reaction from the unknowns: a reading with what is known of it, and the size of its
 * terms, which may cancel. */
static double read_pin(const frot_problem *p, double known, const double *effects, double *size) {
  double sum = known;
  *size += fabs(known);
  for (int c = 0; c < p->unknowns; c++) {
    double term = effects[c] * p->w->reactions.solution[c];
    sum += term, *size += fabs(term);
  }
  return sum;
}

double frot_update_pin_directions(const frot_problem *p, double *rest) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int n = p->unknowns;
  double missed = 0;
  const double *known = w->reactions.known, *effects = w->reactions.effects;
  for (int r = 0; r < p->holding; r++) rest[r] = 0;
  for (int f = p->held; f < n; f++, known += FROT_BOUNDING, effects += FROT_BOUNDING * n) {
    int e = w->reactions.owner[f], line = p->holding + f - p->held;
    rest[line] = 0;
    if (m->elements[e].bound != FROT_BY_PIN) continue;
    double *along = w->reactions.along + FROT_BOUNDING * e, terms = 0, size = 0;
    double part[FROT_BOUNDING] = {0}, length[FROT_BOUNDING] = {0};
    for (int j = 0, k = 0; j < FROT_NORMS && m->elements[e].norm[j] > 0; j++) {
      int end = k + m->elements[e].norm[j];
      double square = 0;
      for (int i = k; i < end; i++) {
        part[i] = read_pin(p, known[i], effects + i * n, &terms);
        square += part[i] * part[i];
      }
      for (; k < end; k++) length[k] = sqrt(square);
      size += sqrt(square);
    }
    double ratio = w->reactions.ratio[e] / w->reactions.unit_of[f], friction = ratio * size;
    if (!(size > 0) || !(fabs(friction) > 0)) continue;
    rest[line] = friction - w->reactions.solution[f];
    double beyond = fabs(rest[line]) - FROT_FRICTION_TERMS * fabs(ratio) * terms;
    missed = fmax(missed, beyond / fabs(friction));
    for (int k = 0; k < FROT_BOUNDING; k++)
      if (length[k] > 0) along[k] = part[k] / length[k];
  }
  return missed;
}
