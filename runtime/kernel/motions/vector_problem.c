/* The problem of a part with slips of several components at rest, with permanent rows as they are.
 */
#include <math.h>
#include <string.h>

#include "contact/cone_point.h"
#include "evaluation/slip_frames.h"
#include "model/indexing.h"
#include "motions/vector_motions.h"

long long frot_vector_doubles(int rows) {
  long long n = rows;
  return n * n + n + FROT_MOST_VECTOR_MOTIONS * 2 * n + 4 * n + 3 * n * n + 10 * n +
         frot_contact_newton_doubles(rows) + frot_cone_scratch(rows, rows) + 64;
}
int frot_vector_integers(int rows) { return 2 * rows + frot_contact_newton_integers(rows) + 8; }
int frot_vector_blocks(int rows) { return 2 * (rows + 4); }

static frot_contact_block *add_block(frot_vector_problem *p, int rule, int at, int n) {
  frot_contact_block *one = &p->blocks[p->n_blocks++];
  *one = (frot_contact_block){.rule = rule, .at = at, .n = n};
  return one;
}

static int add_row(frot_vector_problem *p, int row) {
  p->row_of[p->n] = row;
  return p->n++;
}

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

static void add_element(frot_vector_problem *p, int e, int normal) {
  const frot_place_of_motion *at = p->one->at;
  const frot_element *element = &at->m->elements[e];
  int slides = !at->zero[e], n = slides ? 1 : element->parts, read = p->n, count = 0;
  for (int k = 0; k < FROT_BOUNDING && element->bound == FROT_BY_PIN; k++)
    if (element->bounded_by[k] >= 0)
      add_block(p, FROT_ROW_READS, add_row(p, element->bounded_by[k]), 1), count++;
  int first = p->n;
  for (int k = 0; k < n; k++) add_row(p, element->row + k);
  frot_contact_block *one = add_block(p, slides ? FROT_ROW_SLIDES : FROT_ROW_BALL, first, n);
  const double *coefficient = at->w->core.coefficient + 2 * e;
  one->ratio = coefficient[!slides];
  if (element->bound == FROT_BY_NORMAL) one->bounding = normal, one->n_bounding = 1;
  if (element->bound == FROT_BY_PIN) one->bounding = read, one->n_bounding = count;
  one->d[0] = element->parts == 1 && at->w->core.rate[element->row] < 0 ? -1 : 1;
  add_item(p, element->contact, e, first, n, element->bound == FROT_BY_NORMAL ? normal : -1);
}

static void list_contact(frot_vector_problem *p, int i) {
  const frot_place_of_motion *at = p->one->at;
  const frot_model *m = at->m;
  const frot_contact *contact = &m->contacts[i];
  int normal = -1, parts = 0;
  if (!at->modes[i].closed) return;
  if (contact->row_n >= 0) {
    parts = !contact->reduced && at->s->data[at->w->layout.unilateral + i] != 0;
    normal = add_row(p, contact->row_n);
    add_block(p, contact->reduced ? FROT_ROW_READS : FROT_ROW_HELD, normal, 1);
  }
  if (parts) add_item(p, i, -1, normal, 1, normal);
  for (int e = 0; e < m->n_elements; e++)
    if (m->elements[e].contact == i && m->elements[e].part == 0 && acts(p, e))
      add_element(p, e, normal);
}

static void fill_matrix(frot_vector_problem *p) {
  const frot_model *m = p->one->at->m;
  const frot_work *w = p->one->at->w;
  for (int i = 0; i < p->n; i++) {
    int row = p->row_of[i];
    p->b[i] = w->core.free[row];
    for (int j = 0; j < p->n; j++) {
      int by = p->row_of[j], none = frot_is_reading(m, by) || m->row_group[row] != m->row_group[by];
      p->w[i * p->n + j] = none ? 0 : frot_effect(m, w, row, by);
    }
  }
}

void frot_pose_vector_problem(const frot_contact_instant *one, double *doubles, int *integers,
                              frot_contact_block *blocks, frot_vector_problem *p) {
  const frot_model *m = one->at->m;
  memset(p, 0, sizeof *p);
  p->one = one, p->complete = 1, p->row_of = integers, p->blocks = blocks;
  for (int k = one->first; k < one->end; k++)
    for (int i = 0; i < m->groups[k].n_contacts; i++) list_contact(p, m->groups[k].contacts[i]);
  p->tried = blocks + p->n_blocks, p->integers = integers + p->n;
  p->w = doubles, p->b = p->w + p->n * p->n;
  double *at = p->b + p->n;
  for (int k = 0; k < FROT_MOST_VECTOR_MOTIONS; k++, at += 2 * p->n)
    p->found[k].x = at, p->found[k].a = at + p->n;
  p->scratch = at;
  fill_matrix(p);
}
