/* CVODE (SUNDIALS) on the RC ladder of ladder.py: right-hand side and banded Jacobian in C.
 * The prototypes are those of SUNDIALS 7 with 32-bit indices, as scikit-sundae carries it; its
 * wheel has the libraries without their headers. */
#include <time.h>

typedef void *SUNContext, *N_Vector, *SUNMatrix, *SUNLinearSolver;
typedef int (*rates)(double t, N_Vector y, N_Vector slope, void *data);
typedef int (*slopes)(double t, N_Vector y, N_Vector fy, SUNMatrix j, void *data, N_Vector a,
                      N_Vector b, N_Vector c);

int SUNContext_Create(int comm, SUNContext *context);
int SUNContext_Free(SUNContext *context);
N_Vector N_VNew_Serial(int n, SUNContext context);
double *N_VGetArrayPointer(N_Vector v);
void N_VDestroy(N_Vector v);
SUNMatrix SUNBandMatrix(int n, int upper, int lower, SUNContext context);
double **SUNBandMatrix_Cols(SUNMatrix a);
int SUNBandMatrix_StoredUpperBandwidth(SUNMatrix a);
void SUNMatDestroy(SUNMatrix a);
SUNLinearSolver SUNLinSol_Band(N_Vector y, SUNMatrix a, SUNContext context);
int SUNLinSolFree(SUNLinearSolver solver);
void *CVodeCreate(int method, SUNContext context);
int CVodeInit(void *memory, rates f, double t, N_Vector y);
int CVodeSStolerances(void *memory, double relative, double absolute);
int CVodeSetUserData(void *memory, void *data);
int CVodeSetMaxNumSteps(void *memory, long steps);
int CVodeSetLinearSolver(void *memory, SUNLinearSolver solver, SUNMatrix a);
int CVodeSetJacFn(void *memory, slopes j);
int CVode(void *memory, double until, N_Vector y, double *t, int task);
int CVodeGetNumSteps(void *memory, long *steps);
int CVodeGetNumRhsEvals(void *memory, long *evaluations);
void CVodeFree(void **memory);

enum { BDF = 2, NORMAL = 1 };

static int ladder(double t, N_Vector vy, N_Vector vslope, void *data) {
  const double *u = N_VGetArrayPointer(vy);
  double *slope = N_VGetArrayPointer(vslope);
  int n = *(int *)data;
  (void)t;
  slope[0] = 1 - 2 * u[0] + u[1];
  for (int i = 1; i < n - 1; i++) slope[i] = u[i - 1] - 2 * u[i] + u[i + 1];
  slope[n - 1] = u[n - 2] - u[n - 1];
  return 0;
}

static int jacobian(double t, N_Vector y, N_Vector fy, SUNMatrix j, void *data, N_Vector a,
                    N_Vector b, N_Vector c) {
  double **column = SUNBandMatrix_Cols(j);
  int n = *(int *)data, diagonal = SUNBandMatrix_StoredUpperBandwidth(j);
  (void)t, (void)y, (void)fy, (void)a, (void)b, (void)c;
  for (int i = 0; i < n; i++) {
    column[i][diagonal - 1] = column[i][diagonal + 1] = 1;
    column[i][diagonal] = i == n - 1 ? -1 : -2;
  }
  return 0;
}

/* Runs to each of the times; values: times x n. counts: steps, right-hand sides. Returns the
 * processor time in seconds, or a negative status. */
double run(int n, const double *times, int count, double relative, double absolute, double *values,
           long counts[2]) {
  struct timespec before, after;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &before);
  SUNContext context;
  if (SUNContext_Create(0, &context)) return -1000;
  N_Vector y = N_VNew_Serial(n, context);
  double *u = N_VGetArrayPointer(y), t = 0;
  for (int i = 0; i < n; i++) u[i] = 0;
  void *memory = CVodeCreate(BDF, context);
  int status = CVodeInit(memory, ladder, 0, y);
  CVodeSStolerances(memory, relative, absolute);
  CVodeSetUserData(memory, &n);
  CVodeSetMaxNumSteps(memory, 10000000);
  SUNMatrix a = SUNBandMatrix(n, 1, 1, context);
  SUNLinearSolver solver = SUNLinSol_Band(y, a, context);
  CVodeSetLinearSolver(memory, solver, a);
  CVodeSetJacFn(memory, jacobian);
  for (int k = 0; k < count && status >= 0; k++) {
    status = CVode(memory, times[k], y, &t, NORMAL);
    for (int i = 0; i < n; i++) values[k * n + i] = u[i];
  }
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
