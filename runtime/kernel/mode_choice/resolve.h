/* The modes after an instant: which of the admissible motions follows. */
#ifndef FROT_RESOLVE_H
#define FROT_RESOLVE_H

#include "model/workspace.h"

/* Find the modes that follow time t at coordinates q and speeds v (both may be moved onto the
 * relations that hold, by rounding only), from the modes held in the state and the guards fired.
 *
 * Painleve, Lecons sur le frottement (1895), p. 41-43: where there is no slip, rest is tried first
 * and holds if the reaction it needs is within the bound mu_s N; otherwise the slip starts in the
 * direction in which friction opposes it. All combinations of the coupled contacts are examined, so
 * that none and several motions are known as such.
 *
 * `first`: nothing was known before (start, or values changed from outside). Events go to the
 * recorder, which may be NULL. Returns FROT_OK or the status of the fault recorded. */
int frot_resolve(const frot_model *m, frot_state *s, frot_work *w, double t, double *q, double *v,
                 int first, frot_recorder *recorder);

#endif
