/* Derivatives within the mode: in a direction of states, inputs, parameters and time, and of
 * outputs along the motion.
 *
 * Central differences of a copy of the state, whose modes are held, extrapolated to the step zero
 * (L. F. Richardson 1911; C. J. F. Ridders, Adv. Eng. Software 4, 1982, 75-76). Each unknown takes
 * the entry of its own table that differs least from those next to it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "instance.h"

/* The longest step, in parts of the sizes of what moves; each is half the one before. */
#define FIRST 0.015625
#define ROWS 16
/* How much worse than the best a row may be before the table is left, which has some rows then. */
#define WORSE 4.0
#define LEAST 5

/* A place of the motion, and the direction in which it is varied. */
typedef struct {
  frot_fmu *fmu;
  const char *function;
  const unsigned *unknowns;
  size_t count;
  double *x, *dx, *there; /* states */
  const unsigned *knowns;
  const double *seed;
  size_t n_knowns;
  double dt;
  int along;                   /* the direction is that of the motion */
  double *up, *down, *best;    /* of each unknown: values, derivative */
  double *error, *row, *above; /* and the tables' last two rows, ROWS each */
} probe;

static const frot_fmu_variable *variable_of(const frot_fmu *fmu, const char *function,
                                            unsigned reference, const char *what) {
  if (reference < frot_fmu_variable_count && frot_fmu_variables[reference].type == FROT_REAL)
    return &frot_fmu_variables[reference];
  frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: value reference %u is no real variable, and no %s.",
               function, reference, what);
  return NULL;
}

static int refuse(const frot_fmu *fmu, const char *function, const frot_fmu_variable *variable,
                  const char *what) {
  return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: '%s' is no %s.", function, variable->name, what);
}

static int check_unknowns(const frot_fmu *fmu, const char *function, const unsigned *references,
                          size_t count) {
  static const char *const what = "unknown that has derivatives: an output, a variable or a rate";
  for (size_t i = 0; i < count; i++) {
    const frot_fmu_variable *v = variable_of(fmu, function, references[i], what);
    if (v == NULL) return FROT_FMU_ERROR;
    if (v->role != FROT_FMU_VARIABLE && v->role != FROT_FMU_RATE)
      return refuse(fmu, function, v, what);
  }
  return FROT_FMU_OK;
}

static int check_knowns(const frot_fmu *fmu, const char *function, const unsigned *references,
                        const double *seed, size_t count) {
  static const char *const what = "known: a state, an input, a tunable parameter or the time";
  for (size_t i = 0; i < count; i++) {
    const frot_fmu_variable *v = variable_of(fmu, function, references[i], what);
    if (v == NULL) return FROT_FMU_ERROR;
    const int given = (v->role == FROT_FMU_PARAMETER && !v->fixed) || v->role == FROT_FMU_INPUT;
    if (!given && v->role != FROT_FMU_STATE && v->role != FROT_FMU_TIME)
      return refuse(fmu, function, v, what);
    if (!isfinite(seed[i]))
      return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: the seed of '%s' is not a finite number.",
                          function, v->name);
  }
  return FROT_FMU_OK;
}

/* The value of a known of the copy moves by `by`. */
static void move_known(const frot_fmu *fmu, unsigned reference, double by) {
  const frot_model *model = fmu->model;
  const int index = (int)reference - 1, role = frot_fmu_variables[reference].role;
  if (role == FROT_FMU_PARAMETER)
    frot_set_parameter(model, fmu->probe, index, frot_get_parameter(model, fmu->probe, index) + by);
  if (role == FROT_FMU_INPUT)
    frot_set_input(model, fmu->probe, index - model->np,
                   frot_get_input(model, fmu->probe, index - model->np) + by);
}

/* The unknowns a part `by` of the direction away. 0 where there is no motion. */
static int look(const probe *p, double by, double *values) {
  frot_fmu *fmu = p->fmu;
  const frot_model *model = fmu->model;
  const int states = frot_exchange_states(model);
  const int first = 1 + model->np + model->nu, rates = first + model->n_variables + states;
  memcpy(fmu->probe, fmu->state, fmu->state_size);
  frot_hold_inputs(model, fmu->probe);
  for (size_t k = 0; k < p->n_knowns; k++) move_known(fmu, p->knowns[k], by * p->seed[k]);
  for (int i = 0; i < model->nu && p->along; i++)
    frot_set_input(
        model, fmu->probe, i,
        frot_get_input(model, fmu->state, i) + by * frot_get_input_rate(model, fmu->state, i));
  for (int i = 0; i < states; i++) p->there[i] = p->x[i] + by * p->dx[i];
  frot_exchange_place(model, fmu->probe, fmu->work, fmu->life.t + by * p->dt, p->there);
  if (frot_exchange_inputs(model, fmu->probe, fmu->work) != FROT_OK) return 0;
  int reads = 0, moves = 0;
  for (size_t i = 0; i < p->count; i++) {
    const int is_rate = frot_fmu_variables[p->unknowns[i]].role == FROT_FMU_RATE;
    moves |= is_rate, reads |= !is_rate;
  }
  if (reads && frot_values(model, fmu->probe, fmu->work, fmu->values) != FROT_OK) return 0;
  if (moves &&
      frot_exchange_rates(model, fmu->probe, fmu->work, fmu->rates, fmu->guards) != FROT_OK)
    return 0;
  int finite = 1;
  for (size_t i = 0; i < p->count; i++) {
    const int at = (int)p->unknowns[i];
    values[i] = frot_fmu_variables[at].role == FROT_FMU_RATE ? fmu->rates[at - rates]
                                                             : fmu->values[at - first];
    finite &= isfinite(values[i]) != 0;
  }
  return finite;
}

