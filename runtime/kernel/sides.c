#include "sides.h"

#include "core.h"
#include "elsewhere.h"
#include "islands.h"
#include "tolerances.h"

void frot_look_at_sides(const frot_opening *p) {
  frot_opening_work *w = &p->w->opening;
  frot_call_sides(p->s, p->w, p->part, p->t, p->q, p->v, p->d, w->witness, w->reach);
}

static int sign_beyond(double x, double rounding) {
  return x > rounding ? 1 : x < -rounding ? -1 : 0;
}

int frot_choose_sides(const frot_opening *p, double *side, int natural) {
  const frot_model *m = p->m;
  const double *unilateral = p->s->data + p->w->layout.unilateral;
  int changes = 0;
  frot_look_at_sides(p);
  for (int k = 0; k < p->part->n_contacts; k++) {
    int i = p->part->contacts[k];
    if (!frot_has_normal(&m->contacts[i]) || (p->use[i] && unilateral[i] != 0)) continue;
    const double *witness = p->w->opening.witness + 3 * i;
    double rounding = FROT_TOUCH * frot_length_size(m, p->w, i, p->q);
    int sign = natural ? 0 : sign_beyond(witness[0], rounding);
    if (sign == 0) sign = sign_beyond(witness[1], FROT_TOUCH);
    if (sign == 0) sign = sign_beyond(witness[2], rounding);
    if (sign == 0) sign = 1;
    changes += sign != (int)side[i];
    side[i] = sign;
  }
  return changes;
}

/* Whether contact i of the scene is none of the equations, and the part is inside of it. */
static int is_inside(const frot_opening *p, int i) {
  const frot_model *m = p->m;
  const frot_work *w = p->w;
  if (p->use[i] || m->contacts[i].reduced || !frot_has_normal(&m->contacts[i])) return 0;
  return w->core.gap[i] < -FROT_TOUCH * frot_length_size(m, w, i, p->q);
}

int frot_keep_outside(frot_opening *p) {
  const frot_part *part = p->part;
  for (;;) {
    int status = frot_solve_widely(p), added = 0;
    if (status != FROT_OK) return status;
    frot_look_at_sides(p);
    for (int k = 0; k < part->n_contacts; k++)
      if (is_inside(p, part->contacts[k])) p->use[part->contacts[k]] = 1, added = 1;
    if (!added) return FROT_OK;
  }
}
