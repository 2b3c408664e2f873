/* One motion of many contacts and elements, where their combinations are too many to look at.
 *
 * With the bounds of friction held at given values the reactions are the minimum of a convex
 * quadratic function over a box (for a mass matrix; W lam + a is its gradient): Gauss-Seidel sweeps
 * find which reactions are at their bounds, Newton's method solves for the others (J. More, G.
 * Toraldo, On the solution of large quadratic programming problems with bound constraints, SIAM J.
 * Optim. 1, 1991). Then the bounds follow the reactions, until they agree. The modes read off are a
 * guess only: frot_is_admissible has the last word. */
#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "numerics/basis.h"
#include "reactions/switching_functions.h"
#include "reactions/reactions.h"
#include "modes/enumeration.h"
#include "numerics/tolerances.h"

#define SWEEPS 4    /* of Gauss-Seidel before each of Newton's steps */
#define ROUNDS 60   /* of sweeps and steps in one box */
#define BOXES 200   /* times the bounds follow the reactions */
#define AGREE 1e-12 /* part of a reaction by which bounds and reactions agree */
#define PAST 1e-8   /* part by which a bound is lowered where a rest ends */
#define DOUBT 1e-7  /* part of its size within which a reaction is at its bound, a motion none */
#define APART 1e-4  /* what the others leave at least of the motion that each reaction makes */
#define LEAST_PART 1e-6 /* of a step that is taken */
#define SOFT 1e-14      /* part of its diagonal added to a singular system */
#define LATER 1e-4      /* part of the load by which it has grown a little later */

/* The rows that take part, w->relations.rows[0 .. n), with the bounds least and most of their
 * reactions. */
typedef struct {
  const frot_instant *in;
  const frot_model *m;
  frot_work *w;
  const frot_group *g;
  int n, ends;
  double *least, *most;
} box;

static double own_effect(const box *b, int r) { return frot_effect(b->m, b->w, r, r); }

static void list_rows(box *b, const int *chosen, int count) {
  const frot_model *m = b->m;
  for (int c = 0; c < count; c++) {
    const frot_contact *contact = &m->contacts[chosen[c]];
    if (contact->row_n >= 0 && !contact->reduced) b->w->relations.rows[b->n++] = contact->row_n;
    for (int e = 0; e < m->n_elements; e++)
      if (m->elements[e].contact == chosen[c] && frot_bounds_something(m, b->w, e) &&
          !m->elements[e].prescribed)
        b->w->relations.rows[b->n++] = m->elements[e].row;
  }
}

/* Bounds by the reactions as they are; returns the largest relative change of those that are felt.
 */
static double follow(const box *b, const int *chosen, int count) {
  const frot_model *m = b->m;
  frot_work *w = b->w;
  double largest = 0;
  for (int i = 0; i < b->g->n_rows; i++) {
    int r = b->g->rows[i];
    double size;
    if (frot_is_reading(m, r)) w->core.lam[r] = frot_acceleration(m, w, r, &size);
  }
  for (int c = 0; c < count; c++) {
    const frot_contact *contact = &m->contacts[chosen[c]];
    if (contact->row_n >= 0 && !contact->reduced) {
      b->least[contact->row_n] = b->in->unilateral[chosen[c]] != 0 ? 0 : -INFINITY;
      b->most[contact->row_n] = INFINITY;
    }
  }
  for (int k = 0; k < b->n; k++) {
    int r = w->relations.rows[k], e = -1;
    for (int i = 0; i < m->n_elements; i++)
      if (m->elements[i].row == r) e = i;
    if (e < 0) continue;
    const frot_element *element = &m->elements[e];
    double bounding = 1;
    if (element->bound != FROT_BY_VALUE) bounding = fabs(w->core.lam[element->bounded_by[0]]);
    if (element->bound == FROT_BY_PIN) bounding = frot_bounding_length(element, w->core.lam);
    int rests = b->in->at_rest[e];
    double bound = w->core.coefficient[2 * e + rests] * bounding * (b->ends ? 1 - PAST : 1),
           before = b->most[r];
    b->least[r] = -bound, b->most[r] = bound;
    if (!rests && w->core.rate[r] > 0) b->most[r] = -bound;
    if (!rests && w->core.rate[r] < 0) b->least[r] = bound;
    /* a reaction inside its bounds, old and new, does not feel where they are */
    double change = fabs(fabs(b->least[r]) - fabs(before)), lam = fabs(w->core.lam[r]);
    if (change > 0 && (!rests || lam >= (1 - DOUBT) * fmin(bound, fabs(before))))
      largest = fmax(largest, change / fmax(bound, fabs(before)));
  }
  return largest;
}

