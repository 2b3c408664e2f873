/* What rounding does to derivatives: see error_estimate.h. */
#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "stepping/error_estimate.h"
#include "model/indexing.h"
#include "reactions/switching_functions.h"
#include "inertia/mass_matrix.h"
#include "numerics/dense.h"
#include "methods/right_hand_side.h"
#include "methods/error_scales.h"
#include "methods/dormand_prince.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

/* Part of what rounding may make of terms at most that it usually makes. */
#define USUAL 0.25
/* What is left of an older measure by a new one: a few samples of rounding may all be small. Of the
 * rate of a state that no inertia smooths, in a later step, so much of that: as it dies out its
 * terms fade as fast as what it is worth (error_scales.c). */
#define BEFORE 0.5
#define FADED 0.2
/* Rows of the dense output's stages, which are made later, and vectors of that output: scratch. */
enum { BASE = DP_STAGES + 1, FORTH, BACK };
enum { LARGEST, SIZE, MOVED };
/* Stages near the start of a step, and how much farther than their slopes lead it may end. */
#define FIRST_STAGES 3
#define ASTRAY 1e3

/* How much larger noise has shown itself than it was measured. */
static double level(const frot_state *s) { return s->noise_level > 1 ? s->noise_level : 1; }

/* What rounding of their terms brings to accelerations at the place z, right after an evaluation
 * there, however small they are: where terms cancel, it is not seen by moving the values. Those
 * with a `largest` above it are left. */
static void add_rounding(const frot_model *m, frot_state *s, frot_work *w, double t,
                         const double *z, const double *largest) {
  double *noise = s->data + w->layout.noise, *size = w->relations.residual;
  frot_acceleration_sizes(m, s, w, t, z, z + m->nq, s->data + w->layout.d, size);
  for (int j = 0; j < w->awake.n - FROT_QUADRATURES; j++) {
    int state = w->awake.now->states[j];
    if (state < m->nq) continue;
    double rounding = FROT_ROUNDING * size[state - m->nq];
    if (largest && largest[j] > FROT_NOISE_MARGIN * rounding) continue;
    noise[state] = fmax(noise[state], fmax(largest ? 1 : 0, USUAL * level(s)) * rounding);
  }
}

/* The same of the rates of states that are no coordinates, by their own terms at z. What it makes
 * of these states in a step h is part of their values: raises `size`. */
static void add_rounding_of_rates(const frot_model *m, frot_state *s, frot_work *w, double t,
                                  double h, const double *z, double *size) {
  double *noise = s->data + w->layout.noise, *terms = w->step.f + MOVED * w->layout.nz;
  if (!m->terms.call || s->implicit) return;
  frot_inputs(s, w, &t, z, z + m->nq, s->data + w->layout.d);
  w->call.res[0] = terms;
  frot_call(w, &m->terms);
  for (int j = 0; j < m->nq; j++) {
    if (!isfinite(terms[j]) || !frot_is_small(m, s, w, j)) continue;
    double rounding = USUAL * FROT_ROUNDING * terms[j];
    noise[j] = fmax(noise[j], level(s) * rounding);
    size[j] = fmax(size[j], h * rounding / FROT_NUDGE);
  }
}

/* The largest of coordinates and speeds: of what turns, of what moves. */
typedef struct {
  double coordinate[2], speed[2];
} largest_of;

static void take_larger(largest_of *to, const largest_of *from) {
  for (int k = 0; k < 2; k++) {
    to->coordinate[k] = fmax(to->coordinate[k], from->coordinate[k]);
    to->speed[k] = fmax(to->speed[k], from->speed[k]);
  }
}

static largest_of own_largest(const frot_model *m, const frot_work *w, int speed) {
  largest_of own = {{0, 0}, {0, 0}};
  int turns = m->speed_turns[speed] != 0, at = m->speed_coordinate[speed];
  own.speed[turns] = fabs(w->step.z0[m->nq + speed]);
  if (at >= 0) own.coordinate[turns] = fabs(w->step.z0[at]);
  return own;
}

static void raise_size(const frot_model *m, int speed, const largest_of *by, double *size) {
  int turns = m->speed_turns[speed] != 0, at = m->speed_coordinate[speed];
  size[m->nq + speed] = fmax(size[m->nq + speed], by->speed[turns]);
  if (at >= 0) size[at] = fmax(size[at], by->coordinate[turns]);
}

/* Each step of a tree shares inertia with what it carries, looked through inwards, and with what
 * carries it, outwards. */
