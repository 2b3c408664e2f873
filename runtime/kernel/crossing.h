/* Singular postures: where a row of a closed loop depends on others for an instant, as those of a
 * parallelogram that is flat.
 *
 * There the relations do not tell how the loop goes on, and next to it, at a distance d (in parts
 * of a turn), they tell it with the error of rounding over d^3. The motion itself is smooth, and
 * it goes straight on. So near such a posture each stage of a step is put onto the relations before
 * it is evaluated (an error along the weak row would be worth its cube there), and the slope in a
 * stage that is too near is not evaluated: it lies on the polynomial through those of the others.
 * What rounding leaves in the weak row is no error of the motion, for the projection takes it away
 * again along that row, and keeps the momentum of all the rest. */
#ifndef FROT_CROSSING_H
#define FROT_CROSSING_H

#include "work.h"

/* Whether relations of loops hold: rows of liaisons that cannot open. */
int frot_has_loops(const frot_model *m, const frot_state *s, const frot_work *w);

/* Note what those before it leave of each such row in stage i, which has just been evaluated. */
void frot_note_rows(const frot_model *m, const frot_state *s, frot_work *w, int stage);

/* Find when a row becomes dependent near the step that ran up to stage `reached`, into the state's
 * `posture`, and mark the stages that are too near in w->step.near. Returns whether the stages are
 * to be run again for it. */
int frot_find_crossings(const frot_model *m, frot_state *s, frot_work *w, double t, double h,
                        int reached, int pass);

/* The slope of a stage that is too near, from those of the others up to `reached`. */
void frot_interpolate_stage(const frot_model *m, frot_work *w, int stage, int reached);

/* Whether the step h is good for them, where one of the length `wanted` could be taken but for
 * them.
 */
int frot_is_laid(const frot_model *m, const frot_state *s, const frot_work *w, double t, double h,
                 double wanted);

/* The length of a step from t, about h and no longer than `longest`, in which no stage is too
 * near the postures known. */
double frot_lay_step(const frot_model *m, const frot_state *s, const frot_work *w, double t,
                     double h, double longest);

/* What rounding makes of the error of the speeds along weak rows in the step h that ran: no error
 * of the motion. w->step.excused (2 nv) <- what is to be left out of their estimates by the weights
 * dp_e5 and dp_e3. After frot_run_stages. */
void frot_excuse_noise(const frot_model *m, frot_state *s, frot_work *w, double t, double h);

/* How much the directions of weak rows turn in the step that ran, over what they may: a motion that
 * leaves its way, or one that the step is too long for, is more than 1. */
double frot_turning(const frot_model *m, const frot_state *s, frot_work *w, double t, double h);

/* The liaison of whose weak row a stage of the step that ran is so near a posture that rounding
 * turns it away from its motion, -1 if none: what follows from there may be another motion. */
int frot_lost_row(const frot_model *m, const frot_state *s, const frot_work *w, double t, double h);

/* The liaison whose posture is nearest to t, -1 where none is near. */
int frot_posture_at(const frot_model *m, const frot_state *s, const frot_work *w, double t);

/* The step is taken: count a posture that it has passed, and say whether one is near the next. */
void frot_keep_crossings(const frot_model *m, frot_state *s, const frot_work *w, double t,
                         double h);

#endif
