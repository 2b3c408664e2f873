/* Motion on the relations: projection onto them, and speeds that they hold at zero. */
#ifndef FROT_PROJECTION_H
#define FROT_PROJECTION_H

#include "state.h"

/* Move speeds (and, with `position`, coordinates first) onto the relations that hold in `modes`,
 * by the least change in the metric of the mass. `stuck` (n_contacts, may be NULL): contacts whose
 * slip (bit 0) or rolling (bit 1) is to be zero whatever their mode. Returns 1 if anything moved.
 */
int frot_project(const frot_model *m, frot_state *s, frot_work *w, double t, double *q, double *v,
                 const double *d, const frot_contact_mode *modes, const unsigned char *stuck,
                 int position);

/* Speeds that the relations of `modes` hold at zero for as long as the mode lasts: frozen (nv).
 * A relation counts when it depends on frozen coordinates alone. Uses w->rows. */
void frot_find_frozen(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                      double *frozen);

#endif
