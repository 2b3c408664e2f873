/* The impact of one component of contacts: what it does to speeds, modes and events. */
#ifndef FROT_COMPONENT_IMPACT_H
#define FROT_COMPONENT_IMPACT_H

#include "impacts/impact_rows.h"

/* Evaluate the kinematics of the instant and list the contacts that may be closed in
 * w->search.best. FROT_OK or a status that is not recorded as a fault. */
int frot_evaluate_closable(frot_instant *in, int first);

/* The contacts of a component into w->search.chosen; returns how many. */
int frot_choose_component(const frot_instant *in, int root);

/* Solve the impact listed in `scene` and let it act on the speeds v and the modes; its events are
 * recorded. `driver`: the contact that presses by its friction alone, or -1; `settles`: contacts
 * settle (accumulation.h). *lost grows by the energy that contacts take. FROT_OK or the status of
 * the fault recorded. */
int frot_act_on_component(const frot_instant *in, const int *chosen, int count, int driver,
                          int settles, frot_impact_scene *scene, double *v, double *lost,
                          frot_recorder *recorder);

/* Count the energy `lost`, and the work done from the kinetic energy `before` to that of v. */
void frot_count_energy(const frot_instant *in, double before, double lost, const double *v);

#endif
