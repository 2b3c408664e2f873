/* Layout of the scratch block. */
#include "model/workspace.h"

#include <string.h>

#include "model/sleeping.h"
#include "events/feature_edges.h"
#include "methods/rodas.h"
#include "model/island_calls.h"
#include "numerics/dense.h"
#include "numerics/tolerances.h"
#include "inertia/articulated.h"

/* Under the address sanitizer a gap behind each piece in which nobody may read or write. */
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/asan_interface.h>
#define GAP 64
#else
#define GAP 0
#define ASAN_POISON_MEMORY_REGION(from, size) ((void)(from), (void)(size))
#endif

/* Hands out pieces of the scratch block; with a NULL base it only counts. */
typedef struct {
  char *base;
  size_t used;
} arena;

static void *take(arena *a, size_t count, size_t size) {
  size_t at = (a->used + 15) & ~(size_t)15, end = at + count * size;
  a->used = end + (GAP > 0 ? GAP : size);
  if (!a->base) return NULL;
  ASAN_POISON_MEMORY_REGION(a->base + end, GAP);
  return a->base + at;
}

#define TAKE(field, count) (field = take(a, (size_t)(count), sizeof *field))

/* Sizes that several rooms share. */
typedef struct {
  int equations; /* relations at once: statements, contacts, held rows, invariants */
  int states;    /* unknowns of these relations */
  int square;    /* of the largest linear system: of a group, a part, or of all where equations of
                    the text bind them together */
  int across;    /* unknowns of the largest of these */
  int slopes;    /* items of the rows of the largest at the start, or of the invariants */
  int widest;    /* unknowns of the largest group */
  int block;     /* of the largest block */
} extent;

static int larger(int a, int b) { return a > b ? a : b; }

/* Of the parts of places and of speeds, one after the other. */
static const frot_part *part_of(const frot_model *m, int i) {
  return i < m->n_parts ? &m->parts[i] : &m->speed_parts[i - m->n_parts];
}

static extent extent_of(const frot_model *m, const frot_layout *l) {
  extent e = {.states = m->n_invariants > 0 ? m->nq + m->nv : m->nq};
  e.equations = larger(m->n_position, m->n_velocity) + m->n_rows + m->n_contacts + m->n_invariants +
                larger(m->n_guessed, 4 * m->n_guessed_speeds);
  e.states = larger(e.states, l->nw);
  for (int k = 0; k < m->n_groups; k++) {
    const frot_group *g = &m->groups[k];
    e.widest = larger(e.widest, g->n), e.across = larger(e.across, g->n);
    e.square = larger(e.square, g->n + g->n_rows + g->n_contacts);
  }
  for (int i = 0; i < m->n_parts + m->n_speed_parts; i++) {
    const frot_part *part = part_of(m, i);
    int count = part->n_stated + part->n_contacts + 4 * part->n_guessed;
    for (int k = 0; k < part->n_groups; k++) count += m->groups[part->groups[k]].n_rows;
    e.square = larger(e.square, count), e.across = larger(e.across, part->n_unknowns);
    e.slopes = larger(e.slopes, count * part->n_unknowns);
  }
  if (m->n_invariants > 0)
    e.square = larger(e.equations, l->nw), e.across = e.states, e.slopes = e.states * e.equations;
  for (int i = 0; i < m->n_blocks; i++) e.block = larger(e.block, m->blocks[i].count);
  return e;
}

static int count_reads(const frot_reads *r) { return r->nq + r->nv + r->nu + r->np + r->nd; }

/* The most that a part takes: unknowns, unknowns of blocks that follow from these, all that its
 * functions read. */
