/* Modes of a component with slips of several components, by Newton's method (contact_newton.h).
 *
 * The static coefficient holds what rests; what departs has the coefficient of motion, and the
 * others are found again with it. Where both are the same, a rest that ends at its bound departs
 * without an acceleration: the motion a short time later says what departs, and where to. */
#include "modes/departures.h"

#include <math.h>
#include <string.h>

#include "contact/contact_springs.h"
#include "evaluation/evaluate.h"
#include "evaluation/slip_frames.h"
#include "numerics/dense.h"
#include "reactions/contact_blocks.h"
#include "reactions/equal_springs.h"
#include "reactions/reactions.h"

#define TOLERANCE 1e-12
#define SWEEPS 30
#define MANY_SWEEPS 400
/* Part of the accelerations of its terms from which on what departs moves, and part of its bound
 * by which a reaction at it may miss it. */
#define MOVES 1e-9
/* Part of its terms below which the acceleration of a contact is none. */
#define ROUNDING 1e-13
/* The time after which the beginnings of motions are distinguished, as a part of the usual step,
 * and that as a part of the longest step at least. */
#define LATER 1e-3
#define USUAL 0.1

typedef struct {
  const frot_instant *in;
  const int *chosen;
  int count;
  frot_block_list list; /* of in->w->search */
  int springs;          /* redundant normal reactions are those of equal springs */
} search;

int frot_slips_in_space(const frot_instant *in, const int *chosen, int count) {
  for (int c = 0; c < count && in->w->core.frame; c++)
    for (int e = 0; e < in->m->n_elements; e++)
      if (in->m->elements[e].contact == chosen[c] && frot_is_vector(in->m, e)) return 1;
  return 0;
}

void frot_begin_slips_in_space(const frot_instant *in) {
  const frot_model *m = in->m;
  for (int e = 0; e < m->n_elements && in->w->core.frame; e++) {
    if (m->elements[e].parts == 1) continue;
    int acts =
        in->w->search.best[m->elements[e].contact].closed && frot_bounds_something(m, in->w, e);
    int slides = m->elements[e].part == 0 ? FROT_SLIP_FORWARD : FROT_NONE;
    frot_contact_mode *mode = &in->w->search.best[m->n_contacts + e];
    *mode = (frot_contact_mode){0};
    mode->friction = (signed char)(!acts ? FROT_NONE : in->zero[e] ? FROT_STICK : slides);
  }
}

/* The blocks added from the k-th on belong to no element, the last one to e. */
static void own_blocks(const search *p, int k, int e) {
  for (; k < p->list.n_blocks; k++) p->in->w->search.block_of[k] = -1;
  p->in->w->search.block_of[k - 1] = e;
}

static void list_blocks(search *p) {
  const frot_instant *in = p->in;
  const frot_model *m = in->m;
  for (int c = 0; c < p->count; c++) {
    int i = p->chosen[c], normal = -1;
    const frot_contact *contact = &m->contacts[i];
    if (!in->w->search.best[i].closed) continue;
    if (contact->row_n >= 0) {
      normal = frot_list_row(&p->list, contact->row_n);
      int rule = contact->reduced         ? FROT_ROW_READS
                 : in->unilateral[i] != 0 ? FROT_ROW_PRESSES
                                          : FROT_ROW_HELD;
      frot_list_block(&p->list, rule, normal, 1);
      own_blocks(p, p->list.n_blocks - 1, -1);
    }
    for (int e = 0; e < m->n_elements; e++) {
      int from = p->list.n_blocks;
      if (m->elements[e].contact != i || m->elements[e].part > 0 ||
          !frot_bounds_something(m, in->w, e))
        continue;
      frot_list_element(m, in->w, &p->list, e, normal, !in->zero[e]);
      own_blocks(p, from, e);
    }
  }
}

