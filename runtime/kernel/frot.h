/* The kernel's contract: a compiled model, the state of an instance, and what can be done with it.
 *
 * A model is a constant table written by the compiler (model.h). All that changes in a run is in
 * one flat block without pointers (frot_state): copying the block saves an instance, copying it
 * back restores it. Scratch memory (frot_work) carries nothing from one call to the next. The
 * kernel allocates nothing, has no globals and is re-entrant: one state and one work block an
 * instance.
 *
 * The motion is a chain of segments. A segment is one accepted step of the integrator with its
 * dense output, in one mode of every liaison. A segment may end beyond the time required: values
 * in between are those of the dense output, so that results do not depend on the times of
 * output. Only a change of a parameter or an input from outside cuts a segment.
 */
#ifndef FROT_H
#define FROT_H

#include <stddef.h>

#include "model/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Status of every call that can fail. Positive: recorded in state->fault. */
enum frot_status {
  FROT_OK = 0,
  FROT_FULL = 1,         /* the recorder is full: drain it and call again */
  FROT_STOPPED = 2,      /* the monitor returned a stop */
  FROT_TERMINATED = 3,   /* the model's own `terminate`: the run is over and good */
  FROT_CHECK = 10,       /* a parameter has a value the model cannot have */
  FROT_INITIAL = 11,     /* contradictory initial values */
  FROT_IMPACT = 13,      /* two bodies meet, and no impulses satisfy their laws */
  FROT_IMPASSE = 14,     /* no admissible motion */
  FROT_SEVERAL = 15,     /* several admissible motions and on_indeterminate = stop */
  FROT_CHATTER = 16,     /* events without end at one instant */
  FROT_NAN = 17,         /* a force or an equation gives no number */
  FROT_DIVERGE = 18,     /* the step went to zero: jamming or a singular point */
  FROT_SINGULAR = 19,    /* the mass matrix is singular */
  FROT_TOO_LARGE = 20,   /* too many coupled friction elements change at once */
  FROT_MISUSE = 21,      /* a call out of order or with bad arguments */
  FROT_ALGEBRAIC = 22,   /* a block of equations has no solution, or a singular one */
  FROT_ASSERT = 23,      /* an `assert` of the text does not hold */
  FROT_REFUSED = 24,     /* a change from outside cannot be made in a run; the old values stay */
  FROT_EVENT_FAULT = 30, /* an event of the text cannot do what it says */
  FROT_VANISHED = 32,    /* a curve or surface has no tangent or normal where a liaison needs it */
  FROT_INDEX = 33,       /* a branch does not hold the unknown its equation is solved for */
  FROT_NO_NORMAL = 34,   /* figures meet that have no common normal */
  FROT_POSTURE = 31,     /* relations of a loop do not determine its motion */
  FROT_JUMP = 25         /* a `reinit` or a switch moves a body against its relations */
};

/* Why a change is refused: `other` of the fault. Of contacts, then of bodies that are carried
 * (item: which), last of relations of the text (item: its statement). */
enum frot_why {
  FROT_PARTS = 0,   /* a liaison that cannot part would be apart */
  FROT_ENTERS = 1,  /* a body would be inside a line */
  FROT_MEETS = 2,   /* bodies would meet with speed */
  FROT_JERKS = 3,   /* a liaison that cannot part would part with speed, or carry a body along */
  FROT_CARRIES = 4, /* a body would be carried along at once */
  FROT_TURNS = 5,   /* and turned */
  FROT_BREAKS = 6   /* a relation of the text would not hold any more */
};

/* A state has grown beyond what can be followed: the item of a fault FROT_DIVERGE. */
#define FROT_GROWS 2

/* Modes of the relative motion a law of friction bounds. */
enum frot_friction { FROT_NONE = 0, FROT_STICK = 1, FROT_SLIP_FORWARD = 2, FROT_SLIP_BACKWARD = 3 };

/* Values of a liaison's variable `mode` (FMU integers). */
enum frot_mode { FROT_MODE_OPEN = 0, FROT_MODE_STICK = 1, FROT_MODE_SLIP = 2 };

