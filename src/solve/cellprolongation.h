/* cellprolongation.h -- prolongation that keeps the volume of nearly incompressible bodies; internal
   (eq. 13.8). */
#ifndef MORTISE_CELLPROLONGATION_H
#define MORTISE_CELLPROLONGATION_H

#include "level/level.h"

/* Moves fine nodes inside of coarse cells with mean dilatation to where they have the least energy:

       P_I := - K_II^-1 K_IB P_B,   I the nodes inside of one coarse cell, B all others.

   Collective. [in] fine - made from coarse by one refinement of all cells; [in] K - stiffness on the fine
   level; [in,out] P - displacements of coarse to those of fine, by shape functions (AIJ) */
PetscErrorCode CellProlongationApply(Scene scene, const Level *coarse, const Level *fine, Mat K, Mat *P);

#endif
