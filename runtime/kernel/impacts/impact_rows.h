/* The contacts of a component as the rows of an impact (contact/impact_law.h). */
#ifndef FROT_IMPACT_ROWS_H
#define FROT_IMPACT_ROWS_H

#include "modes/enumeration.h"

/* An impact: its problem in w->impacts, the contact that meets first, its speed, how many take part
 * and in how many phases. */
typedef struct {
  frot_impact_problem problem;
  int first, together, phases;
  int driver; /* the block of the contact that presses without collision, or -1 */
  int struck; /* 1: the last row and block are those of a percussion */
  double rate;
} frot_impact_scene;

/* List the rows, blocks and speeds of the contacts chosen, which are closed in w->search.best;
 * those that meet are in w->impacts.meets; `driver`: the contact that presses without collision, or
 * -1. */
void frot_list_impact(const frot_instant *in, const int *chosen, int count, int driver,
                      frot_impact_scene *scene);

/* Add a percussion to an impact that is listed: a row of its own, by whose impulse the rows of the
 * model change by `change` (n_rows: speeds, and impulses of readings). Contacts at rest give
 * nothing back of it. Returns 0 where it does nothing. */
int frot_add_percussion(const frot_instant *in, const double *change, frot_impact_scene *scene);
/* Leave it out again. */
void frot_drop_percussion(const frot_instant *in, frot_impact_scene *scene);

/* Let contacts that have settled (accumulation.h) and would bounce give nothing back, and the
 * speeds be those before the impact again. Returns whether there are any. */
int frot_settle_beside(const frot_instant *in, const frot_impact_scene *scene);

/* Take from the motion after an impact, by the least change, what its impulses leave of the speeds
 * of rows at rest, and with `settles` the last speeds of contacts that have settled
 * (accumulation.h). Returns 1 where that cannot be. */
int frot_hold_at_rest(const frot_instant *in, const frot_impact_scene *scene, int settles);

/* v <- the speeds after the impulses w->impacts.impulse. */
void frot_apply_impact(const frot_instant *in, const frot_impact_scene *scene, double *v);

/* Energy that the rows of a contact have taken, in J, and its normal impulse. */
double frot_lost_by_contact(const frot_instant *in, const frot_impact_scene *scene, int contact,
                            double *impulse);

#endif
