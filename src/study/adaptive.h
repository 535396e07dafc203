/* adaptive.h -- meshes refined where the error is, until it is small enough. */
#ifndef MORTISE_ADAPTIVE_H
#define MORTISE_ADAPTIVE_H

#include "study/run.h"

/* Solves, estimates the error, marks cells, bisects them, and solves again from what was found, until the calibrated estimate is at most
   scene->adapt.tolerance of the solution in the energy norm, or a limit of scene->adapt comes first: then the run is not solved, and its
   report says why. Prints a line for each mesh. Collective.
   [in] mesh - set up, of a scene with -adapt; afterwards with more levels; [in] guess - displacement to begin with, or NULL;
   [out] run - of the last mesh, with the summary's blocks "estimate" and "bars" */
PetscErrorCode AdaptiveRun(Scene scene, Mesh mesh, Vec guess, Run *run);

#endif
