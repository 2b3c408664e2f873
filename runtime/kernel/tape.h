/* Recorded segments: what a step changes is written for what is awake alone. */
#ifndef FROT_TAPE_H
#define FROT_TAPE_H

#include "work.h"

/* Whether the recorder takes one more segment; one without room for segments takes any. */
int frot_has_room(const frot_model *m, const frot_work *w, const frot_recorder *recorder);

/* Append the current segment; there is room. */
void frot_record(const frot_model *m, frot_state *s, frot_work *w, frot_recorder *recorder);

/* The whole of a recorded segment, in w->tape where it does not stand by itself. */
frot_segment frot_read_record(const frot_model *m, frot_work *w, const double *record);

/* When a recorded segment begins, and its length in doubles. */
static inline double frot_record_begin(const double *record) { return record[FROT_RECORD_HEAD]; }
static inline long long frot_record_length(const double *record) { return (long long)record[0]; }

#endif
