/* Contacts of shared reactions that bear nothing, since their springs would be stretched. */
#include <string.h>

#include "reactions/equal_springs.h"
#include "reactions/force_problem.h"
#include "reactions/reactions.h"

/* Whether a contact that bears nothing would part: the rows of the others do not hold its own. */
static int any_parts(const frot_problem *p, const unsigned char *at_rest) {
  double force;
  for (int k = 0; k < p->g->n_contacts; k++) {
    int contact = p->g->contacts[k];
    if (p->modes[contact].closed && p->modes[contact].unloaded == FROT_BY_SPRINGS &&
        frot_spring_of_unloaded(p->m, p->w, p->modes, at_rest, contact, &force) ==
            FROT_SPRING_PARTS)
      return 1;
  }
  return 0;
}

int frot_find_bearing(frot_problem *p, const unsigned char *at_rest) {
  frot_work *w = p->w;
  frot_contact_mode *bearing = w->reactions.bearing;
  unsigned char *spare = w->reactions.spare_before;
  size_t rows = (size_t)p->m->n_rows;
  memcpy(bearing, p->modes, sizeof *bearing * (size_t)(p->m->n_contacts + p->m->n_elements));
  memcpy(spare, w->span.spare, rows);
  p->modes = bearing;
  int failed = 1, tries = 0;
  for (int changed = w->reactions.stretched; changed >= 0 && tries <= 2 * p->g->n_contacts;
       tries++) {
    bearing[changed].unloaded = bearing[changed].unloaded ? 0 : FROT_BY_SPRINGS;
    memcpy(w->span.spare, spare, rows);
    for (int k = 0; k < p->g->n_contacts; k++)
      if (bearing[p->g->contacts[k]].unloaded == FROT_BY_SPRINGS)
        frot_hold_in_place_of(p, at_rest, p->g->contacts[k]);
    failed = frot_solve_reactions(p, at_rest) || any_parts(p, at_rest);
    changed = w->reactions.stretched;
    if (changed < 0 && !failed) changed = frot_misplaced_spring(p, at_rest);
  }
  memcpy(w->span.spare, spare, rows);
  return failed;
}
