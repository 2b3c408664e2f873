/* How a load is shared among more rests than it needs.
 *
 * A contact at rest carries any sum of the edges of its cone, each times a number that is not
 * negative: of a coefficient mu the reactions (1, mu) and (1, -mu). Where it has two laws, the
 * edges (1, mu, 0), (1, -mu, 0) of the one and (0, 0, delta), (0, 0, -delta) of the other, with one
 * more row by which there is as much of these as of those. Whether such sums hold all rows that are
 * held is a linear program, solved here by the first phase of the simplex method on a dense tableau
 * (G. Dantzig, Linear Programming and Extensions, 1963, ch. 5; R. Bland's rule against circles,
 * Math. of Operations Research 2, 1977). Its basic solutions have as many edges as rows: a contact
 * with both edges is free inside its cone, one with a single edge is at its bound, one with none
 * carries nothing. These are modes with unique reactions, which last until an edge comes to zero;
 * then another basic solution is looked for, and where there is none the rest ends.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "numerics/dense.h"
#include "reactions/equal_springs.h"
#include "reactions/reactions.h"
#include "reactions/switching_functions.h"
#include "modes/mode_options.h"
#include "modes/enumeration.h"
#include "numerics/tolerances.h"

#define ROUNDS 50   /* pivots, in rows and columns together, after which the search is given up */
#define EAGER 5     /* in the same measure, pivots before Bland's rule */
#define LEAST 1e-9  /* pivot, of columns of length one */
#define GAIN 1e-11  /* decrease by a column below which it brings nothing */
#define HOLDS 1e-12 /* part of the load that may be left */
#define AHEAD 5e-12 /* part of the load by which it has grown where a rest is to go on */
#define LATER 1e-4  /* steps after which loads are looked at again */
#define ALONE (-1)  /* of a column that is no edge: its row has a reaction of either sign */

/* Column j < columns of the tableau belongs to an edge of `contact`, or to a row of its own: that
 * of its law i in the direction s, 1 for backward, is edge 2 i + s. The first `held` rows are those
 * that hold, the others those of contacts with two laws. Row r has the basic column basic[r],
 * columns + r while that is what is left of it. */
typedef struct {
  const frot_instant *in;
  const frot_group *g;
  frot_share_work *share;
  int held, rows, columns;
} program;

static double *entry(const program *p, int r, int j) {
  return p->share->tableau + r * (p->columns + 1) + j;
}

/* Stuck laws of a contact that its own normal bounds, into e[]; returns how many. */
static int laws_of(const frot_instant *in, int contact, int e[2]) {
  const frot_model *m = in->m;
  int n = 0;
  for (int k = 0; k < m->n_elements && n < 2; k++)
    if (m->elements[k].contact == contact && m->elements[k].bound == FROT_BY_NORMAL &&
        frot_is_held(m, in->w->search.trial, k))
      e[n++] = k;
  return n;
}

/* Whether the reactions of a contact are sums of edges. */
static int has_cone(const frot_instant *in, int contact) {
  return frot_is_loaded(in->m, in->w->search.trial, contact) && frot_must_press(in, contact);
}

/* One more column: what the reaction x (n_speeds) does to the rows that hold, and `balance` of it
 * to the row of its contact, of length one. */
static void add_column(program *p, const double *x, int contact, int edge, double balance,
                       int row) {
  const frot_work *w = p->in->w;
  int ns = p->g->n_speeds, j = p->columns++;
  double length = fmax(frot_length(x, ns), row < 0 ? 0 : fabs(balance));
  double unit = length > 0 ? 1 / length : 0;
  double *column = p->share->columns + j * p->rows;
  for (int r = 0; r < p->rows; r++)
    column[r] = r < p->held ? unit * frot_dot(w->span.basis + ns * r, x, ns)
                : r == row  ? unit * balance
                            : 0;
  p->share->contact[j] = contact, p->share->edge[j] = (signed char)edge;
}

/* x (n_speeds) <- x + part of what the reaction of a row does. */
static void add_reaction(const program *p, int row, double part, double *x) {
  const double *half = frot_entries(p->in->m, p->in->w->core.half, row);
  for (int i = 0; part != 0 && i < p->g->n_speeds; i++) x[i] += part * half[i];
}

/* The edges of a contact: its normal, the friction of what slips on it, and that of its stuck laws
 * in one direction or the other. `row` is that of a contact with two laws. */
