/* With the modes given, each law has one rule: rest, a slip that begins against its friction (the
 * natural map of P. Alart, A. Curnier 1991), or none. What departs is found with the coefficient of
 * rest first, then has that of motion. */
#include "motions/vector_motions.h"

#include <math.h>
#include <string.h>

#include "contact/cone_point.h"
#include "model/indexing.h"
#include "numerics/basis.h"
#include "numerics/dense.h"

#define TOLERANCE 1e-12
#define SWEEPS 30
/* Directions that Newton's method begins from. */
#define STARTS 12
/* Part of its terms by which an inequality may be missed, and below which nothing begins. */
#define MISSED 1e-10
#define MOVES 1e-9
/* Part of their terms by which accelerations of one motion differ. */
#define EQUAL 1e-7
#define RANK 1e-12

static int is_law(const frot_vector_item *item) { return item->element >= 0; }

/* The item of the contact of a law, if it may part, or -1. */
static int contact_of(const frot_vector_problem *p, int item) {
  for (int k = 0; k < p->n_items; k++)
    if (!is_law(&p->items[k]) && p->items[k].contact == p->items[item].contact) return k;
  return -1;
}

static int is_open(const frot_vector_problem *p, const frot_vector_motion *m, int item) {
  int contact = is_law(&p->items[item]) ? contact_of(p, item) : item;
  return contact >= 0 && (m->open >> contact & 1u);
}

/* The rules of the blocks in the modes of a motion, into p->tried. */
static void choose_rules(frot_vector_problem *p, const frot_vector_motion *m) {
  memcpy(p->tried, p->blocks, sizeof *p->blocks * (size_t)p->n_blocks);
  for (int k = 0; k < p->n_items; k++) {
    frot_contact_block *one = &p->tried[p->items[k].block];
    if (is_open(p, m, k)) {
      one->rule = FROT_ROW_ABSENT;
    } else if (is_law(&p->items[k]) && one->rule == FROT_ROW_BALL) {
      int e = p->items[k].element, moves = m->departs >> k & 1u;
      one->ratio = p->one->at->w->core.coefficient[2 * e + !(m->kinetic >> k & 1u)];
      if (!moves) one->rule = FROT_ROW_HELD;
    }
  }
}

static double size_of_row(const frot_vector_problem *p, const double *x, int row) {
  double size = fabs(p->b[row]);
  for (int j = 0; j < p->n; j++) size += fabs(p->w[row * p->n + j] * x[j]);
  return size;
}

/* Whether the inequalities of a motion hold: contacts press or part, what rests is within its
 * bound, and what departs moves against its friction. */
static int is_admissible(const frot_vector_problem *p, const frot_vector_motion *m) {
  double most = frot_length(m->x, p->n);
  for (int k = 0; k < p->n_items; k++) {
    const frot_vector_item *item = &p->items[k];
    const frot_contact_block *one = &p->blocks[item->block];
    double moved = frot_length(m->a + item->at, item->n), size = 0;
    for (int i = 0; i < item->n; i++) size += size_of_row(p, m->x, item->at + i);
    if (!is_law(item)) {
      int open = m->open >> k & 1u;
      /* what neither parts nor presses is closed */
      if (open ? m->a[item->at] <= MISSED * size : m->x[item->at] < -MISSED * most) return 0;
      continue;
    }
    if (is_open(p, m, k) || one->rule != FROT_ROW_BALL) continue;
    if (m->departs >> k & 1u) {
      if (!(moved > MOVES * size)) return 0;
      continue;
    }
    frot_contact_block bound = *one;
    bound.ratio = p->one->at->w->core.coefficient[2 * item->element + 1];
    double rest = frot_contact_bound(&bound, m->x);
    if (frot_length(m->x + item->at, item->n) > rest + MISSED * (rest + most)) return 0;
  }
  return 1;
}

/* Whether two motions have equal accelerations, block by block. */
static int are_equal(const frot_vector_problem *p, const frot_vector_motion *m,
                     const frot_vector_motion *other) {
  for (int k = 0; k < p->n_blocks; k++) {
    double apart = 0, size = 0;
    for (int i = p->blocks[k].at; i < p->blocks[k].at + p->blocks[k].n; i++) {
      apart = hypot(apart, m->a[i] - other->a[i]);
      size += size_of_row(p, m->x, i) + size_of_row(p, other->x, i);
    }
    if (apart > EQUAL * size) return 0;
  }
  return 1;
}

static int is_known(const frot_vector_problem *p, const frot_vector_motion *m) {
  for (int k = 0; k < p->count; k++)
    if (are_equal(p, m, &p->found[k])) return 1;
  return 0;
}

/* Begin with friction against the directions of a start: number k of them turned about. */
static void set_start(const frot_vector_problem *p, const frot_vector_motion *m, int k,
                      const double *first) {
  double whole = 2 * acos(-1.0);
  memcpy(m->x, first, sizeof(double) * (size_t)p->n);
  for (int i = 0; i < p->n_items && k > 0; i++) {
    const frot_vector_item *item = &p->items[i];
    if (!is_law(item) || !(m->departs >> i & 1u)) continue;
    double angle = whole * (k - 1) / STARTS + i,
           bound = frot_contact_bound(&p->tried[item->block], first);
    for (int c = 0; c < item->n; c++) m->x[item->at + c] = 0;
    m->x[item->at] = bound * cos(angle);
    if (item->n > 1) m->x[item->at + 1] = bound * sin(angle);
  }
}

