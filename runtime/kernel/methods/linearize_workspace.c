#include "methods/linearize_workspace.h"

/* Elements of a group that are parts of a motion of several components. */
static int parts_of(const frot_model *m, const frot_group *g) {
  int parts = 0;
  for (int i = 0; i < g->n_elements; i++) parts += m->elements[g->elements[i]].parts > 1;
  return parts;
}

int frot_lines_of_group(const frot_model *m, const frot_group *g) {
  return g->n + g->n_rows + 2 * g->n_elements + parts_of(m, g);
}

frot_line_extent frot_line_extent_of(const frot_model *m) {
  int early = frot_layout_of(m).early;
  frot_line_extent x = {.columns = m->nq + m->nv + early,
                        .lines = m->nq + early,
                        .entries = m->lines.first[m->n_groups + 2]};
  for (int k = 0; k < m->n_groups; k++) {
    const frot_group *g = &m->groups[k];
    x.lines += frot_lines_of_group(m, g);
    x.equations = frot_larger(x.equations, g->n + 2 * g->n_rows);
    x.unknowns = frot_larger(x.unknowns, g->n + g->n_rows);
    x.most_columns =
        frot_larger(x.most_columns, m->lines.group_start[k + 1] - m->lines.group_start[k]);
    x.most_lines = frot_larger(x.most_lines, frot_lines_of_group(m, g));
  }
  return x;
}

static double *take(double *base, size_t *used, int count) {
  double *at = base ? base + *used : NULL;
  *used += (size_t)count;
  return at;
}

frot_linearize_work frot_linearize_scratch(const frot_model *m, double *doubles, int *integers,
                                           size_t *n_doubles, size_t *n_integers) {
  frot_line_extent x = frot_line_extent_of(m);
  int rows = x.equations, columns = x.unknowns, directions = m->lines.directions;
  size_t used = 0;
  frot_linearize_work w = {.rates = NULL, .residual = NULL};
  w.partial = take(doubles, &used, directions > 0 ? x.lines * directions : x.entries);
  w.seed = take(doubles, &used, x.columns);
  w.block = take(doubles, &used, x.most_lines * x.most_columns);
  w.matrix = take(doubles, &used, rows * columns);
  w.lu = take(doubles, &used, rows * columns);
  w.right = take(doubles, &used, rows * x.most_columns);
  w.least = take(doubles, &used, rows + (rows > columns ? rows : columns) * (columns + 6));
  w.scale = take(doubles, &used, 2 * columns);
  w.pivot = integers;
  w.unknown = integers ? integers + columns : NULL;
  w.place = integers ? w.unknown + m->n_rows : NULL;
  *n_doubles = used, *n_integers = (size_t)(columns + m->n_rows + x.columns);
  return w;
}
