#include "evaluation/evaluation_workspace.h"

#include "inertia/articulated.h"
#include "inertia/mass_matrix.h"
#include "numerics/dense.h"

#define TAKE(field, count) FROT_TAKE(a, field, count)

void frot_bind_core(const frot_model *m, const frot_layout *l, frot_core_work *w, frot_arena *a) {
  int nr = m->n_rows, general = m->general != 0;
  TAKE(w->qd, m->nq), TAKE(w->mass, m->n_matrix), TAKE(w->h, l->nw), TAKE(w->rows, m->n_entries);
  int given = 0;
  for (int k = 0; k < m->n_groups; k++) given += m->groups[k].n_given;
  TAKE(w->given, given), TAKE(w->reach, 2 * nr);
  TAKE(w->c, nr), TAKE(w->rate, nr), TAKE(w->gap, m->n_contacts);
  TAKE(w->condition, m->n_conditions), TAKE(w->coefficient, 2 * m->n_elements), TAKE(w->power, 1);
  TAKE(w->effect, general * m->n_entries), TAKE(w->metric, general * m->n_metric);
  TAKE(w->factor, m->n_metric), TAKE(w->unit, m->n_metric), TAKE(w->share, l->nw),
      TAKE(w->force, l->nw), TAKE(w->half, m->n_entries);
  TAKE(w->lu, general * m->n_matrix), TAKE(w->lu_scale, general * 2 * l->nw);
  TAKE(w->lu_pivot, general * l->nw);
  TAKE(w->wanted, nr), TAKE(w->formed, m->n_groups), TAKE(w->listed, nr),
      TAKE(w->support, 2 * nr + 2), TAKE(w->free, nr), TAKE(w->delassus, m->n_square);
  TAKE(w->load, l->nw), TAKE(w->load_size, l->nw), TAKE(w->row_load, nr);
  TAKE(w->bias_size, nr);
  TAKE(w->lam, nr), TAKE(w->a, l->nw), TAKE(w->rest, l->nw), TAKE(w->column, l->nw);
  int steps = 0, abreast = 0;
  for (int k = 0; k < m->n_groups; k++)
    abreast =
        frot_larger(abreast, m->groups[k].n_speeds * (m->groups[k].n_rows + 2 * FROT_ABREAST));
  TAKE(w->abreast, abreast);
  if (frot_has_vectors(m)) TAKE(w->frame, 9 * m->n_elements), TAKE(w->lam_of_text, nr);
  for (int k = 0; k < m->n_groups; k++) steps = frot_larger(steps, m->groups[k].n_links);
  TAKE(w->inertia, FROT_STEP_INERTIA * steps), TAKE(w->twist, FROT_STEP_TWIST * steps);
  TAKE(w->motion, FROT_STEP_TWIST * steps);
  TAKE(w->momenta, steps > 0 ? l->nw : 0);
}

void frot_bind_blocks(const frot_model *m, const frot_extent *e, frot_block_work *w,
                      frot_arena *a) {
  int n = e->block;
  TAKE(w->y, m->ny), TAKE(w->r, 2 * n), TAKE(w->j, n * n), TAKE(w->lu, n * n), TAKE(w->size, 2 * n);
  TAKE(w->step, 4 * n), TAKE(w->scale, n * n + 5 * n), TAKE(w->pivot, n);
}
