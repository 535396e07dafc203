/* meshhistory.h -- what is remembered of the meshes that a scene was solved on, and the error bars that follow from it. */
#ifndef MORTISE_MESHHISTORY_H
#define MORTISE_MESHHISTORY_H

#include "study/goals.h"

/* One mesh. */
typedef struct {
  PetscInt   cells, unknowns, iterations, active;
  PetscReal  eta, geometry, theta, error; /* estimate, the part of its square of curves, calibration, E (15.3, 15.4) */
  PetscReal  norm, potential, signs, seconds; /* |u|_a^2 (0: rounding), J_h, L */
  PetscBool  missed;                          /* whether contact was missed and nothing moves */
  cJSON     *row;                             /* of SummaryCreateStep() */
  GoalState *goals;                           /* [scene->adapt.num_goals], or NULL */
} SolvedMesh;

/* All of them, coarse first; empty where it is zero. */
typedef struct {
  PetscInt    num, max;
  SolvedMesh *mesh; /* [max] */
} MeshHistory;

/* Remembers what a solved run tells of its mesh. Collective. [in] seconds - that the mesh took so far */
PetscErrorCode MeshHistoryAdd(MeshHistory *history, Run run, PetscReal seconds);
PetscErrorCode MeshHistoryDestroy(MeshHistory *history);
/* The calibrated estimate of the error in the energy norm, over the norm of the solution; 0 where there is none. Not collective. */
PetscReal SolvedMeshGetError(const SolvedMesh *mesh);
/* Whether that is rounding: the space holds the solution. Not collective. */
PetscBool SolvedMeshIsExact(const SolvedMesh *mesh);
/* Gives a run the blocks "estimate" and "bars" of its summary, in place of those that it has, and the goals of the latest mesh their bars. Collective.
   [in,out] run - that of the latest mesh */
PetscErrorCode MeshHistoryDescribe(const MeshHistory *history, Run run);

#endif
