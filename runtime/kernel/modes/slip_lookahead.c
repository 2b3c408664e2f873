/* The slips a little later, where the accelerations of an instant say nothing of them.
 *
 * In a dead centre no speed moves the slip: its row is zero there, or depends on the rows that
 * hold, but only in this posture. Whether it slips, and in which direction, shows when the
 * mechanism has moved on: one step with the accelerations as they are, put back onto what holds for
 * certain. Where loads only begin to pass what friction can hold, these are the accelerations of a
 * little later. */
#include <math.h>
#include <string.h>

#include "modes/contact_components.h"
#include "evaluation/evaluate.h"
#include "reactions/force_problem.h"
#include "constraints/projection.h"
#include "reactions/reactions.h"
#include "modes/enumeration.h"
#include "evaluation/term_sizes.h"
#include "evaluation/quaternions.h"
#include "numerics/tolerances.h"

#define SEEN 1e-6 /* part of the motion in the row above which it slips */
/* The posture may be next to the one in which no speed moves a slip: what slips far on may do so
 * the other way before. How far it moves then, and the part of what its row turns by meanwhile
 * from which on that is seen. */
#define NEAR 1e-10
#define CLEAR 0.1

int frot_group_rests(const frot_instant *in, const frot_group *g) {
  double size = frot_size_of_motion(in->m, in->w, g), limit = FROT_AGREES * size;
  double unresolved = DBL_EPSILON * frot_size_of_time(in->t, in->s->h_max) * size;
  double energy = FROT_ZERO * FROT_ZERO * in->s->energy_scale + 0.5 * unresolved * unresolved;
  return 0.5 * frot_square_of(in->w, g, in->v) <= energy &&
         frot_square_of(in->w, g, in->w->core.a) <= limit * limit;
}

/* A length of the group: that of what its gaps are made of; of coordinates where it has no gaps. */
static double length_of(const frot_instant *in, const frot_group *g) {
  const frot_model *m = in->m;
  double gaps = 0, places = 0;
  for (int i = 0; i < g->n_contacts; i++)
    gaps = fmax(gaps, in->s->data[in->l.reach + g->contacts[i]]);
  for (int k = 0; k < g->n_speeds; k++) {
    int coordinate = m->speed_coordinate[g->unknowns[k]];
    if (coordinate >= 0 && !m->speed_turns[g->unknowns[k]])
      places = fmax(places, fabs(in->q[coordinate]));
  }
  return gaps > 0 ? gaps : places > 0 ? places : 1;
}

double frot_time_of_way(const frot_instant *in, const frot_group *g, double part) {
  const frot_model *m = in->m;
  double shortest = INFINITY, length = length_of(in, g);
  for (int k = 0; k < g->n_speeds; k++) {
    int speed = g->unknowns[k];
    double v = fabs(in->v[speed]), a = fabs(in->w->core.a[speed]);
    double way = part * (m->speed_turns[speed] ? 1 : length);
    if (v == 0 && a == 0) continue;
    shortest = fmin(shortest, 2 * way / (v + sqrt(v * v + 2 * a * way)));
  }
  return isfinite(shortest) ? shortest : 0;
}

/* Whether an element that is at its bound, if it is, is held for certain: several of these hold a
 * row of the group together. */
static int rests_at_bound(const frot_instant *in, const frot_group *g, int e) {
  int row = in->m->elements[e].row;
  return frot_element_mode(in->m, in->w->search.trial, e)->at_bound == 0 ||
         (!g->general && frot_group_of(in->m, row) == g && in->w->span.kept[row]);
}

/* Note which rows that hold in `modes` the others hold, in w->reactions.carried. Returns whether
 * they agree. */
static int note_carried(const frot_instant *in, const frot_group *g,
                        const frot_contact_mode *modes) {
  frot_problem p = {.m = in->m, .w = in->w, .g = g, .modes = modes};
  frot_list_unknowns(&p, in->resists);
  in->w->span.rank = 0;
  return p.unknowns == 0 || !frot_hold_rows(&p);
}

