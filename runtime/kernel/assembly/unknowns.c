#include "assembly/unknowns.h"

#include <math.h>
#include <string.h>

#include "evaluation/quaternions.h"

/* The directions of a turn's changes: along the quaternion r, then half of what unit turns make. */
static void directions(const frot_turn *turn, const double *q, double d[4][4]) {
  const double *r = q + turn->at;
  double length = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
  for (int k = 0; k < 4; k++) d[0][k] = length > 0 ? r[k] / length : k == 0;
  for (int j = 0; j < 3; j++) {
    double by[4] = {0, 0, 0, 0};
    by[1 + j] = 0.5;
    frot_turned(turn, by, d[0], d[1 + j]);
  }
}

void frot_over_changes(const frot_opening *p, const double *row, double *out) {
  memcpy(out, row, sizeof(double) * (size_t)p->n_own);
  for (int i = 0; i < p->part->n_turns && !p->velocity; i++) {
    double d[4][4];
    const frot_turn *turn = &p->w->opening.turns[i];
    const double *own = row + turn->at;
    directions(turn, p->basis, d);
    for (int j = 0; j < 4; j++)
      out[turn->at + j] = d[j][0] * own[0] + d[j][1] * own[1] + d[j][2] * own[2] + d[j][3] * own[3];
  }
}

void frot_from_changes(const frot_opening *p, const double *changes, double *x) {
  memcpy(x, changes, sizeof(double) * (size_t)p->n_own);
  for (int i = 0; i < p->part->n_turns && !p->velocity; i++) {
    double d[4][4];
    const frot_turn *turn = &p->w->opening.turns[i];
    const double *own = changes + turn->at;
    directions(turn, p->basis, d);
    for (int k = 0; k < 4; k++)
      x[turn->at + k] = d[0][k] * own[0] + d[1][k] * own[1] + d[2][k] * own[2] + d[3][k] * own[3];
  }
}

void frot_into_changes(const frot_opening *p, const double *apart, double *changes) {
  frot_over_changes(p, apart, changes);
  for (int i = 0; i < p->part->n_turns && !p->velocity; i++)
    for (int k = 1; k < 4; k++) changes[p->w->opening.turns[i].at + k] *= 4;
}
