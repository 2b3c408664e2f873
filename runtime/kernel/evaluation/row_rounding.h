/* What rounding leaves in the rows of a group. */
#ifndef FROT_ROW_ROUNDING_H
#define FROT_ROW_ROUNDING_H

#include "model/workspace.h"

/* Sizes of what drives bring to c, where they may cancel in it; then those of all its terms, into
 * w->core.bias_size, at the speeds v. */
void frot_size_drives(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                      const double *v, const double *d);
void frot_size_biases(const frot_model *m, const frot_state *s, frot_work *w, const frot_group *g,
                      const double *v);

/* Where all loads of a group are what rounding of its speeds makes of them, they are zero:
 * reactions would be made of rounding alone. After frot_size_biases and frot_factor. */
void frot_drop_loads(const frot_model *m, const frot_state *s, frot_work *w, const frot_group *g,
                     const double *v);

/* Let rows that are nothing but rounding be zero, and the speeds that they give. */
void frot_clean_rows(const frot_model *m, const frot_state *s, frot_work *w, const frot_group *g,
                     const double *v);

/* The slip of an element at the speeds v below which it may be dropped with its row. */
double frot_dropped_rate(const frot_model *m, const frot_state *s, const frot_work *w, int element,
                         const double *v);

#endif
