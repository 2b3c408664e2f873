#include "evaluation/row_order.h"

#include <string.h>

#include "model/indexing.h"

#define LITTLE 0.1 /* part of its length that is little to be left of a row */

void frot_note_unilateral_rows(const frot_state *s, frot_work *w) {
  w->span.unilateral = s->data + w->layout.unilateral;
}

int frot_row_is_deferred(const frot_model *m, const frot_work *w, int row, double rest,
                         double length) {
  if (!(rest < LITTLE * length)) return 0;
  const frot_group *g = frot_group_of(m, row);
  for (int i = 0; i < g->n_contacts; i++)
    if (m->contacts[g->contacts[i]].row_n == row) return w->span.unilateral[g->contacts[i]] != 0;
  return 0;
}

void frot_defer_row(int *order, int i, int last) {
  int waits = order[i];
  memmove(order + i, order + i + 1, sizeof *order * (size_t)(last - i));
  order[last] = waits;
}
