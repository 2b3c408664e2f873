/* CVODE (SUNDIALS) on the problems of stiff.py: right-hand sides in C, dense matrix, Jacobian by
 * differences as CVODE makes it. The prototypes are those of SUNDIALS 7 with 32-bit indices, as
 * scikit-sundae carries it; its wheel has the libraries without their headers. */
#include <math.h>
#include <string.h>
#include <time.h>

typedef void *SUNContext, *N_Vector, *SUNMatrix, *SUNLinearSolver;
typedef int (*rates)(double t, N_Vector y, N_Vector slope, void *data);

int SUNContext_Create(int comm, SUNContext *context);
int SUNContext_Free(SUNContext *context);
void SUNContext_ClearErrHandlers(SUNContext context);
N_Vector N_VNew_Serial(int n, SUNContext context);
double *N_VGetArrayPointer(N_Vector v);
void N_VDestroy(N_Vector v);
SUNMatrix SUNDenseMatrix(int rows, int columns, SUNContext context);
void SUNMatDestroy(SUNMatrix a);
SUNLinearSolver SUNLinSol_Dense(N_Vector y, SUNMatrix a, SUNContext context);
int SUNLinSolFree(SUNLinearSolver solver);
void *CVodeCreate(int method, SUNContext context);
int CVodeInit(void *memory, rates f, double t, N_Vector y);
int CVodeSStolerances(void *memory, double relative, double absolute);
int CVodeSetMaxNumSteps(void *memory, long steps);
int CVodeSetLinearSolver(void *memory, SUNLinearSolver solver, SUNMatrix a);
int CVode(void *memory, double until, N_Vector y, double *t, int task);
int CVodeSetStopTime(void *memory, double t);
int CVodeGetNumSteps(void *memory, long *steps);
int CVodeGetNumRhsEvals(void *memory, long *evaluations);
void CVodeFree(void **memory);

enum { BDF = 2, NORMAL = 1 };

#define RATES(name)                                                  \
  static void name##_rates(double t, const double *y, double *f);    \
  static int name(double t, N_Vector vy, N_Vector vf, void *data) {  \
    (void)data;                                                      \
    name##_rates(t, N_VGetArrayPointer(vy), N_VGetArrayPointer(vf)); \
    return 0;                                                        \
  }                                                                  \
  static void name##_rates(double t, const double *y, double *f)

RATES(robertson) {
  (void)t;
  double forth = 0.04 * y[0], back = 1e4 * y[1] * y[2], on = 3e7 * y[1] * y[1];
  f[0] = back - forth, f[1] = forth - back - on, f[2] = on;
}

RATES(van_der_pol) {
  (void)t;
  f[0] = y[1], f[1] = ((1 - y[0] * y[0]) * y[1] - y[0]) / 1e-6;
}

RATES(oregonator) {
  (void)t;
  f[0] = 77.27 * (y[1] + y[0] * (1 - 8.375e-6 * y[0] - y[1]));
  f[1] = (y[2] - (1 + y[0]) * y[1]) / 77.27;
  f[2] = 0.161 * (y[0] - y[2]);
}

RATES(e5) {
  (void)t;
  double third = y[1] - y[2]; /* what the reactions conserve */
  double one = 7.89e-10 * y[0], two = 1.1e7 * y[0] * third;
  f[0] = -one - two, f[1] = one - 1.13e9 * y[1] * third, f[2] = two - 1.13e3 * y[2];
}

RATES(hires) {
  (void)t;
  double both = 280 * y[5] * y[7];
  f[0] = -1.71 * y[0] + 0.43 * y[1] + 8.32 * y[2] + 0.0007;
  f[1] = 1.71 * y[0] - 8.75 * y[1];
  f[2] = -10.03 * y[2] + 0.43 * y[3] + 0.035 * y[4];
  f[3] = 8.32 * y[1] + 1.71 * y[2] - 1.12 * y[3];
  f[4] = -1.745 * y[4] + 0.43 * y[5] + 0.43 * y[6];
  f[5] = -both + 0.69 * y[3] + 1.71 * y[4] - 0.43 * y[5] + 0.69 * y[6];
  f[6] = both - 1.81 * y[6];
  f[7] = -both + 1.81 * y[6];
}

