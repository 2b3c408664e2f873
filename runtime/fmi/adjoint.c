/* Adjoint derivatives: the change of a sum of unknowns, each times its seed, with each known. */
#include <math.h>
#include <stdlib.h>

#include "instance.h"

static int check_seed(const frot_fmu *fmu, const char *function, const double *seed, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (!isfinite(seed[i])) return frot_fmu_refuse(fmu, function, "a seed is not a finite number");
  return FROT_FMU_OK;
}

int frot_fmu_derive_adjoint(frot_fmu *fmu, const char *function, const unsigned *unknowns,
                            size_t n_unknowns, const unsigned *knowns, size_t n_knowns,
                            const double *seed, double *sensitivity) {
  const double along = 1.0;
  int status = frot_fmu_arrays(fmu, function, unknowns, seed, n_unknowns);
  if (status == FROT_FMU_OK) status = frot_fmu_arrays(fmu, function, knowns, sensitivity, n_knowns);
  if (status == FROT_FMU_OK) status = check_seed(fmu, function, seed, n_unknowns);
  if (status != FROT_FMU_OK) return status;
  double *column = frot_fmu_memory(n_unknowns * sizeof(double));
  if (column == NULL) return frot_fmu_refuse(fmu, function, "there is not enough memory");
  for (size_t k = 0; k < n_knowns && status == FROT_FMU_OK; k++) {
    status = frot_fmu_derive(fmu, function, unknowns, n_unknowns, knowns + k, 1, &along, column);
    double sum = 0.0;
    for (size_t i = 0; i < n_unknowns && status == FROT_FMU_OK; i++) sum += seed[i] * column[i];
    if (status == FROT_FMU_OK) sensitivity[k] = sum;
  }
  free(column);
  return status;
}
