/* Rows that others keep: relations of loops that are stated twice, rest held twice.
 *
 * Which rows depend on others is seen where all of them hold. The stages of a step, and its end
 * before it is projected, lie off the relations by the error of the step: there a row that depends
 * on others seems to be one of its own, and its small remainder is error, whose direction
 * would move the mechanism. So it is decided at the start of a step, and followed inside it. */
#ifndef FROT_REDUNDANT_ROWS_H
#define FROT_REDUNDANT_ROWS_H

#include "model/workspace.h"

/* Decide: of the rows that the evaluation at the start of a step found to depend on each other
 * those that are best left out, as many as it found too many. Returns whether the sign of a
 * determinant is that of other rows. */
int frot_find_redundant_rows(const frot_model *m, frot_state *s, frot_work *w);

/* After a step that followed them: of the contacts those that are best left out now, as many.
 * Returns whether these are others. */
int frot_update_redundant_contacts(const frot_model *m, frot_state *s, frot_work *w);

/* Follow what was decided, redundant (n_rows), until frot_forget_redundant_rows. */
void frot_use_redundant_rows(const frot_model *m, frot_work *w, const double *spare);

/* Let every evaluation see for itself what depends on what. */
void frot_forget_redundant_rows(frot_work *w);

/* Whether a row is left to others by what is followed. */
int frot_is_redundant(const frot_work *w, int row);

/* Whether the rows that were left out hold at the end z (nq + nv, put onto the others) of a step;
 * else they depended on others for an instant only, in a singular posture. */
int frot_redundant_rows_hold(const frot_model *m, frot_state *s, frot_work *w, double t, double *z);

/* Take every row for one of its own, in the step that runs. */
void frot_restore_redundant_rows(const frot_model *m, frot_state *s, frot_work *w);

/* The speeds that no permanent row holds, after an evaluation: those that depend on others are
 * none. */
long long frot_count_free_speeds(const frot_model *m, const frot_state *s, const frot_work *w);

#endif
