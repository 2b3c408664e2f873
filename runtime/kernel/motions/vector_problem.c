/* The problem of a part with slips of several components at rest, with permanent rows as they are.
 */
#include <math.h>
#include <string.h>

#include "contact/cone_point.h"
#include "evaluation/slip_frames.h"
#include "model/indexing.h"
#include "motions/vector_motions.h"
#include "reactions/contact_blocks.h"

long long frot_vector_doubles(int rows) {
  long long n = rows;
  return n * n + n + FROT_MOST_VECTOR_MOTIONS * 2 * n + 4 * n + 3 * n * n + 10 * n +
         frot_contact_springs_doubles(rows) + frot_cone_scratch(rows, rows) + 64;
}
int frot_vector_integers(int rows) { return 2 * rows + frot_contact_newton_integers(rows) + 8; }
int frot_vector_blocks(int rows) { return 2 * (rows + 4); }

static void add_item(frot_vector_problem *p, int contact, int element, int at, int n, int normal) {
  if (p->n_items == 2 * FROT_MOST_VECTOR_ITEMS) {
    p->complete = 0;
    return;
  }
  p->items[p->n_items++] = (frot_vector_item){contact, element, p->n_blocks - 1, at, n, normal};
}

static int acts(const frot_vector_problem *p, int e) {
  return p->one->place_of[p->one->at->m->elements[e].row] >= 0;
}

static void add_element(frot_vector_problem *p, frot_block_list *list, int e, int normal) {
  const frot_place_of_motion *at = p->one->at;
  const frot_element *element = &at->m->elements[e];
  const frot_contact_block *one = frot_list_element(at->m, at->w, list, e, normal, !at->zero[e]);
  p->n_blocks = list->n_blocks;
  int bounding = element->bound == FROT_BY_NORMAL ? normal : -1;
  add_item(p, element->contact, e, one->at, one->n, bounding);
}

static void list_contact(frot_vector_problem *p, frot_block_list *list, int i) {
  const frot_place_of_motion *at = p->one->at;
  const frot_model *m = at->m;
  const frot_contact *contact = &m->contacts[i];
  int normal = -1, parts = 0;
  if (!at->modes[i].closed) return;
  if (contact->row_n >= 0) {
    parts = !contact->reduced && at->s->data[at->w->layout.unilateral + i] != 0;
    normal = frot_list_row(list, contact->row_n);
    frot_list_block(list, contact->reduced ? FROT_ROW_READS : FROT_ROW_HELD, normal, 1);
    p->n_blocks = list->n_blocks;
  }
  if (parts) add_item(p, i, -1, normal, 1, normal);
  for (int e = 0; e < m->n_elements; e++)
    if (m->elements[e].contact == i && m->elements[e].part == 0 && acts(p, e))
      add_element(p, list, e, normal);
}

void frot_pose_vector_problem(const frot_contact_instant *one, double *doubles, int *integers,
                              frot_contact_block *blocks, frot_vector_problem *p) {
  const frot_model *m = one->at->m;
  memset(p, 0, sizeof *p);
  p->one = one, p->complete = 1, p->row_of = integers, p->blocks = blocks;
  frot_block_list list = {blocks, integers, 0, 0};
  for (int k = one->first; k < one->end; k++)
    for (int i = 0; i < m->groups[k].n_contacts; i++)
      list_contact(p, &list, m->groups[k].contacts[i]);
  p->n = list.rows;
  p->tried = blocks + p->n_blocks, p->integers = integers + p->n;
  p->w = doubles, p->b = p->w + p->n * p->n;
  double *at = p->b + p->n;
  for (int k = 0; k < FROT_MOST_VECTOR_MOTIONS; k++, at += 2 * p->n)
    p->found[k].x = at, p->found[k].a = at + p->n;
  p->scratch = at;
  for (int i = 0; i < p->n; i++) p->b[i] = one->at->w->core.free[p->row_of[i]];
  frot_list_effects(m, one->at->w, &list, p->w);
}
