/* adaptive.h -- meshes refined where the error is, until it is small enough. */
#ifndef MORTISE_ADAPTIVE_H
#define MORTISE_ADAPTIVE_H

#include "study/run.h"

/* Solves, estimates the error, marks cells, bisects them, and solves again from what was found, until the calibrated estimate is at most
   scene->adapt.tolerance of the solution in the energy norm, or a limit of scene->adapt comes first: then the run is not solved, and its
   report says why. Prints a line for each mesh. Collective.
   [in] mesh - set up, of a scene with -adapt; afterwards with more levels; [in] guess - displacement to begin with, or NULL;
   [in,out] run - destroyed unless NULL; of the last mesh, with the summary's blocks "estimate" and "bars" */
PetscErrorCode AdaptiveRun(Scene scene, Mesh mesh, Vec guess, Run *run);

/* The same for a scene at several times. */
typedef struct _n_Adaptive *Adaptive;
/* Collective. [in] scene, mesh - borrowed; [out] adaptive - to be freed by AdaptiveDestroy() */
PetscErrorCode AdaptiveCreate(Scene scene, Mesh mesh, Adaptive *adaptive);
PetscErrorCode AdaptiveDestroy(Adaptive *adaptive);
/* Solves at the scene's time. With load steps it begins on the last five meshes of the time before, whose factors are kept, so that there
   are bars without a new mesh; refines from the latest where the error is too large now. No mesh becomes coarser. Collective.
   [in] guess - displacement to begin with, or NULL; [in,out] run - NULL at the first time, else that of the last one; on the latest mesh */
PetscErrorCode AdaptiveSolve(Adaptive adaptive, Vec guess, Run *run);

/* With SceneRepeatsSteps(): all load steps are solved on each mesh, from the first to the last; the next mesh is refined where the error of any
   of them is large. No slip goes from mesh to mesh. */
/* Takes what a solved step tells, and gives its run the blocks "estimate" and "bars". Collective. [in] i - of the step */
PetscErrorCode AdaptiveAddStep(Adaptive adaptive, PetscInt i, Run run);
/* Behind the last step: prints the line of the mesh, and refines unless it is the last one, with a reason in the report of the run if errors
   are larger than what was asked for. Collective.
   [in,out] run - of the last step, destroyed where there is a new mesh; [out] guess - all steps on it, owned by the caller
   [steps]; NULL otherwise */
PetscErrorCode AdaptiveRefineSteps(Adaptive adaptive, Run *run, Vec **guess);
/* Whether a step is known as well as is asked for. Not collective. */
PetscBool AdaptiveStepIsMet(Adaptive adaptive, PetscInt i);

#endif
