/* The modes of contacts and elements at an instant: the admissible motions of a component. */
#ifndef FROT_ENUMERATION_H
#define FROT_ENUMERATION_H

#include "model/workspace.h"

/* An instant at which modes are looked for, after frot_dynamics (FROT_LAWS) and frot_row_loads. */
typedef struct {
  const frot_model *m;
  frot_state *s;
  frot_work *w;
  frot_layout l;
  const double *fired, *unilateral;
  const double *left;     /* n_elements: direction in which a rest was left at this instant */
  const double *vanished; /* n_contacts: terms in which a reaction came to zero at this instant */
  unsigned char *zero;    /* n_elements: its motion is zero */
  unsigned char *at_rest; /* n_elements: and it has not departed: it may stay at rest */
  /* n_elements: what slips from now on is resisted by the friction of rest; NULL: of motion */
  const unsigned char *resists;
  double t;
  const double *q, *v;
  double slight; /* part of its usual speed below which a slip is none, 0: rounding says */
  /* cosine and sine by which directions of pins' reactions are turned at the start of a search;
   * NULL: 1, 0 */
  const double *turn;
  /* modes that are known, of which only the reactions are looked for; NULL: none are */
  const frot_contact_mode *given;
} frot_instant;

/* The instant at (t, q, v), nothing known of it. */
frot_instant frot_instant_at(const frot_model *m, frot_state *s, frot_work *w, double t,
                             const double *q, const double *v);

/* Whether a law's coefficients can ever bound anything: a constant zero is skipped. */
int frot_bounds_something(const frot_model *m, const frot_work *w, int element);

/* Directions that the pins' reactions are looked for from, into w->reactions.along: those of the
 * state, turned by `turn`. */
void frot_begin_directions(const frot_instant *in);

/* Whether the reactions of w->search.trial over `count` contacts `chosen` satisfy every inequality.
 * Where they are not unique, sets those elements at their bounds and those contacts without load
 * that let the others carry. */
int frot_is_admissible(const frot_instant *in, const int *chosen, int count);

/* Whether the inequalities of its laws, once they hold, do so but for rounding. Slack admits more:
 * where terms cancel, motions that the next step takes back. */
int frot_is_exact(const frot_instant *in, const int *chosen, int count);
/* The same of one element. */
int frot_element_is_exact(const frot_instant *in, int e);

/* The margin of a bound when an element holds, over its size: negative beyond the slack. */
double frot_reserve(const frot_instant *in, int element);
/* The same of a contact that must press. */
double frot_pressure(const frot_instant *in, int contact);
/* Whether the reactions as they are satisfy every inequality of the contacts. */
int frot_reactions_hold(const frot_instant *in, const int *chosen, int count);

/* Where frot_is_admissible has found that some elements, of which the accelerations say nothing, go
 * against their modes after the look-ahead interval: give them the slip that they have then.
 * Returns whether there are any. */
int frot_follow_ahead(const frot_instant *in, const frot_group *g);

/* Where reactions are not unique: whether they hold with some elements at their bounds and some
 * contacts without load, which are set in w->search.trial (load_sharing_vertices.c). */
int frot_others_carry(const frot_instant *in, const int *chosen, int count);

/* Where reactions are not unique and those of frot_is_admissible do not last: whether others do,
 * with elements at their bounds and contacts without load, which are set in w->search.trial. */
int frot_others_last(const frot_instant *in, const int *chosen, int count);

/* Whether every law of a contact holds in w->search.trial, so that the side it is pressed on
 * follows from its reaction. */
int frot_all_held(const frot_instant *in, int contact);

/* Whether the reaction of a contact in w->search.trial has the sign of its side: it can part, or
 * friction that slips follows it. */
int frot_must_press(const frot_instant *in, int contact);

/* The side of a contact that its reaction presses on is the other: friction at its bound, whose
 * line goes through zero with the reaction, turns with it. */
void frot_flip_normal_sign(const frot_instant *in, int contact);

/* The margin of an inequality of w->search.trial, over the size of its terms, negative where it
 * does not hold: of a contact that presses or parts, of an element that rests or starts to slip; 1
 * where there is none (persistence.c). */
double frot_margin_of_contact(const frot_instant *in, int contact);
double frot_margin_of_element(const frot_instant *in, int element);

