#include "components.h"

#include "core.h"

/* The rows of motion of a contact and its elements into `rows`; returns how many. */
static int rows_of_contact(const frot_model *m, int i, int *rows) {
  int n = 0;
  if (m->contacts[i].row_n >= 0) rows[n++] = m->contacts[i].row_n;
  for (int e = 0; e < m->n_elements; e++) {
    if (m->elements[e].contact != i) continue;
    rows[n++] = m->elements[e].row;
    for (int k = 0; k < 2; k++)
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
