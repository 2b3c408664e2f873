/* Stops at events, for environments that handle them: FMI 3.0's event mode. */
#include <math.h>
#include <string.h>

#include "instance.h"

int frot_fmu_watch_events(frot_fmu *fmu, int returns_early) {
  fmu->before = frot_fmu_memory(fmu->state_size);
  fmu->watches_events = 1;
  fmu->returns_early = returns_early != 0;
  return fmu->before != NULL;
}

static int counts(const frot_fmu *fmu, const frot_event *event) {
  return event->kind != FROT_EVENT_WARNING && event->t > fmu->life.t;
}

int frot_fmu_has_event(const frot_fmu *fmu) {
  for (long long i = 0; i < fmu->recorder.event_count; i++)
    if (counts(fmu, &fmu->recorder.events[i])) return 1;
  return 0;
}

void frot_fmu_see_event(frot_fmu *fmu, const frot_event *event) {
  fmu->seen = 1;
  if (counts(fmu, event) && event->t < fmu->first_event) fmu->first_event = event->t;
}

void frot_fmu_begin_watch(frot_fmu *fmu) {
  const double due = frot_next_instant(fmu->state);
  fmu->seen = 0;
  fmu->first_event = due > fmu->life.t ? due : INFINITY;
  if (fmu->watches_events) memcpy(fmu->before, fmu->state, fmu->state_size);
}

void frot_fmu_go_back(frot_fmu *fmu) { memcpy(fmu->state, fmu->before, fmu->state_size); }

int frot_fmu_enter_event_mode(frot_fmu *fmu, const char *function) {
  if (!fmu->watches_events)
    return frot_fmu_refuse(fmu, function, "the instance was made without event mode");
  if (fmu->life.phase != FROT_FMU_STEPPING) return frot_fmu_misplaced(fmu, function);
  fmu->life.phase = FROT_FMU_EVENT;
  return FROT_FMU_OK;
}

int frot_fmu_update_discrete(frot_fmu *fmu, const char *function) {
  if (fmu->life.phase == FROT_FMU_ENDED) return FROT_FMU_OK;
  if (fmu->life.phase != FROT_FMU_EVENT) return frot_fmu_misplaced(fmu, function);
  const int status = frot_fmu_settle(fmu, function);
  return fmu->life.phase == FROT_FMU_ENDED ? FROT_FMU_OK : status;
}

int frot_fmu_enter_step_mode(frot_fmu *fmu, const char *function) {
  if (fmu->exchanges)
    return frot_fmu_refuse(fmu, function, "the instance was made for model exchange");
  if (fmu->life.phase != FROT_FMU_EVENT) return frot_fmu_misplaced(fmu, function);
  const int status = frot_fmu_settle(fmu, function);
  if (status == FROT_FMU_OK) fmu->life.phase = FROT_FMU_STEPPING;
  return status;
}
