#include "evaluation/row_rounding.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "model/indexing.h"
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
