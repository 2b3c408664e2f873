#include "evaluation/slip_frames.h"

#include <math.h>
#include <string.h>

#include "model/indexing.h"
#include "numerics/dense.h"

#define TURNED 0.5 /* cosine between a slip and its heading below which it has passed zero */

double frot_slip_of(const frot_model *m, const double *rate, int e, double d[FROT_MOST_PARTS]) {
  const frot_element *element = &m->elements[e];
  double sum = 0;
  for (int k = 0; k < element->parts; k++) sum += rate[element->row + k] * rate[element->row + k];
  double size = sqrt(sum);
  for (int k = 0; k < element->parts && d; k++) d[k] = size > 0 ? rate[element->row + k] / size : 0;
  return size;
}

double frot_turned_slip(const frot_model *m, const frot_work *w, int e, double *d) {
  const double *frame = w->core.frame + FROT_MOST_PARTS * FROT_MOST_PARTS * e;
  const double *rate = w->core.rate + m->elements[e].row;
  int n = m->elements[e].parts;
  double size = frot_length(rate, n);
  for (int k = 0; k < n && size > 0; k++) {
    double sum = 0;
    for (int j = 0; j < n; j++) sum += frame[j * n + k] * rate[j];
    d[k] = sum / size;
  }
  return size;
}

/* frame (n x n, by rows) <- an orthonormal one whose first row is the unit vector d: the reflection
 * that takes the first axis to d or to -d (A. Householder 1958), with the sign put right. */
static void make_frame(const double *d, int n, double *frame) {
  double u[FROT_MOST_PARTS], sign = d[0] > 0 ? -1 : 1, square = 0;
  for (int k = 0; k < n; k++) u[k] = d[k] - (k == 0 ? sign : 0), square += u[k] * u[k];
  for (int i = 0; i < n; i++)
    for (int k = 0; k < n; k++) {
      double entry = (i == k) - 2 * u[i] * u[k] / square;
      frame[i * n + k] = i == 0 ? sign * entry : entry;
    }
}

/* The n items, `step` apart, become those along the frame's rows. */
static void turn(const double *frame, int n, double *items, int step) {
  double before[FROT_MOST_PARTS];
  for (int k = 0; k < n; k++) before[k] = items[k * step];
  for (int i = 0; i < n; i++) {
    double sum = 0;
    for (int k = 0; k < n; k++) sum += frame[i * n + k] * before[k];
    items[i * step] = sum;
  }
}

/* The direction in which an element slips, by its rates or as it is kept. */
static void direction_of(const frot_model *m, const frot_state *s, const frot_work *w, int e,
                         int starts, double *d) {
  const double *heading = w->reactions.follow ? w->reactions.heading : s->data + w->layout.heading;
  int n = m->elements[e].parts;
  double size = frot_slip_of(m, w->core.rate, e, d), sum = 0, along = 0;
  for (int k = 0; k < n; k++)
    sum += heading[e + k] * heading[e + k], along += heading[e + k] * d[k];
  int passed = w->reactions.ahead && sum > 0 && along < TURNED * sqrt(sum);
  if (size > 0 && !starts && !passed) return;
  for (int k = 0; k < n; k++) d[k] = heading[e + k];
  for (int k = 0; k < n; k++) d[k] = sum > 0 ? d[k] / sqrt(sum) : k == 0;
}

void frot_turn_slip_rows(const frot_model *m, const frot_state *s, frot_work *w,
                         const frot_contact_mode *modes) {
  const frot_awake_lists *now = w->awake.now;
  for (int i = 0; i < now->n_elements && w->core.frame; i++) {
    int e = now->elements[i], n = m->elements[e].parts, row = m->elements[e].row;
    if (!frot_is_vector(m, e)) continue;
    const frot_contact_mode *mode = frot_element_mode(m, modes, e);
    double d[FROT_MOST_PARTS], *frame = w->core.frame + FROT_MOST_PARTS * FROT_MOST_PARTS * e;
    frame[0] = NAN; /* none */
    if (!modes[m->elements[e].contact].closed || mode->friction <= FROT_STICK) continue;
    direction_of(m, s, w, e, mode->starts, d);
    make_frame(d, n, frame);
    const frot_group *g = frot_group_of(m, row);
    int from = g->n, to = 0;
    for (int k = 0; k < n; k++) {
      const int *reach = w->core.reach + 2 * (row + k);
      from = reach[0] < from ? reach[0] : from, to = reach[1] > to ? reach[1] : to;
    }
    int step = (int)(frot_entries(m, w->core.rows, row + 1) - frot_entries(m, w->core.rows, row));
    for (int j = from; j < to; j++) {
      turn(frame, n, frot_entries(m, w->core.rows, row) + j, step);
      if (g->general) turn(frame, n, frot_entries(m, w->core.effect, row) + j, step);
    }
    turn(frame, n, w->core.c + row, 1);
    turn(frame, n, w->core.rate + row, 1);
  }
}

const double *frot_lam_of_text(const frot_model *m, frot_work *w) {
  const frot_awake_lists *now = w->awake.now;
  if (!w->core.frame) return w->core.lam;
  memcpy(w->core.lam_of_text, w->core.lam, sizeof(double) * (size_t)m->n_rows);
  for (int i = 0; i < now->n_elements; i++) {
    int e = now->elements[i], n = m->elements[e].parts, row = m->elements[e].row;
    if (!frot_is_vector(m, e)) continue;
    const double *frame = w->core.frame + FROT_MOST_PARTS * FROT_MOST_PARTS * e;
    if (isnan(frame[0])) continue;
    for (int k = 0; k < n; k++) {
      double sum = 0;
      for (int j = 0; j < n; j++) sum += frame[j * n + k] * w->core.lam[row + j];
      w->core.lam_of_text[row + k] = sum;
    }
  }
  return w->core.lam_of_text;
}
