/* Every number by which the kernel calls something zero, equal, settled or enough, with its
 * meaning.
 *
 * Three kinds: what rounding can do (a few units of the last place, times the sizes of the terms),
 * what counts as zero at an event (a root found is no better than the step that found it), and what
 * ends a search. All are relative: each is multiplied by the sizes of the terms compared. */
#ifndef FROT_TOLERANCES_H
#define FROT_TOLERANCES_H

#include <float.h>
#include <math.h>

/* -- rounding ---------------------------------------------------------------------------------- */
/* A sum of terms that cancel to less than this part of their sizes is zero. */
#define FROT_ROUNDING (4 * DBL_EPSILON)
/* Part of the lengths of a gap that is none. */
#define FROT_FLUSH (64 * DBL_EPSILON)
/* Part by which values are moved to see what rounding does to derivatives, and how much larger than
 * what is seen the noise is taken to be. */
#define FROT_NUDGE (2 * DBL_EPSILON)
#define FROT_NOISE_MARGIN 8.0
/* Part by which values are moved apart to see the rounding of the evaluation itself. */
#define FROT_APART (1024 * DBL_EPSILON)
/* The same for states whose rates no inertia smooths. */
#define FROT_NOISE_OF_RATES 32.0
/* An inertia beside that of what it carries, or its rest when all that can follow is
 * eliminated: where that is so many times less, it is found in wide numbers. */
#define FROT_HEAVY 1e5
/* Part of the lengths a row is made of below which it is what rounding leaves of them. */
#define FROT_CANCELS 1e-12
/* Part of the terms of energies, forces times the places where they act, below which no energy
 * differs from rounding: a ten thousandth of it is some dozens of the last places of these. */
#define FROT_LEAST_ENERGY 1e-10
/* Part by which a gap or a statement may change with the unknowns and still be constant. */
#define FROT_CONSTANT 1e-12
/* Part of the lengths a gap is made of, and of 1 in SI, for those that time prescribes are not
 * among them, by which it may be off, or change in a second, though no unknown moves it. */
#define FROT_MOVED_BY_TIME 1e-9
/* Residual of a statement, in what its unknowns could change in it, that no digit of them mends. */
#define FROT_NO_DIGIT 1e-14
/* Part of what it is made of by which a value that time alone changes is constant in a step. */
#define FROT_STEADY 1e-12
/* Error of the squared length of a quaternion that products and sums leave. */
#define FROT_UNIT_SQUARE (8 * DBL_EPSILON)
/* Angle by which rounding may turn the direction of a weak row. */
#define FROT_MOST_TILT 1e-7
/* The same at the start of a step, whose speeds were put onto the relations there. */
#define FROT_MOST_TILT_AT_START 1e-8

/* -- steps ------------------------------------------------------------------------------------- */
/* Part of the tolerance given to one step, so that the whole run keeps it: of the explicit method,
 * and of the implicit one, whose estimate is that of the order below. */
#define FROT_EXPLICIT_SHARE 0.1
#define FROT_IMPLICIT_SHARE 0.5
/* Least tolerance of a step of either: below, rounding decides. */
#define FROT_LEAST_TOLERANCE 2e-15
#define FROT_LEAST_IMPLICIT 1e-14
/* Estimates below this, over their bound, do not keep the next step from being longer. */
#define FROT_LIMITING 1e-4
/* A guard need only be followed well enough to see where it goes: to ten tolerances, between these
 * parts of its size. */
#define FROT_GUARD_LOOSEST 1e-3
#define FROT_GUARD_TIGHTEST 1e-6
static inline double frot_guard_tolerance(double tolerance) {
  return fmin(FROT_GUARD_LOOSEST, fmax(FROT_GUARD_TIGHTEST, 10 * tolerance));
}

/* Part of a step before which a guard that is zero at its start is examined in a shorter one. */
#define FROT_EARLY 0.1
/* Part of the most that a state has been below which its size never decreases. */
#define FROT_LEAST_WORTH 1e-30
/* Relative error that rounding may make in a step through a singular posture. */
#define FROT_MOST_BLUR 1e-9
/* Part of the kinetic energy that a projection there may take. */
#define FROT_MOST_LOST 1e-6
/* Time beyond which events no longer crowd, in longest steps. */
#define FROT_CROWDED_STEPS 1e-9
/* Time from which on steps are measured by its resolution, in longest steps. */
#define FROT_LEAST_TIME 1e-12
/* Length of the first step at least, in longest steps. */
#define FROT_FIRST_LEAST 1e-6
/* Part of the time reached below which a step makes no progress. */
#define FROT_LEAST_STEP (16 * DBL_EPSILON)
/* The least resolution of time, s. */
#define FROT_FINEST_TIME 1e-15

/* -- zero at an event -------------------------------------------------------------------------- */
/* Part of its size below which a velocity, a gap or a reaction is zero. */
#define FROT_ZERO 1e-11
/* A rate against what the speed of its row could be, were all kinetic energy in it. */
#define FROT_ZERO_OF_MOTION 1e-14
/* Part of the usual speed below which an approach is no impact. */
#define FROT_TOUCH 1e-9
/* A flight between two impacts, its speed times its duration, eight times its height, over the
 * lengths of the gap, is none below this: gaps lower than FROT_LOCATED do not differ from contact.
 */
