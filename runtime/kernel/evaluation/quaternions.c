#include "evaluation/quaternions.h"
#include "numerics/tolerances.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* c <- a b. */
static void multiply(const double *a, const double *b, double *c) {
  c[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
  c[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
  c[2] = a[0] * b[2] + a[2] * b[0] + a[3] * b[1] - a[1] * b[3];
  c[3] = a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1];
}

void frot_turned(const frot_turn *turn, const double *by, const double *r, double *out) {
  if (turn->own_axes)
    multiply(r, by, out);
  else
    multiply(by, r, out);
}

static int is_of_group(const frot_model *m, const frot_turn *turn, const frot_group *g) {
  return &m->groups[m->speed_group[turn->speed[2]]] == g;
}

/* The items of a turn's speeds in a vector over the speeds of its group. */
static void items_of(const frot_model *m, const frot_turn *turn, const double *over, double *w) {
  for (int k = 0; k < 3; k++) w[k] = turn->speed[k] < 0 ? 0 : over[m->speed_local[turn->speed[k]]];
}

static double length_of(const double *r) {
  return sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
}

void frot_displace(const frot_model *m, const frot_group *g, double *q, const double *step,
                   double part) {
  for (int i = 0; i < g->n_speeds; i++) {
    int coordinate = m->speed_coordinate[g->unknowns[i]];
    if (coordinate >= 0) q[coordinate] += part * step[i];
  }
  for (int i = 0; i < m->n_turns; i++) {
    const frot_turn *turn = &m->turns[i];
    double w[3], by[4], *r = q + turn->at, out[4];
    if (!is_of_group(m, turn, g)) continue;
    items_of(m, turn, step, w);
    for (int k = 0; k < 3; k++) w[k] *= part;
    double angle = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    double half = angle > 0 ? sin(angle / 2) / angle : 0.5;
    by[0] = cos(angle / 2);
    for (int k = 0; k < 3; k++) by[k + 1] = half * w[k];
    frot_turned(turn, by, r, out);
    double length = length_of(out);
    for (int k = 0; k < 4; k++) r[k] = out[k] / length;
  }
}

void frot_coordinates_after(const frot_model *m, const frot_group *g, const double *v,
                            const double *a, double dt, double *step, double *q) {
  for (int i = 0; i < g->n_speeds; i++) {
    int speed = g->unknowns[i];
    step[i] = v[speed] + (a ? 0.5 * dt * a[speed] : 0);
  }
  frot_displace(m, g, q, step, dt);
}

/* Whether coordinate j is an item of an orientation. */
static int is_turned(const frot_model *m, int j) {
  for (int i = 0; i < m->n_turns; i++)
    if (j >= m->turns[i].at && j < m->turns[i].at + 4) return 1;
  return 0;
}

void frot_drift(const frot_model *m, double *q, const double *rates, double part) {
  for (int j = 0; j < m->nq; j++)
    if (m->q_speed[j] < 0 && !is_turned(m, j)) q[j] += part * rates[j];
}

void frot_over_turn(const frot_model *m, const frot_turn *turn, const double *entries,
                    const double *r, double *items) {
  double by[4] = {0, 0, 0, 0};
  items_of(m, turn, entries, by + 1);
  frot_turned(turn, by, r, items);
  for (int k = 0; k < 4; k++) items[k] *= 2;
}

void frot_over_coordinates(const frot_model *m, const frot_group *g, const double *entries,
                           const double *q, double *row) {
  memset(row, 0, sizeof(double) * (size_t)m->nq);
  for (int i = 0; i < g->n_speeds; i++) {
    int coordinate = m->speed_coordinate[g->unknowns[i]];
    if (coordinate >= 0) row[coordinate] = entries[i];
  }
  for (int i = 0; i < m->n_turns; i++) {
    const frot_turn *turn = &m->turns[i];
    if (is_of_group(m, turn, g)) frot_over_turn(m, turn, entries, q + turn->at, row + turn->at);
  }
}

int frot_normalise(const frot_model *m, double *q) {
  int moved = 0;
  for (int i = 0; i < m->n_turns; i++) {
    double *r = q + m->turns[i].at, length = length_of(r);
    if (fabs(length * length - 1) <= FROT_UNIT_SQUARE || !(length > 0)) continue;
    for (int k = 0; k < 4; k++) r[k] /= length;
    moved = 1;
  }
  return moved;
}
