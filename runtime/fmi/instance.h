/* An instance of an FMU: what the FMI 2.0 and FMI 3.0 faces of a model share.
 *
 * The faces (fmi2*.c, fmi3*.c) translate types and calls; instance.c makes and frees instances and
 * writes the log, lifecycle.c is the state machine, stepping.c runs the kernel, access.c reads and
 * sets values, snapshot.c saves and restores. Nothing is global: instances live side by side.
 */
#ifndef FROT_FMU_INSTANCE_H
#define FROT_FMU_INSTANCE_H

#include <time.h>

#include "frot.h"
#include "model_exchange.h"

/* The numbers fmi2Status and fmi3Status have in common. */
enum frot_fmu_status {
  FROT_FMU_OK = 0,
  FROT_FMU_WARNING = 1,
  FROT_FMU_DISCARD = 2, /* the motion is right up to the last successful time, and stops there */
  FROT_FMU_ERROR = 3
};

enum frot_fmu_phase {
  FROT_FMU_INSTANTIATED = 0,
  FROT_FMU_INITIALIZATION = 1,
  FROT_FMU_STEPPING = 2,
  FROT_FMU_DISCARDED = 3, /* a step ended early: values are those of the last successful time */
  FROT_FMU_FAILED = 4,
  FROT_FMU_TERMINATED = 5,
  FROT_FMU_ENDED = 6,      /* the text has ended the run: values are those of its last instant */
  FROT_FMU_EVENT = 7,      /* in event mode */
  FROT_FMU_CONTINUOUS = 8, /* in continuous-time mode: the environment steps the motion */
  FROT_FMU_ASKED = 9,      /* in a step, while the environment gives inputs at its next point */
  FROT_FMU_SHOWN = 10,     /* and while it reads what has come of them */
  FROT_FMU_PAUSED = 11     /* and while it may end the step */
};

enum frot_fmu_role {
  FROT_FMU_TIME = 0,
  FROT_FMU_PARAMETER = 1,
  FROT_FMU_DEPENDENT = 2, /* a parameter that follows from others */
  FROT_FMU_INPUT = 3,
  FROT_FMU_VARIABLE = 4,
  FROT_FMU_STATE = 5, /* of model exchange, as what follows */
  FROT_FMU_RATE = 6,
  FROT_FMU_GUARD = 7
};

/* Bits of the log's categories; those the description lists. */
enum frot_fmu_category {
  FROT_FMU_LOG_EVENTS = 1,
  FROT_FMU_LOG_DISCARD = 2,
  FROT_FMU_LOG_ERROR = 4,
  FROT_FMU_LOG_ALL = 7
};

/* What lies behind a value reference: the reference is the index in the table, which is time, the
 * parameters, the inputs, the variables and, for model exchange, the states, their rates and the
 * guards, each in the kernel's order. */
typedef struct {
  const char *name;
  int type;     /* frot_type */
  int role;     /* frot_fmu_role */
  int fixed;    /* 1: it acts at the start alone */
  int literals; /* of an enumeration of the text, which are counted from 1, else 0 */
  int size;     /* elements of an array, which begin here; 0 of those that follow, else 1 */
} frot_fmu_variable;

/* Written by the exporter (fmu_table.c) beside the model. */
extern const frot_fmu_variable frot_fmu_variables[];
extern const unsigned frot_fmu_variable_count;

/* What an output or a rate depends on, by value references of elements, in the order of the first;
 * FROT_FMU_ANY where it may be anything. Of archives with arrays alone. */
typedef struct {
  unsigned dependent, independent;
} frot_fmu_dependency;
#define FROT_FMU_ANY 0xffffffffu
extern const frot_fmu_dependency frot_fmu_dependencies[];
extern const unsigned frot_fmu_dependency_count;
extern const int frot_fmu_lists_dependencies; /* 1: they are listed */
extern const int frot_fmu_exchange;           /* 1: model exchange is offered */
extern const int frot_fmu_on_indeterminate;   /* frot_indeterminate */
extern const int frot_fmu_on_impasse;         /* frot_impasse */
extern const long long frot_fmu_most_work;    /* evaluations of the model in one step */

