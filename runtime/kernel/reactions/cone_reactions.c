/* Reactions of a group that are not unique, within the bounds of friction on slips of several
 * components that rest: the least that are admissible (contact/cone_point.h). */
#include <math.h>
#include <string.h>

#include "contact/cone_point.h"
#include "evaluation/slip_frames.h"
#include "reactions/force_problem.h"
#include "reactions/reactions.h"
#include "reactions/switching_functions.h"
#include "numerics/tolerances.h"

/* The place of a row among the unknowns, -1 where it has none. */
static int place_of(const frot_problem *p, int row) {
  for (int c = 0; c < p->unknowns; c++)
    if (p->w->reactions.unknown[c] == row) return c;
  return -1;
}

/* The reaction of unknown c in x. */
static double reaction_of(const frot_problem *p, const double *x, int c) {
  return x[c] * p->w->reactions.unit_of[c];
}

/* Bounds of the group's elements of several components that rest, and the contacts that press. */
static void list_bounds(const frot_problem *p, frot_cone_problem *problem) {
  const frot_model *m = p->m;
  frot_reaction_work *r = &p->w->reactions;
  problem->n_cones = problem->n_balls = 0;
  for (int i = 0; i < p->g->n_contacts; i++) {
    int contact = p->g->contacts[i], at = -1;
    int presses = p->w->span.unilateral[contact] != 0 || frot_sign_matters(m, p->modes, contact);
    if (presses && frot_is_loaded(m, p->modes, contact))
      at = place_of(p, m->contacts[contact].row_n);
    if (at >= 0) r->cones[problem->n_cones++].at = at;
    for (int k = 0; k < p->g->n_elements; k++) {
      int e = p->g->elements[k];
      if (m->elements[e].contact != contact || !frot_is_held(m, p->modes, e)) continue;
      if (m->elements[e].part > 0 || (at < 0 && m->elements[e].bound != FROT_BY_VALUE)) continue;
      int by_value = m->elements[e].bound == FROT_BY_VALUE;
      r->balls[problem->n_balls++] =
          (frot_ball){place_of(p, m->elements[e].row), m->elements[e].parts,
                      by_value ? -1 : problem->n_cones - 1, p->w->core.coefficient[2 * e + 1]};
    }
  }
  problem->cones = r->cones, problem->balls = r->balls;
}

/* Sign by which the normal reaction of a contact is positive: that of its side. */
static double sign_of(const frot_problem *p, int c) {
  for (int i = 0; i < p->g->n_contacts; i++)
    if (p->m->contacts[p->g->contacts[i]].row_n == p->w->reactions.unknown[c])
      return p->modes[p->g->contacts[i]].side < 0 ? -1 : 1;
  return 1;
}

static int is_inside(const frot_problem *p, const frot_cone_problem *problem, const double *x) {
  for (int k = 0; k < problem->n_cones; k++)
    if (sign_of(p, problem->cones[k].at) * reaction_of(p, x, problem->cones[k].at) < 0) return 0;
  for (int k = 0; k < problem->n_balls; k++) {
    const frot_ball *ball = &problem->balls[k];
    double square = 0, bound = ball->ratio;
    for (int i = 0; i < ball->n; i++) {
      double one = reaction_of(p, x, ball->at + i);
      square += one * one;
    }
    if (ball->bounding >= 0) bound *= fabs(reaction_of(p, x, problem->cones[ball->bounding].at));
    if (sqrt(square) > bound * (1 + FROT_CONE_SLACK)) return 0;
  }
  return 1;
}

int frot_keep_within_bounds(const frot_problem *p, double *x) {
  frot_work *w = p->w;
  int n = p->unknowns, rows = p->equations;
  if (!w->core.frame) return 0;
  frot_cone_problem problem = {.n = n, .rows = rows, .tolerance = FROT_CONE_TOLERANCE};
  list_bounds(p, &problem);
  if (is_inside(p, &problem, x)) return 0;
  double *a = w->reactions.cone_rows, *b = a + n * rows, *y = b + rows, *found = y + rows,
         *scratch = found + n;
  for (int r = 0; r < rows; r++) {
    double largest = 0;
    for (int c = 0; c < n; c++) {
      double sign = c < p->held && w->reactions.friction[c] == 0 ? sign_of(p, c) : 1;
      a[r * n + c] = sign * w->linear.matrix[c * n + r] / w->reactions.unit_of[c];
      largest = fmax(largest, fabs(a[r * n + c]));
    }
    double scale = largest > 0 ? 1 / largest : 1;
    for (int c = 0; c < n; c++) a[r * n + c] *= scale;
    b[r] = w->linear.right[r] * scale, y[r] = 0;
  }
  problem.a = a, problem.b = b;
  if (frot_cone_point(&problem, found, y, scratch)) return 1;
  for (int c = 0; c < n; c++) {
    double sign = c < p->held && w->reactions.friction[c] == 0 ? sign_of(p, c) : 1;
    x[c] = sign * found[c] / w->reactions.unit_of[c];
  }
  return 0;
}
