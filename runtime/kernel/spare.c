#include "spare.h"

#include <math.h>
#include <string.h>

#include "core.h"
#include "projection.h"
#include "terms.h"
#include "tolerances.h"

void frot_note_spare(const frot_model *m, frot_state *s, const frot_work *w) {
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_groups; k++) {
    const frot_group *g = &m->groups[now->groups[k]];
    for (int i = 0; i < g->n_rows; i++)
      s->data[w->layout.spare + g->rows[i]] = w->reactions.carried[g->rows[i]];
  }
}

void frot_follow_spare(const frot_model *m, const frot_state *s, frot_work *w) {
  w->span.follow = 0;
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n_groups; k++) {
    const frot_group *g = &m->groups[now->groups[k]];
    for (int i = 0; i < g->n_rows; i++) {
      int r = g->rows[i];
      w->span.spare[r] = s->data[w->layout.spare + r] != 0;
      w->span.follow |= w->span.spare[r];
    }
  }
}

void frot_see_anew(frot_work *w) { w->span.follow = 0; }

int frot_is_spare(const frot_work *w, int row) { return w->span.follow && w->span.spare[row]; }

int frot_spare_rows_hold(const frot_model *m, frot_state *s, frot_work *w, double t, double *z) {
  if (!w->span.follow) return 1;
  const double *d = s->data + w->layout.d;
  const frot_contact_mode *modes = (const void *)(s->data + w->layout.modes);
  int moved;
  if (frot_project(m, s, w, t, z, z + m->nq, d, modes, NULL, &moved) != FROT_OK) return 1;
  if (frot_kinematics(m, s, w, t, z, z + m->nq, d) != FROT_OK) return 1;
  const frot_awake_lists *now = w->awake.now;
  for (int i = 0; i < now->n_contacts; i++) {
    int c = now->contacts[i], row = m->contacts[c].row_n;
    if (row < 0 || m->contacts[c].reduced || !frot_is_spare(w, row)) continue;
    /* one that nothing moves is made of lengths all the same */
    double size = frot_gap_size(m, w, row, z) + s->data[w->layout.reach + c];
    if (fabs(w->core.gap[c]) > FROT_DEPENDENT * size) return 0;
  }
  return 1;
}

void frot_spare_nothing(const frot_model *m, frot_state *s, frot_work *w) {
  memset(s->data + w->layout.spare, 0, sizeof(double) * (size_t)m->n_rows);
  frot_see_anew(w);
}

long long frot_free_speeds(const frot_model *m, const frot_state *s, const frot_work *w) {
  long long held = 0;
  for (int i = 0; i < m->n_contacts; i++) {
    int row = m->contacts[i].row_n;
    if (row < 0 || m->contacts[i].reduced || s->data[w->layout.unilateral + i] != 0) continue;
    held += !w->reactions.carried[row];
  }
  return m->nv - held;
}
