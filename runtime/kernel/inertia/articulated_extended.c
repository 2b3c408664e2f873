#include "inertia/articulated_extended.h"

#define FROT_IN_WIDE
#include "inertia/articulated_passes.h"

int frot_wide_tree_factor(const frot_group *g, const frot_wide *data, frot_wide *factor,
                          frot_wide *inertia, frot_wide *twist, frot_wide *force) {
  return factorize(g->width, g, data, factor, inertia, twist, force);
}

void frot_wide_tree_forward(const frot_group *g, const frot_wide *data, const frot_wide *factor,
                            frot_wide *twist, frot_wide *x) {
  inwards(g->width, g, data, factor, twist, x);
}

void frot_wide_tree_times(const frot_group *g, const frot_wide *data, frot_wide *twist,
                          frot_wide *x) {
  multiply(g->width, g, data, twist, x);
}
