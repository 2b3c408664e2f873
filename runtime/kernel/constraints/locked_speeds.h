/* Speeds that relations hold at zero. */
#ifndef FROT_LOCKED_SPEEDS_H
#define FROT_LOCKED_SPEEDS_H

#include "model/workspace.h"

/* Speeds that the relations of `modes` hold at zero for as long as the mode lasts: frozen (nv).
 * A relation counts when it depends on frozen coordinates alone. After frot_kinematics; drops from
 * w->core.rows what is rounding of lengths that cancel. */
void frot_find_locked_speeds(const frot_model *m, const frot_state *s, frot_work *w,
                             const frot_contact_mode *modes, double *frozen);

/* Whether state k, a coordinate or a speed, stays where it is while the frozen speeds are zero. */
int frot_state_stays(const frot_model *m, const double *frozen, int k);

#endif