enum frot_event_kind {
  FROT_EVENT_STICK = 0,      /* slip ended: slip -> stick */
  FROT_EVENT_SLIP = 1,       /* the bound was reached: stick -> slip */
  FROT_EVENT_REVERSAL = 2,   /* slip -> slip the other way */
  FROT_EVENT_SEPARATION = 3, /* closed -> open */
  FROT_EVENT_CONTACT = 4,    /* open -> closed */
  FROT_EVENT_ROLL_STOP = 5,  /* rolling ended (rolling resistance holds) */
  FROT_EVENT_ROLL_START = 6,
  FROT_EVENT_ROLL_REVERSAL = 7,
  FROT_EVENT_REACTION = 8,   /* the reaction of a bilateral liaison changes sides */
  FROT_EVENT_CONDITION = 9,  /* a condition of the text changes */
  FROT_EVENT_SEVERAL = 10,   /* several motions are admissible; count in `solutions` */
  FROT_EVENT_WARNING = 11,   /* a warning of the text; `contact` is its outcome */
  FROT_EVENT_TERMINATE = 12, /* the text ended the run; `contact` is its outcome */
  FROT_EVENT_IMPACT = 13,    /* a contact that closes with speed, or is pressed by another impact */
  FROT_EVENT_LAST_IMPACT = 14,       /* the same, and the last of infinitely many until `until` */
  FROT_EVENT_TANGENTIAL_IMPACT = 15, /* a contact is pressed by its friction, without collision */
  FROT_EVENT_PERCUSSION = 16         /* an impulse of the text; `contact` is its outcome */
};

typedef struct {
  int status; /* frot_status */
  /* contact; check, statement, or of FROT_CHATTER a condition or, counted on, a held value; second
   * statement or condition: -1 where none; of FROT_INITIAL without statement -2 for speeds; of
   * FROT_POSTURE the item is 0 where the speeds at the start say no way, or several, which differ
   * in the speed `other`; of
   * FROT_DIVERGE the item is 0 where time takes the contact apart, FROT_GROWS where the state
   * `other` is beyond bounds, of FROT_IMPACT where the figures
   * of a closed contact meet at a second place */
  int contact, item, other;
  double t, value;
  double where[FROT_WHERE]; /* of FROT_VANISHED; values of that speed */
} frot_fault;

/* Admissible motions that are distinguished at one instant; as many solutions mean at least so
 * many.
 */
#define FROT_MOST_MOTIONS 31

typedef struct {
  double t;
  int kind, contact;
  int before, after; /* frot_mode, or frot_friction for rolling */
  int solutions;     /* of an impact: phases of slip, stick and compression */
  int together;      /* contacts that take part in an impact */
  int element;       /* one more than the element whose motion begins, ends or reverses; 0: none */
  double impulse;    /* of an impact: along the normal */
  double lost;       /* and energy that this contact has taken */
  double until;      /* of FROT_EVENT_LAST_IMPACT: the instant by which its impacts have ended */
  /* Of a percussion: its impulse in ground axes, its length is `impulse`. The first of an instant
   * has `together`, the number of them, and less their work in `lost`. */
  double vector[3];
} frot_event;

typedef struct {
  long long steps, rejected, evaluations, events;
  long long implicit_steps, jacobians; /* steps of the implicit method among `steps` */
  long long unsearched; /* instants at which other motions were not looked for: too many modes */
  double blurred;       /* largest error of a step, relative, that rounding made beyond its bound */
  long long crossings;  /* steps through postures in which rows that hold depend on each other */
  long long free;       /* speeds at the start that no permanent row holds */
  double masked;        /* part of an acceleration that rounding of the inertias may make there */
  double lost;          /* part of a state's size that rounding of rates has made; 0: it is small */
  long long lost_state; /* that state, where `lost` is above zero */
  long long springs; /* steps in which redundant contacts slide: reactions are of equal springs */
  long long spring;  /* one of these contacts */
} frot_statistics;

/* The model compiled together with the kernel. */
extern const frot_model frot_the_model;

/* Options of a run, fixed at frot_start. FROT_COLLIDE: where the friction of a contact can press it
 * without collision it does so, before other motions; else as FROT_REST. */
