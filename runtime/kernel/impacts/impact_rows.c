#include "impacts/impact_rows.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "modes/zero_slip.h"
#include "numerics/dense.h"

/* The place of a row in the problem: a row is listed once. */
static int place_of(const frot_instant *in, frot_impact_scene *scene, int row, int *is_new) {
  int *rows = in->w->impacts.row_of, n = scene->problem.rows;
  *is_new = 0;
  for (int k = 0; k < n; k++)
    if (rows[k] == row) return k;
  *is_new = 1;
  rows[n] = row, scene->problem.rows = n + 1;
  return n;
}

static frot_impact_block *add_block(const frot_instant *in, frot_impact_scene *scene, int owner,
                                    int rule, int at, int n) {
  int k = scene->problem.n_blocks++;
  in->w->impacts.block_of[k] = owner;
  in->w->impacts.blocks[k] = (frot_impact_block){.rule = rule, .at = at, .n = n};
  return &in->w->impacts.blocks[k];
}

/* The places of the readings that bound an element, one after the other; returns the first. */
static int add_readings(const frot_instant *in, frot_impact_scene *scene, int owner,
                        const frot_element *element, int *count) {
  int first = -1;
  *count = 0;
  for (int k = 0; k < FROT_BOUNDING; k++) {
    if (element->bounded_by[k] < 0) continue;
    int is_new, at = place_of(in, scene, element->bounded_by[k], &is_new);
    if (is_new) add_block(in, scene, owner, FROT_ROW_READS, at, 1);
    if (first < 0) first = at;
    ++*count;
  }
  return first;
}

/* An element whose bound a value of the text gives has no impulse: that is a force. */
static void add_element(const frot_instant *in, frot_impact_scene *scene, int e, int normal) {
  const frot_element *element = &in->m->elements[e];
  frot_work *w = in->w;
  if (element->bound == FROT_BY_VALUE || element->prescribed || !frot_bounds_something(in->m, w, e))
    return;
  int friction = frot_element_mode(in->m, w->search.before, e)->friction, count = 1, is_new;
  int bounding = element->bound == FROT_BY_PIN
                     ? add_readings(in, scene, ~element->contact, element, &count)
                     : normal;
  in->zero[e] = (unsigned char)frot_is_zero_rate(in, e, in->v, friction);
  int at = scene->problem.rows;
  for (int k = 0; k < element->parts; k++) place_of(in, scene, element->row + k, &is_new);
  frot_impact_block *block = add_block(in, scene, e, FROT_ROW_BALL, at, element->parts);
  block->bounding = bounding, block->n_bounding = count;
  block->slipping = w->core.coefficient[2 * e], block->resting = w->core.coefficient[2 * e + 1];
  block->is_zero = in->zero[e];
  for (int k = 0; k < element->parts; k++)
    w->impacts.before[at + k] = in->zero[e] ? 0 : w->core.rate[element->row + k];
}

static void add_contact(const frot_instant *in, frot_impact_scene *scene, int i) {
  const frot_model *m = in->m;
  const frot_contact *contact = &m->contacts[i];
  int normal = -1, is_new;
  if (contact->row_n >= 0) {
    double rate = in->w->core.rate[contact->row_n];
    int rule = contact->reduced         ? FROT_ROW_READS
               : in->unilateral[i] != 0 ? FROT_ROW_PRESSES
                                        : FROT_ROW_HELD;
    normal = place_of(in, scene, contact->row_n, &is_new);
    frot_impact_block *block = add_block(in, scene, ~i, rule, normal, 1);
    const double *flight = in->s->data + in->l.flights + FROT_FLIGHT * i;
    block->law = contact->impact;
    block->restitution = flight[FROT_STAYS_CLOSED] != 0 ? 0 : in->s->data[in->l.restitution + i];
    enum frot_approach approach = frot_approach_of(in, i, &rate);
    in->w->impacts.before[normal] =
        rule == FROT_ROW_PRESSES && approach != FROT_STAYS ? in->w->core.rate[contact->row_n] : 0;
    if (in->w->impacts.meets[i] && !(rate >= scene->rate)) scene->first = i, scene->rate = rate;
  }
  for (int e = 0; e < m->n_elements; e++)
    if (m->elements[e].contact == i && m->elements[e].part == 0) add_element(in, scene, e, normal);
}

