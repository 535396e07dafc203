/* yielding.c -- the displacement by which bodies yield to the neglected part of Green's strain. */
#include "base/compat.h"
#include "checks/yielding.h"
#include "level/ghosted.h"
#include "problem/eigenstrain.h"
#include "solve/dualsolve.h"

/* b = T'q / stiffness with the loads q of the neglected strain, 0 where unknowns are fixed.
   [out] b - layout of vi->b */
static PetscErrorCode YieldingLoad_Private(Fields fields, Vec b)
{
  const VI     vi = fields->vi;
  PetscScalar *a;
  Vec          q;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(vi->level, vi->level->dim, &q));
  PetscCall(GhostedGetArray(q, &a));
  PetscCall(EigenstrainAddNeglected(vi->scene, vi->level, fields->u, a));
  PetscCall(GhostedRestoreArray(q, &a));
  PetscCall(LevelShareVec(q, ADD_VALUES));
  if (vi->T)
    PetscCall(MatMultTranspose(vi->T, q, b));
  else
    PetscCall(VecCopy(q, b));
  PetscCall(VecScale(b, 1 / vi->stiffness));
  PetscCall(VecGetArray(b, &a));
  for (PetscInt i = 0; i < vi->num_fixed; i++) a[vi->fixed_local[i]] = 0;
  PetscCall(VecRestoreArray(b, &a));
  PetscCall(VecDestroy(&q));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode YieldingCreate(Fields fields, Vec *v)
{
  const VI  vi = fields->vi;
  PetscBool solved;
  Vec       b, z;

  PetscFunctionBeginUser;
  *v = NULL;
  if (!fields->solver) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecDuplicate(fields->y, &b));
  PetscCall(VecDuplicate(fields->y, &z));
  PetscCall(YieldingLoad_Private(fields, b));
  PetscCall(DualSolve(fields->solver, fields->report, fields->y, 1, &b, &z, &solved));
  if (solved) {
    PetscCall(LevelCreateVec(vi->level, vi->level->dim, v));
    PetscCall(VecScale(z, 1 / vi->length)); // u = length T y
    PetscCall(VIRecoverDisplacement(vi, z, *v));
  }
  PetscCall(VecDestroy(&z));
  PetscCall(VecDestroy(&b));
  PetscFunctionReturn(PETSC_SUCCESS);
}
