#include "evaluation/slip_frames.h"
#include "events/event_iteration.h"

#include <math.h>
#include <string.h>

#include "evaluation/fault_source.h"
#include "evaluation/algebraic_loops.h"
#include "events/feature_edges.h"
#include "events/modes_read.h"
#include "methods/rate_rounding.h"
#include "model/indexing.h"
#include "guards/conditions.h"
#include "impacts/impacts.h"
#include "impacts/separation.h"
#include "impacts/percussions.h"
#include "methods/right_hand_side.h"
#include "recording/event_log.h"
#include "mode_choice/resolve.h"
#include "events/parameter_change.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

#define SHRINKING \
  3 /* gaps in a row, each shorter than the last in the same ratio: they may have a limit */
#define CROWD 100 /* rounds at one instant after which the events will not settle */

typedef struct {
  const frot_model *m;
  frot_state *s;
  frot_work *w;
  frot_layout l;
  double t, *q, *v;
  frot_recorder *recorder;
} instant;

static frot_contact_mode *modes_of(const instant *in) {
  return (frot_contact_mode *)(void *)(in->s->data + in->l.modes);
}

/* Whether a `when` fires: its condition has come to hold since it was last looked at, at the start
 * it holds. */
static int does_fire(const instant *in, int i, int first) {
  const frot_model *m = in->m;
  int j = m->when_condition[i], holds = in->s->data[in->l.d + j] != 0;
  return holds && (first ? m->when_at_start[i] != 0 : in->w->events.was[j] == 0);
}

/* Those that fire as things are, into w->events.firing. */
static int some_fire(const instant *in, int first) {
  int any = 0;
  for (int i = 0; i < in->m->n_whens; i++) {
    int fires = does_fire(in, i, first);
    in->w->events.firing[i] = fires, any |= fires;
  }
  return any;
}

/* Which `when`s of a rank fire besides those that do, into w->events.firing. */
static int find_firing(const instant *in, int rank, int first) {
  const frot_model *m = in->m;
  const double *d = in->s->data + in->l.d;
  double *was = in->w->events.was;
  int any = 0;
  for (int i = 0; i < m->n_whens; i++) {
    if (m->when_rank[i] != rank || !does_fire(in, i, first)) continue;
    in->w->events.firing[i] = any = 1;
    in->s->data[in->l.fresh + m->when_condition[i]] = 1;
  }
  for (int i = 0; i < m->n_whens; i++)
    if (m->when_rank[i] == rank) was[m->when_condition[i]] = d[m->when_condition[i]];
  return any;
}

/* Contacts that new places or speeds open. One that they close further is an impact; what would be
 * inside, or apart though it cannot part, is a fault: no body is moved back. */
static int release_contacts(const instant *in) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const double *scale = in->s->data + in->l.scale_x + m->nq;
  const double *unilateral = in->s->data + in->l.unilateral;
  frot_contact_mode *modes = modes_of(in);
  for (int i = 0; i < m->n_contacts; i++) {
    const frot_contact *contact = &m->contacts[i];
    int row = contact->row_n;
    if (!frot_has_normal(contact) || contact->reduced) continue;
    double gap = w->core.gap[i], rate = w->core.rate[row],
           near = FROT_TOUCH * (fabs(gap) + frot_gap_size(m, w, row, in->q));
    if (gap < -near) return frot_fail(in->s, FROT_JUMP, in->t, i, -1, FROT_ENTERS, -gap);
    if (!modes[i].closed) continue;
    double usual = frot_row_size(m, w, row, in->v) + frot_row_size(m, w, row, scale);
    int apart = gap > near, leaves = rate > FROT_TOUCH * usual, meets = rate < -FROT_TOUCH * usual;
    if (unilateral[i] == 0 && (apart || leaves || meets))
      return frot_fail(in->s, FROT_JUMP, in->t, i, -1, apart ? FROT_PARTS : FROT_JERKS,
                       apart ? gap : rate);
    if (!apart && !leaves) continue;
    frot_part_contact(m, in->s, in->t, i, in->recorder);
  }
  return FROT_OK;
}

/* Terminations and warnings are kept until they can be told; a failed assertion is a fault. */
static int take_outcomes(const instant *in) {
  const frot_model *m = in->m;
  frot_state *s = in->s;
  int ends = 0;
  for (int i = 0; i < m->n_outcomes; i++) {
    if (in->w->events.outcome[i] == 0) continue;
    if (m->outcomes[i].kind == FROT_OUTCOME_FAULT)
      return frot_fail(s, FROT_EVENT_FAULT, in->t, -1, i, -1, 0);
    if (m->outcomes[i].kind == FROT_OUTCOME_FAIL)
      return frot_fail(s, FROT_ASSERT, in->t, -1, i, -1, 0);
    if (m->outcomes[i].kind == FROT_OUTCOME_MEET)
      return frot_fail(s, FROT_NO_NORMAL, in->t, -1, i, -1, 0);
    s->data[in->l.requested + i] = in->t;
    s->untold = 1;
    if (m->outcomes[i].kind == FROT_OUTCOME_TERMINATE && !ends) ends = 1, s->outcome = i;
  }
  return ends ? FROT_TERMINATED : FROT_OK;
}

