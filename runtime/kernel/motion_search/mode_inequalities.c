#include "motion_search/mode_inequalities.h"

#include <math.h>
#include <string.h>

#include "numerics/dense.h"

/* Rows of one item, at most: of a sector three, of its law two, of its beginning one. */
#define MOST_OF_ITEM 7
/* Friction that follows a reaction is no reaction of its own: least are those that it follows. */
#define FOLLOWS 1e4

int frot_most_equations(const frot_motion_problem *p) { return p->n_permanent + 2 * p->n_items; }
int frot_most_inequalities(const frot_motion_problem *p) { return MOST_OF_ITEM * p->n_items; }

double frot_apart(const frot_motion_problem *p) { return 4 + 4 * p->n_items; }

typedef struct {
  const frot_motion_problem *p;
  const frot_order *order;
  const frot_reading *reading;
  frot_mode_rows *rows;
} writer;

static double *next_equation(writer *w, double right) {
  int n = w->p->n, at = w->rows->p.equations++;
  w->rows->b[at] = right;
  return memset(w->rows->a + at * n, 0, sizeof(double) * (size_t)n);
}

/* row x >= right. Returns the row, zero. */
static double *next_inequality(writer *w, double right, int item, int tag, double size) {
  int n = w->p->n, at = w->rows->p.inequalities++;
  w->rows->g[at] = right, w->rows->own_size[at] = size;
  w->rows->tag[at] = (unsigned char)tag, w->rows->item[at] = item;
  return memset(w->rows->g_rows + at * n, 0, sizeof(double) * (size_t)n);
}

/* Whether an inequality is asked for: at order 0, or where it is zero in the orders below. */
static int is_asked(const writer *w, int item, int tag) {
  return !w->order->held || (w->order->held[item] & tag);
}

static void add_row(double *to, const double *row, double factor, int n) {
  for (int j = 0; j < n; j++) to[j] += factor * row[j];
}

/* What an inequality of an item is read from at the instant of an event. */
static double off_of(const writer *w, int i) { return w->order->k == 0 ? w->p->items[i].off : 0; }

/* The acceleration of a row is zero. */
static void hold_row(writer *w, int row) {
  add_row(next_equation(w, -w->order->b[row]), w->p->w + row * w->p->n, 1, w->p->n);
}

static void no_reaction(writer *w, int row, double off) { next_equation(w, off)[row] = 1; }

/* Sizes of what all reactions of usual size do to a row. */
static double usual(const writer *w, int row) {
  double sum = 0;
  for (int j = 0; j < w->p->n; j++)
    sum += fabs(w->p->w[row * w->p->n + j]) * w->p->unit[j] * w->order->scale;
  return sum;
}

/* The motion of a row begins at order `since`, in the direction s. */
static void begin_row(writer *w, int item, int row, int s, int since) {
  double least = w->reading->strict * frot_apart(w->p) * FROT_MISSED;
  least *= w->order->size[row] + usual(w, row);
  if (w->order->k < since) hold_row(w, row);
  /* what begins by rounding, which is not strict then, must not turn back at the next order */
  int later = w->order->k > since && (w->order->held[item] & FROT_TAG_BEGINS);
  if (w->order->k != since && !later) return;
  double right = -s * w->order->b[row] + least, size = w->order->size[row];
  /* what no reaction moves begins only if loads move it, whatever may be missed */
  if (usual(w, row) == 0 && w->reading->strict > 0 && !(right < 0)) right = w->order->scale;
  add_row(next_inequality(w, right, item, FROT_TAG_BEGINS, size), w->p->w + row * w->p->n, s,
          w->p->n);
}

/* to <- factor times the reaction at a place. Returns factor times its constant. */
static double read_place(const writer *w, int place, double factor, double *to) {
  int n = w->p->n;
  if (place < n) return to[place] += factor, 0;
  add_row(to, w->p->w + place * n, factor, n);
  return factor * w->order->b[place];
}

double frot_bound_value(const frot_motion_problem *p, const frot_motion_item *item, const double *b,
                        const double *x, const double *direction) {
  double value[2] = {0, 0};
  int count = item->bound == FROT_BOUND_VALUE ? 0 : item->bound == FROT_BOUND_LENGTH ? 2 : 1;
  for (int k = 0; k < count; k++) {
    int place = item->reads[k];
    value[k] = place < p->n ? x[place] : b[place] + frot_dot(p->w + place * p->n, x, p->n);
  }
  return count == 2 ? value[0] * direction[0] + value[1] * direction[1] : value[0];
}

void frot_bounding_reaction(const frot_motion_problem *p, const frot_motion_item *item,
                            const double *b, const double *x, double r[2]) {
  static const double axes[2][2] = {{1, 0}, {0, 1}};
  for (int c = 0; c < 2; c++) r[c] = frot_bound_value(p, item, b, x, axes[c]);
}

