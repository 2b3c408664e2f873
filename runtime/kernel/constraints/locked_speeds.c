#include "constraints/locked_speeds.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "model/indexing.h"
#include "numerics/dense.h"
#include "numerics/basis.h"
#include "constraints/projection.h"
#include "numerics/tolerances.h"

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

/* Whether coordinate k stays where it is while the known speeds are zero. */
static int stays(const frot_model *m, int k, const double *known) {
  if (m->q_speed[k] >= 0) return known[m->q_speed[k]] != 0;
  for (int i = 0; i < m->n_turns; i++) {
    const frot_turn *turn = &m->turns[i];
    if (k < turn->at || k >= turn->at + 4) continue;
    for (int j = 0; j < 3; j++)
      if (turn->speed[j] >= 0 && known[turn->speed[j]] == 0) return 0;
    return 1;
  }
  return 0;
}

/* The contact of a row, or -1 of an item of the text. */
static int contact_of(const frot_model *m, int row) {
  const frot_group *g = frot_group_of(m, row);
  for (int i = 0; i < g->n_contacts; i++)
    if (m->contacts[g->contacts[i]].row_n == row) return g->contacts[i];
  for (int i = 0; i < g->n_elements; i++)
    if (m->elements[g->elements[i]].row == row) return m->elements[g->elements[i]].contact;
  return -1;
}

/* Whether the contact of a row may part. */
static int may_part(const frot_model *m, const frot_state *s, const frot_work *w, int row) {
  int contact = contact_of(m, row);
  return contact < 0 || s->data[w->layout.unilateral + contact] != 0;
}

/* Whether a row depends on coordinates alone that stay. */
static int is_constant(const frot_model *m, int row, const double *known) {
  const unsigned char *depends = m->row_depends + row * (m->nq + 1);
  for (int k = 0; k < m->nq; k++)
    if (depends[k] && !stays(m, k, known)) return 0;
  return 1;
}

/* Marks the rows of a group that move a speed which is not known, in whatever posture: into
 * w->span.order by their places in the group. */
static void note_moving_rows(const frot_group *g, frot_work *w, const double *known) {
  memset(w->span.order, 0, sizeof(int) * (size_t)g->n_rows);
  for (int i = 0; i < g->n_given; i++) {
    int column = g->given[i] % g->n;
    if (column >= g->n_speeds || known[g->unknowns[column]] == 0)
      w->span.order[g->given[i] / g->n] = 1;
  }
}

/* Marks the speeds of a group that rows hold which are constant, or which cannot part and move
 * nothing but such speeds: the unit vector of such a speed lies in their span. A row of the second
 * kind may turn with other coordinates; its speed is zero all the same. (Two that may part may come
 * to be one inside a step, as where a corner passes an edge: then reactions are wrong, and the
 * error of a speed that is not frozen shows it.) Columns are taken in units of their largest entry,
 * so that units do not matter: masses say nothing of what holds. */
static int frozen_by_rows(const frot_model *m, const frot_state *s, frot_work *w,
                          const frot_group *g, int n, const double *known, double *frozen) {
  int ns = g->n_speeds, count = 0, columns = 0;
  double *unit = w->core.rest, *scale = w->core.column;
  for (int k = 0; k < ns; k++) {
    scale[k] = 0;
    for (int i = 0; i < n; i++)
      scale[k] = fmax(scale[k], fabs(frot_entries(m, w->core.rows, w->relations.rows[i])[k]));
  }
  note_moving_rows(g, w, known);
  for (int i = 0; i < n; i++) {
    int row = w->relations.rows[i];
    if (m->row_depends[row * (m->nq + 1) + m->nq]) continue;
    if (!is_constant(m, row, known) &&
        (w->span.order[m->row_local[row]] != 0 || may_part(m, s, w, row)))
      continue;
    double *x = w->span.basis + ns * columns;
    const double *entries = frot_entries(m, w->core.rows, row);
    for (int k = 0; k < ns; k++) x[k] = scale[k] > 0 ? entries[k] / scale[k] : 0;
    double length = frot_length(x, ns),
           rest = frot_reject(x, w->span.basis, columns, ns, w->span.parts);
    if (!(rest > 0.1 * FROT_DEPENDENT * length)) continue;
    for (int k = 0; k < ns; k++) x[k] /= rest;
    columns++;
  }
  for (int k = 0; k < ns; k++) {
    int speed = g->unknowns[k];
    for (int i = 0; i < ns; i++) unit[i] = i == k;
    frozen[speed] = known[speed] != 0 && frot_reject(unit, w->span.basis, columns, ns,
                                                     w->span.parts) < FROT_SPEED_LOCKED;
    count += frozen[speed] != 0;
  }
  return count;
}

void frot_find_locked_speeds(const frot_model *m, const frot_state *s, frot_work *w,
                             const frot_contact_mode *modes, double *frozen) {
  double *known = w->core.load;
  drop_cancelled(m, s, w);
  for (int k = 0; k < m->nv; k++) frozen[k] = known[k] = 0;
  for (int i = 0; i < m->n_groups; i++) {
    const frot_group *g = &m->groups[i];
    int n = frot_rows_of_group(m, g, modes, NULL, 0, w->relations.rows), count = g->n_speeds + 1;
    for (int k = 0; k < g->n_speeds; k++) known[g->unknowns[k]] = 1;
    while (n > 0) {
      int now = frozen_by_rows(m, s, w, g, n, known, frozen);
      if (now == count || now == 0) break;
      count = now;
      for (int k = 0; k < g->n_speeds; k++) known[g->unknowns[k]] = frozen[g->unknowns[k]];
    }
    for (int k = 0; k < g->n_speeds; k++) known[g->unknowns[k]] = 0;
  }
}

int frot_state_stays(const frot_model *m, const double *frozen, int k) {
  return k < m->nq ? stays(m, k, frozen) : frozen[k - m->nq] != 0;
}
