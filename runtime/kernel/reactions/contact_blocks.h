/* Contacts and laws as the rows and blocks of a contact problem (contact/contact_newton.h): for the
 * motion of a component, for all motions of a state, for impacts. */
#ifndef FROT_CONTACT_BLOCKS_H
#define FROT_CONTACT_BLOCKS_H

#include "model/workspace.h"

/* Blocks, and of each place the row of the model. */
typedef struct {
  frot_contact_block *blocks;
  int *row_of;
  int n_blocks, rows;
} frot_block_list;

/* Add a row. Returns its place. */
int frot_list_row(frot_block_list *list, int row);

/* Add a block of n rows that begin at a place. */
frot_contact_block *frot_list_block(frot_block_list *list, int rule, int at, int n);

/* Add element e with the readings that bound it, which elements of one joint share, and last its
 * own block: a slip in its direction if it `slides`, with the coefficient of motion, else a ball
 * with that of rest. `normal`: the place of the reaction that bounds a contact's. Returns that
 * block. */
frot_contact_block *frot_list_element(const frot_model *m, const frot_work *w,
                                      frot_block_list *list, int e, int normal, int slides);

/* matrix (rows x rows, by rows) <- what the reactions of the rows do to them. */
void frot_list_effects(const frot_model *m, const frot_work *w, const frot_block_list *list,
                       double *matrix);

#endif