/* Tell what has changed since w->events.before. */
static void tell_conditions(const instant *in) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const double *d = in->s->data + in->l.d;
  for (int j = 0; j < m->n_conditions; j++) {
    int holds = d[j] != 0, held = w->events.before[j] != 0;
    if (holds != held) frot_record_condition(m, in->recorder, in->s, in->t, j, holds);
  }
}

/* The first condition whose `when` fires, or the first held value that changes: for a fault. */
static int first_cause(const instant *in) {
  const frot_model *m = in->m;
  for (int i = 0; i < m->n_whens; i++)
    if (in->w->events.firing[i] != 0) return m->when_condition[i];
  const double *held = in->s->data + in->l.d + in->l.nd - m->n_held;
  for (int k = 0; k < m->n_held; k++)
    if (held[k] != in->w->events.held[k]) return m->n_conditions + k;
  return 0;
}

/* What values of a rank were before, for the next round: as `update` has told them. */
static void keep_before(const instant *in, int rank) {
  const frot_model *m = in->m;
  const double *told = in->w->events.discrete + (m->n_discrete - m->n_held);
  for (int k = 0; k < m->n_held; k++)
    if (m->held[k].rank == rank) in->w->events.held[k] = told[k];
}

/* Call `update` at the values known; a discrete value after the event may need others, through the
 * equations: it is called again until they agree. Coordinates and speeds after `reinit` into q and
 * v, what the held values of this rank will be into w->held. */
static int find_values(const instant *in, int rank, double *q, double *v) {
  const frot_model *m = in->m;
  frot_state *s = in->s;
  frot_work *w = in->w;
  double *d = s->data + in->l.d, *discrete = d + m->n_conditions + m->n_contacts;
  size_t size = sizeof(double) * (size_t)(m->n_discrete - m->n_held);
  for (int pass = 0; pass < CROWD; pass++) {
    int status = frot_solution(m, s, w, in->t, in->q, in->v, d, modes_of(in),
                               s->data + in->l.frozen, s->data + in->l.along, 1);
    if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, in->t);
    frot_inputs(s, w, &in->t, in->q, in->v, d);
    w->call.arg[7] = w->core.a, w->call.arg[8] = frot_lam_of_text(m, w),
    w->call.arg[9] = w->events.firing, w->call.arg[10] = w->events.discrete_before;
    w->call.res[0] = q, w->call.res[1] = v, w->call.res[2] = w->events.discrete,
    w->call.res[3] = w->events.outcome;
    frot_call(w, &m->update);
    if (!frot_all_finite(q, m->nq + m->nv) || !frot_all_finite(w->events.discrete, m->n_discrete))
      return frot_fail(s, FROT_NAN, in->t, -1, m->n_loads + m->n_watched + first_cause(in), -1, 0);
    if (pass == 0) keep_before(in, rank);
    if (memcmp(discrete, w->events.discrete, size) == 0) return FROT_OK;
    memcpy(discrete, w->events.discrete, size);
    status = frot_settle_conditions(m, s, w, in->t, in->q, in->v);
    if (status != FROT_OK) return status;
  }
  return frot_fail(s, FROT_CHATTER, in->t, -1, first_cause(in), -1, CROWD);
}

/* The `when`s of one round, rank by rank: those that read what others set come after these. *fires:
 * whether any does. */
static int act_in_order(const instant *in, int first, int *fires, double *q, double *v) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const double *d = in->s->data + in->l.d;
  *fires = 0;
  memset(w->events.firing, 0, sizeof(double) * (size_t)m->n_whens);
  memcpy(w->events.discrete_before, d + m->n_conditions + m->n_contacts,
         sizeof(double) * (size_t)m->n_discrete);
  for (int rank = 0; rank < m->n_ranks; rank++) {
    int more = find_firing(in, rank, first), status = FROT_OK;
    *fires |= more;
    if (more || rank == 0)
      status = find_values(in, rank, q, v);
    else
      keep_before(in, rank);
    if (status != FROT_OK) return status;
  }
  for (int j = 0; j < m->n_conditions; j++)
    if (d[j] == 0) w->events.was[j] = 0; /* what it does has ended it: it may come to hold again */
  return FROT_OK;
}

/* Note the conditions of the `when`s that have moved the states. */
static void note_near(const instant *in) {
  double *near = in->s->data + in->l.near;
  for (int i = 0; i < in->m->n_whens; i++) {
    int j = in->m->when_condition[i];
    if (in->w->events.firing[i] != 0 && j < in->m->n_located) near[j] = 1;
  }
}

