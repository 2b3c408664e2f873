#include "nearer.h"

#include <math.h>
#include <string.h>

#include "core.h"
#include "tolerances.h"

/* The gap of a contact at the values x, with the places found from those in w->blocks.y; NaN where
 * there is none. */
static double gap_at(const frot_model *m, frot_state *s, frot_work *w, int contact, double t,
                     const double *x) {
  if (frot_kinematics(m, s, w, t, x, x + m->nq, s->data + w->layout.d) != FROT_OK) return NAN;
  return w->core.gap[contact];
}

/* The place of a contact in y (ny) <- that in `place`. */
static void set_place(const frot_model *m, const double *place, int contact, double *y) {
  const frot_block *block = &m->blocks[m->contacts[contact].followed];
  memcpy(y + block->first, place + block->first, sizeof(double) * (size_t)block->count);
}

/* Whether the place in w->blocks.y is on the figures, which may have ends. */
static int is_within(const frot_model *m, const frot_work *w, int contact) {
  const frot_block *block = &m->blocks[m->contacts[contact].followed];
  for (int k = block->first; k < block->first + block->count; k++)
    if (!(w->blocks.y[k] >= w->nearer.least[k] && w->blocks.y[k] <= w->nearer.largest[k])) return 0;
  return 1;
}

/* Whether the figures of an open contact are nearer than `far` at another place, which is then
 * kept; -1 where they have passed through each other there. */
static int look(const frot_model *m, frot_state *s, frot_work *w, int contact, double t, double end,
                double far) {
  double *y = w->blocks.y;
  memcpy(y, w->step.y_end, sizeof(double) * (size_t)m->ny);
  set_place(m, w->nearer.begin, contact, y);
  double other = gap_at(m, s, w, contact, end, w->step.z1);
  if (!(fabs(other) < (1 - FROT_NEARER) * far) || !is_within(m, w, contact)) return 0;
  if (other < 0) return gap_at(m, s, w, contact, t, w->step.z0) > 0 ? -1 : 0;
  set_place(m, y, contact, w->nearer.y);
  w->nearer.changed[contact] = 1;
  return 1;
}

/* Kinematics of the end, and where searches begin there. */
static void look_at_end(const frot_model *m, frot_state *s, frot_work *w, double end) {
  const double *x = w->step.z1, *d = s->data + w->layout.d;
  memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)m->ny);
  frot_kinematics(m, s, w, end, x, x + m->nq, d);
  memcpy(w->nearer.far, w->core.gap, sizeof(double) * (size_t)m->n_contacts);
  frot_inputs(m, s, w, &end, x, x + m->nq, d);
  w->call.res[0] = w->nearer.begin, w->call.res[1] = w->nearer.least;
  w->call.res[2] = w->nearer.largest;
  frot_call(w, &m->beginnings);
}

int frot_look_nearer(const frot_model *m, frot_state *s, frot_work *w, double t, double end) {
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  const double *unilateral = s->data + w->layout.unilateral;
  const frot_awake_lists *now = w->awake.now;
  int found = 0, listed = 0;
  w->nearer.count = 0;
  if (m->n_followed == 0) return 0;
  memset(w->nearer.changed, 0, (size_t)m->n_contacts);
  for (int k = 0; k < now->n_contacts; k++) {
    int i = now->contacts[k];
    if (m->contacts[i].followed < 0 || modes[i].closed || unilateral[i] == 0) continue;
    if (!listed) look_at_end(m, s, w, end), listed = 1;
    int nearer = look(m, s, w, i, t, end, w->nearer.far[i]);
    if (nearer < 0) return -1;
    found += nearer;
  }
  memcpy(w->blocks.y, w->step.y_end, sizeof(double) * (size_t)m->ny);
  if (listed) frot_kinematics(m, s, w, end, w->step.z1, w->step.z1 + m->nq, s->data + w->layout.d);
  return w->nearer.count = found;
}

void frot_take_nearer(const frot_model *m, const frot_work *w, double *y) {
  for (int i = 0; i < m->n_contacts && w->nearer.count > 0; i++)
    if (m->contacts[i].followed >= 0 && w->nearer.changed[i]) set_place(m, w->nearer.y, i, y);
}
