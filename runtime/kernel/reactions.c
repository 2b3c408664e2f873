/* Reactions of the active rows.
 *
 * The unknowns are the normal reactions, both components of a pin's reaction, and what holds the
 * motions at rest. What slips follows them: w->ratio is the reaction of the slip (first of two per
 * contact) and of rolling over the reaction that bounds it, or the reaction itself where a value
 * bounds it. The size of a pin's reaction is not linear: it is replaced by its part along the
 * direction w->along of the last pass, which is Newton's method. */
#include "reactions.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core.h"
#include "linear.h"

#define FRICTION_WEIGHT 1e-5
#define AGREES 1e-9 /* of their terms: accelerations of dependent rows that do not contradict */
#define PIN_PASSES 60
#define PIN_CLOSE 1e-9 /* of the reaction: the next pass, twice as exact, is the last */

/* What an unknown is: the reaction that bounds (a pin's two components), or one that holds. */
enum { NORMAL, SECOND, HELD };

double frot_bound_of_rest(const frot_model *m, const frot_work *w, int i,
                          const frot_contact_mode *mode, int rolling) {
  const frot_contact *contact = &m->contacts[i];
  const double *k = w->coefficient + 3 * i; /* mu, mu_s, delta */
  double coefficient = rolling ? k[2] : k[1];
  if (contact->bound == FROT_BY_VALUE) return coefficient;
  if (contact->bound == FROT_BY_PIN)
    return coefficient * hypot(w->lam[contact->row_n], w->lam[contact->row_n2]);
  return coefficient * mode->side * w->lam[contact->row_n];
}

double frot_free_size(const frot_model *m, const frot_work *w, int row) {
  int nw = m->nv + m->na + m->nc;
  double sum = fabs(w->c[row]);
  if (!m->general)
    return sum + sqrt(frot_dot(w->force, w->force, nw)) * sqrt(w->delassus[row * (m->n_rows + 1)]);
  for (int k = 0; k < nw; k++) sum += fabs(w->rows[nw * row + k] * w->free_motion[k]);
  return sum;
}

/* Direction of friction on the body: against the slip, times the side of the reaction. */
static double opposed(const frot_contact_mode *mode, int friction) {
  if (friction == FROT_SLIP_FORWARD) return -mode->side;
  if (friction == FROT_SLIP_BACKWARD) return mode->side;
  return 0;
}

static void set_ratios(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                       const unsigned char *at_rest) {
  for (int i = 0; i < m->n_contacts; i++) {
    const double *k = w->coefficient + 3 * i;
    double *ratio = w->ratio + 2 * i, *clamp = w->clamp + 2 * i;
    ratio[0] = opposed(&modes[i], modes[i].friction) * (at_rest && at_rest[i] ? k[1] : k[0]);
    ratio[1] = opposed(&modes[i], modes[i].rolling) * k[2];
    if (clamp[0] != 0) ratio[0] = clamp[0] * k[1];
    if (clamp[1] != 0) ratio[1] = clamp[1] * k[2];
  }
}

/* Whether the motion of row `row` is held: 1, and 2 where its reaction is at its bound all the
 * same and so follows. */
static int holds(const frot_work *w, const frot_contact_mode *modes, int i, int rolling) {
  int mode = rolling ? modes[i].rolling : modes[i].friction;
  if (mode != FROT_STICK) return 0;
  return w->clamp[2 * i + rolling] != 0 ? 2 : 1;
}

/* Unknowns into w->row_of, w->contact_of and `kind`, then the rows whose reaction is known though
 * they are held; returns the number of unknowns and in *rows that of all of them. */
static int list_unknowns(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                         unsigned char *kind, int clamped, int *rows) {
  int n = 0;
  for (int pass = 1; pass <= 1 + clamped; pass++) {
    for (int i = 0; i < m->n_contacts; i++) {
      const frot_contact *contact = &m->contacts[i];
      if (!modes[i].closed) continue;
      int at[FROT_ROWS];
      frot_rows_of(contact, at);
      for (int k = 0; k < FROT_ROWS; k++) {
        int wanted = k < 2 ? pass == 1 : holds(w, modes, i, k == 3) == pass;
        if (at[k] < 0 || !wanted) continue;
        if (k >= 2 && frot_is_prescribed(m, w, at[k])) continue; /* no reaction changes it */
        kind[n] = (unsigned char)(k == 0 ? NORMAL : k == 1 ? SECOND : HELD);
        w->contact_of[n] = i;
        w->row_of[n++] = at[k];
      }
    }
    if (pass == 1) *rows = n;
  }
  int unknowns = *rows;
  *rows = n;
  return unknowns;
}

