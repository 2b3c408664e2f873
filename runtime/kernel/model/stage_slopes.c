#include "model/stage_slopes.h"

void frot_weigh_stages(const frot_work *w, const double *coefficient, int count, int from, int size,
                       double sum[FROT_CHUNK]) {
  const double *slopes = w->step.k + from;
  int nz = w->layout.nz;
  if (size == FROT_CHUNK) {
    double a = 0, b = 0, c = 0, d = 0;
    for (int k = 0; k < count; k++, slopes += nz) {
      const double factor = coefficient[k];
      if (factor == 0) continue;
      a += factor * slopes[0], b += factor * slopes[1];
      c += factor * slopes[2], d += factor * slopes[3];
    }
    sum[0] = a, sum[1] = b, sum[2] = c, sum[3] = d;
    return;
  }
  for (int j = 0; j < size; j++) {
    double total = 0;
    for (int k = 0; k < count; k++) total += coefficient[k] * slopes[k * nz + j];
    sum[j] = total;
  }
}
