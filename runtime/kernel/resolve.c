#include "resolve.h"

#include <math.h>
#include <string.h>

#include "blocks.h"
#include "mechanics.h"
#include "projection.h"
#include "record.h"

#define ENOUGH 200000 /* combinations of modes examined one by one */
#define CONTACT_OPTIONS 24
#define ROUNDING 1e-14
#define SAME_INSTANT 1e-13
#define TOUCH 1e-9 /* part of the usual speed below which an approach is no impact */

typedef struct {
  const frot_model *m;
  frot_state *s;
  frot_work *w;
  frot_layout l;
  const double *fired, *unilateral;
  const double *left;  /* 2 per contact: direction in which rest of friction, of rolling was left */
  unsigned char *zero; /* per contact: bit 0 no slip, bit 1 no rolling */
  unsigned char *at_rest; /* per contact: no slip, so that mu_s bounds it */
} instant;

/* Whether a slip or rolling rate is zero: its guard (of index `guard`) fired at zero, or it is zero
 * to rounding against its terms, the sizes it had and the motion as a whole. */
static int is_zero_rate(const instant *in, int row, const double *v, int guard, int moved) {
  if (moved && in->fired[guard] != 0) return 1;
  if (frot_is_prescribed(in->m, in->w, row) && fabs(in->w->rate[row]) <= FROT_PRESCRIBED_REST)
    return 1;
  double size = fmax(frot_row_size(in->m, in->w, row, v), in->s->data[in->l.scale_g + guard]);
  return fabs(in->w->rate[row]) <=
         FROT_ZERO * size + ROUNDING * frot_row_speed(in->m, in->w, row, v);
}

/* Whether a law's coefficient can ever bound anything: a constant zero is skipped. */
static int bounds_something(const frot_work *w, const frot_contact *contact, int i, int rolling) {
  const double *k = w->coefficient + 3 * i;
  if (rolling) return contact->row_r >= 0 && !(contact->fixed_delta && k[2] == 0);
  return contact->row_t >= 0 && !(contact->fixed_mu && k[0] == 0 && k[1] == 0);
}

/* The modes one bounded motion may take: into `list`, returns how many. `exit`: -1 or +1 when the
 * bound of rest was reached towards slip in that direction. */
static int friction_options(int active, double rate, int zero, int left, signed char *list) {
  if (!active) return list[0] = FROT_NONE, 1;
  if (!zero) return list[0] = rate > 0 ? FROT_SLIP_FORWARD : FROT_SLIP_BACKWARD, 1;
  if (left > 0) return list[0] = FROT_SLIP_FORWARD, 1;
  if (left < 0) return list[0] = FROT_SLIP_BACKWARD, 1;
  list[0] = FROT_STICK, list[1] = FROT_SLIP_FORWARD, list[2] = FROT_SLIP_BACKWARD;
  return 3;
}

/* A reaction that reached its upper bound (first guard) lets the body go backward. */
static int left_by(const double *fired) { return fired[0] != 0 ? -1 : (fired[1] != 0 ? 1 : 0); }

/* The direction in which rest ends now; a prescribed motion says itself. */
static int direction_left(const instant *in, int i, int rolling) {
  const frot_contact *contact = &in->m->contacts[i];
  int left = (int)in->left[2 * i + rolling], row = rolling ? contact->row_r : contact->row_t;
  if (left != 0 && frot_is_prescribed(in->m, in->w, row)) return in->w->c[row] > 0 ? 1 : -1;
  return left;
}

