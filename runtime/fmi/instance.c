/* Instances and their log. */
#include "instance.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MESSAGE 2048

static const char *category_of(int status) {
  return status == FROT_FMU_DISCARD ? "logStatusDiscard" : "logStatusError";
}

static unsigned bit_of(const char *name) {
  if (strcmp(name, "logEvents") == 0) return FROT_FMU_LOG_EVENTS;
  if (strcmp(name, "logStatusDiscard") == 0) return FROT_FMU_LOG_DISCARD;
  if (strcmp(name, "logStatusError") == 0) return FROT_FMU_LOG_ERROR;
  if (strcmp(name, "logAll") == 0) return FROT_FMU_LOG_ALL;
  return 0;
}

/* A cut inside a character of several bytes is not UTF-8, and environments choke on it. */
static void trim_partial_character(char *text) {
  size_t n = strlen(text);
  size_t i = n;
  while (i > 0 && ((unsigned char)text[i - 1] & 0xC0u) == 0x80u) i--;
  if (i == 0) return;
  const unsigned char lead = (unsigned char)text[i - 1];
  const size_t width = lead < 0x80u ? 1 : lead < 0xE0u ? 2 : lead < 0xF0u ? 3 : 4;
  if (n - (i - 1) < width) text[i - 1] = '\0';
}

int frot_fmu_say(const frot_fmu *fmu, int status, const char *format, ...) {
  const unsigned bit = status == FROT_FMU_DISCARD ? FROT_FMU_LOG_DISCARD : FROT_FMU_LOG_ERROR;
  char text[MESSAGE];
  va_list arguments;
  if (fmu == NULL || fmu->sink == NULL || !(fmu->categories & bit)) return status;
  va_start(arguments, format);
  const int length = vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  if (length >= (int)sizeof text) trim_partial_character(text);
  if (length >= 0) fmu->sink(fmu, status, category_of(status), text);
  return status;
}

void frot_fmu_say_event(const frot_fmu *fmu, const char *message) {
  if (fmu->sink != NULL && (fmu->categories & FROT_FMU_LOG_EVENTS))
    fmu->sink(fmu, FROT_FMU_OK, "logEvents", message);
}

int frot_fmu_refuse(const frot_fmu *fmu, const char *function, const char *reason) {
  return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: %s.", function, reason);
}

void *frot_fmu_memory(size_t size) { return calloc(1, size > 0 ? size : 1); }

static int draft_acceptable(const frot_fmu *draft, const char *function, const char *name,
                            const char *token) {
  const frot_model *model = &frot_the_model;
  const int motion = 2 * frot_exchange_states(model) + frot_exchange_guards(model);
  const unsigned expected = 1u + (unsigned)(model->np + model->nu + model->n_variables) +
                            (unsigned)(frot_fmu_exchange ? motion : 0);
  if (name == NULL || name[strspn(name, " \t\r\n")] == '\0') {
    frot_fmu_say(draft, FROT_FMU_ERROR, "%s: the instance name is empty.", function);
    return 0;
  }
  if (token == NULL || strcmp(token, model->key) != 0) {
    frot_fmu_say(draft, FROT_FMU_ERROR,
                 "%s: the token '%s' is not that of this model, '%s': the model description "
                 "and the library are not of the same export.",
                 function, token == NULL ? "" : token, model->key);
    return 0;
  }
  if (frot_fmu_variable_count != expected) {
    frot_fmu_say(draft, FROT_FMU_ERROR,
                 "%s: the table of variables has %u entries where the model has %u.", function,
                 frot_fmu_variable_count, expected);
    return 0;
  }
  return 1;
}

/* Room for the events of several instants; nobody reads the segments. */
static int make_recorder(frot_fmu *fmu) {
  const frot_model *model = fmu->model;
  const long long events = 4 * frot_events_at_once(model);
  fmu->recorder.events = frot_fmu_memory((size_t)events * sizeof(frot_event));
  fmu->recorder.event_capacity = events;
  return fmu->recorder.events != NULL;
}

frot_fmu *frot_fmu_open(const frot_fmu *draft, size_t size, const char *function, const char *name,
                        const char *token, int logging) {
  const frot_model *model = &frot_the_model;
  frot_fmu_limits limits;
  if (!draft_acceptable(draft, function, name, token)) return NULL;
  if (frot_fmu_read_limits(draft, function, &limits) != FROT_FMU_OK) return NULL;
  frot_fmu *fmu = frot_fmu_memory(size);
  if (fmu != NULL) {
    const size_t length = strlen(name) + 1;
    memcpy(fmu, draft, size);
    fmu->model = model;
    fmu->limits = limits;
    fmu->state_size = frot_state_size(model);
    fmu->state = frot_fmu_memory(fmu->state_size);
    fmu->accepted = frot_fmu_memory(fmu->state_size);
    fmu->work = frot_fmu_memory(frot_work_size(model));
    fmu->values = frot_fmu_memory((size_t)model->n_variables * sizeof(double));
    fmu->name_memory = frot_fmu_memory(length);
    const int made = make_recorder(fmu) && frot_fmu_make_exchange(fmu);
    if (made && fmu->name_memory != NULL && fmu->state != NULL && fmu->accepted != NULL &&
        fmu->work != NULL && fmu->values != NULL) {
      memcpy(fmu->name_memory, name, length);
      fmu->name = fmu->name_memory;
      fmu->categories = logging ? FROT_FMU_LOG_ALL : 0;
      frot_fmu_reset(fmu);
      return fmu;
    }
    frot_fmu_close(fmu);
  }
  frot_fmu_say(draft, FROT_FMU_ERROR, "%s: there is not enough memory.", function);
  return NULL;
}

void frot_fmu_close(frot_fmu *fmu) {
  if (fmu == NULL) return;
  frot_fmu_drop_all(fmu);
  free(fmu->name_memory);
  free(fmu->state);
  free(fmu->accepted);
  free(fmu->before);
  free(fmu->probe);
  free(fmu->probe_numbers);
  free(fmu->in_between);
  free(fmu->asked);
  for (int i = 0; i < 2; i++) free(fmu->elements[i]);
  free(fmu->work);
  free(fmu->values);
  free(fmu->states);
  free(fmu->rates);
  free(fmu->guards);
  free(fmu->recorder.events);
  free(fmu);
}

int frot_fmu_set_logging(frot_fmu *fmu, const char *function, int on, size_t count,
                         const char *const *names) {
  unsigned bits = 0;
  if (count > 0 && names == NULL)
    return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: the categories are NULL.", function);
  for (size_t i = 0; i < count; i++) {
    const unsigned bit = names[i] == NULL ? 0 : bit_of(names[i]);
    if (bit == 0)
      return frot_fmu_say(fmu, FROT_FMU_ERROR,
                          "%s: there is no log category '%s'; there are logEvents, "
                          "logStatusDiscard, logStatusError and logAll.",
                          function, names[i] == NULL ? "" : names[i]);
    bits |= bit;
  }
  if (on)
    fmu->categories = count == 0 ? FROT_FMU_LOG_ALL : bits;
  else
    fmu->categories = count == 0 ? 0 : fmu->categories & ~bits;
  return FROT_FMU_OK;
}
