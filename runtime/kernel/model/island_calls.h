/* Evaluation of the generated functions that islands have of their own (tables.h), of those awake.
 */
#ifndef FROT_ISLAND_CALLS_H
#define FROT_ISLAND_CALLS_H

#include "model/workspace.h"

/* Fill w->awake.extent; make the rows w->core.rows zero, and tell where they can be anything else;
 * once for a block of scratch memory. */
void frot_measure_islands(const frot_model *m, frot_work *w);
void frot_measure_rows(const frot_model *m, frot_work *w);

/* The results of `dynamics` and `spread`, into w->core; of `kinematics`; of `sizes`, into
 * w->core.load. Where a model has no islands, those of the whole. The first returns 0 where a
 * result that is wanted (evaluate.h) is no number. */
int frot_call_dynamics(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                       const double *v, const double *d, int wanted);
void frot_call_kinematics(const frot_model *m, frot_state *s, frot_work *w, double t,
                          const double *q, const double *v, const double *d);
void frot_call_sizes(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                     const double *v, const double *d);

/* Point w->call.arg at the arguments of an island's functions; returns what is free behind them of
 * w->awake.values. */
double *frot_take_inputs(const frot_state *s, frot_work *w, const frot_island *island,
                         const double *t, const double *q, const double *v, const double *d);

/* The results of `sides` of a part into those of all contacts: witness (3 each) and reach. */
void frot_call_sides(const frot_state *s, frot_work *w, const frot_part *part, double t,
                     const double *q, const double *v, const double *d, double *witness,
                     double *reach);

/* A function of a part, the results of which are set. */
void frot_call_part(const frot_state *s, frot_work *w, const frot_part *part,
                    const frot_callable *function, const double *t, const double *q,
                    const double *v, const double *d);

#endif
