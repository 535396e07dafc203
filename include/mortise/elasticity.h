/* elasticity.h -- stiffness K and load f of all bodies, before any boundary condition (floor 5). */
#ifndef MORTISE_ELASTICITY_H
#define MORTISE_ELASTICITY_H

#include <mortise/mesh.h>

/* C at a point of a body (Hooke tensor, thickness not included) and Poisson's ratio (NAN where there is none).
   Not collective; expressions are checked by ElasticityAssemble(). [out] C - [num_strains][num_strains] */
PetscErrorCode ElasticityHooke(Scene scene, PetscInt body, const PetscReal x[], PetscReal C[], PetscReal *poisson);

/* K = int B'CB,  f = int phi b + int_side phi t, times the thickness. Faults on moduli that are not positive definite at
   some point. Collective. [out] K - AIJ of block size dim, owned by the caller; [out] f - ghosted Vec, owned by the caller */
PetscErrorCode ElasticityAssemble(Scene scene, Level *level, Mat *K, Vec *f);

/* energy_b = (1/2) u'K u over the nodes of body b (K does not couple bodies). Collective.
   [in] u - ghosted; [out] energy - [num_bodies], the same on all ranks */
PetscErrorCode ElasticityBodyEnergy(Scene scene, Level *level, Mat K, Vec u, PetscReal energy[]);

#endif
