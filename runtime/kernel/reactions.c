/* Reactions of the active rows of a group.
 *
 * Held rows do not accelerate: J z + c = 0. What slips follows the reaction that bounds it, lam_t =
 * ratio * bounding. Where that is the reaction of a held row, its column takes the friction along;
 * where it is a reading, which depends on all reactions, the friction is an unknown with an
 * equation of its own. The size of a pin's reaction is not linear: it is replaced by its part along
 * the direction w->reactions.along of the last pass, which is Newton's method.
 *
 * Of a mass matrix the held rows H = L^-1 J' are made orthonormal, in their order, H = Q R, and the
 * conditions taken as Q' u + R'^-1 c = 0 with u = f + sum of H lam: the condition of the system is
 * that of H, not of its Gram matrix. What depends on the rows before it is left out, if it agrees
 * with them. */
#include "reactions.h"

#include <math.h>
#include <string.h>

#include "core.h"
#include "linear.h"
#include "spare.h"
#include "tolerances.h"

/* The unknown reactions are w->reactions.unknown[0 .. unknowns): first those of held rows, then
 * friction that follows readings. Friction that follows a held normal goes with its column:
 * w->reactions.fold, two places for each unknown, the rows, w->reactions.fold_ratio, the ratios. */
typedef struct {
  const frot_model *m;
  frot_work *w;
  const frot_group *g;
  const frot_contact_mode *modes;
  int held, unknowns, equations; /* of these, those that hold rows: */
  int holding;
} problem;

double frot_bounding(const frot_model *m, const frot_work *w, int element,
                     const frot_contact_mode *modes) {
  const frot_element *e = &m->elements[element];
  if (e->bound == FROT_BY_VALUE) return 1;
  if (e->bound == FROT_BY_PIN)
    return hypot(w->core.lam[e->bounded_by[0]], w->core.lam[e->bounded_by[1]]);
  return modes[e->contact].side * w->core.lam[e->bounded_by[0]];
}

double frot_bound_of_rest(const frot_model *m, const frot_work *w, int element,
                          const frot_contact_mode *modes) {
  return w->core.coefficient[2 * element + 1] * frot_bounding(m, w, element, modes);
}

double frot_acceleration(const frot_model *m, const frot_work *w, int row, double *size) {
  const frot_group *g = frot_group_of(m, row);
  const double *effects = frot_effect_on(m, w, row);
  double sum = w->core.free[row];
  *size = 0;
  for (int k = 0; k < g->n_rows; k++) {
    double lam = w->core.lam[g->rows[k]];
    if (lam == 0 || frot_is_reading(m, g->rows[k])) continue;
    sum += effects[k] * lam, *size += fabs(effects[k] * lam);
  }
  return sum;
}

double frot_free_size(const frot_model *m, const frot_work *w, int row) {
  const frot_group *g = frot_group_of(m, row);
  double sum = w->core.bias_size[row];
  const double *force = w->core.force + g->vector;
  const double *entries = frot_entries(m, g->general ? w->core.rows : w->core.half, row);
  int count = g->general ? g->n : g->n_speeds;
  for (int k = 0; k < count; k++) sum += fabs(entries[k] * force[k]);
  return sum;
}

int frot_is_held(const frot_model *m, const frot_contact_mode *modes, int element) {
  const frot_element *e = &m->elements[element];
  const frot_contact_mode *mode = frot_element_mode(m, modes, element);
  return modes[e->contact].closed && !modes[e->contact].unloaded && mode->friction == FROT_STICK &&
         mode->at_bound == 0 && !e->prescribed;
}

int frot_is_loaded(const frot_model *m, const frot_contact_mode *modes, int contact) {
  const frot_contact *c = &m->contacts[contact];
  return c->row_n >= 0 && !c->reduced && modes[contact].closed && !modes[contact].unloaded;
}

/* Friction of an element over what bounds it, with its sign. */
static double ratio_of(const problem *p, int e, const unsigned char *at_rest) {
  const frot_contact_mode *contact = &p->modes[p->m->elements[e].contact];
  const frot_contact_mode *mode = frot_element_mode(p->m, p->modes, e);
  const double *k = p->w->core.coefficient + 2 * e;
  if (!contact->closed || contact->unloaded) return 0;
  if (mode->friction == FROT_STICK) return mode->at_bound * contact->side * k[1];
  double size = at_rest && at_rest[e] ? k[1] : k[0];
  if (mode->friction == FROT_SLIP_FORWARD) return -contact->side * size;
  if (mode->friction == FROT_SLIP_BACKWARD) return contact->side * size;
  return 0;
}