static double clip(double x, double least, double most) {
  return x < least ? least : x > most ? most : x;
}

static void sweep(const box *b) {
  double size;
  for (int k = 0; k < b->n; k++) {
    int r = b->w->relations.rows[k];
    double own = own_effect(b, r), a = frot_acceleration(b->m, b->w, r, &size);
    if (own > 0) b->w->core.lam[r] = clip(b->w->core.lam[r] - a / own, b->least[r], b->most[r]);
  }
}

/* x <- the least solution of the symmetric system of n reactions, each in its own unit: by its
 * factor where none of them depends on others. */
static void solve_inside(const frot_work *w, int n, double *x) {
  double *a = w->linear.matrix, *factor = w->linear.scratch, least = 1;
  memcpy(factor, a, sizeof(double) * (size_t)(n * n));
  int singular = frot_cholesky(factor, n);
  for (int i = 0; i < n && !singular; i++) least = fmin(least, fabs(factor[i * n + i]));
  if (singular || !(least > APART)) {
    frot_least_norm(a, w->linear.right, n, n, FROT_RANK, x, factor, w->linear.pivot);
    return;
  }
  memcpy(x, w->linear.right, sizeof(double) * (size_t)n);
  frot_forward(factor, n, n, x);
  frot_backward(factor, n, n, x);
}

/* The quadratic function of which the reactions are the minimum. */
static double value(const box *b) {
  double sum = 0, size;
  for (int k = 0; k < b->n; k++) {
    int r = b->w->relations.rows[k];
    sum += 0.5 * b->w->core.lam[r] * (frot_acceleration(b->m, b->w, r, &size) + b->w->core.free[r]);
  }
  return sum;
}

/* The reactions of `rows` are those `from`, with a part of `step`, as far as their bounds let them.
 * Returns whether they do. */
static int move(const box *b, int n, const int *rows, const double *from, const double *step,
                double part) {
  int whole = 1;
  for (int i = 0; i < n; i++) {
    double to = from[i] + part * step[i], *lam = &b->w->core.lam[rows[i]];
    *lam = clip(to, b->least[rows[i]], b->most[rows[i]]);
    whole &= *lam == to;
  }
  return whole;
}

/* Newton's step on the reactions inside their bounds. Those that meet bounds stay there while the
 * others go on, in half the step where the function would grow: to stop at the first bound would
 * take a step for each, where reactions are not unique most of them none. Returns whether it is a
 * whole step that meets no bound. */
static int step_inside(const box *b) {
  frot_work *w = b->w;
  int free = 0, *rows = w->reactions.fold; /* FROT_FOLDS places for each row: room enough */
  double size, *from = w->linear.right;
  for (int k = 0; k < b->n; k++) {
    int r = w->relations.rows[k];
    if (w->core.lam[r] > b->least[r] && w->core.lam[r] < b->most[r]) rows[free++] = r;
  }
  if (free == 0) return 1;
  double *step = w->reactions.solution;
  for (int i = 0; i < free; i++) {
    double scale = 1 / sqrt(own_effect(b, rows[i]));
    for (int j = 0; j < free; j++)
      w->linear.matrix[j * free + i] = scale * frot_effect(b->m, w, rows[i], rows[j]) /
                                       sqrt(own_effect(b, rows[j])) * (i == j ? 1 + SOFT : 1);
    w->linear.right[i] = -scale * frot_acceleration(b->m, w, rows[i], &size);
  }
  solve_inside(w, free, step);
  for (int i = 0; i < free; i++) {
    step[i] /= sqrt(own_effect(b, rows[i]));
    from[i] = w->core.lam[rows[i]];
  }
  double before = value(b);
  for (double part = 1; part > LEAST_PART; part *= 0.5) {
    int whole = move(b, free, rows, from, step, part);
    if (whole && part == 1) return 1;
    if (value(b) <= before) return 0;
  }
  move(b, free, rows, from, step, 0);
  return 0;
}

