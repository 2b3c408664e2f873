#include "evaluation/row_rounding.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "inertia/mass_matrix.h"
#include "model/indexing.h"
#include "numerics/dense.h"
#include "numerics/tolerances.h"

void frot_size_drives(const frot_model *m, frot_state *s, frot_work *w, double t, const double *q,
                      const double *v, const double *d) {
  if (!m->drives.call) return;
  frot_inputs(s, w, &t, q, v, d);
  w->call.res[0] = w->core.bias_size;
  frot_call(w, &m->drives);
}

/* The sums of a group's speeds: V of what moves, W of what turns. */
typedef struct {
  double moving, turning;
  int known;
} speeds;

/* What the lengths of a contact bring to the terms of c: reach W^2 + V W. */
static double size_of_turning(const frot_model *m, const frot_group *g, const double *v,
                              double reach, speeds *sum) {
  for (int i = 0; !sum->known && i < g->n_speeds; i++) {
    int speed = g->unknowns[i];
    *(m->speed_turns[speed] ? &sum->turning : &sum->moving) += fabs(v[speed]);
  }
  sum->known = 1;
  return (reach * sum->turning + sum->moving) * sum->turning;
}

void frot_size_biases(const frot_model *m, const frot_state *s, frot_work *w, const frot_group *g,
                      const double *v) {
  speeds sum = {0, 0, 0};
  for (int i = 0; i < g->n_rows; i++) {
    int row = g->rows[i];
    double driven = m->drives.call ? w->core.bias_size[row] : 0;
    w->core.bias_size[row] = driven + fabs(w->core.c[row]);
  }
  for (int i = 0; i < g->n_elements; i++) {
    const frot_element *e = &m->elements[g->elements[i]];
    double reach = s->data[w->layout.reach + e->contact];
    if (reach > 0 && !e->rolling)
      w->core.bias_size[e->row] += size_of_turning(m, g, v, reach, &sum);
  }
  for (int i = 0; i < g->n_contacts; i++) {
    int row = m->contacts[g->contacts[i]].row_n;
    double reach = s->data[w->layout.reach + g->contacts[i]];
    if (row >= 0 && reach > 0) w->core.bias_size[row] += size_of_turning(m, g, v, reach, &sum);
  }
}

/* Whether c of all rows of a group is rounding of its terms. */
static int biases_are_rounding(const frot_model *m, const frot_work *w, const frot_group *g) {
  for (int i = 0; i < g->n_rows; i++) {
    int row = g->rows[i];
    if (frot_is_reading(m, row)) continue;
    if (fabs(w->core.c[row]) > FROT_ROUNDING * w->core.bias_size[row]) return 0;
  }
  return g->n_rows > 0;
}

/* What speeds bring to the loads of a group has the size |v| W, W their turning, in the metric. 0
 * where that is more than rounding leaves of turning beside what moves. */
static double size_of_gyration(const frot_model *m, const frot_state *s, const frot_work *w,
                               const frot_group *g, const double *v) {
  double turning = 0, moving = 0;
  for (int k = 0; k < g->n_speeds; k++) {
    int speed = g->unknowns[k];
    *(m->speed_turns[speed] ? &turning : &moving) += fabs(v[speed]);
  }
  for (int i = 0; i < g->n_contacts; i++)
    if (s->data[w->layout.reach + g->contacts[i]] * turning > FROT_CANCELS * moving) return 0;
  return turning > 0 ? turning * sqrt(frot_square_of(w, g, v)) : 0;
}

/* Whether the loads of a group are below `size` in the metric: of its motion, and of each reading
 * with the inertia of its direction. */
static int loads_are_below(const frot_model *m, const frot_work *w, const frot_group *g,
                           double size) {
  const double *force = w->core.force + g->vector;
  double *own = w->core.column;
  if (frot_dot(force, force, g->n_speeds) > size * size) return 0;
  frot_own_inertias(w, g, own);
  for (int i = 0; i < g->n_rows; i++) {
    int reads = m->row_reads[g->rows[i]];
    double load = reads >= 0 ? fabs(w->core.h[g->unknowns[reads]]) : 0;
    if (load > 0 && !(load <= size * sqrt(fmax(own[reads], 0)))) return 0;
  }
  return 1;
}

void frot_drop_loads(const frot_model *m, const frot_state *s, frot_work *w, const frot_group *g,
                     const double *v) {
  if (!biases_are_rounding(m, w, g)) return;
  double size = FROT_ROUNDING * size_of_gyration(m, s, w, g, v);
  if (!(size > 0) || !loads_are_below(m, w, g, size)) return;
  memset(w->core.force + g->vector, 0, sizeof(double) * (size_t)g->n_speeds);
  for (int k = 0; k < g->n_speeds; k++) w->core.h[g->unknowns[k]] = 0;
  for (int i = 0; i < g->n_rows; i++) {
    int row = g->rows[i], reads = m->row_reads[row];
    *(reads >= 0 ? &w->core.h[g->unknowns[reads]] : &w->core.c[row]) = 0;
  }
}

/* A row that is nothing but rounding of lengths that cancel, as that of a point which other
 * liaisons keep on its line, is zero, and so is the speed it gives. */
static void drop_rounding(const frot_model *m, frot_work *w, int row, double reach,
                          const double *v) {
  const frot_group *g = frot_group_of(m, row);
  double *entries = frot_entries(m, w->core.rows, row), speed = 0;
  for (int k = 0; k < g->n_speeds; k++) {
    double length = m->speed_turns[g->unknowns[k]] ? reach : 1;
    if (!(fabs(entries[k]) <= FROT_CANCELS * length)) return;
    speed += length * fabs(v[g->unknowns[k]]);
  }
  memset(entries, 0, sizeof(double) * (size_t)g->n_speeds);
  if (fabs(w->core.rate[row]) <= FROT_CANCELS * speed) w->core.rate[row] = 0;
}

void frot_clean_rows(const frot_model *m, const frot_state *s, frot_work *w, const frot_group *g,
                     const double *v) {
  const double *reach = s->data + w->layout.reach;
  for (int k = 0; k < g->n_contacts; k++) {
    int i = g->contacts[k], row = m->contacts[i].row_n, sliding = m->contacts[i].sliding;
    if (!(reach[i] > 0)) continue;
    if (row >= 0 && !m->contacts[i].reduced) drop_rounding(m, w, row, reach[i], v);
    if (sliding >= 0) drop_rounding(m, w, m->elements[sliding].row, reach[i], v);
  }
}

double frot_dropped_rate(const frot_model *m, const frot_state *s, const frot_work *w, int element,
                         const double *v) {
  int i = m->elements[element].contact, row = m->elements[element].row;
  const frot_group *g = frot_group_of(m, row);
  double reach = s->data[w->layout.reach + i], speed = 0;
  if (m->contacts[i].sliding != element || !(reach > 0)) return 0;
  for (int k = 0; k < g->n_speeds; k++) {
    double length = m->speed_turns[g->unknowns[k]] ? reach : 1;
    speed += length * fabs(v[g->unknowns[k]]);
  }
  return FROT_CANCELS * speed;
}