static void add_edges(program *p, int contact, int row) {
  const frot_instant *in = p->in;
  const frot_model *m = in->m;
  const frot_work *w = in->w;
  int e[2], laws = laws_of(in, contact, e), side = w->search.trial[contact].side;
  size_t size = sizeof(double) * (size_t)p->g->n_speeds;
  double *normal = p->share->normal, *x = w->core.rest, length;
  memset(normal, 0, size);
  add_reaction(p, m->contacts[contact].row_n, side, normal);
  for (int k = 0; k < m->n_elements; k++)
    if (m->elements[k].contact == contact && m->elements[k].bound == FROT_BY_NORMAL)
      add_reaction(p, m->elements[k].row, side * w->reactions.ratio[k], normal);
  length = sqrt(frot_dot(normal, normal, p->g->n_speeds));
  for (int i = 0; i < (laws > 0 ? laws : 1); i++)
    for (int s = 0; s < (laws > 0 ? 2 : 1); s++) {
      memset(x, 0, size);
      if (i == 0) memcpy(x, normal, size);
      if (laws > 0)
        add_reaction(p, m->elements[e[i]].row, (s ? -1 : 1) * w->core.coefficient[2 * e[i] + 1], x);
      add_column(p, x, contact, 2 * i + s, i == 0 ? length : -length, row);
    }
}

/* A reaction of either sign: two columns. */
static void add_free(program *p, int row) {
  const frot_work *w = p->in->w;
  double *x = w->core.rest;
  for (int sign = 1; sign >= -1; sign -= 2) {
    const double *half = frot_entries(p->in->m, w->core.half, row);
    for (int i = 0; i < p->g->n_speeds; i++) x[i] = sign * half[i];
    add_column(p, x, ALONE, 0, 0, -1);
  }
}

/* All columns. Returns 0 where friction is bounded by what no edge says: by a value, by the size of
 * a pin's reaction or of one that may pull. */
static int add_columns(program *p) {
  const frot_instant *in = p->in;
  const frot_model *m = in->m;
  const frot_contact_mode *trial = in->w->search.trial;
  int row = p->held, e[2];
  for (int i = 0; i < p->g->n_contacts; i++) {
    int contact = p->g->contacts[i];
    if (has_cone(in, contact))
      add_edges(p, contact, laws_of(in, contact, e) == 2 ? row++ : -1);
    else if (frot_is_loaded(m, trial, contact))
      add_free(p, m->contacts[contact].row_n);
  }
  for (int i = 0; i < p->g->n_elements; i++) {
    int own = p->g->elements[i];
    const frot_element *element = &m->elements[own];
    int edge = element->bound == FROT_BY_NORMAL && has_cone(in, element->contact);
    if (!edge && (frot_is_held(m, trial, own) || in->w->reactions.ratio[own] != 0)) return 0;
  }
  return 1;
}

/* The load on the rows that hold, as they are to take it, into the last column; where the group
 * rests, a little later, unless its growth moves all alike and leaves rounding in them. Rows whose
 * load is negative change sign. */
static void add_load(program *p) {
  const frot_instant *in = p->in;
  const frot_work *w = in->w;
  int ns = p->g->n_speeds, n = p->columns;
  const double *growth = w->share.growth + p->g->vector, *force = w->core.force + p->g->vector;
  double largest = 0, grows = 0;
  double none = FROT_AGREES * frot_length(growth, ns) + FROT_ROUNDING * frot_length(force, ns);
  for (int r = 0; r < p->held; r++) {
    const double *q = w->span.basis + ns * r;
    double load = -frot_dot(q, force, ns) - w->span.bias[r];
    largest = fmax(largest, fabs(load));
    grows = fmax(grows, fabs(frot_dot(q, growth, ns)));
    *entry(p, r, n) = load;
  }
  double part = grows > none ? AHEAD * largest / grows : 0, unit = largest > 0 ? 1 / largest : 0;
  for (int r = 0; r < p->rows; r++) {
    const double *q = w->span.basis + ns * r;
    double load = r < p->held ? unit * (*entry(p, r, n) - part * frot_dot(q, growth, ns)) : 0;
    double sign = load < 0 ? -1 : 1;
    for (int j = 0; j < n; j++) *entry(p, r, j) = sign * w->share.columns[j * p->rows + r];
    *entry(p, r, n) = sign * load;
    p->share->basic[r] = n + r;
  }
}

/* How much of what is left of the load a unit of column j takes. */
static double gain(const program *p, int j) {
  double sum = 0;
  for (int r = 0; r < p->rows; r++)
    if (p->share->basic[r] >= p->columns) sum += *entry(p, r, j);
  return sum;
}

