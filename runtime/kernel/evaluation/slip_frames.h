/* Slips of several components: the rows of an element turned so that its slip is along the first.
 *
 * A law on a motion of n components is n elements that follow each other (tables.h). While it slips
 * its first element has the mode FROT_SLIP_FORWARD along the direction d of the slip, the others
 * FROT_NONE: with the rows turned into an orthonormal frame that begins with d, it is one friction
 * along one row, whose rate is |s| and whose acceleration is d|s|/dt. At rest all n rows hold, and
 * no frame is made. */
#ifndef FROT_SLIP_FRAMES_H
#define FROT_SLIP_FRAMES_H

#include "model/workspace.h"

enum { FROT_MOST_PARTS = 3 };

/* Whether element e is the first of several. */
static inline int frot_is_vector(const frot_model *m, int e) {
  return m->elements[e].parts > 1 && m->elements[e].part == 0;
}
/* Whether it is one of several, but not the first. */
static inline int frot_is_later_part(const frot_model *m, int e) { return m->elements[e].part > 0; }

/* Turn the rows of all awake elements that slip in `modes`, after the generated functions of the
 * instant: w->core.rows, effect, c and rate. The direction is that of the slip; where the mode says
 * `starts`, or nothing moves, it is the one kept as its heading. With w->reactions.ahead it is so
 * too where the slip is turned far from its heading: the friction is smooth where the slip passes
 * zero, and its rate along the heading changes sign there. */
void frot_turn_slip_rows(const frot_model *m, const frot_state *s, frot_work *w,
                         const frot_contact_mode *modes);

/* The reactions in the rows as the text has them: w->core.lam, or where rows were turned a copy. */
const double *frot_lam_of_text(const frot_model *m, frot_work *w);

/* Direction of the slip of element e in its rows as the text has them, from the speeds of
 * w->core.rate before they are turned. Returns |s|. */
double frot_slip_of(const frot_model *m, const double *rate, int e, double d[FROT_MOST_PARTS]);
/* The same after its rows were turned: into `d` (parts) the direction in the rows of the text. */
double frot_turned_slip(const frot_model *m, const frot_work *w, int e, double *d);

#endif
