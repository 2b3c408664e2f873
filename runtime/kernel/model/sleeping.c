#include "model/sleeping.h"

#include <string.h>

#include "model/calls.h"
#include "model/indexing.h"
#include "model/stage_slopes.h"

#define TAKE(field, count) FROT_TAKE(a, field, count)

/* Fill the lists; `asleep` may be NULL. */
static void fill(const frot_model *m, frot_work *w, frot_awake_lists *a, const double *asleep) {
  unsigned char *state = w->awake.state, *group = w->awake.group, *condition = w->awake.condition;
  a->n = a->n_islands = a->n_groups = a->n_contacts = a->n_elements = a->n_located = 0;
  memset(state, !asleep, (size_t)(m->nq + m->nv));
  memset(group, !asleep, (size_t)m->n_groups);
  memset(condition, !asleep, (size_t)m->n_located);
  for (int i = 0; i < m->n_islands; i++) {
    const frot_island *island = &m->islands[i];
    if (asleep && asleep[i] != 0) continue;
    a->islands[a->n_islands++] = i;
    for (int k = 0; k < island->reads.nq; k++) state[island->reads.q[k]] = 1;
    for (int k = 0; k < island->reads.nv; k++) state[m->nq + island->reads.v[k]] = 1;
    for (int k = 0; k < island->n_groups; k++) group[island->first_group + k] = 1;
    for (int k = 0; k < island->n_located; k++) condition[island->conditions[k]] = 1;
  }
  for (int j = 0; j < w->layout.nx; j++) {
    int awake = j >= m->nq + m->nv || state[j];
    a->place[j] = awake ? a->n : -1;
    if (awake) a->states[a->n++] = j;
  }
  for (int k = 0; k < m->n_groups; k++)
    if (group[k]) a->groups[a->n_groups++] = k;
  for (int i = 0; i < m->n_contacts; i++)
    if (group[m->contact_group[i]]) a->contacts[a->n_contacts++] = i;
  for (int e = 0; e < m->n_elements; e++)
    if (group[m->row_group[m->elements[e].row]]) a->elements[a->n_elements++] = e;
  for (int j = 0; j < m->n_located; j++)
    if (condition[j]) a->located[a->n_located++] = j;
}

void frot_list_all_islands(const frot_model *m, frot_work *w) {
  fill(m, w, &w->awake.all, NULL);
  w->awake.known = 0;
  frot_leave_sleep(w);
}

/* The lists in use: all, or those of a step. */
static void use(frot_work *w, const frot_awake_lists *a) {
  w->awake.now = a;
  w->awake.n = a->n;
  if (a == &w->awake.all) w->awake.filled = 1;
}

void frot_leave_sleep(frot_work *w) { use(w, &w->awake.all); }

void frot_restore_sleep(const frot_model *m, frot_work *w, const double *asleep) {
  fill(m, w, &w->awake.some, m->n_islands > 0 ? asleep : NULL);
  w->awake.known = 0;
  use(w, &w->awake.some);
}

void frot_restrict_to_islands(frot_work *w, const int *islands, int n_islands, const int *groups,
                              int n_groups) {
  frot_awake_lists *a = &w->awake.some;
  memcpy(a->islands, islands, sizeof *islands * (size_t)n_islands);
  memcpy(a->groups, groups, sizeof *groups * (size_t)n_groups);
  a->n = a->n_contacts = a->n_elements = a->n_located = 0;
  a->n_islands = n_islands, a->n_groups = n_groups;
  w->awake.known = 0;
  use(w, a);
}

void frot_enter_sleep(const frot_model *m, const frot_state *s, frot_work *w) {
  if (s->asleep == 0) return;
  w->awake.filled = w->awake.known != s->asleep;
  if (w->awake.filled) fill(m, w, &w->awake.some, s->data + w->layout.asleep);
  w->awake.known = s->asleep;
  use(w, &w->awake.some);
}

void frot_wake_all_islands(const frot_model *m, frot_state *s, frot_work *w) {
  w->awake.known = 0;
  if (s->asleep == 0) return;
  memset(s->data + frot_layout_of(m).asleep, 0, sizeof(double) * (size_t)m->n_islands);
  s->asleep = 0;
  s->naps++;
}

void frot_wake_within_step(const frot_model *m, frot_state *s, frot_work *w) {
  if (s->asleep == 0) return;
  frot_wake_all_islands(m, s, w);
  frot_leave_sleep(w);
  s->has_slope = 0; /* other guards are listed */
}

/* Whether the motions that laws bound take energy. */
static int dissipates(const frot_model *m, const frot_state *s, const frot_work *w,
                      const frot_island *island) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  for (int k = 0; k < island->n_groups; k++) {
    const frot_group *g = &m->groups[island->first_group + k];
    for (int i = 0; i < g->n_elements; i++) {
      int e = g->elements[i], row = m->elements[e].row;
      if (frot_element_mode(m, modes, e)->friction > FROT_STICK &&
          w->core.lam[row] * w->core.rate[row] != 0)
        return 1;
    }
  }
  return 0;
}

