#include "starts/start_branch.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "starts/guesses.h"
#include "inertia/mass_matrix.h"
#include "numerics/dense.h"
#include "assembly/gauss_newton.h"
#include "assembly/start_parts.h"
#include "singular/tangent_cone.h"
#include "numerics/tolerances.h"

/* Speeds from which ways are looked for, along each of the conditions, in sizes of the motion: from
 * beyond its two solutions Newton's method goes to the nearer one. */
#define PLACES 6
static const double place[PLACES] = {1, -1, 8, -8, 64, -64};

/* Two ways, w->opening.nearest and w->opening.second: the square of what they miss the guesses of
 * speeds by, in parts (1 where there are none), INFINITY where there is no way. */
typedef struct {
  double missed[2];
} two_ways;

static double guesses_missed(const frot_opening *p) {
  int n = p->part->n_guessed;
  const double *missed = p->w->relations.residual, *size = p->w->relations.size;
  double sum = 0;
  if (n == 0 || !frot_look_at_guessed_speeds(p)) return 1;
  for (int i = 0; i < n; i++) {
    double part = size[i] > 0 ? missed[i] / size[i] : 0;
    sum += part * part;
  }
  return isfinite(sum) ? sum : 1;
}

/* The inertia and the conditions of a group at p->x. */
static int look(frot_opening *p, const frot_group *g) {
  const frot_contact_mode *modes = (const void *)(p->s->data + p->w->layout.modes);
  if (!frot_has_loops_alone(p->m, p->s, p->w, g)) return 0;
  frot_put(p);
  int status = frot_dynamics(p->m, p->s, p->w, p->t, p->q, p->v, p->d, modes, FROT_INERTIA);
  return status == FROT_OK ? frot_find_branches(p->m, p->s, p->w, g, p->t, p->q, p->v, p->d) : 0;
}

/* Distance of speeds, by the kinetic energy of their difference. */
static double between(const frot_opening *p, const double *x, const double *other) {
  double *apart = p->w->opening.apart, sum = 0;
  for (int k = 0; k < p->n_own; k++) apart[p->part->reads.v[k]] = x[k] - other[k];
  for (int k = 0; k < p->part->n_groups; k++)
    sum += frot_square_of(p->w, &p->m->groups[p->part->groups[k]], apart);
  return sqrt(sum);
}

/* On from p->x to a way, which is kept if it is one of the two that miss the guesses least. */
static void find(frot_opening *p, two_ways *found) {
  double *first = p->w->opening.nearest, *second = p->w->opening.second;
  size_t bytes = sizeof(double) * (size_t)p->n_own;
  p->ways = 1;
  int status = frot_solve_nearest(p);
  p->ways = 0;
  if (status != FROT_OK) {
    frot_clear_opening(p);
    return;
  }
  double missed = guesses_missed(p), size = sqrt(2 * frot_kinetic(p->m, p->w, p->v));
  for (int k = 0; k < 2; k++)
    if (isfinite(found->missed[k]) &&
        !(between(p, p->x, k ? second : first) > FROT_SAME_BRANCH * size))
      return;
  if (missed < found->missed[0]) {
    memcpy(second, first, bytes), memcpy(first, p->x, bytes);
    found->missed[1] = found->missed[0], found->missed[0] = missed;
  } else if (missed < found->missed[1]) {
    memcpy(second, p->x, bytes), found->missed[1] = missed;
  }
}

/* w->opening.way <- a change of the speeds w->opening.start, as large as they are, that statements
 * and liaisons leave open, along condition i of a group. Returns 0 if there is none. */
static int open_change(frot_opening *p, const frot_group *g, int i) {
  const double *start = p->w->opening.start;
  double *along = p->w->linear.scratch + g->n_speeds * i, *change = p->w->opening.way;
  memcpy(p->x, start, sizeof(double) * (size_t)p->n_own);
  if (look(p, g) <= i) return 0;
  double size = sqrt(frot_square_of(p->w, g, p->v));
  frot_outwards(p->w, g, along);
  for (int j = 0; j < g->n_speeds; j++)
    p->x[frot_number_here(p, g->unknowns[j])] += size * along[j];
  if (frot_solve_nearest(p) != FROT_OK) {
    frot_clear_opening(p);
    return 0;
  }
  double far = between(p, p->x, start);
  for (int k = 0; k < p->n_own; k++) change[k] = size / far * (p->x[k] - start[k]);
  return far > FROT_SAME_BRANCH * size;
}

/* Look for ways from both sides of the speeds w->opening.start, along each condition of a group. */
static void look_around(frot_opening *p, const frot_group *g, two_ways *found) {
  const double *start = p->w->opening.start, *change = p->w->opening.way;
  memcpy(p->x, start, sizeof(double) * (size_t)p->n_own);
  int count = look(p, g);
  for (int i = 0; i < count; i++) {
    if (!open_change(p, g, i)) continue;
    for (int k = 0; k < PLACES; k++) {
      for (int j = 0; j < p->n_own; j++) p->x[j] = start[j] + place[k] * change[j];
      find(p, found);
    }
  }
}

/* The liaison of a loop of a group that has ways on at p->x, or -1. */
static int contact_with_ways(frot_opening *p, const frot_group *g) {
  if (look(p, g) == 0) return -1;
  for (int i = 0; i < g->n_contacts; i++)
    if (p->m->contacts[g->contacts[i]].row_n == p->w->span.way[0]) return g->contacts[i];
  return -1;
}

/* That no motion begins, or two that are about as near. */
static int tell(frot_opening *p, int contact, const two_ways *found) {
  const double *first = p->w->opening.nearest, *second = p->w->opening.second;
  int differs = -1;
  double most = 0;
  /* the rate of an angle says most to the reader, if one differs */
  for (int turning = 1; turning >= 0 && differs < 0 && isfinite(found->missed[1]); turning--) {
    for (int k = 0; k < p->n_own; k++) {
      double apart = fabs(first[k] - second[k]);
      if (turning && frot_angle_of(p->m, p->part->reads.v[k]) < 0) continue;
      if (apart > (1 + FROT_SAME_BRANCH) * most) most = apart, differs = k;
    }
  }
  int speed = differs >= 0 ? p->part->reads.v[differs] : -1;
  if (differs >= 0) {
    memcpy(p->x, p->w->opening.start, sizeof(double) * (size_t)p->n_own);
    int own = contact_with_ways(p, &p->m->groups[p->m->speed_group[speed]]);
    contact = own >= 0 ? own : contact;
  }
  int status = frot_fail(p->s, FROT_POSTURE, p->t, contact, 0, speed, 0);
  if (differs >= 0) p->s->fault.where[0] = first[differs], p->s->fault.where[1] = second[differs];
  return status;
}

int frot_choose_branch(frot_opening *p) {
  frot_opening_work *w = &p->w->opening;
  const frot_part *part = p->part;
  const frot_group *groups = p->m->groups;
  size_t bytes = sizeof(double) * (size_t)p->n_own;
  two_ways found = {{INFINITY, INFINITY}};
  int contact = -1;
  for (int k = 0; k < part->n_groups && contact < 0; k++)
    contact = contact_with_ways(p, &groups[part->groups[k]]);
  if (contact < 0) return FROT_OK;
  memcpy(w->start, p->x, bytes);
  find(p, &found);
  for (int k = 0; k < part->n_groups; k++) look_around(p, &groups[part->groups[k]], &found);
  if (!isfinite(found.missed[0]) || found.missed[0] >= FROT_GUESS_LESS * found.missed[1])
    return tell(p, contact, &found);
  memcpy(p->x, w->nearest, bytes);
  return frot_solve_nearest(p);
}
