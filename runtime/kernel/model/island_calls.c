#include "model/island_calls.h"

#include <string.h>

#include "model/calls.h"

/* Where the results of an island lie in w->awake.values, in the order of its tables. */
typedef struct {
  double *qd, *h, *c, *rate, *gap, *condition, *coefficient, *power, *end;
} results;

static double *gather(const double *from, const int *places, int count, double *to) {
  for (int k = 0; k < count; k++) to[k] = from[places[k]];
  return to + count;
}

static const double *scatter(const double *from, const int *places, int count, double *to) {
  for (int k = 0; k < count; k++) to[places[k]] = from[k];
  return from + count;
}

/* Point w->call.arg at what functions read, but for y; returns what is free behind `at`. */
static double *take_reads(const frot_state *s, frot_work *w, const frot_reads *reads,
                          const double *t, const double *q, const double *v, const double *d,
                          double *at) {
  const double **arg = w->call.arg;
  arg[0] = t;
  arg[1] = at, at = gather(q, reads->q, reads->nq, at);
  arg[2] = at, at = gather(v, reads->v, reads->nv, at);
  arg[3] = at, at = gather(frot_inputs_at(s, w, *t), reads->u, reads->nu, at);
  arg[4] = at, at = gather(s->data + w->layout.p, reads->p, reads->np, at);
  arg[5] = at, at = gather(d, reads->d, reads->nd, at);
  arg[7] = reads->numbers;
  return at;
}

double *frot_take_inputs(const frot_state *s, frot_work *w, const frot_island *island,
                         const double *t, const double *q, const double *v, const double *d) {
  w->call.arg[6] = w->blocks.y;
  return take_reads(s, w, &island->reads, t, q, v, d, w->awake.values);
}

static results divide(const frot_island *island, const frot_island_extent *size, double *at,
                      int n_conditions) {
  results r;
  r.qd = at, at += island->reads.nq;
  r.h = at, at += size->unknowns;
  r.c = at, at += size->rows;
  r.rate = at, at += size->rows;
  r.gap = at, at += size->contacts;
  r.condition = at, at += n_conditions;
  r.coefficient = at, at += 2 * size->elements;
  r.power = at, at += 1;
  r.end = at;
  return r;
}

/* Put the rows of groups that are given one after the other where they belong; what is zero in
 * every posture stays zero. */
static void spread_rows(const frot_model *m, frot_work *w, int first, int count) {
  const double *given = w->core.given;
  for (int k = first; k < first + count; k++) {
    const frot_group *g = &m->groups[k];
    given = scatter(given, g->given, g->n_given, w->core.rows + g->entries);
  }
}

/* Put what belongs to groups where it belongs. */
static void spread_results(const frot_model *m, frot_work *w, const frot_island *island,
                           const results *r) {
  const double *h = r->h, *c = r->c, *rate = r->rate, *gap = r->gap, *law = r->coefficient;
  spread_rows(m, w, island->first_group, island->n_groups);
  for (int k = 0; k < island->n_groups; k++) {
    const frot_group *g = &m->groups[island->first_group + k];
    h = scatter(h, g->unknowns, g->n, w->core.h);
    c = scatter(c, g->rows, g->n_rows, w->core.c);
    rate = scatter(rate, g->rows, g->n_rows, w->core.rate);
    gap = scatter(gap, g->contacts, g->n_contacts, w->core.gap);
    for (int i = 0; i < g->n_elements; i++, law += 2)
      memcpy(w->core.coefficient + 2 * g->elements[i], law, 2 * sizeof(double));
  }
}