static void list_unknowns(problem *p, const unsigned char *at_rest) {
  const frot_model *m = p->m;
  const frot_group *g = p->g;
  frot_work *w = p->w;
  int n = 0;
  /* what always holds stands first, friction depends on it */
  for (int i = 0; i < g->n_contacts; i++)
    if (frot_is_loaded(m, p->modes, g->contacts[i]))
      w->reactions.unknown[n++] = m->contacts[g->contacts[i]].row_n;
  for (int k = 0; k < n; k++) w->reactions.friction[k] = 0;
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    w->reactions.ratio[e] = 0;
    if (!frot_is_held(m, p->modes, e)) continue;
    w->reactions.friction[n] = (unsigned char)(1 + (m->elements[e].bound == FROT_BY_VALUE));
    w->reactions.owner[n] = e;
    w->reactions.unknown[n++] = m->elements[e].row;
  }
  p->held = n;
  for (int k = 0; k < 2 * n; k++) w->reactions.fold[k] = -1;
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    const frot_element *element = &m->elements[e];
    double ratio = ratio_of(p, e, at_rest);
    w->reactions.ratio[e] = ratio;
    if (ratio == 0 || element->bound == FROT_BY_VALUE) continue;
    if (element->bound == FROT_BY_NORMAL && !frot_is_reading(m, element->bounded_by[0])) {
      for (int k = 0; k < p->held; k++) {
        if (w->reactions.unknown[k] != element->bounded_by[0]) continue;
        int at = 2 * k + (w->reactions.fold[2 * k] >= 0);
        w->reactions.fold[at] = element->row, w->reactions.fold_ratio[at] = ratio;
      }
      continue;
    }
    w->reactions.friction[n] = 0, w->reactions.owner[n] = e;
    w->reactions.fold[2 * n] = w->reactions.fold[2 * n + 1] = -1;
    w->reactions.unknown[n++] = element->row;
  }
  p->unknowns = n;
}

/* What the reaction of unknown c, with the friction that goes with it, does to a row. */
static double effect_of(const problem *p, int row, int c) {
  const frot_work *w = p->w;
  const double *effects = frot_effect_on(p->m, w, row);
  double value = effects[p->m->row_local[w->reactions.unknown[c]]];
  for (int k = 2 * c; k < 2 * c + 2; k++)
    if (w->reactions.fold[k] >= 0)
      value += w->reactions.fold_ratio[k] * effects[p->m->row_local[w->reactions.fold[k]]];
  return value;
}

/* A row's value without the unknowns: with the friction that values bound. */
static double known_part(const problem *p, int row) {
  const frot_model *m = p->m;
  double sum = p->w->core.free[row];
  for (int i = 0; i < p->g->n_elements; i++) {
    int e = p->g->elements[i];
    if (m->elements[e].bound == FROT_BY_VALUE && p->w->reactions.ratio[e] != 0)
      sum += p->w->reactions.ratio[e] * frot_effect(m, p->w, row, m->elements[e].row);
  }
  return sum;
}

/* x (n_speeds) <- what the unknown c does to u, or with c < 0 what is known of u. */
static void column_of(const problem *p, int c, double *x) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  const frot_group *g = p->g;
  int ns = g->n_speeds;
  if (c >= 0) {
    memcpy(x, frot_entries(m, w->core.half, w->reactions.unknown[c]), sizeof(double) * (size_t)ns);
    for (int k = 2 * c; k < 2 * c + 2; k++) {
      if (w->reactions.fold[k] < 0) continue;
      const double *half = frot_entries(m, w->core.half, w->reactions.fold[k]);
      for (int j = 0; j < ns; j++) x[j] += w->reactions.fold_ratio[k] * half[j];
    }
    return;
  }
  memcpy(x, w->core.force + g->vector, sizeof(double) * (size_t)ns);
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    if (m->elements[e].bound != FROT_BY_VALUE || w->reactions.ratio[e] == 0) continue;
    const double *half = frot_entries(m, w->core.half, m->elements[e].row);
    for (int j = 0; j < ns; j++) x[j] += w->reactions.ratio[e] * half[j];
  }
}

/* Row k of those of a contact that is kept without a reaction of its own, then of its elements that
 * are: -1 for the others. */
