/* The modes that a contact and its elements may take at an instant. */
#include "modes/mode_options.h"

#include <math.h>
#include <string.h>

#include "evaluation/evaluate.h"

static const frot_contact_mode OPEN = {0, 1, 0, 0, 0, 0, 0, {0}};

int frot_bounds_something(const frot_model *m, const frot_work *w, int element) {
  const double *k = w->core.coefficient + 2 * element;
  return !(m->elements[element].fixed && k[0] == 0 && k[1] == 0);
}

/* Elements of a contact; returns how many. */
int frot_laws_of(const frot_model *m, int contact, int own[FROT_LAWS_OF_CONTACT]) {
  const frot_group *g = &m->groups[m->contact_group[contact]];
  int n = 0;
  for (int k = 0; k < g->n_elements && n < FROT_LAWS_OF_CONTACT; k++)
    if (m->elements[g->elements[k]].contact == contact) own[n++] = g->elements[k];
  return n;
}

/* The direction in which rest ends now; a prescribed motion says itself. */
static int direction_left(const frot_instant *in, int e) {
  int left = (int)in->left[e];
  if (left != 0 && in->m->elements[e].prescribed)
    return in->w->core.c[in->m->elements[e].row] > 0 ? 1 : -1;
  return left;
}

/* The modes one element may take. */
static int element_options(const frot_instant *in, int e, int forced, frot_contact_mode *list) {
  static const signed char ways[3] = {FROT_STICK, FROT_SLIP_FORWARD, FROT_SLIP_BACKWARD};
  const frot_contact_mode still = {0, 0, 0, FROT_STICK, 0, 0, 0, {0}};
  int n = 0, left = direction_left(in, e);
  list[0] = still;
  if (!frot_bounds_something(in->m, in->w, e)) return list[0].friction = FROT_NONE, 1;
  if (!in->zero[e]) {
    double rate = in->w->core.rate[in->m->elements[e].row];
    return list[0].friction = rate > 0 ? FROT_SLIP_FORWARD : FROT_SLIP_BACKWARD, 1;
  }
  if (!in->at_rest[e]) { /* it departs, in either direction */
    list[0].friction = FROT_SLIP_FORWARD;
    list[1] = still, list[1].friction = FROT_SLIP_BACKWARD;
    return 2;
  }
  if (left != 0 && forced)
    return list[0].friction = left > 0 ? FROT_SLIP_FORWARD : FROT_SLIP_BACKWARD, 1;
  for (int k = 0; k < 3; k++) list[n] = still, list[n++].friction = ways[k];
  if (left != 0 && !in->m->elements[e].prescribed) /* others may hold what it cannot */
    list[n] = still, list[n++].at_bound = (signed char)-left;
  return n;
}

/* Whether an option has the modes that are known. */
static int agrees(const frot_instant *in, int i, const int *own, int laws, const frot_option *one) {
  if (one->contact.closed != in->given[i].closed) return 0;
  if (!one->contact.closed) return 1;
  int slips = 0;
  for (int k = 0; k < laws; k++) {
    int friction = in->given[in->m->n_contacts + own[k]].friction;
    if (one->element[k].friction != friction) return 0;
    slips |= friction > FROT_STICK;
  }
  return !slips || in->unilateral[i] != 0 || one->contact.side == in->given[i].side;
}

int frot_contact_options(const frot_instant *in, int i, int forced, frot_option *list) {
  const frot_contact *contact = &in->m->contacts[i];
  frot_contact_mode before = in->w->search.before[i], modes[FROT_LAWS_OF_CONTACT][4];
  int own[FROT_LAWS_OF_CONTACT], counts[FROT_LAWS_OF_CONTACT] = {1, 1},
                                 laws = frot_laws_of(in->m, i, own), n = 0;
  int can_open = in->unilateral[i] != 0 && frot_has_normal(contact);
  int one_sided = can_open || !frot_has_normal(contact), acts = 0;
  int changes = forced && before.closed && in->fired[i] != 0;
  memset(modes, 0, sizeof modes);
  for (int k = 0; k < laws; k++) {
    counts[k] = element_options(in, own[k], forced, modes[k]);
    acts |= modes[k][0].friction != FROT_NONE;
  }
  /* a reaction that came to zero may stay there, if others carry the load */
  int unloads = before.closed && can_open && !contact->reduced && in->fired[i] != 0;
  for (int a = 0; a < counts[0] && !(changes && can_open); a++)
    for (int b = 0; b < counts[1]; b++)
      for (int side = 1; side >= -1; side -= 2) {
        int held = modes[0][a].friction <= FROT_STICK && modes[1][b].friction <= FROT_STICK;
        int turns = changes && !one_sided;
        if (side < 0 && (one_sided || !acts)) continue;
        if (turns && side == before.side) continue;
        /* the side follows from the reaction, but friction at its bound from the side */
        if (side < 0 && !turns && held && !modes[0][a].at_bound && !modes[1][b].at_bound) continue;
        for (int unloaded = unloads; unloaded >= 0; unloaded--, n++)
          list[n] = (frot_option){{1, (signed char)side, (signed char)unloaded, 0, 0, 0, 0, {0}},
                                  {modes[0][a], modes[1][b]}};
      }
  if (can_open) list[n] = (frot_option){OPEN, {{0}, {0}}}, n++;
  int kept = 0;
  for (int k = 0; k < n && in->given; k++)
    if (agrees(in, i, own, laws, &list[k])) list[kept++] = list[k];
  return in->given ? kept : n;
}

void frot_take_option(const frot_instant *in, int i, const frot_option *option) {
  int own[FROT_LAWS_OF_CONTACT], laws = frot_laws_of(in->m, i, own);
  in->w->search.trial[i] = option->contact;
  for (int k = 0; k < laws; k++)
    in->w->search.trial[in->m->n_contacts + own[k]] = option->element[k];
}
