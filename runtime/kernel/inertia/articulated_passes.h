/* Passes along the steps of a large tree (articulated.h) that are made in ordinary and in wide
 * numbers: `real` of articulated_step.h. */
#ifndef FROT_ARTICULATED_PASSES_H
#define FROT_ARTICULATED_PASSES_H

#include "inertia/articulated_step.h"

/* What the forces of the factor do at a step, for each whose speeds are auxiliary. */
static inline void note_forces(int width, const frot_group *g, const real *data, real *factor,
                               real *twist, const real *force) {
  memset(twist, 0, sizeof(real) * (size_t)(width * g->n_links));
  for (int k = g->n_links - 1; k >= 0; k--) {
    const frot_link *s = &g->links[k];
    real *wrench = twist + width * k, *y = factor + s->factor;
    if (s->auxiliary) memcpy(y + inertia_size(width), wrench, sizeof(real) * (size_t)width);
    for (int j = 0; j < s->count && !s->auxiliary; j++, y += width + 1)
      add_times(width, wrench, force[s->first + j], y);
    if (s->above >= 0)
      add_wrench(width, s->faces_ground, arm_of(width, s, data), wrench, twist + width * s->above);
  }
}

static inline int factorize(int width, const frot_group *g, const real *data, real *factor,
                            real *inertia, real *twist, real *force) {
  int size = inertia_size(width), reads = 0;
  for (int k = 0; k < g->n_links; k++) {
    const frot_link *s = &g->links[k];
    own_inertia(width, mass_of(width, s, data), inertia + size * k);
    memcpy(twist + width * k, wrench_of(width, s, data), sizeof(real) * (size_t)width);
  }
  for (int k = g->n_links - 1; k >= 0; k--) {
    const frot_link *s = &g->links[k];
    real *p = inertia + size * k, *wrench = twist + width * k, whole[2];
    const real *column = data + s->data;
    real *y = factor + s->factor;
    sizes_of(width, p, whole);
    for (int j = 0; j < s->count && !s->auxiliary; j++, column += width, y += width + 1)
      if (let_go(width, column, whole, p, wrench, y, force + s->first + j)) return 1;
    if (s->auxiliary) memcpy(y, p, sizeof(real) * (size_t)size), reads = 1;
    if (s->above < 0) continue;
    const real *arm = arm_of(width, s, data);
    add_inertia(width, s->faces_ground, arm, p, inertia + size * s->above);
    add_wrench(width, s->faces_ground, arm, wrench, twist + width * s->above);
  }
  if (reads) note_forces(width, g, data, factor, twist, force);
  return 0;
}

/* Whether neither a wrench nor a force of a speed acts at a step, as beyond all that a row moves.
 */
static inline int nothing_acts(int width, const frot_link *s, const real *wrench, const real *x) {
  for (int i = 0; i < width; i++)
    if (wrench[i] != 0) return 0;
  for (int j = 0; j < s->count && !s->auxiliary; j++)
    if (x[s->first + j] != 0) return 0;
  return 1;
}

static inline void inwards(int width, const frot_group *g, const real *data, const real *factor,
                           real *twist, real *x) {
  memset(twist, 0, sizeof(real) * (size_t)(width * g->n_links));
  for (int k = g->n_links - 1; k >= 0; k--) {
    const frot_link *s = &g->links[k];
    real *wrench = twist + width * k;
    const real *column = data + s->data, *y = factor + s->factor;
    if (nothing_acts(width, s, wrench, x)) continue;
    for (int j = 0; j < s->count && !s->auxiliary; j++, column += width, y += width + 1) {
      real *own = x + s->first + j;
      *own = y[width] * (*own - dot(width, column, wrench));
      add_times(width, wrench, *own, y);
    }
    if (s->above >= 0)
      add_wrench(width, s->faces_ground, arm_of(width, s, data), wrench, twist + width * s->above);
  }
}

/* Momenta of a step's bodies by themselves that move by `motion`. */
static inline void momentum(int width, const real *mass, const real *motion, real *own) {
  real p[FROT_STEP_INERTIA];
  own_inertia(width, mass, p);
  times(width, p, motion, own);
}

static inline void multiply(int width, const frot_group *g, const real *data, real *twist,
                            real *x) {
  for (int k = 0; k < g->n_links; k++) {
    const frot_link *s = &g->links[k];
    real *motion = carry_to(width, s, k, data, twist);
    for (int j = 0; j < s->count; j++)
      if (x[s->first + j] != 0)
        add_times(width, motion, x[s->first + j], data + s->data + width * j);
  }
  for (int k = 0; k < g->n_links; k++) {
    real own[SPACE];
    momentum(width, mass_of(width, &g->links[k], data), twist + width * k, own);
    memcpy(twist + width * k, own, sizeof(real) * (size_t)width);
  }
  for (int k = g->n_links - 1; k >= 0; k--) {
    const frot_link *s = &g->links[k];
    const real *whole = twist + width * k;
    for (int j = 0; j < s->count; j++)
      x[s->first + j] = dot(width, data + s->data + width * j, whole);
    if (s->above >= 0)
      add_wrench(width, s->faces_ground, arm_of(width, s, data), whole, twist + width * s->above);
  }
}

#endif
