/* The motion where another integrator steps it: states and time are set from outside, events are
 * handled here. The current segment is a single instant with the states set. */
#ifndef FROT_MODEL_EXCHANGE_H
#define FROT_MODEL_EXCHANGE_H

#include "frot.h"

/* Continuous states: coordinates, speeds, dissipated energy, work of forces without potential. */
int frot_exchange_states(const frot_model *model);
/* Guards: positive while the modes and conditions last, and 1 where they cannot end them. */
int frot_exchange_guards(const frot_model *model);

/* Time and states; `x` NULL: the states stay. */
void frot_exchange_place(const frot_model *model, frot_state *state, frot_work *work, double t,
                         const double *x);
void frot_exchange_read(const frot_model *model, frot_state *state, double *x);
/* The largest sizes that the states have had, and no less than the usual ones; of energies, on
 * which nothing depends, INFINITY. */
void frot_exchange_sizes(const frot_model *model, const frot_state *state, double *x);
/* Usual sizes of the states: those of the text, else 1. */
void frot_exchange_nominals(const frot_model *model, const frot_state *state, double *x);

/* At the start, after frot_start: what is zero there has not come to zero. */
void frot_exchange_begin(const frot_model *model, frot_state *state, frot_work *work);

/* Rates of the states and values of the guards at the time reached. FROT_OK or a status that is not
 * recorded as a fault: there is no motion in this mode at these states. */
int frot_exchange_rates(const frot_model *model, frot_state *state, frot_work *work, double *rates,
                        double *guards);

/* As frot_values, also a little beyond an event that is still to happen. */
int frot_exchange_values(const frot_model *model, frot_state *state, frot_work *work,
                         double *values);

/* Let inputs set act at once, without an event. FROT_OK or the status of the fault recorded. */
int frot_exchange_inputs(const frot_model *model, frot_state *state, frot_work *work);

/* A step of the other integrator ends at the states set: note how large values are. *event: the
 * states have left the relations that hold by more than a hundred tolerances. FROT_OK or the status
 * of the fault recorded. */
int frot_exchange_accept(const frot_model *model, frot_state *state, frot_work *work, int *event);

/* Put the states onto the relations, and let everything happen that the guards and time bring about
 * there. *moved: the states are others. FROT_OK, FROT_TERMINATED or the status of the fault
 * recorded. */
int frot_exchange_event(const frot_model *model, frot_state *state, frot_work *work, int *moved,
                        frot_recorder *recorder);

#endif
