#include "modes/contact_components.h"

#include <string.h>

#include "evaluation/evaluate.h"
#include "reactions/reactions.h"

/* The rows of motion of a contact and its elements into `rows`; returns how many. */
static int rows_of_contact(const frot_model *m, int i, int *rows) {
  int n = 0;
  if (m->contacts[i].row_n >= 0) rows[n++] = m->contacts[i].row_n;
  for (int e = 0; e < m->n_elements; e++) {
    if (m->elements[e].contact != i) continue;
    rows[n++] = m->elements[e].row;
    for (int k = 0; k < FROT_BOUNDING; k++)
      if (m->elements[e].bounded_by[k] >= 0) rows[n++] = m->elements[e].bounded_by[k];
  }
  return n;
}

/* Whether a reaction of contact j changes anything at contact i. */
static int coupled(const frot_instant *in, int i, int j) {
  const frot_model *m = in->m;
  int *a = in->w->relations.rows, count = rows_of_contact(m, i, a), *b = a + count;
  int others = rows_of_contact(m, j, b);
  for (int k = 0; k < count; k++)
    for (int c = 0; c < others; c++)
      if (!frot_is_reading(m, b[c]) && m->row_group[a[k]] == m->row_group[b[c]] &&
          in->w->core.wanted[a[k]] && in->w->core.wanted[b[c]] &&
          frot_effect(m, in->w, a[k], b[c]) != 0)
        return 1;
  return 0;
}

void frot_find_components(const frot_instant *in) {
  const frot_model *m = in->m;
  int *component = in->w->search.component;
  for (int i = 0; i < m->n_contacts; i++) component[i] = in->w->search.best[i].closed ? i : -1;
  for (int i = 0; i < m->n_contacts; i++)
    for (int j = 0; j < i; j++) {
      if (component[i] < 0 || component[j] < 0 || component[i] == component[j]) continue;
      if (m->contact_group[i] != m->contact_group[j]) continue;
      if (!coupled(in, i, j) && !coupled(in, j, i)) continue;
      int from = component[i], to = component[j];
      for (int k = 0; k <= i; k++)
        if (component[k] == from) component[k] = to;
    }
}

void frot_note_others(const frot_instant *in, const int *chosen, int count) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  const frot_group *g = &m->groups[m->contact_group[chosen[0]]];
  double *others = w->search.others;
  int more = 0;
  memset(others, 0, sizeof(double) * (size_t)m->n_rows);
  for (int i = 0; i < g->n_contacts; i++) {
    int component = w->search.component[g->contacts[i]];
    more |= component >= 0 && component != w->search.component[chosen[0]];
  }
  if (!more) return;
  memcpy(w->reactions.along, in->s->data + in->l.along,
         sizeof(double) * FROT_BOUNDING * (size_t)m->n_elements);
  if (frot_group_reactions(m, w, g, w->search.best, NULL)) return;
  for (int i = 0; i < g->n_rows; i++)
    if (!frot_is_reading(m, g->rows[i])) others[g->rows[i]] = w->core.lam[g->rows[i]];
  for (int c = 0; c < count; c++) {
    if (m->contacts[chosen[c]].row_n >= 0) others[m->contacts[chosen[c]].row_n] = 0;
    for (int e = 0; e < m->n_elements; e++)
      if (m->elements[e].contact == chosen[c]) others[m->elements[e].row] = 0;
  }
}

/* The speeds of other groups with rows, whose modes are not all found yet, go on as until now. */
static void keep_motion(const frot_instant *in, const frot_group *own) {
  const frot_model *m = in->m;
  const double *slope = in->s->data + in->l.slope + m->nq;
  for (int k = 0; k < m->n_groups && in->s->statistics.steps > 0; k++) {
    const frot_group *g = &m->groups[k];
    for (int i = 0; i < g->n_speeds && g->n_rows > 0 && g != own; i++)
      in->w->core.a[g->unknowns[i]] = slope[g->unknowns[i]];
  }
}

void frot_move_beside_others(const frot_instant *in, const frot_group *g) {
  frot_work *w = in->w;
  for (int i = 0; i < g->n_rows; i++)
    if (w->search.others[g->rows[i]] != 0) w->core.lam[g->rows[i]] = w->search.others[g->rows[i]];
  frot_accelerations(in->m, w, w->search.nothing_frozen);
  keep_motion(in, g);
  for (int i = 0; i < g->n_rows; i++)
    if (w->search.others[g->rows[i]] != 0) w->core.lam[g->rows[i]] = 0;
}
