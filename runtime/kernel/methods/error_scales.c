#include "methods/error_scales.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "methods/jacobian.h"
#include "numerics/tolerances.h"

#define TAKE(field, count) FROT_TAKE(a, field, count)

/* What noise of slopes makes of speeds in the stages, and these of the error of a coordinate, over
 * what it makes of that of a speed: |e' A| / |e| of the method of order eight. */
#define BY_STAGES 4

/* Size of a small state at most, in units of the largest of its dimension. */
#define SMALL_PART 1e-2
/* Part of a rounding of time by which a state may be early or late in a step: what passes zero, and
 * is worth nothing there, need not be followed beyond what its instant is known to. */
#define LATE 1e-3
/* How long an error lives: in times in which a state's own damping would end it, in steps where
 * nothing damps it. */
#define LASTING 2
#define LASTING_STEPS 16
/* Sweeps there and back over the Jacobian: each brings sizes along a chain in order. */
#define SWEEPS 3
/* What a step leaves of the memory: an explicit one, and an implicit one, in which a state may die
 * out by more than that only where its error is felt. */
#define LEFT 0.3
#define LEFT_STIFF 0.1
/* What an explicit step that is stable may leave of a state that dies out, about exp(-7). What has
 * gone by more only passes zero at its end. */
#define DIES 1e-3

/* fmax is a call, for what it does with NaN. */
static double larger(double a, double b) { return a > b ? a : b; }

/* What a state counts as that was worth so much, and of which an explicit step leaves `left`. */
static double faded(double worth, double left) {
  double most = larger(left / LEFT, DIES * worth);
  return worth < most ? worth : most;
}

static int is_own(const frot_model *m, int j) { return m->q_speed[j] < 0; }

int frot_state_sizes(const frot_model *m, const frot_state *s, frot_work *w) {
  const frot_layout *l = &w->layout;
  const double *most = s->data + l->scale_x, *worth = s->data + l->worth;
  const double *nominal = s->data + l->nominal;
  const double *rate = s->data + l->slope;
  double *largest = w->sizes.alike, late = LATE * DBL_EPSILON * fabs(w->core.t) / s->tolerance;
  int zero = 0;
  for (int i = 0; i < w->sizes.count; i++) largest[m->q_alike[w->sizes.states[i]]] = 0;
  for (int i = 0; i < w->sizes.count; i++) {
    int j = w->sizes.states[i];
    double size = larger(larger(worth[j], fabs(w->step.z0[j])), w->sizes.change[j]);
    size = larger(faded(size, w->sizes.left[j]), late * fabs(rate[j]));
    w->sizes.own[j] = larger(larger(size, nominal[j]), FROT_LEAST_WORTH * most[j]);
    double *alike = &largest[m->q_alike[j]];
    *alike = larger(*alike, w->sizes.own[j]);
    zero |= w->sizes.own[j] == 0;
  }
  return zero;
}

void frot_motion_sizes(const frot_model *m, const frot_state *s, frot_work *w, double h,
                       const double *slope, int stiff) {
  const double *most = s->data + w->layout.scale_x;
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n - FROT_QUADRATURES; k++) {
    int j = now->states[k];
    if (j < m->nq && is_own(m, j)) continue;
    double change = h * fabs(slope[k]), gone = fabs(w->step.z1[j] - w->step.z0[j]);
    if (j < m->nq) change += h * h * fabs(slope[now->place[m->nq + m->q_speed[j]]]);
    if (stiff && gone < change) change = gone;
    double size = larger(larger(most[j], fabs(w->step.z0[j])), change);
    w->sizes.own[j] = size > 0 ? size : gone;
  }
}

int frot_is_small(const frot_model *m, const frot_state *s, const frot_work *w, int j) {
  return is_own(m, j) && s->data[w->layout.nominal + j] == 0 &&
         larger(s->data[w->layout.scale_x + j], w->sizes.own[j]) <
             SMALL_PART * w->sizes.alike[m->q_alike[j]];
}

/* Tables of frot_raise_small: how long an error of each state lives, the most that its size may be
 * raised to (0: it is not small), and the state that has raised it, UNRAISED, or UNDRIVEN of what
 * no other moves. */
enum { UNRAISED = -1, UNDRIVEN = -2 };
typedef struct {
  double *lives, *most;
  int *by;
} raising;