static frot_part largest_part(const frot_model *m) {
  frot_part most = {0};
  for (int i = 0; i < m->n_parts + m->n_speed_parts; i++) {
    const frot_part *k = part_of(m, i);
    int read = count_reads(&k->reads) + k->ny;
    most.n_unknowns = larger(most.n_unknowns, k->n_unknowns);
    most.n_turns = larger(most.n_turns, k->n_turns), most.ny = larger(most.ny, k->ny);
    most.n_own = larger(most.n_own, k->n_own), most.reads.nq = larger(most.reads.nq, read);
    most.n_stated = larger(most.n_stated, k->n_stated);
    most.n_contacts = larger(most.n_contacts, k->n_contacts);
  }
  return most;
}

/* The scratch that any of the generated functions needs. */
static frot_callable scratch_of_all(const frot_model *m) {
  const frot_callable *calls[] = {
      &m->parameters, &m->start,    &m->beginning, &m->kinematics, &m->beginnings, &m->places,
      &m->pace,       &m->dynamics, &m->drives,    &m->spread,     &m->rates,      &m->jacobian,
      &m->invariants, &m->update,   &m->sizes,     &m->variables,  &m->energy,     &m->timers,
      &m->sensed,     &m->watched,  &m->vanishing, &m->terms,      &m->orders};
  int count = (int)(sizeof calls / sizeof *calls);
  frot_callable most = {NULL, 11, 11, 0, 0};
  for (int i = 0; i < count + 2 * m->n_blocks; i++) {
    const frot_callable *call = i < count ? calls[i] : NULL;
    if (i >= count) {
      const frot_block *block = &m->blocks[(i - count) / 2];
      call = (i - count) % 2 ? &block->switching : &block->residual;
    }
    most.n_arg = larger(most.n_arg, call->n_arg), most.n_res = larger(most.n_res, call->n_res);
    most.n_iw = larger(most.n_iw, call->n_iw), most.n_w = larger(most.n_w, call->n_w);
  }
  for (int i = 0; i < m->n_islands; i++) {
    const frot_island *k = &m->islands[i];
    const frot_callable *own[] = {&k->kinematics, &k->dynamics, &k->spread, &k->sizes};
    for (int j = 0; j < 4; j++)
      most.n_iw = larger(most.n_iw, own[j]->n_iw), most.n_w = larger(most.n_w, own[j]->n_w);
  }
  for (int i = 0; i < m->n_parts + m->n_speed_parts; i++) {
    const frot_part *k = part_of(m, i);
    const frot_callable *own[] = {&k->stating, &k->guessing, &k->sides, &k->slopes};
    for (int j = 0; j < 4; j++)
      most.n_iw = larger(most.n_iw, own[j]->n_iw), most.n_w = larger(most.n_w, own[j]->n_w);
  }
  return most;
}

/* Whether a motion that a law opposes has several components. */
static int has_vectors(const frot_model *m) {
  int several = 0;
  for (int e = 0; e < m->n_elements; e++) several |= m->elements[e].parts > 1;
  return several;
}

static void bind_lists(const frot_model *m, const frot_layout *l, frot_awake_lists *w, arena *a) {
  TAKE(w->place, l->nx), TAKE(w->states, l->nx), TAKE(w->islands, m->n_islands),
      TAKE(w->groups, m->n_groups);
  TAKE(w->contacts, m->n_contacts), TAKE(w->elements, m->n_elements);
  TAKE(w->located, m->n_located);
}

static void bind_awake(const frot_model *m, const frot_layout *l, frot_awake_work *w, arena *a) {
  bind_lists(m, l, &w->all, a), bind_lists(m, l, &w->some, a);
  TAKE(w->extent, m->n_islands);
  TAKE(w->power, m->n_islands), TAKE(w->state, m->nq + m->nv), TAKE(w->group, m->n_groups);
  TAKE(w->condition, m->n_located);
  int most = 0;
  for (int i = 0; i < m->n_islands; i++) {
    const frot_island *k = &m->islands[i];
    most = larger(most, k->reads.nq + count_reads(&k->reads) + k->n_conditions);
  }
  if (m->n_islands > 0) most += l->nw + 2 * m->n_rows + m->n_contacts + 2 * m->n_elements + 1;
  TAKE(w->values, most);
}

