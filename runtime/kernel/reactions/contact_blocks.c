#include "reactions/contact_blocks.h"

#include <string.h>

#include "model/indexing.h"

int frot_list_row(frot_block_list *list, int row) {
  list->row_of[list->rows] = row;
  return list->rows++;
}

frot_contact_block *frot_list_block(frot_block_list *list, int rule, int at, int n) {
  frot_contact_block *one = &list->blocks[list->n_blocks++];
  *one = (frot_contact_block){.rule = rule, .at = at, .n = n};
  return one;
}

/* The first place of the readings that bound a pin, which elements of one joint share. */
static int list_readings(frot_block_list *list, const frot_element *element, int count) {
  for (int i = 0; i < list->rows; i++)
    if (list->row_of[i] == element->bounded_by[0]) return i;
  int first = list->rows;
  for (int k = 0; k < count; k++)
    frot_list_block(list, FROT_ROW_READS, frot_list_row(list, element->bounded_by[k]), 1);
  return first;
}

frot_contact_block *frot_list_element(const frot_model *m, const frot_work *w,
                                      frot_block_list *list, int e, int normal, int slides) {
  const frot_element *element = &m->elements[e];
  int n = slides ? 1 : element->parts, count = frot_norm_first(element, FROT_NORMS);
  int read = list_readings(list, element, count), at = list->rows;
  for (int k = 0; k < n; k++) frot_list_row(list, element->row + k);
  frot_contact_block *one = frot_list_block(list, slides ? FROT_ROW_SLIDES : FROT_ROW_BALL, at, n);
  one->ratio = w->core.coefficient[2 * e + !slides];
  if (element->bound == FROT_BY_NORMAL) one->bounding = normal, one->n_bounding = 1;
  if (element->bound == FROT_BY_PIN) {
    one->bounding = read, one->n_bounding = count;
    memcpy(one->norm, element->norm, sizeof one->norm);
  }
  /* rows of several components are turned along the slip */
  one->d[0] = element->parts == 1 && w->core.rate[element->row] < 0 ? -1 : 1;
  return one;
}

void frot_list_effects(const frot_model *m, const frot_work *w, const frot_block_list *list,
                       double *matrix) {
  for (int i = 0; i < list->rows; i++)
    for (int j = 0; j < list->rows; j++) {
      int row = list->row_of[i], by = list->row_of[j];
      int none = frot_is_reading(m, by) || m->row_group[row] != m->row_group[by];
      matrix[i * list->rows + j] = none ? 0 : frot_effect(m, w, row, by);
    }
}