/* The equations in own->problem; scratch of Newton's method follows their sizes of terms. */
static frot_contact_equations equations_of(const search *p) {
  frot_search_work *own = &p->in->w->search;
  int n = p->list.rows;
  double *b = own->problem + n * n;
  return (frot_contact_equations){n,           p->list.n_blocks, own->problem, b,
                                  own->blocks, TOLERANCE,        b + n};
}

/* Where Newton's method finds no solution from zero it begins at that of contacts that give. */
static int solve_from_zero(const search *p, double *x, double *a) {
  const frot_instant *in = p->in;
  frot_search_work *own = &in->w->search;
  int n = p->list.rows;
  double *w = own->problem, *b = w + n * n, *terms = b + n, *doubles = terms + n;
  for (int i = 0; i < n; i++) {
    b[i] = in->w->core.free[own->row_of[i]];
    terms[i] = fmax(fabs(b[i]), in->w->core.row_load[own->row_of[i]]);
  }
  frot_list_effects(in->m, in->w, &p->list, w);
  frot_contact_equations equations = equations_of(p);
  for (int sweeps = SWEEPS; sweeps <= MANY_SWEEPS; sweeps += MANY_SWEEPS - SWEEPS) {
    memset(x, 0, sizeof(double) * (size_t)n);
    if (!frot_contact_newton(&equations, sweeps, x, a, doubles, own->pivot)) return 0;
  }
  frot_soften(&equations, FROT_GIVE, 1, w);
  memset(x, 0, sizeof(double) * (size_t)n);
  equations.tolerance = FROT_GIVE_TOLERANCE;
  frot_contact_newton(&equations, SWEEPS, x, a, doubles, own->pivot);
  frot_list_effects(in->m, in->w, &p->list, w);
  equations.tolerance = TOLERANCE;
  return frot_contact_newton(&equations, 0, x, a, doubles, own->pivot);
}

static int solve(const search *p, double *x, double *a) {
  if (solve_from_zero(p, x, a)) return 1;
  frot_contact_equations equations = equations_of(p);
  double *doubles = p->in->w->search.problem + p->list.rows * (p->list.rows + 2);
  return p->springs && frot_contact_springs(&equations, x, a, doubles, p->in->w->search.pivot);
}

/* Length of the part of a block in x. */
static double length_in(const frot_contact_block *one, const double *x) {
  return frot_length(x + one->at, one->n);
}

/* Whether the reaction of a block that may rest has reached its bound. Within it nothing moves. */
static int is_at_bound(const frot_contact_block *one, const double *x) {
  return length_in(one, x) >= (1 - MOVES) * frot_contact_bound(one, x);
}

/* Whether a block begins to move: its reaction is at its bound, and what its loads and reactions
 * bring it is more than rounding of them. */
static int departs(const search *p, const frot_contact_block *one, const double *x,
                   const double *a) {
  const double *w = p->in->w->search.problem, *b = w + p->list.rows * p->list.rows;
  double size = 0;
  if (one->rule != FROT_ROW_BALL || !is_at_bound(one, x)) return 0;
  for (int i = one->at; i < one->at + one->n; i++) {
    size += fabs(b[i]);
    for (int j = 0; j < p->list.rows; j++) size += fabs(w[i * p->list.rows + j] * x[j]);
  }
  return length_in(one, a) > MOVES * size;
}

/* Whether the reactions in which a group rested have ended at this instant, which no guard located.
 */
static int has_ended(const search *p) {
  const frot_state *s = p->in->s;
  return s->jammed_at == p->in->t && s->jammed == p->in->m->contact_group[p->chosen[0]];
}

/* The contact whose normal is row `at`, or n_contacts. */
static int contact_at(const search *p, int at) {
  const frot_model *m = p->in->m;
  int i = 0;
  while (i < m->n_contacts && m->contacts[i].row_n != p->in->w->search.row_of[at]) i++;
  return i;
}

/* Whether a contact that was open before the instant neither parts nor presses now, but for
 * rounding: it has opened at this instant, and other loads follow. */
