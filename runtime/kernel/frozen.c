#include "frozen.h"

#include <math.h>
#include <string.h>

#include "core.h"
#include "linear.h"
#include "orthogonal.h"
#include "projection.h"
#include "tolerances.h"

#define HELD 1e-13 /* part of a unit speed outside the span of the rows that hold it */

/* Entries of a row that are rounding of lengths that cancel are none: the two points of a contact
 * between bodies that turn together do not move along it. */
static void drop_entries(const frot_model *m, frot_work *w, int row, double reach) {
  const frot_group *g = frot_group_of(m, row);
  double *entries = frot_entries(m, w->core.rows, row);
  for (int k = 0; k < g->n_speeds; k++) {
    double length = m->speed_turns[g->unknowns[k]] ? reach : 1;
    if (fabs(entries[k]) <= FROT_CANCELS * length) entries[k] = 0;
  }
}

static void drop_cancelled(const frot_model *m, const frot_state *s, frot_work *w) {
  const double *reach = s->data + w->layout.reach;
  for (int i = 0; i < m->n_contacts; i++) {
    int row = m->contacts[i].row_n, sliding = m->contacts[i].sliding;
    if (!(reach[i] > 0)) continue;
    if (row >= 0 && !m->contacts[i].reduced) drop_entries(m, w, row, reach[i]);
    if (sliding >= 0) drop_entries(m, w, m->elements[sliding].row, reach[i]);
  }
}

/* Marks the speeds of a group that the rows which depend on frozen coordinates alone hold: the unit
 * vector of such a speed lies in their span. Columns are taken in units of their largest entry, so
 * that units do not matter: masses say nothing of what holds. */
static int frozen_by_rows(const frot_model *m, frot_work *w, const frot_group *g, int n,
                          const double *known, double *frozen) {
  int ns = g->n_speeds, count = 0, columns = 0;
  double *unit = w->core.rest, *scale = w->core.column;
  for (int k = 0; k < ns; k++) {
    scale[k] = 0;
    for (int i = 0; i < n; i++)
      scale[k] = fmax(scale[k], fabs(frot_entries(m, w->core.rows, w->relations.rows[i])[k]));
  }
  for (int i = 0; i < n; i++) {
    int row = w->relations.rows[i], usable = !m->row_depends[row * (m->nq + 1) + m->nq];
    for (int k = 0; k < m->nq && usable; k++)
      if (m->row_depends[row * (m->nq + 1) + k] && (m->q_speed[k] < 0 || known[m->q_speed[k]] == 0))
        usable = 0;
    if (!usable) continue;
    double *x = w->span.basis + ns * columns;
    const double *entries = frot_entries(m, w->core.rows, row);
    for (int k = 0; k < ns; k++) x[k] = scale[k] > 0 ? entries[k] / scale[k] : 0;
    double length = sqrt(frot_dot(x, x, ns)),
           rest = frot_reject(x, w->span.basis, columns, ns, w->span.parts);
    if (!(rest > 0.1 * FROT_DEPENDENT * length)) continue;
    for (int k = 0; k < ns; k++) x[k] /= rest;
    columns++;
  }
  for (int k = 0; k < ns; k++) {
    int speed = g->unknowns[k];
    for (int i = 0; i < ns; i++) unit[i] = i == k;
    frozen[speed] =
        known[speed] != 0 && frot_reject(unit, w->span.basis, columns, ns, w->span.parts) < HELD;
    count += frozen[speed] != 0;
  }
  return count;
}

void frot_find_frozen(const frot_model *m, const frot_state *s, frot_work *w,
                      const frot_contact_mode *modes, double *frozen) {
  double *known = w->core.load;
  drop_cancelled(m, s, w);
  for (int k = 0; k < m->nv; k++) frozen[k] = known[k] = 0;
  for (int i = 0; i < m->n_groups; i++) {
    const frot_group *g = &m->groups[i];
    int n = frot_rows_of_group(m, g, modes, NULL, 0, w->relations.rows), count = g->n_speeds + 1;
    for (int k = 0; k < g->n_speeds; k++) known[g->unknowns[k]] = 1;
    while (n > 0) {
      int now = frozen_by_rows(m, w, g, n, known, frozen);
      if (now == count || now == 0) break;
      count = now;
      for (int k = 0; k < g->n_speeds; k++) known[g->unknowns[k]] = frozen[g->unknowns[k]];
    }
    for (int k = 0; k < g->n_speeds; k++) known[g->unknowns[k]] = 0;
  }
}
