/* The flat block of an instance, as the kernel's files see it. */
#ifndef FROT_STATE_H
#define FROT_STATE_H

#include <float.h>
#include <math.h>

#include "numerics/dormand_prince_table.h"
#include "frot.h"

#define FROT_MAGIC 0x46524f54u
#define FROT_LAYOUT_VERSION 31
#define FROT_KEY 72
#define FROT_QUADRATURES 2 /* dissipated energy, work of forces without potential */

enum frot_phase { FROT_CLEARED = 0, FROT_RUNNING = 1, FROT_FAULTED = 2, FROT_ENDED = 3 };

/* A closed contact that bears nothing because others do: while its spring is not pressed. */
enum { FROT_BY_SPRINGS = 2 };

/* Mode of a contact or, after those of all contacts, of an element. As large as a double, so that
 * segments are arrays of doubles. */
typedef struct {
  signed char closed;   /* contact: 0 open, 1 closed */
  signed char side;     /* contact: sign of its normal reaction, +1 or -1 */
  signed char unloaded; /* contact: closed, but others carry its load: its reaction is zero;
                           1, or FROT_BY_SPRINGS: equal_springs.h */
  signed char friction; /* element: frot_friction */
  signed char at_bound; /* element that sticks: others hold it, its own friction is at its bound, in
                           the direction of the sign */
  signed char starts;   /* element of several components that slips: in the direction kept as
                           `heading`, since its slip is zero at the start of the step */
  signed char
      shared; /* contact or element: closed or stuck, by reactions that are not determined */
  signed char reserved[1];
} frot_contact_mode;

/* Offsets in doubles from the head of state->data, and sizes. Computed from the model. */
typedef struct {
  int nw, nx, nz, ng, nf, nd, ns; /* ns: doubles of a segment */
  int early;                      /* unknowns of the blocks that are not late */
  int set, given, p, kept, u, ramp, experiment, nominal, unilateral, restitution, flights, carried,
      x, y, slope, slip, heading, scale_x, scale_g, most_g, worth, lost, noise, along, friction,
      reach, asleep, fired, several, due, blows, left, vanished, spare, sign, posture, requested,
      fresh, near, modes, d, frozen, segment, size;
} frot_layout;

struct frot_state {
  unsigned magic, version;
  unsigned long long size; /* bytes of the block */
  char key[FROT_KEY];
  int phase;
  int pending;   /* an event waits at the end of the current segment */
  int has_slope; /* slope holds the derivatives at the end of the current segment */
  int changed;   /* parameters or inputs were set since the last frot_settle */
  int ramps;     /* inputs change with time, linearly from ramps_from on */
  int crowded;   /* events since the time last moved on */
  int idle;      /* the last of them that changed nothing, in a row: guard_crossing.h */
  int fleeting;  /* the contact at which no motion lasts at the last event, or -1 */
  int second; /* the contact whose figures meet at another place too, or -1: closest_features.h */
  long long told;  /* events that changed something before that */
  int jammed;      /* the group without reactions beyond jammed_at, -1 once it has other modes */
  int jumped;      /* the last event of the text moved coordinates or speeds */
  int settled;     /* contacts whose bounces have ended, which is no event yet: event_log.h */
  int several;     /* groups had several motions, or impacts, at the start: to be recorded */
  int asleep;      /* islands that sleep: see sleeping.h */
  int naps;        /* times that this has changed */
  int kept_naps;   /* the same when the whole segment was kept, and not what is awake alone */
  double foreseen; /* the nearest singular posture, as the last step shows it, or INFINITY */
  int spare_loops; /* rows of loops are left out, others may be at the next start: redundant_rows.h
                    */
  int measured;    /* rows of loops are measured beside all others: singular_posture.c */
  int weak;        /* rows of loops are weak: singular_posture.h */
  int tied; /* stages are put onto the relations of loops: singular_posture.h; < 0: not for some
               steps */
  int from_posture; /* the first step begins in one, on a way that its speeds say: tangent_cone.h */
  double across;    /* error, to its bound, of the last step that tried to pass a posture ahead */
  int no_better;    /* times in a row that the next was none, posture_passage.c */
  int implicit;     /* the next step is made by the implicit method */
  int was_implicit; /* the current segment was */
  int unmeasured;   /* steps since rounding was measured: see step.c */
  int stiff_steps, calm_steps; /* see method_choice.h */
  int patience, stay;
  double felt, explicit_step; /* see method_choice.h */
  int outcome;                /* the `terminate` that ended the run */
  int untold;         /* outcomes wait to be recorded as events: their times are in `requested`, NaN
                         elsewhere */
  int ended_recorded; /* the last instant of a run that has ended is recorded */
  int shrinking;      /* times in a row that the text's events followed each other sooner */
  /* when the last one was, how long after the one before, over the gap before that, and the gap
   * that the row began with */
  double text_event, text_gap, text_ratio, text_first;
  double crowded_since;
  double unseen; /* flights that another integrator goes through without a step, at this instant:
                    speed times duration, over the lengths of the gap */
  double drift;  /* how far another integrator has come off the relations, in sizes of states */
  double step_drift; /* the largest part of that which one of its steps has made */
  double ramps_from;
  double calm;               /* the next step as it is without events that cut steps short */
  double jammed_at;          /* where no step was possible for want of reactions, or NaN */
  double left_at;            /* instant of the last event: see `left` and `vanished` */
  double t;                  /* time reached */
  double h;                  /* next step */
  double last_h, last_ratio; /* the last step and its error over the bound; 0: none */
  double failed_h;           /* the last step whose error was too large, and longer since */
  double caution;            /* part of their length that steps are to have: step_length.c */
  int noise_measured; /* rounding is known; < 0: from before the last event, of another system */
  int noise_shown;    /* an error was seen that rounding made, and rounding not measured since */
  double heard_at;    /* start of the step in which it was measured last, NaN: in none */
  double noise_level; /* how much larger it was than measured */
  double heard;       /* the longest step planned since rounding was measured last */
  double due;         /* when time next changes a condition, INFINITY if never */
  double h_max;
  double began; /* time of the start */
  double tolerance;
  double energy; /* kinetic + potential at the start, corrected for changes from outside */
  double energy_scale;
  double energy_terms; /* the largest that what the energies are made of has been seen to be */
  frot_options options;
  frot_fault fault;
  frot_statistics statistics;
  double data[];
};