static int is_undecided(const search *p, const frot_contact_block *one, const double *x,
                        const double *a) {
  const frot_instant *in = p->in;
  const double *w = in->w->search.problem + one->at * p->list.rows;
  if (one->rule != FROT_ROW_PRESSES) return 0;
  if (in->w->search.before[contact_at(p, one->at)].closed) return 0;
  double size = 0;
  for (int j = 0; j < p->list.rows; j++) size += fabs(w[j] * x[j]);
  return fabs(w[one->at] * x[one->at]) + fabs(a[one->at]) <= MOVES * size;
}

/* Give what departs the coefficient of motion. Returns whether anything is another now; *ended:
 * whether a rest has ended at its bound without an acceleration, a reaction has come to zero, or an
 * opening is undecided. */
static int change_departed(const search *p, const double *x, const double *a, int *ended) {
  const frot_instant *in = p->in;
  int changed = 0;
  *ended = has_ended(p);
  for (int c = 0; c < p->count; c++)
    *ended |= in->fired[p->chosen[c]] != 0 && in->w->search.before[p->chosen[c]].closed;
  for (int k = 0; k < p->list.n_blocks; k++) {
    frot_contact_block *one = &in->w->search.blocks[k];
    int e = in->w->search.block_of[k];
    *ended |= is_undecided(p, one, x, a);
    if (e < 0 || one->rule != FROT_ROW_BALL) continue;
    const double *coefficient = in->w->core.coefficient + 2 * e;
    int rested = frot_element_mode(in->m, in->w->search.before, e)->friction == FROT_STICK;
    int fired = rested && in->fired[frot_element_guard(in->m, e)] != 0;
    int moves = departs(p, one, x, a);
    if ((moves || fired) && one->ratio != coefficient[0]) {
      one->ratio = coefficient[0], changed = 1;
    } else if (fired && !moves) {
      *ended = 1;
    }
  }
  return changed;
}

/* The motion after the time dt, where time and the motion so far have changed the loads. The
 * instant is evaluated again afterwards. Returns 1 where none is found. */
static int solve_after(const search *p, double dt, double *x, double *a) {
  const frot_instant *in = p->in;
  const frot_model *m = in->m;
  frot_work *w = in->w;
  double *q = w->step.z;
  const double *d = in->s->data + in->l.d;
  /* what rests at its bound ends without a jump: accelerations are those up to the instant */
  const double *slope = in->s->data + in->l.slope + m->nq;
  double begun = in->s->statistics.steps > 0;
  for (int k = 0; k < m->nq; k++) q[k] = in->q[k] + dt * w->core.qd[k];
  for (int k = 0; k < m->nv; k++) q[m->nq + k] = in->v[k] + begun * dt * slope[k];
  int status = frot_dynamics(m, in->s, w, in->t + dt, q, q + m->nq, d, w->search.best, FROT_LAWS);
  int failed = status != FROT_OK || solve(p, x, a);
  status = frot_dynamics(m, in->s, w, in->t, in->q, in->v, d, w->search.best, FROT_LAWS);
  return failed || status != FROT_OK;
}

/* a <- for each block that begins to move, a direction in which it does so at the instant: from
 * those after half the time and after the whole, `half` and a. */
static void extrapolate(const search *p, const double *half, double *a) {
  for (int k = 0; k < p->list.n_blocks; k++) {
    const frot_contact_block *one = &p->in->w->search.blocks[k];
    double first = length_in(one, half), second = length_in(one, a);
    if (one->rule != FROT_ROW_BALL || one->n == 1 || !(first > 0) || !(second > 0)) continue;
    for (int i = one->at; i < one->at + one->n; i++)
      a[i] = second * (2 * half[i] / first - a[i] / second);
  }
}

/* The motion a short time later, which tells apart what begins without acceleration; directions are
 * those at the instant. Returns 1 where none is found. */
