#include "order.h"

#include <string.h>

#define LITTLE 0.1 /* part of its length that is little to be left of a row */

void frot_note_parting(const frot_model *m, const frot_state *s, const frot_work *w) {
  memset(w->span.parting, 0, (size_t)m->n_rows);
  for (int i = 0; i < m->n_contacts; i++)
    if (m->contacts[i].row_n >= 0)
      w->span.parting[m->contacts[i].row_n] = s->data[w->layout.unilateral + i] != 0;
}

int frot_may_wait(const frot_work *w, int row, double rest, double length) {
  return w->span.parting[row] && rest < LITTLE * length;
}

void frot_let_wait(int *order, int i, int last) {
  int waits = order[i];
  memmove(order + i, order + i + 1, sizeof *order * (size_t)(last - i));
  order[last] = waits;
}
