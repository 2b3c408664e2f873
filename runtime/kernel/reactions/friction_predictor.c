#include "reactions/friction_predictor.h"

#include <math.h>

#include "numerics/bernstein.h"

/* Instants that a polynomial goes through: more amplify what the errors of stages make of it. */
#define POINTS 4
/* Two of them are one where they are nearer to each other than this part of the way from the first
 * one noted. */
#define SAME 1e-3

/* Where the instant t is to be noted among `count`; FROT_INSTANTS where there is no room. */
static int place_of(const double *at, int count, double t) {
  for (int k = 0; k < count; k++)
    if (fabs(t - at[k]) <= SAME * fabs(t - at[0])) return k;
  return count;
}

void frot_begin_friction_history(frot_work *w, double t, const double *friction) {
  frot_reaction_work *r = &w->reactions;
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_groups; k++) {
    int g = now->groups[k];
    r->rate[g] = 0, r->instants[g] = 1, r->instant[FROT_INSTANTS * g] = t;
  }
  for (int k = 0; k < now->n_elements; k++) {
    int e = now->elements[k];
    r->noted[FROT_INSTANTS * e] = friction[e];
  }
}

void frot_note_friction(const frot_problem *p) {
  frot_reaction_work *r = &p->w->reactions;
  int g = (int)(p->g - p->m->groups);
  double *at = r->instant + FROT_INSTANTS * g, t = p->w->core.t;
  int k = place_of(at, r->instants[g], t);
  if (k == FROT_INSTANTS) return;
  if (k == r->instants[g]) r->instants[g]++;
  at[k] = t;
  for (int f = 0; f < p->unknowns; f++)
    r->noted[FROT_INSTANTS * r->owner[f] + k] = p->w->core.lam[r->unknown[f]];
}

/* The instants nearest to t; returns how many. */
static int list_nearest(const double *at, int count, double t, int near[POINTS]) {
  double way[POINTS];
  int n = 0;
  for (int k = 0; k < count; k++) {
    double far = fabs(at[k] - t);
    int i = n < POINTS ? n++ : POINTS;
    for (; i > 0 && far < way[i - 1]; i--)
      if (i < POINTS) way[i] = way[i - 1], near[i] = near[i - 1];
    if (i < POINTS) way[i] = far, near[i] = k;
  }
  return n;
}

void frot_extrapolate_friction(const frot_problem *p) {
  frot_reaction_work *r = &p->w->reactions;
  int g = (int)(p->g - p->m->groups), near[POINTS];
  const double *at = r->instant + FROT_INSTANTS * g, t = p->w->core.t;
  int n = list_nearest(at, r->instants[g], t, near);
  double instant[POINTS], weight[POINTS];
  for (int i = 0; i < n; i++) instant[i] = at[near[i]];
  frot_weigh_values(instant, n, t, weight);
  for (int f = 0; f < p->unknowns && n > 0; f++) {
    const double *noted = r->noted + FROT_INSTANTS * r->owner[f];
    double sum = 0;
    for (int i = 0; i < n; i++) sum += weight[i] * noted[near[i]];
    p->w->core.lam[r->unknown[f]] = sum;
  }
}
