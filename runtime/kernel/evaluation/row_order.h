/* In which order rows are made orthonormal.
 *
 * Of two rows that nearly agree the difference says something of its own, but badly: what rounding
 * leaves in them is divided by what one leaves of the other. Where there are more rows than can
 * move, as where a box slides over the joint of two tables, others say the same well. So the row of
 * which those before it leave little comes last. Those of loops keep their places: their lengths
 * are followed (singular_posture.c), and the last one left is what vanishes in a posture. */
#ifndef FROT_ROW_ORDER_H
#define FROT_ROW_ORDER_H

#include "model/workspace.h"

/* Note which contacts may part: their normals may wait. */
void frot_note_unilateral_rows(const frot_state *s, frot_work *w);

/* Whether a row, of whose length those before it leave so much, waits for those that come. */
int frot_row_is_deferred(const frot_model *m, const frot_work *w, int row, double rest,
                         double length);

/* Let what stands in place i of an order come in place `last`, and those between one earlier. */
void frot_defer_row(int *order, int i, int last);

#endif