static int contact_options(const instant *in, int i, int forced, frot_contact_mode *list) {
  const frot_contact *contact = &in->m->contacts[i];
  const double *fired = in->fired + FROT_GUARDS * i;
  frot_contact_mode before = in->w->before[i];
  int n = 0, can_open = in->unilateral[i] != 0 && frot_has_normal(contact);
  int one_sided = can_open || !frot_has_normal(contact);
  int leaves = forced && before.closed && can_open && fired[0] != 0;
  int turns = forced && before.closed && !one_sided && fired[0] != 0;
  if (!leaves) {
    signed char friction[3], rolling[3];
    int act_t = bounds_something(in->w, contact, i, 0),
        act_r = bounds_something(in->w, contact, i, 1);
    int zero_t = in->zero[i] & 1, zero_r = in->zero[i] & 2;
    int n_t = friction_options(act_t, act_t ? in->w->rate[contact->row_t] : 0, zero_t,
                               forced ? direction_left(in, i, 0) : 0, friction);
    int n_r = friction_options(act_r, act_r ? in->w->rate[contact->row_r] : 0, zero_r,
                               forced ? direction_left(in, i, 1) : 0, rolling);
    for (int a = 0; a < n_t; a++)
      for (int b = 0; b < n_r; b++)
        for (int side = 1; side >= -1; side -= 2) {
          if (side < 0 && (one_sided || (!act_t && !act_r))) continue;
          if (turns && side == before.side) continue;
          /* held all round, the side follows from the reaction: is_admissible sets it */
          if (side < 0 && !turns && friction[a] <= FROT_STICK && rolling[b] <= FROT_STICK) continue;
          list[n++] = (frot_contact_mode){1, (signed char)side, friction[a], rolling[b], {0}};
        }
  }
  if (can_open) list[n++] = (frot_contact_mode){0, 1, FROT_NONE, FROT_NONE, {0}};
  return n;
}

/* Size of the terms of a row's acceleration, for the comparison with zero. */
static double acceleration_size(const instant *in, int row) {
  int nr = in->m->n_rows;
  double sum = in->w->row_load[row];
  for (int k = 0; k < nr; k++)
    if (in->w->lam[k] != 0) sum += fabs(in->w->delassus[row * nr + k] * in->w->lam[k]);
  return sum;
}

static double acceleration(const instant *in, int row) {
  int nr = in->m->n_rows;
  double sum = in->w->free[row];
  for (int k = 0; k < nr; k++)
    if (in->w->lam[k] != 0) sum += in->w->delassus[row * nr + k] * in->w->lam[k];
  return sum;
}

static int motion_is_admissible(const instant *in, int mode, int row, int departs, double bound) {
  double lam = in->w->lam[row];
  if (mode == FROT_STICK && frot_is_prescribed(in->m, in->w, row))
    return fabs(in->w->c[row]) <= FROT_PRESCRIBED_REST;
  if (mode == FROT_STICK) return fabs(lam) <= bound + 1e-10 * (fabs(bound) + fabs(lam));
  if (mode == FROT_NONE || !departs) return 1;
  double a = acceleration(in, row) * (mode == FROT_SLIP_FORWARD ? 1 : -1);
  return a >= -1e-9 * acceleration_size(in, row);
}

/* Whether the normal reaction has the sign of its side, which is set where all is held. */
static int normal_is_admissible(const instant *in, int i, frot_contact_mode *mode) {
  int row = in->m->contacts[i].row_n;
  if (in->unilateral[i] == 0 && mode->friction <= FROT_STICK && mode->rolling <= FROT_STICK)
    mode->side = in->w->lam[row] < 0 ? -1 : 1;
  int matters = in->unilateral[i] != 0 || mode->friction != FROT_NONE || mode->rolling != FROT_NONE;
  double load = acceleration_size(in, row) / fabs(in->w->delassus[row * (in->m->n_rows + 1)]);
  return !(matters && mode->side * in->w->lam[row] < -1e-10 * load);
}

/* Whether the reactions of w->trial over the contacts `chosen` satisfy every inequality. */
static int is_admissible(const instant *in, const int *chosen, int count) {
  frot_work *w = in->w;
  if (frot_reactions(in->m, w, w->trial, in->at_rest)) return 0;
  for (int c = 0; c < count; c++) {
    int i = chosen[c];
    const frot_contact *contact = &in->m->contacts[i];
    frot_contact_mode *mode = &w->trial[i];
    if (!mode->closed) {
      double a = acceleration(in, contact->row_n);
      if (!(a >= -1e-9 * acceleration_size(in, contact->row_n))) return 0;
      continue;
    }
    if (frot_has_normal(contact) && !normal_is_admissible(in, i, mode)) return 0;
    double friction = fabs(frot_bound_of_rest(in->m, w, i, mode, 0));
    double rolling = fabs(frot_bound_of_rest(in->m, w, i, mode, 1));
    if (contact->row_t >= 0 &&
        !motion_is_admissible(in, mode->friction, contact->row_t, in->zero[i] & 1, friction))
      return 0;
    if (contact->row_r >= 0 &&
        !motion_is_admissible(in, mode->rolling, contact->row_r, in->zero[i] & 2, rolling))
      return 0;
  }
  return 1;
}

