#include "mode_choice/choose_modes.h"

#include <string.h>

#include "evaluation/evaluate.h"
#include "evaluation/fault_source.h"
#include "mode_choice/listed_motions.h"
#include "modes/contact_components.h"
#include "modes/departures.h"
#include "recording/event_log.h"

/* Whether nothing in the group of a contact can part or has friction: its relations alone leave no
 * motion, as where they depend on each other and the speeds do not agree. */
static int only_loops(const frot_instant *in, int contact) {
  const frot_group *g = &in->m->groups[in->m->contact_group[contact]];
  for (int i = 0; i < g->n_contacts; i++)
    if (in->unilateral[g->contacts[i]] != 0) return 0;
  return g->n_elements == 0;
}

/* Whether the modes have ended for want of reactions beyond the instant, and no others last: a
 * motion in them would be one of rounding, beyond a pole. */
static int has_jammed(const frot_instant *in, int contact) {
  return !in->w->search.lasts && in->s->jammed_at == in->t &&
         in->s->jammed == in->m->contact_group[contact];
}

/* The part of the model in which a contact is. */
static int part_of(const frot_model *m, int contact) {
  for (int part = 0; part < frot_parts_of(m); part++) {
    int first, end;
    frot_groups_of_part(m, part, &first, &end);
    if (m->contact_group[contact] >= first && m->contact_group[contact] < end) return part;
  }
  return -1;
}

/* Why a component has no motion: the status of the fault recorded. */
static int fail_without_motion(const frot_instant *in, int contact, int count, int unsearched) {
  const frot_model *m = in->m;
  int fault = unsearched ? FROT_TOO_LARGE : only_loops(in, contact) ? FROT_POSTURE : FROT_IMPASSE;
  int apart = -1;
  if (fault == FROT_POSTURE)
    apart = frot_contact_opened_by_time(m, in->s, in->w, in->t, in->q, in->v);
  if (apart >= 0) return frot_fail(in->s, FROT_DIVERGE, in->t, apart, 0, -1, 0);
  int begins = fault == FROT_POSTURE && in->s->statistics.steps == 0; /* fault_messages.c */
  return frot_fail(in->s, fault, in->t, contact, -1, -1, begins ? 0 : count);
}

/* The list of a part, and the motion that is preferred, or -1; `pins`: laws of pins are listed. */
typedef struct {
  frot_motions_memory memory;
  int part, preferred, pins;
} part_list;

/* The modes of a component from the list of its part. Returns how many motions it has. */
static int find_listed(const frot_instant *in, part_list *list, int pins, const int *chosen,
                       int count) {
  int part = part_of(in->m, chosen[0]);
  if (!in->w->search.list) return 0;
  if (part != list->part || pins != list->pins)
    list->preferred = frot_list_part(in, &list->memory, part, pins);
  list->part = part, list->pins = pins;
  if (list->preferred < 0) return 0;
  return frot_take_motion(in, &list->memory, list->preferred, chosen, count);
}

/* Whether the list of the part of a component is complete and empty. */
static int none_listed(const frot_instant *in, const part_list *list, const int *chosen) {
  return list->preferred == FROT_NONE_LISTED && list->part == part_of(in->m, chosen[0]);
}

/* The modes of a component into w->search.best, from the list of its part, or else by enumeration;
 * where that finds none beside dry pins, from the list of all their sectors. Returns how many
 * motions it has. */
static int find_motions(const frot_instant *in, part_list *list, const int *chosen, int count,
                        int *unsearched) {
  frot_note_others(in, chosen, count);
  if (frot_slips_in_space(in, chosen, count)) return frot_find_contact_motion(in, chosen, count);
  int motions = find_listed(in, list, 0, chosen, count);
  if (motions == 0) motions = frot_look_for_motions(in, chosen, count, unsearched);
  /* neither at the instant nor after a short time */
  if (none_listed(in, list, chosen) && !in->w->search.lasts) return 0;
  if (motions == 0) motions = find_listed(in, list, 1, chosen, count);
  return motions;
}

int frot_choose_modes(const frot_instant *in, double t, int first, frot_recorder *recorder) {
  const frot_model *m = in->m;
  frot_work *w = in->w;
  int several = 0, several_at = -1;
  if (first) memset(in->s->data + in->l.several, 0, sizeof(double) * (size_t)m->n_contacts);
  in->s->fleeting = -1;
  /* of components that are searched later no reactions are known */
  memset(w->core.lam, 0, sizeof(double) * (size_t)m->n_rows);
  frot_find_components(in);
  part_list list;
  list.part = list.preferred = -1, list.pins = 0;
  if (w->search.list) frot_begin_list(in, &list.memory);
  for (int root = 0; root < m->n_contacts; root++) {
    int *chosen = w->search.chosen, count = 0, unsearched = 0;
    for (int i = 0; i < m->n_contacts; i++)
      if (w->search.component[i] == root) chosen[count++] = i;
    if (count == 0) continue;
    int motions = find_motions(in, &list, chosen, count, &unsearched);
    in->s->statistics.unsearched += unsearched;
    if (!w->search.lasts) in->s->fleeting = chosen[0];
    if (motions > 0 && has_jammed(in, chosen[0])) return FROT_DIVERGE;
    if (motions == 0) return fail_without_motion(in, chosen[0], count, unsearched);
    if (motions < 2) continue;
    if (!several) several = motions, several_at = chosen[0];
    if (!first)
      frot_record_event(recorder, in->s, t, FROT_EVENT_SEVERAL, chosen[0],
                        frot_mode_value(m, w->search.before, chosen[0]),
                        frot_mode_value(m, w->search.best, chosen[0]), motions);
    else
      in->s->several = 1, in->s->data[in->l.several + chosen[0]] = motions; /* told at once after */
  }
  if (several && in->s->options.on_indeterminate == FROT_HALT)
    return frot_fail(in->s, FROT_SEVERAL, t, several_at, -1, -1, several);
  return FROT_OK;
}