/* The part of the direction that moves what it moves by their sizes, 0 where it moves nothing. */
static double size_of_direction(const probe *p, const double *sizes) {
  const frot_model *model = p->fmu->model;
  const int states = frot_exchange_states(model);
  double most = fabs(p->dt) / fmax(1.0, fabs(p->fmu->life.t));
  for (int i = 0; i < states; i++) most = fmax(most, fabs(p->dx[i]) / sizes[i]);
  for (size_t k = 0; k < p->n_knowns; k++) {
    const int index = (int)p->knowns[k] - 1, role = frot_fmu_variables[p->knowns[k]].role;
    double now = 0.0;
    if (role == FROT_FMU_PARAMETER) now = frot_get_parameter(model, p->fmu->state, index);
    if (role == FROT_FMU_INPUT) now = frot_get_input(model, p->fmu->state, index - model->np);
    /* a parameter is not moved through zero, an input may be */
    const double least = role == FROT_FMU_PARAMETER && now != 0.0 ? 0.0 : 1.0;
    if (role == FROT_FMU_PARAMETER || role == FROT_FMU_INPUT)
      most = fmax(most, fabs(p->seed[k]) / fmax(fabs(now), least));
  }
  return most;
}

/* A new row of the table of unknown i, whose first entry is `value`; `n` rows are there. Returns
 * whether the row is not far worse than the best. */
static int extend(const probe *p, size_t i, int n, double value) {
  double *row = p->row + ROWS * i, *above = p->above + ROWS * i, factor = 1.0;
  memcpy(above, row, sizeof(double) * ROWS);
  row[0] = value;
  for (int k = 1; k <= n; k++) {
    factor *= 4.0;
    row[k] = row[k - 1] + (row[k - 1] - above[k - 1]) / (factor - 1.0);
    const double error = fmax(fabs(row[k] - row[k - 1]), fabs(row[k] - above[k - 1]));
    if (error < p->error[i]) p->error[i] = error, p->best[i] = row[k];
  }
  return n < LEAST || fabs(row[n] - above[n - 1]) < WORSE * p->error[i];
}

static int differentiate(const probe *p, const double *sizes) {
  const double size = size_of_direction(p, sizes);
  for (size_t i = 0; i < p->count; i++) p->error[i] = INFINITY, p->best[i] = 0.0;
  if (size == 0.0) return FROT_FMU_OK;
  int n = 0, found = 0, goes_on = 1;
  double step = FIRST / size;
  for (int k = 0; k < 2 * ROWS && n < ROWS && goes_on; k++, step *= 0.5) {
    if (!look(p, step, p->up) || !look(p, -step, p->down)) {
      n = 0; /* too far: a smaller change is evaluated */
      continue;
    }
    goes_on = 0;
    for (size_t i = 0; i < p->count; i++)
      goes_on |= extend(p, i, n, (p->up[i] - p->down[i]) / (2.0 * step));
    n++, found |= n > 1;
  }
  if (found) return FROT_FMU_OK;
  return frot_fmu_say(p->fmu, FROT_FMU_DISCARD,
                      "%s: there is no motion in this mode next to the states at t = %.15g s.",
                      p->function, p->fmu->life.t);
}

/* Memory of the copy and of `count` tables. */
static int make_room(frot_fmu *fmu, const char *function, size_t count) {
  const size_t states = (size_t)frot_exchange_states(fmu->model);
  if (fmu->probe == NULL) fmu->probe = frot_fmu_memory(fmu->state_size);
  if (fmu->probe_room < count || fmu->probe_numbers == NULL) {
    free(fmu->probe_numbers);
    fmu->probe_numbers = frot_fmu_memory((4 * states + (4 + 2 * ROWS) * count) * sizeof(double));
    fmu->probe_room = fmu->probe_numbers == NULL ? 0 : count;
  }
  if (fmu->probe != NULL && fmu->probe_numbers != NULL) return FROT_FMU_OK;
  return frot_fmu_refuse(fmu, function, "there is not enough memory");
}

