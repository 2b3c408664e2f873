#include "starts/sequential_guesses.h"

#include <math.h>
#include <string.h>

#include "assembly/unknowns.h"
#include "assembly/levenberg_marquardt.h"
#include "starts/multistart.h"
#include "assembly/gauss_newton.h"
#include "assembly/start_parts.h"
#include "numerics/tolerances.h"

#define AROUND 8 /* beginnings of the unknowns of one vector beside the given one, */
#define ROUNDS 4 /* each round twice as far off as the one before */
#define WHOLE_TURN 6.283185307179586
/* What vectors that nearly agree are missed by, squared, beside the arms of the angles. */

/* How many unknowns that are not taken the guesses of a vector follow from, and the last of them;
 * those with `mark` are marked, of an orientation all. */
static int count_new(const frot_opening *p, int vector, int mark, int *last) {
  const frot_part *part = p->part;
  unsigned char *state = p->w->opening.state;
  int first = p->n - part->n_guessed, nx = p->n_own, count = 0;
  for (int j = 0; j < part->n_guessed; j++) {
    const double *row = p->w->relations.jacobian + nx * (first + j);
    for (int k = 0; k < nx && part->vectors[j] == vector; k++)
      if (row[k] != 0 && state[k] == 0)
        state[k] = FROT_MOVES_NOW, count++, *last = k > *last ? k : *last;
  }
  for (int i = 0; i < part->n_turns && mark; i++) {
    unsigned char *four = state + p->w->opening.turns[i].at;
    for (int k = 0; k < 4; k++)
      if (memchr(four, FROT_MOVES_NOW, 4) && four[k] == 0) four[k] = FROT_MOVES_NOW;
  }
  for (int k = 0; k < nx && !mark; k++)
    if (state[k] == FROT_MOVES_NOW) state[k] = 0;
  return count;
}

/* Mark the unknowns of the next vector from the ground outwards: of those whose last new unknown
 * comes first, the one that follows from the fewest. Returns 0 where all are taken. */
static int mark_next(const frot_opening *p) {
  int fewest = 0, first = p->n_own, next = -1;
  for (int j = 0; j < p->part->n_guessed; j++) {
    int last = -1, count = p->part->vectors[j] == j ? count_new(p, j, 0, &last) : 0;
    if (count == 0 || last > first || (last == first && count >= fewest)) continue;
    first = last, fewest = count, next = j;
  }
  return next >= 0 && count_new(p, next, 1, &first) > 0;
}

/* Whether an unknown that is to come moves row i or, of a guess, any item of its vector. */
static int is_open(const frot_opening *p, int i) {
  const frot_part *part = p->part;
  int first = p->n - part->n_guessed;
  for (int j = i < first ? i : first; j < (i < first ? i + 1 : p->n); j++) {
    const double *row = p->w->relations.jacobian + p->n_own * j;
    if (i >= first && part->vectors[j - first] != part->vectors[i - first]) continue;
    for (int k = 0; k < p->n_own; k++)
      if (row[k] != 0 && p->w->opening.state[k] == 0) return 1;
  }
  return 0;
}

/* Leave of the equations those that the unknowns marked move, and none that are to come. */
static void choose_rows(const frot_opening *p) {
  const unsigned char *state = p->w->opening.state;
  for (int i = 0; i < p->n; i++) {
    const double *row = p->w->relations.jacobian + p->n_own * i;
    int moved = 0;
    for (int k = 0; k < p->n_own; k++) moved |= row[k] != 0 && state[k] == FROT_MOVES_NOW;
    p->w->opening.chosen[i] = (unsigned char)(moved && !is_open(p, i));
  }
}

/* What moves on as it turns, as on a screw, may be whole turns away from where the rest holds: turn
 * each angle marked by as many as leave least of what is missed. Returns whether any turns. */
