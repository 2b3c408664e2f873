/* The modes of an instant, component after component. */
#ifndef FROT_CHOOSE_MODES_H
#define FROT_CHOOSE_MODES_H

#include "modes/enumeration.h"

/* The modes of the instant `in`, after frot_dynamics (FROT_LAWS) and frot_row_loads, into
 * w->search.best; each component that has several motions is recorded as an event. `first` and
 * recorder as in frot_resolve. FROT_OK or the status of the fault recorded; FROT_DIVERGE without a
 * fault where modes have jammed: what is to blame is looked for elsewhere, which a search that may
 * go on does not outlast. */
int frot_choose_modes(const frot_instant *in, double t, int first, frot_recorder *recorder);

#endif
