/* Singular postures: where a row of a closed loop depends on others for an instant, as those of a
 * parallelogram that is flat.
 *
 * There the relations do not determine the motion of the loop, and next to it, at a distance d (in
 * parts of a turn), they determine it with the error of rounding over d^3. The motion itself is
 * smooth, and it goes straight on. So near such a posture each stage of a step is put onto the
 * relations before it is evaluated (an error along the weak row would be worth its cube there), and
 * from further off where that makes the error of a step much smaller (off the relations there is a
 * pole in its place, and steps would shorten in proportion to the distance). The slope in a stage
 * that is too near is not evaluated: it lies on the polynomial through those of the others. What
 * rounding leaves in the weak row is no error of the motion, for the projection takes it away again
 * along that row, and keeps the momentum of all the rest. */
#ifndef FROT_SINGULAR_POSTURE_H
#define FROT_SINGULAR_POSTURE_H

#include "evaluation/held_modes.h"

/* In steps, how far before and beyond its stages a posture makes rows weak. */
#define FROT_AROUND 0.6

/* Whether relations of loops hold: rows of liaisons that cannot open. */
int frot_has_loops(const frot_model *m, const frot_state *s, const frot_work *w);

/* Note what those before it leave of each such row in stage i, which has just been evaluated. */
void frot_note_rows(const frot_model *m, const frot_state *s, frot_work *w, int stage);

/* What a step made another way meets, by its stages `first` to `last`, of which the last two are
 * `gap` of a step apart: FROT_POSTURE where a row is weak and becomes dependent in it or soon
 * after, FROT_DIVERGE where one does so that was not weak at its ends, else FROT_OK. */
int frot_meets_posture(const frot_model *m, const frot_state *s, const frot_work *w, int first,
                       int last, double gap);

/* Find when a row becomes dependent near the step that ran up to stage `reached`, into the state's
 * `posture`, and mark the stages that are too near in w->step.near. Returns whether the stages are
 * to be run again for it. */
int frot_find_singular_postures(const frot_model *m, frot_state *s, frot_work *w, double t,
                                double h, int reached, int pass);

/* Whether stages off the relations may be what makes the error of the step h from t too large: they
 * are, and a posture is foreseen, by the order of the method from further off than it makes rows
 * weak. */
int frot_foresees_posture(const frot_model *m, const frot_state *s, const frot_work *w, double t,
                          double h);

/* The step has run with its stages put onto the relations, and loose: they stay so if that makes
 * its error much smaller. */
void frot_judge_projected_stages(frot_state *s, double tied, double loose);

/* The slope of a stage that is too near, from those of the others up to `reached`. */
void frot_interpolate_stage(const frot_model *m, frot_work *w, int stage, int reached);

/* Whether the step h is good for them, where one of the length `wanted` could be taken but for
 * them.
 */
int frot_length_avoids_posture(const frot_model *m, const frot_state *s, const frot_work *w,
                               double t, double h, double wanted);

/* The length of a step from t, about h and no longer than `longest`, in which no stage is too
 * near the postures known. */
double frot_place_between_postures(const frot_model *m, const frot_state *s, const frot_work *w,
                                   double t, double h, double longest);

/* Whether a posture lies in the step h from t. */
int frot_passes(const frot_model *m, const frot_state *s, const frot_work *w, double t, double h);

/* The step is taken: count a posture that it has passed, and say whether one is near the next. */
void frot_keep_crossings(const frot_model *m, frot_state *s, const frot_work *w, double t,
                         double h);

/* Scratch of what a step shows of its rows, from the arena. */
void frot_bind_posture(const frot_model *m, frot_step_work *w, frot_arena *a);

#endif