/* Part of the ratio by which the slip follows this unknown. */
static double share(const frot_model *m, const frot_work *w, int i, int kind) {
  if (m->contacts[i].bound != FROT_BY_PIN) return 1;
  return w->along[2 * i + (kind == SECOND)];
}

/* The system of the active rows (rows x unknowns) into w->active and w->right. */
static void assemble(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                     const unsigned char *kind, int unknowns, int rows) {
  int nr = m->n_rows;
  for (int c = 0; c < unknowns; c++) {
    int i = w->contact_of[c];
    const frot_contact *contact = &m->contacts[i];
    double friction = w->ratio[2 * i] * share(m, w, i, kind[c]);
    double rolling = kind[c] == NORMAL ? w->ratio[2 * i + 1] : 0;
    for (int r = 0; r < rows; r++) {
      const double *responses = w->delassus + w->row_of[r] * nr;
      double value = responses[w->row_of[c]];
      if (kind[c] != HELD && friction != 0) value += friction * responses[contact->row_t];
      if (kind[c] != HELD && rolling != 0) value += rolling * responses[contact->row_r];
      w->active[c * rows + r] = value;
    }
  }
  for (int r = 0; r < rows; r++) {
    w->right[r] = -w->free[w->row_of[r]];
    for (int i = 0; i < m->n_contacts; i++)
      if (modes[i].closed && m->contacts[i].bound == FROT_BY_VALUE && w->ratio[2 * i] != 0)
        w->right[r] -= w->ratio[2 * i] * w->delassus[w->row_of[r] * nr + m->contacts[i].row_t];
  }
}

/* Weights of the unknowns into w->weight: friction weighs so much more than normal reactions that
 * rest is not lost for want of it. Elements side by side that values bound share a load in
 * proportion to their bounds, so that they reach them together: sum of lam^2 g / bound is least,
 * where g, the size of the row, makes a gear between them count. */
static void set_weights(const frot_model *m, frot_work *w, const unsigned char *kind,
                        int unknowns) {
  double largest = 0;
  for (int c = 0; c < unknowns; c++) {
    int i = w->contact_of[c], row = w->row_of[c];
    double *weight = w->weight + c;
    *weight = 1;
    if (kind[c] != HELD || m->contacts[i].bound != FROT_BY_VALUE) continue;
    double size = sqrt(fabs(w->delassus[row * (m->n_rows + 1)]));
    *weight = size > 0 ? sqrt(w->coefficient[3 * i + 1] / size) : 1;
    largest = fmax(largest, *weight);
  }
  for (int c = 0; c < unknowns; c++) {
    if (kind[c] != HELD) continue;
    if (m->contacts[w->contact_of[c]].bound == FROT_BY_VALUE && largest > 0)
      w->weight[c] /= largest;
    w->weight[c] *= FRICTION_WEIGHT;
  }
}

/* Least reactions where the rows depend on each other (hyperstatic), if they do not contradict. */
static int solve_least(const frot_model *m, frot_work *w, const unsigned char *kind, int unknowns,
                       int rows, double *x) {
  double *copy = w->lstsq, *b = copy + rows * unknowns, *scratch = b + rows;
  set_weights(m, w, kind, unknowns);
  for (int c = 0; c < unknowns; c++)
    for (int r = 0; r < rows; r++) copy[c * rows + r] = w->weight[c] * w->active[c * rows + r];
  memcpy(b, w->right, sizeof(double) * (size_t)rows);
  frot_least_norm(copy, b, rows, unknowns, x, scratch, w->pivot);
  for (int c = 0; c < unknowns; c++) x[c] *= w->weight[c];
  for (int r = 0; r < rows; r++) {
    double sum = -w->right[r], size = frot_free_size(m, w, w->row_of[r]) + fabs(w->right[r]);
    for (int c = 0; c < unknowns; c++) {
      sum += w->active[c * rows + r] * x[c];
      size += fabs(w->active[c * rows + r] * x[c]);
    }
    if (!(fabs(sum) <= AGREES * size)) return 1;
  }
  return 0;
}

