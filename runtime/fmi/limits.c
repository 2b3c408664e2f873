/* How much work one step may take: evaluations of the model, its pace, and seconds. */
#include <stdlib.h>
#include <time.h>

#include "instance.h"

/* A step is given up early where it would take this many times the most work at its pace so far,
 * which this many evaluations tell: one of 1e300 s ends in seconds. */
#define HOPELESS 1000.0
#define TELLING 400000.0

/* A positive number of the environment of the process; the former value where there is none. */
static int read_limit(const frot_fmu *fmu, const char *function, const char *name, double *value) {
  const char *text = getenv(name);
  char *end = NULL;
  if (text == NULL || *text == '\0') return FROT_FMU_OK;
  const double read = strtod(text, &end);
  if (*end != '\0' || !(read > 0.0))
    return frot_fmu_say(fmu, FROT_FMU_ERROR,
                        "%s: the environment variable %s is '%s', which is not a positive number.",
                        function, name, text);
  *value = read;
  return FROT_FMU_OK;
}

int frot_fmu_read_limits(const frot_fmu *fmu, const char *function, frot_fmu_limits *limits) {
  limits->evaluations = (double)frot_fmu_most_work;
  limits->seconds = 0.0;
  const int status = read_limit(fmu, function, "FROT_FMU_EVALUATIONS", &limits->evaluations);
  if (status != FROT_FMU_OK) return status;
  return read_limit(fmu, function, "FROT_FMU_SECONDS", &limits->seconds);
}

frot_fmu_budget frot_fmu_begin_budget(frot_fmu *fmu, double t) {
  const frot_fmu_budget budget = {fmu,
                                  (double)frot_run_statistics(fmu->state)->evaluations,
                                  frot_time(fmu->state),
                                  t,
                                  time(NULL),
                                  0,
                                  FROT_FMU_LEFT};
  return budget;
}

static int is_cancelled(frot_fmu *fmu, double t) {
  fmu->life.phase = FROT_FMU_PAUSED;
  const int ends = fmu->caller(fmu, FROT_FMU_PAUSE, t);
  fmu->life.phase = FROT_FMU_STEPPING;
  return ends;
}

int frot_fmu_spent(void *context, double t) {
  frot_fmu_budget *b = context;
  const frot_fmu_limits *limits = &b->fmu->limits;
  if (b->until_event && frot_fmu_has_event(b->fmu)) return 1;
  const double taken = (double)frot_run_statistics(b->fmu->state)->evaluations - b->before;
  const double done = (t - b->begin) / (b->end - b->begin);
  if (taken > limits->evaluations)
    b->spent = FROT_FMU_EVALUATIONS;
  else if (taken > TELLING && done * HOPELESS * limits->evaluations < taken)
    b->spent = FROT_FMU_PACE;
  else if (limits->seconds > 0.0 && difftime(time(NULL), b->started) >= limits->seconds)
    b->spent = FROT_FMU_SECONDS;
  else if (b->fmu->caller != NULL && is_cancelled(b->fmu, t))
    b->spent = FROT_FMU_CANCELLED;
  return b->spent != FROT_FMU_LEFT;
}

int frot_fmu_say_spent(const frot_fmu *fmu, const char *function, const frot_fmu_budget *b) {
  static const char *const remedy =
      "make shorter steps, or look for values that make the motion stiff";
  const double reached = fmu->life.t;
  switch (b->spent) {
    case FROT_FMU_SECONDS:
      return frot_fmu_say(fmu, FROT_FMU_DISCARD,
                          "%s: the step to %.15g s has taken %g s, the most by FROT_FMU_SECONDS, "
                          "and ends at %.15g s.",
                          function, b->end, fmu->limits.seconds, reached);
    case FROT_FMU_PACE:
      return frot_fmu_say(
          fmu, FROT_FMU_DISCARD,
          "%s: at its pace the step to %.15g s would take more than %g times the "
          "%.0f evaluations of the model that it may take, and ends at %.15g s; %s.",
          function, b->end, HOPELESS, fmu->limits.evaluations, reached, remedy);
    default:
      return frot_fmu_say(fmu, FROT_FMU_DISCARD,
                          "%s: the step to %.15g s has taken %.0f evaluations of the model, the "
                          "most that one step may take, and ends at %.15g s; %s.",
                          function, b->end, fmu->limits.evaluations, reached, remedy);
  }
}