enum frot_indeterminate { FROT_REST = 0, FROT_CONTINUE = 1, FROT_HALT = 2, FROT_COLLIDE = 3 };
/* Where no motion is admissible: a tangential impact, or the run ends. */
enum frot_impasse { FROT_IMPASSE_BY_IMPACT = 0, FROT_IMPASSE_ENDS = 1 };
typedef struct {
  double tolerance; /* <= 0: the model's own */
  int on_indeterminate;
  int on_impasse;
} frot_options;

/* Head of the flat block of an instance; its arrays follow it (see layout.h). */
typedef struct frot_state frot_state;
typedef struct frot_work frot_work;

/* Where segments and events go, in memory of the caller. A segment takes frot_segment_size doubles
 * at most: one in which islands sleep refers to one before it for what stands still. Its first item
 * is its length, its fourth the time at which it begins. The first of each memory stands by itself.
 * With segments NULL only events are recorded. The events need room for frot_events_at_once, and a
 * single instant may bring more: then `drain` is called with `context`, which takes the events or
 * gives more room. Events that still find no room are counted in `lost`. */
typedef struct frot_recorder frot_recorder;
struct frot_recorder {
  double *segments;
  long long segment_capacity, segment_used; /* doubles */
  frot_event *events;
  long long event_capacity, event_count;
  long long last;        /* where the last segment begins */
  long long whole, naps; /* the kernel's own: the last that stands by itself, and what slept */
  void (*drain)(frot_recorder *recorder, void *context); /* may be NULL */
  void *context;
  long long lost;
};

/* Called now and then with the time reached; a nonzero answer stops the run. May be NULL. */
typedef int (*frot_monitor)(void *context, double t);

size_t frot_state_size(const frot_model *model);      /* bytes */
size_t frot_work_size(const frot_model *model);       /* bytes */
long long frot_segment_size(const frot_model *model); /* doubles of the longest segment */

/* Events that one instant usually brings at most. */
long long frot_events_at_once(const frot_model *model);

/* Fill a new state with the defaults of the model. */
void frot_state_clear(const frot_model *model, frot_state *state);

/* Parameters and inputs, in SI. A value that differs from the one held is noted, and takes effect
 * at frot_start or, in a run, at the time reached (frot_settle). */
void frot_set_parameter(const frot_model *model, frot_state *state, int index, double value);
void frot_set_input(const frot_model *model, frot_state *state, int index, double value);
/* Rate of an input from the time reached on: until frot_hold_inputs, which keeps the values that
 * the inputs have come to at the time reached then. */
void frot_set_input_rate(const frot_model *model, frot_state *state, int index, double rate);
void frot_hold_inputs(const frot_model *model, frot_state *state);
/* The rate at the time reached: also where inputs have been held there. */
double frot_get_input_rate(const frot_model *model, const frot_state *state, int index);
double frot_get_parameter(const frot_model *model, const frot_state *state, int index);
double frot_get_input(const frot_model *model, const frot_state *state, int index);

/* Evaluate the parameters: dependent values, checks, and experiment[4] = start stop tolerance
 * interval (NaN where the text is silent). */
int frot_settle_parameters(const frot_model *model, frot_state *state, frot_work *work,
                           double experiment[4]);

/* Solve the initial values at time t and the first modes. `options` NULL: defaults. */
int frot_start(const frot_model *model, frot_state *state, frot_work *work, double t,
               const frot_options *options);

/* Let values set since the last call take effect at the time reached. Does nothing if none differs.
 * FROT_CHECK and FROT_REFUSED: the old values stay, and the run can go on with them. */
int frot_settle(const frot_model *model, frot_state *state, frot_work *work);

/* Run until time t is inside the current segment: an instant that differs from t by rounding is t.
 * The recorder may be NULL. On FROT_FULL call again. */
int frot_advance(const frot_model *model, frot_state *state, frot_work *work, double t,
                 frot_recorder *recorder, frot_monitor monitor, void *context);

/* Values of all variables at the time reached by frot_start or frot_advance. */
int frot_values(const frot_model *model, frot_state *state, frot_work *work, double *values);

/* Values at any time inside a recorded segment (parameters and inputs are those of `state`, and are
 * to be what they were in the run). */
