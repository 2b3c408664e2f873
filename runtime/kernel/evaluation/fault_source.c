#include "evaluation/slip_frames.h"
#include "evaluation/fault_source.h"

#include <math.h>
#include <string.h>

#include "evaluation/algebraic_loops.h"
#include "evaluation/evaluate.h"
#include "model/indexing.h"
#include "numerics/tolerances.h"

/* The applied force that is no number at (q, v) and the time of the last evaluation, or -1. */
static int wrong_load(const frot_model *m, frot_state *s, frot_work *w, const double *q,
                      const double *v) {
  double *sizes = w->step.z, *loads = w->call.values;
  if (m->n_loads == 0) return -1;
  frot_inputs(s, w, &w->core.t, q, v, s->data + w->layout.d);
  w->call.res[0] = sizes, w->call.res[1] = loads;
  frot_call(w, &m->sizes);
  for (int i = 0; i < m->n_loads; i++)
    if (!isfinite(loads[i])) return i;
  return -1;
}

/* The equation of the text that gives no number at (q, v, d) and the time of the last evaluation,
 * or -1. */
static int wrong_equation(const frot_model *m, frot_state *s, frot_work *w, const double *q,
                          const double *v, const double *d) {
  if (m->n_watched == 0 || !q) return -1;
  frot_inputs(s, w, &w->core.t, q, v, d);
  w->call.arg[7] = w->core.a, w->call.arg[8] = frot_lam_of_text(m, w);
  w->call.res[0] = w->call.values;
  frot_call(w, &m->watched);
  for (int i = 0; i < m->n_watched; i++)
    if (!isfinite(w->call.values[i])) return i;
  return -1;
}

/* The fault of such an equation. */
static int status_of(const frot_model *m, int equation) {
  return m->equations[equation].lacks ? FROT_INDEX : FROT_NAN;
}

/* The group that kept the last step from being any longer: that without reactions, or of the state
 * whose error was the largest; -1 where that is not known. */
static int group_at_fault(const frot_model *m, const frot_work *w) {
  int state = w->step.worst;
  if (w->reactions.jammed >= 0) return w->reactions.jammed;
  if (state < 0 || state >= m->nq + m->nv) return -1;
  int speed = state < m->nq ? m->q_speed[state] : state - m->nq;
  return speed < 0 ? -1 : m->speed_group[speed];
}

/* The contact of a coefficient that is no number, or of the largest reaction in the group at fault;
 * -1 if none. */
static int wrong_contact(const frot_model *m, const frot_work *w, int status) {
  int blamed = -1, group = status == FROT_NAN ? -1 : group_at_fault(m, w);
  double largest = 0;
  for (int e = 0; e < m->n_elements; e++) {
    const double *k = w->core.coefficient + 2 * e;
    const frot_element *element = &m->elements[e];
    int row = element->bounded_by[0] >= 0 ? element->bounded_by[0] : element->row;
    double size = fabs(w->core.lam[row]);
    if (group >= 0 && m->contact_group[element->contact] != group) continue;
    int wrong = status == FROT_NAN ? isnan(k[0] + k[1]) : size > largest;
    if (wrong) largest = size, blamed = element->contact;
  }
  for (int i = 0; i < m->n_contacts && status != FROT_NAN; i++) {
    int row = m->contacts[i].row_n;
    if (group >= 0 && m->contact_group[i] != group) continue;
    if (row >= 0 && fabs(w->core.lam[row]) > largest) largest = fabs(w->core.lam[row]), blamed = i;
  }
  if (blamed < 0 && group >= 0 && m->groups[group].n_contacts > 0)
    blamed = m->groups[group].contacts[0]; /* no reactions are known */
  return blamed;
}

int frot_group_of_jamming_slip(const frot_model *m, const frot_state *s, const frot_work *w) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  int contact = wrong_contact(m, w, FROT_DIVERGE);
  int group = contact < 0 ? -1 : m->contact_group[contact];
  for (int e = 0; e < m->n_elements && group >= 0; e++)
    if (m->contact_group[m->elements[e].contact] == group &&
        frot_element_mode(m, modes, e)->friction > FROT_STICK)
      return group;
  return -1;
}

/* Whether no speed of its group moves the row of a contact, but for rounding of its lengths. */
static int is_unmoved(const frot_model *m, const frot_state *s, const frot_work *w, int contact) {
  int row = m->contacts[contact].row_n;
  const frot_group *g = frot_group_of(m, row);
  const double *entries = frot_entries(m, w->core.rows, row);
  double least = FROT_CANCELS * s->data[w->layout.reach + contact];
  for (int k = 0; k < g->n_speeds; k++)
    if (fabs(entries[k]) > least) return 0;
  return 1;
}

int frot_contact_opened_by_time(const frot_model *m, frot_state *s, frot_work *w, double t,
                                const double *q, const double *v) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  int apart = -1;
  for (double later = s->h_max; apart < 0 && later <= 100 * s->h_max; later *= 10) {
    if (frot_kinematics(m, s, w, t + later, q, v, s->data + w->layout.d) != FROT_OK) return -1;
    double most = FROT_AGREES;
    for (int i = 0; i < m->n_contacts; i++) {
      const frot_contact *c = &m->contacts[i];
      if (!modes[i].closed || c->reduced || c->row_n < 0 || c->kinematic) continue;
      double reach = s->data[w->layout.reach + i],
             part = fabs(w->core.gap[i]) / (reach > 0 ? reach : 1);
      if (part > most && is_unmoved(m, s, w, i)) most = part, apart = i;
    }
  }
  return apart;
}

