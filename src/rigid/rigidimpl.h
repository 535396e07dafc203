/* rigidimpl.h -- declarations that the files of this module share. */
#ifndef MORTISE_RIGIDIMPL_H
#define MORTISE_RIGIDIMPL_H

#include "rigid/cone.h"
#include "rigid/solvability.h"

/* Sets solvability->overlap and forces_at. Collective. */
PetscErrorCode ContactRowsCreate(VI vi, Solvability solvability);
/* Sets friction and forces_at for a part of the present coefficients of friction. Collective. */
PetscErrorCode ContactRowsUpdate(VI vi, Solvability solvability, PetscReal part);
PetscErrorCode ContactRowsDestroy(Solvability solvability);
/* The rows as a Cone, borrowed. Not collective. */
Cone ContactRowsCone(VI vi, Solvability solvability, const ContactRows *rows);

/* Sets slide and tangent of solvability; nothing without friction. Not collective. */
PetscErrorCode FrictionRowsCreate(VI vi, Solvability solvability);
/* Sets friction and friction_row for a part of the present coefficients. Not collective. */
PetscErrorCode FrictionRowsUpdate(VI vi, Solvability solvability, PetscReal part);
/* Rows that resist rigid motions where contacts are pressed: tangents beside normals. Not collective.
   [in,out] pressed - of normals, then of tangents too [num_rows]; [out] rows - [num_rows][m] */
PetscErrorCode FrictionRowsTakePressed(VI vi, Solvability solvability, PetscBool pressed[], PetscReal rows[]);
/* Upper bound of friction.num; without friction the number of rows. Not collective. */
PetscInt       FrictionRowsCountMost(VI vi);
PetscErrorCode FrictionRowsDestroy(Solvability solvability);

/* Searches a motion, in chosen modes, that no force of contact resists, with round cones in space. Loads do
   more work on it than friction at its bounds. Such a motion proves that there is no equilibrium. Without
   one, there may be an equilibrium or not. Collective.
   [in] phi - work of the loads / their sum [m];
   [in] balanced - rounding of phi; [in] take - chosen modes [m]; [out] q - the motion, if found [m] */
PetscErrorCode FrictionLimitsFindMotion(VI vi, Solvability solvability, const PetscReal phi[], PetscReal balanced,
                                        const PetscBool take[], PetscReal q[], PetscBool *found);

/* Sets regularization, approach and start. Collective. */
PetscErrorCode RegularizationCreate(VI vi, Solvability solvability);
/* Sets approach and start anew. Collective. */
PetscErrorCode RegularizationUpdate(VI vi, Solvability solvability);

/* Marks modes without rotation. Not collective. [out] straight - [m] */
void SolvabilityMarkStraight(VI vi, PetscBool straight[]);
/* The combination of rigid motions with given products with them. Collective.
   [in] products - [m]; [out] part - of each motion [m] */
PetscErrorCode SolvabilityFindModes(Solvability solvability, const PetscReal products[], PetscReal part[]);

/* Adds the relative displacement of the two sides at a point. Not collective.
   [in] q - [m]; [in,out] slip - [3] */
void SceneMotionAddSlip(VI vi, const ContactPlace *place, const PetscReal q[], PetscReal slip[]);
/* The same for one mode, k, times a factor. */
void SceneMotionAddSlipOfMode(VI vi, const ContactPlace *place, PetscInt k, PetscReal factor, PetscReal slip[]);

#endif
