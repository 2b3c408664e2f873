/* Layout of the scratch block. */
#include "model/workspace.h"

#include <string.h>

#include "assembly/start_scratch.h"
#include "constraints/projection.h"
#include "evaluation/evaluation_workspace.h"
#include "events/feature_edges.h"
#include "mode_choice/listed_motions.h"
#include "guards/closest_features.h"
#include "guards/conditions.h"
#include "inertia/extended_inertia.h"
#include "methods/dormand_prince.h"
#include "methods/error_scales.h"
#include "methods/rodas.h"
#include "model/island_calls.h"
#include "model/sleeping.h"
#include "numerics/tolerances.h"
#include "reactions/reactions.h"
#include "reactions/switching_functions.h"
#include "singular/singular_posture.h"

#define TAKE(field, count) FROT_TAKE(a, field, count)

/* Of the parts of places and of speeds, one after the other. */
static const frot_part *part_of(const frot_model *m, int i) {
  return i < m->n_parts ? &m->parts[i] : &m->speed_parts[i - m->n_parts];
}

static frot_extent extent_of(const frot_model *m, const frot_layout *l) {
  frot_extent e = {.states = m->n_invariants > 0 ? m->nq + m->nv : m->nq};
  e.equations = frot_larger(m->n_position, m->n_velocity) + m->n_rows + m->n_contacts +
                m->n_invariants + frot_larger(m->n_guessed, 4 * m->n_guessed_speeds);
  e.states = frot_larger(e.states, l->nw);
  for (int k = 0; k < m->n_groups; k++) {
    const frot_group *g = &m->groups[k];
    e.widest = frot_larger(e.widest, g->n), e.across = frot_larger(e.across, g->n);
    e.square = frot_larger(e.square, g->n + g->n_rows + g->n_contacts);
  }
  for (int i = 0; i < m->n_parts + m->n_speed_parts; i++) {
    const frot_part *part = part_of(m, i);
    int count = part->n_stated + part->n_contacts + 4 * part->n_guessed;
    for (int k = 0; k < part->n_groups; k++) count += m->groups[part->groups[k]].n_rows;
    e.square = frot_larger(e.square, count), e.across = frot_larger(e.across, part->n_unknowns);
    e.slopes = frot_larger(e.slopes, count * part->n_unknowns);
  }
  if (m->n_invariants > 0)
    e.square = frot_larger(e.equations, l->nw), e.across = e.states,
    e.slopes = e.states * e.equations;
  for (int i = 0; i < m->n_blocks; i++) e.block = frot_larger(e.block, m->blocks[i].count);
  return e;
}

/* The most that a part takes: unknowns, unknowns of blocks that follow from these, all that its
 * functions read. */
static frot_part largest_part(const frot_model *m) {
  frot_part most = {0};
  for (int i = 0; i < m->n_parts + m->n_speed_parts; i++) {
    const frot_part *k = part_of(m, i);
    int read = frot_count_reads(&k->reads) + k->ny;
    most.n_unknowns = frot_larger(most.n_unknowns, k->n_unknowns);
    most.n_turns = frot_larger(most.n_turns, k->n_turns), most.ny = frot_larger(most.ny, k->ny);
    most.n_own = frot_larger(most.n_own, k->n_own),
    most.reads.nq = frot_larger(most.reads.nq, read);
    most.n_stated = frot_larger(most.n_stated, k->n_stated);
    most.n_contacts = frot_larger(most.n_contacts, k->n_contacts);
  }
  return most;
}

/* The scratch that any of the generated functions needs. */
static frot_callable scratch_of_all(const frot_model *m) {
  const frot_callable *calls[] = {
      &m->parameters, &m->start,    &m->beginning, &m->kinematics, &m->beginnings, &m->places,
      &m->pace,       &m->dynamics, &m->drives,    &m->spread,     &m->rates,      &m->jacobian,
      &m->invariants, &m->update,   &m->sizes,     &m->variables,  &m->energy,     &m->timers,
      &m->impulses,   &m->sensed,   &m->watched,   &m->vanishing,  &m->terms,      &m->orders};
  int count = (int)(sizeof calls / sizeof *calls);
  frot_callable most = {NULL, 11, 11, 0, 0};
  for (int i = 0; i < count + 2 * m->n_blocks; i++) {
    const frot_callable *call = i < count ? calls[i] : NULL;
    if (i >= count) {
      const frot_block *block = &m->blocks[(i - count) / 2];
      call = (i - count) % 2 ? &block->switching : &block->residual;
    }
    most.n_arg = frot_larger(most.n_arg, call->n_arg),
    most.n_res = frot_larger(most.n_res, call->n_res);
    most.n_iw = frot_larger(most.n_iw, call->n_iw), most.n_w = frot_larger(most.n_w, call->n_w);
  }
  for (int i = 0; i < m->n_islands; i++) {
    const frot_island *k = &m->islands[i];
    const frot_callable *own[] = {&k->kinematics, &k->dynamics, &k->spread, &k->sizes};
    for (int j = 0; j < 4; j++)
      most.n_iw = frot_larger(most.n_iw, own[j]->n_iw),
      most.n_w = frot_larger(most.n_w, own[j]->n_w);
  }
  for (int i = 0; i < m->n_parts + m->n_speed_parts; i++) {
    const frot_part *k = part_of(m, i);
    const frot_callable *own[] = {&k->stating, &k->guessing, &k->sides, &k->slopes};
    for (int j = 0; j < 4; j++)
      most.n_iw = frot_larger(most.n_iw, own[j]->n_iw),
      most.n_w = frot_larger(most.n_w, own[j]->n_w);
  }
  return most;
}

