/* stress.h -- stresses at nodes. */
#ifndef MORTISE_STRESS_H
#define MORTISE_STRESS_H

#include "mesh/mesh.h"

/* Stresses of the displacement u at nodes (eq. 8.2), xx,yy,zz,yz,xz,xy. Collective. [in] u - ghosted, dim per node;
   [out] stress - ghosted, 6 per node, owned by the caller */
PetscErrorCode StressCreate(Scene scene, Level *level, Vec u, Vec *stress);

#endif