/* The column that enters, or -1: that of the largest gain or, by Bland, the first with any. */
static int entering(const program *p, int first) {
  int found = -1;
  double most = GAIN;
  for (int j = 0; j < p->columns; j++) {
    double now = gain(p, j);
    if (!(now > most)) continue;
    found = j, most = now;
    if (first) break;
  }
  return found;
}

/* The row that column j leaves as it is: the first whose basic variable comes to zero; of several
 * at once one that is still left of the load, then the one of the first column. */
static int leaving(const program *p, int j) {
  int found = -1;
  double least = INFINITY;
  for (int r = 0; r < p->rows; r++) {
    double a = *entry(p, r, j);
    if (!(a > LEAST)) continue;
    double ratio = *entry(p, r, p->columns) / a;
    int left = p->share->basic[r] >= p->columns;
    int first = found < 0 || ratio < least - DBL_EPSILON;
    int tie = !first && ratio <= least + DBL_EPSILON;
    if (!first && !(tie && (left || p->share->basic[r] < p->share->basic[found]))) continue;
    if (tie && p->share->basic[found] >= p->columns && !left) continue;
    found = r, least = ratio;
  }
  return found;
}

static void exchange(program *p, int row, int column) {
  double pivot = *entry(p, row, column);
  for (int j = 0; j <= p->columns; j++) *entry(p, row, j) /= pivot;
  for (int r = 0; r < p->rows; r++) {
    double factor = *entry(p, r, column);
    if (r == row || factor == 0) continue;
    for (int j = 0; j <= p->columns; j++) *entry(p, r, j) -= factor * *entry(p, row, j);
    *entry(p, r, column) = 0;
  }
  p->share->basic[row] = column;
}

/* Take the load by basic columns. Returns whether it is all taken. */
static int take_load(program *p) {
  int size = p->rows + p->columns;
  for (int round = 0; round < ROUNDS * size; round++) {
    int column = entering(p, round > EAGER * size);
    int row = column < 0 ? -1 : leaving(p, column);
    if (row < 0) break;
    exchange(p, row, column);
  }
  for (int r = 0; r < p->rows; r++) {
    if (p->share->basic[r] < p->columns) continue;
    if (!(fabs(*entry(p, r, p->columns)) <= HOLDS)) return 0;
    /* nothing is left in this row: any column may stand for it */
    int best = -1;
    for (int j = 0; j < p->columns; j++)
      if (best < 0 || fabs(*entry(p, r, j)) > fabs(*entry(p, r, best))) best = j;
    if (best < 0 || !(fabs(*entry(p, r, best)) > LEAST)) return 0;
    exchange(p, r, best);
  }
  return 1;
}

/* The modes of a contact from its basic edges: a law of which one alone is basic is at its bound.
 * There is as much of the edges of one law as of those of the other: of none, none.
 */
static void read_contact(const program *p, int contact) {
  const frot_instant *in = p->in;
  frot_contact_mode *trial = in->w->search.trial;
  int e[2], laws = laws_of(in, contact, e), has[4] = {0, 0, 0, 0};
  for (int r = 0; r < p->rows; r++) {
    int j = p->share->basic[r];
    if (p->share->contact[j] == contact) has[p->share->edge[j]] = 1;
  }
  trial[contact].unloaded = (!has[0] && !has[1]) || (laws == 2 && !has[2] && !has[3]);
  for (int i = 0; i < laws; i++)
    if (!trial[contact].unloaded && has[2 * i] != has[2 * i + 1])
      trial[in->m->n_contacts + e[i]].at_bound = has[2 * i] ? 1 : -1;
}

/* Contacts of a group with two stuck laws that their normals bound. */
static int count_with_two(const program *p) {
  int n = 0, e[2];
  for (int i = 0; i < p->g->n_contacts; i++)
    n += has_cone(p->in, p->g->contacts[i]) && laws_of(p->in, p->g->contacts[i], e) == 2;
  return n;
}

/* The contact among those chosen whose reaction is worst below zero, or the unloaded one whose
 * spring is pressed most; -1. *force: that of the spring. */
static int worst_spring(const frot_instant *in, const int *chosen, int count) {
  const frot_contact_mode *trial = in->w->search.trial;
  double most = FROT_BOUND_SLACK;
  int worst = -1;
  for (int c = 0; c < count; c++) {
    int i = chosen[c];
    double beyond = 0, force;
    if (trial[i].closed && trial[i].unloaded) {
      frot_spring_of_unloaded(in->m, in->w, trial, in->resists, i, &force);
      double size = fabs(force) + frot_reaction_size(in->m, in->w, in->m->contacts[i].row_n);
      beyond = size > 0 ? force / size : 0;
    } else if (frot_is_loaded(in->m, trial, i) && frot_must_press(in, i)) {
      beyond = -frot_pressure(in, i);
    }
    if (beyond > most) most = beyond, worst = i;
  }
  return worst;
}