static int call_island(const frot_model *m, frot_state *s, frot_work *w, int i, double t,
                       const double *q, const double *v, const double *d, int wanted) {
  const frot_island *island = &m->islands[i];
  const frot_island_extent *size = &w->awake.extent[i];
  double *at = frot_take_inputs(s, w, island, &t, q, v, d);
  results r = divide(island, size, at, island->n_located);
  double *matrix = w->core.mass + size->matrix, *given = w->core.given;
  double *res[] = {r.qd,   matrix, r.h,         given,         r.c,
                   r.rate, r.gap,  r.condition, r.coefficient, r.power};
  memcpy(w->call.res, res, sizeof res);
  frot_call(w, &island->dynamics);
  /* what is no number is put there too, where it is looked for */
  scatter(r.qd, island->reads.q, island->reads.nq, w->core.qd);
  scatter(r.condition, island->conditions, island->n_located, w->core.condition);
  spread_results(m, w, island, &r);
  int finite = frot_all_finite(matrix, size->matrices) && frot_all_finite(given, size->given);
  if (wanted == FROT_INERTIA)
    finite = finite && frot_all_finite(r.qd, (int)(r.h - r.qd)) &&
             frot_all_finite(r.c, (int)(r.condition - r.c));
  else
    finite = finite && frot_all_finite(r.qd, (int)(r.end - r.qd));
  if (!finite && wanted != FROT_INERTIA) return 0;
  w->awake.power[i] = *r.power;
  w->core.power[0] += *r.power;
  if (!island->spread.call) return finite;
  double *effect = w->core.effect + size->entries, *metric = w->core.metric + size->metric;
  w->call.res[0] = effect, w->call.res[1] = metric;
  frot_call(w, &island->spread);
  return finite && frot_all_finite(effect, size->all_entries) &&
         frot_all_finite(metric, size->metrics);
}

static int loads_finite(const frot_model *m, const frot_work *w) {
  return frot_all_finite(w->core.h, w->layout.nw) &&
         frot_all_finite(w->core.coefficient, 2 * m->n_elements) &&
         frot_all_finite(w->core.condition, m->n_located) && frot_all_finite(w->core.power, 1);
}

static int call_whole(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                      const double *v, const double *d, int wanted) {
  frot_inputs(s, w, &t, q, v, d);
  double *res[] = {w->core.qd,          w->core.mass, w->core.h,   w->core.given,
                   w->core.c,           w->core.rate, w->core.gap, w->core.condition,
                   w->core.coefficient, w->core.power};
  memcpy(w->call.res, res, sizeof res);
  frot_call(w, &m->dynamics);
  spread_rows(m, w, 0, m->n_groups);
  int finite = frot_all_finite(w->core.mass, m->n_matrix) &&
               frot_all_finite(w->core.given, w->core.n_given) &&
               frot_all_finite(w->core.qd, m->nq) && frot_all_finite(w->core.c, m->n_rows) &&
               frot_all_finite(w->core.gap, m->n_contacts);
  if (wanted != FROT_INERTIA && !(finite && loads_finite(m, w))) return 0;
  if (!m->general) return finite;
  w->call.res[0] = w->core.effect, w->call.res[1] = w->core.metric;
  frot_call(w, &m->spread);
  return finite && frot_all_finite(w->core.effect, m->n_entries) &&
         frot_all_finite(w->core.metric, m->n_metric);
}

void frot_measure_islands(const frot_model *m, frot_work *w) {
  for (int i = 0; i < m->n_islands; i++) {
    const frot_island *island = &m->islands[i];
    frot_island_extent *size = &w->awake.extent[i];
    *size = (frot_island_extent){0};
    if (island->n_groups == 0) continue;
    const frot_group *first = &m->groups[island->first_group];
    size->matrix = first->matrix, size->entries = first->entries, size->metric = first->metric;
    int end = island->first_group + island->n_groups;
    const frot_group *after = end < m->n_groups ? &m->groups[end] : NULL;
    size->matrices = (after ? after->matrix : m->n_matrix) - first->matrix;
    size->all_entries = (after ? after->entries : m->n_entries) - first->entries;
    size->metrics = (after ? after->metric : m->n_metric) - first->metric;
    for (int k = 0; k < island->n_groups; k++) {
      const frot_group *g = first + k;
      size->unknowns += g->n, size->rows += g->n_rows;
      size->contacts += g->n_contacts, size->elements += g->n_elements;
      size->given += g->n_given;
    }
  }
}