#define FROT_LEAST_FLIGHT 4e-9
/* Flights whose durations are in no larger ratio end in finite time. */
#define FROT_ENDING 0.9999
/* Guards are examined from this part of their size on. */
#define FROT_GUARD_FLOOR 1e-12
/* Part of its size that rounding may hide at most: of a guard, of what moves in a step. */
#define FROT_DROWNED 1e-3
/* A located guard below this part of its size has fallen; above, it was a dip. */
#define FROT_LOCATED 1e-9
/* Part of its largest size by which a condition is off zero by rounding: far below
 * FROT_GUARD_FLOOR, so that what counts as fallen does not fall again. */
#define FROT_CONDITION_ZERO 4e-15
/* The same at another evaluation at one instant: it is still the value that was decided on. */
#define FROT_UNCHANGED 1e-13
/* Part of its size in the next step by which a condition moves that has no rate. */
#define FROT_FLAT 1e-10
/* Part of its largest size below which a pin's reaction has no direction. */
#define FROT_NO_DIRECTION 1e-9
/* Events of the text that follow each other in one ratio, to this part of it, have a limit, and
 * crowd when their distance is this part of the first. */
#define FROT_ONE_RATIO 0.01
#define FROT_CROWDED 1e-5
/* Part of its terms to which the instant of an event resolves a reaction. */
#define FROT_RESOLVED 1e-6
/* Prescribed rates and their rates below this are rest (SI): there is nothing to compare with. */
#define FROT_PRESCRIBED_REST 1e-12
/* Events closer than this part of the time are at one instant. */
#define FROT_ONE_INSTANT 1e-13
/* What of an instant rounding and that part are parts of: near the start a part of the longest
 * step. */
static inline double frot_size_of_time(double t, double h_max) {
  return fmax(fabs(t), 1e-3 * h_max);
}
/* Distance, in m or radii, from a point without tangent or normal at which a failure is due to
 * it. */
#define FROT_TANGENT_LOST 1e-6
/* Part of the time by which a fault is sought beyond the instant at which steps shrink to zero. */
#define FROT_BEYOND_FAULT 1e-12
/* Part of the step from which on an other place is as good as reached at its end. */
#define FROT_AT_FEATURE_END (1 - 1e-6)
/* Part of its lengths by which figures that touch are in each other at another place. */
#define FROT_FEATURE_INSIDE 1e-11
/* Part of a step in which a condition moves as its slope at the start says. */
#define FROT_AT_ONCE 1e-6
/* Rounding of a slip of several components, in its terms. */
#define FROT_SLIP_FLOOR (32 * DBL_EPSILON)
/* Such a slip is zero below this part of its terms. */
#define FROT_SLIP_ZERO (1000 * DBL_EPSILON)
/* Part of the time within which a slip that ends has ended: steps cannot be that short. */
#define FROT_SLIP_INSTANT (4096 * DBL_EPSILON)
/* Part of its usual size that a slip has before, and leaves at, the instant at which another one
 * vanishes, where both vanish together. */
#define FROT_SLIP_SMALL 1e-6
/* Part of its usual size from which on a slip has grown: the third power of a tenth of it is no
 * error. */
#define FROT_SLIP_GROWS 1e-6
/* Part of its size below which a guard that is no condition is rounding. */
#define FROT_ROOT_RESOLVED (64 * DBL_EPSILON)
/* In steps, how near the end of the stages an instant is reached by the slope there and its
 * rate. */
#define FROT_NEXT_TO_END 1e-5
/* The same by the slope alone. */
#define FROT_NEXT_BY_SLOPE 1e-8

/* -- systems ----------------------------------------------------------------------------------- */
/* Sine of the angle between a row and the rows before it below which it depends on them. */
#define FROT_DEPENDENT 1e-9
/* The same inside a step, where rows are off by its error. */
#define FROT_DEPENDENT_INSIDE 1e-7
/* The same from which on a contact that bears nothing is not held by the others. */
#define FROT_NOT_HELD 1e-3
/* Dependent rows agree when their accelerations differ by less than this part of their terms. */
#define FROT_AGREES 1e-9
/* Pivot of a scaled square system below which it is singular. */
#define FROT_SINGULAR_PIVOT 1e-14
/* Part of the largest that a pivot on the diagonal has at least where it is taken all the same:
 * what a state does not depend on then does not reach it by rounding. */
#define FROT_ENOUGH_PIVOT 0.1
/* Part of the sizes of its terms that a pivot of a sparse factor must keep, and the term below
 * which digits are lost by underflow. */
#define FROT_LEAST_PIVOT 1e-9
#define FROT_LEAST_TERM 1e-280
/* A state beyond which squares of rates and of sizes come near the end of numbers. */
#define FROT_LARGEST 1e100
/* The same of what a text or its user gives: products of three moments of inertia are formed too.
 */