/* Whether all contacts that bear nothing are springs beside one that slides; then they are marked
 * as such. */
static int are_springs(const frot_instant *in, const int *chosen, int count) {
  frot_contact_mode *trial = in->w->search.trial;
  double force;
  int any = 0;
  for (int c = 0; c < count; c++) {
    int i = chosen[c];
    if (!trial[i].closed || !trial[i].unloaded) continue;
    if (frot_spring_of_unloaded(in->m, in->w, trial, in->resists, i, &force) !=
        FROT_SPRING_BESIDE_SLIDING)
      return 0;
    trial[i].unloaded = FROT_BY_SPRINGS, any = 1;
  }
  return any;
}

/* Whether friction of motion follows the normal of a contact chosen. */
static int any_slides(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  const frot_group *g = &m->groups[m->contact_group[chosen[0]]];
  for (int c = 0; c < count; c++)
    for (int k = 0; k < g->n_elements; k++) {
      int e = g->elements[k];
      if (m->elements[e].contact == chosen[c] && m->elements[e].bound == FROT_BY_NORMAL &&
          in->unilateral[chosen[c]] != 0 &&
          frot_element_mode(m, in->w->search.trial, e)->friction > FROT_STICK)
        return 1;
    }
  return 0;
}

/* Whether springs of which one slides hold the load: those that would be stretched bear nothing,
 * and those that are pressed bear again. */
static int share_by_springs(const frot_instant *in, const int *chosen, int count) {
  frot_contact_mode *trial = in->w->search.trial;
  const frot_group *g = &in->m->groups[in->m->contact_group[chosen[0]]];
  for (int tries = 0; tries <= 2 * count; tries++) {
    if (frot_group_reactions(in->m, in->w, g, trial, in->resists)) return 0;
    int worst = worst_spring(in, chosen, count);
    if (worst < 0) return are_springs(in, chosen, count) && frot_reactions_hold(in, chosen, count);
    trial[worst].unloaded = !trial[worst].unloaded;
  }
  return 0;
}

enum frot_share frot_share_load(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const frot_group *g = &m->groups[m->contact_group[chosen[0]]];
  frot_contact_mode *trial = w->search.trial;
  program p = {in, g, &w->share, 0, 0, 0};
  enum frot_share found = FROT_SHARE_UNKNOWN;
  size_t modes = sizeof *trial * (size_t)(m->n_contacts + m->n_elements);
  memcpy(w->share.before, trial, modes);
  if (any_slides(in, chosen, count)) {
    if (share_by_springs(in, chosen, count)) return FROT_SHARED;
    memcpy(trial, w->share.before, modes);
  }
  for (int c = 0; c < count; c++) trial[chosen[c]].unloaded = 0;
  for (int i = 0; i < g->n_elements; i++) trial[m->n_contacts + g->elements[i]].at_bound = 0;
  if (!g->general && !frot_group_reactions(m, w, g, trial, in->resists)) {
    p.held = w->span.rank, p.rows = p.held + count_with_two(&p);
    if (w->reactions.dependent && p.held > 0 && add_columns(&p)) {
      add_load(&p);
      found = take_load(&p) ? FROT_SHARED : FROT_NO_SHARE;
    }
  }
  if (found == FROT_SHARED) {
    for (int c = 0; c < count; c++) w->share.read[c] = has_cone(in, chosen[c]) != 0;
    for (int c = 0; c < count; c++)
      if (w->share.read[c]) read_contact(&p, chosen[c]);
  } else {
    memcpy(trial, w->share.before, modes);
  }
  if (frot_group_reactions(m, w, g, trial, in->resists)) return FROT_NO_SHARE;
  return found;
}

int frot_find_growth(const frot_instant *in, const double *d) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  double *growth = w->share.growth;
  size_t size = sizeof(double) * (size_t)w->layout.nw;
  memset(growth, 0, size);
  for (int k = 0; k < m->nv; k++)
    if (in->v[k] != 0) return 0;
  double later = LATER * (in->s->calm > 0 ? in->s->calm : in->s->h_max);
  if (!(m->time_dependent || in->s->ramps) || !(later > 0)) return 0;
  memcpy(growth, w->core.force, size);
  int status =
      frot_dynamics(m, in->s, w, in->t + later, in->q, in->v, d, w->search.best, FROT_LAWS);
  for (int k = 0; k < w->layout.nw; k++)
    growth[k] = status == FROT_OK ? w->core.force[k] - growth[k] : 0;
  return 1;
}
