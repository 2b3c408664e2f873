/* The contact problem of an instant of a model: what may open, slip or rest there. */
#ifndef FROT_CONTACT_INSTANT_H
#define FROT_CONTACT_INSTANT_H

#include "motion_search/motion_search.h"
#include "model/workspace.h"

/* A place of the motion, with modes (n_contacts, then n_elements) in which everything is closed
 * that may be, and everything holds whose motion is zero. */
typedef struct {
  const frot_model *m;
  frot_state *s;
  frot_work *w;
  double t;
  const double *q, *v, *d;
  frot_contact_mode *modes;
  unsigned char *zero; /* n_elements: the motion is zero */
} frot_place_of_motion;

/* Groups first .. end that are one contact problem, with their numbers: place_of (n_rows) of each
 * row or -1, row_at (places), contact_of and element_of (items, -1 where none); `vectors`: elements
 * of several components at rest, which no item is; in wide numbers no order above 0 is known. */
typedef struct {
  const frot_place_of_motion *at;
  int first, end, vectors, wide, scalars;
  int *place_of, *row_at, *contact_of, *element_of;
  frot_motion_item *items;
  int *permanent;
  double *w, *unit, *rows, *force;
  /* permanent_rows.h: rows turned, their parts; the basis rows, their number, lengths before they
   * were units; which rows they are; biases and their sizes */
  double *turned, *parts, *length, *gram, *bias, *bias_size;
  int *basis_row, rank;
  unsigned char *taken;
  frot_motion_problem problem;
  struct frot_taylor *taylor;
} frot_contact_instant;

/* Close what may be closed and hold what may rest, and evaluate the dynamics there. FROT_OK or the
 * status of the fault recorded: a contact closes with speed (FROT_IMPACT), or no numbers. */
int frot_evaluate_place(frot_place_of_motion *at);

/* Rows, readings, items and entries in the metric of groups first .. end, at most. */
typedef struct {
  int places, items, width;
} frot_instant_size;
frot_instant_size frot_size_of_instant(const frot_model *m, int first, int end);

/* Fill the problem of the groups, after frot_evaluate_place; its arrays have room. */
void frot_pose_contact_problem(frot_contact_instant *one);

#endif