static void note_in_tree(const frot_model *m, frot_work *w, const frot_group *g, double *size) {
  largest_of *found = (largest_of *)(void *)w->core.twist;
  for (int outwards = 0; outwards < 2; outwards++) {
    memset(found, 0, sizeof(largest_of) * (size_t)g->n_links);
    for (int i = 0; i < g->n_links; i++) {
      int k = outwards ? i : g->n_links - 1 - i;
      const frot_link *s = &g->links[k];
      if (outwards && s->above >= 0) found[k] = found[s->above];
      for (int j = 0; j < s->count && !s->auxiliary; j++) {
        largest_of own = own_largest(m, w, g->unknowns[s->first + j]);
        take_larger(&found[k], &own);
      }
      for (int j = 0; j < s->count && !s->auxiliary; j++)
        raise_size(m, g->unknowns[s->first + j], &found[k], size);
      if (!outwards && s->above >= 0) take_larger(&found[s->above], &found[k]);
    }
  }
}

static void note_in_matrix(const frot_model *m, frot_work *w, const frot_group *g, double *size) {
  double *column = w->core.rest;
  for (int k = 0; k < g->n_speeds; k++) {
    int carrier = g->unknowns[k];
    largest_of own = own_largest(m, w, carrier);
    frot_whole_column(w, g, k, column);
    for (int l = 0; l < g->n_speeds; l++)
      if (column[l] != 0) raise_size(m, g->unknowns[l], &own, size);
  }
}

/* Raise what a turn made of the items of an orientation: a rotation by an angle moves them by half
 * of it at most. */
static void raise_turns(const frot_model *m, const frot_group *g, const double *angle,
                        double *size) {
  for (int i = 0; i < m->n_turns; i++) {
    const frot_turn *turn = &m->turns[i];
    if (&m->groups[m->speed_group[turn->speed[2]]] != g) continue;
    double most = 0;
    for (int k = 0; k < 3; k++)
      if (turn->speed[k] >= 0) most = fmax(most, angle[m->speed_local[turn->speed[k]]]);
    for (int k = 0; k < 4; k++) size[turn->at + k] = fmax(size[turn->at + k], 0.5 * most);
  }
}

/* Coordinates and speeds that a row keeps are known to the rounding of its gap and its rate: both
 * are put onto the row by the least change, A^-1 J' (J A^-1 J')^-1 of what is missed. */
static void note_row(const frot_model *m, const frot_state *s, frot_work *w, int contact,
                     double *size) {
  int row = m->contacts[contact].row_n;
  const frot_group *g = frot_group_of(m, row);
  const double *entries = frot_entries(m, w->core.rows, row), *z = w->step.z0;
  double *change = w->core.rest, *angle = w->relations.step, rate = 0;
  double gap = frot_size_of_gap(m, s, w, contact, z);
  for (int k = 0; k < g->n_speeds; k++) rate += fabs(entries[k] * z[m->nq + g->unknowns[k]]);
  memcpy(change, entries, sizeof(double) * (size_t)g->n_speeds);
  frot_inwards(w, g, change);
  double own = frot_dot(change, change, g->n_speeds);
  if (!(own > 0)) return;
  frot_outwards(w, g, change);
  for (int k = 0; k < g->n_speeds; k++) {
    int speed = g->unknowns[k], at = m->speed_coordinate[speed];
    double part = fabs(change[k]) / own;
    size[m->nq + speed] = fmax(size[m->nq + speed], part * rate);
    if (at >= 0) size[at] = fmax(size[at], part * gap);
    angle[k] = part * gap;
  }
  raise_turns(m, g, angle, size);
}

static void note_rows(const frot_model *m, const frot_state *s, frot_work *w, double *size) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_contacts; k++) {
    const frot_contact *c = &m->contacts[now->contacts[k]];
    int kept = modes[now->contacts[k]].closed && c->row_n >= 0 && !c->reduced && !c->kinematic;
    if (kept && !frot_group_of(m, c->row_n)->general) note_row(m, s, w, now->contacts[k], size);
  }
}

/* Sizes of what rounding moves: of a value itself, and of a coordinate or speed the largest of its
 * kind among those that its inertia is shared with. For bodies carried by bodies are placed by sums
 * of these, in which a small one is no better than the largest. What rows keep is no better than
 * the lengths that they are made of. */
static void note_neighbours(const frot_model *m, const frot_state *s, frot_work *w, double *size) {
  for (int j = 0; j < m->nq + m->nv; j++) size[j] = fabs(w->step.z0[j]);
  for (int i = 0; i < w->awake.now->n_groups; i++) {
    const frot_group *g = &m->groups[w->awake.now->groups[i]];
    if (g->n_links > 0)
      note_in_tree(m, w, g, size);
    else if (!g->general)
      note_in_matrix(m, w, g, size);
  }
  note_rows(m, s, w, size);
}

