/* Every number by which the kernel calls something zero, equal, settled or enough, with its
 * meaning.
 *
 * Three kinds: what rounding can do (a few units of the last place, times the sizes of the terms),
 * what counts as zero at an event (a root found is no better than the step that found it), and what
 * ends a search. All are relative: each is multiplied by the sizes of the terms compared. */
#ifndef FROT_TOLERANCES_H
#define FROT_TOLERANCES_H

#include <float.h>

/* -- rounding ---------------------------------------------------------------------------------- */
/* A sum of terms that cancel to less than this part of their sizes is zero. */
#define FROT_ROUNDING (4 * DBL_EPSILON)
/* Part by which values are moved to see what rounding does to derivatives, and how much larger than
 * what is seen the noise is taken to be. */
#define FROT_NUDGE (2 * DBL_EPSILON)
#define FROT_NOISE_MARGIN 8.0
/* Part by which values are moved apart to see the rounding of the evaluation itself. */
#define FROT_APART (1024 * DBL_EPSILON)
/* The same for states whose rates no inertia smooths. */
#define FROT_NOISE_OF_RATES 32.0
/* Least tolerance of a step: below, rounding decides. */
#define FROT_LEAST_TOLERANCE 2e-15

/* -- zero at an event -------------------------------------------------------------------------- */
/* Part of its size below which a velocity, a gap or a reaction is zero. */
#define FROT_ZERO 1e-11
/* A rate against what the speed of its row could be, were all kinetic energy in it. */
#define FROT_ZERO_OF_MOTION 1e-14
/* Part of the usual speed below which an approach is no impact. */
#define FROT_TOUCH 1e-9
/* Guards are looked at from this part of their size on. */
#define FROT_GUARD_FLOOR 1e-12
/* Prescribed rates and their rates below this are rest (SI): there is nothing to compare with. */
#define FROT_PRESCRIBED_REST 1e-12
/* Events closer than this part of the time are at one instant. */
#define FROT_ONE_INSTANT 1e-13

/* -- systems ----------------------------------------------------------------------------------- */
/* Sine of the angle between a row and the rows before it below which it depends on them. */
#define FROT_DEPENDENT 1e-9
/* Dependent rows agree when their accelerations differ by less than this part of their terms. */
#define FROT_AGREES 1e-9
/* Pivot of a scaled square system below which it is singular. */
#define FROT_SINGULAR_PIVOT 1e-14
/* What friction weighs against normal reactions where reactions are not unique. */
#define FROT_FRICTION_WEIGHT 1e-5
/* Passes of Newton's method on the directions of pins' reactions. */
#define FROT_PIN_PASSES 60
/* Part of a pin's reaction missed below which the next pass, twice as exact, is the last. */
#define FROT_PIN_CLOSE 1e-9

/* -- admissible motions ------------------------------------------------------------------------ */
/* A bound may be passed, a reaction be negative by this part of its terms. */
#define FROT_BOUND_SLACK 1e-10
/* A departing motion may accelerate the wrong way by this part of its terms. */
#define FROT_DEPARTURE_SLACK 1e-9
/* Motions differ when accelerations differ by this part of their terms. */
#define FROT_DIFFERENT 1e-8
/* Combinations of modes examined one by one; beyond, one motion is looked for by pivoting. */
#define FROT_ENOUGH 2500

/* Motions told apart at one instant; more are counted as this many. */
#define FROT_MOTIONS 32

#endif