static void bind_call(const frot_model *m, const frot_layout *l, frot_call_work *w, arena *a) {
  frot_callable most = scratch_of_all(m);
  TAKE(w->arg, most.n_arg), TAKE(w->res, most.n_res), TAKE(w->iw, most.n_iw);
  TAKE(w->w, most.n_w), TAKE(w->inputs, m->nu);
  int told = larger(m->n_watched, (1 + FROT_WHERE) * m->n_vanishing);
  TAKE(w->values, larger(m->np, l->nw) + m->n_checks + m->nq + m->nv + m->n_loads + told);
}

static void bind_blocks(const frot_model *m, const extent *e, frot_block_work *w, arena *a) {
  int n = e->block;
  TAKE(w->y, m->ny), TAKE(w->r, 2 * n), TAKE(w->j, n * n), TAKE(w->lu, n * n), TAKE(w->size, 2 * n);
  TAKE(w->step, 4 * n), TAKE(w->scale, n * n + 5 * n), TAKE(w->pivot, n);
}

static void bind_core(const frot_model *m, const frot_layout *l, frot_core_work *w, arena *a) {
  int nr = m->n_rows, general = m->general != 0;
  TAKE(w->qd, m->nq), TAKE(w->mass, m->n_matrix), TAKE(w->h, l->nw), TAKE(w->rows, m->n_entries);
  int given = 0;
  for (int k = 0; k < m->n_groups; k++) given += m->groups[k].n_given;
  TAKE(w->given, given), TAKE(w->reach, 2 * nr);
  TAKE(w->c, nr), TAKE(w->rate, nr), TAKE(w->gap, m->n_contacts);
  TAKE(w->condition, m->n_conditions), TAKE(w->coefficient, 2 * m->n_elements), TAKE(w->power, 1);
  TAKE(w->effect, general * m->n_entries), TAKE(w->metric, general * m->n_metric);
  TAKE(w->factor, m->n_metric), TAKE(w->unit, m->n_metric), TAKE(w->share, l->nw),
      TAKE(w->force, l->nw), TAKE(w->half, m->n_entries);
  TAKE(w->lu, general * m->n_matrix), TAKE(w->lu_scale, general * 2 * l->nw);
  TAKE(w->lu_pivot, general * l->nw);
  TAKE(w->wanted, nr), TAKE(w->formed, m->n_groups), TAKE(w->listed, nr),
      TAKE(w->support, 2 * nr + 2), TAKE(w->free, nr), TAKE(w->delassus, m->n_square);
  TAKE(w->load, l->nw), TAKE(w->load_size, l->nw), TAKE(w->row_load, nr);
  TAKE(w->bias_size, nr);
  TAKE(w->lam, nr), TAKE(w->a, l->nw), TAKE(w->rest, l->nw), TAKE(w->column, l->nw);
  int steps = 0, abreast = 0;
  for (int k = 0; k < m->n_groups; k++)
    abreast = larger(abreast, m->groups[k].n_speeds * (m->groups[k].n_rows + 2 * FROT_ABREAST));
  TAKE(w->abreast, abreast);
  if (has_vectors(m)) TAKE(w->frame, 9 * m->n_elements), TAKE(w->lam_of_text, nr);
  for (int k = 0; k < m->n_groups; k++) steps = larger(steps, m->groups[k].n_links);
  TAKE(w->inertia, FROT_STEP_INERTIA * steps), TAKE(w->twist, FROT_STEP_TWIST * steps);
  TAKE(w->motion, FROT_STEP_TWIST * steps);
  TAKE(w->momenta, steps > 0 ? l->nw : 0);
}