/* Whether the motion of w->search.trial, which frot_is_admissible has found good, lasts: what is
 * zero in it at the instant is not past its bound after the look-ahead interval (persistence.c).
 * Gives a reaction that may have either sign the one it has then. */
int frot_lasts(const frot_instant *in, const int *chosen, int count);

/* Whether the group is at rest, but for what loads bring in a rounding of time, and the
 * accelerations are what rounding leaves of loads that cancel (slip_lookahead.c). */
int frot_group_rests(const frot_instant *in, const frot_group *g);

/* Whether the group, which rests at the instant, starts to move in w->search.trial as loads grow;
 * then w->core.a are its accelerations after the look-ahead interval, all else is at the instant
 * (persistence.c).
 */
int frot_sets_out(const frot_instant *in, const frot_group *g);

/* Share the load of w->search.trial among the contacts `chosen` and their stuck elements, so that
 * reactions are unique and each within its bounds: sets those at their bounds and those without
 * load. FROT_SHARE_UNKNOWN: reactions are unique already, or friction follows what is no cone; then
 * and where there is no share the modes stay (load_sharing_lp.c). */
enum frot_share { FROT_SHARE_UNKNOWN, FROT_NO_SHARE, FROT_SHARED };
enum frot_share frot_share_load(const frot_instant *in, const int *chosen, int count);
/* The same for the load and the place after the look-ahead interval, as the modes move on there: a
 * share that holds now may have an edge that is zero and decreases. Returns whether it is shared
 * (persistence.c).
 */
int frot_share_later(const frot_instant *in, const int *chosen, int count);
/* Whether the contacts, all at rest before the instant, stay so with their load shared in another
 * way; then these modes are in w->search.best. */
int frot_rest_goes_on(const frot_instant *in, const int *chosen, int count);

/* How loads grow from the instant on, into w->share.growth, where nothing moves; else zero.
 * Returns whether the dynamics are now those after the look-ahead interval. */
int frot_find_growth(const frot_instant *in, const double *d);

/* The signs of the slips after the look-ahead interval, moving on as w->search.trial and
 * w->core.lam say, into w->search.ahead (n_elements): 0 where a motion stays none. Leaves the
 * kinematics at the instant (slip_lookahead.c). */
int frot_look_ahead(const frot_instant *in, const frot_group *g);

/* Time in which the fastest coordinate of the group has gone a part of a radian or of its length,
 * usually FROT_WAY; 0 when nothing moves. */
#define FROT_WAY 1e-3
double frot_time_of_way(const frot_instant *in, const frot_group *g, double part);

/* Looks for the modes of the contacts `chosen`, which act on each other only and are closed in
 * w->search.best; leaves those preferred there. Every combination is examined where there are
 * few; else one motion is found by pivoting and only what stays ambiguous is examined, and
 * *unsearched is set. `forced`: what fired must change; `lasting`: what does not last is left out.
 * Returns the number of motions. */
int frot_search(const frot_instant *in, const int *chosen, int count, int forced, int lasting,
                int *unsearched);

/* The same of motions that last, whatever has fired, with corners of reactions examined from the
 * start. */
int frot_search_corners(const frot_instant *in, const int *chosen, int count, int *unsearched);

/* A first guess of the modes of many contacts into w->search.trial, and into `certain` (n_contacts)
 * whether a contact's are beyond doubt (box_qp.c). `ends`: a rest ends, so that what is just at its
 * bound is past it. `later`: for the load after the look-ahead
 * interval. */
void frot_guess_modes(const frot_instant *in, const int *chosen, int count, int ends, int later,
                      unsigned char *certain);
/* Whether all rests in the group of a contact and its load grows. */
int frot_loads_grow(const frot_instant *in, int contact);

/* Change the modes of w->search.trial one by one, the worst first, until they are admissible;
 * `forced` as in frot_search. Returns whether they are (principal_pivoting.c). */
int frot_mend_modes(const frot_instant *in, const int *chosen, int count, int forced);
/* Keep the modes of w->search.trial of the contacts `chosen` as those preferred. */
void frot_remember_modes(const frot_instant *in, const int *chosen, int count);

/* Change what is violated in w->search.trial: contact k, or element k - n_contacts. Returns 0 where
 * that may not be. */
int frot_change_mode(const frot_instant *in, int k, int forced);

#endif