static int turn_wholly(frot_opening *p) {
  const double *residual = p->w->relations.residual, *weight = p->w->opening.row_weight;
  double *missed = p->w->linear.scratch;
  int turned = 0;
  for (int k = 0; k < p->n_own; k++) {
    if (p->w->opening.state[k] != FROT_MOVES_NOW || !frot_is_angle(p, k)) continue;
    if (frot_evaluate_statements(p) != FROT_OK) return 0;
    for (int i = 0; i < p->n; i++) missed[i] = residual[i];
    double start = p->x[k], along = 0, square = 0;
    p->x[k] = start + 2 * WHOLE_TURN; /* an orientation is the same after two */
    int status = frot_evaluate_statements(p);
    for (int i = 0; i < p->n && status == FROT_OK; i++) {
      double change = 0.5 * (residual[i] - missed[i]) * weight[i];
      along -= change * missed[i] * weight[i], square += change * change;
    }
    double turns = square > FROT_LEAST_ADVANCE * FROT_LEAST_ADVANCE ? round(along / square) : 0;
    p->x[k] = start + WHOLE_TURN * turns, turned |= turns != 0;
  }
  return turned && frot_evaluate_statements(p) == FROT_OK;
}

/* Move the unknowns marked to where the equations chosen are missed least near here, and on by
 * whole turns while that leaves less. Returns what is missed, squared, INFINITY where there is no
 * way. */
static double come_there(frot_opening *p) {
  double missed = INFINITY, before;
  do {
    before = missed;
    if (!frot_follow_damped(p)) return INFINITY;
    missed = frot_missed_square(p);
  } while (missed > FROT_NOTHING_MISSED && missed < before && turn_wholly(p));
  return missed;
}

/* Move the unknowns marked to where the equations chosen are missed least, from here and, with
 * `widely`, from several other beginnings until they are met. Returns whether they are, but for
 * FROT_NEARLY_MET. */
static int meet_next(frot_opening *p, int widely) {
  frot_opening_work *w = &p->w->opening;
  size_t bytes = sizeof(double) * (size_t)p->n_own;
  double *before = w->second, *best = w->nearest, least = INFINITY;
  memcpy(before, p->x, bytes);
  for (int k = 0; k <= (widely ? AROUND * ROUNDS : 0) && !(least <= FROT_NEARLY_MET); k++) {
    double farther = k > AROUND ? 1 << ((k - 1) / AROUND) : 1;
    memcpy(p->x, before, bytes);
    frot_begin_units(p);
    if (k > 0 && frot_opening_metric(p) != FROT_OK) continue;
    if (k > 0) frot_begin_multistart(p, (k - 1) % AROUND, k % 3 == 0);
    for (int i = 0; i < p->n_own; i++)
      if (w->state[i] != FROT_MOVES_NOW)
        p->x[i] = before[i];
      else if (p->m->q_speed[p->part->reads.q[i]] >= 0) /* of no orientation */
        p->x[i] = before[i] + farther * (p->x[i] - before[i]);
    double missed = come_there(p);
    if (!(missed < least)) continue;
    least = missed;
    memcpy(best, p->x, bytes);
    frot_keep_blocks(p, best + p->n_own);
  }
  memcpy(p->x, isfinite(least) ? best : before, bytes);
  isfinite(least) ? frot_return_blocks(p, best + p->n_own) : frot_begin_blocks(p);
  return least <= FROT_NEARLY_MET;
}

void frot_meet_guesses_in_sequence(frot_opening *p) {
  unsigned char *state = p->w->opening.state;
  int met = 1;
  memset(state, 0, (size_t)p->n_own);
  p->guessed = p->alike = 1;
  while (frot_evaluate_statements(p) == FROT_OK && mark_next(p)) {
    choose_rows(p);
    p->some = 1;
    met &= meet_next(p, met);
    p->some = 0;
    for (int k = 0; k < p->n_own; k++) state[k] = state[k] != 0 ? FROT_TAKEN : 0;
  }
  p->guessed = p->alike = 0;
}