/* What rounding of rates makes of speeds, and of states that have always been zero, in the stages
 * of a step h: what leaves zero in it is no larger there at first, whatever moves by it. Of speeds
 * only the rounding of their terms counts, right after add_rounding: what was measured before holds
 * the effect of such changes already, and would grow from measure to measure. Where the terms of
 * rates are known, add_rounding_of_rates has done so for the states. */
static void add_rounding_of_stages(const frot_model *m, const frot_state *s, const frot_work *w,
                                   double h, double *size) {
  const double *noise = s->data + w->layout.noise, *most = s->data + w->layout.scale_x;
  const double *terms = w->relations.residual;
  for (int j = 0; j < w->awake.n - FROT_QUADRATURES && m->nv > 0 && !s->implicit; j++) {
    int state = w->awake.now->states[j];
    int begins = state < m->nq && m->q_speed[state] < 0 && most[state] == 0 && !m->terms.call;
    double rounding = 0;
    if (state >= m->nq) rounding = USUAL * level(s) * FROT_ROUNDING * terms[state - m->nq];
    if (begins) rounding = noise[state];
    size[state] = fmax(size[state], h * rounding / FROT_NUDGE);
  }
}

static int slope_from_start(const frot_model *m, frot_state *s, frot_work *w, double t,
                            const double *z, double *slope) {
  memcpy(w->blocks.y, s->data + w->layout.y, sizeof(double) * (size_t)m->ny);
  return frot_slope(m, s, w, t, z, slope);
}

/* Whether the step that ran ends where its first slopes do not lead: one that is far too long may
 * end anywhere, and what terms are made of there says nothing. */
static int strays(const frot_model *m, frot_state *s, const frot_work *w, double t) {
  double h = fabs(t - *frot_segment_at(m, s->data + w->layout.segment).t1), way = 0, fastest = 0;
  for (int j = 0; j < w->awake.n - FROT_QUADRATURES; j++) {
    int state = w->awake.now->states[j];
    if (state < m->nq) continue;
    way = fmax(way, fabs(w->step.z1[state] - w->step.z0[state]));
    for (int i = 0; i < (s->implicit ? 1 : FIRST_STAGES); i++)
      fastest = fmax(fastest, fabs(frot_stage(w, i)[j]));
  }
  return !(way <= ASTRAY * h * fastest);
}

/* The real parameters moved apart as values are, up and down in turn. */
static void move_parameters(const frot_model *m, frot_state *s, const frot_work *w, double part) {
  double *p = s->data + w->layout.p;
  for (int k = 0; k < m->np; k++)
    if (m->p_type[k] == FROT_REAL) p[k] = w->step.parameters[k] * (1 + (k & 1 ? part : -part));
}

/* What rounding leaves of terms that cancel and hold no state: the drop of voltage between two
 * places that a source of a thousand volts feeds. The parameters say the same moved up and down,
 * but for that. */
static void add_rounding_of_constants(const frot_model *m, frot_state *s, frot_work *w, double t,
                                      const double *base) {
  double *forth = frot_stage(w, FORTH), *back = frot_stage(w, BACK);
  double *noise = s->data + w->layout.noise;
  size_t size = sizeof(double) * (size_t)m->np;
  memcpy(w->step.parameters, s->data + w->layout.p, size);
  move_parameters(m, s, w, FROT_APART);
  int status = slope_from_start(m, s, w, t, w->step.z0, forth);
  move_parameters(m, s, w, -FROT_APART);
  if (status == FROT_OK) status = slope_from_start(m, s, w, t, w->step.z0, back);
  memcpy(s->data + w->layout.p, w->step.parameters, size);
  if (status != FROT_OK) return;
  for (int j = 0; j < w->awake.n - FROT_QUADRATURES; j++) {
    double rounding = 0.5 * fabs(forth[j] - 2 * base[j] + back[j]);
    double *own = noise + w->awake.now->states[j];
    *own = fmax(*own, level(s) * rounding);
  }
}

/* Move the values of z0 by parts of their sizes, up and down: what slopes and guards make of that
 * is their noise. Returns 1 where a slope is not known. */