/* Of each contact, in state->data from `flights` on: when it has met or parted last, whether it
 * has, how long it had been open before, the speed with which it met then, whether it stays closed
 * then, when its impacts end, one more than the mode in which it rests then as long as that is no
 * event yet, and the largest that its gap and what it is made of have been; of an impact at the
 * start, to be recorded as an event, its kind, impulse and loss of energy. */
enum {
  FROT_MET,
  FROT_HAS_MET,
  FROT_FLOWN,
  FROT_LANDED,
  FROT_STAYS_CLOSED,
  FROT_ENDS_AT,
  FROT_UNTOLD,
  FROT_FLIGHT_SIZE,
  FROT_START_KIND,
  FROT_START_IMPULSE,
  FROT_START_LOST,
  FROT_FLIGHT
};

/* Those of a contact. */
static inline double *frot_flight_of(frot_state *state, const frot_layout *layout, int contact) {
  return state->data + layout->flights + FROT_FLIGHT * contact;
}

/* Parts of a segment. */
typedef struct {
  double *t0, *t1, *h;
  frot_contact_mode *modes;
  double *d, *frozen;
  double *spare;    /* n_rows: left to others inside it, none at an instant: redundant_rows.h */
  double *along;    /* 2 n_elements: where to begin to look for the directions of pins' reactions */
  double *heading;  /* n_elements: components of directions of slips at its start */
  double *friction; /* n_elements: at its start */
  double *y0, *y1;  /* unknowns of the blocks at its ends */
  double *sizes;    /* the largest that q and v have been, where there are invariants */
  double *x0;       /* nx: q, v, quadratures */
  double *f;        /* DP_DENSE x nx */
} frot_segment;

/* A recorded segment begins with its length, how far before it, in doubles, one stands by itself
 * that holds what it lacks: 0 where it does so itself, and what it tells of its inside:
 * segment_store.h. */
#define FROT_RECORD_HEAD 3

/* Times that differ by less are one instant: both are sums, rounded in different ways. */
#define FROT_SAME_INSTANT(t) (4 * DBL_EPSILON * fabs(t))

frot_layout frot_layout_of(const frot_model *model);
frot_segment frot_segment_at(const frot_model *model, double *data);

/* Make all as in a new state but the parameters and inputs set. */
void frot_clear_run(const frot_model *model, frot_state *state);

/* Whether a contact has a normal, and can open. */
int frot_has_normal(const frot_contact *contact);

/* Open a contact: its laws bound nothing. */
void frot_open(const frot_model *model, frot_contact_mode *modes, int contact);

/* Value of a liaison's variable `mode`. */
int frot_mode_value(const frot_model *model, const frot_contact_mode *modes, int contact);

/* Whether a contact slips forwards (1) or backwards (-1), or sticks (0); of one that is open or has
 * no friction that is free. */
enum { FROT_SENSE_FREE = 2 };
int frot_sense_of_slip(const frot_model *model, const frot_contact_mode *modes, int contact);

/* What text and laws read of a mode, by its place among the modes that are read. */
double frot_mode_read(const frot_model *model, const frot_contact_mode *modes, int k);

/* That nothing is wrong at t. */
frot_fault frot_no_fault(double t);
/* Record a fault and return its status. */
int frot_fail(frot_state *state, int status, double t, int contact, int item, int other,
              double value);

#endif
