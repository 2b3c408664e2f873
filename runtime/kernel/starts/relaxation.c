#include "starts/relaxation.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "starts/multistart.h"
#include "methods/right_hand_side.h"
#include "assembly/gauss_newton.h"
#include "assembly/start_parts.h"
#include "evaluation/quaternions.h"

/* The method is FIRE (E. Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006), with its parameters: a
 * pseudo-motion is steered towards the accelerations and stopped where these oppose it. */
#define STEPS 1000
#define STEER 0.1
#define STEER_LESS 0.99
#define LONGER 1.1
#define SHORTER 0.5
#define DELAY 5
/* Change of an angle in a step, at most; of a length, in sizes of the scene. */
#define MOST 0.1
/* Part of the first accelerations that is left at the end: Newton's method finds the place then. */
#define SETTLED 1e-4

int frot_balance_of(const frot_opening *p) {
  int found = FROT_PLAIN;
  for (int i = 0; i < p->part->n_stated; i++) {
    int kind = p->m->position_kind[p->part->stated[i]];
    if (kind == FROT_OPTIONAL || (kind == FROT_BALANCE && found == FROT_PLAIN)) found = kind;
  }
  return found;
}

/* a.b of speeds or accelerations (nv) of the part, in the metric of the mass. */
static double product(const frot_opening *p, const double *a, const double *b) {
  double *sum = p->w->opening.apart, both[2] = {0, 0};
  for (int side = 0; side < 2; side++)
    for (int k = 0; k < p->part->n_groups; k++) {
      const frot_group *g = &p->m->groups[p->part->groups[k]];
      for (int j = 0; j < g->n_speeds; j++) {
        int speed = g->unknowns[j];
        sum[speed] = side ? a[speed] - b[speed] : a[speed] + b[speed];
      }
      both[side] += frot_square_of(p->w, g, sum);
    }
  return (both[0] - both[1]) / 4;
}

/* w->core.a <- the accelerations of the part, at rest. */
static int accelerate(frot_opening *p) {
  const frot_contact_mode *modes = (const void *)(p->s->data + p->w->layout.modes);
  const double *frozen = p->s->data + p->w->layout.frozen;
  frot_put(p);
  return frot_solution(p->m, p->s, p->w, p->t, p->q, p->v, p->d, modes, frozen, NULL, 0);
}

/* The longest of the speeds u, in the most that a step may change a coordinate by. */
static double fastest(const frot_opening *p, const double *u) {
  double most = 0;
  for (int k = 0; k < p->part->n_groups; k++) {
    const frot_group *g = &p->m->groups[p->part->groups[k]];
    for (int j = 0; j < g->n_speeds; j++) {
      int speed = g->unknowns[j];
      most = fmax(most, fabs(u[speed]) / (p->m->speed_turns[speed] ? 1 : p->scene));
    }
  }
  return most / MOST;
}

/* Move the part by h u, then onto the equations. */
static int move(frot_opening *p, const double *u, double h) {
  double *step = p->w->relations.step;
  frot_put(p);
  for (int k = 0; k < p->part->n_groups; k++) {
    const frot_group *g = &p->m->groups[p->part->groups[k]];
    for (int j = 0; j < g->n_speeds; j++) step[j] = u[g->unknowns[j]];
    frot_displace(p->m, g, p->q, step, h);
  }
  frot_normalise(p->m, p->q);
  frot_take_part(p, p->part);
  if (frot_solve_nearest(p) == FROT_OK) return 1;
  frot_clear_opening(p);
  return 0;
}

/* u <- (1 - part) u + by a. */
static void steer(const frot_opening *p, double part, double by, double *u) {
  for (int k = 0; k < p->part->n_groups; k++) {
    const frot_group *g = &p->m->groups[p->part->groups[k]];
    for (int j = 0; j < g->n_speeds; j++) {
      int speed = g->unknowns[j];
      u[speed] = (1 - part) * u[speed] + by * p->w->core.a[speed];
    }
  }
}

/* Follow the pseudo-motion; returns whether the accelerations have vanished. */
static int follow(frot_opening *p) {
  double *u = p->w->opening.start, first = 0, h = 0, share = STEER;
  const double *a = p->w->core.a;
  size_t bytes = sizeof(double) * (size_t)p->m->nv;
  memset(u, 0, bytes);
  for (int step = 0, smooth = 0; step < STEPS; step++) {
    if (accelerate(p) != FROT_OK) return 0;
    double size = sqrt(product(p, a, a));
    first = fmax(first, size);
    if (size <= SETTLED * first) return 1;
    if (step == 0) h = sqrt(1 / fastest(p, a));
    if (product(p, a, u) < 0) {
      memset(u, 0, bytes);
      h *= SHORTER, share = STEER, smooth = 0;
    } else if (++smooth > DELAY) {
      h *= LONGER, share *= STEER_LESS;
    }
    double speed = sqrt(product(p, u, u));
    steer(p, share, share * speed / size + h, u);
    double length = h * fastest(p, u);
    if (length > 1) steer(p, 1 - 1 / length, 0, u);
    if (!move(p, u, h)) return 0;
  }
  return 0;
}

int frot_relax(frot_opening *p) {
  frot_contact_mode *modes = (void *)(p->s->data + p->w->layout.modes);
  double *speeds = p->w->step.z1;
  size_t bytes = sizeof(double) * (size_t)p->m->nv;
  memcpy(speeds, p->v, bytes);
  memset(p->v, 0, bytes);
  for (int k = 0; k < p->part->n_contacts; k++) modes[p->part->contacts[k]].closed = 1;
  frot_take_liaisons(p);
  p->wide = p->unbalanced = 1;
  int found = frot_solve_widely(p) == FROT_OK;
  if (found) {
    frot_put(p);
    frot_note_reaches(p->m, p->s, p->w, p->t, p->q, p->v, p->d);
    found = follow(p);
  }
  p->wide = p->unbalanced = 0;
  memcpy(p->v, speeds, bytes);
  frot_clear_opening(p);
  return found;
}