/* Sets of types an FMI function accesses. */
#define FROT_FMU_TYPE(type) (1 << (type))

typedef struct frot_fmu frot_fmu;
typedef struct frot_fmu_snapshot frot_fmu_snapshot;

/* Calls of the environment in a step, at its points in between. */
enum frot_fmu_call {
  FROT_FMU_GIVE = 0, /* it gives the inputs at a time ahead */
  FROT_FMU_SHOW = 1, /* it reads values at this time */
  FROT_FMU_PAUSE = 2 /* it may end the step: no values are there */
};
/* The answer: whether the step is to end early. */
typedef int (*frot_fmu_caller)(const frot_fmu *fmu, int call, double t);

/* Whether values were set between steps and have not taken effect, so that they may be refused. */
enum frot_fmu_unsettled {
  FROT_FMU_SETTLED = 0,
  FROT_FMU_REVOCABLE = 1, /* `accepted` is the state before them */
  FROT_FMU_RESTORED = 2   /* they came with a saved state, which has no such copy */
};

/* Hands a message to the environment. `fmu` carries the name and the environment's pointer. */
typedef void (*frot_fmu_sink)(const frot_fmu *fmu, int status, const char *category,
                              const char *message);

/* What a saved state holds besides the kernel's block. */
typedef struct {
  int phase;
  int has_tolerance, has_stop;
  int started; /* in initialization mode: the start is solved with the values held */
  int status;  /* of the step that ended early */
  int refused; /* what was set is refused, and the former values hold: others may be set in the
                  phase of this number */
  int moved;   /* of model exchange: time or states were set since the last event */
  double tolerance, start, stop;
  double t; /* last successful time */
} frot_fmu_life;

/* What one step may take (limits.c). */
typedef struct {
  double evaluations; /* of the model */
  double seconds;     /* 0: any time */
} frot_fmu_limits;

enum frot_fmu_spending {
  FROT_FMU_LEFT = 0,
  FROT_FMU_EVALUATIONS = 1,
  FROT_FMU_PACE = 2, /* the end of the step is beyond reach */
  FROT_FMU_SECONDS = 3,
  FROT_FMU_CANCELLED = 4 /* the environment ends the step */
};

/* A step at work: evaluations before it, its times, when it was begun, what was spent. It may be
 * tried until an event only. */
typedef struct {
  frot_fmu *fmu;
  double before, begin, end;
  time_t started;
  int until_event;
  int spent; /* frot_fmu_spending */
} frot_fmu_budget;

struct frot_fmu {
  const frot_model *model;
  const char *name;
  void *name_memory;
  void *environment;
  frot_fmu_sink sink;
  unsigned categories;
  int values_valid;
  int unsettled; /* frot_fmu_unsettled */
  size_t state_size;
  frot_state *state;
  frot_state *accepted; /* the state before what was set between steps */
  frot_work *work;
  double *values; /* n_variables, at life.t where values_valid */
  int exchanges;  /* made for model exchange */
  int motion_valid;
  double *states, *rates, *guards; /* at life.t where motion_valid */
  frot_recorder recorder;
  frot_fmu_limits limits;
  int watches_events; /* steps tell of events, and the environment handles them */
  int returns_early;  /* and end at the first */
  int seen;           /* the last step had events */
  double first_event; /* its first one, or the next instant of time: INFINITY where there is none */
  frot_state *before; /* the state at its beginning, where events are watched */
  int event;          /* the last step ended at an event, or beyond one */
  frot_fmu_life life;
  frot_fmu_snapshot *snapshots;
  frot_state *probe; /* derivatives.c: a copy of the state, and its numbers; NULL before */
  double *probe_numbers;
  size_t probe_room;
  frot_fmu_caller caller;    /* in steps; NULL: nobody is called */
  unsigned char *in_between; /* the variables that may be given and read there, or NULL */
  double *asked;             /* n_inputs: those given for the next point */
  int returned;              /* the environment has ended the step early */
  unsigned *elements[2];     /* fmi3_elements.c: two lists, and their sizes */
  size_t elements_room[2];
};

#if defined __GNUC__
#define FROT_FMU_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define FROT_FMU_PRINTF(text, first)
#endif