/* row <- factor times what reactions make of the bound of a law, over its coefficient. Returns the
 * constant part. */
static double bound_of(const writer *w, int i, const frot_item_state *state, double factor,
                       double *row) {
  const frot_motion_item *item = &w->p->items[i];
  const double *along = w->reading->direction + 2 * i;
  if (item->bound == FROT_BOUND_VALUE) return 0;
  if (item->bound == FROT_BOUND_SIDED) factor *= state->side;
  if (item->bound != FROT_BOUND_LENGTH) return read_place(w, item->reads[0], factor, row);
  return read_place(w, item->reads[0], factor * along[0], row) +
         read_place(w, item->reads[1], factor * along[1], row);
}

/* Whether the bound is one linear function of the reactions as the modes are decided. */
static int is_linear(const writer *w, int i, const frot_item_state *state) {
  int bound = w->p->items[i].bound;
  return (bound != FROT_BOUND_SIDED || state->side != 0) &&
         (bound != FROT_BOUND_LENGTH || w->reading->direction);
}

/* Whether the law of an item acts: its contact is not open. */
static int acts(const writer *w, const frot_item_state *states, int i) {
  int contact = w->p->items[i].contact;
  return contact < 0 || states[contact].mode != FROT_ITEM_OPEN;
}

static void list_contact(writer *w, const frot_item_state *states, int i) {
  const frot_item_state *state = &states[i];
  int row = w->p->items[i].row;
  if (state->mode == FROT_ITEM_OPEN) {
    no_reaction(w, row, off_of(w, i));
    begin_row(w, i, row, 1, state->since);
    return;
  }
  if (is_asked(w, i, FROT_TAG_NORMAL))
    next_inequality(w, off_of(w, i), i, FROT_TAG_NORMAL, 0)[row] = 1;
  int undecided = state->mode == FROT_ITEM_OPEN_QUESTION || (w->reading->doubtful && state->doubt);
  if (undecided && is_asked(w, i, FROT_TAG_NORMAL))
    add_row(next_inequality(w, -w->order->b[row], i, FROT_TAG_BEGINS, w->order->size[row]),
            w->p->w + row * w->p->n, 1, w->p->n);
  else
    hold_row(w, row);
}

/* The direction of a reaction of two components lies in a sector. */
static void list_sector(writer *w, int i, const frot_item_state *state) {
  const frot_motion_item *item = &w->p->items[i];
  double steep = tan((double)state->half);
  double along[2] = {cos(state->angle), sin(state->angle)}, across[2] = {-along[1], along[0]};
  for (int k = 0; k < 3; k++) {
    double *row = next_inequality(w, 0, i, FROT_TAG_SECTOR, 0), sum = 0;
    double side = k == 0 ? 0 : k == 1 ? 1 : -1, much = k == 0 ? 1 : steep;
    for (int c = 0; c < 2; c++)
      sum += read_place(w, item->reads[c], much * along[c] + side * across[c], row);
    w->rows->g[w->rows->p.inequalities - 1] = -sum;
  }
}

/* And the law within the hull of what it is there (at order 0): |f| <= mu |R|, and of a slip
 * mu R.u <= -s f <= mu |R|. */
static void list_hull(writer *w, int i, const frot_item_state *state, int slides, double mu) {
  const frot_motion_item *item = &w->p->items[i];
  double out = 1 / cos((double)state->half), along[2] = {cos(state->angle), sin(state->angle)};
  list_sector(w, i, state);
  for (int k = 0; k < 2; k++) {
    double sum = 0, *row = next_inequality(w, 0, i, FROT_TAG_SECTOR, 0);
    double factor = slides && k == 0 ? -mu : mu * out;
    double sign = slides ? (k == 0 ? -slides : slides) : (k == 0 ? 1 : -1);
    for (int c = 0; c < 2; c++) sum += read_place(w, item->reads[c], factor * along[c], row);
    row[item->row] += sign;
    w->rows->g[w->rows->p.inequalities - 1] = -sum;
  }
}

static void list_slip(writer *w, const frot_item_state *states, int i) {
  const frot_item_state *state = &states[i];
  const frot_motion_item *item = &w->p->items[i];
  int s = item->moving ? item->moving : state->mode == FROT_ITEM_FORWARD ? 1 : -1;
  int kinetic = w->reading->kinetic[i];
  double mu = kinetic ? item->mu : item->mu_s;
  if (is_linear(w, i, state)) {
    double *row = next_equation(w, 0), constant = bound_of(w, i, state, s * mu, row);
    row[item->row] += 1;
    double off = item->mu == item->mu_s && !item->moving ? off_of(w, i) : 0;
    constant += s * (w->order->known[2 * i + !kinetic] - off);
    w->rows->b[w->rows->p.equations - 1] = -constant;
  } else if (item->bound == FROT_BOUND_LENGTH && state->half > 0) {
    list_hull(w, i, state, s, mu);
  }
  if (item->moving == 0) begin_row(w, i, item->row, s, state->since);
}

