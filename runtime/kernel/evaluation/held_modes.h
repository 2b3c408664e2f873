/* What modes say of groups and liaisons by the tables alone. */
#ifndef FROT_HELD_MODES_H
#define FROT_HELD_MODES_H

#include "model/workspace.h"

/* Whether the friction of several elements follows readings and nothing else acts in a group, that
 * is no general one, so that frot_iterate_friction is tried first (friction_fixed_point.c). */
int frot_only_follows(const frot_model *m, const frot_group *g, const frot_contact_mode *modes);

/* Whether a contact keeps a relation of a loop: it cannot open, and no coordinate keeps it. */
int frot_is_loop(const frot_model *m, const frot_state *s, const frot_work *w, int contact);

#endif