/* Rest whose reactions are not unique: those of least norm within the bounds. Returns 1 where there
 * are none, or something slips, or no unilateral contact bounds the laws. */
static int hold_within_bounds(const frot_vector_problem *p, double *x, double *a, double *scratch) {
  int n = p->n, n_cones = 0, n_balls = 0, cone_of[2 * FROT_MOST_VECTOR_ITEMS];
  frot_cone cones[2 * FROT_MOST_VECTOR_ITEMS];
  frot_ball balls[2 * FROT_MOST_VECTOR_ITEMS];
  double *matrix = scratch, *right = matrix + n * n, *y = right + n;
  for (int k = 0; k < p->n_items; k++) {
    const frot_vector_item *item = &p->items[k];
    const frot_contact_block *one = &p->tried[item->block];
    cone_of[k] = n_cones;
    if (one->rule == FROT_ROW_ABSENT) continue;
    if (one->rule != FROT_ROW_HELD) return 1;
    if (!is_law(item)) {
      cones[n_cones++].at = item->at;
      continue;
    }
    int contact = contact_of(p, k), e = item->element, by_value = one->n_bounding == 0;
    if (contact < 0 && !by_value) return 1;
    balls[n_balls++] = (frot_ball){item->at, item->n, by_value ? -1 : cone_of[contact],
                                   p->one->at->w->core.coefficient[2 * e + 1]};
  }
  for (int k = 0; k < p->n_blocks; k++)
    for (int i = p->tried[k].at; i < p->tried[k].at + p->tried[k].n; i++) {
      int held = p->tried[k].rule == FROT_ROW_HELD;
      if (p->tried[k].rule == FROT_ROW_READS) return 1;
      double length = held ? frot_length(p->w + i * n, n) : 1;
      for (int j = 0; j < n; j++)
        matrix[i * n + j] = held ? (length > 0 ? p->w[i * n + j] / length : 0) : (i == j);
      right[i] = held && length > 0 ? -p->b[i] / length : 0, y[i] = 0;
    }
  frot_cone_problem cone = {.n = n, .rows = n, .n_cones = n_cones, .n_balls = n_balls};
  cone.a = matrix, cone.b = right, cone.cones = cones, cone.balls = balls,
  cone.tolerance = TOLERANCE;
  if (frot_cone_point(&cone, x, y, y + n)) return 1;
  for (int i = 0; i < n; i++) a[i] = p->b[i] + frot_dot(p->w + i * n, x, n);
  return 0;
}

/* Whether friction of motion reads the reactions of several contacts that may part. */
static int slides_on_several(const frot_vector_problem *p, const frot_vector_motion *m) {
  int contacts = 0, slides = 0;
  for (int k = 0; k < p->n_items; k++) {
    if (is_open(p, m, k)) continue;
    contacts += !is_law(&p->items[k]);
    slides |= is_law(&p->items[k]) && p->tried[p->items[k].block].rule != FROT_ROW_HELD;
  }
  return contacts > 1 && slides;
}

/* Of a motion whose reactions are not unique those of equal springs, if they are admissible. */
static void share_by_springs(const frot_vector_problem *p, frot_vector_motion *m) {
  int n = p->n;
  double *x = m->a + n, *a = x + n;
  if (!slides_on_several(p, m)) return;
  for (int k = 0; k < p->n_items; k++)
    if (!is_law(&p->items[k]) && !is_open(p, m, k))
      p->tried[p->items[k].block].rule = FROT_ROW_PRESSES;
  frot_contact_equations equations = {n, p->n_blocks, p->w, p->b, p->tried, TOLERANCE, NULL};
  memcpy(x, m->x, sizeof(double) * (size_t)n);
  frot_vector_motion shared = *m;
  shared.x = x, shared.a = a;
  int failed = frot_contact_springs(&equations, x, a, a + n, p->integers);
  for (int k = 0; k < p->n_items; k++)
    if (p->tried[p->items[k].block].rule == FROT_ROW_PRESSES)
      p->tried[p->items[k].block].rule = FROT_ROW_HELD;
  if (failed || !is_admissible(p, &shared)) return;
  memcpy(m->x, x, sizeof(double) * (size_t)n), memcpy(m->a, a, sizeof(double) * (size_t)n);
}