/* Apply what the `when`s of a round do; *changed: whether anything was to be done. */
static int update(const instant *in, int first, int *changed) {
  const frot_model *m = in->m;
  frot_state *s = in->s;
  frot_work *w = in->w;
  double *q = w->step.z, *v = w->step.z + m->nq;
  double *held = s->data + in->l.d + in->l.nd - m->n_held;
  size_t held_size = sizeof(double) * (size_t)m->n_held;
  int fires = 0;
  *changed = 0;
  memcpy(w->events.before, s->data + in->l.d, sizeof(double) * (size_t)m->n_conditions);
  int status = act_in_order(in, first, &fires, q, v);
  if (status != FROT_OK) return status;
  *changed = fires || memcmp(held, w->events.held, held_size) != 0;
  if (!*changed) return FROT_OK;
  status = take_outcomes(in);
  if (status != FROT_OK && status != FROT_TERMINATED) return status;
  int ended = status == FROT_TERMINATED;
  int moved = memcmp(in->q, q, sizeof(double) * (size_t)m->nq) != 0 ||
              memcmp(in->v, v, sizeof(double) * (size_t)m->nv) != 0;
  s->jumped |= moved;
  if (moved) note_near(in), frot_forget_rate_rounding(m, s, w);
  memcpy(in->q, q, sizeof(double) * (size_t)m->nq);
  memcpy(in->v, v, sizeof(double) * (size_t)m->nv);
  memcpy(held, w->events.held, held_size);
  status = frot_settle_conditions(m, s, w, in->t, in->q, in->v);
  if (status != FROT_OK) return status;
  tell_conditions(in);
  if (ended) return FROT_TERMINATED;
  return moved ? release_contacts(in) : FROT_OK;
}

/* Whether a `when` fires that has moved the states before, and whose condition has since then not
 * been clear of zero: its next events are nothing but rounding. */
static int comes_unseen(const instant *in) {
  const double *near = in->s->data + in->l.near;
  for (int i = 0; i < in->m->n_whens; i++) {
    int j = in->m->when_condition[i];
    if (in->w->events.firing[i] != 0 && j < in->m->n_located && near[j] != 0) return 1;
  }
  return 0;
}

/* Whether the text's events crowd before a limit (a ball that bounces): rounding would hide the
 * last of them, and what follows would be wrong. */
static int crowds(const instant *in) {
  frot_state *s = in->s;
  double t = in->t, gap = t - s->text_event;
  if (!(gap > 0)) return 0;
  if (comes_unseen(in)) return 1;
  double ratio = s->text_gap > 0 ? gap / s->text_gap : 1;
  int same = fabs(ratio - s->text_ratio) <= FROT_ONE_RATIO * ratio;
  if (!(ratio < 1) || (s->shrinking > 1 && !same)) s->shrinking = 0;
  if (s->shrinking++ == 0) s->text_first = gap;
  s->text_event = t, s->text_gap = gap, s->text_ratio = ratio;
  return s->shrinking > SHRINKING && gap < FROT_CROWDED * s->text_first;
}

/* Fire `when`s until none fires and no held value changes. *happened: whether any did. */
static int fire_whens(const instant *in, int first, int *happened) {
  const frot_model *m = in->m;
  frot_state *s = in->s;
  const double *d = s->data + in->l.d;
  double before[3], after[3];
  int ended = FROT_OK;
  *happened = 0;
  memcpy(in->w->events.was, in->w->events.before, sizeof(double) * (size_t)m->n_conditions);
  for (int round = 0;; round++) {
    int changed = 0, begins = first && round == 0, fires = some_fire(in, begins);
    if (!fires && m->n_held == 0) break;
    if (round == CROWD) return frot_fail(s, FROT_CHATTER, in->t, -1, first_cause(in), -1, round);
    if (round == 0 && fires && crowds(in))
      return frot_fail(s, FROT_CHATTER, in->t, -1, first_cause(in), -1, FROT_EVER_SOONER);
    int status = FROT_OK;
    if (round == 0) status = frot_energies(m, s, in->w, in->t, in->q, in->v, d, before);
    if (status != FROT_OK) return frot_fail_evaluation(in->m, s, in->w, status, in->t);
    ended = update(in, begins, &changed);
    *happened |= changed;
    if (ended != FROT_OK && ended != FROT_TERMINATED) return ended;
    if (!changed || ended != FROT_OK) break;
  }
  if (!*happened) return FROT_OK;
  /* what the text gives or takes is no part of the balance of the motion */
  int status = frot_energies(m, s, in->w, in->t, in->q, in->v, d, after);
  if (status != FROT_OK) return frot_fail_evaluation(in->m, s, in->w, status, in->t);
  s->energy += after[0] + after[1] - before[0] - before[1];
  return ended;
}