/* instance.c */

/* A new instance of `size` bytes that begins as `draft` (sink, environment). NULL with a logged
 * sentence if the name, the token or the memory does not do. */
frot_fmu *frot_fmu_open(const frot_fmu *draft, size_t size, const char *function, const char *name,
                        const char *token, int logging);
void frot_fmu_close(frot_fmu *fmu);
void *frot_fmu_memory(size_t size); /* zeroed, or NULL; given back by `free` */
int frot_fmu_set_logging(frot_fmu *fmu, const char *function, int on, size_t count,
                         const char *const *names);
/* Log a sentence under the category of the status; the answer is the status. */
int frot_fmu_say(const frot_fmu *fmu, int status, const char *format, ...) FROT_FMU_PRINTF(3, 4);
void frot_fmu_say_event(const frot_fmu *fmu, const char *message);
/* The refusal of a function of an ability the description does not declare. */
int frot_fmu_refuse(const frot_fmu *fmu, const char *function, const char *reason);

/* lifecycle.c: every call answers a frot_fmu_status. */
int frot_fmu_misplaced(const frot_fmu *fmu, const char *function);
/* Whether the environment is called in a step, where most functions are misplaced. */
int frot_fmu_is_called(const frot_fmu *fmu);
int frot_fmu_setup(frot_fmu *fmu, const char *function, int has_tolerance, double tolerance,
                   double start, int has_stop, double stop);
int frot_fmu_enter_initialization(frot_fmu *fmu, const char *function);
int frot_fmu_exit_initialization(frot_fmu *fmu, const char *function);
int frot_fmu_terminate(frot_fmu *fmu, const char *function);
void frot_fmu_reset(frot_fmu *fmu);
int frot_fmu_begin_anew(frot_fmu *fmu, const char *function); /* the same, called from outside */
/* Bring the kernel to the instant that values are read at. */
int frot_fmu_ready(frot_fmu *fmu, const char *function, int role);

/* stepping.c: every call but frot_fmu_note_change answers a frot_fmu_status. */
int frot_fmu_step(frot_fmu *fmu, const char *function, double point, double step);
/* Before the first value that is set between two steps: so that it can be refused. */
void frot_fmu_note_change(frot_fmu *fmu);
/* Let what was set take effect at the time reached; where it cannot, the former values hold. */
int frot_fmu_settle(frot_fmu *fmu, const char *function);
/* Log the events of a recorder whose context is the FMU, and empty it. */
void frot_fmu_take_events(frot_recorder *recorder, void *context);
/* Log the kernel's fault; the answer is the status. */
int frot_fmu_say_fault(const frot_fmu *fmu, int status, const char *function);

/* events.c */

/* Of an instance whose environment handles events; 0 where memory is short. */
int frot_fmu_watch_events(frot_fmu *fmu, int returns_early);
void frot_fmu_begin_watch(frot_fmu *fmu);
int frot_fmu_has_event(const frot_fmu *fmu); /* the recorder does, beyond the step's beginning */
void frot_fmu_see_event(frot_fmu *fmu, const frot_event *event);
void frot_fmu_go_back(frot_fmu *fmu); /* to the beginning of the step */
int frot_fmu_enter_event_mode(frot_fmu *fmu, const char *function);
int frot_fmu_update_discrete(frot_fmu *fmu, const char *function);
int frot_fmu_enter_step_mode(frot_fmu *fmu, const char *function);

/* exchange.c: every call but the first two answers a frot_fmu_status. */
int frot_fmu_make_exchange(frot_fmu *fmu); /* memory; 0 where that is short */
int frot_fmu_refuse_exchange(const frot_fmu *fmu, const char *function);
/* States, rates and guards at the time reached. */
int frot_fmu_find_motion(frot_fmu *fmu, const char *function);
int frot_fmu_set_time(frot_fmu *fmu, const char *function, double t);
int frot_fmu_set_states(frot_fmu *fmu, const char *function, const double *x, size_t count);
/* `what`: the role of the values. */
int frot_fmu_get_motion(frot_fmu *fmu, const char *function, int what, double *values,
                        size_t count);
