#include "sizes.h"

#include <math.h>
#include <string.h>

/* Size of a state at least, in units of the largest of its dimension. */
#define LEAST_PART 1e-2
/* And in units of the largest of all: what lies before a front moves by higher orders of the step
 * than any step resolves. */
#define LEAST_OF_ALL 1e-10

/* fmax is a call, for what it does with NaN. */
static double larger(double a, double b) { return a > b ? a : b; }

int frot_state_sizes(const frot_model *m, const frot_state *s, frot_work *w) {
  const double *had = s->data + frot_layout_of(m).scale_x;
  double *largest = w->largest_alike;
  double largest_of_all = 0;
  int zero = 0;
  memset(largest, 0, sizeof(double) * (size_t)m->nq);
  for (int j = 0; j < m->nq; j++) {
    if (m->q_speed[j] >= 0) continue;
    double size = larger(larger(had[j], fabs(w->z0[j])), w->change[j]);
    double *most = &largest[m->q_alike[j]];
    w->own_size[j] = size;
    *most = larger(*most, size);
    largest_of_all = larger(largest_of_all, size);
  }
  for (int j = 0; j < m->nq; j++) {
    if (m->q_speed[j] >= 0) continue;
    double least = larger(LEAST_PART * largest[m->q_alike[j]], LEAST_OF_ALL * largest_of_all);
    w->own_size[j] = larger(w->own_size[j], least);
    zero |= w->own_size[j] == 0;
  }
  return zero;
}
