/* Coulomb's oscillator written by hand: a block on a rough horizontal table, a spring and a push.
 *
 * One coordinate x; the normal direction is an auxiliary speed. It has what the worked examples
 * lack: parameters of every type, one that follows from another, and an input.
 *
 *   p = mu, stiffness, x0, mass, count (integer), pulled (boolean), weight (= 9.81 mass)
 *   u = push
 *   variables = mode, x, x', reaction, friction, time of the start of count
 */
#include "frot.h"

#include <math.h>

#define NP 7

static int parameters(const double **arg, double **res, long long *iw, double *w, int mem) {
  const double *p = arg[0], *set = arg[1];
  (void)iw, (void)w, (void)mem;
  for (int i = 0; i < NP; i++) res[0][i] = p[i];
  if (set[6] == 0.0) res[0][6] = 9.81 * p[3];
  res[1][0] = res[0][3];
  res[1][1] = res[0][0];
  res[2][0] = 0.0;
  res[3][0] = 0.0, res[3][1] = 12.0, res[3][2] = 1e-10, res[3][3] = NAN;
  return 0;
}

static int start(const double **arg, double **res, long long *iw, double *w, int mem) {
  (void)iw, (void)w, (void)mem;
  res[0][0] = arg[2][2];
  return 0;
}

static int beginning(const double **arg, double **res, long long *iw, double *w, int mem) {
  (void)arg, (void)iw, (void)w, (void)mem;
  res[0][0] = 0.0;
  return 0;
}

static int stated_place(const double **arg, double **res, long long *iw, double *w, int mem) {
  (void)iw, (void)w, (void)mem;
  res[0][0] = arg[1][0] - arg[4][2];
  if (res[1]) res[1][0] = 1.0;
  return 0;
}

static int stated_speed(const double **arg, double **res, long long *iw, double *w, int mem) {
  (void)iw, (void)w, (void)mem;
  res[0][0] = arg[2][0];
  if (res[1]) res[1][0] = 1.0;
  return 0;
}

/* What is not zero of the rows: the normal moves the auxiliary speed, the slip the block. */
static void rows(double *jacobian) { jacobian[0] = jacobian[1] = 1.0; }

static int kinematics(const double **arg, double **res, long long *iw, double *w, int mem) {
  (void)iw, (void)w, (void)mem;
  if (res[0]) res[0][0] = 0.0;
  if (res[1]) rows(res[1]);
  if (res[2]) res[2][0] = 0.0, res[2][1] = arg[2][0];
  return 0;
}

static int sides(const double **arg, double **res, long long *iw, double *w, int mem) {
  (void)arg, (void)iw, (void)w, (void)mem;
  res[0][0] = res[0][1] = res[0][2] = 1.0;
  res[1][0] = 0.0;
  return 0;
}

static int sizes(const double **arg, double **res, long long *iw, double *w, int mem) {
  (void)arg, (void)iw, (void)w, (void)mem;
  if (res[0]) res[0][0] = 100, res[0][1] = 100;
  return 0;
}

static int dynamics(const double **arg, double **res, long long *iw, double *w, int mem) {
  const double x = arg[1][0], v = arg[2][0], *u = arg[3], *p = arg[4];
  (void)iw, (void)w, (void)mem;
  if (res[0]) res[0][0] = v;
  if (res[1]) res[1][0] = p[3], res[1][1] = 0.0, res[1][2] = p[3];
  if (res[2]) res[2][0] = (p[5] != 0.0 ? -p[1] * x : 0.0) + u[0], res[2][1] = -p[6];
  if (res[3]) rows(res[3]);
  if (res[4]) res[4][0] = 0.0, res[4][1] = 0.0;
  if (res[5]) res[5][0] = 0.0, res[5][1] = v;
  if (res[6]) res[6][0] = 0.0;
  if (res[8]) res[8][0] = p[0], res[8][1] = p[0];
  if (res[9]) res[9][0] = u[0] * v;
  return 0;
}

static int variables(const double **arg, double **res, long long *iw, double *w, int mem) {
  const double *p = arg[4], *lam = arg[8];
  (void)iw, (void)w, (void)mem;
  res[0][1] = arg[1][0];
  res[0][2] = arg[2][0];
  res[0][3] = lam[0];
  res[0][4] = lam[1];
  res[0][5] = arg[0][0] + p[4];
  return 0;
}

static int energy(const double **arg, double **res, long long *iw, double *w, int mem) {
  const double x = arg[1][0], v = arg[2][0], *p = arg[4];
  (void)iw, (void)w, (void)mem;
  res[0][0] = 0.5 * p[3] * v * v;
  res[1][0] = p[5] != 0.0 ? 0.5 * p[1] * x * x : 0.0;
  return 0;
}

