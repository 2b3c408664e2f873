/* Recorded segments: what a step changes is written for what is awake alone.
 *
 * Of a step inside which nothing had to be decided the stages are written that its dense output is
 * made of, so that its last evaluations are made where somebody looks, if anybody does. */
#ifndef FROT_SEGMENT_STORE_H
#define FROT_SEGMENT_STORE_H

#include "model/workspace.h"

/* What a recorded segment tells of its inside, in the last place of its head: so many vectors of
 * its dense output, those after which are zero, or its end and its stages. */
#define FROT_INSIDE (-1)

/* Whether the recorder takes one more segment; one without room for segments takes any. */
int frot_has_room(const frot_model *m, const frot_recorder *recorder);

/* Append the current segment, with those awake that are in its step; there is room. `stages`:
 * the step is in the scratch memory still, and these are written. */
void frot_record(const frot_model *m, const frot_state *s, const frot_work *w,
                 frot_recorder *recorder, int stages);

/* The whole of a recorded segment, in w->tape where it does not stand by itself. */
frot_segment frot_read_record(const frot_model *m, frot_state *s, frot_work *w,
                              const double *record);

/* When a recorded segment begins, and its length in doubles. */
static inline double frot_record_begin(const double *record) { return record[FROT_RECORD_HEAD]; }
static inline long long frot_record_length(const double *record) { return (long long)record[0]; }

#endif
