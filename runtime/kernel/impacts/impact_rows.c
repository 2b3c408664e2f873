#include "impacts/impact_rows.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "impacts/accumulation.h"
#include "modes/zero_slip.h"
#include "numerics/dense.h"
#include "numerics/tolerances.h"
#include "reactions/contact_blocks.h"

/* The blocks listed from the k-th on as those of the impact, of contact `owner` = ~contact or of an
 * element; returns the last one. */
static frot_impact_block *take_blocks(const frot_instant *in, const frot_block_list *list, int k,
                                      int owner) {
  frot_impact_work *own = &in->w->impacts;
  for (; k < list->n_blocks; k++) {
    const frot_contact_block *one = &list->blocks[k];
    frot_impact_block *block = &own->blocks[k];
    *block = (frot_impact_block){.rule = one->rule, .at = one->at, .n = one->n};
    block->bounding = one->bounding, block->n_bounding = one->n_bounding;
    memcpy(block->norm, one->norm, sizeof block->norm);
    own->block_of[k] = owner;
    for (int i = one->at; i < one->at + one->n; i++) own->before[i] = 0;
  }
  return &own->blocks[k - 1];
}

/* An element whose bound a value of the text gives has no impulse: that is a force. */
static void add_element(const frot_instant *in, frot_block_list *list, int e, int normal) {
  const frot_element *element = &in->m->elements[e];
  frot_work *w = in->w;
  if (element->bound == FROT_BY_VALUE || element->prescribed || !frot_bounds_something(in->m, w, e))
    return;
  int friction = frot_element_mode(in->m, w->search.before, e)->friction, from = list->n_blocks;
  in->zero[e] = (unsigned char)frot_is_zero_rate(in, e, in->v, friction);
  frot_list_element(in->m, w, list, e, normal, 0);
  frot_impact_block *block = take_blocks(in, list, from, e);
  block->slipping = w->core.coefficient[2 * e], block->resting = w->core.coefficient[2 * e + 1];
  block->is_zero = in->zero[e];
  for (int k = 0; k < element->parts; k++)
    w->impacts.before[block->at + k] = w->core.rate[element->row + k];
}

static void add_contact(const frot_instant *in, frot_impact_scene *scene, frot_block_list *list,
                        int i) {
  const frot_model *m = in->m;
  const frot_contact *contact = &m->contacts[i];
  int normal = -1;
  if (contact->row_n >= 0) {
    double rate;
    int rule = contact->reduced         ? FROT_ROW_READS
               : in->unilateral[i] != 0 ? FROT_ROW_PRESSES
                                        : FROT_ROW_HELD;
    normal = frot_list_row(list, contact->row_n);
    frot_list_block(list, rule, normal, 1);
    frot_impact_block *block = take_blocks(in, list, list->n_blocks - 1, ~i);
    int stays = frot_flight_of(in->s, &in->l, i)[FROT_STAYS_CLOSED] != 0;
    block->law = contact->impact;
    block->restitution = stays ? 0 : in->s->data[in->l.restitution + i];
    enum frot_approach approach = frot_approach_of(in, i, &rate);
    block->is_zero = approach == FROT_STAYS;
    if (rule == FROT_ROW_PRESSES) in->w->impacts.before[normal] = rate;
    if (in->w->impacts.meets[i] && !(rate >= scene->rate)) scene->first = i, scene->rate = rate;
  }
  for (int e = 0; e < m->n_elements; e++)
    if (m->elements[e].contact == i && m->elements[e].part == 0) add_element(in, list, e, normal);
}

void frot_list_impact(const frot_instant *in, const int *chosen, int count, int driver,
                      frot_impact_scene *scene) {
  frot_impact_work *own = &in->w->impacts;
  frot_block_list list = {own->listed, own->row_of, 0, 0};
  *scene = (frot_impact_scene){.first = chosen[0]};
  for (int c = 0; c < count; c++) add_contact(in, scene, &list, chosen[c]);
  scene->problem = (frot_impact_problem){list.rows, list.n_blocks, own->problem, own->blocks};
  frot_list_effects(in->m, in->w, &list, own->problem);
  memcpy(own->after, own->before, sizeof(double) * (size_t)list.rows);
  scene->driver = -1;
  for (int c = 0; c < count; c++) scene->together += own->meets[chosen[c]] || chosen[c] == driver;
  for (int k = 0; k < scene->problem.n_blocks; k++)
    if (own->blocks[k].rule == FROT_ROW_PRESSES && own->block_of[k] == ~driver) scene->driver = k;
}