static int row_without_reaction(const problem *p, int contact, int k) {
  const frot_model *m = p->m;
  const frot_contact_mode *mode = &p->modes[contact];
  const frot_contact *c = &m->contacts[contact];
  if (k < 0) return mode->closed && mode->unloaded && c->row_n >= 0 && !c->reduced ? c->row_n : -1;
  const frot_contact_mode *law = frot_element_mode(m, p->modes, k);
  int kept = m->elements[k].contact == contact && mode->closed && !m->elements[k].prescribed &&
             law->friction == FROT_STICK && (mode->unloaded || law->at_bound != 0);
  return kept ? m->elements[k].row : -1;
}

/* Whether anything of the group is at its bound or carries nothing. */
static int leaves_to_others(const problem *p) {
  const frot_group *g = p->g;
  for (int i = 0; i < g->n_contacts; i++)
    if (p->modes[g->contacts[i]].unloaded) return 1;
  for (int i = 0; i < g->n_elements; i++)
    if (frot_element_mode(p->m, p->modes, g->elements[i])->at_bound != 0) return 1;
  return 0;
}

/* What is at its bound or carries nothing is kept by the others: where several friction forces at
 * their bounds hold a row together, none of them has a row of its own. Appends those rows to the
 * orthonormal ones. */
static void add_kept_rows(problem *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int ns = p->g->n_speeds, some = leaves_to_others(p);
  for (int i = 0; some && i < p->g->n_contacts; i++)
    for (int law = -1; law < p->g->n_elements && w->span.rank < ns; law++) {
      int e = law < 0 ? -1 : p->g->elements[law], rank = w->span.rank;
      int row = row_without_reaction(p, p->g->contacts[i], e);
      if (row < 0) continue;
      double *x = w->span.basis + ns * rank, *parts = w->span.parts, bias = w->core.c[row];
      memcpy(x, frot_entries(m, w->core.half, row), sizeof(double) * (size_t)ns);
      double length = sqrt(frot_dot(x, x, ns)), size = w->core.bias_size[row];
      double rest = frot_reject(x, w->span.basis, rank, ns, parts);
      if (!(rest > frot_least_length(m, w, row, length))) continue;
      for (int k = 0; k < rank; k++)
        bias -= parts[k] * w->span.bias[k], size += fabs(parts[k]) * w->span.bias_size[k];
      for (int k = 0; k < ns; k++) x[k] /= rest;
      w->span.bias[rank] = bias / rest, w->span.bias_size[rank] = size / rest;
      w->span.rank++;
    }
  p->equations = w->span.rank;
}

/* The held rows of a mass matrix, orthonormal, into w->span.basis with their biases in
 * w->span.bias; p->equations is their number. Returns 1 when a row that depends on others
 * contradicts them. */
static int orthonormalize(problem *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int ns = p->g->n_speeds, rank = 0;
  for (int k = 0; k < p->held; k++) {
    int row = w->reactions.unknown[k];
    if (frot_is_spare(w, row)) {
      w->reactions.dependent = w->reactions.carried[row] = 1;
      w->span.left[row] = 0;
      continue;
    }
    double *x = w->span.basis + ns * rank, *parts = w->span.parts;
    memcpy(x, frot_entries(m, w->core.half, row), sizeof(double) * (size_t)ns);
    w->reactions.carried[row] = 0;
    double length = sqrt(frot_dot(x, x, ns)), bias = w->core.c[row];
    double size = w->core.bias_size[row];
    double rest = frot_reject(x, w->span.basis, rank, ns, parts);
    for (int i = 0; i < rank; i++) {
      bias -= parts[i] * w->span.bias[i];
      size += fabs(parts[i]) * w->span.bias_size[i];
    }
    if (!(rest > frot_least_length(m, w, row, length))) {
      w->reactions.dependent = w->reactions.carried[row] = 1;
      w->span.left[row] = 0;
      if (!(fabs(bias) <= FROT_AGREES * (size + frot_free_size(m, w, row)))) return 1;
      continue;
    }
    w->span.left[row] = rest;
    for (int i = 0; i < ns; i++) x[i] /= rest;
    if (w->reactions.friction[k] == 0)
      memcpy(frot_entries(m, w->span.direction, row), x, sizeof(double) * (size_t)ns);
    w->span.bias_size[rank] = size / rest;
    w->span.bias[rank++] = bias / rest;
  }
  w->span.rank = rank;
  add_kept_rows(p);
  return 0;
}

/* The conditions that hold the held rows into the first lines of w->linear.matrix and
 * w->linear.right, the columns in units w->unit_of. The leading dimension is the number of
 * unknowns. Returns 1 when they contradict each other. */
