/* The motions of an instant as the search order by order lists them (motion_search/), and the modes
 * of the one preferred. */
#ifndef FROT_LISTED_MOTIONS_H
#define FROT_LISTED_MOTIONS_H

#include "modes/enumeration.h"
#include "motions/motions_memory.h"

/* Contacts and laws of a part that are listed at most, and nodes of a search. */
enum { FROT_MOST_LISTED = 12, FROT_LISTED_NODES = 1500 };

/* Pose the problems of an instant in the memory w->search.list. */
void frot_begin_list(const frot_instant *in, frot_motions_memory *c);

/* A list that is complete and empty. */
enum { FROT_NONE_LISTED = -2 };

/* List the motions of a part of the model. Returns the one preferred by `on_indeterminate`,
 * FROT_NONE_LISTED, or -1 where the list is not complete or inequalities are not decided. `pins`:
 * the part has laws of dry pins, or none is listed. */
int frot_list_part(const frot_instant *in, frot_motions_memory *c, int part, int pins);

/* The modes of motion k for the component `chosen` into w->search.best, with reactions that hold
 * them. Returns how many motions the component has, or 0 where no reactions are found. */
int frot_take_motion(const frot_instant *in, const frot_motions_memory *c, int k, const int *chosen,
                     int count);

#endif
