/* A node leaves some items undecided and relaxes them. At order 0 it is decided whether a motion
 * begins at once (s' > 0) or not (s' = 0); what is zero in all reactions then is in doubt, and the
 * same is decided for it at the next order, rest first. */
#include "motion_search/branch_and_bound.h"

#include <math.h>
#include <string.h>

#include "numerics/dense.h"

/* Sectors that a direction is divided into at first. */
#define SECTORS 8
/* Order up to which equations that depend on each other are compared where something moves. */
#define CONFLICTS_TO 2
/* Part of a row up to which it depends on others: of itself, or of its square. */
#define DEPENDS 1e-10
#define DEPENDS_SQUARED 1e-8

typedef struct {
  frot_searcher *s;
  frot_motion_list *list;
} search;

static void push(search *q, const frot_item_state *states, int order) {
  frot_searcher *s = q->s;
  int n = s->p->n_items;
  if (s->waiting == s->room) {
    q->list->complete = 0;
    return;
  }
  memcpy(s->stack + s->waiting * n, states, sizeof *states * (size_t)n);
  s->order[s->waiting++] = order;
}

static void push_changed(search *q, frot_item_state *states, int order, int item,
                         frot_item_state changed) {
  frot_item_state kept = states[item];
  states[item] = changed;
  push(q, states, order);
  states[item] = kept;
}

static int is_law(const search *q, int i) { return q->s->p->items[i].kind == FROT_ITEM_LAW; }

/* Whether a law has modes: its contact is not open. */
static int acts(const search *q, const frot_item_state *states, int i) {
  int contact = q->s->p->items[i].contact;
  return !is_law(q, i) || contact < 0 || states[contact].mode != FROT_ITEM_OPEN;
}

/* The first item that is not decided, contacts before their laws, or -1. */
static int undecided(const search *q, const frot_item_state *states) {
  for (int i = 0; i < q->s->p->n_items; i++)
    if (states[i].mode == FROT_ITEM_OPEN_QUESTION && acts(q, states, i)) return i;
  return -1;
}

static void decide(search *q, frot_item_state *states, int i) {
  const frot_motion_item *item = &q->s->p->items[i];
  frot_item_state own = states[i];
  own.since = 0;
  if (item->kind == FROT_ITEM_CONTACT) {
    own.mode = FROT_ITEM_OPEN, push_changed(q, states, 0, i, own);
  } else if (item->moving == 0) {
    own.mode = FROT_ITEM_BACKWARD, push_changed(q, states, 0, i, own);
    own.mode = FROT_ITEM_FORWARD, push_changed(q, states, 0, i, own);
  } else {
    own.mode = item->moving > 0 ? FROT_ITEM_FORWARD : FROT_ITEM_BACKWARD;
    push_changed(q, states, 0, i, own);
    return;
  }
  own.mode = FROT_ITEM_HELD, push_changed(q, states, 0, i, own);
}

/* The item whose normal has no side or whose direction no sector yet, or -1. */
static int unsided(const search *q, const frot_item_state *states) {
  for (int i = 0; i < q->s->p->n_items; i++) {
    if (!is_law(q, i) || !acts(q, states, i)) continue;
    int bound = q->s->p->items[i].bound;
    if (bound == FROT_BOUND_SIDED && states[i].side == 0) return i;
    if (bound == FROT_BOUND_LENGTH && !(states[i].half > 0)) return i;
  }
  return -1;
}

static void divide(search *q, frot_item_state *states, int i, int order) {
  frot_item_state own = states[i];
  if (q->s->p->items[i].bound == FROT_BOUND_SIDED) {
    own.side = -1, push_changed(q, states, order, i, own);
    own.side = 1, push_changed(q, states, order, i, own);
    return;
  }
  double whole = 2 * acos(-1.0);
  for (int k = 0; k < SECTORS; k++) {
    own.angle = whole * k / SECTORS, own.half = (float)(whole / SECTORS / 2);
    push_changed(q, states, order, i, own);
  }
}

static void halve(search *q, frot_item_state *states, int i, int order) {
  frot_item_state own = states[i];
  double angle = own.angle;
  own.half /= 2;
  for (int side = -1; side <= 1; side += 2)
    own.angle = angle + side * (double)own.half, push_changed(q, states, order, i, own);
}

static int first_doubt(const search *q, const frot_item_state *states) {
  for (int i = 0; i < q->s->p->n_items; i++)
    if (states[i].doubt) return i;
  return -1;
}

