/* Scratch of the search for modes (modes/) and of impacts (impacts/). */
#ifndef FROT_SEARCH_WORKSPACE_H
#define FROT_SEARCH_WORKSPACE_H

#include "contact/cone_point.h"
#include "contact/contact_newton.h"
#include "contact/impact_law.h"
#include "model/state.h"

/* `modes` are those of n_contacts + n_elements. */
typedef struct {
  frot_contact_mode *trial;       /* modes under test */
  frot_contact_mode *best;        /* modes found so far that are preferred */
  frot_contact_mode *before;      /* modes before the instant */
  frot_contact_mode *guess;       /* modes that the box problem guesses: box_qp.c */
  frot_contact_mode *guess_ahead; /* modes after a short time: slip_lookahead.c */
  frot_contact_mode *corner;      /* modes of a corner of the reactions: load_sharing_vertices.c */
  frot_contact_mode *idle;        /* twice: modes before friction that does nothing is bounded */
  frot_contact_mode *found;       /* modes put aside while others are tried: departures.c */
  frot_contact_mode *slack;       /* modes of a motion that holds by slack alone */
  frot_contact_mode *closable;    /* modes: which contacts may be closed after the instant */
  frot_contact_mode *given;       /* modes of the motion taken from the list: listed_motions.h */
  unsigned char *certain;         /* n_contacts: the box problem leaves no doubt of its mode */
  unsigned char *zero;            /* n_elements: its slip is zero */
  unsigned char *at_rest;         /* n_elements: it is zero, and the element has not departed */
  unsigned char *departs;         /* n_elements: its slip starts by posture, not by acceleration */
  signed char *ahead;             /* n_elements: sign of its slip after a short time, 0: none */
  double *motions;                /* FROT_MOTIONS x n_rows: accelerations of rows of each motion */
  double *pivot_bound;            /* 3 n_rows: bounds of the box problem, its right side */
  double *nothing_frozen;         /* nv: zeros */
  double *margin;                 /* modes: relative margin of each inequality, 1: inactive */
  double *rates;                  /* nq: rates of the coordinates at the instant: persistence.c */
  double *set_out;                /* nv: accelerations of a motion that departs as loads grow */
  double *others;                 /* n_rows: reactions of other components */
  double *beyond;                 /* 2 modes: by how much inequalities do not hold */
  double *moved_from;             /* nq + nv: states before they are settled: resolve.c */
  double *along;                  /* FROT_BOUNDING n_elements: directions of reactions in `best` */
  double *problem;                /* rows x (rows + 2): contact problem of a component */
  double *reactions_found;        /* 4 n_rows: reactions of its solutions: contact_search.c */
  frot_contact_block *blocks;     /* its blocks */
  int *row_of;                    /* n_rows: row of the core of each row of it */
  int *block_of;                  /* element of each block, or -1 */
  int *pivot;                     /* integers of its solver */
  int *choice;                    /* 4 modes: options of each digit of the enumeration */
  int *component;                 /* n_contacts: component of each contact, -1: none */
  int *chosen;                    /* n_contacts: the contacts of a component */
  int exact;                      /* 1: `best` needs no slack: frot_is_exact */
  int lasts;                      /* 1: `best` lasts: frot_lasts */
  int falls;                      /* index + 1 of the inequality of `trial` that fails after a
                                     short time within slack, or of a slip that begins and does
                                     not grow; 0: none */
  int fades;                      /* the same of `best` */
  int against;                    /* elements whose slip contradicts the mode found good */
  int corners;                    /* corners that this search may still evaluate */
  void *list;                     /* memory of a list of motions, NULL: none is made */
} frot_search_work;

/* load_sharing_lp.c. */
typedef struct {
  double *tableau;           /* items of the simplex tableau, by rows */
  double *columns;           /* the same before the first exchange */
  double *growth;            /* nw: rate of the loads where nothing moves: frot_find_growth */
  double *normal;            /* unknowns of a group: a normal reaction with its friction */
  int *basic;                /* rows: the basic column of each */
  int *contact;              /* columns: the contact of each */
  signed char *edge;         /* columns: which edge of its friction cone */
  unsigned char *read;       /* n_contacts: its columns are formed */
  frot_contact_mode *before; /* modes before the load is shared */
} frot_share_work;

/* The impact of a component, of `rows` rows: impacts.h. Impulses in N s, N m s. */
typedef struct {
  frot_impact_block *blocks;  /* blocks of the impact law */
  frot_contact_block *listed; /* the same as they are listed: reactions/contact_blocks.h */
  frot_contact_block *held;   /* rows: blocks that hold contacts that have settled */
  int *row_of;                /* rows: row of the core */
  int *block_of;              /* element of each block, ~i: of contact i */
  int *pivot;                 /* integers of its solver */
  double *problem;            /* rows x rows: speeds that unit impulses give */
  double *before, *after;     /* rows: speeds before and after the impact */
  double *impulse;            /* rows */
  double *lost;               /* blocks: work that each takes, J */
  double *changes;            /* unknowns of the core: changes of speeds by the impulses */
  double *scratch;            /* doubles of its solver */
  unsigned char *meets;       /* n_contacts: the contact closes with speed */
  unsigned char *met;         /* n_contacts: it has done so at this instant */
  double *struck_rows;        /* n_rows: changes of the rows by percussions alone */
  double *struck;             /* unknowns of the core: changes of speeds by them */
  double *moving;             /* unknowns of the core: zeros, no speed is frozen */
} frot_impact_work;

#endif