static int stuck_count(const frot_contact_mode *mode) {
  return (mode->friction == FROT_STICK) + (mode->rolling == FROT_STICK);
}

static int same_mode(const frot_contact_mode *a, const frot_contact_mode *b) {
  if (!a->closed || !b->closed) return a->closed == b->closed;
  return a->side == b->side && a->friction == b->friction && a->rolling == b->rolling;
}

/* How much a combination is preferred: rest first, then continuity, or the other way round. */
static int preference(const instant *in, const int *chosen, int count) {
  int rest = 0, kept = 0;
  for (int c = 0; c < count; c++) {
    rest += stuck_count(&in->w->trial[chosen[c]]);
    kept += same_mode(&in->w->trial[chosen[c]], &in->w->before[chosen[c]]);
  }
  int big = 2 * in->m->n_contacts + 1;
  return in->s->options.on_indeterminate == FROT_CONTINUE ? kept * big + rest : rest * big + kept;
}

/* Two combinations are one motion when the accelerations of their rows are equal. */
static int is_new_motion(const instant *in, const int *chosen, int count) {
  for (int c = 0; c < count; c++) {
    int rows[FROT_ROWS];
    frot_rows_of(&in->m->contacts[chosen[c]], rows);
    for (int k = 0; k < FROT_ROWS; k++) {
      if (rows[k] < 0) continue;
      double change = acceleration(in, rows[k]) - in->w->best_acceleration[rows[k]];
      if (fabs(change) > 1e-7 * acceleration_size(in, rows[k])) return 1;
    }
  }
  return 0;
}

static void remember(const instant *in, const int *chosen, int count) {
  for (int c = 0; c < count; c++) {
    int i = chosen[c];
    int rows[FROT_ROWS];
    frot_rows_of(&in->m->contacts[i], rows);
    in->w->best[i] = in->w->trial[i];
    for (int k = 0; k < FROT_ROWS; k++)
      if (rows[k] >= 0) in->w->best_acceleration[rows[k]] = acceleration(in, rows[k]);
  }
}

/* Search the combinations of the contacts `chosen`, which are coupled with each other only. Returns
 * the number of motions found, -1 when there are too many combinations. */
static int search(const instant *in, const int *chosen, int count, int forced) {
  frot_work *w = in->w;
  frot_contact_mode lists[CONTACT_OPTIONS];
  int *options = w->choice, *digit = w->choice + count;
  double combinations = 1;
  for (int i = 0; i < in->m->n_contacts; i++) w->trial[i] = (frot_contact_mode){0};
  for (int c = 0; c < count; c++) {
    options[c] = contact_options(in, chosen[c], forced, lists);
    digit[c] = 0;
    w->trial[chosen[c]] = lists[0];
    combinations *= options[c];
  }
  if (combinations > ENOUGH) return -1;
  int motions = 0, best = 0;
  for (;;) {
    if (is_admissible(in, chosen, count)) {
      int rank = preference(in, chosen, count);
      if (motions == 0) {
        motions = 1, best = rank;
        remember(in, chosen, count);
      } else {
        motions += is_new_motion(in, chosen, count);
        if (rank > best) best = rank, remember(in, chosen, count);
      }
    }
    int c = 0;
    for (; c < count; c++) {
      digit[c] = (digit[c] + 1) % options[c];
      contact_options(in, chosen[c], forced, lists);
      w->trial[chosen[c]] = lists[digit[c]];
      if (digit[c] != 0) break;
    }
    if (c == count) return motions;
  }
}

/* Whether a reaction of contact j moves contact i. */
static int coupled(const instant *in, int i, int j) {
  int a[FROT_ROWS], b[FROT_ROWS];
  frot_rows_of(&in->m->contacts[i], a);
  frot_rows_of(&in->m->contacts[j], b);
  for (int k = 0; k < FROT_ROWS * FROT_ROWS; k++) {
    int r = a[k / FROT_ROWS], c = b[k % FROT_ROWS];
    if (r >= 0 && c >= 0 && in->w->delassus[r * in->m->n_rows + c] != 0) return 1;
  }
  return 0;
}