/* Raise row's size to what column makes of it; 1 if that is more than it was. */
static int raise(frot_work *w, const raising *r, int row, int column, double entry) {
  if (r->most[row] == 0 || row == column || r->by[column] == row) return 0;
  double time = r->lives[row] < r->lives[column] ? r->lives[row] : r->lives[column];
  double size = fabs(entry) * time * w->sizes.own[column];
  if (size > r->most[row]) size = r->most[row];
  if (!(size > w->sizes.own[row])) return 0;
  w->sizes.own[row] = size;
  r->by[row] = column;
  return 1;
}

static void raise_by_jacobian(const frot_model *m, const frot_state *s, frot_work *w, double h) {
  frot_jacobian j = frot_jacobian_of(m, w, NULL, NULL);
  const frot_pattern *p = &m->pattern;
  int n = frot_order(m), sparse = p->n > 0, entries = sparse ? p->entries : n * n, raised = 1;
  raising r = {j.scratch, j.scratch + n, j.raised_by};
  for (int k = 0; k < n; k++) {
    r.lives[k] = (double)LASTING / LASTING_STEPS / h;
    r.most[k] =
        k < m->nq && frot_is_small(m, s, w, k) ? SMALL_PART * w->sizes.alike[m->q_alike[k]] : 0;
    r.by[k] = UNDRIVEN;
  }
  for (int e = 0; e < entries; e++) {
    int row = sparse ? p->entry_row[e] : e % n, column = sparse ? p->entry_column[e] : e / n;
    if (row == column) r.lives[row] = larger(r.lives[row], fabs(j.entries[e]));
    if (row != column && j.entries[e] != 0) r.by[row] = UNRAISED;
  }
  for (int k = 0; k < n; k++) r.lives[k] = LASTING / r.lives[k];
  for (int sweep = 0; sweep < 2 * SWEEPS && raised; sweep++) {
    raised = sweep == 0; /* the way back is always gone */
    for (int i = 0; i < entries; i++) {
      int e = sweep % 2 == 0 ? i : entries - 1 - i;
      int row = sparse ? p->entry_row[e] : e % n, column = sparse ? p->entry_column[e] : e / n;
      raised |= raise(w, &r, row, column, j.entries[e]);
    }
  }
  /* what a root drives that is zero yet begins with no slope */
  for (int k = 0; k < n; k++)
    if (r.by[k] == UNDRIVEN && w->step.z0[k] == 0 && r.most[k] > 0) w->sizes.own[k] = r.most[k];
}

void frot_raise_small(const frot_model *m, const frot_state *s, frot_work *w, double h,
                      int by_slopes) {
  if (!by_slopes) {
    raise_by_jacobian(m, s, w, h);
    return;
  }
  for (int j = 0; j < m->nq; j++)
    if (frot_is_small(m, s, w, j) && fabs(w->step.z0[j]) <= w->sizes.change[j])
      w->sizes.own[j] = SMALL_PART * w->sizes.alike[m->q_alike[j]];
}

void frot_update_state_sizes(frot_state *s, const frot_work *w, const double *z) {
  double *worth = s->data + w->layout.worth;
  for (int i = 0; i < w->sizes.count; i++) {
    int j = w->sizes.states[i];
    double size = fabs(z[j]);
    double was = s->implicit ? LEFT_STIFF * worth[j] : faded(LEFT * worth[j], size);
    worth[j] = larger(was, size);
  }
}

void frot_keep_state_sizes(frot_state *s, const frot_work *w) {
  double *worth = s->data + w->layout.worth;
  for (int i = 0; i < w->sizes.count; i++) {
    int j = w->sizes.states[i];
    if (isfinite(w->sizes.change[j])) worth[j] = larger(worth[j], w->sizes.change[j]);
  }
}

double frot_rate_rounding(const frot_model *m, const frot_state *s, const frot_work *w, int state,
                          double h) {
  const double *noise = s->data + w->layout.noise;
  if (state >= m->nq || m->q_speed[state] < 0) return noise[state];
  return noise[state] + BY_STAGES * fabs(h) * noise[m->nq + m->q_speed[state]];
}

double frot_rounding_of_turn(const frot_model *m, int state) {
  for (int k = 0; k < m->n_turns; k++)
    if (state >= m->turns[k].at && state < m->turns[k].at + 4) return DBL_EPSILON;
  return 0;
}

void frot_bind_sizes(const frot_model *m, frot_size_work *w, frot_arena *a) {
  TAKE(w->change, m->nq), TAKE(w->left, m->nq), TAKE(w->own, m->nq + m->nv);
  TAKE(w->alike, m->nq), TAKE(w->states, m->nq);
  w->count = 0;
  for (int j = 0; a->base && j < m->nq; j++)
    if (m->q_speed[j] < 0) w->states[w->count++] = j;
}
