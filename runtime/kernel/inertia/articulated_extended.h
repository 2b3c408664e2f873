/* The passes along the steps of a large tree (articulated.h) in wide numbers: data, factor and
 * scratch are laid out alike. */
#ifndef FROT_ARTICULATED_EXTENDED_H
#define FROT_ARTICULATED_EXTENDED_H

#include "frot.h"

/* As frot_tree_factor, frot_tree_forward and frot_tree_times. */
int frot_wide_tree_factor(const frot_group *g, const frot_wide *data, frot_wide *factor,
                          frot_wide *inertia, frot_wide *twist, frot_wide *force);
void frot_wide_tree_forward(const frot_group *g, const frot_wide *data, const frot_wide *factor,
                            frot_wide *twist, frot_wide *x);
void frot_wide_tree_times(const frot_group *g, const frot_wide *data, frot_wide *twist,
                          frot_wide *x);

#endif
