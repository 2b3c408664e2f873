/* Layout of the state and of the scratch block; parameters and inputs. */
#include "state.h"

#include <math.h>
#include <string.h>

#include "implicit.h"
#include "tolerances.h"

/* A mode fills a double exactly, so that it can lie in an array of doubles. */
typedef char frot_mode_fills_double[sizeof(frot_contact_mode) == sizeof(double) ? 1 : -1];

frot_layout frot_layout_of(const frot_model *m) {
  frot_layout l;
  l.nw = m->nv + m->na + m->nc;
  l.nx = m->nq + m->nv + FROT_QUADRATURES;
  l.ng = m->n_contacts + 2 * m->n_elements + m->n_located;
  l.nf = m->n_contacts + 2 * m->n_elements + m->n_conditions;
  l.nz = l.nx + l.ng;
  l.nd = m->n_conditions + m->n_contacts + m->n_discrete;
  l.ns = 3 + m->n_contacts + 3 * m->n_elements + l.nd + m->nv + 2 * m->ny + l.nx + DP_DENSE * l.nx;
  l.early = 0;
  for (int i = 0; i < m->n_blocks; i++)
    if (!m->blocks[i].late) l.early += m->blocks[i].count;
  int at = 0;
  l.set = at, at += m->np;
  l.given = at, at += m->np;
  l.p = at, at += m->np;
  l.kept = at, at += 2 * m->np + m->nu;
  l.u = at, at += m->nu;
  l.experiment = at, at += 5;
  l.nominal = at, at += m->nq;
  l.unilateral = at, at += m->n_contacts;
  l.x = at, at += l.nx;
  l.y = at, at += m->ny;
  l.slope = at, at += l.nz;
  l.scale_x = at, at += l.nx;
  l.scale_g = at, at += l.ng;
  l.worth = at, at += m->nq;
  l.noise = at, at += m->nq + m->nv;
  l.along = at, at += 2 * m->n_elements;
  l.fired = at, at += l.nf;
  l.several = at, at += m->n_contacts;
  l.due = at, at += m->n_timed;
  l.left = at, at += m->n_elements;
  l.asked = at, at += m->n_outcomes;
  l.fresh = at, at += m->n_conditions;
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

long long frot_segment_size(const frot_model *model) { return frot_layout_of(model).ns; }

frot_segment frot_segment_at(const frot_model *m, double *data) {
  frot_layout l = frot_layout_of(m);
  frot_segment s;
  s.t0 = data, s.t1 = data + 1, s.h = data + 2;
  data += 3;
  s.modes = (frot_contact_mode *)(void *)data, data += m->n_contacts + m->n_elements;
  s.d = data, data += l.nd;
  s.frozen = data, data += m->nv;
  s.along = data, data += 2 * m->n_elements;
  s.y0 = data, data += m->ny;
  s.y1 = data, data += m->ny;
  s.x0 = data, data += l.nx;
  s.f = data;
  return s;
}

/* Hands out pieces of the scratch block; with a NULL base it only counts. */
typedef struct {
  char *base;
  size_t used;
} arena;

static void *take(arena *a, size_t count, size_t size) {
  size_t at = (a->used + 15) & ~(size_t)15;
  a->used = at + (count + 1) * size;
  return a->base ? a->base + at : NULL;
}

#define TAKE(field, count) (w->field = take(&a, (size_t)(count), sizeof *w->field))

/* The scratch that any of the generated functions needs. */
static frot_callable scratch_of_all(const frot_model *m) {
  const frot_callable *calls[] = {&m->parameters,
                                  &m->start,
                                  &m->initial_position,
                                  &m->initial_velocity,
                                  &m->kinematics,
                                  &m->sides,
                                  &m->places,
                                  &m->pace,
                                  &m->dynamics,
                                  &m->spread,
                                  &m->rates,
                                  &m->jacobian,
                                  &m->invariants,
                                  &m->block_slopes,
                                  &m->update,
                                  &m->sizes,
                                  &m->variables,
                                  &m->energy,
                                  &m->timers,
                                  &m->watched};
  int count = (int)(sizeof calls / sizeof *calls);
  frot_callable most = {NULL, 11, 11, 0, 0};
  for (int i = 0; i < count + m->n_blocks; i++) {
    const frot_callable *call = i < count ? calls[i] : &m->blocks[i - count].residual;
    if (call->n_arg > most.n_arg) most.n_arg = call->n_arg;
    if (call->n_res > most.n_res) most.n_res = call->n_res;
    if (call->n_iw > most.n_iw) most.n_iw = call->n_iw;
    if (call->n_w > most.n_w) most.n_w = call->n_w;
  }
  return most;
}

static size_t bind(const frot_model *m, frot_work *w, char *base) {
  frot_layout l = frot_layout_of(m);
  frot_callable most = scratch_of_all(m);
  int nr = m->n_rows, nc = m->n_contacts, ni = m->n_invariants, nb = 0;
  int ne = (m->n_position > m->n_velocity ? m->n_position : m->n_velocity) + nr + nc + ni;
  int wide = ni > 0 ? m->nq + m->nv : m->nq;
  if (l.nw > wide) wide = l.nw;
  int big = ne > l.nw ? ne : l.nw;
  for (int i = 0; i < m->n_blocks; i++)
    if (m->blocks[i].count > nb) nb = m->blocks[i].count;
  arena a = {base, sizeof(frot_work)};
  w->layout = l;
  TAKE(arg, most.n_arg), TAKE(res, most.n_res), TAKE(iw, most.n_iw), TAKE(w, most.n_w);
  TAKE(pivot, big > wide ? big : wide);
  TAKE(y, m->ny), TAKE(y_end, m->ny);
  TAKE(block_r, nb), TAKE(block_j, nb * nb), TAKE(block_lu, nb * nb), TAKE(block_size, 2 * nb);
  TAKE(block_step, 2 * nb), TAKE(block_scale, nb * nb + 5 * nb), TAKE(block_pivot, nb);
  int n_el = m->n_elements, widest = 0;
  for (int k = 0; k < m->n_groups; k++)
    if (m->groups[k].n > widest) widest = m->groups[k].n;
  TAKE(qd, m->nq), TAKE(mass, m->n_matrix), TAKE(h, l.nw), TAKE(rows, m->n_entries), TAKE(c, nr);
  TAKE(rate, nr), TAKE(gap, nc), TAKE(condition, m->n_conditions), TAKE(coefficient, 2 * n_el);
  TAKE(power, 1), TAKE(witness, 3 * nc), TAKE(reach, nc);
  TAKE(pace, 4 * m->n_paced);
  TAKE(stood, nc + nr + 2 * (FROT_PLACE * m->n_carried + ni));
  TAKE(effect, m->general ? m->n_entries : 0), TAKE(metric, m->general ? m->n_metric : 0);
  TAKE(factor, m->n_metric), TAKE(force, l.nw), TAKE(half, m->n_entries);
  TAKE(lu, m->general ? m->n_matrix : 0), TAKE(lu_scale, m->general ? 2 * l.nw : 0);
  TAKE(lu_pivot, m->general ? l.nw : 0);
  TAKE(wanted, nr), TAKE(free, nr), TAKE(delassus, m->n_square);
  TAKE(load, big > l.nw ? big : l.nw), TAKE(load_size, l.nw), TAKE(row_load, nr), TAKE(lam, nr);
  TAKE(a, l.nw), TAKE(unknown, nr), TAKE(owner, nr), TAKE(fold, 2 * nr), TAKE(friction, nr);
  TAKE(fold_ratio, 2 * nr), TAKE(ratio, n_el), TAKE(along, 2 * n_el), TAKE(unit_of, nr);
  TAKE(weight, nr), TAKE(solution, nr);
  TAKE(basis, (nr + 1) * widest), TAKE(parts, nr + widest), TAKE(bias, nr);
  TAKE(active, big * (big > wide ? big : wide)), TAKE(right, big);
  int least = big < wide ? big : wide;
  TAKE(lstsq, 2 * big * big + 6 * big + 4 * wide + least * wide);
  TAKE(rest, l.nw), TAKE(column, l.nw), TAKE(row_of, nr + nc + n_el), TAKE(guards, l.ng);
  TAKE(guard, l.ng), TAKE(end_reaction, 2 * n_el), TAKE(k, DP_ALL * l.nz);
  TAKE(change, m->nq), TAKE(own_size, m->nq), TAKE(largest_alike, m->nq);
  TAKE(implicit, frot_implicit_doubles(m)), TAKE(implicit_pivot, frot_implicit_integers(m));
  TAKE(z0, l.nz), TAKE(z1, l.nz), TAKE(ztry, l.nz), TAKE(f, DP_DENSE * l.nz);
  int nvar = m->np > l.nw ? m->np : l.nw;
  TAKE(values, nvar + m->n_checks + m->nq + m->nv + m->n_loads + m->n_watched + 4);
  TAKE(jacobian, wide * ne), TAKE(residual, ne + l.nw), TAKE(size, ne);
  TAKE(step, wide + l.nw + ne);
  int asked = m->n_position + m->n_velocity > 0 ? l.early : 0;
  TAKE(residual_y, m->ny * ne), TAKE(slopes, (m->nq + m->nv) * asked);
  TAKE(slopes_y, asked * asked + 3 * asked), TAKE(slopes_pivot, asked), TAKE(unit, wide);
  TAKE(position_factor, m->nv * m->nv);
  TAKE(row_weight, ne), TAKE(off_at_first, ne), TAKE(begin, wide), TAKE(nearest, wide);
  TAKE(rose, m->n_conditions), TAKE(firing, m->n_whens), TAKE(outcome, m->n_outcomes);
  TAKE(condition_before, m->n_conditions), TAKE(condition_known, m->n_conditions);
  TAKE(timer, 2 * m->n_timed), TAKE(discrete, m->n_discrete);
  TAKE(discrete_before, m->n_discrete), TAKE(held, m->n_held);
  TAKE(trial, nc + n_el), TAKE(best, nc + n_el), TAKE(before, nc + n_el);
  TAKE(guess, nc + n_el), TAKE(certain, nc), TAKE(pivot_bound, 4 * nr);
  TAKE(motions, FROT_MOTIONS * nr), TAKE(choice, 4 * nc + 4 * n_el), TAKE(component, nc);
  TAKE(chosen, nc), TAKE(zero, n_el), TAKE(at_rest, n_el), TAKE(ahead, n_el), TAKE(departs, n_el),
      TAKE(carried, nr);
  TAKE(guess_ahead, nc + n_el), TAKE(nothing_frozen, m->nv);
  for (int k = 0; base && k < m->nv; k++) w->nothing_frozen[k] = 0;
  return a.used;
}

void frot_bind_work(const frot_model *model, frot_work *work) { bind(model, work, (char *)work); }

size_t frot_work_size(const frot_model *model) {
  frot_work counted;
  return bind(model, &counted, NULL);
}

int frot_has_normal(const frot_contact *contact) { return contact->row_n >= 0; }

void frot_open(const frot_model *m, frot_contact_mode *modes, int contact) {
  modes[contact] = (frot_contact_mode){0, 1, 0, 0, 0, {0}};
  for (int e = 0; e < m->n_elements; e++)
    if (m->elements[e].contact == contact) modes[m->n_contacts + e] = (frot_contact_mode){0};
}

int frot_mode_value(const frot_model *m, const frot_contact_mode *modes, int contact) {
  int sliding = m->contacts[contact].sliding;
  if (!modes[contact].closed) return FROT_MODE_OPEN;
  if (sliding < 0) return FROT_MODE_SLIP;
  return modes[m->n_contacts + sliding].friction == FROT_STICK ? FROT_MODE_STICK : FROT_MODE_SLIP;
}

int frot_fail(frot_state *s, int status, double t, int contact, int item, int other, double value) {
  s->fault = (frot_fault){status, contact, item, other, t, value};
  s->phase = FROT_FAULTED;
  return status;
}

void frot_state_clear(const frot_model *m, frot_state *s) {
  frot_layout l = frot_layout_of(m);
  memset(s, 0, frot_state_size(m));
  s->magic = FROT_MAGIC;
  s->version = FROT_LAYOUT_VERSION;
  s->size = frot_state_size(m);
  strncpy(s->key, m->key, FROT_KEY - 1);
  s->fault = (frot_fault){FROT_OK, -1, -1, -1, 0, 0};
  for (int i = 0; i < m->np; i++) s->data[l.given + i] = s->data[l.p + i] = m->p_default[i];
  for (int i = 0; i < m->nu; i++) s->data[l.u + i] = m->u_default[i];
  for (int i = 0; i < m->n_outcomes; i++) s->data[l.asked + i] = NAN;
  frot_contact_mode *modes = (void *)(s->data + l.modes);
  frot_segment g = frot_segment_at(m, s->data + l.segment);
  for (int i = 0; i < m->n_contacts; i++)
    modes[i].closed = g.modes[i].closed = (signed char)!frot_has_normal(&m->contacts[i]);
}

/* Whether modes are such as the model's contacts and elements can have. */
static int modes_valid(const frot_model *m, const frot_contact_mode *modes) {
  for (int i = 0; i < m->n_contacts + m->n_elements; i++) {
    const frot_contact_mode *mode = modes + i;
    if (mode->side < -1 || mode->side > 1 || mode->friction < 0 || mode->friction > 3) return 0;
    if (mode->unloaded < 0 || mode->unloaded > 1 || mode->at_bound < -1 || mode->at_bound > 1)
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
  if (s->implicit < 0 || s->implicit > m->has_jacobian) return 0;
  if (s->fault.contact < -1 || s->fault.contact >= m->n_contacts) return 0;
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