/* The modes of what holds for certain: by a reaction, in this posture and the next. What a contact
 * that carries nothing leaves to friction is not: it is closed all the same, and which of the two
 * depends on the other shows only where both may act: whether they have reactions by themselves,
 * and with them what is at its bound, is not asked. Returns FROT_OK, or what has none in the trial.
 */
static int keep_certain(const frot_instant *in, const frot_group *g, frot_contact_mode *modes) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  int unloaded = 0, status = FROT_OK;
  memcpy(modes, w->search.trial, sizeof *modes * (size_t)(m->n_contacts + m->n_elements));
  for (int i = 0; i < g->n_contacts; i++) {
    unloaded |= modes[g->contacts[i]].unloaded;
    modes[g->contacts[i]].unloaded = 0;
  }
  for (int e = 0; e < m->n_elements; e++) {
    frot_contact_mode *mode = modes + m->n_contacts + e;
    if (mode->friction != FROT_STICK || !rests_at_bound(in, g, e)) mode->friction = FROT_NONE;
  }
  if (unloaded && !note_carried(in, g, modes)) status = FROT_DIVERGE;
  for (int i = 0; i < g->n_elements; i++) { /* of other groups nothing is known */
    int e = g->elements[i];
    if (modes[m->n_contacts + e].at_bound == 0 && w->reactions.carried[m->elements[e].row])
      modes[m->n_contacts + e].friction = FROT_NONE;
  }
  if (unloaded && frot_group_reactions(m, w, g, w->search.trial, in->resists))
    status = FROT_DIVERGE;
  return status;
}

/* Move on by dt, put back onto what holds for certain, and see there what slips by more than the
 * part `seen` of the motion in its row: a sign for each element of the group into `ahead`, 0 where
 * there is none; of those that `among` (may be NULL) has a sign for. */
static int look(const frot_instant *in, const frot_group *g, double dt, double seen,
                const signed char *among, signed char *ahead) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const double *d = in->s->data + in->l.d;
  double *q = w->step.z1, *v = q + m->nq;
  memcpy(q, in->q, sizeof(double) * (size_t)m->nq);
  memcpy(v, in->v, sizeof(double) * (size_t)m->nv);
  for (int k = 0; k < g->n_speeds; k++) {
    int speed = g->unknowns[k];
    w->relations.step[k] = v[speed] + 0.5 * dt * w->core.a[speed];
    v[speed] += dt * w->core.a[speed];
  }
  frot_displace(m, g, q, w->relations.step, dt);
  int moved, status = frot_project(m, in->s, w, in->t + dt, q, v, d, w->search.guess_ahead, NULL,
                                   NULL, &moved);
  if (status == FROT_OK) status = frot_kinematics(m, in->s, w, in->t + dt, q, v, d);
  for (int i = 0; i < g->n_elements && status == FROT_OK; i++) {
    int e = g->elements[i], row = m->elements[e].row;
    double own = frot_row_speed(m, w, row, v), rate = w->core.rate[row];
    double beside = m->row_beside[row] < 0 ? 0 : frot_row_speed(m, w, m->row_beside[row], v);
    if ((!among || among[e] != 0) && fabs(rate) > seen * fmax(own, beside))
      ahead[e] = rate > 0 ? 1 : -1;
  }
  return status;
}

int frot_look_ahead(const frot_instant *in, const frot_group *g) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  signed char *ahead = w->search.ahead;
  memset(ahead, 0, (size_t)m->n_elements);
  frot_move_beside_others(in, g);
  if (frot_group_rests(in, g) && !frot_sets_out(in, g)) return FROT_OK;
  double near = frot_time_of_way(in, g, NEAR), far = frot_time_of_way(in, g, FROT_WAY);
  if (!(far > 0)) return FROT_OK;
  int status = keep_certain(in, g, w->search.guess_ahead);
  if (status == FROT_OK) status = look(in, g, far, SEEN, NULL, ahead);
  if (status == FROT_OK) status = look(in, g, near, CLEAR * NEAR, ahead, ahead);
  int back = frot_kinematics(m, in->s, w, in->t, in->q, in->v, in->s->data + in->l.d);
  return status == FROT_OK ? back : status;
}