void frot_measure_rows(const frot_model *m, frot_work *w) {
  memset(w->core.rows, 0, sizeof(double) * (size_t)m->n_entries);
  if (w->wide.mass) memset(w->wide.rows, 0, sizeof(frot_wide) * (size_t)m->n_entries);
  memset(w->core.reach, 0, 2 * sizeof(int) * (size_t)m->n_rows);
  w->core.n_given = 0;
  for (int k = 0; k < m->n_groups; k++) {
    const frot_group *g = &m->groups[k];
    w->core.n_given += g->n_given;
    for (int i = 0; i < g->n_given; i++) {
      int *reach = w->core.reach + 2 * g->rows[g->given[i] / g->n], at = g->given[i] % g->n;
      if (reach[1] == 0) reach[0] = at;
      reach[1] = at + 1;
    }
  }
}

int frot_call_dynamics(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                       const double *v, const double *d, int wanted) {
  if (m->n_islands == 0) return call_whole(m, s, w, t, q, v, d, wanted);
  const frot_awake_lists *now = w->awake.now;
  w->core.power[0] = 0;
  int finite = 1;
  for (int k = 0; k < now->n_islands; k++)
    finite &= call_island(m, s, w, now->islands[k], t, q, v, d, wanted);
  return finite;
}

void frot_call_kinematics(const frot_model *m, frot_state *s, frot_work *w, double t,
                          const double *q, const double *v, const double *d) {
  if (m->n_islands == 0) {
    frot_inputs(s, w, &t, q, v, d);
    w->call.res[0] = w->core.gap, w->call.res[1] = w->core.given;
    w->call.res[2] = w->core.rate, w->call.res[3] = w->core.condition;
    frot_call(w, &m->kinematics);
    spread_rows(m, w, 0, m->n_groups);
    return;
  }
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_islands; k++) {
    const frot_island *island = &m->islands[now->islands[k]];
    double *at = frot_take_inputs(s, w, island, &t, q, v, d);
    results r = divide(island, &w->awake.extent[now->islands[k]], at, island->n_conditions);
    w->call.res[0] = r.gap, w->call.res[1] = w->core.given;
    w->call.res[2] = r.rate, w->call.res[3] = r.condition;
    frot_call(w, &island->kinematics);
    spread_rows(m, w, island->first_group, island->n_groups);
    scatter(r.condition, island->conditions, island->n_conditions, w->core.condition);
    const double *rate = r.rate, *gap = r.gap;
    for (int i = 0; i < island->n_groups; i++) {
      const frot_group *g = &m->groups[island->first_group + i];
      rate = scatter(rate, g->rows, g->n_rows, w->core.rate);
      gap = scatter(gap, g->contacts, g->n_contacts, w->core.gap);
    }
  }
}

void frot_call_sizes(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                     const double *v, const double *d) {
  if (m->n_islands == 0) {
    frot_inputs(s, w, &t, q, v, d);
    w->call.res[0] = w->core.load, w->call.res[1] = w->call.values;
    frot_call(w, &m->sizes);
    return;
  }
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_islands; k++) {
    const frot_island *island = &m->islands[now->islands[k]];
    double *load = frot_take_inputs(s, w, island, &t, q, v, d);
    w->call.res[0] = load;
    frot_call(w, &island->sizes);
    for (int i = 0; i < island->n_groups; i++) {
      const frot_group *g = &m->groups[island->first_group + i];
      scatter(load, g->unknowns, g->n, w->core.load);
      load += g->n;
    }
  }
}

void frot_call_part(const frot_state *s, frot_work *w, const frot_part *part,
                    const frot_callable *function, const double *t, const double *q,
                    const double *v, const double *d) {
  double *at = take_reads(s, w, &part->reads, t, q, v, d, w->opening.read);
  w->call.arg[6] = at;
  gather(w->blocks.y, part->y, part->ny, at);
  frot_call(w, function);
}

void frot_call_sides(const frot_state *s, frot_work *w, const frot_part *part, double t,
                     const double *q, const double *v, const double *d, double *witness,
                     double *reach) {
  int n = part->n_contacts;
  if (n == 0) return;
  double *own = w->opening.sides;
  w->call.res[0] = own, w->call.res[1] = own + 3 * n;
  frot_call_part(s, w, part, &part->sides, &t, q, v, d);
  for (int i = 0; i < n; i++) memcpy(witness + 3 * part->contacts[i], own + 3 * i, 3 * sizeof *own);
  scatter(own + 3 * n, part->contacts, n, reach);
}