static int solve_later(const search *p, double *x, double *a) {
  const frot_state *s = p->in->s;
  double dt = LATER * fmax(fmax(s->calm, s->h), USUAL * s->h_max);
  double *half = a + p->in->m->n_rows;
  if (solve_after(p, dt / 2, x, half) || solve_after(p, dt, x, a)) return 1;
  extrapolate(p, half, a);
  return 0;
}

/* Whether a contact whose row is `at` opens, as the natural map decides; of redundant ones, one
 * that neither parts nor presses, but for rounding, is held by others. */
static int opens(const search *p, int at, const double *x, const double *a) {
  const double *w = p->in->w->search.problem + at * p->list.rows;
  double size = 0;
  for (int j = 0; j < p->list.rows && p->springs; j++) size += fabs(w[j] * x[j]);
  return a[at] - w[at] * x[at] > ROUNDING * size;
}

static void set_contact(const search *p, int at, int i, const double *x, const double *a) {
  frot_contact_mode *mode = &p->in->w->search.best[i];
  int part = p->in->unilateral[i] != 0 && !p->in->m->contacts[i].reduced;
  if (part && opens(p, at, x, a)) {
    frot_open(p->in->m, p->in->w->search.best, i);
    return;
  }
  int side = part || x[at] >= 0 ? 1 : -1;
  *mode = (frot_contact_mode){.closed = 1, .side = (signed char)side};
}

/* The modes and directions that the solution says, into w->search.best and the state's
 * `heading`. */
static void set_modes(const search *p, const double *x, const double *a) {
  const frot_instant *in = p->in;
  const frot_model *m = in->m;
  frot_contact_mode *best = in->w->search.best;
  for (int k = 0; k < p->list.n_blocks; k++) {
    const frot_contact_block *one = &in->w->search.blocks[k];
    int e = in->w->search.block_of[k], i = e < 0 ? contact_at(p, one->at) : m->n_contacts;
    if (i < m->n_contacts) set_contact(p, one->at, i, x, a);
    if (e < 0 || !best[m->elements[e].contact].closed) continue;
    int parts = m->elements[e].parts, moves = departs(p, one, x, a);
    double size = length_in(one, a), *heading = in->s->data + in->l.heading + e;
    for (int i = 0; i < parts && moves; i++) {
      double d = a[one->at + i] / size;
      if (parts > 1) heading[i] = d;
      best[m->n_contacts + e + i] =
          (frot_contact_mode){.friction = i > 0                ? FROT_NONE
                                          : parts > 1 || d > 0 ? FROT_SLIP_FORWARD
                                                               : FROT_SLIP_BACKWARD,
                              .starts = i == 0 && parts > 1};
    }
    in->s->data[in->l.slip + e] = in->zero[e] ? 0 : in->w->core.rate[m->elements[e].row];
    const double *frame = in->w->core.frame + FROT_MOST_PARTS * FROT_MOST_PARTS * e;
    for (int i = 0; i < parts && parts > 1 && !in->zero[e]; i++) heading[i] = frame[i];
    if (parts == 1 && !in->zero[e])
      best[m->n_contacts + e] =
          (frot_contact_mode){.friction = one->d[0] > 0 ? FROT_SLIP_FORWARD : FROT_SLIP_BACKWARD};
    for (int i = 0; i < parts && !moves && in->zero[e]; i++)
      best[m->n_contacts + e + i] = (frot_contact_mode){.friction = FROT_STICK};
  }
}

/* The block of the slip that a contact bounds, whose row is `at`, or NULL. */
static const frot_contact_block *slip_at(const search *p, int at) {
  for (int k = 0; k < p->list.n_blocks; k++) {
    const frot_contact_block *one = &p->in->w->search.blocks[k];
    if (one->rule == FROT_ROW_SLIDES && one->n_bounding == 1 && one->bounding == at) return one;
  }
  return NULL;
}

/* Where a contact opens whose slip presses it (p < 0) it may stay closed as well, with the reaction
 * -a/p (P. Painleve 1895): that motion, into `pressed` and `closed`. Returns its contact, or -1. */
