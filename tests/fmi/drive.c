/* Drives an FMU linked into the program, for sanitizers: whole lives, saved states, damage, misuse.
 * Compiled with DRIVE=2 or DRIVE=3. Ends with 0 if every status is the one expected. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if DRIVE == 2
#include "fmi2Functions.h"
#define FMI(name) fmi2##name
#define REAL(way) fmi2##way##Real
#define WHOLE(way) fmi2##way##Integer
#define STATE(name) fmi2##name##FMUstate
#define DESERIALIZE fmi2DeSerializeFMUstate
#define SIZE fmi2SerializedFMUstateSize
#define COUNT(n) /* no second count */
typedef fmi2Component instance;
typedef fmi2FMUstate saved;
typedef fmi2Byte byte;
typedef fmi2ValueReference reference;
typedef fmi2Integer whole;
#else
#include "fmi3Functions.h"
#define FMI(name) fmi3##name
#define REAL(way) fmi3##way##Float64
#define WHOLE(way) fmi3##way##Int64
#define STATE(name) fmi3##name##FMUState
#define DESERIALIZE fmi3DeserializeFMUState
#define SIZE fmi3SerializedFMUStateSize
#define COUNT(n) , n
typedef fmi3Instance instance;
typedef fmi3FMUState saved;
typedef fmi3Byte byte;
typedef fmi3ValueReference reference;
typedef fmi3Int64 whole;
#endif

enum { OK = 0, DISCARD = 2, ERROR = 3 };
enum { MU = 1, STIFFNESS = 2, MASS = 4, PUSH = 8, MODE = 9, X = 10 };

#define EXPECT(status, call)                                                                   \
  do {                                                                                         \
    const int got = (int)(call);                                                               \
    if (got != (status)) {                                                                     \
      fprintf(stderr, "line %d: status %d instead of %d: %s\n", __LINE__, got, status, #call); \
      exit(1);                                                                                 \
    }                                                                                          \
  } while (0)

#if DRIVE == 2
static void log_message(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                        fmi2String category, fmi2String message, ...) {
  (void)environment, (void)name, (void)status;
  if (strlen(category) + strlen(message) == 0) exit(2);
}

static instance make(const char *token) {
  const fmi2CallbackFunctions functions = {log_message, calloc, free, NULL, NULL};
  return fmi2Instantiate("one", fmi2CoSimulation, token, "", &functions, 0, 1);
}

static int begin(instance c, double t) {
  const int status = (int)fmi2SetupExperiment(c, 0, 0.0, t, 0, 0.0);
  return status != OK ? status : (int)fmi2EnterInitializationMode(c);
}

static int step(instance c, double t, double h) { return (int)fmi2DoStep(c, t, h, 1); }
#else
static void log_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                        fmi3String message) {
  (void)environment, (void)status;
  if (strlen(category) + strlen(message) == 0) exit(2);
}

static instance make(const char *token) {
  return fmi3InstantiateCoSimulation("one", token, NULL, 0, 1, 0, 0, NULL, 0, NULL, log_message,
                                     NULL);
}

static int begin(instance c, double t) {
  return (int)fmi3EnterInitializationMode(c, 0, 0.0, t, 0, 0.0);
}

static int step(instance c, double t, double h) {
  fmi3Boolean event, end, early;
  fmi3Float64 reached;
  return (int)fmi3DoStep(c, t, h, 1, &event, &end, &early, &reached);
}
#endif

static int set(instance c, reference r, double value) {
  return (int)REAL(Set)(c, &r, 1, &value COUNT(1));
}

static double get(instance c, reference r) {
  double value = NAN;
  EXPECT(OK, REAL(Get)(c, &r, 1, &value COUNT(1)));
  return value;
}

static void damage(instance c, const byte *bytes, size_t size) {
  byte *copy = malloc(size);
  if (copy == NULL) exit(3);
  for (size_t i = 0; i < size; i += 1 + size / 200) {
    saved state = NULL;
    memcpy(copy, bytes, size);
    copy[i] = (byte)(copy[i] ^ 0x55);
    EXPECT(ERROR, DESERIALIZE(c, copy, size, &state));
  }
  free(copy);
}

