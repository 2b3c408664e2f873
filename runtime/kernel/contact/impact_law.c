#include "contact/impact_law.h"

#include <math.h>
#include <string.h>

#include "contact/impact_parts.h"
#include "numerics/dense.h"

#define MOST_PHASES 2000
/* Phases that slips alone have ended after which they are taken for stiff. */
#define MOST_EXPLICIT 200
/* Part of the energy of its scale below which a contact has stored nothing. */
#define LEAST_STORED 1e-24
/* Part of the speeds of the whole below which contacts that are pressed are at rest. */
#define SPENT 1e-9
/* Part of its rate by which a slip may turn and yet be said to go straight. */
#define STRAIGHT 1e-14
/* Part of its terms by which a speed is not zero where that of what depends on it is. */
#define REST 1e-10
/* Part of its size below which a slip that has ended is taken away. */
#define SMALL 1e-8
/* Part of W_nn by which Painleve's coefficient is below zero where a contact jams; and up to which
 * it counts as zero, where the turn of the slip decides. */
#define JAMS 1e-9
#define ALMOST_JAMS 1e-4
/* The same where steps have ended because reactions grow without bound. */
#define ENDED 1e-8
/* Part of its size by which a slip is followed to see where it turns. */
#define TURN 1e-2
/* Speed with which a contact begins to be pressed by its own friction, where springs follow it:
 * part of its size. */
#define BEGINNING 1e-10

static int parts_in_doubles(int blocks) {
  return (int)((sizeof(frot_impact_part) * (size_t)blocks + sizeof(double) - 1) / sizeof(double));
}
static int blocks_in_doubles(int blocks) {
  return (int)((sizeof(frot_contact_block) * (size_t)blocks + sizeof(double) - 1) / sizeof(double));
}

int frot_impact_doubles(int rows, int blocks) {
  return 5 * rows + rows * rows + 2 * blocks + frot_spring_doubles(rows, blocks) +
         frot_contact_newton_doubles(rows) + parts_in_doubles(blocks) + blocks_in_doubles(blocks);
}
int frot_impact_integers(int rows) { return frot_contact_newton_integers(rows); }

int frot_gives_back(const frot_impact *f, int k) {
  const frot_impact_block *block = &f->given->blocks[k];
  return !f->spent && block->restitution > 0 &&
         (block->law != FROT_NEWTON || f->parts[k].approach > 0);
}

void frot_begin_compression(frot_impact *f, int k) {
  const frot_impact_block *block = &f->given->blocks[k];
  frot_impact_part *part = &f->parts[k];
  double e = block->restitution;
  f->phases++, f->turns++;
  if (part->state == FROT_PART_UNLOADING && block->law == FROT_POISSON)
    part->compressed -= e > 0 ? (f->p[block->at] - part->mark) / e : 0;
  else if (part->state != FROT_PART_UNLOADING)
    part->stored = part->compressed = 0;
  if (!frot_gives_back(f, k) && part->state == FROT_PART_OPEN) {
    part->state = FROT_PART_RIGID, f->u[block->at] = 0;
    return;
  }
  part->state = FROT_PART_LOADING, part->mark = f->p[block->at];
}

void frot_end_compression(frot_impact *f, int k) {
  const frot_impact_block *block = &f->given->blocks[k];
  frot_impact_part *part = &f->parts[k];
  int may_give = frot_gives_back(f, k), gives = may_give;
  double least = LEAST_STORED * f->scale[block->at] * f->scale[block->at];
  f->phases++, f->turns++;
  f->u[block->at] = 0;
  if (!(part->stored * f->given->w[block->at * (f->given->rows + 1)] > least)) gives = 0;
  part->compressed += f->p[block->at] - part->mark;
  part->mark = f->p[block->at], part->peak = sqrt(2 * f->stiffness * part->stored);
  part->state = gives ? FROT_PART_UNLOADING : may_give ? FROT_PART_OPEN : FROT_PART_RIGID;
  if (!gives) part->stored = 0;
}

void frot_end_restitution(frot_impact *f, int k) {
  f->phases++, f->turns++;
  f->parts[k].state = FROT_PART_OPEN, f->parts[k].stored = 0;
}

/* Whether the rows of a block have no speed, or next to none: those of a contact that is closed, of
 * an element that sticks, of a relation. */
static int has_no_speed(const frot_impact *f, int k) {
  const frot_impact_block *block = &f->given->blocks[k];
  if (block->rule == FROT_ROW_BALL)
    return f->parts[k].state == FROT_PART_STICKS && frot_can_rub(f, k) &&
           frot_impact_slip(block, f->u, NULL) <= SMALL * frot_impact_scale(f, block);
  return f->parts[k].state == FROT_PART_RIGID || block->rule == FROT_ROW_HELD;
}