/* What is in doubt at an order holds, or begins to move there. */
static void resolve_doubt(search *q, frot_item_state *states, int i, int order) {
  frot_item_state own = states[i];
  int doubt = own.doubt;
  own.doubt = 0, own.since = (signed char)order;
  if (doubt & FROT_MAY_OPEN) own.mode = FROT_ITEM_OPEN, push_changed(q, states, order, i, own);
  if (doubt & FROT_MAY_GO_BACKWARD)
    own.mode = FROT_ITEM_BACKWARD, push_changed(q, states, order, i, own);
  if (doubt & FROT_MAY_GO_FORWARD)
    own.mode = FROT_ITEM_FORWARD, push_changed(q, states, order, i, own);
  own = states[i], own.doubt = 0;
  push_changed(q, states, order, i, own);
}

/* Note what is in doubt at the next order. Returns whether anything is. */
static int note_doubts(const search *q, frot_item_state *states) {
  const frot_searcher *s = q->s;
  int any = 0;
  for (int i = 0; i < s->p->n_items; i++) {
    states[i].doubt = 0;
    if (states[i].mode != FROT_ITEM_HELD || !acts(q, states, i)) continue;
    int doubt = 0;
    if (!is_law(q, i) && (s->held[i] & FROT_TAG_NORMAL)) doubt |= FROT_MAY_OPEN;
    if (is_law(q, i) && (s->held[i] & FROT_TAG_FORWARD)) doubt |= FROT_MAY_GO_FORWARD;
    if (is_law(q, i) && (s->held[i] & FROT_TAG_BACKWARD)) doubt |= FROT_MAY_GO_BACKWARD;
    states[i].doubt = (signed char)doubt, any |= doubt;
  }
  return any != 0;
}

static void take_out(double *row, const double *unit, int n) {
  for (int pass = 0; pass < 2; pass++) {
    double part = frot_dot(row, unit, n);
    for (int j = 0; j < n; j++) row[j] -= part * unit[j];
  }
}

/* Whether a row holds by itself whatever its reaction: it is permanent, of a closed contact, or of
 * another law at rest. */
static int is_kept(const search *q, const frot_item_state *states, int row, int beside) {
  const frot_motion_problem *p = q->s->p;
  for (int i = 0; i < p->n_permanent; i++)
    if (p->permanent[i] == row) return 1;
  for (int i = 0; i < p->n_items; i++)
    if (p->items[i].row == row)
      return i != beside && acts(q, states, i) && states[i].mode == FROT_ITEM_HELD;
  return 0;
}

/* Whether the row of an item that holds depends on the other rows that do. */
static int depends(const search *q, const frot_item_state *states, int item) {
  const frot_motion_problem *p = q->s->p;
  int width = p->width > 0 ? p->width : p->n, count = 0, row = p->items[item].row;
  const double *rows = p->width > 0 ? p->rows : p->w;
  double *own = q->s->span, *basis = own + width;
  double limit = rows == p->w ? DEPENDS_SQUARED : DEPENDS;
  for (int r = 0; r <= p->n; r++) {
    int last = r == p->n, at = last ? row : r;
    if (!last && !is_kept(q, states, r, item)) continue;
    double *next = last ? own : basis + count * width;
    memcpy(next, rows + at * width, sizeof(double) * (size_t)width);
    double before = frot_length(next, width);
    for (int k = 0; k < count; k++) take_out(next, basis + k * width, width);
    double after = frot_length(next, width);
    if (last) return after <= limit * before || before == 0;
    if (!(after > limit * before) || before == 0) continue;
    for (int j = 0; j < width; j++) next[j] /= after;
    count++;
  }
  return 0;
}

/* Equations contradict each other at an order above 0: what rests in a row that depends on others
 * slips from that order on, its friction at its bound from order 0 on; directions are found again.
 */
static void branch_conflict(search *q, frot_item_state *states, int order) {
  const frot_motion_problem *p = q->s->p;
  if (order == 0) return;
  for (int i = 0; i < p->n_items; i++) {
    if (!is_law(q, i) || !acts(q, states, i) || states[i].mode != FROT_ITEM_HELD) continue;
    if (p->items[i].moving || !depends(q, states, i)) continue;
    for (int k = 0; k < p->n_items; k++) states[k].doubt = 0, states[k].half = 0;
    frot_item_state own = states[i];
    own.since = (signed char)order;
    own.mode = FROT_ITEM_BACKWARD, push_changed(q, states, 0, i, own);
    own.mode = FROT_ITEM_FORWARD, push_changed(q, states, 0, i, own);
  }
}

/* Whether motion sets out from rest without an acceleration, while what rests depends on other rows
 * in this posture alone: a contradiction shows at orders above the highest. */
static int shows_later(const search *q, const frot_item_state *states, int order) {
  const frot_searcher *s = q->s;
  if (s->redundant == 0 || frot_anything_moves(s, 0) || !frot_anything_moves(s, order)) return 0;
  for (int i = 0; i < s->p->n_items; i++)
    if (is_law(q, i) && acts(q, states, i) && states[i].mode == FROT_ITEM_HELD &&
        depends(q, states, i))
      return 1;
  return 0;
}

