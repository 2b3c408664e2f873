#include "assembly/closing_speeds.h"

#include <float.h>
#include <string.h>

#include "assembly/gauss_newton.h"
#include "assembly/start_parts.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

/* Rounds in which all contacts that are approached become equations at once; after these only the
 * first one does (K. G. Murty's rule of the least index), which cannot come back to the same set.
 */
#define AT_ONCE 10

/* The problem is: the least change of the speeds, in the metric of the mass, after which no rate of
 * a closed contact is negative. The contacts whose rate is zero for it are equations, and each of
 * them pushes: without it alone its rate would be negative. */

/* Whether the speeds of the part change the gap of contact i: 1 if it opens, -1 if it closes. */
static int direction_of(const frot_opening *p, int i) {
  const frot_model *m = p->m;
  int row = m->contacts[i].row_n;
  double rate = p->w->core.rate[row];
  double size = DBL_EPSILON * frot_row_size(m, p->w, row, p->v) +
                FROT_NO_DIGIT * frot_row_speed(m, p->w, row, p->v);
  return rate > size ? 1 : rate < -size ? -1 : 0;
}

static int may_part(const frot_opening *p, int i) {
  const frot_contact *contact = &p->m->contacts[i];
  const double *unilateral = p->s->data + p->w->layout.unilateral;
  return frot_has_normal(contact) && !contact->reduced && unilateral[i] != 0;
}

/* The speeds nearest to those of the beginning for which the equations hold. */
static int solve_again(frot_opening *p) {
  memcpy(p->x, p->w->opening.start, sizeof(double) * (size_t)p->n_own);
  return frot_solve_nearest(p);
}

/* Take for equations the closed contacts that are approached, or the first of them. */
static int add_approached(const frot_opening *p, const frot_contact_mode *modes, int first) {
  int added = 0;
  for (int k = 0; k < p->part->n_contacts && !(first && added); k++) {
    int i = p->part->contacts[k];
    if (p->use[i] || !modes[i].closed || !may_part(p, i) || direction_of(p, i) >= 0) continue;
    p->use[i] = 1, added++;
  }
  return added;
}

/* Leave out the first contact without which the equations have a solution, and which opens then if
 * it is to be one that `pulls`. */
static int leave_one(frot_opening *p, int pulls) {
  for (int k = 0; k < p->part->n_contacts; k++) {
    int i = p->part->contacts[k];
    if (!p->use[i] || !may_part(p, i)) continue;
    p->use[i] = 0;
    if (solve_again(p) == FROT_OK && (!pulls || direction_of(p, i) > 0)) return 1;
    frot_clear_opening(p);
    p->use[i] = 1;
  }
  return 0;
}

/* Leave out all contacts that may part. */
static void leave_all(const frot_opening *p) {
  for (int k = 0; k < p->part->n_contacts; k++)
    if (may_part(p, p->part->contacts[k])) p->use[p->part->contacts[k]] = 0;
}

/* Open the contacts that separate. */
static void open_separating(const frot_opening *p, frot_contact_mode *modes) {
  for (int k = 0; k < p->part->n_contacts; k++) {
    int i = p->part->contacts[k];
    if (!p->use[i] && may_part(p, i) && direction_of(p, i) > 0) modes[i].closed = 0;
  }
}

/* The nearest speeds that close no contact, into p->x. FROT_INITIAL where there are none. */
static int stop_all(frot_opening *p, frot_contact_mode *modes) {
  int count = p->part->n_contacts, equations = 0, one_by_one = 0, status = FROT_OK, settled = 0;
  memcpy(p->w->opening.start, p->x, sizeof(double) * (size_t)p->n_own);
  for (int round = 0; round < AT_ONCE + count * count && !settled; round++) {
    one_by_one |= round >= AT_ONCE;
    status = solve_again(p);
    if (status == FROT_INITIAL && equations > 1) {
      frot_clear_opening(p);
      if (!one_by_one)
        leave_all(p), one_by_one = 1, equations = 0;
      else if (leave_one(p, 0))
        equations--;
      else
        return solve_again(p);
      continue;
    }
    if (status != FROT_OK) return status;
    int added = add_approached(p, modes, one_by_one);
    equations += added;
    if (added) continue;
    settled = equations < 2 || !leave_one(p, 1);
    if (settled && equations > 1) status = solve_again(p);
    if (!settled) equations--;
  }
  if (!settled) { /* no set of equations keeps all contacts from closing: say which contradict */
    add_approached(p, modes, 0);
    status = solve_again(p);
  }
  return status;
}

/* Whether a closed contact of the part that may part is approached. */
static int any_approached(const frot_opening *p, const frot_contact_mode *modes) {
  for (int k = 0; k < p->part->n_contacts; k++) {
    int i = p->part->contacts[k];
    if (modes[i].closed && may_part(p, i) && direction_of(p, i) < 0) return 1;
  }
  return 0;
}

int frot_stop_approach(frot_opening *p, frot_contact_mode *modes) {
  int status = stop_all(p, modes);
  if (status == FROT_INITIAL) { /* speeds are stated that close contacts: they meet at once */
    frot_fault fault = p->s->fault;
    frot_clear_opening(p);
    leave_all(p);
    status = solve_again(p);
    if (status == FROT_OK && !any_approached(p, modes))
      status = FROT_INITIAL, p->s->fault = fault, p->s->phase = FROT_FAULTED;
  }
  if (status == FROT_OK) open_separating(p, modes);
  return status;
}