int frot_fail_evaluation(const frot_model *m, frot_state *s, frot_work *w, int status, double t) {
  int item = status == FROT_ALGEBRAIC ? w->blocks.failed : -1;
  int other = status == FROT_NAN ? w->blocks.failed : -1, contact = -1;
  for (int e = 0; e < m->n_elements && status == FROT_NAN && other < 0; e++) {
    const double *k = w->core.coefficient + 2 * e;
    if (isnan(k[0] + k[1])) contact = m->elements[e].contact;
  }
  int equation = -1;
  if (status == FROT_NAN && other < 0 && contact < 0)
    equation = wrong_equation(m, s, w, w->core.q, w->core.v, w->core.d);
  if (equation >= 0) item = m->n_loads + equation, status = status_of(m, equation);
  return frot_fail(s, status, t, contact, item, other, w->blocks.singular);
}

int frot_fail_step(const frot_model *m, frot_state *s, frot_work *w, int status, double t, double h,
                   const double *q, const double *v) {
  int equation = -1;
  if (status == FROT_NAN) equation = wrong_equation(m, s, w, q, v, s->data + w->layout.d);
  if (equation >= 0)
    return frot_fail(s, status_of(m, equation), t, -1, m->n_loads + equation, -1, h);
  if (status == FROT_ALGEBRAIC || (status == FROT_NAN && w->blocks.failed >= 0))
    return frot_fail_evaluation(m, s, w, status, t);
  int blamed = wrong_contact(m, w, status), state = -1;
  int load = status == FROT_NAN && blamed < 0 ? wrong_load(m, s, w, q, v) : -1;
  if (status ==
      FROT_DIVERGE) { /* a force may come to where it has no value with a slope without end */
    w->core.t = t + FROT_BEYOND_FAULT * fmax(fabs(t), s->h_max);
    load = wrong_load(m, s, w, q, v);
    if (load >= 0) return frot_fail(s, FROT_NAN, t, -1, load, -1, h);
  }
  int apart = -1;
  if (status == FROT_DIVERGE) apart = frot_contact_opened_by_time(m, s, w, t, q, v);
  if (apart >= 0) return frot_fail(s, status, t, apart, 0, -1, h);
  if (status == FROT_DIVERGE && w->step.worst >= 0 && w->step.worst < m->nq + m->nv) {
    int own = w->step.worst < m->nq && m->q_speed[w->step.worst] < 0;
    if (own) blamed = -1;
    if (own || blamed < 0) state = w->step.worst;
  }
  return frot_fail(s, status, t, blamed, load, state, h);
}

/* What the figures of a liaison have lost at the states z, or -1: the nearest to it. */
static int lost_at(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z) {
  double *distance = w->call.values, *where = distance + m->n_vanishing, least = FROT_TANGENT_LOST;
  int lost = -1;
  if (!frot_all_finite(z, m->nq + m->nv) || !frot_all_finite(w->blocks.y, m->ny)) return -1;
  frot_inputs(s, w, &t, z, z + m->nq, s->data + w->layout.d);
  w->call.res[0] = distance, w->call.res[1] = where;
  frot_call(w, &m->vanishing);
  for (int i = 0; i < m->n_vanishing; i++) {
    double far = isfinite(distance[i]) ? distance[i] : 0;
    if (far < least) least = far, lost = i;
  }
  return lost;
}

int frot_name_singular_figure(const frot_model *m, frot_state *s, frot_work *w, int status,
                              const double *z) {
  int unnamed = status == FROT_NAN && s->fault.item < 0 && s->fault.contact < 0;
  int lost = -1;
  if (m->n_vanishing == 0) return status;
  if (!unnamed && status != FROT_SINGULAR && status != FROT_DIVERGE && status != FROT_ALGEBRAIC &&
      status != FROT_POSTURE)
    return status;
  for (int k = 0; k < 4 && lost < 0; k++) {
    if (k == 2) memcpy(w->blocks.y, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
    lost = lost_at(m, s, w, s->fault.t, k % 2 ? z : s->data + w->layout.x);
  }
  if (lost < 0) return status;
  const double *where = w->call.values + m->n_vanishing + FROT_WHERE * lost;
  frot_fail(s, FROT_VANISHED, s->fault.t, -1, lost, -1, 0);
  memcpy(s->fault.where, where, sizeof s->fault.where);
  return FROT_VANISHED;
}

int frot_name_singular_figure_at(const frot_model *m, frot_state *s, frot_work *w, int status,
                                 double t) {
  int phase = s->phase;
  frot_fault fault = s->fault;
  s->fault = frot_no_fault(t), s->fault.status = status;
  int found = frot_name_singular_figure(m, s, w, status, w->step.z1);
  int named = found == FROT_NAN || found == FROT_ALGEBRAIC;
  if (named && phase != FROT_FAULTED) frot_fail_evaluation(m, s, w, found, t);
  s->phase = phase;
  /* where the run itself has failed, that is what is told */
  if (found != FROT_VANISHED && (!named || phase == FROT_FAULTED)) s->fault = fault;
  return found;
}
