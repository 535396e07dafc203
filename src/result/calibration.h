/* calibration.h -- the error estimate in the scale of measured differences of energy. */
#ifndef MORTISE_CALIBRATION_H
#define MORTISE_CALIBRATION_H

#include "mesh/mesh.h"

/* Numbers by which consecutive meshes are compared. */
typedef struct {
  PetscReal squared; /* eta^2 */
  PetscReal energy;  /* 2 J_h - L: its distance from the limit is |e|^2 */
} CalibrationMesh;

/* theta of the finest mesh (eq. 15.4): theta_k^2 = (energy_(k-1) - energy_k) / (eta_(k-1)^2 - eta_k^2), the
   median of the standard and of the latest two where eta^2 falls by 40 % of itself or more, in [0.5, 4]. E =
   theta eta. Not collective. [in] mesh - coarse first [num] */
PetscReal CalibrationFind(PetscInt num, const CalibrationMesh mesh[], PetscReal standard);
/* theta of one mesh alone: how far recovery falls short on the worst of its types of cells, measured. Collective. */
PetscErrorCode CalibrationGetStandard(const Level *level, PetscReal *theta);

#endif
