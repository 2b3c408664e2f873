#include "evaluation/held_modes.h"

#include "model/indexing.h"

/* Followers from which on it costs less than a system for all of them. */
#define MANY 3

int frot_only_follows(const frot_model *m, const frot_group *g, const frot_contact_mode *modes) {
  int followers = 0;
  for (int i = 0; i < g->n_contacts; i++) {
    int c = g->contacts[i];
    if (modes[c].unloaded || frot_is_loaded(m, modes, c)) return 0;
  }
  for (int i = 0; i < g->n_elements; i++) {
    int e = g->elements[i];
    const frot_element *element = &m->elements[e];
    const frot_contact_mode *mode = frot_element_mode(m, modes, e);
    if (!modes[element->contact].closed || mode->friction == FROT_NONE) continue;
    if (mode->friction == FROT_STICK || mode->at_bound != 0) return 0;
    if (element->bound == FROT_BY_VALUE) continue;
    if (!frot_is_reading(m, element->bounded_by[0])) return 0;
    followers++;
  }
  return followers >= MANY;
}

int frot_is_loop(const frot_model *m, const frot_state *s, const frot_work *w, int contact) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  return s->data[w->layout.unilateral + contact] == 0 && frot_is_loaded(m, modes, contact) &&
         !frot_group_of(m, m->contacts[contact].row_n)->general;
}