/* Read off the modes; what is near a bound, and a motion near none, is in doubt. */
static void read_modes(const box *b, const int *chosen, int count, unsigned char *certain) {
  const frot_model *m = b->m;
  frot_work *w = b->w;
  for (int c = 0; c < count; c++) {
    int i = chosen[c], row = m->contacts[i].row_n;
    double size, a = 0;
    frot_contact_mode mode = {1, 1, 0, 0, 0, 0, 0, {0}};
    certain[i] = 1;
    if (row >= 0 && b->in->unilateral[i] != 0) {
      a = frot_acceleration(m, w, row, &size);
      size += w->core.row_load[row];
      mode.closed = !(w->core.lam[row] <= 0 && a > DOUBT * size);
      if (mode.closed && w->core.lam[row] <= DOUBT * frot_reaction_size(m, w, row)) certain[i] = 0;
    } else if (row >= 0) {
      mode.side = w->core.lam[row] < 0 ? -1 : 1;
    }
    w->search.trial[i] = mode;
    for (int e = 0; e < m->n_elements; e++) {
      const frot_element *element = &m->elements[e];
      frot_contact_mode *law = &w->search.trial[m->n_contacts + e];
      if (element->contact != i) continue;
      *law = (frot_contact_mode){0};
      if (!mode.closed || !frot_bounds_something(m, w, e)) continue;
      a = frot_acceleration(m, w, element->row, &size);
      size += w->core.row_load[element->row];
      double rate = w->core.rate[element->row], lam = w->core.lam[element->row],
             most = b->most[element->row];
      if (!b->in->zero[e] || element->prescribed) {
        law->friction = rate > 0 ? FROT_SLIP_FORWARD : FROT_SLIP_BACKWARD;
        if (element->prescribed && rate == 0) law->friction = FROT_STICK, certain[i] = 0;
        continue;
      }
      int at_bound = fabs(lam) >= most * (1 - DOUBT);
      law->friction = FROT_STICK;
      if (at_bound && fabs(a) > (b->ends ? 1e-3 * PAST : DOUBT) * size)
        law->friction = a > 0 ? FROT_SLIP_FORWARD : FROT_SLIP_BACKWARD;
      else if (at_bound && most > 0)
        law->at_bound = lam > 0 ? 1 : -1;
    }
  }
}

int frot_loads_grow(const frot_instant *in, int contact) {
  const frot_group *g = &in->m->groups[in->m->contact_group[contact]];
  const double *growth = in->w->share.growth + g->vector;
  return !g->general && frot_dot(growth, growth, g->n_speeds) > 0;
}

/* The load a little later, where all rests: what comes to zero at the instant has its sign then.
 * Readings are left as they are. */
static void let_grow(const box *b) {
  frot_work *w = b->w;
  const double *growth = w->share.growth + b->g->vector, *force = w->core.force + b->g->vector;
  int ns = b->g->n_speeds;
  double load = frot_dot(force, force, ns), by = frot_dot(growth, growth, ns);
  double part = load > 0 ? LATER * sqrt(load / by) : 1;
  for (int k = 0; k < b->n; k++) {
    int r = w->relations.rows[k];
    if (!frot_is_reading(b->m, r))
      w->core.free[r] += part * frot_dot(frot_entries(b->m, w->core.half, r), growth, ns);
  }
}

void frot_guess_modes(const frot_instant *in, const int *chosen, int count, int ends, int later,
                      unsigned char *certain) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  box b = {in,
           m,
           w,
           &m->groups[m->contact_group[chosen[0]]],
           0,
           ends,
           w->search.pivot_bound,
           w->search.pivot_bound + m->n_rows};
  double *now = b.most + m->n_rows;
  memset(w->search.pivot_bound, 0, sizeof(double) * 2 * (size_t)m->n_rows);
  memset(w->core.lam, 0, sizeof(double) * (size_t)m->n_rows);
  memcpy(now, w->core.free, sizeof(double) * (size_t)m->n_rows);
  list_rows(&b, chosen, count);
  if (later) let_grow(&b);
  for (int boxes = 0; boxes < BOXES; boxes++) {
    double change = follow(&b, chosen, count);
    if (boxes > 0 && change <= AGREE) break;
    for (int k = 0; k < b.n; k++) {
      int r = w->relations.rows[k];
      w->core.lam[r] = clip(w->core.lam[r], b.least[r], b.most[r]);
    }
    for (int round = 0, settled = 0; round < ROUNDS && settled < 2; round++) {
      for (int k = 0; k < SWEEPS; k++) sweep(&b);
      settled = step_inside(&b) ? settled + 1 : 0;
    }
  }
  read_modes(&b, chosen, count, certain);
  memcpy(w->core.free, now, sizeof(double) * (size_t)m->n_rows);
}
