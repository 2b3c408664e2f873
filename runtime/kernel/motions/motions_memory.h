/* The memory in which the motions of an instant are listed. */
#ifndef FROT_MOTIONS_MEMORY_H
#define FROT_MOTIONS_MEMORY_H

#include "motions/describe_motion.h"

/* Motions of all parts that are described, beside one of each. */
enum { FROT_MOST_DESCRIBED = 64 };

/* Parts of a model: groups whose loads read each other, first .. end. */
int frot_parts_of(const frot_model *m);
void frot_groups_of_part(const frot_model *m, int part, int *first, int *end);

/* Bytes of the memory of a search of parts with up to so many items, and with `described` of what
 * its motions are in the terms of the model. */
size_t frot_motions_bytes(const frot_model *m, int most_items, int described);

/* Set the pointers of a memory into a block of that size. */
void frot_lay_out_motions(const frot_model *m, void *block, int most_items, int described,
                          frot_motions_memory *c);

#endif
