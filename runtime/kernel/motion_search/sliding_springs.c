#include "motion_search/sliding_springs.h"

#include <math.h>
#include <string.h>

#include "numerics/dense.h"
#include "contact/spring_rows.h"

/* Length of a row of length 1 below which it depends on the others. */
#define DEPENDENT 1e-9
/* Part of the usual reaction below which a force of a spring is none. */
#define NO_FORCE 1e-11

enum { BEARS = 1, UNLOADED = 2 };

int frot_sliding_springs_doubles(int n, int width) {
  return frot_spring_rows_doubles(n, width > n ? width : n) + n;
}
int frot_sliding_springs_integers(int n) { return frot_spring_rows_integers(n) + 2 * n; }

/* `item`: that of each row of `springs`; state (items): BEARS, UNLOADED or 0. */
typedef struct {
  frot_searcher *s;
  const frot_item_state *states;
  frot_spring_rows springs;
  int *item, *state;
  double *found;
} search;

static const double *row_of(const search *q, int row, int *width) {
  const frot_motion_problem *p = q->s->p;
  *width = p->width > 0 ? p->width : p->n;
  return (p->width > 0 ? p->rows : p->w) + row * *width;
}

/* Whether friction of motion follows the reaction of an item's contact. */
static int slides(const search *q, int contact) {
  const frot_motion_problem *p = q->s->p;
  for (int i = 0; i < p->n_items; i++) {
    const frot_motion_item *law = &p->items[i];
    int mode = q->states[i].mode;
    if (law->kind == FROT_ITEM_LAW && law->contact == contact &&
        law->bound == FROT_BOUND_PRESSING &&
        (mode == FROT_ITEM_FORWARD || mode == FROT_ITEM_BACKWARD))
      return 1;
  }
  return 0;
}

static int is_open(const search *q, int contact) {
  return contact >= 0 && q->states[contact].mode == FROT_ITEM_OPEN;
}

/* Put the rows of contacts that bear and of laws at rest, which are rigid, and with `last` that of
 * an unloaded contact into q->springs. Returns the number of rows. */
static int put_rows(search *q, int last) {
  const frot_motion_problem *p = q->s->p;
  int count = 0, width = 0;
  for (int pass = 0; pass < 2; pass++) {
    int at = 0;
    for (int i = 0; i < p->n_items; i++) {
      int law = p->items[i].kind == FROT_ITEM_LAW;
      int rigid = law && q->states[i].mode == FROT_ITEM_HELD && !is_open(q, p->items[i].contact);
      if (!rigid && !(q->state[i] == BEARS) && i != last) continue;
      if (pass == 0) {
        count++;
        continue;
      }
      const double *row = row_of(q, p->items[i].row, &width);
      q->item[at] = i;
      frot_add_spring_row(&q->springs, at++, row, !law, !law && slides(q, i));
    }
    if (pass == 0) {
      row_of(q, 0, &width);
      double *doubles = q->springs.x;
      int *integers = q->springs.kind;
      frot_begin_springs(&q->springs, count, width, doubles, integers);
    }
  }
  int place = -1;
  for (int k = 0; k < count; k++)
    if (q->item[k] == last) place = k;
  frot_combine_springs(&q->springs, DEPENDENT, -1, place);
  return count;
}

/* An equation row x = 0 more, zero. */
static double *next_equation(search *q) {
  frot_mode_rows *r = &q->s->rows;
  int n = q->s->p->n, at = r->p.equations++;
  r->b[at] = 0;
  return memset(r->a + at * n, 0, sizeof(double) * (size_t)n);
}

/* The equations of springs that bear and of contacts that do not, after the first `equations`. */
static void add_equations(search *q, int equations) {
  const frot_motion_problem *p = q->s->p;
  q->s->rows.p.equations = equations;
  int count = put_rows(q, -1);
  for (int k = 0; k < count; k++) {
    if (!frot_is_compatible(&q->springs, k)) continue;
    double *row = next_equation(q);
    for (int i = 0; i < count; i++)
      if (frot_is_spring(&q->springs, i))
        row[p->items[q->item[i]].row] = q->springs.z[k * count + i];
  }
  for (int i = 0; i < p->n_items; i++)
    if (q->state[i] == UNLOADED) next_equation(q)[p->items[i].row] = 1;
}

/* What the spring of an unloaded contact would bear. */
static double spring_of(search *q, int item) {
  const frot_motion_problem *p = q->s->p;
  int count = put_rows(q, item), last = 0;
  while (q->item[last] != item) last++;
  if (!frot_is_compatible(&q->springs, last)) return 0;
  const double *z = q->springs.z + last * count;
  double sum = 0;
  for (int i = 0; i < count; i++)
    if (i != last && frot_is_spring(&q->springs, i))
      sum -= z[i] * q->found[p->items[q->item[i]].row];
  return sum / z[last];
}

/* The contact that is most stretched or, though it bears nothing, pressed; -1. */
static int worst_of(search *q) {
  const frot_motion_problem *p = q->s->p;
  double most = NO_FORCE * q->s->force;
  int worst = -1;
  for (int i = 0; i < p->n_items; i++) {
    if (!q->state[i]) continue;
    double beyond = q->state[i] == BEARS ? -q->found[p->items[i].row] : spring_of(q, i);
    beyond /= p->unit[p->items[i].row];
    if (beyond > most) most = beyond, worst = i;
  }
  return worst;
}

/* The reactions of the equations into q->found, where contacts that bear press. */
static int find(search *q, int equations, int inequalities) {
  frot_searcher *s = q->s;
  for (int tries = 0; tries <= 2 * s->p->n_items; tries++) {
    int redundant;
    add_equations(q, equations);
    s->rows.p.inequalities = 0;
    if (frot_polyhedron_point(&s->rows.p, q->found, &redundant, s->doubles, s->integers)) return 0;
    int worst = worst_of(q);
    if (worst < 0) {
      s->rows.p.inequalities = inequalities;
      return !frot_polyhedron_point(&s->rows.p, q->found, &redundant, s->doubles, s->integers);
    }
    q->state[worst] = q->state[worst] == BEARS ? UNLOADED : BEARS;
  }
  return 0;
}

int frot_sliding_springs(frot_searcher *s, const frot_item_state *states, double *x) {
  const frot_motion_problem *p = s->p;
  search q = {.s = s, .states = states, .found = s->spring_doubles};
  int most = p->n_items;
  q.item = s->spring_integers, q.state = q.item + most;
  q.springs.x = q.found + p->n, q.springs.kind = q.state + most;
  for (int i = 0; i < p->n_items; i++)
    q.state[i] = p->items[i].kind == FROT_ITEM_CONTACT && states[i].mode == FROT_ITEM_HELD;
  int equations = s->rows.p.equations, inequalities = s->rows.p.inequalities;
  int found = find(&q, equations, inequalities);
  s->rows.p.equations = equations, s->rows.p.inequalities = inequalities;
  if (found) memcpy(x, q.found, sizeof(double) * (size_t)p->n);
  return found;
}