static int end_run(const instant *in) {
  in->s->phase = FROT_ENDED;
  memset(in->s->data + in->l.fired, 0, sizeof(double) * (size_t)in->l.nf);
  return FROT_TERMINATED;
}

/* Change the conditions that fired, and those that follow from them. */
static int change_conditions(const instant *in, int first) {
  const frot_model *m = in->m;
  frot_state *s = in->s;
  const double *d = s->data + in->l.d;
  if (m->n_conditions == 0) return FROT_OK;
  int status = frot_note_conditions(m, s, in->w, in->t, in->q, in->v);
  if (status != FROT_OK) return status;
  int kept = !first && m->n_invariants > 0;
  if (kept) status = frot_note_contacts_before_change(m, s, in->w, in->t, in->q, in->v);
  if (status != FROT_OK) return status;
  memcpy(in->w->events.before, d, sizeof(double) * (size_t)m->n_conditions);
  int edges = !first && frot_has_edges(m);
  if (edges) frot_note_normals(m, in->w);
  s->jumped = 0;
  status = frot_change_conditions(m, s, in->w, in->t, in->q, in->v);
  if (status != FROT_OK) return status;
  memset(s->data + in->l.fresh, 0, sizeof(double) * (size_t)m->n_conditions);
  if (!first) status = frot_settle_conditions(m, s, in->w, in->t, in->q, in->v);
  if (status == FROT_OK && edges)
    status = frot_pass_edges(m, s, in->w, in->t, in->q, in->v, in->recorder);
  if (status == FROT_OK) tell_conditions(in);
  if (status == FROT_OK && kept) status = frot_check_switch(m, s, in->w, in->t, in->q, in->v);
  return status;
}

/* Whether the modes found have changed what is read of them, or conditions on the solution. */
static int look_again(const instant *in, int *changed, int *turned) {
  const frot_model *m = in->m;
  const double *d = in->s->data + in->l.d;
  size_t size = sizeof(double) * (size_t)m->n_conditions;
  memcpy(in->w->events.before, d, size);
  *changed = frot_read_modes(in->m, in->s, turned);
  if (!*changed && m->n_sensed == 0) return FROT_OK;
  int status = frot_settle_conditions(m, in->s, in->w, in->t, in->q, in->v);
  *changed |= memcmp(in->w->events.before, d, size) != 0;
  return status;
}

/* Let the text see the modes found: conditions that follow from them, what these fire, and the
 * modes that hold then, until none changes; none does where a law opens the contact on which it
 * acts. At the start nothing fires by it. */
static int follow_modes(const instant *in, int first) {
  const frot_model *m = in->m;
  /* at the start of the run nothing is known of what nothing was solved for */
  for (int j = m->n_located - m->n_sensed; first && j < m->n_located; j++)
    in->w->events.known[j] = NAN;
  for (int round = 0;; round++) {
    int happened = 0, changed = 0, turned = -1, status = look_again(in, &changed, &turned);
    if (status != FROT_OK || !changed) return status;
    if (round == CROWD)
      return frot_fail(in->s, turned < 0 ? FROT_CHATTER : FROT_IMPASSE, in->t, turned,
                       turned < 0 ? 0 : -1, -1, round);
    if (!first) tell_conditions(in);
    if (!first && (m->n_whens > 0 || m->n_held > 0)) status = fire_whens(in, 0, &happened);
    if (status != FROT_OK) return status;
    status = frot_resolve(m, in->s, in->w, in->t, in->q, in->v, first, in->recorder);
    if (status != FROT_OK) return status;
  }
}

int frot_process_events(const frot_model *m, frot_state *s, frot_work *w, double t, double *q,
                        double *v, int first, frot_recorder *recorder) {
  instant in = {m, s, w, w->layout, t, q, v, recorder};
  int happened = 0, struck = 0, status = FROT_OK;
  frot_expect_openings(m, s);
  if (first) status = frot_meet_and_resolve(m, s, w, t, q, v, 1, recorder);
  if (first && status == FROT_OK) status = follow_modes(&in, 1);
  if (status == FROT_OK) status = change_conditions(&in, first);
  if (status != FROT_OK) return status;
  if (m->n_whens > 0 || m->n_held > 0) status = fire_whens(&in, first, &happened);
  if (status == FROT_TERMINATED) return end_run(&in);
  if (status == FROT_OK) status = frot_strike(m, s, w, t, q, v, &struck, recorder);
  if (status == FROT_OK && (!first || happened || struck))
    status = frot_meet_and_resolve(m, s, w, t, q, v, first, recorder);
  if (status == FROT_OK) status = follow_modes(&in, 0);
  if (status == FROT_TERMINATED) return end_run(&in);
  if (status == FROT_OK) frot_find_time_event(m, s, w);
  return status;
}
