/* rigidimpl.h -- what holds bodies that supports do not. */
#ifndef MORTISE_RIGIDIMPL_H
#define MORTISE_RIGIDIMPL_H

#include "rigid/conennls.h"
#include "rigid/solvability.h"

/* The rows of B as rows of contact, and those of the bodies themselves where partners end within facets: s->cover. Collective. */
PetscErrorCode ContactRowsCreate(VI vi, Solvability s);
PetscErrorCode ContactRowsDestroy(Solvability s);

/* Springs (eq. 12.6), and where they rest. Collective. */
PetscErrorCode RegularizationCreate(VI vi, Solvability solvability);

/* min |q - target|  over  row.q <= bound for all rows, bound >= 0; equality for rows of both signs. Collective.
   [in] bound - [cone->num]; [in] target - [m]; [out] q - the same on all ranks [m] */
PetscErrorCode ConeProject(const Cone *cone, const PetscReal bound[], const PetscReal target[], PetscReal q[]);

/* Adds how the two sides of a contact move past and from each other at its place. Not collective. [in] q - [m];
   [in,out] slip - [3] */
void SceneMotionAddSlip(VI vi, const ContactPlace *place, const PetscReal q[], PetscReal slip[]);
/* The same of one rigid motion, k, with a factor. */
void SceneMotionAddSlipOfMode(VI vi, const ContactPlace *place, PetscInt k, PetscReal factor, PetscReal slip[]);

#endif