void frot_bring_to_rest(frot_impact *f, int first) {
  const frot_impact_problem *p = f->given;
  for (int k = 0; k < p->n_blocks; k++) {
    const frot_impact_block *one = &p->blocks[k];
    int reads = one->rule == FROT_ROW_READS;
    f->now[k] = (frot_contact_block){.rule = reads ? FROT_ROW_READS
                                             : has_no_speed(f, k) || (first && one->is_zero)
                                                 ? FROT_ROW_HELD
                                                 : FROT_ROW_ABSENT,
                                     .at = one->at,
                                     .n = one->n};
    for (int i = one->at; i < one->at + one->n; i++) f->b[i] = reads ? 0 : f->u[i];
  }
  memset(f->x, 0, sizeof(double) * (size_t)p->rows);
  frot_contact_equations equations = {p->rows, p->n_blocks, p->w, f->b, f->now, REST, NULL};
  int failed = frot_contact_newton(&equations, 0, f->x, f->a, f->newton, f->pivot);
  for (int k = 0; k < p->n_blocks; k++) {
    const frot_impact_block *one = &p->blocks[k];
    for (int i = one->at; i < one->at + one->n; i++) {
      if (!failed) f->p[i] += f->x[i];
      if (!failed && one->rule != FROT_ROW_READS) f->u[i] = f->a[i];
      if (f->now[k].rule == FROT_ROW_HELD) f->u[i] = 0;
    }
  }
}

void frot_put_at_rest(frot_impact *f, int k) {
  f->phases++;
  f->parts[k].state = FROT_PART_STICKS;
  if (frot_sticks(f, k))
    frot_bring_to_rest(f, 0);
  else /* it has passed through zero */
    f->parts[k].state = FROT_PART_SLIPS;
}

/* How fast rows move that have the energy of the whole: speeds are measured by that. */
static void measure(frot_impact *f) {
  const frot_impact_problem *p = f->given;
  double most = 0;
  for (int i = 0; i < p->rows; i++) {
    double own = p->w[i * p->rows + i];
    if (own > 0) most = fmax(most, fabs(f->u[i]) / sqrt(own));
  }
  for (int i = 0; i < p->rows; i++) f->scale[i] = most * sqrt(fmax(p->w[i * p->rows + i], 0));
}

/* The matrix of contacts that give a little, by which redundant impulses are shared. */
static void soften(frot_impact *f, double give) {
  const frot_impact_problem *p = f->given;
  memcpy(f->soft, p->w, sizeof(double) * (size_t)(p->rows * p->rows));
  for (int k = 0; k < p->n_blocks; k++)
    for (int i = p->blocks[k].at; i < p->blocks[k].at + p->blocks[k].n; i++)
      if (p->blocks[k].rule == FROT_ROW_PRESSES || p->blocks[k].rule == FROT_ROW_BALL)
        f->soft[i * (p->rows + 1)] += give;
}

static void begin(frot_impact *f, int driver) {
  const frot_impact_problem *p = f->given;
  measure(f);
  memset(f->p, 0, sizeof(double) * (size_t)p->rows);
  memset(f->parts, 0, sizeof *f->parts * (size_t)p->n_blocks);
  double most = 0;
  for (int k = 0; k < p->n_blocks; k++) {
    const frot_impact_block *block = &p->blocks[k];
    frot_impact_part *part = &f->parts[k];
    double u = block->is_zero ? 0 : f->u[block->at];
    f->force[k] = f->lost[k] = 0;
    if (block->rule == FROT_ROW_BALL) {
      part->state = block->is_zero ? FROT_PART_STICKS : FROT_PART_SLIPS;
    }
    if (block->rule != FROT_ROW_PRESSES) continue;
    part->approach = fmax(-u, 0);
    /* springs at rest are there: others may press them */
    part->state = u > 0                                           ? FROT_PART_OPEN
                  : u < 0 || k == driver || frot_gives_back(f, k) ? FROT_PART_LOADING
                                                                  : FROT_PART_RIGID;
    most = fmax(most, p->w[block->at * p->rows + block->at]);
  }
  f->stiffness = 1 / most;
  soften(f, FROT_GIVE * most); /* the largest W of a normal */
  frot_bring_to_rest(f, 1);
  f->phases = 0;
}

/* The contact that is pressed if there is one, -1 if there are several. */
static int only_driver(const frot_impact *f, int *count) {
  int driver = -1;
  *count = 0;
  for (int k = 0; k < f->given->n_blocks; k++)
    if (frot_is_driven(&f->parts[k])) driver = k, ++*count;
  return *count == 1 ? driver : -1;
}