static void record(search *q, const frot_item_state *states, int order, int decided) {
  const frot_searcher *s = q->s;
  const frot_motion_problem *p = s->p;
  if (q->list->count == FROT_MOST_FOUND) {
    q->list->complete = 0;
    return;
  }
  frot_found_motion *m = &q->list->found[q->list->count++];
  memcpy(m->states, states, sizeof *states * (size_t)p->n_items);
  memcpy(m->kinetic, s->kinetic, (size_t)p->n_items);
  memcpy(m->x, s->x, sizeof(double) * (size_t)((order + 1) * p->n));
  memcpy(m->b, s->b, sizeof(double) * (size_t)((order + 1) * p->places));
  m->late = shows_later(q, states, order);
  m->order = order, m->decided = decided && !m->late, m->family = s->family,
  m->hardly = s->strict == 0;
  m->same = -1;
}

/* Whether something is zero in all orders so far that the next one decides: the side of a normal of
 * either sign, which a law reads; whether what begins by rounding does begin. */
static int decides_later(const search *q, const frot_item_state *states) {
  const frot_searcher *s = q->s;
  for (int i = 0; i < s->p->n_items; i++)
    if (acts(q, states, i) && (s->held[i] & (FROT_TAG_SIDE | FROT_TAG_BEGINS))) return 1;
  return 0;
}

/* A node whose modes are all decided and in no doubt at order k, after its orders are found. */
static void leaf(search *q, frot_item_state *states, int k) {
  const frot_searcher *s = q->s;
  int doubt = note_doubts(q, states);
  int compare = s->redundant > 0 && frot_anything_moves(s, k) && k < CONFLICTS_TO;
  compare |= decides_later(q, states);
  if ((doubt || compare) && k < s->p->orders) {
    push(q, states, k + 1);
    return;
  }
  record(q, states, k, !doubt);
}

static int has_length(const frot_motion_problem *p) {
  for (int i = 0; i < p->n_items; i++)
    if (p->items[i].kind == FROT_ITEM_LAW && p->items[i].bound == FROT_BOUND_LENGTH) return 1;
  return 0;
}

/* The orders up to k in the directions found; in their sectors, where reactions are redundant and
 * the least ones have other directions. */
static int find_directed(search *q, const frot_item_state *states, int k, int doubtful) {
  int failed = frot_find_orders(q->s, states, (frot_look){k, 1, doubtful, 0});
  if (failed >= 0 || frot_follows_its_reaction(q->s, states)) return failed;
  return frot_find_orders(q->s, states, (frot_look){k, 1, doubtful, 1});
}

static void expand(search *q, frot_item_state *states, int k) {
  frot_searcher *s = q->s;
  int lengths = has_length(s->p), first = first_doubt(q, states), open = unsided(q, states);
  if (lengths && k > 0) { /* directions are found at order 0 */
    frot_find_orders(s, states, (frot_look){0, 0, 0, 0});
    if (frot_find_directions(s, states) >= 0) {
      q->list->complete = 0;
      return;
    }
  }
  int failed = lengths && k > 0 ? find_directed(q, states, k, first >= 0)
                                : frot_find_orders(s, states, (frot_look){k, 0, first >= 0, 0});
  int next = undecided(q, states);
  /* close to a jam the reactions of the modes decided may be large: these equations are solved */
  if (failed >= 0 && !(s->far && next >= 0)) {
    if (failed > 0 && first < 0 && next < 0) branch_conflict(q, states, failed);
    return;
  }
  if (next >= 0) {
    decide(q, states, next);
  } else if (first >= 0) {
    resolve_doubt(q, states, first, k);
  } else if (open >= 0) {
    divide(q, states, open, k);
  } else if (lengths && k == 0) {
    int item = frot_find_directions(s, states);
    if (item >= 0) {
      halve(q, states, item, k);
    } else if (find_directed(q, states, k, 0) < 0) {
      leaf(q, states, k);
    }
  } else {
    leaf(q, states, k);
  }
}

void frot_branch(frot_searcher *s, const frot_item_state *given, int budget,
                 frot_motion_list *list) {
  search q = {s, list};
  size_t size = sizeof *given * (size_t)s->p->n_items;
  s->waiting = 0;
  push(&q, given, 0);
  while (s->waiting > 0) {
    if (list->nodes >= budget) {
      list->complete = 0;
      return;
    }
    list->nodes++, s->waiting--;
    memcpy(s->child, s->stack + s->waiting * s->p->n_items, size);
    expand(&q, s->child, s->order[s->waiting]);
  }
}
