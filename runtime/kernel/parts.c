#include "parts.h"

#include <string.h>

void frot_take_part(frot_opening *p, int part) {
  frot_opening_work *w = &p->w->opening;
  int nx = frot_opening_count(p);
  p->part = part, p->n_own = 0;
  for (int k = 0; k < nx; k++)
    w->is_own[k] = (unsigned char)(p->velocity || part < 0 || p->m->q_part[k] == part);
  for (int k = 0; k < nx; k++)
    if (w->is_own[k] && frot_is_attached(p, k)) w->own[p->n_own++] = k;
  p->attached = p->n_own;
  for (int k = 0; k < nx; k++)
    if (w->is_own[k] && !frot_is_attached(p, k)) w->own[p->n_own++] = k;
}

void frot_leave_others(frot_opening *p, int count) {
  frot_relation_work *r = &p->w->relations;
  int nx = frot_opening_count(p);
  p->n_rows = 0;
  for (int i = 0; i < count; i++) {
    int part = p->w->opening.row_part[i];
    if (part != FROT_NO_PART && (p->velocity || frot_is_of_part(p, part))) {
      if (i < p->n) p->w->opening.rows[p->n_rows++] = i;
      continue;
    }
    r->residual[i] = r->size[i] = 0;
    memset(r->jacobian + nx * i, 0, sizeof(double) * (size_t)nx);
    r->bounds[2 * i] = r->bounds[2 * i + 1] = 0;
  }
}