/* Contacts in one component act on each other through the masses. */
static void find_components(const instant *in) {
  const frot_model *m = in->m;
  int *component = in->w->component;
  for (int i = 0; i < m->n_contacts; i++) component[i] = in->w->best[i].closed ? i : -1;
  for (int i = 0; i < m->n_contacts; i++)
    for (int j = 0; j < i; j++) {
      if (component[i] < 0 || component[j] < 0 || component[i] == component[j]) continue;
      if (!coupled(in, i, j) && !coupled(in, j, i)) continue;
      int from = component[i], to = component[j];
      for (int k = 0; k <= i; k++)
        if (component[k] == from) component[k] = to;
    }
}

/* The speed of a row with the largest speeds met so far. */
static double typical_speed(const instant *in, int row) {
  const frot_model *m = in->m;
  double sum = 0;
  for (int k = 0; k < m->nv; k++)
    sum += fabs(in->w->rows[in->l.nw * row + k]) * in->s->data[in->l.scale_x + m->nq + k];
  return sum;
}

/* Contacts that may be closed after the instant, into w->best: those that were, and open ones whose
 * gap has closed. A gap that closes with speed is an impact. */
static int closable(const instant *in, double t, int first) {
  const frot_model *m = in->m;
  for (int i = 0; i < m->n_contacts; i++) {
    const frot_contact *contact = &m->contacts[i];
    frot_contact_mode mode = in->w->before[i];
    in->w->best[i] = mode;
    if (mode.closed || first) continue;
    if (in->fired[FROT_GUARDS * i] == 0) continue;
    double rate = in->w->rate[contact->row_n];
    if (rate < -TOUCH * typical_speed(in, contact->row_n))
      return frot_fail(in->s, FROT_IMPACT, t, i, -1, -1, rate);
    in->w->best[i].closed = 1;
  }
  return FROT_OK;
}

/* Note which rests end now, and in which direction. What was left at this very instant stays left:
 * where two rests hold each other at their bounds, both end. */
static void note_left(const frot_model *m, frot_state *s, double t) {
  frot_layout l = frot_layout_of(m);
  double *left = s->data + l.left;
  const frot_contact_mode *modes = (const void *)(s->data + l.modes);
  if (!(fabs(t - s->left_at) <= SAME_INSTANT * fmax(fabs(t), 1e-3 * s->h_max)))
    memset(left, 0, sizeof(double) * 2 * (size_t)m->n_contacts);
  for (int i = 0; i < m->n_contacts; i++) {
    const double *fired = s->data + l.fired + FROT_GUARDS * i;
    if (modes[i].friction == FROT_STICK && left_by(fired + 1)) left[2 * i] = left_by(fired + 1);
    if (modes[i].rolling == FROT_STICK && left_by(fired + 3)) left[2 * i + 1] = left_by(fired + 3);
  }
  s->left_at = t;
}

/* What is known of the speeds: a slip that has come to zero is zero exactly, if its law can hold
 * it. Moves coordinates and speeds onto what holds. */
static int settle_speeds(instant *in, double t, double *q, double *v) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  double *d = in->s->data + in->l.d;
  int nc = m->n_contacts;
  for (int i = 0; i < nc; i++) {
    if (!w->best[i].closed) continue;
    const frot_contact *contact = &m->contacts[i];
    int slipped = w->before[i].friction > FROT_STICK, rolled = w->before[i].rolling > FROT_STICK;
    if (contact->row_t >= 0 && is_zero_rate(in, contact->row_t, v, FROT_GUARDS * i + 1, slipped))
      in->zero[i] |= 1;
    if (contact->row_r >= 0 && is_zero_rate(in, contact->row_r, v, FROT_GUARDS * i + 3, rolled))
      in->zero[i] |= 2;
  }
  for (int i = 0; i < nc; i++) { /* a law that bounds nothing holds nothing */
    if (!bounds_something(w, &m->contacts[i], i, 0)) in->zero[i] &= (unsigned char)~1;
    if (!bounds_something(w, &m->contacts[i], i, 1)) in->zero[i] &= (unsigned char)~2;
    in->at_rest[i] = in->zero[i] & 1;
  }
  memcpy(w->trial, w->best, sizeof *w->trial * (size_t)nc);
  for (int i = 0; i < nc; i++) w->trial[i].friction = w->trial[i].rolling = FROT_NONE;
  int moved;
  return frot_project(m, in->s, w, t, q, v, d, w->trial, in->zero, &moved);
}

