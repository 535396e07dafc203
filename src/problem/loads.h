/* loads.h -- body forces, tractions and pressures as nodal loads, and strains without stress. */
#ifndef MORTISE_LOADS_H
#define MORTISE_LOADS_H

#include "level/level.h"

/* f_i = int phi_i b + int_side phi_i t - int_side phi_i p nu + int B_i' C eps_0, times the thickness.
   Collective. [in,out] f - ghosted, shared */
PetscErrorCode LoadsAssemble(Scene scene, Level *level, Vec f);

/* Sums of the loads on a side over all ranks, with the thickness or the ring. */
typedef struct {
  PetscReal force[3], moment[3]; /* moment about the centroid; of no meaning in axisymmetric scenes */
  PetscReal centre[3], area;     /* of the side */
} LoadSum;

/* The sums of all nodal loads of a body's data for one side, of this name. Collective. */
PetscErrorCode LoadSumsCompute(Scene scene, Level *level, PetscInt body, const char side[], LoadSum *sum);

#endif
