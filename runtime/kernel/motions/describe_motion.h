/* Found motions in the terms of the model. */
#ifndef FROT_DESCRIBE_MOTION_H
#define FROT_DESCRIBE_MOTION_H

#include "motions/taylor.h"
#include "motions/vector_motions.h"

/* All memory of a call. */
typedef struct {
  frot_place_of_motion at;
  frot_contact_instant one;
  frot_taylor taylor;
  frot_motion_list *list;
  frot_vector_problem *vectors;
  frot_contact_block *blocks;
  double *doubles, *x, *b, *place; /* place: coordinates and speeds of the state */
  int *integers, *part_of_contact;
  frot_motion *motions;
  signed char *contacts;
} frot_motions_memory;

/* What the found motion k of a part is: of the list, `before` motions after others; of the
 * vectors. */
void frot_describe_motion(frot_motions_memory *c, int part, int k, int before, frot_motion *one);
void frot_describe_vector_motion(frot_motions_memory *c, int part, int k, frot_motion *one);

#endif
