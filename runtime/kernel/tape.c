#include "tape.h"

#include <string.h>

#include "awake.h"
#include "segment.h"

/* Instants t0, t1 and length h of a segment. */
#define TIMES 3

int frot_has_room(const frot_model *m, const frot_work *w, const frot_recorder *recorder) {
  long long size = FROT_RECORD_HEAD + w->layout.ns + m->n_islands;
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

/* The segment as it is, and which islands sleep. */
static void write_whole(const frot_model *m, const frot_state *s, const frot_work *w, tape *to) {
  write(to, s->data + w->layout.segment, w->layout.ns);
  write(to, s->data + w->layout.asleep, m->n_islands);
}

static void write_awake(const frot_model *m, frot_state *s, frot_work *w, tape *to) {
  frot_segment g = frot_segment_at(m, s->data + w->layout.segment);
  frot_let_sleep(m, s, w);
  const frot_awake_lists *now = w->awake.now;
  write(to, s->data + w->layout.segment, TIMES);
  for (int k = 0; k < now->n_elements; k++) write(to, g.along + 2 * now->elements[k], 2);
  for (int k = 0; k < now->n_groups; k++) {
    const frot_group *group = &m->groups[now->groups[k]];
    for (int i = 0; i < group->n_rows; i++) write(to, g.spare + group->rows[i], 1);
  }
  write(to, g.y0, 2 * m->ny);
  for (int i = -1; i < DP_DENSE; i++) {
    frot_pack(w, i < 0 ? g.x0 : g.f + i * w->layout.nx, to->at);
    to->at += now->n;
  }
  frot_wake(w);
}

void frot_record(const frot_model *m, frot_state *s, frot_work *w, frot_recorder *recorder) {
  double *record = recorder->segments + recorder->segment_used;
  tape to = {record + FROT_RECORD_HEAD};
  int whole = s->asleep == 0 || recorder->segment_used == 0 || recorder->naps != s->naps;
  if (whole) {
    recorder->whole = recorder->segment_used, recorder->naps = s->naps;
    write_whole(m, s, w, &to);
  } else {
    write_awake(m, s, w, &to);
  }
  record[0] = (double)(to.at - record);
  record[1] = (double)(recorder->segment_used - recorder->whole);
  recorder->last = recorder->segment_used;
  recorder->segment_used += to.at - record;
}

frot_segment frot_read_record(const frot_model *m, frot_work *w, const double *record) {
  const double *whole = record - (long long)record[1] + FROT_RECORD_HEAD;
  if (record[1] == 0) return frot_segment_at(m, (double *)whole);
  frot_segment g = frot_segment_at(m, w->tape);
  tape from = {(double *)record + FROT_RECORD_HEAD};
  memcpy(w->tape, whole, sizeof(double) * (size_t)w->layout.ns);
  frot_list_awake(m, w, whole + w->layout.ns);
  const frot_awake_lists *some = &w->awake.some;
  read(&from, w->tape, TIMES);
  for (int k = 0; k < some->n_elements; k++) read(&from, g.along + 2 * some->elements[k], 2);
  for (int k = 0; k < some->n_groups; k++) {
    const frot_group *group = &m->groups[some->groups[k]];
    for (int i = 0; i < group->n_rows; i++) read(&from, g.spare + group->rows[i], 1);
  }
  read(&from, g.y0, 2 * m->ny);
  for (int i = -1; i < DP_DENSE; i++) {
    double *all = i < 0 ? g.x0 : g.f + i * w->layout.nx;
    for (int k = 0; k < some->n; k++) all[some->states[k]] = from.at[k];
    from.at += some->n;
  }
  return g;
}
