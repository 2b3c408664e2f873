/* Layout of the state; parameters and inputs. */
#include "model/state.h"

#include "model/fault_indices.h"
#include "model/indexing.h"

#include <math.h>
#include <string.h>

/* A mode fills a double exactly, so that it can lie in an array of doubles. */
typedef char frot_mode_fills_double[sizeof(frot_contact_mode) == sizeof(double) ? 1 : -1];

/* Sizes of states kept with a segment: they are what its values are projected by. */
static int sizes_kept(const frot_model *m) { return m->n_invariants > 0 ? m->nq + m->nv : 0; }

frot_layout frot_layout_of(const frot_model *m) {
  frot_layout l;
  l.nw = m->nv + m->na + m->nc;
  l.nx = m->nq + m->nv + FROT_QUADRATURES;
  l.ng = frot_condition_guard(m) + m->n_located;
  l.nf = frot_condition_guard(m) + m->n_conditions;
  l.nz = l.nx + l.ng;
  l.nd = m->n_conditions + m->n_contacts + m->n_discrete;
  l.ns = 3 + sizes_kept(m) + m->n_contacts + (3 + FROT_BOUNDING) * m->n_elements + l.nd + m->nv +
         m->n_rows + 2 * m->ny + l.nx + DP_DENSE * l.nx;
  l.early = 0;
  for (int i = 0; i < m->n_blocks; i++)
    if (!m->blocks[i].late) l.early += m->blocks[i].count;
  int at = 0;
  l.set = at, at += m->np;
  l.given = at, at += m->np;
  l.p = at, at += m->np;
  l.kept = at, at += 2 * m->np + m->nu;
  l.u = at, at += m->nu;
  l.ramp = at, at += m->nu;
  l.experiment = at, at += 5;
  l.nominal = at, at += m->nq;
  l.unilateral = at, at += m->n_contacts;
  l.restitution = at, at += m->n_contacts;
  l.carried = at, at += m->n_groups;
  l.x = at, at += l.nx;
  l.y = at, at += m->ny;
  l.slope = at, at += l.nz;
  l.scale_x = at, at += l.nx;
  l.scale_g = at, at += l.ng;
  l.most_g = at, at += l.ng;
  l.worth = at, at += m->nq;
  l.lost = at, at += m->nq;
  l.noise = at, at += m->nq + m->nv + l.ng;
  l.along = at, at += FROT_BOUNDING * m->n_elements;
  l.friction = at, at += m->n_elements;
  l.slip = at, at += m->n_elements;
  l.heading = at, at += m->n_elements;
  l.reach = at, at += m->n_contacts;
  l.flights = at, at += FROT_FLIGHT * m->n_contacts;
  l.asleep = at, at += m->n_islands;
  l.fired = at, at += l.nf;
  l.several = at, at += m->n_contacts;
  l.due = at, at += m->n_timed;
  l.blows = at, at += 4 * m->n_percussions;
  l.left = at, at += m->n_elements;
  l.vanished = at, at += m->n_contacts;
  l.spare = at, at += m->n_rows;
  l.posture = at, at += m->n_rows;
  l.sign = at, at += m->n_groups;
  l.requested = at, at += m->n_outcomes;
  l.fresh = at, at += m->n_conditions;
  l.near = at, at += m->n_located;
  l.modes = at, at += m->n_contacts + m->n_elements;
  l.d = at, at += l.nd;
  l.frozen = at, at += m->nv;
  l.segment = at, at += l.ns;
  l.size = at;
  return l;
}

size_t frot_state_size(const frot_model *model) {
  return sizeof(frot_state) + sizeof(double) * (size_t)frot_layout_of(model).size;
}

long long frot_segment_size(const frot_model *model) {
  frot_layout l = frot_layout_of(model);
  return FROT_RECORD_HEAD + model->n_islands + l.ns + (DP_INSIDE + 1 - DP_DENSE) * l.nx;
}

frot_segment frot_segment_at(const frot_model *m, double *data) {
  frot_segment s;
  s.t0 = data, s.t1 = data + 1, s.h = data + 2;
  data += 3;
  s.modes = (frot_contact_mode *)(void *)data, data += m->n_contacts + m->n_elements;
  s.d = data, data += m->n_conditions + m->n_contacts + m->n_discrete;
  s.frozen = data, data += m->nv;
  s.spare = data, data += m->n_rows;
  s.along = data, data += FROT_BOUNDING * m->n_elements;
  s.heading = data, data += m->n_elements;
  s.friction = data, data += m->n_elements;
  s.y0 = data, data += m->ny;
  s.y1 = data, data += m->ny;
  s.sizes = data, data += sizes_kept(m);
  s.x0 = data, data += m->nq + m->nv + FROT_QUADRATURES;
  s.f = data;
  return s;
}