static int hold_rows(problem *p) {
  frot_work *w = p->w;
  int n = p->unknowns, ns = p->g->n_speeds;
  if (p->g->general) {
    p->equations = p->held;
    for (int c = 0; c < n; c++) {
      double size = fabs(effect_of(p, w->reactions.unknown[c], c));
      w->reactions.unit_of[c] = size > 0 ? 1 / sqrt(size) : 1;
    }
    for (int r = 0; r < p->held; r++) {
      double scale = w->reactions.unit_of[r];
      for (int c = 0; c < n; c++)
        w->linear.matrix[c * n + r] =
            scale * w->reactions.unit_of[c] * effect_of(p, w->reactions.unknown[r], c);
      w->linear.right[r] = -scale * known_part(p, w->reactions.unknown[r]);
    }
    return 0;
  }
  if (orthonormalize(p)) return 1;
  double *x = w->core.rest;
  for (int c = -1; c < n; c++) {
    column_of(p, c, x);
    double length = sqrt(frot_dot(x, x, ns)), unit = length > 0 ? 1 / length : 1;
    if (c >= 0) w->reactions.unit_of[c] = unit;
    for (int r = 0; r < p->equations; r++) {
      double part = frot_dot(w->span.basis + ns * r, x, ns);
      if (c < 0)
        w->linear.right[r] = -(part + w->span.bias[r]);
      else
        w->linear.matrix[c * n + r] = unit * part;
    }
  }
  return 0;
}

/* What is known of the readings that bound friction, and what each unknown does to them, once for
 * all directions: known (2 for each follower), effects (n for each of these). */
static void read_bounds(const problem *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int n = p->unknowns;
  double *known = w->reactions.known, *effects = w->reactions.effects;
  for (int f = p->held; f < n; f++)
    for (int k = 0; k < 2; k++, known++, effects += n) {
      int reading = m->elements[w->reactions.owner[f]].bounded_by[k];
      if (reading < 0) continue;
      *known = known_part(p, reading);
      for (int c = 0; c < p->held; c++)
        effects[c] = w->reactions.unit_of[c] * effect_of(p, reading, c);
      const double *all = frot_effect_on(m, w, reading); /* nothing goes with what follows */
      for (int c = p->held; c < n; c++)
        effects[c] = w->reactions.unit_of[c] * all[m->row_local[w->reactions.unknown[c]]];
    }
}

/* The friction that follows readings: lam - ratio (its reading) = 0. */
static void follow_readings(problem *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int n = p->unknowns;
  const double *known = w->reactions.known, *effects = w->reactions.effects;
  p->equations = p->holding;
  for (int f = p->held; f < n; f++, known += 2, effects += 2 * n) {
    int e = w->reactions.owner[f], line = p->equations++, pin = m->elements[e].bound == FROT_BY_PIN;
    double ratio = w->reactions.ratio[e] / w->reactions.unit_of[f];
    double first = pin ? w->reactions.along[2 * e] : 1;
    double second = pin ? w->reactions.along[2 * e + 1] : 0;
    double *entry = w->linear.matrix + line;
    for (int c = 0; c < n; c++, entry += n) {
      double effect = first * effects[c];
      if (pin) effect += second * effects[n + c];
      *entry = (c == f) - ratio * effect;
    }
    w->linear.right[line] = ratio * (first * known[0] + (pin ? second * known[1] : 0));
  }
}

/* What the unknowns weigh, into w->reactions.weight: friction so much more than normal reactions
 * that rest is not lost for want of it. Elements side by side that values bound share a load in
 * proportion to their bounds, so that they reach them together: sum of lam^2 g / bound is least,
 * where g, the size of the row, makes a gear between them count. */
static void weigh(const problem *p) {
  frot_work *w = p->w;
  double largest = 0;
  for (int c = 0; c < p->unknowns; c++) {
    w->reactions.weight[c] = 1;
    if (c >= p->held || w->reactions.friction[c] < 2) continue;
    double size =
        sqrt(fabs(frot_effect(p->m, w, w->reactions.unknown[c], w->reactions.unknown[c])));
    w->reactions.weight[c] =
        size > 0 ? sqrt(w->core.coefficient[2 * w->reactions.owner[c] + 1] / size) : 1;
    largest = fmax(largest, w->reactions.weight[c]);
  }
  for (int c = 0; c < p->held; c++) {
    if (w->reactions.friction[c] == 0) continue;
    if (w->reactions.friction[c] == 2 && largest > 0) w->reactions.weight[c] /= largest;
    w->reactions.weight[c] *= FROT_FRICTION_WEIGHT;
  }
}