/* The forces of springs; none is known where no contact has been compressed yet: then they grow as
 * the speeds of approach say. */
static void set_forces(frot_impact *f, int driver) {
  const frot_impact_problem *p = f->given;
  double sum = 0;
  for (int k = 0; k < p->n_blocks; k++) {
    f->force[k] = frot_is_driven(&f->parts[k]) ? sqrt(2 * f->stiffness * f->parts[k].stored) : 0;
    if (k == driver) f->force[k] = 1;
    sum += f->force[k];
  }
  for (int k = 0; k < p->n_blocks && sum == 0; k++)
    if (frot_is_driven(&f->parts[k])) f->force[k] = fmax(-f->u[p->blocks[k].at], 0);
}

/* Whether all rates are constant while the modes last: no slip turns. */
static int goes_straight(const frot_impact *f) {
  for (int k = 0; k < f->given->n_blocks; k++) {
    const frot_impact_block *block = &f->given->blocks[k];
    double d[3], along = 0, across = 0;
    if (block->rule != FROT_ROW_BALL || f->parts[k].state != FROT_PART_SLIPS || block->n == 1)
      continue;
    if (!(frot_impact_slip(block, f->u, d) > 0)) memcpy(d, f->parts[k].d, sizeof d);
    const double *rate = f->a + block->at;
    for (int i = 0; i < block->n; i++) along += d[i] * rate[i];
    for (int i = 0; i < block->n; i++) across = fmax(across, fabs(rate[i] - along * d[i]));
    double size = frot_length(f->x, f->given->rows) *
                  frot_length(f->given->w + block->at * f->given->rows, f->given->rows);
    if (across > STRAIGHT * size && f->now[k].ratio > 0) return 0;
  }
  return 1;
}

/* Whether all contacts that are pressed have next to no speed and energy: infinitely many turns of
 * contacts that press each other shrink in a ratio, and end at rest. */
static int is_spent(const frot_impact *f) {
  for (int k = 0; k < f->given->n_blocks; k++) {
    const frot_impact_part *part = &f->parts[k];
    int at = f->given->blocks[k].at;
    double least = SPENT * f->scale[at], own = f->given->w[at * (f->given->rows + 1)];
    if (!frot_is_driven(part)) continue;
    if (fabs(f->u[at]) > least || 2 * part->stored * own > least * least) return 0;
  }
  return 1;
}

/* Put the arrays of a problem into the scratch memory. */
static frot_impact lay_out(const frot_impact_problem *p, double *doubles, int *integers) {
  frot_impact f = {.given = p, .pivot = integers};
  int n = p->rows;
  f.x = doubles, f.a = f.x + n, f.b = f.a + n, f.scale = f.b + n, f.force = f.scale + n;
  f.terms = f.force + p->n_blocks, f.stages = f.terms + n + p->n_blocks;
  f.soft = f.stages, f.stages += n * n;
  f.newton = f.stages + frot_spring_doubles(n, p->n_blocks);
  double *rest = f.newton + frot_contact_newton_doubles(n);
  f.parts = (frot_impact_part *)(void *)rest;
  f.now = (frot_contact_block *)(void *)(rest + parts_in_doubles(p->n_blocks));
  return f;
}

static int any_approaches(const frot_impact_problem *p, const double *u) {
  for (int k = 0; k < p->n_blocks; k++)
    if (p->blocks[k].rule == FROT_ROW_PRESSES && !p->blocks[k].is_zero && u[p->blocks[k].at] < 0)
      return 1;
  return 0;
}

/* Speeds of what is at rest are exactly zero. */
static void finish(frot_impact *f) {
  for (int k = 0; k < f->given->n_blocks; k++) {
    const frot_impact_block *block = &f->given->blocks[k];
    int rests = f->parts[k].state == FROT_PART_RIGID || frot_sticks(f, k);
    for (int i = block->at; i < block->at + block->n && rests; i++)
      if (block->rule == FROT_ROW_PRESSES || block->rule == FROT_ROW_BALL) f->u[i] = 0;
    if (block->rule == FROT_ROW_PRESSES) f->p[block->at] = fmax(f->p[block->at], 0);
  }
}

/* Painleve's coefficient of block k, over W_nn: the change of its speed per unit of the impulse
 * that presses it alone. */
static double pressed_rate(const frot_impact *f, int k) {
  int at = f->given->blocks[k].at;
  return f->a[at] / f->given->w[at * (f->given->rows + 1)];
}