/* What wide numbers take, where there are any. */
static void bind_wide(const frot_model *m, const frot_layout *l, frot_wide_work *w, arena *a) {
  int scratch = m->wide.n_w, given = 0, steps = 0, some = m->wide.call != NULL;
  for (int i = 0; i < m->n_islands; i++) {
    some |= m->islands[i].wide.call != NULL, scratch = larger(scratch, m->islands[i].wide.n_w);
  }
  if (!some) return;
  for (int k = 0; k < m->n_groups; k++)
    given += m->groups[k].n_given, steps = larger(steps, m->groups[k].n_links);
  TAKE(w->mass, m->n_matrix), TAKE(w->h, l->nw), TAKE(w->rows, m->n_entries);
  TAKE(w->factor, m->n_metric), TAKE(w->force, l->nw), TAKE(w->half, m->n_entries);
  TAKE(w->loads, l->nw), TAKE(w->given, given), TAKE(w->w, scratch), TAKE(w->of, m->n_groups);
  TAKE(w->inertia, FROT_STEP_INERTIA * steps), TAKE(w->twist, FROT_STEP_TWIST * steps);
}

static void bind_reactions(const frot_model *m, const extent *e, frot_work *w, arena *a) {
  frot_reaction_work *r = &w->reactions;
  int n = m->n_rows, elements = m->n_elements;
  TAKE(r->unknown, n), TAKE(r->owner, n), TAKE(r->fold, FROT_FOLDS * n), TAKE(r->friction, n);
  TAKE(w->span.spare, n), TAKE(w->span.kept, n);
  TAKE(w->span.order, n), w->span.follow = r->follow = 0;
  TAKE(r->sign, m->n_groups), TAKE(r->carried, n), TAKE(r->fold_ratio, FROT_FOLDS * n),
      TAKE(r->ratio, elements);
  TAKE(r->along, FROT_BOUNDING * elements), TAKE(r->heading, elements), TAKE(r->unit_of, n),
      TAKE(r->weight, n), TAKE(r->solution, n);
  int followers = 0, followed = 0;
  for (int k = 0; k < m->n_groups; k++) {
    followers = larger(followers, m->groups[k].n_elements);
    followed = larger(followed, m->groups[k].n_elements * m->groups[k].n_rows);
  }
  TAKE(r->known, FROT_BOUNDING * followers), TAKE(r->effects, FROT_BOUNDING * followed),
      TAKE(r->rate, m->n_groups);
  TAKE(r->followers, followers), TAKE(r->noted, FROT_INSTANTS * elements);
  TAKE(r->instant, FROT_INSTANTS * m->n_groups), TAKE(r->instants, m->n_groups);
  if (has_vectors(m)) {
    int widest = 0;
    for (int k = 0; k < m->n_groups; k++) widest = larger(widest, m->groups[k].n_rows);
    TAKE(r->cone_rows, widest * (widest + 3) + frot_cone_scratch(widest, widest));
    TAKE(r->cones, m->n_contacts), TAKE(r->balls, elements);
  }
  TAKE(w->span.basis, (n + 1) * e->widest), TAKE(w->span.parts, n + e->widest);
  TAKE(w->span.along, n), TAKE(w->span.way, n);
  TAKE(w->span.bias, n), TAKE(w->span.bias_size, n), TAKE(w->span.left, n);
  TAKE(w->span.direction, m->n_entries), TAKE(w->step.direction, m->n_entries);
  TAKE(w->step.motion, m->n_entries);
  TAKE(w->step.left, n * (DP_STAGES + 1));
  TAKE(w->step.near, DP_STAGES + 1);
  TAKE(w->step.order, m->n_contacts), TAKE(w->step.ordered, m->n_groups);
}

