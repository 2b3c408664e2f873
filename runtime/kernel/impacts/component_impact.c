#include "impacts/component_impact.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "evaluation/fault_source.h"
#include "impacts/accumulation.h"
#include "impacts/separation.h"
#include "methods/rate_rounding.h"
#include "numerics/dense.h"
#include "reactions/switching_functions.h"
#include "modes/zero_slip.h"
#include "recording/event_log.h"

/* Part of what impulses do to a slip below which it is what the integration of the impact leaves.
 */
#define NO_SLIP 1e-11

/* Record the event of a contact that has taken an impulse. */
static void record_impact(const frot_instant *in, int i, int driver, const frot_impact_scene *scene,
                          frot_recorder *recorder) {
  const frot_contact_mode *modes = (const void *)(in->s->data + in->l.modes);
  double impulse, lost = frot_lost_by_contact(in, scene, i, &impulse);
  if (!(impulse > 0)) return;
  frot_record_settled_contacts(in->m, in->s, in->t, i, recorder);
  double *flight = frot_flight_of(in->s, &in->l, i);
  int last = in->w->impacts.meets[i] && flight[FROT_STAYS_CLOSED] != 0;
  frot_event event = {.t = in->t,
                      .kind = i == driver ? FROT_EVENT_TANGENTIAL_IMPACT
                              : last      ? FROT_EVENT_LAST_IMPACT
                                          : FROT_EVENT_IMPACT,
                      .contact = i,
                      .before = frot_mode_value(in->m, in->w->search.before, i),
                      .after = frot_mode_value(in->m, modes, i),
                      .solutions = scene->phases,
                      .together = scene->together,
                      .impulse = impulse,
                      .lost = lost,
                      .until = last ? flight[FROT_ENDS_AT] : 0};
  if (in->s->phase != FROT_CLEARED) {
    frot_record_whole_event(recorder, in->s, &event);
    return;
  }
  /* at the start there is no recorder yet: the first frot_advance records it */
  flight[FROT_START_KIND] = event.kind, flight[FROT_START_IMPULSE] += impulse;
  flight[FROT_START_LOST] += lost, in->s->several = 1;
}

/* The size of what impulses, each by itself, do to the rows of a block. */
static double change_of(const frot_impact_scene *scene, const frot_impact_work *own,
                        const frot_impact_block *block) {
  int rows = scene->problem.rows;
  double most = 0;
  for (int i = block->at; i < block->at + block->n; i++) {
    double sum = 0;
    for (int j = 0; j < rows; j++) sum += fabs(scene->problem.w[i * rows + j] * own->impulse[j]);
    most = fmax(most, sum);
  }
  return most;
}

/* The modes that an impact leaves: contacts that part are open, and elements at rest that slip are
 * no more at rest; those of a contact that closes without slip are at rest. */
static void set_modes(const frot_instant *in, const frot_impact_scene *scene,
                      frot_recorder *recorder) {
  const frot_model *m = in->m;
  const frot_impact_work *own = &in->w->impacts;
  frot_contact_mode *modes = (void *)(in->s->data + in->l.modes);
  for (int k = 0; k < scene->problem.n_blocks; k++) {
    const frot_impact_block *block = &own->blocks[k];
    double u = own->after[block->at];
    int e = own->block_of[k], i = ~e;
    if (block->rule == FROT_ROW_PRESSES && modes[i].closed && u > 0) {
      frot_part_contact(m, in->s, in->t, i, recorder);
    }
    if (block->rule != FROT_ROW_BALL) continue;
    frot_contact_mode *mode = &modes[m->n_contacts + e];
    double slip = frot_length(own->after + block->at, block->n);
    if (!modes[m->elements[e].contact].closed) {
      /* where nothing moves any more no size of speeds tells slip from rounding */
      if (slip <= NO_SLIP * change_of(scene, own, block)) mode->friction = FROT_STICK;
      continue;
    }
    if (mode->friction != FROT_STICK || !(slip > 0)) continue;
    frot_forget_guards(m, in->s, frot_element_guard(m, e), FROT_ELEMENT_GUARDS);
    for (int c = 0; c < block->n; c++) mode[c] = (frot_contact_mode){.friction = FROT_NONE};
    mode->friction = (signed char)(block->n > 1 || u > 0 ? FROT_SLIP_FORWARD : FROT_SLIP_BACKWARD);
  }
}

int frot_act_on_component(const frot_instant *in, const int *chosen, int count, int driver,
                          int settles, frot_impact_scene *scene, double *v, double *lost,
                          frot_recorder *recorder) {
  frot_impact_work *own = &in->w->impacts;
  int failed;
  do {
    failed = frot_solve_impact(&scene->problem, scene->driver, own->after, own->impulse, own->lost,
                               &scene->phases, own->scratch, own->pivot);
  } while (!failed && settles && frot_settle_beside(in, scene));
  if (!failed) failed = frot_hold_at_rest(in, scene, settles);
  frot_drop_percussion(in, scene);
  if (failed) return frot_fail(in->s, FROT_IMPACT, in->t, scene->first, -1, -1, scene->rate);
  frot_apply_impact(in, scene, v);
  for (int k = 0; k < scene->problem.n_blocks; k++) *lost += own->lost[k];
  set_modes(in, scene, recorder);
  for (int c = 0; c < count; c++) record_impact(in, chosen[c], driver, scene, recorder);
  return FROT_OK;
}

void frot_count_energy(const frot_instant *in, double before, double lost, const double *v) {
  double *quadratures = in->s->data + in->l.x + in->m->nq + in->m->nv;
  quadratures[0] += lost;
  quadratures[1] += frot_kinetic(in->m, in->w, v) - before + lost;
  frot_forget_rate_rounding(in->m, in->s, in->w);
}

int frot_evaluate_closable(frot_instant *in, int first) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  size_t modes = sizeof *w->search.best * (size_t)(m->n_contacts + m->n_elements);
  memcpy(w->search.before, in->s->data + in->l.modes, modes);
  memset(w->search.zero, 0, (size_t)m->n_elements);
  int status = frot_kinematics(m, in->s, w, in->t, in->q, in->v, in->s->data + in->l.d);
  frot_list_closable(in, first);
  memset(w->search.best + m->n_contacts, 0, sizeof *w->search.best * (size_t)m->n_elements);
  return status;
}

int frot_choose_component(const frot_instant *in, int root) {
  int count = 0;
  for (int i = 0; i < in->m->n_contacts; i++)
    if (in->w->search.component[i] == root) in->w->search.chosen[count++] = i;
  return count;
}