int frot_has_normal(const frot_contact *contact) { return contact->row_n >= 0; }

void frot_open(const frot_model *m, frot_contact_mode *modes, int contact) {
  modes[contact] = (frot_contact_mode){0, 1, 0, 0, 0, 0, 0, {0}};
  for (int e = 0; e < m->n_elements; e++)
    if (m->elements[e].contact == contact) modes[m->n_contacts + e] = (frot_contact_mode){0};
}

int frot_mode_value(const frot_model *m, const frot_contact_mode *modes, int contact) {
  int sliding = m->contacts[contact].sliding;
  if (!modes[contact].closed) return FROT_MODE_OPEN;
  if (sliding == FROT_NEVER_SLIPS) return FROT_MODE_STICK;
  if (sliding < 0) return FROT_MODE_SLIP;
  for (int e = sliding; e < m->n_elements && m->elements[e].contact == contact; e++) {
    if (m->elements[e].rolling || m->elements[e].part > 0) continue;
    if (modes[m->n_contacts + e].friction != FROT_STICK) return FROT_MODE_SLIP;
  }
  return FROT_MODE_STICK;
}

int frot_sense_of_slip(const frot_model *m, const frot_contact_mode *modes, int contact) {
  int sliding = m->contacts[contact].sliding;
  if (!modes[contact].closed || sliding < 0) return FROT_SENSE_FREE;
  switch (modes[m->n_contacts + sliding].friction) {
    case FROT_STICK:
      return 0;
    case FROT_SLIP_FORWARD:
      return 1;
    case FROT_SLIP_BACKWARD:
      return -1;
    default:
      return FROT_SENSE_FREE;
  }
}

double frot_mode_read(const frot_model *m, const frot_contact_mode *modes, int k) {
  int contact = m->mode_contact[k];
  switch (m->mode_reads[k]) {
    case FROT_READS_SENSE:
      return frot_sense_of_slip(m, modes, contact);
    case FROT_READS_CLOSED:
      return modes[contact].closed;
    default:
      return frot_mode_value(m, modes, contact);
  }
}

int frot_fail(frot_state *s, int status, double t, int contact, int item, int other, double value) {
  s->fault = (frot_fault){status, contact, item, other, t, value, {0, 0, 0}};
  s->phase = FROT_FAULTED;
  return status;
}

frot_fault frot_no_fault(double t) { return (frot_fault){FROT_OK, -1, -1, -1, t, 0, {0, 0, 0}}; }

void frot_clear_run(const frot_model *m, frot_state *s) {
  frot_layout l = frot_layout_of(m);
  memset(s, 0, sizeof *s);
  memset(s->data + l.x, 0, sizeof(double) * (size_t)(l.size - l.x));
  s->magic = FROT_MAGIC;
  s->version = FROT_LAYOUT_VERSION;
  s->size = frot_state_size(m);
  strncpy(s->key, m->key, FROT_KEY - 1);
  s->fault = frot_no_fault(0);
  for (int i = 0; i < m->n_outcomes; i++) s->data[l.requested + i] = NAN;
  frot_contact_mode *modes = (void *)(s->data + l.modes);
  frot_segment g = frot_segment_at(m, s->data + l.segment);
  for (int i = 0; i < m->n_contacts; i++)
    modes[i].closed = g.modes[i].closed = (signed char)!frot_has_normal(&m->contacts[i]);
}

void frot_state_clear(const frot_model *m, frot_state *s) {
  frot_layout l = frot_layout_of(m);
  memset(s->data, 0, sizeof(double) * (size_t)l.x);
  frot_clear_run(m, s);
  for (int i = 0; i < m->np; i++) s->data[l.given + i] = s->data[l.p + i] = m->p_default[i];
  for (int i = 0; i < m->nu; i++) s->data[l.u + i] = m->u_default[i];
}

/* Whether modes are such as the model's contacts and elements can have. */
static int modes_valid(const frot_model *m, const frot_contact_mode *modes) {
  for (int i = 0; i < m->n_contacts + m->n_elements; i++) {
    const frot_contact_mode *mode = modes + i;
    if (mode->side < -1 || mode->side > 1 || mode->friction < 0 || mode->friction > 3) return 0;
    if (mode->unloaded < 0 || mode->unloaded > FROT_BY_SPRINGS || mode->at_bound < -1 ||
        mode->at_bound > 1)
      return 0;
    if (mode->closed < 0 || mode->closed > 1) return 0;
    if (i < m->n_contacts && !mode->closed && !frot_has_normal(&m->contacts[i])) return 0;
  }
  return 1;
}

