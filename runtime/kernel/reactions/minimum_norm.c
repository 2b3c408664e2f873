/* Reactions that are not unique: the least, friction sparingly. */
#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "numerics/basis.h"
#include "reactions/equal_springs.h"
#include "numerics/tolerances.h"

#define GOLDEN 0.6180339887498949

/* The least and the largest of what a unit of each reaction that is no friction does to the group;
 * of friction itself where there is no other. */
static void list_sizes(const frot_problem *p, double *least, double *largest) {
  const frot_work *w = p->w;
  for (int frictions = 0; frictions < 2; frictions++) {
    *least = INFINITY, *largest = 0;
    for (int c = 0; c < p->held; c++) {
      if ((w->reactions.friction[c] != 0) != frictions) continue;
      *least = fmin(*least, 1 / w->reactions.unit_of[c]);
      *largest = fmax(*largest, 1 / w->reactions.unit_of[c]);
    }
    if (*largest > 0) return;
  }
  *least = *largest = 1;
}

/* What the unknowns weigh, into w->reactions.weight: friction so much more than other reactions
 * that rest is not lost for want of it. Elements side by side share a load in proportion to their
 * bounds, so that they reach them together: sum of lam^2 g / bound is least, where g, the size of
 * the row, makes a gear between them count, and makes forces of couples, whatever the lengths.
 * What bounds most of them is unknown, and the same for all; of those that values bound the most
 * is a force as the others have. Friction that follows is one too. Where a pin slips other normal
 * reactions change its friction, and so the motion: they are not spared then. */
static void weigh_sparingly(const frot_problem *p) {
  frot_work *w = p->w;
  double least, largest, most[3] = {0}, unit = 0;
  double sparing = p->unknowns > p->held ? 1 : FROT_FRICTION_WEIGHT;
  list_sizes(p, &least, &largest);
  for (int c = 0; c < p->unknowns; c++) {
    double size = 1 / w->reactions.unit_of[c];
    int kind = c < p->held ? w->reactions.friction[c] : 0;
    w->reactions.weight[c] = c < p->held ? 1 : largest / size;
    if (kind == 0) continue;
    w->reactions.weight[c] = sqrt(w->core.coefficient[2 * w->reactions.owner[c] + 1] / size);
    if (w->reactions.weight[c] > most[kind])
      most[kind] = w->reactions.weight[c], unit = kind == 2 ? least / size / most[kind] : unit;
  }
  for (int c = 0; c < p->held; c++) {
    int kind = w->reactions.friction[c];
    if (kind == 0) continue;
    double weight = fmax(w->reactions.weight[c], FROT_NO_WEIGHT * most[kind]);
    weight *= kind == 2 ? unit : sqrt(least);
    weight = most[kind] > 0 ? fmin(weight, largest * w->reactions.unit_of[c])
                            : largest * w->reactions.unit_of[c];
    w->reactions.weight[c] = weight * sparing;
  }
}

/* Other weights, all alike but so that no two reactions are weighed in a simple ratio:
 * load_sharing_vertices.c. */
static void weigh_evenly(const frot_problem *p) {
  for (int c = 0; c < p->unknowns; c++)
    p->w->reactions.weight[c] = (1 + fmod(GOLDEN * (c + 1), 1)) * p->w->reactions.unit_of[c];
}

/* What an element without a coefficient takes of what others hold as well is rounding: it is none.
 */
static void leave_to_others(const frot_problem *p, double *x) {
  const frot_work *w = p->w;
  double largest = 0;
  for (int c = 0; c < p->held; c++) largest = fmax(largest, fabs(x[c]));
  for (int c = 0; c < p->held; c++) {
    if (w->reactions.friction[c] == 0) continue;
    if (w->core.coefficient[2 * w->reactions.owner[c] + 1] != 0) continue;
    if (fabs(x[c]) <= FROT_ROUNDING * largest) x[c] = 0;
  }
}

/* Passes: what friction the weights leave in the place of normal reactions, 1e-10 of them, is more
 * than a pin can bear whose reaction comes to zero. So it begins anew with what the normal
 * reactions of the pass before leave to it; the last pass takes away rounding. */
#define PASSES 3

int frot_solve_least(const frot_problem *p, double *x) {
  frot_work *w = p->w;
  int n = p->unknowns, springs = p->evenly ? 0 : frot_equal_springs(p);
  int rows = p->equations + springs;
  double *copy = w->linear.scratch, *b = copy + n * n, *step = b + n, *scratch = step + n;
  if (p->evenly)
    weigh_evenly(p);
  else
    weigh_sparingly(p);
  memset(x, 0, sizeof(double) * (size_t)n);
  for (int pass = 0; pass < PASSES; pass++) {
    for (int c = 0; c < p->held && pass < PASSES - 1; c++)
      if (w->reactions.friction[c] != 0) x[c] = 0;
    for (int r = 0; r < rows; r++) {
      int spring = r - p->equations;
      double largest = 0, rest = spring < 0 ? w->linear.right[r] : 0;
      for (int c = 0; c < n; c++) {
        double entry = spring < 0 ? w->linear.matrix[c * n + r] / w->reactions.unit_of[c]
                                  : w->reactions.compatible[spring * n + c];
        copy[c * rows + r] = entry * w->reactions.weight[c];
        largest = fmax(largest, fabs(copy[c * rows + r]));
        rest -= x[c] * (spring < 0 ? w->linear.matrix[c * n + r] : entry * w->reactions.unit_of[c]);
      }
      double scale = largest > 0 ? 1 / largest : 1;
      for (int c = 0; c < n; c++) copy[c * rows + r] *= scale;
      b[r] = rest * scale;
    }
    frot_least_norm(copy, b, rows, n, FROT_RANK, step, scratch, w->linear.pivot);
    for (int c = 0; c < n; c++) x[c] += step[c] * w->reactions.weight[c] / w->reactions.unit_of[c];
  }
  if (!p->evenly) leave_to_others(p, x);
  return springs;
}
