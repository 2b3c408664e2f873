#include "stepping/step_ends.h"

#include <math.h>
#include <string.h>

#include "model/sleeping.h"
#include "evaluation/evaluate.h"
#include "reactions/switching_functions.h"
#include "methods/right_hand_side.h"
#include "constraints/redundant_rows.h"
#include "methods/dormand_prince.h"
#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"
#include "singular/tangent_cone.h"

/* What a step leaves of the size that a force once had: at a jam in passing it is without bound,
 * and nothing would be known of it ever after. */
#define LEFT 0.5

static const frot_contact_mode *modes_of(const frot_state *s, const frot_work *w) {
  return (const frot_contact_mode *)(const void *)(s->data + w->layout.modes);
}

void frot_measure_end(const frot_model *m, frot_state *s, frot_work *w, double t, const double *z) {
  const double *d = s->data + w->layout.d;
  const frot_contact_mode *modes = modes_of(s, w);
  const frot_awake_lists *now = w->awake.now;
  for (int i = 0; i < now->n_elements; i++) {
    int e = now->elements[i];
    for (int k = 0; k < FROT_BOUNDING && m->elements[e].bound == FROT_BY_PIN; k++)
      if (m->elements[e].bounded_by[k] >= 0)
        w->guards.end_reaction[FROT_BOUNDING * e + k] = w->core.lam[m->elements[e].bounded_by[k]];
    w->guards.end_friction[e] = w->core.lam[m->elements[e].row];
  }
  w->guards.end_kinetic = frot_kinetic(m, w, z + m->nq);
  if (frot_guards_read_loads(m, w, modes)) {
    for (int i = 0; i < now->n_groups; i++) frot_rows(m, w, &m->groups[now->groups[i]]);
    frot_row_loads(m, s, w, t, z, z + m->nq, d);
  }
  frot_guards(m, s, w, z, z + m->nq, d, modes, w->step.z, w->guards.size);
}

void frot_keep_friction(frot_state *s, const frot_work *w) {
  const frot_awake_lists *now = w->awake.now;
  for (int i = 0; i < now->n_elements; i++) {
    int e = now->elements[i];
    s->data[w->layout.friction + e] = w->guards.end_friction[e];
  }
}

void frot_update_sizes(const frot_model *m, frot_state *s, const frot_work *w, const double *z,
                       const double *guards) {
  const frot_layout *l = &w->layout;
  const frot_awake_lists *now = w->awake.now;
  for (int k = 0; k < now->n - FROT_QUADRATURES; k++) {
    int j = now->states[k];
    s->data[l->scale_x + j] = fmax(s->data[l->scale_x + j], fabs(z[j]));
  }
  for (int k = 0; k < w->guards.count; k++) {
    int j = w->guards.list[k];
    double *scale = s->data + l->scale_g + j, was = *scale;
    int fades = frot_guard_is_force(m, s, w, k) && fabs(guards[k]) > FROT_LOCATED * was;
    double kept = fades ? LEFT : 1;
    *scale = fmax(kept * was, w->guards.size[k]);
    s->data[l->most_g + j] = fmax(s->data[l->most_g + j], *scale);
    if (*scale < was) s->data[l->noise + m->nq + m->nv + j] *= *scale / was;
  }
  s->energy_scale = fmax(s->energy_scale, w->guards.end_kinetic);
}

int frot_start_slope(const frot_model *m, frot_state *s, frot_work *w, double t) {
  const frot_layout *l = &w->layout;
  if (w->awake.filled) {
    memcpy(w->step.z0, s->data + l->x, sizeof(double) * (size_t)l->nx);
    memcpy(w->step.z1, w->step.z0, sizeof(double) * (size_t)l->nx);
  } else {
    frot_copy_awake(w, s->data + l->x, w->step.z0);
  }
  frot_list_guards(m, s, w, modes_of(s, w));
  if (s->has_slope) {
    frot_pack_awake(w, s->data + l->slope, frot_stage(w, 0));
    memcpy(frot_stage(w, 0) + w->awake.n, s->data + l->slope + l->nx,
           sizeof(double) * (size_t)w->guards.count);
    /* as large as they have been: scratch says nothing of the step before */
    for (int k = 0; k < w->guards.count; k++)
      w->guards.size[k] = s->data[l->scale_g + w->guards.list[k]];
    return FROT_OK;
  }
  memcpy(w->blocks.y, s->data + l->y, sizeof(double) * (size_t)m->ny);
  memset(w->reactions.carried, 0, (size_t)m->n_rows);
  int status = frot_slope(m, s, w, t, w->step.z0, frot_stage(w, 0));
  if (status == FROT_OK) {
    if (!s->from_posture && frot_find_redundant_rows(m, s, w)) {
      frot_use_redundant_rows(m, w, s->data + l->spare);
      status = frot_slope(m, s, w, t, w->step.z0, frot_stage(w, 0));
      frot_forget_redundant_rows(w);
      if (status != FROT_OK) return status;
    }
    for (int i = 0; i < w->awake.now->n_groups; i++) {
      int k = w->awake.now->groups[i];
      s->data[l->sign + k] = w->reactions.sign[k];
    }
    memcpy(s->data + l->y, w->blocks.y, sizeof(double) * (size_t)m->ny);
    frot_turn_references(m, s, w);
    frot_measure_end(m, s, w, t, w->step.z0);
    frot_keep_friction(s, w);
    frot_update_sizes(m, s, w, w->step.z0, w->step.z);
    memcpy(frot_stage(w, 0) + w->awake.n, w->step.z, sizeof(double) * (size_t)w->guards.count);
  }
  if (status != FROT_OK || !s->from_posture) return status;
  const double *q = w->step.z0, *d = s->data + l->d;
  status =
      frot_accelerations_on_branch(m, s, w, t, q, q + m->nq, d, modes_of(s, w), s->data + l->spare);
  for (int k = 0; k < w->awake.n - FROT_QUADRATURES; k++) {
    int speed = w->awake.now->states[k] - m->nq;
    if (speed >= 0) frot_stage(w, 0)[k] = w->core.a[speed];
  }
  return status;
}

void frot_turn_references_at_end(const frot_model *m, frot_state *s, frot_work *w, double *slope) {
  const frot_layout *l = &w->layout;
  const frot_contact_mode *modes = modes_of(s, w);
  const frot_awake_lists *now = w->awake.now;
  for (int i = 0; i < now->n_elements; i++) {
    int e = now->elements[i];
    for (int k = 0; k < FROT_BOUNDING && m->elements[e].bound == FROT_BY_PIN; k++)
      if (m->elements[e].bounded_by[k] >= 0)
        w->core.lam[m->elements[e].bounded_by[k]] = w->guards.end_reaction[FROT_BOUNDING * e + k];
  }
  frot_turn_references(m, s, w);
  for (int k = 0; k < w->guards.count && w->guards.list[k] < frot_condition_guard(m); k++) {
    int j = w->guards.list[k], e = frot_guarded_element(m, j);
    if (j < m->n_contacts || j == frot_element_guard(m, e)) continue;
    if (frot_element_mode(m, modes, e)->friction == FROT_STICK) continue;
    slope[l->nx + k] =
        frot_bounding_along(&m->elements[e], w->core.lam, s->data + l->along + FROT_BOUNDING * e,
                            j - frot_element_guard(m, e) - 1);
  }
}