int frot_segment_values(const frot_model *model, frot_state *state, frot_work *work,
                        const double *segment, double t, double *values);
/* The same at many times in order, over recorded segments in order, which take `size` doubles
 * together; values: count rows. A time belongs to the last segment that begins at or before it, or
 * after it by rounding. */
int frot_sample(const frot_model *model, frot_state *state, frot_work *work, const double *segments,
                long long size, const double *times, long long count, double *values);

/* Residual kinetic + potential + dissipated - work in since the start, and the energy scale: the
 * largest of these that took part, and no less than the rounding of what they are made of.
 * balance[0..4] = residual, scale, kinetic + potential, dissipated, work. */
int frot_energy(const frot_model *model, frot_state *state, frot_work *work, double balance[5]);

/* An admissible motion of what acts on each other at an instant: contacts and laws of one `part` of
 * the model. a: accelerations (nw), reactions lam (n_rows), zero beside the part. Of elements:
 * acceleration of the motion, Painleve's coefficient of one that slips (NaN where there is none),
 * components of the directions of the slips. contact: 1 closed, 0 open; element: frot_friction;
 * -1 where it is not of the part, or open. since: the order of the time after the instant at which
 * the motion of a contact, then of an element, first differs from zero.
 * `decided`: 0 where inequalities are zero at all orders; `family`: reactions that are
 * not determined decide its accelerations, 2: those of equal springs; `hardly`: it begins by no
 * more than rounding; `same`: the motion before it that has the same accelerations and other
 * reactions, or -1. values: of all variables (n_variables), the other parts in their first motions.
 */
typedef struct {
  int part, order, decided, family, hardly, same;
  double *a, *lam, *acceleration, *painleve, *direction, *values;
  signed char *contact, *element, *since;
} frot_motion;

/* The motions of all parts; `complete`: none is left out; `proved`: which needs no starts;
 * `highest`: the highest order that is known; `nodes`: of the search; of each part whether anything
 * may open or slip there (contacts that may, n_contacts). */
typedef struct {
  int n_parts, count, complete, proved, highest, nodes;
  frot_motion *motions;
  signed char *contacts;
  const int *part_of_contact;
} frot_motions_found;

/* Bytes that frot_motions takes. */
size_t frot_motions_size(const frot_model *model);

/* Every admissible motion of the state at the time reached, or where frot_start or frot_advance
 * found none. `nodes`: of the search, at most. FROT_OK, or the status of the fault recorded. */
int frot_motions(const frot_model *model, frot_state *state, frot_work *work, void *memory,
                 int nodes, frot_motions_found *found);

/* What the law of an element resists: the liaison or item of the text, in how many components, and
 * which of them this element is; a frot_law_kind. */
enum frot_law_kind { FROT_SLIDING, FROT_ROLLING, FROT_TURNING, FROT_IN_A_PIN, FROT_OF_THE_TEXT };
int frot_law_of_element(const frot_model *model, int element, int *contact, int *part, int *parts);
int frot_element_count(const frot_model *model);

double frot_time(const frot_state *state);
/* The next instant at which time by itself changes something, INFINITY if there is none. */
double frot_next_instant(const frot_state *state);
const frot_fault *frot_last_fault(const frot_state *state);
const frot_statistics *frot_run_statistics(const frot_state *state);

/* The sentence that tells a fault, with names, values in SI and the remedy, ended by NUL. */
void frot_fault_text(const frot_model *model, const frot_state *state, char *text, size_t size);
/* The name of a state in the text; "" where that is not known. */
const char *frot_state_name(const frot_model *model, int state);
/* Places (file:line:column, one a line) of what the fault is about; empty if none is to blame. */
void frot_fault_places(const frot_model *model, const frot_state *state, char *text, size_t size);
/* The sentence that tells an event: "floor: slip -> stick at t = 1.86884131838260". */
void frot_event_text(const frot_model *model, const frot_event *event, char *text, size_t size);

/* Whether a block of `size` bytes is a state of this model (key, size, version). */
int frot_state_valid(const frot_model *model, const void *block, size_t size);

#ifdef __cplusplus
}
#endif
#endif