#define FROT_LARGEST_GIVEN 1e150
/* Part of the longest column's length below which the columns left of a matrix are rounding. */
#define FROT_RANK 1e-11
/* What friction weighs against normal reactions where reactions are not unique. */
#define FROT_FRICTION_WEIGHT 1e-5
/* Passes of Newton's method on the directions of pins' reactions. */
#define FROT_PIN_PASSES 60
/* Part of a pin's reaction missed below which the next pass, twice as exact, is the last. */
#define FROT_PIN_CLOSE 1e-9
/* Part of a unit speed outside the span of the rows that hold it. */
#define FROT_SPEED_LOCKED 1e-13
/* Part of |column| |f| below which the slope along an unknown is rounding. */
#define FROT_FLAT_SLOPE 1e-14
/* Part of the longest column below which a column is zero. */
#define FROT_NO_COLUMN 1e-13
/* Residual of the equations of reactions in cones, in their terms, that is settled. */
#define FROT_CONE_TOLERANCE 1e-12
/* Part of a bound by which reactions may pass it by rounding. */
#define FROT_CONE_SLACK 1e-12
/* Change of a friction by a pass, in the friction, that is none. */
#define FROT_FRICTION_ENOUGH (8 * DBL_EPSILON)
/* Change of a friction by a pass, in the friction, that rounding of its terms may be. */
#define FROT_FRICTION_ROUNDED 1e-12
/* Rounding of a bounding reaction whose terms cancel, in these: no pass mends it. */
#define FROT_FRICTION_TERMS (8 * DBL_EPSILON)
/* The same of a pin's reaction. */
#define FROT_PIN_ROUNDING (8 * DBL_EPSILON)
/* Part of the largest weight of friction that one without coefficient has. */
#define FROT_NO_WEIGHT 1e-8
/* Part of its terms below which the rate of a combination of rows is rounding, or lies among
 * them. */
#define FROT_TURNS_NOT 1e-6

/* -- equations --------------------------------------------------------------------------------- */
/* Residual of a block, in the sizes of its terms, that is a solution if nothing improves it; one
 * within FROT_ROUNDING always is. */
#define FROT_SETTLED 1e-9
/* Part of Newton's step below which nothing improves: in a block, at the start. */
#define FROT_LEAST_DAMPING 1e-12
#define FROT_LEAST_DAMPING_AT_START 1e-9
/* Size of a state for the projection, in the largest of its kind, while it is still small. */
#define FROT_LEAST_SIZE 1e-3
/* Error of the solution of a linear system, in its terms, that pivoting is missed by. */
#define FROT_GROWN 1e-10
/* Change, in sizes of the scene, that no statement asks for: what an equation does not depend on
 * but for rounding would be moved so far that the rounding there fits. */
#define FROT_FAR 1e10
/* Part by which a place must be nearer to be taken instead. */
#define FROT_NEARER 1e-6
/* A sum of squares that is zero. */
#define FROT_NOTHING_MISSED 1e-24
/* Part of the remaining distance that the slope along the solutions may be at the nearest one. */
#define FROT_NEAREST_SLOPE 1e-9
/* Ratio of two distances by which the longer one is no farther but for rounding. */
#define FROT_NO_FARTHER (1 + 1e-13)
/* Ratio of two distances at which an angle may be brought next to its guess by whole turns. */
#define FROT_UNNOTICED (1 + 1e-9)
/* Part of a slope that conjugate gradients may leave. */
#define FROT_SLOPE_FOLLOWED 1e-7
/* Curvature, beside the largest, that is none. */
#define FROT_NO_CURVATURE 1e-12
/* Relative change below which weights of guesses are settled. */
#define FROT_GUESS_SETTLED 1e-12
/* Square of what vectors that nearly agree are missed by, beside the arms of the angles. */
#define FROT_NEARLY_MET 1e-6
/* Advance of a turn, beside what angles change in a residual, that is none. */
#define FROT_LEAST_ADVANCE 1e-9
/* Speeds of two branches that differ by less than this part are the same. */
#define FROT_SAME_BRANCH 1e-6

/* -- admissible motions ------------------------------------------------------------------------ */
/* A bound may be passed, a reaction be negative by this part of its terms. */
#define FROT_BOUND_SLACK 1e-10
/* A departing motion may accelerate the wrong way by this part of its terms. */
#define FROT_DEPARTURE_SLACK 1e-9
/* Motions differ when accelerations differ by this part of their terms. */
#define FROT_DIFFERENT 1e-8
/* Combinations of modes examined one by one; beyond, one motion is looked for by pivoting. */
#define FROT_ENOUGH 2500

/* Places for the accelerations of motions at one instant: FROT_MOST_MOTIONS, and one for scratch.
 */
#define FROT_MOTIONS (FROT_MOST_MOTIONS + 1)

/* Error of a step of another integrator, in sizes of states, beyond which it is no tolerance. */
#define FROT_LOOSEST_OUTSIDE 1e-6

/* Part of the time over which guards are extrapolated after an event. */
#define FROT_SOON 1e-8

/* Part of the speeds before an impact that counts as none in rows that are held after it. */
#define FROT_HELD_SPEED 1e-7

#endif