static void list_rest(writer *w, const frot_item_state *states, int i) {
  const frot_item_state *state = &states[i];
  const frot_motion_item *item = &w->p->items[i];
  int n = w->p->n, held = state->mode == FROT_ITEM_HELD, row = item->row;
  for (int k = 0; k < 2 && is_linear(w, i, state); k++) { /* bound + f, bound - f */
    int tag = k == 0 ? FROT_TAG_FORWARD : FROT_TAG_BACKWARD;
    if (!is_asked(w, i, tag)) continue;
    double *own = next_inequality(w, 0, i, tag, 0);
    double constant = bound_of(w, i, state, item->mu_s, own);
    own[row] += k == 0 ? 1 : -1;
    constant += w->order->known[2 * i + 1] - off_of(w, i);
    w->rows->g[w->rows->p.inequalities - 1] = -constant;
  }
  if (!is_linear(w, i, state) && state->half > 0) list_hull(w, i, state, 0, item->mu_s);
  if (held && !(w->reading->doubtful && state->doubt)) {
    hold_row(w, row);
  } else if (w->order->held) { /* not decided at this order: what its zero slacks allow */
    int forward = w->order->held[i] & FROT_TAG_FORWARD,
        backward = w->order->held[i] & FROT_TAG_BACKWARD;
    if (!forward && !backward) {
      hold_row(w, row);
    } else if (!forward || !backward) {
      int s = forward ? 1 : -1;
      double right = -s * w->order->b[row], size = w->order->size[row];
      add_row(next_inequality(w, right, i, FROT_TAG_BEGINS, size), w->p->w + row * n, s, n);
    }
  }
}

/* Whether the friction of an item follows what bounds it. */
static int follows(const frot_motion_problem *p, const frot_item_state *state, int i) {
  return p->items[i].kind == FROT_ITEM_LAW &&
         (p->items[i].moving != 0 || state->mode == FROT_ITEM_FORWARD ||
          state->mode == FROT_ITEM_BACKWARD);
}

static void list_law(writer *w, const frot_item_state *states, int i) {
  const frot_item_state *state = &states[i];
  const frot_motion_item *item = &w->p->items[i];
  if (!acts(w, states, i)) { /* the offset of its normal reaction has friction */
    double left = item->bound == FROT_BOUND_PRESSING ? off_of(w, item->contact) : 0;
    no_reaction(w, item->row, -item->moving * item->mu * left);
    return;
  }
  if (item->bound == FROT_BOUND_SIDED && state->side != 0 && is_asked(w, i, FROT_TAG_SIDE)) {
    double *row = next_inequality(w, 0, i, FROT_TAG_SIDE, 0);
    double off = w->order->k == 0 ? state->side * item->side_off : 0;
    w->rows->g[w->rows->p.inequalities - 1] = off - read_place(w, item->reads[0], state->side, row);
  }
  int within = w->reading->sectors && w->order->k == 0 && item->bound == FROT_BOUND_LENGTH;
  if (within && state->half > 0) list_sector(w, i, state);
  int slides =
      item->moving || state->mode == FROT_ITEM_FORWARD || state->mode == FROT_ITEM_BACKWARD;
  if (slides)
    list_slip(w, states, i);
  else
    list_rest(w, states, i);
}

void frot_list_inequalities(const frot_motion_problem *p, const frot_item_state *states,
                            const frot_order *order, const frot_reading *reading,
                            frot_mode_rows *rows) {
  writer w = {p, order, reading, rows};
  int n = p->n;
  rows->p = (frot_polyhedron){.n = n,
                              .a = rows->a,
                              .b = rows->b,
                              .g_rows = rows->g_rows,
                              .g = rows->g,
                              .slack = rows->slack,
                              .unit = rows->unit,
                              .size = order->scale};
  for (int j = 0; j < n; j++) rows->unit[j] = p->unit[j];
  for (int i = 0; i < p->n_permanent; i++) hold_row(&w, p->permanent[i]);
  for (int i = 0; i < p->n_items; i++) {
    if (p->items[i].kind == FROT_ITEM_CONTACT)
      list_contact(&w, states, i);
    else
      list_law(&w, states, i);
  }
  for (int i = 0; i < rows->p.inequalities; i++) {
    double sum = rows->own_size[i];
    for (int j = 0; j < n; j++) sum += fabs(rows->g_rows[i * n + j]) * p->unit[j] * order->scale;
    rows->slack[i] = FROT_MISSED * sum;
  }
}

void frot_weigh_followers(const frot_motion_problem *p, const frot_item_state *states,
                          frot_mode_rows *rows) {
  for (int i = 0; i < p->n_items; i++)
    if (follows(p, &states[i], i)) rows->unit[p->items[i].row] *= FOLLOWS;
}