static int find_pressed(const search *p, const double *x, const double *a, double *pressed,
                        double *closed) {
  frot_search_work *own = &p->in->w->search;
  int n = p->list.rows;
  double *w = own->problem, *doubles = w + n * (n + 2);
  frot_contact_equations equations = equations_of(p);
  for (int k = 0; k < p->list.n_blocks; k++) {
    int at = own->blocks[k].at;
    const frot_contact_block *slip = slip_at(p, at);
    if (own->blocks[k].rule != FROT_ROW_PRESSES || !slip || !opens(p, at, x, a)) continue;
    double painleve = w[at * n + at] - slip->ratio * slip->d[0] * w[at * n + slip->at];
    if (!(painleve < 0)) continue;
    memcpy(pressed, x, sizeof(double) * (size_t)n);
    pressed[at] = -a[at] / painleve, pressed[slip->at] = -slip->ratio * slip->d[0] * pressed[at];
    if (frot_contact_newton(&equations, 0, pressed, closed, doubles, own->pivot)) continue;
    if (pressed[at] > 0) return contact_at(p, at);
  }
  return -1;
}

/* Mark the reactions of contacts and of elements at rest as not determined. */
static void share_all(const search *p) {
  const frot_model *m = p->in->m;
  frot_contact_mode *best = p->in->w->search.best;
  for (int c = 0; c < p->count; c++) {
    if (!best[p->chosen[c]].closed) continue;
    best[p->chosen[c]].shared = 1;
    for (int e = 0; e < m->n_elements; e++)
      if (m->elements[e].contact == p->chosen[c] && best[m->n_contacts + e].friction == FROT_STICK)
        best[m->n_contacts + e].shared = 1;
  }
}

/* Whether a law of the contacts chosen slides in w->search.best. */
static int slides(const search *p) {
  const frot_model *m = p->in->m;
  for (int c = 0; c < p->count; c++)
    for (int e = 0; e < m->n_elements; e++)
      if (m->elements[e].contact == p->chosen[c] &&
          frot_element_mode(m, p->in->w->search.best, e)->friction > FROT_STICK)
        return 1;
  return 0;
}

/* The modes of a motion into w->search.best. Returns the number of motions. */
static int find_motion(search *p, int springs) {
  const frot_instant *in = p->in;
  double *x = in->w->search.reactions_found, *a = x + in->m->n_rows;
  p->list.rows = p->list.n_blocks = 0, p->springs = springs;
  list_blocks(p);
  int rounds = p->list.n_blocks + 1, ended;
  do {
    if (solve(p, x, a)) return 0;
  } while (change_departed(p, x, a, &ended) && --rounds > 0);
  if (ended && solve_later(p, x, a)) return 0;
  double *pressed = a + in->m->n_rows, *closed = pressed + in->m->n_rows;
  int other = find_pressed(p, x, a, pressed, closed);
  if (other >= 0 && in->w->search.before[other].closed) x = pressed, a = closed;
  set_modes(p, x, a);
  return other < 0 ? 1 : 2;
}

int frot_find_contact_motion(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  frot_search_work *own = &in->w->search;
  const frot_group *g = &m->groups[m->contact_group[chosen[0]]];
  search p = {in, chosen, count, {own->blocks, own->row_of, 0, 0}, 0};
  size_t modes = sizeof *own->best * (size_t)(m->n_contacts + m->n_elements);
  memcpy(own->corner, own->best, modes);
  own->lasts = 1;
  int motions = find_motion(&p, 0);
  if (motions && slides(&p) && frot_springs_are_redundant(m, in->w, g, own->corner)) {
    memcpy(own->best, own->corner, modes);
    motions = find_motion(&p, 1);
  }
  if (!motions || frot_group_reactions(m, in->w, g, own->best, NULL)) return 0;
  if (in->w->reactions.dependent) share_all(&p);
  return motions;
}