/* The impulse of the pressed contact in which the first slip changes by a `share` of itself, at
 * these rates; infinite where none does. */
static double impulse_of_slips(const frot_impact *f, double share) {
  double impulse = INFINITY;
  for (int i = 0; i < f->given->n_blocks; i++) {
    const frot_impact_block *block = &f->given->blocks[i];
    if (block->rule != FROT_ROW_BALL || f->parts[i].state != FROT_PART_SLIPS) continue;
    double rate = frot_length(f->a + block->at, block->n);
    if (rate > 0) impulse = fmin(impulse, share * frot_impact_slip(block, f->u, NULL) / rate);
  }
  return impulse;
}

/* The same of block k, which is `part` now, after an *impulse that turns slips a little. */
static double turned_rate(frot_impact *f, int k, double part, double *impulse) {
  double *later = f->stages;
  *impulse = impulse_of_slips(f, TURN);
  if (!(*impulse > 0 && *impulse < INFINITY)) return part;
  for (int i = 0; i < f->given->rows; i++) later[i] = f->u[i] + *impulse * f->a[i];
  return frot_impact_rates(f, later) ? part : pressed_rate(f, k);
}

/* Springs without force and speed stay so: let the contact that its friction presses approach, by
 * no less than it would part until its slip has turned, or has ended where it goes straight. */
static void begin_to_press(frot_impact *f, int driver, int straight) {
  int at = f->given->blocks[driver].at;
  if (f->parts[driver].state != FROT_PART_LOADING || f->parts[driver].stored > 0 || f->u[at] != 0)
    return;
  double part = fmax(pressed_rate(f, driver), 0), impulse, parted = 0;
  if (straight) {
    impulse = impulse_of_slips(f, 1);
    if (impulse < INFINITY) parted = part * impulse;
  } else {
    double turned = turned_rate(f, driver, part, &impulse);
    if (turned < part) parted = part * part / (part - turned) * impulse;
  }
  f->u[at] = -BEGINNING * f->scale[at] - parted * f->given->w[at * (f->given->rows + 1)];
}

int frot_solve_impact(const frot_impact_problem *problem, int driver, double *u, double *p,
                      double *lost, int *phases, double *doubles, int *integers) {
  frot_impact f = lay_out(problem, doubles, integers);
  f.u = u, f.p = p, f.lost = lost;
  begin(&f, driver);
  if (driver < 0 && !any_approaches(problem, u)) return *phases = 0, FROT_IMPACT_SOLVED;
  int slipping = 0;
  for (int phase = 0, turns = 0; phase < MOST_PHASES; phase++) {
    slipping += phase > 0 && f.turns == turns, turns = f.turns;
    int count, only = only_driver(&f, &count);
    *phases = f.phases;
    if (count == 0) return finish(&f), FROT_IMPACT_SOLVED;
    f.spent |= phase > 0 && is_spent(&f);
    f.alone = only >= 0;
    set_forces(&f, only);
    f.implicit |= slipping > MOST_EXPLICIT || (!f.implicit && frot_decide_impact(&f));
    if (f.implicit) {
      if (frot_implicit_phase(&f)) return FROT_IMPACT_ENDLESS;
      continue;
    }
    int other = only_driver(&f, &count);
    if (other != only) continue; /* a contact that was at rest is pressed as well */
    int straight = only >= 0 && goes_straight(&f);
    if (driver >= 0 && (!straight || pressed_rate(&f, driver) > -JAMS))
      begin_to_press(&f, driver, straight);
    int endless = straight ? frot_constant_phase(&f, only) : frot_spring_phase(&f);
    if (endless) return FROT_IMPACT_ENDLESS;
  }
  return FROT_IMPACT_ENDLESS;
}

int frot_jamming_contact(const frot_impact_problem *problem, int ended, double *u, double *p,
                         double *lost, double *doubles, int *integers) {
  int found = -1;
  double least = ended ? ENDED : -JAMS;
  for (int k = 0; k < problem->n_blocks; k++) {
    const frot_impact_block *block = &problem->blocks[k];
    if (block->rule != FROT_ROW_PRESSES || !(block->is_zero || u[block->at] == 0)) continue;
    frot_impact f = lay_out(problem, doubles, integers);
    f.u = u, f.p = p, f.lost = lost;
    begin(&f, k);
    set_forces(&f, k);
    if (frot_decide_impact(&f)) continue;
    double part = pressed_rate(&f, k);
    if (fabs(part) <= ALMOST_JAMS) {
      double impulse, turned = turned_rate(&f, k, part, &impulse);
      if (turned < -fabs(part)) part = turned;
    }
    if (part < least) least = part, found = k;
  }
  return found;
}