/* Solve once in the directions w->along. *dependent: the reactions are not unique. */
static int solve(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                 unsigned char *kind, int clamped, int *dependent) {
  int rows, unknowns = list_unknowns(m, w, modes, kind, clamped, &rows);
  memset(w->lam, 0, sizeof(double) * (size_t)m->n_rows);
  assemble(m, w, modes, kind, unknowns, rows);
  double *copy = w->lstsq, *x = w->step;
  int regular = rows == unknowns;
  if (regular) {
    memcpy(copy, w->active, sizeof(double) * (size_t)(rows * rows));
    memcpy(x, w->right, sizeof(double) * (size_t)rows);
    regular = !frot_lu_solve(copy, x, rows);
  }
  if (!regular) *dependent = 1;
  if (!regular && solve_least(m, w, kind, unknowns, rows, x)) return 1;
  for (int c = 0; c < unknowns; c++) w->lam[w->row_of[c]] = x[c];
  for (int i = 0; i < m->n_contacts; i++) {
    const frot_contact *contact = &m->contacts[i];
    if (!modes[i].closed) continue;
    double bounding = contact->bound == FROT_BY_VALUE ? 1 : w->lam[contact->row_n];
    if (contact->bound == FROT_BY_PIN)
      bounding = w->along[2 * i] * bounding + w->along[2 * i + 1] * w->lam[contact->row_n2];
    if (w->ratio[2 * i] != 0) w->lam[contact->row_t] = w->ratio[2 * i] * bounding;
    if (w->ratio[2 * i + 1] != 0) w->lam[contact->row_r] = w->ratio[2 * i + 1] * bounding;
  }
  return !frot_all_finite(w->lam, m->n_rows);
}

/* Turn the directions of the pins whose friction follows to their reactions. Returns the largest
 * part of a reaction that the directions before missed. */
static double turn_pins(const frot_model *m, frot_work *w, const frot_contact_mode *modes) {
  double missed = 0;
  for (int i = 0; i < m->n_contacts; i++) {
    const frot_contact *contact = &m->contacts[i];
    if (contact->bound != FROT_BY_PIN || !modes[i].closed || w->ratio[2 * i] == 0) continue;
    double *along = w->along + 2 * i;
    double first = w->lam[contact->row_n], second = w->lam[contact->row_n2];
    double size = hypot(first, second), before = along[0] * first + along[1] * second;
    if (!(size > before)) continue;
    missed = fmax(missed, (size - before) / size);
    along[0] = first / size, along[1] = second / size;
  }
  return missed;
}

static int solve_pins(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                      unsigned char *kind, int clamped, int *dependent) {
  if (w->pins == 0) return solve(m, w, modes, kind, clamped, dependent);
  memset(w->along, 0, sizeof(double) * 2 * (size_t)m->n_contacts);
  int last = 0;
  for (int pass = 0; pass < PIN_PASSES; pass++) {
    if (solve(m, w, modes, kind, clamped, dependent)) return 1;
    double missed = turn_pins(m, w, modes);
    if (last || missed <= 4 * DBL_EPSILON) return 0;
    last = missed < PIN_CLOSE;
  }
  return 1;
}

/* Where held motions need more than their bounds, but others could hold instead, put the former at
 * their bounds. Returns 1 when one was put there. */
static int clamp_excess(const frot_model *m, frot_work *w, const frot_contact_mode *modes) {
  int worst = -1;
  double most = 1 + 1e-12;
  for (int k = 0; k < 2 * m->n_contacts; k++) {
    int i = k / 2, rolling = k % 2;
    if (!modes[i].closed || holds(w, modes, i, rolling) != 1) continue;
    int row = rolling ? m->contacts[i].row_r : m->contacts[i].row_t;
    double bound = frot_bound_of_rest(m, w, i, &modes[i], rolling);
    if (fabs(w->lam[row]) > most * fabs(bound))
      most = bound != 0 ? fabs(w->lam[row] / bound) : INFINITY, worst = k;
  }
  if (worst < 0) return 0;
  const frot_contact *contact = &m->contacts[worst / 2];
  double lam = w->lam[worst % 2 ? contact->row_r : contact->row_t];
  double bounding = frot_has_normal(contact) ? w->lam[contact->row_n] : 1;
  w->clamp[worst] = (lam > 0) == (bounding >= 0) ? 1 : -1;
  return 1;
}

int frot_reactions(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                   const unsigned char *at_rest) {
  int dependent = 0;
  unsigned char *kind = w->kind;
  if (m->n_rows == 0) return 0;
  memset(w->clamp, 0, sizeof(double) * 2 * (size_t)m->n_contacts);
  set_ratios(m, w, modes, at_rest);
  if (solve_pins(m, w, modes, kind, 0, &dependent)) return 1;
  while (dependent && clamp_excess(m, w, modes)) {
    set_ratios(m, w, modes, at_rest);
    if (!solve_pins(m, w, modes, kind, 1, &dependent)) continue;
    /* nothing else can hold: the excess stands, and ends the rest */
    memset(w->clamp, 0, sizeof(double) * 2 * (size_t)m->n_contacts);
    set_ratios(m, w, modes, at_rest);
    return solve_pins(m, w, modes, kind, 0, &dependent);
  }
  return 0;
}