/* Bring the instance to the place where its motion is evaluated. */
static int prepare(frot_fmu *fmu, const char *function, size_t count) {
  const int phase = fmu->life.phase;
  if (phase != FROT_FMU_STEPPING && phase != FROT_FMU_EVENT && phase != FROT_FMU_CONTINUOUS)
    return frot_fmu_misplaced(fmu, function);
  const int status = frot_fmu_ready(fmu, function, FROT_FMU_VARIABLE);
  return status == FROT_FMU_OK ? make_room(fmu, function, count) : status;
}

/* A probe at the states of the instance, whose directions are zero. */
static probe begin(frot_fmu *fmu, const char *function, const unsigned *unknowns, size_t count,
                   double *derivatives, double **sizes) {
  const size_t states = (size_t)frot_exchange_states(fmu->model);
  double *at = fmu->probe_numbers;
  probe p = {fmu, function, unknowns, count, NULL, NULL,        NULL, NULL, NULL,
             0,   0.0,      0,        NULL,  NULL, derivatives, NULL, NULL, NULL};
  p.x = at, at += states;
  p.dx = at, at += states;
  p.there = at, at += states;
  *sizes = at, at += states;
  p.up = at, at += count;
  p.down = at, at += count;
  p.error = at, at += count;
  p.row = at, at += ROWS * count;
  p.above = at;
  memcpy(fmu->probe, fmu->state, fmu->state_size);
  frot_hold_inputs(fmu->model, fmu->probe);
  frot_exchange_read(fmu->model, fmu->probe, p.x);
  frot_exchange_sizes(fmu->model, fmu->state, *sizes);
  memset(p.dx, 0, states * sizeof(double));
  return p;
}

/* Values and rates are those of the last place evaluated. */
static int end(frot_fmu *fmu, int status) {
  fmu->values_valid = fmu->motion_valid = 0;
  return status;
}

int frot_fmu_derive(frot_fmu *fmu, const char *function, const unsigned *unknowns,
                    size_t n_unknowns, const unsigned *knowns, size_t n_knowns, const double *seed,
                    double *sensitivity) {
  int status = frot_fmu_arrays(fmu, function, unknowns, sensitivity, n_unknowns);
  if (status == FROT_FMU_OK) status = frot_fmu_arrays(fmu, function, knowns, seed, n_knowns);
  if (status == FROT_FMU_OK) status = check_unknowns(fmu, function, unknowns, n_unknowns);
  if (status == FROT_FMU_OK) status = check_knowns(fmu, function, knowns, seed, n_knowns);
  if (status == FROT_FMU_OK) status = prepare(fmu, function, n_unknowns);
  if (status != FROT_FMU_OK) return status;
  const frot_model *model = fmu->model;
  const unsigned first = 1u + (unsigned)(model->np + model->nu + model->n_variables);
  double *sizes;
  probe p = begin(fmu, function, unknowns, n_unknowns, sensitivity, &sizes);
  p.knowns = knowns, p.seed = seed, p.n_knowns = n_knowns;
  for (size_t k = 0; k < n_knowns; k++) {
    if (frot_fmu_variables[knowns[k]].role == FROT_FMU_STATE) p.dx[knowns[k] - first] += seed[k];
    if (frot_fmu_variables[knowns[k]].role == FROT_FMU_TIME) p.dt += seed[k];
  }
  return end(fmu, differentiate(&p, sizes));
}

int frot_fmu_derive_outputs(frot_fmu *fmu, const char *function, const unsigned *references,
                            size_t count, const int *orders, double *values) {
  int status = frot_fmu_arrays(fmu, function, references, values, count);
  if (status == FROT_FMU_OK && count > 0 && orders == NULL)
    status = frot_fmu_refuse(fmu, function, "the orders are NULL");
  if (status == FROT_FMU_OK && fmu->exchanges)
    status = frot_fmu_refuse(fmu, function, "the instance was made for model exchange");
  for (size_t i = 0; i < count && status == FROT_FMU_OK; i++)
    if (orders[i] != 1)
      status = frot_fmu_say(fmu, FROT_FMU_ERROR,
                            "%s: the derivative of order %d is asked for, there is the first only.",
                            function, orders[i]);
  if (status == FROT_FMU_OK) status = check_unknowns(fmu, function, references, count);
  if (status == FROT_FMU_OK) status = prepare(fmu, function, count);
  if (status != FROT_FMU_OK) return status;
  double *sizes;
  probe p = begin(fmu, function, references, count, values, &sizes);
  p.dt = 1.0, p.along = 1;
  frot_exchange_place(fmu->model, fmu->probe, fmu->work, fmu->life.t, p.x);
  if (frot_exchange_rates(fmu->model, fmu->probe, fmu->work, p.dx, fmu->guards) != FROT_OK)
    return end(fmu, frot_fmu_refuse(fmu, function, "there is no motion at the time reached"));
  return end(fmu, differentiate(&p, sizes));
}
