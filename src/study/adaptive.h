/* adaptive.h -- adaptive refinement until the error is as small as asked for. */
#ifndef MORTISE_ADAPTIVE_H
#define MORTISE_ADAPTIVE_H

#include "study/run.h"

/* Solves, estimates the error, marks cells, bisects them, and solves again with the last solution as initial
   guess. Ends when the calibrated estimate is at most scene->adapt.tolerance of the solution in the energy
   norm and all goals are met. A limit of scene->adapt may end it before: then the run is not solved, and its
   report has the reason. Prints a line for each mesh. Collective.
   [in] mesh - set up, of a scene with -adapt; gets more levels;
   [in] guess - initial guess of the displacement, or NULL;
   [in,out] run - destroyed unless NULL; then that of the last mesh, with the blocks "estimate" and "bars" of
   the summary */
PetscErrorCode AdaptiveRun(Scene scene, Mesh mesh, Vec guess, Run *run);

/* The same for a scene at several times. */
typedef struct _n_Adaptive *Adaptive;
/* Collective. [in] scene, mesh - borrowed; [out] adaptive - owned by the caller, AdaptiveDestroy() */
PetscErrorCode AdaptiveCreate(Scene scene, Mesh mesh, Adaptive *adaptive);
/* Collective. */
PetscErrorCode AdaptiveDestroy(Adaptive *adaptive);
/* Solves at the scene's time. With load steps, the last five meshes of the time before are solved on first,
   with their factors. Then there are bars without a new mesh. Refines the latest mesh while the error is too
   large; never coarsens. Collective.
   [in] guess - initial guess of the displacement, or NULL;
   [in,out] run - NULL at the first time, else that of the last time; then that of the latest mesh */
PetscErrorCode AdaptiveSolve(Adaptive adaptive, Vec guess, Run *run);

/* The next three are for scenes with SceneRepeatsSteps(). All load steps are solved on each mesh, from the
   first to the last. The next mesh is refined where the error of any step is large. Slip is not transferred
   between meshes. */

/* Adds a solved step, and gives its run the blocks "estimate" and "bars". Collective.
   [in] i - index of the step */
PetscErrorCode AdaptiveAddStep(Adaptive adaptive, PetscInt i, Run run);
/* After the last step: prints the line of the mesh, and refines the mesh unless it is the last one. If errors
   are larger than asked for on the last mesh, the report of the run has the reason. Collective.
   [in,out] run - of the last step, destroyed if all steps are to be solved again;
   [out] guess - displacements of all steps on the new mesh, owned by the caller [steps]; NULL without one;
   [out] again - whether all steps are to be solved again: on a new mesh, or without one if it failed */
PetscErrorCode AdaptiveRefineSteps(Adaptive adaptive, Run *run, Vec **guess, PetscBool *again);
/* After a step that was not solved: goes back to the mesh before, if there is one. Then all steps are to be
   solved again, and AdaptiveRefineSteps() ends with the failure as the reason. Collective.
   [in,out] run - of that step, or NULL after a user error; destroyed if there is a mesh before;
   [out] again - whether there is one */
PetscErrorCode AdaptiveReturnSteps(Adaptive adaptive, Run *run, PetscBool *again);
/* Whether the error of a step is as small as asked for. Not collective. */
PetscBool AdaptiveStepIsMet(Adaptive adaptive, PetscInt i);

#endif