static void bind_relations(const frot_model *m, const frot_layout *l, const extent *e, frot_work *w,
                           arena *a) {
  frot_relation_work *r = &w->relations;
  int wide = e->states, big = e->square, across = e->across, least = big < across ? big : across;
  TAKE(w->linear.matrix, big * larger(big, across)), TAKE(w->linear.right, 2 * big);
  TAKE(w->linear.scratch, 2 * big * big + 6 * big + 4 * across + least * across);
  TAKE(w->linear.pivot, 2 * larger(big, wide));
  TAKE(r->jacobian, e->slopes), TAKE(r->residual, e->equations + l->nw);
  TAKE(r->size, e->equations), TAKE(r->step, wide + l->nw + e->equations);
  TAKE(r->unit, wide), TAKE(r->rows, m->n_rows + m->n_contacts + m->n_elements);
  TAKE(r->bounds, 2 * e->equations);
}

static void bind_opening(const frot_model *m, const extent *e, frot_opening_work *w, arena *a) {
  frot_part most = largest_part(m);
  int nx = most.n_unknowns, own = most.n_own, ny = most.ny;
  TAKE(w->use, m->n_contacts), TAKE(w->witness, 3 * m->n_contacts), TAKE(w->reach, m->n_contacts);
  TAKE(w->residual_y, own * most.n_stated), TAKE(w->slopes, nx * own);
  TAKE(w->slopes_y, own * own + 3 * own), TAKE(w->slopes_pivot, own);
  TAKE(w->factor, nx * nx), TAKE(w->row_weight, e->equations);
  /* found, begin and apart are also of all coordinates: tangent_cone.c, start_branch.c */
  TAKE(w->off_at_first, e->equations), TAKE(w->begin, e->states), TAKE(w->found, e->states),
      TAKE(w->apart, e->states);
  TAKE(w->nearest, nx + ny), TAKE(w->second, nx), TAKE(w->way, nx), TAKE(w->next_way, nx);
  TAKE(w->behind, nx), TAKE(w->here, nx), TAKE(w->first_factor, nx * nx), TAKE(w->first_unit, nx);
  TAKE(w->scratch, larger(3 * nx, m->nv)), TAKE(w->left, e->equations), TAKE(w->met, m->nq);
  TAKE(w->guess_weight, 2 * m->n_guessed), TAKE(w->begin_y, ny), TAKE(w->fresh, m->ny);
  TAKE(w->other, 2 * (nx + ny)), TAKE(w->near, nx + ny), TAKE(w->x, nx),
      TAKE(w->read, most.reads.nq);
  TAKE(w->own, nx), TAKE(w->rows, e->equations), TAKE(w->number, larger(m->nq, m->nv));
  TAKE(w->turns, most.n_turns), TAKE(w->left_out, most.n_stated), TAKE(w->kept, nx);
  TAKE(w->state, nx), TAKE(w->chosen, e->equations);
  TAKE(w->contact_of, most.n_contacts);
  TAKE(w->sides, 4 * most.n_contacts), TAKE(w->start, m->nv);
  TAKE(w->first, larger(m->nq, nx + ny + most.n_contacts)), TAKE(w->first_use, most.n_contacts);
  TAKE(w->outside, 2 * (nx + ny));
  TAKE(w->descent, 6 * nx), TAKE(w->multiplier, e->equations);
}

static void bind_step(const frot_model *m, const frot_layout *l, frot_work *w, arena *a) {
  frot_step_work *p = &w->step;
  TAKE(w->guards.list, l->ng), TAKE(w->guards.size, l->ng), TAKE(w->guards.shown, l->ng);
  TAKE(w->guards.motion, m->n_groups);
  TAKE(w->guards.end_reaction, FROT_BOUNDING * m->n_elements);
  TAKE(w->guards.end_friction, m->n_elements);
  if (has_vectors(m))
    TAKE(w->guards.end_slip, 4 * m->n_elements), TAKE(w->guards.end_direction, 2 * m->n_elements);
  TAKE(p->k, DP_ALL * l->nz), TAKE(p->first, l->nz), TAKE(p->doubt, l->nz),
      TAKE(p->excused, 2 * m->nv), TAKE(p->beyond, m->nv), TAKE(p->z0, l->nz), TAKE(p->z1, l->nz),
      TAKE(p->z, l->nz);
  TAKE(p->y_end, m->ny), TAKE(p->f, DP_DENSE * l->nz), TAKE(p->parameters, m->np);
  TAKE(w->sizes.change, m->nq), TAKE(w->sizes.left, m->nq), TAKE(w->sizes.own, m->nq + m->nv),
      TAKE(w->sizes.alike, m->nq);
  TAKE(w->sizes.states, m->nq);
  w->sizes.count = 0;
  for (int j = 0; a->base && j < m->nq; j++)
    if (m->q_speed[j] < 0) w->sizes.states[w->sizes.count++] = j;
  TAKE(w->implicit.items, frot_implicit_doubles(m));
  TAKE(w->implicit.pivot, frot_implicit_integers(m));
}

