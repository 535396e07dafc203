/* meshhistory.h -- results of the meshes that a scene was solved on, and the error bars that follow from
   them. */
#ifndef MORTISE_MESHHISTORY_H
#define MORTISE_MESHHISTORY_H

#include "result/peak.h"
#include "study/goals.h"

/* One mesh. */
typedef struct {
  PetscInt  cells, unknowns, iterations, active;
  PetscReal eta, geometry, theta, error; /* estimate, the part of its square from curves, calibration, E (15.3, 15.4) */
  PetscReal norm, potential, signs;      /* |u|_a^2 (0: rounding), J_h, L */
  PetscReal lost, supports;              /* parts of L: changes of volume, moved supports */
  PetscReal seconds;                     /* from the mesh to its bars */
  PetscBool missed;                      /* whether contact was missed somewhere */
  cJSON    *row;                         /* of SummaryCreateStep() */
  Peak     *peak;                        /* of pairs [num_pairs] */
  GoalState *goals;                      /* [scene->adapt.num_goals], or NULL */
} SolvedMesh;

/* All meshes, coarse first. Zero means empty. */
typedef struct {
  PetscInt    num, max;
  SolvedMesh *mesh; /* [max] */
} MeshHistory;

/* Adds the results of a solved run. Collective. [in] seconds - of its mesh so far */
PetscErrorCode MeshHistoryAdd(MeshHistory *history, Run run, PetscReal seconds);
PetscErrorCode MeshHistoryDestroy(MeshHistory *history);
/* Forgets the latest meshes. Not collective. [in] num - that remain */
PetscErrorCode MeshHistoryTruncate(MeshHistory *history, PetscInt num);
/* The calibrated estimate of the error in the energy norm, over the norm of the solution; 0 where there is
   none. Not collective. */
PetscReal SolvedMeshGetError(const SolvedMesh *mesh);
/* 2 J_h - L: it falls like the square of the error. Not collective. */
PetscReal SolvedMeshGetEnergy(const SolvedMesh *mesh);
/* Whether that error is rounding: the finite element space contains the solution. Not collective. */
PetscBool SolvedMeshIsExact(const SolvedMesh *mesh);
/* Replaces the blocks "estimate" and "bars" of a run, and sets the bars of the goals of the latest mesh.
   Collective.
   [in,out] run - that of the latest mesh */
PetscErrorCode MeshHistoryDescribe(const MeshHistory *history, Run run);

#endif