static int shake(const frot_model *m, frot_state *s, frot_work *w, double t, const double *size) {
  double *base = frot_stage(w, BASE), *forth = frot_stage(w, FORTH), *back = frot_stage(w, BACK);
  double *z = w->step.f + MOVED * w->layout.nz, *noise = s->data + w->layout.noise;
  double *guards = noise + m->nq + m->nv;
  int n = m->nq + m->nv, packed = w->awake.n, moving = packed - FROT_QUADRATURES;
  for (int pattern = 0; pattern < 2; pattern++) {
    for (int side = 0; side < 2; side++) {
      double moved = (side ? -1 : 1) * FROT_APART, *there = side ? back : forth;
      memcpy(z, w->step.z0, sizeof(double) * (size_t)w->layout.nx);
      for (int j = 0; j < n; j++) z[j] += (((j >> pattern) & 1) != 0 ? moved : -moved) * size[j];
      w->blocks.shaken = moved, w->blocks.pattern = pattern;
      int status = slope_from_start(m, s, w, t * (1 + moved), z, there);
      w->blocks.shaken = 0;
      if (status != FROT_OK) return 1;
    }
    for (int j = 0; j < frot_width(w); j++) {
      if (j >= moving && j < packed) continue; /* energies follow */
      double *own =
          j < packed ? noise + w->awake.now->states[j] : guards + w->guards.list[j - packed];
      double sensitivity = 0.5 * fabs(forth[j] - back[j]) * (FROT_NUDGE / FROT_APART);
      double rounding = 0.5 * fabs(forth[j] - 2 * base[j] + back[j]);
      *own = fmax(*own, level(s) * (sensitivity + rounding));
    }
  }
  return 0;
}

/* Raise the size of a speed to what the noise of its rate makes of it in the stages of a step h:
 * one that is zero by symmetry is no better than that, and moves others. In groups in which rows
 * act slips that begin are as small, and are followed. Returns whether any is raised. */
static int raise_shaken(const frot_model *m, const frot_state *s, const frot_work *w, double h,
                        double *size) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  const double *noise = s->data + w->layout.noise;
  int raised = 0;
  for (int k = 0; k < w->awake.now->n_groups; k++) {
    const frot_group *g = &m->groups[w->awake.now->groups[k]];
    int acts = g->general;
    for (int i = 0; i < g->n_contacts; i++) acts |= modes[g->contacts[i]].closed;
    for (int i = 0; i < g->n_speeds && !acts; i++) {
      int j = m->nq + g->unknowns[i];
      double made = h * noise[j] / FROT_NUDGE;
      if (!(made > size[j])) continue;
      size[j] = made, raised = 1;
    }
  }
  return raised;
}

int frot_measure_rounding(const frot_model *m, frot_state *s, frot_work *w, double t, int deep) {
  double *base = frot_stage(w, BASE);
  double *largest = w->step.f + LARGEST * w->layout.nz, *size = w->step.f + SIZE * w->layout.nz;
  double *noise = s->data + w->layout.noise;
  int n = m->nq + m->nv, moving = w->awake.n - FROT_QUADRATURES;
  for (int j = 0; j < moving; j++) {
    largest[j] = 0;
    /* of an implicit step only the slopes at its ends are there */
    for (int i = 0; i <= DP_STAGES; i += s->implicit ? DP_STAGES : 1)
      largest[j] = fmax(largest[j], fabs(frot_stage(w, i)[j]));
  }
  double before = s->noise_measured < 0 ? 0 : BEFORE;
  double now = *frot_segment_at(m, s->data + w->layout.segment).t1;
  double plain = s->heard_at == now ? before : before * FADED;
  s->noise_shown = 0, s->noise_measured = 1, s->heard_at = now;
  int astray = strays(m, s, w, t);
  if (slope_from_start(m, s, w, t, w->step.z0, base) != FROT_OK) return 0;
  note_neighbours(m, s, w, size);
  for (int j = 0; j < n + w->layout.ng; j++)
    noise[j] *= j < m->nq && m->q_speed[j] < 0 ? plain : before;
  add_rounding(m, s, w, t, w->step.z0, NULL);
  /* of a step that is far too long the stages say nothing about the next one's */
  double h = astray ? 0 : fabs(t - now);
  add_rounding_of_rates(m, s, w, t, h, w->step.z0, size);
  add_rounding_of_stages(m, s, w, h, size);
  if (shake(m, s, w, t, size)) return 0;
  if (deep && raise_shaken(m, s, w, h, size) && shake(m, s, w, t, size)) return 0;
  add_rounding_of_constants(m, s, w, t, base);
  for (int j = 0; j < m->nq; j++)
    if (m->q_speed[j] >= 0)
      noise[j] = fmax(noise[j], FROT_NUDGE * fabs(w->step.z0[m->nq + m->q_speed[j]]));
  /* where terms no longer vanish by symmetry: a step that is far too long ends where all is large
   */
  if (astray || frot_slope(m, s, w, t, w->step.z1, base) != FROT_OK) return 0;
  add_rounding(m, s, w, t, w->step.z1, largest);
  return m->ny == 0;
}