/* Least reactions, in units w->reactions.unit_of, of the system that w->linear.matrix holds. Solved
 * twice: the second time for what the first left, so that the weights cost no digits. */
static void solve_least(const problem *p, double *x) {
  frot_work *w = p->w;
  int n = p->unknowns, rows = p->equations;
  double *copy = w->linear.scratch, *b = copy + n * n, *step = b + n, *scratch = step + n;
  weigh(p);
  memset(x, 0, sizeof(double) * (size_t)n);
  for (int pass = 0; pass < 2; pass++) {
    for (int r = 0; r < rows; r++) {
      double largest = 0, rest = w->linear.right[r];
      for (int c = 0; c < n; c++) {
        double weighed =
            w->linear.matrix[c * n + r] / w->reactions.unit_of[c] * w->reactions.weight[c];
        copy[c * rows + r] = weighed, largest = fmax(largest, fabs(weighed));
        rest -= w->linear.matrix[c * n + r] * x[c];
      }
      double scale = largest > 0 ? 1 / largest : 1;
      for (int c = 0; c < n; c++) copy[c * rows + r] *= scale;
      b[r] = rest * scale;
    }
    frot_least_norm(copy, b, rows, n, step, scratch, w->linear.pivot);
    for (int c = 0; c < n; c++) x[c] += step[c] * w->reactions.weight[c] / w->reactions.unit_of[c];
  }
}

double frot_size_of_motion(const frot_model *m, const frot_work *w, const frot_group *g) {
  int count = g->general ? g->n : g->n_speeds;
  const double *force = w->core.force + g->vector;
  double motion = sqrt(frot_dot(force, force, count));
  for (int i = 0; i < g->n_rows; i++) {
    const double *half = w->core.half + g->entries + i * g->n;
    double lam = w->core.lam[g->rows[i]];
    if (lam == 0 || frot_is_reading(m, g->rows[i])) continue;
    motion += fabs(lam) * sqrt(frot_dot(half, half, count));
  }
  return motion;
}

double frot_row_rounding(const frot_model *m, const frot_work *w, int row) {
  const frot_group *g = frot_group_of(m, row);
  int count = g->general ? g->n : g->n_speeds;
  const double *own = frot_entries(m, g->general ? w->core.rows : w->core.half, row);
  return 4 * FROT_ROUNDING * sqrt(frot_dot(own, own, count)) * frot_size_of_motion(m, w, g);
}

/* Whether the held rows do not accelerate and friction follows its reaction. */
static int is_solution(const problem *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  for (int k = 0; k < p->unknowns; k++) {
    double size, value, rounding = 0;
    if (k < p->held && frot_is_spare(w, w->reactions.unknown[k])) continue;
    if (k < p->held) {
      value = frot_acceleration(m, w, w->reactions.unknown[k], &size);
      size += frot_free_size(m, w, w->reactions.unknown[k]);
      rounding = frot_row_rounding(m, w, w->reactions.unknown[k]);
    } else {
      const frot_element *element = &m->elements[w->reactions.owner[k]];
      double along[2] = {1, 0}, bounding = 0;
      if (element->bound == FROT_BY_PIN)
        memcpy(along, w->reactions.along + 2 * w->reactions.owner[k], sizeof along);
      double ratio = w->reactions.ratio[w->reactions.owner[k]], terms = 0;
      for (int i = 0; i < 2; i++) {
        int reading = element->bounded_by[i];
        if (reading < 0) continue;
        bounding += along[i] * w->core.lam[reading];
        if (!frot_is_reading(m, reading)) continue;
        frot_acceleration(m, w, reading, &size);
        terms += size + frot_free_size(m, w, reading);
      }
      value = w->core.lam[element->row] - ratio * bounding;
      size = fabs(w->core.lam[element->row]) + fabs(value) + fabs(ratio) * terms;
    }
    if (!(fabs(value) <= FROT_AGREES * size + rounding)) return 0;
  }
  return 1;
}