int frot_fmu_get_nominals(frot_fmu *fmu, const char *function, double *values, size_t count);
/* *event: the states are to be put onto the relations, in event mode. */
int frot_fmu_complete_step(frot_fmu *fmu, const char *function, int *event);
int frot_fmu_take_inputs(frot_fmu *fmu, const char *function);
int frot_fmu_enter_exchange_event(frot_fmu *fmu, const char *function);
/* *moved: the states are others. */
int frot_fmu_exchange_update(frot_fmu *fmu, const char *function, int *moved);
int frot_fmu_enter_continuous(frot_fmu *fmu, const char *function);

/* derivatives.c: every call answers a frot_fmu_status. */

/* The change of the unknowns in a direction of the knowns, in the mode as it is. */
int frot_fmu_derive(frot_fmu *fmu, const char *function, const unsigned *unknowns,
                    size_t n_unknowns, const unsigned *knowns, size_t n_knowns, const double *seed,
                    double *sensitivity);
/* Rates of variables along the motion, at the time reached. */
int frot_fmu_derive_outputs(frot_fmu *fmu, const char *function, const unsigned *references,
                            size_t count, const int *orders, double *values);

/* adjoint.c: the change of the sum of the unknowns, each times its seed, with each known. */
int frot_fmu_derive_adjoint(frot_fmu *fmu, const char *function, const unsigned *unknowns,
                            size_t n_unknowns, const unsigned *knowns, size_t n_knowns,
                            const double *seed, double *sensitivity);

/* inputs.c */

/* First derivatives of inputs from the time reached on, in the next step. */
int frot_fmu_set_input_rates(frot_fmu *fmu, const char *function, const unsigned *references,
                             size_t count, const int *orders, const double *values);
/* `caller` is called in steps at points in between, where the environment gives and reads the
 * variables named. */
int frot_fmu_call_in_between(frot_fmu *fmu, const char *function, frot_fmu_caller caller,
                             const unsigned *references, size_t count);
void frot_fmu_give(frot_fmu *fmu, unsigned reference, double value);
/* The points of a step: how many there are; the environment gives the
 * inputs at one ahead; whether the step ends at it. */
int frot_fmu_points(const frot_fmu *fmu);
void frot_fmu_ask_inputs(frot_fmu *fmu, double t);
int frot_fmu_ends_at(frot_fmu *fmu, double t);

/* limits.c */

/* From the environment of the process, else the model's own. */
int frot_fmu_read_limits(const frot_fmu *fmu, const char *function, frot_fmu_limits *limits);
frot_fmu_budget frot_fmu_begin_budget(frot_fmu *fmu, double t);
int frot_fmu_spent(void *budget, double t); /* the kernel's monitor */
/* Log what was spent, once life.t is the time reached; the answer is the status. */
int frot_fmu_say_spent(const frot_fmu *fmu, const char *function, const frot_fmu_budget *budget);

/* access.c */
int frot_fmu_arrays(const frot_fmu *fmu, const char *function, const unsigned *references,
                    const void *values, size_t count);
int frot_fmu_get(frot_fmu *fmu, const char *function, unsigned reference, int types, double *value);
/* Whether a value may be set, with a logged sentence if not. */
int frot_fmu_settable(const frot_fmu *fmu, const char *function, unsigned reference, int types,
                      double value);
void frot_fmu_set(frot_fmu *fmu, unsigned reference, double value);

/* snapshot.c: `handle` is the environment's fmi2FMUstate or fmi3FMUState. */
int frot_fmu_save(frot_fmu *fmu, const char *function, void **handle);
int frot_fmu_restore(frot_fmu *fmu, const char *function, void *handle);
int frot_fmu_drop(frot_fmu *fmu, const char *function, void **handle);
int frot_fmu_serialized_size(frot_fmu *fmu, const char *function, void *handle, size_t *size);
int frot_fmu_serialize(frot_fmu *fmu, const char *function, void *handle, void *bytes, size_t size);
int frot_fmu_deserialize(frot_fmu *fmu, const char *function, const void *bytes, size_t size,
                         void **handle);
void frot_fmu_drop_all(frot_fmu *fmu);

#endif