static const double p_default[NP] = {0.1, 9.0, 2.0, 1.0, 3.0, 1.0, 0.0};
static const double u_default[1] = {0.0};
static const frot_contact contacts[1] = {
    {"guide", "hand_model.c:1:1", 0, 1, 0, -1, 0, 0, -1, 0, 0}};
static const frot_element elements[1] = {{0,
                                          FROT_BY_NORMAL,
                                          1,
                                          {0, -1, -1, -1, -1},
                                          {0, 0, 0},
                                          0,
                                          1,
                                          0,
                                          {-1, -1},
                                          0,
                                          1,
                                          FROT_JOINT_TURNS}};
static const int places[2] = {0, 1};
static const int entries[2] = {1, 2};
static const frot_group groups[1] = {
    {0, 2, 1, 1, 2, 1, 1, 2, places, places, places, places, entries, 0, 0, 0, 0, 0, 0, 0, 0}};
static const int row_reads[2] = {1, -1};
static const int row_beside[2] = {-1, 0};
static const int none[2] = {0, 0};
static const unsigned char held_at_start[1] = {1};
static const unsigned char plain[1] = {0};
static const frot_check checks[2] = {
    {FROT_POSITIVE, "mass of body 'block'", "hand_model.c:2:1"},
    {FROT_NOT_NEGATIVE, "friction of 'guide'", "hand_model.c:3:1"}};
static const frot_statement statements[2] = {{"x = x0", "hand_model.c:4:1", "m"},
                                             {"v = 0", "hand_model.c:5:1", "m/s"}};
static const int position_statement[1] = {0};
static const int velocity_statement[1] = {1};
static const int p_dependent[NP] = {0, 0, 0, 0, 0, 0, 1};
static const int p_type[NP] = {FROT_REAL,    FROT_REAL,    FROT_REAL, FROT_REAL,
                               FROT_INTEGER, FROT_BOOLEAN, FROT_REAL};
static const unsigned char row_depends[4] = {0, 0, 0, 0};
static const int q_speed[1] = {0};

#define CALL(f) {f, 16, 16, 1, 1}

#define LISTS all, all, all, all, all, all, all, all, all
#define READS {1, 1, 1, NP, 1, all, all, all, all, all, 0}
static const int all[NP] = {0, 1, 2, 3, 4, 5, 6};
static const frot_part parts[1] = {
    {1, 0, 1, 0, 1, 1, 0, 0, 0, 0, LISTS, READS, CALL(stated_place), {0}, CALL(sides), {0}}};
static const frot_part speed_parts[1] = {
    {1, 0, 1, 0, 1, 1, 0, 0, 0, 0, LISTS, READS, CALL(stated_speed), {0}, {0}, {0}}};

extern const frot_model frot_the_model;
const frot_model frot_the_model = {
    .name = "Hand",
    .key = "hand-model-key",
    .nq = 1,
    .nv = 1,
    .na = 1,
    .nu = 1,
    .np = NP,
    .n_rows = 2,
    .n_contacts = 1,
    .n_elements = 1,
    .n_groups = 1,
    .n_matrix = 3,
    .n_metric = 1,
    .n_entries = 4,
    .n_square = 4,
    .n_checks = 2,
    .n_position = 1,
    .n_velocity = 1,
    .n_statements = 2,
    .n_variables = 6,
    .parameters = CALL(parameters),
    .start = CALL(start),
    .beginning = CALL(beginning),
    .kinematics = CALL(kinematics),
    .dynamics = CALL(dynamics),
    .sizes = CALL(sizes),
    .variables = CALL(variables),
    .energy = CALL(energy),
    .p_default = p_default,
    .u_default = u_default,
    .contacts = contacts,
    .elements = elements,
    .groups = groups,
    .row_reads = row_reads,
    .row_beside = row_beside,
    .row_group = none,
    .row_local = places,
    .contact_group = none,
    .speed_group = none,
    .speed_local = none,
    .speed_coordinate = none,
    .speed_turns = none,
    .checks = checks,
    .statements = statements,
    .n_parts = 1,
    .n_speed_parts = 1,
    .parts = parts,
    .speed_parts = speed_parts,
    .position_direct = held_at_start,
    .position_kind = plain,
    .position_statement = position_statement,
    .velocity_statement = velocity_statement,
    .p_dependent = p_dependent,
    .p_type = p_type,
    .row_depends = row_depends,
    .q_speed = q_speed,
};