/* All reactions of the group from those of the unknowns. */
static void spread_reactions(const problem *p, const double *x) {
  const frot_model *m = p->m;
  const frot_group *g = p->g;
  frot_work *w = p->w;
  for (int i = 0; i < g->n_rows; i++) w->core.lam[g->rows[i]] = 0;
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    if (m->elements[e].bound == FROT_BY_VALUE && w->reactions.ratio[e] != 0)
      w->core.lam[m->elements[e].row] = w->reactions.ratio[e];
  }
  for (int c = 0; c < p->unknowns; c++) {
    double lam = x[c] * w->reactions.unit_of[c];
    w->core.lam[w->reactions.unknown[c]] = lam;
    for (int k = 2 * c; k < 2 * c + 2; k++)
      if (w->reactions.fold[k] >= 0)
        w->core.lam[w->reactions.fold[k]] = w->reactions.fold_ratio[k] * lam;
  }
  for (int i = 0; i < g->n_rows; i++) {
    int r = g->rows[i];
    double size;
    if (frot_is_reading(m, r) && w->core.wanted[r])
      w->core.lam[r] = frot_acceleration(m, w, r, &size);
  }
}

static int group_is_finite(const problem *p) {
  for (int i = 0; i < p->g->n_rows; i++)
    if (!isfinite(p->w->core.lam[p->g->rows[i]])) return 0;
  return 1;
}

/* Solve once in the directions w->reactions.along; *regular: whether one solution was all there is,
 * the reactions are then not yet spread. */
static int solve(problem *p, int *regular) {
  frot_work *w = p->w;
  int n = p->unknowns;
  double *x = w->reactions.solution;
  follow_readings(p);
  *regular = p->equations == n;
  if (*regular) {
    memcpy(w->linear.scratch, w->linear.matrix, sizeof(double) * (size_t)(n * n));
    memcpy(x, w->linear.right, sizeof(double) * (size_t)n);
    *regular = !frot_lu_solve(w->linear.scratch, x, n, &w->reactions.sign[p->g - p->m->groups]);
  }
  if (*regular) return 0;
  w->reactions.dependent = 1, w->reactions.sign[p->g - p->m->groups] = 0;
  solve_least(p, x);
  spread_reactions(p, x);
  return !group_is_finite(p) || !is_solution(p);
}

/* Turn the directions of the pins whose friction follows to their reactions. Returns the largest
 * part of a reaction that the directions before missed. */
static double turn_pins(const problem *p) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  int n = p->unknowns;
  double missed = 0;
  const double *known = w->reactions.known, *effects = w->reactions.effects;
  for (int f = p->held; f < n; f++, known += 2, effects += 2 * n) {
    int e = w->reactions.owner[f];
    if (m->elements[e].bound != FROT_BY_PIN) continue;
    double *along = w->reactions.along + 2 * e, first = known[0], second = known[1];
    for (int c = 0; c < n; c++) {
      first += effects[c] * w->reactions.solution[c];
      second += effects[n + c] * w->reactions.solution[c];
    }
    double size = hypot(first, second), before = along[0] * first + along[1] * second;
    if (!(size > 0)) continue;
    missed = fmax(missed, (size - before) / size);
    along[0] = first / size, along[1] = second / size;
  }
  return missed;
}

int frot_group_reactions(const frot_model *m, frot_work *w, const frot_group *g,
                         const frot_contact_mode *modes, const unsigned char *at_rest) {
  problem p = {m, w, g, modes, 0, 0, 0, 0};
  w->reactions.dependent = w->reactions.sign[g - m->groups] = 0;
  if (g->n_rows == 0) return 0;
  list_unknowns(&p, at_rest);
  int pins = 0, regular = 0;
  for (int f = p.held; f < p.unknowns; f++)
    pins |= m->elements[w->reactions.owner[f]].bound == FROT_BY_PIN;
  w->span.rank = 0;
  if (p.unknowns == 0) return spread_reactions(&p, w->reactions.solution), !group_is_finite(&p);
  if (hold_rows(&p)) return 1;
  if (p.equations > p.unknowns) return 1; /* no reaction is left for a row that is to be kept */
  p.holding = p.equations;
  read_bounds(&p);
  for (int pass = 0, last = 0; pass < FROT_PIN_PASSES; pass++) {
    if (solve(&p, &regular)) return 1;
    double missed = pins ? turn_pins(&p) : 0;
    if (last || missed <= 2 * DBL_EPSILON) {
      if (!regular) return 0;
      spread_reactions(&p, w->reactions.solution);
      return !group_is_finite(&p);
    }
    last = missed < FROT_PIN_CLOSE;
  }
  return 1;
}

int frot_reactions(const frot_model *m, frot_work *w, const frot_contact_mode *modes,
                   const unsigned char *at_rest) {
  for (int k = 0; k < w->awake.now->n_groups; k++)
    if (frot_group_reactions(m, w, &m->groups[w->awake.now->groups[k]], modes, at_rest)) return 1;
  return 0;
}
