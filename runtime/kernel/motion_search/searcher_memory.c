/* The scratch memory of a search, carved out of one block. */
#include <string.h>

#include "motion_search/motion_orders.h"
#include "motion_search/sliding_springs.h"

static double *take(double **from, long long count) {
  double *at = *from;
  *from += count;
  return at;
}

/* Nodes that wait: children of each of the items on a way down, at every order. */
static int room_of(int n_items) { return 16 * (n_items + 2) * FROT_ORDERS; }

/* Doubles that hold `count` items of `size` bytes. */
static long long doubles_of(long long count, size_t size) {
  return (count * (long long)size + (long long)sizeof(double) - 1) / (long long)sizeof(double);
}

/* With the first double NULL it only counts. */
static long long carve(frot_searcher *s, int n, int places, int width, int n_permanent, int n_items,
                       double *doubles) {
  frot_motion_problem size = {.n_permanent = n_permanent, .n_items = n_items};
  int equations = frot_most_equations(&size), inequalities = frot_most_inequalities(&size);
  long long used = 0, total = equations + inequalities + n_items;
  double *at = doubles, none = 0;
  if (!at) at = &none;
  double *begin = at;
#define TAKE(field, count) (s->field = doubles ? take(&at, (count)) : (used += (count), NULL))
#define TAKE_BYTES(field, count)                                                  \
  (s->field = (void *)(doubles ? take(&at, doubles_of((count), sizeof *s->field)) \
                               : (used += doubles_of((count), sizeof *s->field), NULL)))
  TAKE(x, FROT_ORDERS * n), TAKE(b, FROT_ORDERS * places), TAKE(size, FROT_ORDERS * places);
  TAKE(coefficient, FROT_ORDERS * 2 * n_items), TAKE(length, FROT_ORDERS * n_items);
  TAKE(known, 2 * n_items), TAKE(direction, 2 * n_items), TAKE(turned, n + n * n);
  TAKE(whole, (long long)places * n), TAKE(span, (long long)(n + 1) * (width > n ? width : n));
  TAKE(rows.a, total * n), TAKE(rows.b, total);
  TAKE(rows.g_rows, (long long)inequalities * n), TAKE(rows.g, inequalities);
  TAKE(rows.slack, inequalities), TAKE(rows.own_size, inequalities), TAKE(rows.unit, n);
  TAKE_BYTES(rows.tag, inequalities), TAKE_BYTES(rows.item, inequalities);
  TAKE_BYTES(held, n_items), TAKE_BYTES(zero, inequalities), TAKE_BYTES(kinetic, n_items);
  TAKE_BYTES(stack, (long long)room_of(n_items) * n_items), TAKE_BYTES(child, 2 * n_items);
  TAKE_BYTES(order, room_of(n_items));
  TAKE(doubles, frot_polyhedron_doubles(n, (int)total, inequalities));
  TAKE(spring_doubles, frot_sliding_springs_doubles(n_items > n ? n_items : n, width));
  TAKE_BYTES(spring_integers, frot_sliding_springs_integers(n_items > n ? n_items : n));
#undef TAKE
#undef TAKE_BYTES
  return doubles ? (long long)(at - begin) : used;
}

long long frot_found_doubles(int n, int places, int n_items) {
  return doubles_of(n_items, sizeof(frot_item_state)) + doubles_of(n_items, 1) +
         FROT_ORDERS * (n + places);
}

long long frot_motion_doubles(int n, int places, int width, int n_permanent, int n_items) {
  frot_searcher s;
  long long found = frot_found_doubles(n, places, n_items);
  return carve(&s, n, places, width, n_permanent, n_items, NULL) +
         (2 * FROT_MOST_FOUND + 1) * found;
}

long long frot_motion_integers(int n, int n_permanent, int n_items) {
  frot_motion_problem size = {.n_permanent = n_permanent, .n_items = n_items};
  return frot_polyhedron_integers(n, frot_most_inequalities(&size)) + 8;
}

void frot_begin_search(const frot_motion_problem *p, frot_searcher *s, double *doubles,
                       int *integers) {
  memset(s, 0, sizeof *s);
  carve(s, p->n, p->places, p->width, p->n_permanent, p->n_items, doubles);
  s->p = p, s->integers = integers, s->strict = 1, s->room = room_of(p->n_items);
  p->right_side(p->context, 0, s->x, s->b, s->size, s->coefficient);
  s->force = frot_usual_force(s);
}
