/* With the modes given, each law has one rule: rest, a slip that begins against its friction (the
 * natural map of P. Alart, A. Curnier 1991), or none. What departs is found with the coefficient of
 * rest first, then has that of motion. */
#include "motions/vector_motions.h"

#include <math.h>
#include <string.h>

#include "contact/slip_directions.h"
#include "evaluation/slip_frames.h"
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

long long frot_vector_doubles(int rows) {
  long long n = rows;
  return n * n + n + FROT_MOST_VECTOR_MOTIONS * 2 * n + 4 * n + 2 * n * n + 6 * n +
         frot_contact_newton_doubles(rows) + 64;
}
int frot_vector_integers(int rows) { return 2 * rows + frot_contact_newton_integers(rows) + 8; }
int frot_vector_blocks(int rows) { return 2 * (rows + 4); }

static frot_contact_block *add_block(frot_vector_problem *p, int rule, int at, int n) {
  frot_contact_block *one = &p->blocks[p->n_blocks++];
  *one = (frot_contact_block){.rule = rule, .at = at, .n = n};
  return one;
}

static int add_row(frot_vector_problem *p, int row) {
  p->row_of[p->n] = row;
  return p->n++;
}

static void add_item(frot_vector_problem *p, int contact, int element, int at, int n, int normal) {
  if (p->n_items == 2 * FROT_MOST_VECTOR_ITEMS) {
    p->complete = 0;
    return;
  }
  p->items[p->n_items++] = (frot_vector_item){contact, element, p->n_blocks - 1, at, n, normal};
}

static int acts(const frot_vector_problem *p, int e) {
  return p->one->place_of[p->one->at->m->elements[e].row] >= 0;
}

static void add_element(frot_vector_problem *p, int e, int normal) {
  const frot_place_of_motion *at = p->one->at;
  const frot_element *element = &at->m->elements[e];
  int slides = !at->zero[e], n = slides ? 1 : element->parts, read = p->n, count = 0;
  for (int k = 0; k < FROT_BOUNDING && element->bound == FROT_BY_PIN; k++)
    if (element->bounded_by[k] >= 0)
      add_block(p, FROT_ROW_READS, add_row(p, element->bounded_by[k]), 1), count++;
  int first = p->n;
  for (int k = 0; k < n; k++) add_row(p, element->row + k);
  frot_contact_block *one = add_block(p, slides ? FROT_ROW_SLIDES : FROT_ROW_BALL, first, n);
  const double *coefficient = at->w->core.coefficient + 2 * e;
  one->ratio = coefficient[!slides];
  if (element->bound == FROT_BY_NORMAL) one->bounding = normal, one->n_bounding = 1;
  if (element->bound == FROT_BY_PIN) one->bounding = read, one->n_bounding = count;
  one->d[0] = element->parts == 1 && at->w->core.rate[element->row] < 0 ? -1 : 1;
  add_item(p, element->contact, e, first, n, element->bound == FROT_BY_NORMAL ? normal : -1);
}

static void list_contact(frot_vector_problem *p, int i) {
  const frot_place_of_motion *at = p->one->at;
  const frot_model *m = at->m;
  const frot_contact *contact = &m->contacts[i];
  int normal = -1, parts = 0;
  if (!at->modes[i].closed) return;
  if (contact->row_n >= 0) {
    parts = !contact->reduced && at->s->data[at->w->layout.unilateral + i] != 0;
    normal = add_row(p, contact->row_n);
    add_block(p, contact->reduced ? FROT_ROW_READS : FROT_ROW_HELD, normal, 1);
  }
  if (parts) add_item(p, i, -1, normal, 1, normal);
  for (int e = 0; e < m->n_elements; e++)
    if (m->elements[e].contact == i && m->elements[e].part == 0 && acts(p, e))
      add_element(p, e, normal);
}

static void fill_matrix(frot_vector_problem *p) {
  const frot_model *m = p->one->at->m;
  const frot_work *w = p->one->at->w;
  for (int i = 0; i < p->n; i++) {
    int row = p->row_of[i];
    p->b[i] = w->core.free[row];
    for (int j = 0; j < p->n; j++) {
      int by = p->row_of[j], none = frot_is_reading(m, by) || m->row_group[row] != m->row_group[by];
      p->w[i * p->n + j] = none ? 0 : frot_effect(m, w, row, by);
    }
  }
}

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
      if (open ? m->a[item->at] < -MISSED * size : m->x[item->at] < -MISSED * most) return 0;
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

static int is_known(const frot_vector_problem *p, const frot_vector_motion *m) {
  for (int k = 0; k < p->count; k++) {
    const frot_vector_motion *other = &p->found[k];
    int same = other->kinetic == m->kinetic || other->departs != m->departs;
    for (int i = 0; i < p->n && same; i++) {
      double size = size_of_row(p, m->x, i) + size_of_row(p, other->x, i);
      same = fabs(m->a[i] - other->a[i]) <= EQUAL * size;
    }
    if (same) return 1;
  }
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

/* Solve in the modes of a motion from all starts; admissible solutions are added to the list. */
static void try_modes(frot_vector_problem *p, const frot_vector_motion *modes) {
  frot_vector_motion m = *modes;
  double *first = p->scratch;
  m.x = first + p->n, m.a = m.x + p->n;
  memset(first, 0, sizeof(double) * (size_t)p->n);
  choose_rules(p, &m);
  frot_contact_equations equations = {p->n, p->n_blocks, p->w, p->b, p->tried, TOLERANCE};
  for (int k = 0; k <= (m.departs ? STARTS : 0); k++) {
    set_start(p, &m, k, first);
    if (frot_contact_newton(&equations, k == 0 ? SWEEPS : 0, m.x, m.a, m.a + p->n, p->integers))
      continue;
    if (k == 0) memcpy(first, m.x, sizeof(double) * (size_t)p->n);
    if (!is_admissible(p, &m) || is_known(p, &m)) continue;
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

void frot_list_vector_motions(const frot_contact_instant *one, double *doubles, int *integers,
                              frot_contact_block *blocks, frot_vector_problem *p) {
  const frot_model *m = one->at->m;
  memset(p, 0, sizeof *p);
  p->one = one, p->complete = 1, p->row_of = integers, p->blocks = blocks;
  for (int k = one->first; k < one->end; k++)
    for (int i = 0; i < m->groups[k].n_contacts; i++) list_contact(p, m->groups[k].contacts[i]);
  p->tried = blocks + p->n_blocks, p->integers = integers + p->n;
  p->w = doubles, p->b = p->w + p->n * p->n;
  double *at = p->b + p->n;
  for (int k = 0; k < FROT_MOST_VECTOR_MOTIONS; k++, at += 2 * p->n)
    p->found[k].x = at, p->found[k].a = at + p->n;
  p->scratch = at;
  fill_matrix(p);
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