/* The largest W of a row that acts: the scale of the row of a percussion. */
static double largest_effect(const frot_impact_problem *p) {
  double most = 0;
  for (int i = 0; i < p->rows; i++) most = fmax(most, p->w[i * (p->rows + 1)]);
  return most;
}

/* The square root of twice the energy that the changes have in the rows, each by itself. */
static double size_of_change(const frot_impact_problem *p, const int *row_of, const double *change,
                             double most) {
  double size = 0;
  for (int i = 0; i < p->rows; i++) {
    double own = p->w[i * (p->rows + 1)], moved = fabs(change[row_of[i]]);
    size = fmax(size, own > 0 ? moved / sqrt(own) : moved * sqrt(most));
  }
  return size;
}

int frot_add_percussion(const frot_instant *in, const double *change, frot_impact_scene *scene) {
  frot_impact_work *own = &in->w->impacts;
  frot_impact_problem *p = &scene->problem;
  int n = p->rows, wide = n + 1;
  double most = largest_effect(p), size = size_of_change(p, own->row_of, change, most);
  if (!(size > 0)) return 0;
  /* a mass 1/most in the row is stopped within the impulse `whole` */
  double whole = size / sqrt(most);
  for (int i = n - 1; i >= 0; i--) {
    memmove(own->problem + i * wide, own->problem + i * n, sizeof(double) * (size_t)n);
    own->problem[i * wide + n] = change[own->row_of[i]] / whole;
  }
  for (int j = 0; j < n; j++) own->problem[n * wide + j] = 0;
  own->problem[n * wide + n] = most;
  own->before[n] = own->after[n] = -most * whole;
  for (int k = 0; k < p->n_blocks; k++)
    if (own->blocks[k].is_zero) own->blocks[k].restitution = 0;
  own->blocks[p->n_blocks++] = (frot_impact_block){.rule = FROT_ROW_PRESSES, .at = n, .n = 1};
  p->rows = wide, scene->struck = 1;
  return 1;
}

void frot_drop_percussion(const frot_instant *in, frot_impact_scene *scene) {
  if (!scene->struck) return;
  double *w = in->w->impacts.problem;
  int n = scene->problem.rows - 1;
  for (int i = 1; i < n; i++) memmove(w + i * n, w + i * (n + 1), sizeof(double) * (size_t)n);
  scene->problem.rows--, scene->problem.n_blocks--, scene->struck = 0;
}

void frot_apply_impact(const frot_instant *in, const frot_impact_scene *scene, double *v) {
  frot_work *w = in->w;
  memset(w->core.lam, 0, sizeof(double) * (size_t)in->m->n_rows);
  for (int k = 0; k < scene->problem.rows; k++)
    if (!frot_is_reading(in->m, w->impacts.row_of[k]))
      w->core.lam[w->impacts.row_of[k]] = w->impacts.impulse[k];
  frot_speed_changes(in->m, w, w->impacts.changes);
  for (int k = 0; k < in->m->nv; k++) v[k] += w->impacts.changes[k];
}

/* The impulse of a normal row, zero where it is rounding beside the others of the impact. */
static double normal_impulse(const frot_impact_work *own, const frot_impact_problem *p, int k) {
  double most = 0, impulse = own->impulse[own->blocks[k].at];
  for (int j = 0; j < p->n_blocks; j++) {
    int at = own->blocks[j].at;
    if (own->blocks[j].rule == FROT_ROW_PRESSES)
      most = fmax(most, sqrt(p->w[at * (p->rows + 1)]) * own->impulse[at]);
  }
  int at = own->blocks[k].at;
  return sqrt(p->w[at * (p->rows + 1)]) * impulse > FROT_ROUNDING * most ? impulse : 0;
}

double frot_lost_by_contact(const frot_instant *in, const frot_impact_scene *scene, int contact,
                            double *impulse) {
  const frot_impact_work *own = &in->w->impacts;
  double lost = 0;
  *impulse = 0;
  for (int k = 0; k < scene->problem.n_blocks; k++) {
    int of = own->block_of[k];
    if ((of < 0 ? ~of : in->m->elements[of].contact) != contact) continue;
    if (own->blocks[k].rule == FROT_ROW_PRESSES) *impulse = normal_impulse(own, &scene->problem, k);
    lost += own->lost[k];
  }
  return lost;
}

/* Whether the rows of a block hold after an impact; with `settles` also where they would part by
 * what counts as no flight. */