static void bind_call(const frot_model *m, const frot_layout *l, frot_call_work *w, frot_arena *a) {
  frot_callable most = scratch_of_all(m);
  TAKE(w->arg, most.n_arg), TAKE(w->res, most.n_res), TAKE(w->iw, most.n_iw);
  TAKE(w->w, most.n_w), TAKE(w->inputs, m->nu);
  int told = frot_larger(m->n_watched, (1 + FROT_WHERE) * m->n_vanishing);
  TAKE(w->values, frot_larger(m->np, l->nw) + m->n_checks + m->nq + m->nv + m->n_loads + told);
}

static void bind_search(const frot_model *m, frot_search_work *w, frot_arena *a) {
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
  TAKE(w->others, m->n_rows), TAKE(w->given, nc + ne);
  w->list = NULL;
  if (m->lists_motions) w->list = frot_take(a, 1, frot_motions_bytes(m, FROT_MOST_LISTED, 0));
  TAKE(w->beyond, 2 * (nc + ne)), TAKE(w->closable, nc + ne), TAKE(w->moved_from, m->nq + m->nv);
  for (int k = 0; a->base && k < m->nv; k++) w->nothing_frozen[k] = 0;
  if (!frot_has_vectors(m)) return;
  int widest = 0;
  for (int k = 0; k < m->n_groups; k++) widest = frot_larger(widest, m->groups[k].n_rows);
  TAKE(w->problem, widest * (widest + 2) + frot_contact_springs_doubles(widest));
  TAKE(w->reactions_found, 4 * nr), TAKE(w->blocks, nc + ne + nr), TAKE(w->block_of, nc + ne + nr);
  TAKE(w->row_of, nr), TAKE(w->pivot, frot_contact_newton_integers(widest));
}

static void bind_share(const frot_model *m, const frot_layout *l, const frot_extent *e,
                       frot_share_work *w, frot_arena *a) {
  /* of a contact four edges at most, of another row two columns */
  int columns = 0, rows = 0, items = 0;
  for (int k = 0; k < m->n_groups; k++) {
    const frot_group *g = &m->groups[k];
    int own = 4 * g->n_contacts + 2 * g->n_rows, across = g->n + g->n_contacts;
    columns = frot_larger(columns, own), rows = frot_larger(rows, across);
    items = frot_larger(items, across * (own + 1));
  }
  TAKE(w->tableau, items), TAKE(w->columns, items);
  TAKE(w->growth, l->nw), TAKE(w->normal, e->widest), TAKE(w->basic, rows);
  TAKE(w->contact, columns), TAKE(w->edge, columns), TAKE(w->read, m->n_contacts);
  TAKE(w->before, m->n_contacts + m->n_elements);
}

static void bind_impacts(const frot_model *m, frot_impact_work *w, frot_arena *a) {
  int nr = m->n_rows, blocks = m->n_contacts + m->n_elements + nr, widest = 0, part = 0;
  for (int i = 0; i < m->n_contacts; i++)
    part |= m->contacts[i].row_n >= 0 && !m->contacts[i].reduced;
  if (!part && m->n_percussions == 0) return;
  for (int k = 0; k < m->n_groups; k++) widest = frot_larger(widest, m->groups[k].n_rows);
  widest++, blocks++; /* of a percussion */
  TAKE(w->lost, blocks), TAKE(w->listed, blocks), TAKE(w->held, widest), TAKE(w->blocks, blocks),
      TAKE(w->block_of, blocks), TAKE(w->row_of, nr + 1);
  TAKE(w->pivot, frot_impact_integers(widest)), TAKE(w->problem, widest * widest);
  TAKE(w->before, widest), TAKE(w->after, widest), TAKE(w->impulse, widest);
  TAKE(w->changes, m->nv + m->na + m->nc), TAKE(w->scratch, frot_impact_doubles(widest, blocks));
  TAKE(w->meets, m->n_contacts), TAKE(w->met, m->n_contacts);
  TAKE(w->struck_rows, nr), TAKE(w->struck, m->nv + m->na + m->nc),
      TAKE(w->moving, m->nv + m->na + m->nc);
}

static size_t bind(const frot_model *m, frot_work *w, char *base) {
  frot_layout l = frot_layout_of(m);
  frot_extent e = extent_of(m, &l);
  frot_arena held = {base, sizeof(frot_work)}, *a = &held;
  w->layout = l;
  bind_call(m, &l, &w->call, a);
  frot_bind_awake(m, &l, &w->awake, a);
  frot_bind_blocks(m, &e, &w->blocks, a);
  frot_bind_core(m, &l, &w->core, a);
  frot_bind_wide(m, &l, &w->wide, a);
  frot_bind_reactions(m, &w->reactions, a);
  frot_bind_span(m, &e, &w->span, a);
  frot_bind_relations(m, &l, &e, w, a);
  frot_part largest = largest_part(m);
  frot_bind_opening(m, &largest, &e, &w->opening, a);
  frot_bind_guards(m, &l, &w->guards, a);
  frot_bind_step(m, &l, &w->step, a);
  frot_bind_posture(m, &w->step, a);
  frot_bind_sizes(m, &w->sizes, a);
  frot_bind_implicit(m, &w->implicit, a);
  frot_bind_events(m, frot_has_edges(m), &w->events, a);
  frot_bind_nearer(m, &w->nearer, a);
  bind_search(m, &w->search, a);
  bind_share(m, &l, &e, &w->share, a);
  bind_impacts(m, &w->impacts, a);
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