void frot_list_impact(const frot_instant *in, const int *chosen, int count, int driver,
                      frot_impact_scene *scene) {
  frot_impact_work *own = &in->w->impacts;
  *scene = (frot_impact_scene){.problem = {0, 0, own->problem, own->blocks}, .first = chosen[0]};
  for (int c = 0; c < count; c++) add_contact(in, scene, chosen[c]);
  int n = scene->problem.rows;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      own->problem[i * n + j] = frot_is_reading(in->m, own->row_of[j])
                                    ? 0
                                    : frot_effect(in->m, in->w, own->row_of[i], own->row_of[j]);
  memcpy(own->after, own->before, sizeof(double) * (size_t)n);
  scene->driver = -1;
  for (int c = 0; c < count; c++) scene->together += own->meets[chosen[c]] || chosen[c] == driver;
  for (int k = 0; k < scene->problem.n_blocks; k++)
    if (own->blocks[k].rule == FROT_ROW_PRESSES && own->block_of[k] == ~driver) scene->driver = k;
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

double frot_lost_by_contact(const frot_instant *in, const frot_impact_scene *scene, int contact,
                            double *impulse) {
  const frot_impact_work *own = &in->w->impacts;
  double lost = 0;
  *impulse = 0;
  for (int k = 0; k < scene->problem.n_blocks; k++) {
    int of = own->block_of[k];
    if ((of < 0 ? ~of : in->m->elements[of].contact) != contact) continue;
    if (own->blocks[k].rule == FROT_ROW_PRESSES) *impulse = own->impulse[own->blocks[k].at];
    lost += own->lost[k];
  }
  return lost;
}

/* Whether a row holds: it is not left by the impact. */
static int stays_zero(const frot_instant *in, const frot_impact_scene *scene, int k,
                      frot_settled settled) {
  const frot_impact_work *own = &in->w->impacts;
  const frot_impact_block *block = &scene->problem.blocks[k];
  if (block->rule == FROT_ROW_READS) return 0;
  if (frot_length(own->after + block->at, block->n) == 0) return 1;
  return block->rule == FROT_ROW_PRESSES && settled(in, ~own->block_of[k], own->after[block->at]);
}

int frot_hold_settled(const frot_instant *in, const frot_impact_scene *scene,
                      frot_settled settled) {
  frot_impact_work *own = &in->w->impacts;
  int rows = scene->problem.rows, held = 0;
  double *impulse = own->scratch, *speed = impulse + rows, *doubles = speed + rows;
  frot_contact_block *blocks = in->w->impacts.held;
  for (int k = 0; k < scene->problem.n_blocks; k++) {
    const frot_impact_block *block = &scene->problem.blocks[k];
    int holds = stays_zero(in, scene, k, settled);
    for (int i = block->at; i < block->at + block->n; i++)
      blocks[i] =
          (frot_contact_block){.rule = holds ? FROT_ROW_HELD : FROT_ROW_ABSENT, .at = i, .n = 1};
    held |= holds && own->after[block->at] != 0;
  }
  if (!held) return 0;
  frot_contact_equations equations = {rows, rows, own->problem, own->after, blocks, 1e-12};
  memset(impulse, 0, sizeof(double) * (size_t)rows);
  if (frot_contact_newton(&equations, 0, impulse, speed, doubles, own->pivot)) return 1;
  for (int k = 0; k < scene->problem.n_blocks; k++) {
    const frot_impact_block *block = &scene->problem.blocks[k];
    for (int i = block->at; i < block->at + block->n; i++) {
      int holds = blocks[i].rule == FROT_ROW_HELD;
      if (block->rule != FROT_ROW_READS) own->lost[k] -= 0.5 * impulse[i] * own->after[i];
      own->impulse[i] += impulse[i], own->after[i] = holds ? 0 : speed[i];
    }
  }
  return 0;
}
