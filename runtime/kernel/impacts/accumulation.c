#include "impacts/accumulation.h"

#include <math.h>

#include "evaluation/term_sizes.h"
#include "numerics/tolerances.h"

/* The length of a flight, its duration times its speed, below which it is none. */
static double least_flight(const frot_instant *in, int i) {
  double part = fmax(FROT_LEAST_FLIGHT, in->s->unseen);
  return part * frot_flight_of(in->s, &in->l, i)[FROT_FLIGHT_SIZE];
}

/* Note the sizes that the gap of contact i has had. */
static void note_size(const frot_instant *in, int i) {
  double made = frot_size_of_gap(in->m, in->s, in->w, i, in->q);
  double *size = frot_flight_of(in->s, &in->l, i) + FROT_FLIGHT_SIZE;
  *size = fmax(*size, fmax(made, in->s->data[in->l.scale_g + i]));
}

/* Note the flight of contact i that ends with the speed u. */
static int note_flight(const frot_instant *in, int i, double u) {
  double *flight = frot_flight_of(in->s, &in->l, i), last = flight[FROT_FLOWN];
  double flown = flight[FROT_HAS_MET] != 0 ? in->t - flight[FROT_MET] : 0;
  double ratio = last > 0 ? flown / last : 1;
  flight[FROT_MET] = in->t, flight[FROT_FLOWN] = flown, flight[FROT_HAS_MET] = 1;
  flight[FROT_LANDED] = u;
  note_size(in, i);
  flight[FROT_STAYS_CLOSED] = flown > 0 && u * flown < least_flight(in, i);
  flight[FROT_ENDS_AT] = in->t + (ratio < FROT_ENDING ? flown * ratio / (1 - ratio) : 0);
  return flight[FROT_STAYS_CLOSED] != 0;
}

int frot_note_flights(const frot_instant *in, const int *chosen, int count) {
  int settles = 0;
  for (int c = 0; c < count; c++) {
    int i = chosen[c];
    frot_flight_of(in->s, &in->l, i)[FROT_STAYS_CLOSED] = 0;
    if (in->w->impacts.meets[i])
      settles |= note_flight(in, i, -in->w->core.rate[in->m->contacts[i].row_n]);
  }
  return settles;
}

int frot_is_settled_beside(const frot_instant *in, int i, double u) {
  const double *flight = frot_flight_of(in->s, &in->l, i);
  /* a flight that begins with another speed than the last ended with takes as much longer */
  double longer = fmax(u / flight[FROT_LANDED], 1);
  return flight[FROT_FLOWN] > 0 && u * flight[FROT_FLOWN] * longer < least_flight(in, i);
}