static void bind_events(const frot_model *m, frot_event_work *w, arena *a) {
  TAKE(w->was, m->n_conditions), TAKE(w->firing, m->n_whens);
  TAKE(w->outcome, m->n_outcomes);
  TAKE(w->before, m->n_conditions), TAKE(w->known, m->n_conditions);
  TAKE(w->timer, 2 * m->n_timed), TAKE(w->discrete, m->n_discrete);
  TAKE(w->discrete_before, m->n_discrete), TAKE(w->held, m->n_held);
  TAKE(w->normals, frot_has_edges(m) ? m->n_entries : 0);
}

static void bind_search(const frot_model *m, frot_search_work *w, arena *a) {
  int nc = m->n_contacts, ne = m->n_elements, nr = m->n_rows;
  TAKE(w->trial, nc + ne), TAKE(w->best, nc + ne), TAKE(w->before, nc + ne);
  TAKE(w->guess, nc + ne), TAKE(w->guess_ahead, nc + ne), TAKE(w->certain, nc);
  TAKE(w->corner, nc + ne), TAKE(w->idle, 2 * (nc + ne)), TAKE(w->found, nc + ne),
      TAKE(w->slack, nc + ne);
  TAKE(w->zero, ne), TAKE(w->at_rest, ne), TAKE(w->departs, ne), TAKE(w->ahead, ne);
  TAKE(w->motions, FROT_MOTIONS * nr), TAKE(w->pivot_bound, 3 * nr);
  TAKE(w->choice, 4 * nc + 4 * ne), TAKE(w->component, nc), TAKE(w->chosen, nc);
  TAKE(w->nothing_frozen, m->nv), TAKE(w->margin, nc + ne);
  TAKE(w->rates, m->nq), TAKE(w->along, FROT_BOUNDING * m->n_elements), TAKE(w->set_out, m->nv);
  TAKE(w->others, m->n_rows);
  TAKE(w->beyond, 2 * (nc + ne)), TAKE(w->closable, nc + ne), TAKE(w->moved_from, m->nq + m->nv);
  for (int k = 0; a->base && k < m->nv; k++) w->nothing_frozen[k] = 0;
  if (!has_vectors(m)) return;
  int widest = 0;
  for (int k = 0; k < m->n_groups; k++) widest = larger(widest, m->groups[k].n_rows);
  TAKE(w->problem, widest * (widest + 1) + frot_contact_newton_doubles(widest));
  TAKE(w->reactions_found, 3 * nr), TAKE(w->blocks, nc + ne + nr), TAKE(w->block_of, nc + ne + nr);
  TAKE(w->row_of, nr), TAKE(w->pivot, frot_contact_newton_integers(widest));
}

