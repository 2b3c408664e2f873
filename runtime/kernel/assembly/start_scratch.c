#include "assembly/start_scratch.h"

#define TAKE(field, count) FROT_TAKE(a, field, count)

void frot_bind_relations(const frot_model *m, const frot_layout *l, const frot_extent *e,
                         frot_work *w, frot_arena *a) {
  frot_relation_work *r = &w->relations;
  int wide = e->states, big = e->square, across = e->across, least = big < across ? big : across;
  TAKE(w->linear.matrix, big * frot_larger(big, across)), TAKE(w->linear.right, 2 * big);
  TAKE(w->linear.scratch, 2 * big * big + 6 * big + 4 * across + least * across);
  TAKE(w->linear.pivot, 2 * frot_larger(big, wide));
  TAKE(r->jacobian, e->slopes), TAKE(r->residual, e->equations + l->nw);
  TAKE(r->size, e->equations), TAKE(r->step, wide + l->nw + e->equations);
  TAKE(r->unit, wide), TAKE(r->rows, m->n_rows + m->n_contacts + m->n_elements);
  TAKE(r->bounds, 2 * e->equations);
}

void frot_bind_opening(const frot_model *m, const frot_part *largest, const frot_extent *e,
                       frot_opening_work *w, frot_arena *a) {
  int nx = largest->n_unknowns, own = largest->n_own, ny = largest->ny;
  TAKE(w->use, m->n_contacts), TAKE(w->witness, 3 * m->n_contacts), TAKE(w->reach, m->n_contacts);
  TAKE(w->residual_y, own * largest->n_stated), TAKE(w->slopes, nx * own);
  TAKE(w->slopes_y, own * own + 3 * own), TAKE(w->slopes_pivot, own);
  TAKE(w->factor, nx * nx), TAKE(w->row_weight, e->equations);
  /* found, begin and apart are also of all coordinates: tangent_cone.c, start_branch.c */
  TAKE(w->off_at_first, e->equations), TAKE(w->begin, e->states), TAKE(w->found, e->states),
      TAKE(w->apart, e->states);
  TAKE(w->nearest, nx + ny), TAKE(w->second, nx), TAKE(w->way, nx), TAKE(w->next_way, nx);
  TAKE(w->behind, nx), TAKE(w->here, nx), TAKE(w->first_factor, nx * nx), TAKE(w->first_unit, nx);
  TAKE(w->scratch, frot_larger(3 * nx, m->nv)), TAKE(w->left, e->equations), TAKE(w->met, m->nq);
  TAKE(w->guess_weight, 2 * m->n_guessed), TAKE(w->begin_y, ny), TAKE(w->fresh, m->ny);
  TAKE(w->other, 2 * (nx + ny)), TAKE(w->near, nx + ny), TAKE(w->x, nx),
      TAKE(w->read, largest->reads.nq);
  TAKE(w->own, nx), TAKE(w->rows, e->equations), TAKE(w->number, frot_larger(m->nq, m->nv));
  TAKE(w->turns, largest->n_turns), TAKE(w->left_out, largest->n_stated), TAKE(w->kept, nx);
  TAKE(w->state, nx), TAKE(w->chosen, e->equations);
  TAKE(w->contact_of, largest->n_contacts);
  TAKE(w->sides, 4 * largest->n_contacts), TAKE(w->start, m->nv);
  TAKE(w->first, frot_larger(m->nq, nx + ny + largest->n_contacts)),
      TAKE(w->first_use, largest->n_contacts);
  TAKE(w->outside, 2 * (nx + ny));
  TAKE(w->descent, 6 * nx), TAKE(w->multiplier, e->equations);
}