/* The modes into w->best, component after component. */
static int choose_modes(const instant *in, double t, int first, frot_recorder *recorder) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  int several = 0, several_at = -1;
  find_components(in);
  for (int root = 0; root < m->n_contacts; root++) {
    int *chosen = w->row_of + m->n_rows, count = 0;
    for (int i = 0; i < m->n_contacts; i++)
      if (w->component[i] == root) chosen[count++] = i;
    if (count == 0) continue;
    int motions = search(in, chosen, count, 1);
    if (motions == 0) motions = search(in, chosen, count, 0);
    if (motions < 0) return frot_fail(in->s, FROT_TOO_LARGE, t, chosen[0], -1, -1, count);
    if (motions == 0) return frot_fail(in->s, FROT_IMPASSE, t, chosen[0], -1, -1, 0);
    if (motions > 1) several = motions, several_at = chosen[0];
  }
  if (!several) return FROT_OK;
  if (first)
    in->s->several = several, in->s->several_at = several_at; /* told by the first frot_advance */
  else
    frot_note(recorder, in->s, t, FROT_EVENT_SEVERAL, several_at,
              frot_mode_value(&w->before[several_at]), frot_mode_value(&w->best[several_at]),
              several);
  if (in->s->options.on_indeterminate == FROT_HALT)
    return frot_fail(in->s, FROT_SEVERAL, t, several_at, -1, -1, several);
  return FROT_OK;
}

int frot_resolve(const frot_model *m, frot_state *s, frot_work *w, double t, double *q, double *v,
                 int first, frot_recorder *recorder) {
  frot_layout l = frot_layout_of(m);
  int nc = m->n_contacts;
  double *d = s->data + l.d, *fired = s->data + l.fired, *frozen = s->data + l.frozen;
  frot_contact_mode *modes = (frot_contact_mode *)(void *)(s->data + l.modes);
  unsigned char *flags = (unsigned char *)(w->choice + 2 * nc);
  note_left(m, s, t);
  instant in = {m, s, w, l, fired, s->data + l.unilateral, s->data + l.left, flags, flags + nc};
  memcpy(w->before, modes, sizeof *modes * (size_t)nc);
  memset(flags, 0, 2 * (size_t)nc);

  int status = frot_kinematics(m, s, w, t, q, v, d);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);
  status = closable(&in, t, first);
  if (status != FROT_OK) return status;
  status = frot_dynamics(m, s, w, t, q, v, d, w->best);
  if (status == FROT_OK) status = frot_metric(m, w);
  if (status == FROT_OK) status = settle_speeds(&in, t, q, v);
  if (status == FROT_OK) status = frot_dynamics(m, s, w, t, q, v, d, w->best);
  if (status == FROT_OK) status = frot_metric(m, w);
  if (status != FROT_OK) return frot_fail_evaluation(m, s, w, status, t);

  frot_row_loads(m, s, w, t, q, v, d, w->best);
  status = choose_modes(&in, t, first, recorder);
  if (status != FROT_OK) return status;
  memcpy(modes, w->best, sizeof *modes * (size_t)nc);
  if (!first) frot_note_changes(m, s, t, w->before, modes, recorder);
  frot_find_frozen(m, w, modes, frozen);
  for (int k = 0; k < m->nv; k++)
    if (frozen[k] != 0) v[k] = 0;
  memset(fired, 0, sizeof(double) * (size_t)l.nf);
  /* The guards of another mode have another size. */
  for (int i = 0; i < nc; i++)
    if (memcmp(&modes[i], &w->before[i], sizeof *modes) != 0)
      memset(s->data + l.scale_g + FROT_GUARDS * i, 0, sizeof(double) * FROT_GUARDS);
  return FROT_OK;
}