/* Let the islands found be asleep; returns how many they are. */
static int let_sleep(frot_state *s, int found) {
  s->asleep += found;
  s->naps += found > 0;
  return found;
}

/* Marks the groups a guard of which is not above zero at the start of the step. */
static void mark_falling(const frot_model *m, const frot_work *w, unsigned char *falls) {
  const double *guard = frot_stage(w, 0) + w->awake.n;
  memset(falls, 0, (size_t)m->n_groups);
  for (int k = 0; k < w->guards.count; k++) {
    int j = w->guards.list[k];
    if (guard[k] > 0 || j >= frot_condition_guard(m)) continue;
    int e = frot_guarded_element(m, j);
    falls[j < m->n_contacts ? m->contact_group[j] : m->row_group[m->elements[e].row]] = 1;
  }
}

int frot_note_resting_islands_at_start(const frot_model *m, frot_state *s, frot_work *w) {
  const frot_awake_lists *now = w->awake.now;
  const double *slope = frot_stage(w, 0);
  unsigned char *falls = w->awake.group;
  int found = 0;
  if (m->n_islands == 0 || s->implicit || s->ramps) return 0;
  mark_falling(m, w, falls);
  for (int k = 0; k < now->n_islands; k++) {
    const frot_island *island = &m->islands[now->islands[k]];
    int still = island->sleeps && w->awake.power[now->islands[k]] == 0 && island->n_located == 0;
    for (int j = 0; j < island->n_groups && still; j++) still = !falls[island->first_group + j];
    for (int j = 0; j < island->reads.nv && still; j++) {
      int state = m->nq + island->reads.v[j];
      still = w->step.z0[state] == 0 && slope[now->place[state]] == 0;
    }
    for (int j = 0; j < island->reads.nq && still; j++)
      still = slope[now->place[island->reads.q[j]]] == 0;
    if (!still || dissipates(m, s, w, island)) continue;
    s->data[w->layout.asleep + now->islands[k]] = 1;
    found++;
  }
  return let_sleep(s, found);
}

int frot_note_resting_islands(const frot_model *m, frot_state *s, frot_work *w, const double *x) {
  const frot_awake_lists *now = w->awake.now;
  const double *start = frot_stage(w, 0), *end = frot_stage(w, DP_STAGES);
  double *asleep = s->data + w->layout.asleep;
  if (m->n_islands == 0 || s->ramps) return 0;
  int found = 0;
  for (int k = 0; k < now->n_islands; k++) {
    const frot_island *island = &m->islands[now->islands[k]];
    int still = island->sleeps && w->awake.power[now->islands[k]] == 0;
    for (int j = 0; j < island->reads.nv && still; j++) {
      int state = m->nq + island->reads.v[j], at = now->place[state];
      still = x[state] == 0 && w->step.z0[state] == 0 && start[at] == 0 && end[at] == 0;
    }
    for (int j = 0; j < island->reads.nq && still; j++) {
      int state = island->reads.q[j], at = now->place[state];
      still = x[state] == w->step.z0[state] && start[at] == 0 && end[at] == 0;
    }
    if (!still || dissipates(m, s, w, island)) continue;
    asleep[now->islands[k]] = 1;
    found++;
  }
  return let_sleep(s, found);
}

void frot_unpack_awake(const frot_work *w, const double *packed, double *all) {
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n; k++) all[now->states[k]] = packed[k];
}

void frot_copy_awake(const frot_work *w, const double *from, double *to) {
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n; k++) to[now->states[k]] = from[now->states[k]];
}

void frot_pack_awake(const frot_work *w, const double *all, double *packed) {
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n; k++) packed[k] = all[now->states[k]];
}

static void bind_lists(const frot_model *m, const frot_layout *l, frot_awake_lists *w,
                       frot_arena *a) {
  TAKE(w->place, l->nx), TAKE(w->states, l->nx), TAKE(w->islands, m->n_islands),
      TAKE(w->groups, m->n_groups);
  TAKE(w->contacts, m->n_contacts), TAKE(w->elements, m->n_elements);
  TAKE(w->located, m->n_located);
}

void frot_bind_awake(const frot_model *m, const frot_layout *l, frot_awake_work *w, frot_arena *a) {
  bind_lists(m, l, &w->all, a), bind_lists(m, l, &w->some, a);
  TAKE(w->extent, m->n_islands);
  TAKE(w->power, m->n_islands), TAKE(w->state, m->nq + m->nv), TAKE(w->group, m->n_groups);
  TAKE(w->condition, m->n_located);
  int most = 0;
  for (int i = 0; i < m->n_islands; i++) {
    const frot_island *k = &m->islands[i];
    most = frot_larger(most, k->reads.nq + frot_count_reads(&k->reads) + k->n_conditions);
  }
  if (m->n_islands > 0) most += l->nw + 2 * m->n_rows + m->n_contacts + 2 * m->n_elements + 1;
  TAKE(w->values, most);
}