RATES(pollution) {
  (void)t;
  double r[26];
  r[1] = 0.35 * y[0], r[2] = 26.6 * y[1] * y[3], r[3] = 1.23e4 * y[4] * y[1];
  r[4] = 8.6e-4 * y[6], r[5] = 8.2e-4 * y[6], r[6] = 1.5e4 * y[6] * y[5], r[7] = 1.3e-4 * y[8];
  r[8] = 2.4e4 * y[8] * y[5], r[9] = 1.65e4 * y[10] * y[1], r[10] = 9e3 * y[10] * y[0];
  r[11] = 2.2e-2 * y[12], r[12] = 1.2e4 * y[9] * y[1], r[13] = 1.88 * y[13];
  r[14] = 1.63e4 * y[0] * y[5], r[15] = 4.8e6 * y[2], r[16] = 3.5e-4 * y[3];
  r[17] = 1.75e-2 * y[3], r[18] = 1e8 * y[15], r[19] = 4.44e11 * y[15];
  r[20] = 1.24e3 * y[16] * y[5], r[21] = 2.1 * y[18], r[22] = 5.78 * y[18];
  r[23] = 4.74e-2 * y[0] * y[3], r[24] = 1.78e3 * y[18] * y[0], r[25] = 3.12 * y[19];
  f[0] = -r[1] - r[10] - r[14] - r[23] - r[24] + r[2] + r[3] + r[9] + r[11] + r[12] + r[22] + r[25];
  f[1] = -r[2] - r[3] - r[9] - r[12] + r[1] + r[21];
  f[2] = -r[15] + r[1] + r[17] + r[19] + r[22];
  f[3] = -r[2] - r[16] - r[17] - r[23] + r[15];
  f[4] = -r[3] + 2 * r[4] + r[6] + r[7] + r[13] + r[20];
  f[5] = -r[6] - r[8] - r[14] - r[20] + r[3] + 2 * r[18];
  f[6] = -r[4] - r[5] - r[6] + r[13];
  f[7] = r[4] + r[5] + r[6] + r[7];
  f[8] = -r[7] - r[8];
  f[9] = -r[12] + r[7] + r[9];
  f[10] = -r[9] - r[10] + r[8] + r[11];
  f[11] = r[9];
  f[12] = -r[11] + r[10];
  f[13] = -r[13] + r[12];
  f[14] = r[14];
  f[15] = -r[18] - r[19] + r[16];
  f[16] = -r[20];
  f[17] = r[20];
  f[18] = -r[21] - r[22] - r[24] + r[23] + r[25];
  f[19] = -r[25] + r[24];
}

static double diode(double u) { return 40.67286402e-9 * (exp(17.7493332 * u) - 1); }

RATES(ring_modulator) {
  const double pi = 3.14159265358979323846;
  double first = 0.5 * sin(2e3 * pi * t), second = 2 * sin(2e4 * pi * t);
  double a = diode(y[2] - y[4] - y[6] - second), b = diode(-y[3] + y[5] - y[6] - second);
  double c = diode(y[3] + y[4] + y[6] + second), d = diode(-y[2] - y[5] + y[6] + second);
  f[0] = (y[7] - 0.5 * y[9] + 0.5 * y[10] + y[13] - y[0] / 25000) / 1.6e-8;
  f[1] = (y[8] - 0.5 * y[11] + 0.5 * y[12] + y[14] - y[1] / 25000) / 1.6e-8;
  f[2] = (y[9] - a + d) / 2e-12;
  f[3] = (-y[10] + b - c) / 2e-12;
  f[4] = (y[11] + a - c) / 2e-12;
  f[5] = (-y[12] - b + d) / 2e-12;
  f[6] = (-y[6] / 50 + a + b - c - d) / 1e-8;
  f[7] = -y[0] / 4.45, f[8] = -y[1] / 4.45;
  f[9] = (0.5 * y[0] - y[2] - 17.3 * y[9]) / 5e-4;
  f[10] = (-0.5 * y[0] + y[3] - 17.3 * y[10]) / 5e-4;
  f[11] = (0.5 * y[1] - y[4] - 17.3 * y[11]) / 5e-4;
  f[12] = (-0.5 * y[1] + y[5] - 17.3 * y[12]) / 5e-4;
  f[13] = (-y[0] + first - (50 + 36.3) * y[13]) / 2e-3;
  f[14] = (-y[1] - (600 + 36.3) * y[14]) / 2e-3;
}

static const struct {
  const char *name;
  rates f;
} problems[] = {
    {"robertson", robertson},
    {"van_der_pol", van_der_pol},
    {"oregonator", oregonator},
    {"e5", e5},
    {"hires", hires},
    {"pollution", pollution},
    {"ring_modulator", ring_modulator},
};

/* Runs a problem from y (n) at zero to the time `until`. counts: steps, right-hand sides. Returns
 * the processor time in seconds, or a negative status. */
double run(const char *name, int n, double until, double relative, double absolute, double *values,
           long counts[2]) {
  rates f = NULL;
  for (size_t i = 0; i < sizeof problems / sizeof *problems; i++)
    if (strcmp(problems[i].name, name) == 0) f = problems[i].f;
  if (!f) return -1001;
  struct timespec before, after;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &before);
  SUNContext context;
  if (SUNContext_Create(0, &context)) return -1000;
  SUNContext_ClearErrHandlers(context);
  N_Vector y = N_VNew_Serial(n, context);
  double t = 0;
  memcpy(N_VGetArrayPointer(y), values, sizeof(double) * (size_t)n);
  void *memory = CVodeCreate(BDF, context);
  int status = CVodeInit(memory, f, 0, y);
  CVodeSStolerances(memory, relative, absolute);
  CVodeSetMaxNumSteps(memory, 10000000);
  CVodeSetStopTime(memory, until);
  SUNMatrix a = SUNDenseMatrix(n, n, context);
  SUNLinearSolver solver = SUNLinSol_Dense(y, a, context);
  CVodeSetLinearSolver(memory, solver, a);
  status = CVode(memory, until, y, &t, NORMAL);
  memcpy(values, N_VGetArrayPointer(y), sizeof(double) * (size_t)n);
  CVodeGetNumSteps(memory, counts);
  CVodeGetNumRhsEvals(memory, counts + 1);
  CVodeFree(&memory);
  SUNLinSolFree(solver);
  SUNMatDestroy(a);
  N_VDestroy(y);
  SUNContext_Free(&context);
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &after);
  if (status < 0) return status;
  return (double)(after.tv_sec - before.tv_sec) + 1e-9 * (double)(after.tv_nsec - before.tv_nsec);
}
