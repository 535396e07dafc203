/* algebraic.h -- levels below the coarsest mesh; internal (floor 6; T38). */
#ifndef MORTISE_ALGEBRAIC_H
#define MORTISE_ALGEBRAIC_H

#include <mortise/vi.h>
#include "aggregate.h"

/* K of a level of the mesh, with the rigid motions of its bodies. Collective. [out] fabric - of its displacements, to be destroyed by
   FabricDestroy() */
PetscErrorCode AlgebraicBegin(VI vi, Fabric *fabric);
/* The next coarser level. Collective.
   [in] fine - a level of the mesh or one of these; [in,out] fabric - of fine, then of coarse; [in] largest - eigenvalue of diag(A)^-1 A, at
   least; [out] P - y of coarse to y of fine; [out] coarse - both owned by the caller */
PetscErrorCode AlgebraicCoarsen(VI fine, Fabric *fabric, PetscReal largest, Mat *P, VI *coarse);

#endif