static int stays_zero(const frot_instant *in, const frot_impact_scene *scene, int k, int settles) {
  const frot_impact_work *own = &in->w->impacts;
  const frot_impact_block *block = &scene->problem.blocks[k];
  if (block->rule == FROT_ROW_READS) return 0;
  if (frot_length(own->after + block->at, block->n) == 0) return 1;
  return settles && block->rule == FROT_ROW_PRESSES &&
         frot_is_settled_beside(in, ~own->block_of[k], own->after[block->at]);
}

int frot_settle_beside(const frot_instant *in, const frot_impact_scene *scene) {
  frot_impact_work *own = &in->w->impacts;
  int changed = 0;
  for (int k = 0; k < scene->problem.n_blocks; k++) {
    frot_impact_block *block = &own->blocks[k];
    if (block->rule != FROT_ROW_PRESSES || !(block->restitution > 0)) continue;
    double u = own->after[block->at];
    if (u > 0 && frot_is_settled_beside(in, ~own->block_of[k], u))
      block->restitution = 0, changed = 1;
  }
  if (changed) memcpy(own->after, own->before, sizeof(double) * (size_t)scene->problem.rows);
  return changed;
}

/* Whether all speeds that are held are next to zero: where rows depend on each other those of an
 * impact, found to its tolerance, contradict each other. */
static int are_held(const frot_impact_scene *scene, const frot_contact_block *blocks,
                    const double *before, const double *speed) {
  double most = 0, left = 0;
  for (int i = 0; i < scene->problem.rows; i++) {
    most = fmax(most, fabs(before[i]));
    if (blocks[i].rule == FROT_ROW_HELD) left = fmax(left, fabs(speed[i]));
  }
  return left <= FROT_HELD_SPEED * most;
}

/* The speeds that the impulses make of those before, into `actual`. Returns whether a row that
 * rests by its law, or is to, has one beyond rounding. */
static int moves_at_rest(const frot_impact_scene *scene, const frot_impact_work *own,
                         const frot_contact_block *blocks, double *actual) {
  int rows = scene->problem.rows, moves = 0;
  for (int i = 0; i < rows; i++) {
    double sum = own->before[i], size = fabs(sum);
    for (int j = 0; j < rows; j++) {
      double part = own->problem[i * rows + j] * own->impulse[j];
      sum += part, size += fabs(part);
    }
    actual[i] = sum;
    moves |= blocks[i].rule == FROT_ROW_HELD && fabs(sum) > FROT_ROUNDING * size;
  }
  return moves;
}

int frot_hold_at_rest(const frot_instant *in, const frot_impact_scene *scene, int settles) {
  frot_impact_work *own = &in->w->impacts;
  int rows = scene->problem.rows;
  double *impulse = own->scratch, *speed = impulse + rows, *actual = speed + rows,
         *doubles = actual + rows;
  frot_contact_block *blocks = own->held;
  for (int k = 0; k < scene->problem.n_blocks; k++) {
    const frot_impact_block *block = &scene->problem.blocks[k];
    int given = scene->struck && k == scene->problem.n_blocks - 1;
    int holds = !given && stays_zero(in, scene, k, settles);
    for (int i = block->at; i < block->at + block->n; i++)
      blocks[i] =
          (frot_contact_block){.rule = holds ? FROT_ROW_HELD : FROT_ROW_ABSENT, .at = i, .n = 1};
  }
  if (!moves_at_rest(scene, own, blocks, actual)) return 0;
  frot_contact_equations equations = {rows, rows, own->problem, actual, blocks, 1e-12, NULL};
  memset(impulse, 0, sizeof(double) * (size_t)rows);
  if (frot_contact_newton(&equations, 0, impulse, speed, doubles, own->pivot) &&
      !are_held(scene, blocks, own->before, speed))
    return 1;
  for (int k = 0; k < scene->problem.n_blocks; k++) {
    const frot_impact_block *block = &scene->problem.blocks[k];
    if (block->rule == FROT_ROW_READS) continue;
    for (int i = block->at; i < block->at + block->n; i++) {
      int parts = block->rule == FROT_ROW_PRESSES && own->after[i] > 0 && !(speed[i] > 0);
      own->lost[k] -= 0.5 * impulse[i] * actual[i], own->impulse[i] += impulse[i];
      if (blocks[i].rule == FROT_ROW_HELD)
        own->after[i] = 0;
      else if (!parts)
        own->after[i] = speed[i];
    }
  }
  return 0;
}