/* Solve in the modes of a motion from all starts; admissible solutions are added to the list. */
static void try_modes(frot_vector_problem *p, const frot_vector_motion *modes) {
  frot_vector_motion m = *modes;
  double *first = p->scratch;
  m.x = first + p->n, m.a = m.x + p->n;
  memset(first, 0, sizeof(double) * (size_t)p->n);
  choose_rules(p, &m);
  frot_contact_equations equations = {p->n, p->n_blocks, p->w, p->b, p->tried, TOLERANCE, NULL};
  for (int k = 0; k <= (m.departs ? STARTS : 0); k++) {
    set_start(p, &m, k, first);
    if (frot_contact_newton(&equations, k == 0 ? SWEEPS : 0, m.x, m.a, m.a + p->n, p->integers))
      continue;
    if (k == 0) memcpy(first, m.x, sizeof(double) * (size_t)p->n);
    if (!is_admissible(p, &m) && hold_within_bounds(p, m.x, m.a, m.a + p->n)) continue;
    if (!is_admissible(p, &m)) continue;
    share_by_springs(p, &m);
    if (is_known(p, &m)) continue;
    if (p->count == FROT_MOST_VECTOR_MOTIONS) {
      p->complete = 0;
      return;
    }
    frot_vector_motion *kept = &p->found[p->count++];
    double *x = kept->x, *a = kept->a;
    memcpy(x, m.x, sizeof(double) * (size_t)p->n), memcpy(a, m.a, sizeof(double) * (size_t)p->n);
    *kept = m, kept->x = x, kept->a = a;
  }
}

/* Every combination of modes in which what is `forced` departs with the coefficient of motion. */
static void enumerate(frot_vector_problem *p, unsigned forced) {
  for (unsigned modes = 0; modes < 1u << p->n_items; modes++) {
    frot_vector_motion m = {.kinetic = forced};
    int possible = 1;
    for (int k = 0; k < p->n_items; k++) {
      unsigned bit = 1u << k, chosen = modes & bit;
      int rests = is_law(&p->items[k]) && p->blocks[p->items[k].block].rule == FROT_ROW_BALL;
      if (is_law(&p->items[k]) && !rests && chosen) possible = 0;
      if (rests) m.departs |= chosen;
      if (!is_law(&p->items[k])) m.open |= chosen;
    }
    for (int k = 0; k < p->n_items && possible; k++)
      if (is_law(&p->items[k]) && is_open(p, &m, k) && (m.departs >> k & 1u)) possible = 0;
    if (possible && (m.departs & forced) == forced) try_modes(p, &m);
  }
}

/* What departs in a motion with more friction than it will have. */
static unsigned falls_in(const frot_vector_problem *p, const frot_vector_motion *m) {
  unsigned found = 0;
  for (int k = 0; k < p->n_items; k++) {
    if (!is_law(&p->items[k])) continue;
    const double *c = p->one->at->w->core.coefficient + 2 * p->items[k].element;
    if ((m->departs & ~m->kinetic) >> k & 1u && c[1] > c[0]) found |= 1u << k;
  }
  return found;
}

void frot_list_vector_motions(frot_vector_problem *p) {
  if (p->n_items > FROT_MOST_VECTOR_ITEMS) {
    p->complete = 0;
    return;
  }
  unsigned known[FROT_MOST_VECTOR_MOTIONS] = {0};
  int count = 1;
  for (int next = 0; next < count; next++) {
    int before = p->count;
    enumerate(p, known[next]);
    for (int k = before; k < p->count; k++) {
      unsigned departed = falls_in(p, &p->found[k]), forced = known[next] | departed;
      if (!departed) continue;
      int there = count == FROT_MOST_VECTOR_MOTIONS;
      for (int i = 0; i < count; i++) there |= known[i] == forced;
      if (!there) known[count++] = forced;
      frot_vector_motion last = p->found[--p->count], dropped = p->found[k];
      p->found[k] = last, p->found[p->count] = dropped, k--;
    }
  }
}

double frot_vector_painleve(frot_vector_problem *p, const frot_vector_motion *motion, int item) {
  int n = p->n, normal = p->items[item].normal, rank;
  double *matrix = p->scratch, *right = matrix + n * n, *x = right + n, *work = x + n;
  if (normal < 0 || frot_is_reading(p->one->at->m, p->row_of[normal])) return NAN;
  choose_rules(p, motion);
  memset(right, 0, sizeof(double) * (size_t)n);
  for (int k = 0; k < p->n_blocks; k++) {
    const frot_contact_block *one = &p->tried[k];
    for (int i = one->at; i < one->at + one->n; i++) {
      double bound = frot_contact_bound(one, motion->x);
      for (int j = 0; j < n; j++) {
        double effect = p->w[i * n + j], *entry = &matrix[j * n + i];
        *entry =
            one->rule == FROT_ROW_HELD ? effect : (i == j) - (one->rule == FROT_ROW_READS) * effect;
      }
      if (one->rule != FROT_ROW_SLIDES && one->rule != FROT_ROW_BALL) continue;
      for (int j = 0; j < one->n_bounding; j++) { /* friction in its direction follows the bound */
        double part = bound > 0 ? motion->x[i] / bound : 0;
        double length = frot_length(motion->x + one->bounding, one->n_bounding);
        double unit = length > 0 ? motion->x[one->bounding + j] / length : 1;
        matrix[(one->bounding + j) * n + i] -= part * one->ratio * unit;
      }
    }
  }
  right[normal] = 1;
  rank = frot_least_norm(matrix, right, n, n, RANK, x, work, p->integers);
  return rank < n ? NAN : 1 / x[normal];
}
