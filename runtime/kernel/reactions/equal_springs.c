#include "reactions/equal_springs.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"
#include "contact/spring_rows.h"
#include "numerics/dense.h"
#include "numerics/tolerances.h"
#include "reactions/reactions.h"

/* Whether a contact gives: it may part. Others hold rigidly. */
static int gives(const frot_problem *p, int contact) { return p->w->span.unilateral[contact] != 0; }

/* Whether friction of motion goes with the reaction of an unknown; at rest friction at its bound
 * does as well. */
static int slides(const frot_problem *p, int unknown) {
  const int *fold = p->w->reactions.fold + FROT_FOLDS * unknown;
  for (int i = 0; i < p->g->n_elements && fold[0] >= 0; i++) {
    int e = p->g->elements[i];
    if (frot_element_mode(p->m, p->modes, e)->friction <= FROT_STICK) continue;
    for (int k = 0; k < FROT_FOLDS; k++)
      if (fold[k] == p->m->elements[e].row) return 1;
  }
  return 0;
}

static const double *entries_of(const frot_problem *p, int row) {
  return frot_entries(p->m, p->g->general ? p->w->core.rows : p->w->core.half, row);
}

/* The held rows of p, with room for `more`. Returns whether any contact slides. */
static int begin(const frot_problem *p, frot_spring_rows *c, int more) {
  frot_reaction_work *r = &p->w->reactions;
  int i = 0, any = 0;
  frot_begin_springs(c, p->held + more, p->g->general ? p->g->n : p->g->n_speeds, r->spring_rows,
                     r->springs);
  for (int k = 0; k < p->g->n_contacts; k++) { /* contacts stand first among the unknowns */
    int contact = p->g->contacts[k];
    if (!frot_is_loaded(p->m, p->modes, contact)) continue;
    const double *row = entries_of(p, p->m->contacts[contact].row_n);
    frot_add_spring_row(c, i, row, gives(p, contact), slides(p, i));
    any |= slides(p, i), i++;
  }
  for (; i < p->held; i++) frot_add_spring_row(c, i, entries_of(p, r->unknown[i]), 0, 0);
  return any;
}

int frot_springs_are_redundant(const frot_model *m, frot_work *w, const frot_group *g,
                               const frot_contact_mode *modes) {
  frot_problem p = {.m = m, .w = w, .g = g, .modes = modes};
  frot_spring_rows c;
  frot_list_unknowns(&p, NULL);
  begin(&p, &c, 0);
  frot_combine_springs(&c, FROT_DEPENDENT, -1, -1);
  for (int k = 0; k < c.n; k++)
    if (frot_remains(&c, k)) return 1;
  return 0;
}

int frot_equal_springs(const frot_problem *p) {
  frot_work *w = p->w;
  int n = p->unknowns, count = 0, follows = w->span.follow;
  frot_spring_rows c;
  if (!begin(p, &c, 0)) return 0;
  /* inside a step it is decided which rows are redundant, and rows are off by its error */
  frot_combine_springs(&c, follows ? FROT_DEPENDENT_INSIDE : FROT_DEPENDENT,
                       follows ? p->equations - p->kept : -1, -1);
  for (int k = 0; k < c.n; k++) {
    if (!frot_is_compatible(&c, k)) continue;
    double *equation = w->reactions.compatible + count++ * n;
    memset(equation, 0, sizeof(double) * (size_t)n);
    for (int i = 0; i < c.n; i++)
      if (frot_is_spring(&c, i)) equation[i] = c.z[k * c.n + i];
  }
  return count;
}

void frot_hold_in_place_of(const frot_problem *p, const unsigned char *at_rest, int contact) {
  frot_work *w = p->w;
  frot_problem own = {.m = p->m, .w = w, .g = p->g, .modes = p->modes};
  frot_spring_rows c;
  if (!w->span.follow || w->span.spare[p->m->contacts[contact].row_n]) return;
  int best = -1;
  double longest = FROT_NOT_HELD;
  frot_list_unknowns(&own, at_rest);
  for (int i = 0; i < own.held; i++) {
    if (!w->span.spare[w->reactions.unknown[i]]) continue;
    begin(&own, &c, 0);
    frot_combine_springs(&c, FROT_DEPENDENT_INSIDE, -1, i);
    double left = frot_length(c.x + i * c.width, c.width);
    if (left > longest) longest = left, best = w->reactions.unknown[i];
  }
  if (best >= 0) w->span.spare[best] = 0;
}

enum frot_unloaded_spring frot_spring_of_unloaded(const frot_model *m, frot_work *w,
                                                  const frot_contact_mode *modes,
                                                  const unsigned char *at_rest, int contact,
                                                  double *force) {
  int row = m->contacts[contact].row_n;
  frot_problem p = {.m = m, .w = w, .g = frot_group_of(m, row), .modes = modes};
  frot_spring_rows c;
  *force = 0;
  frot_list_unknowns(&p, at_rest);
  int any = begin(&p, &c, 1);
  frot_add_spring_row(&c, p.held, entries_of(&p, row), 1, 0);
  frot_combine_springs(&c, FROT_DEPENDENT_INSIDE, -1, p.held);
  if (frot_length(c.x + p.held * c.width, c.width) > FROT_NOT_HELD) return FROT_SPRING_PARTS;
  if (!any || !frot_is_compatible(&c, p.held)) return FROT_SPRING_ALONE;
  const double *z = c.z + p.held * c.n;
  double sum = 0;
  for (int i = 0; i < p.held; i++)
    if (frot_is_spring(&c, i)) sum -= z[i] * w->core.lam[w->reactions.unknown[i]];
  *force = modes[contact].side * sum / z[p.held];
  return FROT_SPRING_BESIDE_SLIDING;
}

int frot_sliding_spring(const frot_problem *p) {
  for (int k = 0, c = 0; k < p->g->n_contacts; k++) {
    int contact = p->g->contacts[k];
    if (!frot_is_loaded(p->m, p->modes, contact)) continue;
    if (gives(p, contact) && slides(p, c)) return contact;
    c++;
  }
  return -1;
}

int frot_stretched_spring(const frot_problem *p, const double *lam, double least) {
  int stretched = -1;
  for (int k = 0; k < p->g->n_contacts; k++) {
    int contact = p->g->contacts[k];
    const frot_contact_mode *mode = &p->modes[contact];
    if (!mode->shared || !gives(p, contact) || !frot_is_loaded(p->m, p->modes, contact)) continue;
    double force = mode->side * lam[p->m->contacts[contact].row_n];
    if (force < least) least = force, stretched = contact;
  }
  return stretched;
}

/* Part of the largest reaction of the group that is rounding. */
static double rounding_of(const frot_problem *p) {
  double most = 0;
  for (int k = 0; k < p->g->n_rows; k++) most = fmax(most, fabs(p->w->core.lam[p->g->rows[k]]));
  return FROT_ROUNDING * most;
}

int frot_misplaced_spring(const frot_problem *p, const unsigned char *at_rest) {
  double most = rounding_of(p), force;
  int pressed = -1, stretched = frot_stretched_spring(p, p->w->core.lam, -most);
  if (stretched >= 0) return stretched;
  for (int k = 0; k < p->g->n_contacts; k++) {
    int contact = p->g->contacts[k];
    if (!p->modes[contact].closed || p->modes[contact].unloaded != FROT_BY_SPRINGS) continue;
    frot_spring_of_unloaded(p->m, p->w, p->modes, at_rest, contact, &force);
    if (force > most) most = force, pressed = contact;
  }
  return pressed;
}
