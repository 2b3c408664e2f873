#include "inertia/articulated.h"

#include <string.h>

#include "inertia/articulated_passes.h"

static inline void outwards(int width, const frot_group *g, const double *data,
                            const double *factor, double *twist, double *x) {
  for (int k = 0; k < g->n_links; k++) {
    const frot_link *s = &g->links[k];
    double *motion = carry_to(width, s, k, data, twist);
    for (int j = s->count - 1; j >= 0 && !s->auxiliary; j--) {
      const double *column = data + s->data + width * j, *y = factor + s->factor + (width + 1) * j;
      double *own = x + s->first + j;
      *own = y[width] * (*own - dot(width, y, motion));
      add_times(width, motion, *own, column);
    }
  }
}

/* Reactions between steps: of what is beyond an auxiliary one, the inertia that it shows times its
 * motion, and what the forces there do that let it go. */
static inline void read(int width, const frot_group *g, const double *data, const double *factor,
                        const double *wrench, const double *motion, double *x) {
  for (int k = 0; k < g->n_links; k++) {
    const frot_link *s = &g->links[k];
    const double *p = factor + s->factor, *forces = p + inertia_size(width);
    double whole[SPACE];
    if (!s->auxiliary) continue;
    times(width, p, motion + width * k, whole);
    for (int i = 0; i < width; i++) whole[i] += forces[i] + wrench[width * k + i];
    for (int j = 0; j < s->count; j++)
      x[s->first + j] = dot(width, data + s->data + width * j, whole);
  }
}

static inline void respond(int width, const frot_group *g, const double *data, const double *factor,
                           double *wrench, double *motion, const double *force, double *x) {
  inwards(width, g, data, factor, wrench, x);
  for (int k = 0; k < g->n_speeds; k++) x[k] += force[k];
  outwards(width, g, data, factor, motion, x);
  read(width, g, data, factor, wrench, motion, x);
}

/* Composite bodies: the inertia of all that a step carries. */
static inline void take_diagonal(int width, const frot_group *g, const double *data,
                                 double *inertia, double *diagonal) {
  int size = inertia_size(width);
  for (int k = 0; k < g->n_links; k++)
    own_inertia(width, mass_of(width, &g->links[k], data), inertia + size * k);
  for (int k = g->n_links - 1; k >= 0; k--) {
    const frot_link *s = &g->links[k];
    const double *whole = inertia + size * k;
    for (int j = 0; j < s->count; j++) {
      double momenta[SPACE];
      times(width, whole, data + s->data + width * j, momenta);
      diagonal[s->first + j] = dot(width, data + s->data + width * j, momenta);
    }
    if (s->above >= 0)
      add_inertia(width, s->faces_ground, arm_of(width, s, data), whole, inertia + size * s->above);
  }
}

static inline double make_square(int width, const frot_group *g, const double *data, double *twist,
                                 const double *v) {
  double sum = 0;
  for (int k = 0; k < g->n_links; k++) {
    const frot_link *s = &g->links[k];
    double *motion = carry_to(width, s, k, data, twist), own[SPACE];
    for (int j = 0; j < s->count && !s->auxiliary; j++)
      add_times(width, motion, v[g->unknowns[s->first + j]], data + s->data + width * j);
    momentum(width, mass_of(width, s, data), motion, own);
    sum += dot(width, own, motion);
  }
  return sum;
}

int frot_tree_factor(const frot_group *g, const double *data, double *factor, double *inertia,
                     double *twist, double *force) {
  return g->width == PLANE ? factorize(PLANE, g, data, factor, inertia, twist, force)
                           : factorize(SPACE, g, data, factor, inertia, twist, force);
}

void frot_tree_forward(const frot_group *g, const double *data, const double *factor, double *twist,
                       double *x) {
  if (g->width == PLANE)
    inwards(PLANE, g, data, factor, twist, x);
  else
    inwards(SPACE, g, data, factor, twist, x);
}

void frot_tree_backward(const frot_group *g, const double *data, const double *factor,
                        double *twist, double *x) {
  if (g->width == PLANE)
    outwards(PLANE, g, data, factor, twist, x);
  else
    outwards(SPACE, g, data, factor, twist, x);
}

void frot_tree_respond(const frot_group *g, const double *data, const double *factor,
                       double *wrench, double *motion, const double *force, double *x) {
  if (g->width == PLANE)
    respond(PLANE, g, data, factor, wrench, motion, force, x);
  else
    respond(SPACE, g, data, factor, wrench, motion, force, x);
}

void frot_tree_times(const frot_group *g, const double *data, double *twist, double *x) {
  if (g->width == PLANE)
    multiply(PLANE, g, data, twist, x);
  else
    multiply(SPACE, g, data, twist, x);
}

void frot_tree_diagonal(const frot_group *g, const double *data, double *inertia,
                        double *diagonal) {
  if (g->width == PLANE)
    take_diagonal(PLANE, g, data, inertia, diagonal);
  else
    take_diagonal(SPACE, g, data, inertia, diagonal);
}

double frot_tree_square(const frot_group *g, const double *data, double *twist, const double *v) {
  return g->width == PLANE ? make_square(PLANE, g, data, twist, v)
                           : make_square(SPACE, g, data, twist, v);
}