int frot_state_valid(const frot_model *m, const void *block, size_t size) {
  const frot_state *s = block;
  frot_layout l = frot_layout_of(m);
  if (size != frot_state_size(m) || s->magic != FROT_MAGIC || s->version != FROT_LAYOUT_VERSION ||
      s->size != size || strncmp(s->key, m->key, FROT_KEY - 1) != 0)
    return 0;
  if (s->phase < FROT_CLEARED || s->phase > FROT_ENDED) return 0;
  if (!isfinite(s->t) || !isfinite(s->h) || !isfinite(s->h_max) || !isfinite(s->tolerance))
    return 0;
  if (s->ramps < 0 || s->ramps > 1 || !isfinite(s->ramps_from)) return 0;
  if (s->asleep < 0 || s->asleep > m->n_islands) return 0;
  if (s->implicit < 0 || s->implicit > m->has_jacobian) return 0;
  if (!frot_fault_is_valid(m, &s->fault)) return 0;
  if (s->second < -1 || s->second >= m->n_contacts) return 0;
  if (s->fleeting < -1 || s->fleeting >= m->n_contacts) return 0;
  if (s->jammed < -1 || (s->jammed > 0 && s->jammed >= m->n_groups)) return 0;
  if (s->phase == FROT_ENDED && (s->outcome < 0 || s->outcome >= m->n_outcomes)) return 0;
  const frot_contact_mode *modes = (const void *)(s->data + l.modes);
  frot_segment g = frot_segment_at(m, (double *)(s->data + l.segment));
  return modes_valid(m, modes) && modes_valid(m, g.modes);
}

void frot_set_parameter(const frot_model *m, frot_state *s, int index, double value) {
  frot_layout l = frot_layout_of(m);
  if (index < 0 || index >= m->np) return;
  if (s->data[l.set + index] != 0 && s->data[l.given + index] == value) return;
  if (!m->p_dependent[index] && s->data[l.given + index] == value) return;
  s->data[l.set + index] = 1;
  s->data[l.given + index] = value;
  s->changed = 1;
}

void frot_set_input(const frot_model *m, frot_state *s, int index, double value) {
  frot_layout l = frot_layout_of(m);
  if (index < 0 || index >= m->nu || s->data[l.u + index] == value) return;
  s->data[l.u + index] = value;
  s->changed = 1;
}

void frot_set_input_rate(const frot_model *m, frot_state *s, int index, double rate) {
  frot_layout l = frot_layout_of(m);
  if (index < 0 || index >= m->nu || (!s->ramps && rate == 0)) return;
  double *rates = s->data + l.ramp;
  if (!s->ramps) memset(rates, 0, sizeof(double) * (size_t)m->nu);
  rates[index] = rate;
  s->ramps = s->changed = 1;
  s->ramps_from = s->t;
}

void frot_hold_inputs(const frot_model *m, frot_state *s) {
  if (!s->ramps) return;
  frot_layout l = frot_layout_of(m);
  double *u = s->data + l.u, *kept = s->data + l.kept + 2 * m->np;
  for (int i = 0; i < m->nu; i++)
    u[i] = kept[i] = u[i] + s->data[l.ramp + i] * (s->t - s->ramps_from);
  s->ramps = 0, s->changed = 1;
  s->ramps_from = s->t;
}

double frot_get_input_rate(const frot_model *m, const frot_state *s, int index) {
  if (index < 0 || index >= m->nu || (!s->ramps && s->ramps_from != s->t)) return 0;
  return s->data[frot_layout_of(m).ramp + index];
}

double frot_get_parameter(const frot_model *m, const frot_state *s, int index) {
  frot_layout l = frot_layout_of(m);
  if (index < 0 || index >= m->np) return NAN;
  return s->data[(m->p_dependent[index] && s->data[l.set + index] == 0 ? l.p : l.given) + index];
}

double frot_get_input(const frot_model *m, const frot_state *s, int index) {
  return index < 0 || index >= m->nu ? NAN : s->data[frot_layout_of(m).u + index];
}

double frot_time(const frot_state *s) { return s->t; }

double frot_next_instant(const frot_state *s) {
  return s->phase == FROT_RUNNING ? s->due : INFINITY;
}

const frot_fault *frot_last_fault(const frot_state *s) { return &s->fault; }
const frot_statistics *frot_run_statistics(const frot_state *s) { return &s->statistics; }