static void bind_share(const frot_model *m, const frot_layout *l, const extent *e,
                       frot_share_work *w, arena *a) {
  /* of a contact four edges at most, of another row two columns */
  int columns = 0, rows = 0, items = 0;
  for (int k = 0; k < m->n_groups; k++) {
    const frot_group *g = &m->groups[k];
    int own = 4 * g->n_contacts + 2 * g->n_rows, across = g->n + g->n_contacts;
    columns = larger(columns, own), rows = larger(rows, across);
    items = larger(items, across * (own + 1));
  }
  TAKE(w->tableau, items), TAKE(w->columns, items);
  TAKE(w->growth, l->nw), TAKE(w->normal, e->widest), TAKE(w->basic, rows);
  TAKE(w->contact, columns), TAKE(w->edge, columns), TAKE(w->read, m->n_contacts);
  TAKE(w->before, m->n_contacts + m->n_elements);
}

static void bind_impacts(const frot_model *m, frot_impact_work *w, arena *a) {
  int nr = m->n_rows, blocks = m->n_contacts + m->n_elements + nr, widest = 0, part = 0;
  for (int i = 0; i < m->n_contacts; i++)
    part |= m->contacts[i].row_n >= 0 && !m->contacts[i].reduced;
  if (!part && m->n_percussions == 0) return;
  for (int k = 0; k < m->n_groups; k++) widest = larger(widest, m->groups[k].n_rows);
  widest++, blocks++; /* of a percussion */
  TAKE(w->lost, blocks), TAKE(w->listed, blocks), TAKE(w->held, widest), TAKE(w->blocks, blocks),
      TAKE(w->block_of, blocks), TAKE(w->row_of, nr + 1);
  TAKE(w->pivot, frot_impact_integers(widest)), TAKE(w->problem, widest * widest);
  TAKE(w->before, widest), TAKE(w->after, widest), TAKE(w->impulse, widest);
  TAKE(w->changes, m->nv + m->na + m->nc), TAKE(w->scratch, frot_impact_doubles(widest, blocks));
  TAKE(w->meets, m->n_contacts);
  TAKE(w->struck_rows, nr), TAKE(w->struck, m->nv + m->na + m->nc),
      TAKE(w->moving, m->nv + m->na + m->nc);
}

static size_t bind(const frot_model *m, frot_work *w, char *base) {
  frot_layout l = frot_layout_of(m);
  extent e = extent_of(m, &l);
  arena held = {base, sizeof(frot_work)}, *a = &held;
  w->layout = l;
  bind_call(m, &l, &w->call, a);
  bind_awake(m, &l, &w->awake, a);
  bind_blocks(m, &e, &w->blocks, a);
  bind_core(m, &l, &w->core, a);
  bind_wide(m, &l, &w->wide, a);
  bind_reactions(m, &e, w, a);
  bind_relations(m, &l, &e, w, a);
  bind_opening(m, &e, &w->opening, a);
  bind_step(m, &l, w, a);
  bind_events(m, &w->events, a);
  bind_search(m, &w->search, a);
  bind_share(m, &l, &e, &w->share, a);
  bind_impacts(m, &w->impacts, a);
  TAKE(w->nearer.begin, m->n_followed), TAKE(w->nearer.y, m->n_followed > 0 ? m->ny : 0);
  TAKE(w->nearer.far, m->n_followed > 0 ? m->n_contacts : 0);
  TAKE(w->nearer.flags, m->n_conditions), TAKE(w->nearer.kept, m->n_conditions);
  TAKE(w->nearer.changed, m->n_contacts);
  TAKE(w->pace, 4 * m->n_paced);
  TAKE(w->tape, l.ns);
  TAKE(w->stood, m->n_contacts + m->n_rows + 2 * (FROT_PLACE * m->n_carried + m->n_invariants));
  return held.used;
}

void frot_bind_work(const frot_model *model, frot_work *work) {
  memset(work, 0, sizeof *work); /* numbers beside the pieces carry nothing either */
  bind(model, work, (char *)work);
  frot_measure_islands(model, work);
  frot_measure_rows(model, work);
  frot_list_all_islands(model, work);
  work->reactions.jammed = work->step.worst = -1; /* no step has failed */
}

size_t frot_work_size(const frot_model *model) {
  frot_work counted;
  return bind(model, &counted, NULL);
}