static void one_life(int number) {
  instance c = make("hand-model-key");
  saved state = NULL, other = NULL;
  size_t size = 0;
  const reference mode = MODE;
  whole m = -1;
  if (c == NULL) exit(4);
  if (make("wrong") != NULL) exit(5);
  EXPECT(ERROR, step(c, 0.0, 1.0));
  EXPECT(OK, set(c, MU, 0.05 + 0.01 * number));
  EXPECT(OK, begin(c, 0.0));
  (void)get(c, X);
  EXPECT(OK, set(c, MASS, 1.0 + number));
  EXPECT(OK, FMI(ExitInitializationMode)(c));
  for (int i = 0; i < 10; i++) EXPECT(OK, step(c, 0.5 * i, 0.5));
  EXPECT(OK, STATE(Get)(c, &state));
  EXPECT(OK, STATE(Get)(c, &state));
  EXPECT(OK, SIZE(c, state, &size));
  byte *bytes = malloc(size);
  if (bytes == NULL) exit(3);
  EXPECT(ERROR, STATE(Serialize)(c, state, bytes, size - 1));
  EXPECT(OK, STATE(Serialize)(c, state, bytes, size));
  damage(c, bytes, size);
  EXPECT(OK, set(c, PUSH, 3.0));
  EXPECT(OK, step(c, 5.0, 7.0));
  EXPECT(OK, WHOLE(Get)(c, &mode, 1, &m COUNT(1)));
  if (m < 0 || m > 2) exit(6);
  const double x = get(c, X);
  EXPECT(OK, DESERIALIZE(c, bytes, size, &other));
  EXPECT(OK, STATE(Set)(c, other));
  EXPECT(OK, set(c, PUSH, 3.0));
  EXPECT(OK, step(c, 5.0, 7.0));
  if (get(c, X) != x) exit(7);
  EXPECT(OK, STATE(Free)(c, &other));
  EXPECT(OK, STATE(Set)(c, state));
  EXPECT(OK, set(c, STIFFNESS, 1e308));
  EXPECT(DISCARD, step(c, 5.0, 1.0));
  EXPECT(DISCARD, step(c, 5.0, 1.0));
  (void)get(c, 0);
  if (number % 2) EXPECT(OK, FMI(Terminate)(c));
  EXPECT(OK, FMI(Reset)(c));
  if (get(c, STIFFNESS) != 9.0) exit(8);
  free(bytes);
  FMI(FreeInstance)(c); /* with a saved state left over */
}

static instance started(void) {
  instance c = make("hand-model-key");
  if (c == NULL) exit(4);
  EXPECT(OK, begin(c, 0.0));
  EXPECT(OK, FMI(ExitInitializationMode)(c));
  return c;
}

/* Three at once, one reset while another runs on and one freed: none knows of the others. */
static void lives_beside_each_other(void) {
  instance long_steps = started(), short_steps = started(), other = started();
  EXPECT(OK, set(other, MASS, 7.0));
  for (int i = 0; i < 10; i++) {
    EXPECT(OK, step(long_steps, 0.5 * i, 0.5));
    EXPECT(OK, step(other, 0.5 * i, 0.5));
    for (int k = 0; k < 2; k++) EXPECT(OK, step(short_steps, 0.5 * i + 0.25 * k, 0.25));
  }
  const double x = get(long_steps, X);
  if (get(short_steps, X) != x || get(other, X) == x) exit(9);
  EXPECT(OK, FMI(Reset)(long_steps));
  FMI(FreeInstance)(other);
  EXPECT(OK, begin(long_steps, 0.0));
  EXPECT(OK, FMI(ExitInitializationMode)(long_steps));
  for (int i = 0; i < 10; i++) {
    EXPECT(OK, step(short_steps, 5.0 + 0.1 * i, 0.1));
    EXPECT(OK, step(long_steps, 0.5 * i, 0.5));
  }
  if (get(long_steps, X) != x) exit(10);
  FMI(FreeInstance)(long_steps);
  FMI(FreeInstance)(short_steps);
}

int main(void) {
  for (int i = 0; i < 20; i++) one_life(i % 4);
  lives_beside_each_other();
  FMI(FreeInstance)(NULL);
  return 0;
}
