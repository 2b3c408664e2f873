/* The unknown reactions of a group, and what each of them does. */
#include "reactions/force_problem.h"

#include <string.h>

#include "evaluation/evaluate.h"
#include "reactions/reactions.h"

/* Friction of an element over what bounds it, with its sign. */
static double ratio_of(const frot_problem *p, int e, const unsigned char *at_rest) {
  const frot_contact_mode *contact = &p->modes[p->m->elements[e].contact];
  const frot_contact_mode *mode = frot_element_mode(p->m, p->modes, e);
  const double *k = p->w->core.coefficient + 2 * e;
  if (!contact->closed || contact->unloaded) return 0;
  if (mode->friction == FROT_STICK) return mode->at_bound * contact->side * k[1];
  double size = at_rest && at_rest[e] ? k[1] : k[0];
  if (mode->friction == FROT_SLIP_FORWARD) return -contact->side * size;
  if (mode->friction == FROT_SLIP_BACKWARD) return contact->side * size;
  return 0;
}

void frot_list_unknowns(frot_problem *p, const unsigned char *at_rest) {
  const frot_model *m = p->m;
  const frot_group *g = p->g;
  frot_work *w = p->w;
  int n = 0;
  /* what always holds stands first, friction depends on it */
  for (int i = 0; i < g->n_contacts; i++)
    if (frot_is_loaded(m, p->modes, g->contacts[i]))
      w->reactions.unknown[n++] = m->contacts[g->contacts[i]].row_n;
  for (int k = 0; k < n; k++) w->reactions.friction[k] = 0;
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    w->reactions.ratio[e] = 0;
    if (!frot_is_held(m, p->modes, e)) continue;
    w->reactions.friction[n] = (unsigned char)(1 + (m->elements[e].bound == FROT_BY_VALUE));
    w->reactions.owner[n] = e;
    w->reactions.unknown[n++] = m->elements[e].row;
  }
  p->held = n;
  for (int k = 0; k < FROT_FOLDS * n; k++) w->reactions.fold[k] = -1;
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    const frot_element *element = &m->elements[e];
    double ratio = ratio_of(p, e, at_rest);
    w->reactions.ratio[e] = ratio;
    if (ratio == 0 || element->bound == FROT_BY_VALUE) continue;
    if (element->bound == FROT_BY_NORMAL && !frot_is_reading(m, element->bounded_by[0])) {
      for (int k = 0; k < p->held; k++) {
        if (w->reactions.unknown[k] != element->bounded_by[0]) continue;
        int at = FROT_FOLDS * k;
        while (w->reactions.fold[at] >= 0) at++;
        w->reactions.fold[at] = element->row, w->reactions.fold_ratio[at] = ratio;
      }
      continue;
    }
    w->reactions.friction[n] = 0, w->reactions.owner[n] = e;
    for (int k = 0; k < FROT_FOLDS; k++) w->reactions.fold[FROT_FOLDS * n + k] = -1;
    w->reactions.unknown[n++] = element->row;
  }
  p->unknowns = n;
}

double frot_unknown_effect(const frot_problem *p, int row, int c) {
  const frot_work *w = p->w;
  const double *effects = frot_effect_on(p->m, w, row);
  double value = effects[p->m->row_local[w->reactions.unknown[c]]];
  for (int k = FROT_FOLDS * c; k < FROT_FOLDS * (c + 1); k++)
    if (w->reactions.fold[k] >= 0)
      value += w->reactions.fold_ratio[k] * effects[p->m->row_local[w->reactions.fold[k]]];
  return value;
}

double frot_known_part(const frot_problem *p, int row) {
  const frot_model *m = p->m;
  double sum = p->w->core.free[row];
  for (int i = 0; i < p->g->n_elements; i++) {
    int e = p->g->elements[i];
    if (m->elements[e].bound == FROT_BY_VALUE && p->w->reactions.ratio[e] != 0)
      sum += p->w->reactions.ratio[e] * frot_effect(m, p->w, row, m->elements[e].row);
  }
  return sum;
}

void frot_unknown_column(const frot_problem *p, int c, double *x) {
  const frot_model *m = p->m;
  frot_work *w = p->w;
  const frot_group *g = p->g;
  int ns = g->n_speeds;
  if (c >= 0) {
    memcpy(x, frot_entries(m, w->core.half, w->reactions.unknown[c]), sizeof(double) * (size_t)ns);
    for (int k = FROT_FOLDS * c; k < FROT_FOLDS * (c + 1); k++) {
      if (w->reactions.fold[k] < 0) continue;
      const double *half = frot_entries(m, w->core.half, w->reactions.fold[k]);
      for (int j = 0; j < ns; j++) x[j] += w->reactions.fold_ratio[k] * half[j];
    }
    return;
  }
  memcpy(x, w->core.force + g->vector, sizeof(double) * (size_t)ns);
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    if (m->elements[e].bound != FROT_BY_VALUE || w->reactions.ratio[e] == 0) continue;
    const double *half = frot_entries(m, w->core.half, m->elements[e].row);
    for (int j = 0; j < ns; j++) x[j] += w->reactions.ratio[e] * half[j];
  }
}
