/* ghosted.h -- the values of a ghosted Vec with those of ghosts.

   As VecGetArray() and the like, which give the values of own nodes alone. Not collective. */
#ifndef MORTISE_GHOSTED_H
#define MORTISE_GHOSTED_H

#include <petscvec.h>

/* [in] v - of LevelCreateVec(); [out] values - in local node order, own nodes first [num_nodes][bs] */
PetscErrorCode GhostedGetArray(Vec v, PetscScalar **values);
PetscErrorCode GhostedRestoreArray(Vec v, PetscScalar **values);
PetscErrorCode GhostedGetArrayRead(Vec v, const PetscScalar **values);
PetscErrorCode GhostedRestoreArrayRead(Vec v, const PetscScalar **values);

#endif
