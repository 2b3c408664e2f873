/* Runs a compiled model under sanitizers: whole runs, runs in pieces, saved states, bad values. */
#include <math.h>
#include <sanitizer/asan_interface.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "frot.h"

static int stop_at_once(void *context, double t) {
  (void)t;
  return ++*(int *)context > 0;
}

/* Fill the scratch, the gaps between its pieces too. */
static void spoil(frot_work *w, int with, size_t size) {
  ASAN_UNPOISON_MEMORY_REGION(w, size);
  memset(w, with, size);
}

int main(int argc, char **argv) {
  const frot_model *m = &frot_the_model;
  double end = argc > 1 ? atof(argv[1]) : 3;
  size_t size = frot_state_size(m);
  long long ns = frot_segment_size(m);
  frot_state *s = malloc(size), *saved = malloc(size);
  frot_work *w = malloc(frot_work_size(m));
  double *values = malloc(sizeof(double) * (size_t)m->n_variables);
  double *segments = malloc(sizeof(double) * (size_t)(4 * ns));
  frot_event *events = malloc(sizeof *events * (size_t)frot_events_at_once(m));
  char text[64];
  int failures = 0;
  spoil(w, 0x5a, frot_work_size(m));
  for (int round = 0; round < 20; round++) {
    frot_state_clear(m, s);
    if (frot_advance(m, s, w, 1, NULL, NULL, NULL) != FROT_MISUSE) failures++;
    if (frot_start(m, s, w, 0, NULL) != FROT_OK) return 2;
    frot_recorder recorder = {segments, 4 * ns, 0, events, frot_events_at_once(m), 0, 0, 0, 0};
    double t = 0;
    while (t < end) {
      t += end / (3 + round);
      int status;
      while ((status = frot_advance(m, s, w, t, &recorder, NULL, NULL)) == FROT_FULL) {
        for (long long i = 0; i < recorder.event_count; i++)
          frot_event_text(m, &events[i], text, sizeof text);
        recorder.event_count = recorder.segment_used = 0;
      }
      if (status != FROT_OK) failures++;
      if (frot_values(m, s, w, values) != FROT_OK) failures++;
      memcpy(saved, s, size);
      spoil(w, round, frot_work_size(m)); /* scratch carries nothing */
      if (!frot_state_valid(m, saved, size)) failures++;
      memcpy(s, saved, size);
    }
    double balance[5];
    frot_energy(m, s, w, balance);
    if (!(fabs(balance[0]) <= 1e-6 * balance[1])) failures++;
  }
  int called = 0;
  frot_state_clear(m, s);
  frot_start(m, s, w, 0, NULL);
  frot_advance(m, s, w, 1e3 * end, NULL, stop_at_once, &called);
  /* values no model can have: a status and a sentence, never a trap */
  const double bad[] = {NAN, INFINITY, -1, 0, 1e300, -1e300, 1e-300};
  for (int p = 0; p < m->np; p++)
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
      frot_state_clear(m, s);
      frot_set_parameter(m, s, p, bad[k]);
      int status = frot_start(m, s, w, 0, NULL);
      if (status == FROT_OK) status = frot_advance(m, s, w, end, NULL, NULL, NULL);
      frot_fault_text(m, s, text, sizeof text);
      if (status != FROT_OK && text[0] == 0) failures++;
    }
  free(s), free(saved), free(w), free(values), free(segments), free(events);
  printf("%d failures\n", failures);
  return failures != 0;
}
