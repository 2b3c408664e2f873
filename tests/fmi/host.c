/* Runs an FMU of version 2.0 on a platform that Python does not run on, and writes the bits of its
 * real variables after every step, sixteen digits each, a line a step. Compiled with LIBRARY,
 * TOKEN, FIRST and COUNT (value references), STEPS and STEP (s). */
#include "fmi2Functions.h"

#ifdef _WIN32
__declspec(dllimport) void *__stdcall LoadLibraryA(const char *name);
__declspec(dllimport) void *__stdcall GetProcAddress(void *library, const char *name);
__declspec(dllimport) void *__stdcall GetStdHandle(unsigned which);
__declspec(dllimport) int __stdcall WriteFile(void *file, const void *bytes, unsigned size,
                                              unsigned *written, void *overlapped);
__declspec(dllimport) void __stdcall ExitProcess(unsigned status);
#define load(name) LoadLibraryA(name)
#define look_up(library, name) GetProcAddress(library, name)
#define end(status) ExitProcess(status)
int _fltused = 0;
static void put(const char *text, unsigned size) {
  unsigned written = 0;
  WriteFile(GetStdHandle(-11u), text, size, &written, 0);
}
#define main mainCRTStartup
#else
#include <dlfcn.h>
#include <stdlib.h>
#include <unistd.h>
/* Begins at main, without the start-up code of the C library. */
#define load(name) dlopen(name, RTLD_NOW)
#define look_up(library, name) dlsym(library, name)
#define end(status) exit(status)
static void put(const char *text, unsigned size) {
  if (write(1, text, size) < 0) exit(9);
}
#endif

static void put_number(double x) {
  union {
    double number;
    unsigned long long bits;
  } both = {x};
  char text[17];
  for (int i = 0; i < 16; i++) text[i] = "0123456789abcdef"[both.bits >> (60 - 4 * i) & 15u];
  text[16] = ' ';
  put(text, sizeof text);
}

#define CALL(name) ((fmi2##name##TYPE *)look_up(library, "fmi2" #name))

static int run(void *library) {
  const fmi2CallbackFunctions functions = {0, 0, 0, 0, 0};
  fmi2ValueReference references[COUNT];
  fmi2Real values[COUNT];
  for (unsigned i = 0; i < COUNT; i++) references[i] = FIRST + i;
  void *c = CALL(Instantiate)("one", fmi2CoSimulation, TOKEN, "", &functions, 0, 0);
  if (c == 0) return 2;
  if (CALL(SetupExperiment)(c, 0, 0.0, 0.0, 0, 0.0) != fmi2OK) return 3;
  if (CALL(EnterInitializationMode)(c) != fmi2OK) return 3;
  if (CALL(ExitInitializationMode)(c) != fmi2OK) return 3;
  for (int i = 0; i < STEPS; i++) {
    if (CALL(DoStep)(c, i * STEP, STEP, fmi2True) != fmi2OK) return 4;
    if (CALL(GetReal)(c, references, COUNT, values) != fmi2OK) return 5;
    for (int k = 0; k < COUNT; k++) put_number(values[k]);
    put("\n", 1);
  }
  CALL(FreeInstance)(c);
  return 0;
}

int main(void) {
  void *library = load(LIBRARY);
  end(library == 0 ? 1 : run(library));
  return 0;
}
