#include "recording/segment_store.h"

#include <string.h>

#include "model/sleeping.h"
#include "model/segment.h"
#include "methods/dormand_prince.h"

/* Instants t0, t1 and length h of a segment. */
#define TIMES 3

int frot_has_room(const frot_model *m, const frot_recorder *recorder) {
  long long size = frot_segment_size(m);
  return !recorder->segments || recorder->segment_used + size <= recorder->segment_capacity;
}

/* Doubles to or from the end of the tape. */
typedef struct {
  double *at;
} tape;

static void write(tape *to, const double *from, int count) {
  memcpy(to->at, from, sizeof(double) * (size_t)count);
  to->at += count;
}

static void read(tape *from, double *to, int count) {
  memcpy(to, from->at, sizeof(double) * (size_t)count);
  from->at += count;
}

/* Doubles of a segment before its dense output, and of one that stands by itself before that. */
static int head_of(const frot_work *w) { return w->layout.ns - DP_DENSE * w->layout.nx; }

/* A vector of all states: all of it, or those awake. */
static void write_states(const frot_work *w, tape *to, const double *all, int whole) {
  if (whole) {
    write(to, all, w->layout.nx);
  } else {
    frot_pack_awake(w, all, to->at);
    to->at += w->awake.n;
  }
}

static void read_states(const frot_work *w, tape *from, double *all, int whole) {
  if (whole) {
    read(from, all, w->layout.nx);
  } else {
    frot_unpack_awake(w, from->at, all);
    from->at += w->awake.n;
  }
}

/* A stage: what sleeps has no slope. */
static void write_stage(const frot_work *w, tape *to, const double *packed, int whole) {
  if (!whole) {
    write(to, packed, w->awake.n);
    return;
  }
  memset(to->at, 0, sizeof(double) * (size_t)w->layout.nx);
  frot_unpack_awake(w, packed, to->at);
  to->at += w->layout.nx;
}

static void read_stage(const frot_work *w, tape *from, double *packed, int whole) {
  if (whole) {
    frot_pack_awake(w, from->at, packed);
    from->at += w->layout.nx;
  } else {
    read(from, packed, w->awake.n);
  }
}

/* What a segment has of those awake, but for its inside. */
static void write_awake(const frot_model *m, const frot_work *w, const frot_segment *g, tape *to) {
  const frot_awake_lists *now = w->awake.now;
  write(to, g->t0, TIMES);
  for (int k = 0; k < now->n_elements; k++) {
    write(to, g->along + FROT_BOUNDING * now->elements[k], FROT_BOUNDING);
    write(to, g->heading + now->elements[k], 1);
    write(to, g->friction + now->elements[k], 1);
  }
  for (int k = 0; k < now->n_groups; k++) {
    const frot_group *group = &m->groups[now->groups[k]];
    for (int i = 0; i < group->n_rows; i++) write(to, g->spare + group->rows[i], 1);
  }
  write(to, g->y0, 2 * m->ny);
  write_states(w, to, g->x0, 0);
}

static void read_awake(const frot_model *m, const frot_work *w, const frot_segment *g, tape *from) {
  const frot_awake_lists *now = w->awake.now;
  read(from, g->t0, TIMES);
  for (int k = 0; k < now->n_elements; k++) {
    read(from, g->along + FROT_BOUNDING * now->elements[k], FROT_BOUNDING);
    read(from, g->heading + now->elements[k], 1);
    read(from, g->friction + now->elements[k], 1);
  }
  for (int k = 0; k < now->n_groups; k++) {
    const frot_group *group = &m->groups[now->groups[k]];
    for (int i = 0; i < group->n_rows; i++) read(from, g->spare + group->rows[i], 1);
  }
  read(from, g->y0, 2 * m->ny);
  read_states(w, from, g->x0, 0);
}

/* The vectors of its dense output that are not zero: the implicit methods, and what rests, need
 * fewer. */
static int vectors_of(const frot_work *w, const frot_segment *g) {
  int nx = w->layout.nx, end = DP_DENSE * nx;
  while (end > 0 && g->f[end - 1] == 0) end--;
  return (end + nx - 1) / nx;
}

void frot_record(const frot_model *m, const frot_state *s, const frot_work *w,
                 frot_recorder *recorder, int stages) {
  double *record = recorder->segments + recorder->segment_used;
  frot_segment g = frot_segment_at(m, (double *)s->data + w->layout.segment);
  tape to = {record + FROT_RECORD_HEAD};
  int whole = s->asleep == 0 || recorder->segment_used == 0 || recorder->naps != s->naps;
  if (whole) {
    recorder->whole = recorder->segment_used, recorder->naps = s->naps;
    write(&to, g.t0, head_of(w));
    write(&to, s->data + w->layout.asleep, m->n_islands);
  } else {
    write_awake(m, w, &g, &to);
  }
  int vectors = stages ? FROT_INSIDE : vectors_of(w, &g);
  if (stages) {
    write_states(w, &to, w->step.z1, whole);
    for (int i = 0; i < DP_INSIDE; i++) write_stage(w, &to, frot_stage(w, dp_inside[i]), whole);
  } else {
    for (int i = 0; i < vectors; i++) write_states(w, &to, g.f + i * w->layout.nx, whole);
  }
  record[0] = (double)(to.at - record);
  record[1] = (double)(recorder->segment_used - recorder->whole);
  record[2] = vectors;
  recorder->last = recorder->segment_used;
  recorder->segment_used += to.at - record;
}

/* The step of a segment, as its stages tell it, back in the scratch memory, and its last
 * evaluations.
 */
static void read_stages(const frot_model *m, frot_state *s, frot_work *w, const frot_segment *g,
                        tape *from, int whole) {
  size_t size = sizeof(double) * (size_t)w->layout.nx;
  memcpy(w->step.z0, g->x0, size), memcpy(w->step.z1, g->x0, size);
  read_states(w, from, w->step.z1, whole);
  for (int i = 0, k = 0; i <= DP_STAGES; i++) {
    if (i == dp_inside[k])
      read_stage(w, from, frot_stage(w, i), whole), k++;
    else
      memset(frot_stage(w, i), 0, size);
  }
  frot_complete_dense_output(m, s, w, g);
}

frot_segment frot_read_record(const frot_model *m, frot_state *s, frot_work *w,
                              const double *record) {
  const double *base = record - (long long)record[1] + FROT_RECORD_HEAD;
  int whole = record[1] == 0;
  frot_segment g = frot_segment_at(m, w->tape);
  tape from = {(double *)record + FROT_RECORD_HEAD};
  memcpy(w->tape, base, sizeof(double) * (size_t)head_of(w));
  memset(g.f, 0, sizeof(double) * DP_DENSE * (size_t)w->layout.nx);
  frot_restore_sleep(m, w, base + head_of(w));
  if (whole)
    from.at += head_of(w) + m->n_islands;
  else
    read_awake(m, w, &g, &from);
  if (record[2] == FROT_INSIDE)
    read_stages(m, s, w, &g, &from, whole);
  else
    for (int i = 0; i < (int)record[2]; i++) read_states(w, &from, g.f + i * w->layout.nx, whole);
  frot_leave_sleep(w);
  return g;
}
