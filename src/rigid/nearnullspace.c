/* nearnullspace.c -- rigid body modes as near null space.

   Smoothed aggregation needs the modes of each body as separate vectors. In the unknowns y, a mode is y =
   T^-1 u. It is u~ = S^-1 u at ordinary nodes, F u~ at nodes with a frame, and (B u)_row / D_row where a row
   of B is an unknown. */
#include "base/compat.h"
#include "base/log.h"
#include "rigid/nearnullspace.h"

/* A vector shorter than this share of its first length depends linearly on the ones before it. */
static const PetscReal DEPENDENT_MODE = 1e-8;

/* u of one rigid motion of a body: translations first, then rotations about the origin of coordinates. Those
   of a plane serve axisymmetric bodies as well: away from the axis the hoop strain costs little.
   [in,out] u - ghosted */
static PetscErrorCode NearNullSpaceSetMotion_Private(const Level *level, PetscInt body, PetscInt mode, Vec u)
{
  const PetscInt dim = level->dim;
  PetscScalar   *ua;

  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(u));
  PetscCall(VecGetArray(u, &ua));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    const PetscReal *x = &level->coords[i * dim];
    if (level->node_body[i] != body) continue;
    if (mode < dim) {
      ua[i * dim + mode] = 1;
    } else { // about the axis across the plane (j, k)
      const PetscInt j = dim == 2 ? 0 : (mode - dim + 1) % 3, k = dim == 2 ? 1 : (mode - dim + 2) % 3;
      ua[i * dim + j] = -x[k];
      ua[i * dim + k] = x[j];
    }
  }
  PetscCall(VecRestoreArray(u, &ua));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Orthonormalizes a vector against those before, and drops it if it depends on them: its body is fixed. */
static PetscErrorCode NearNullSpaceOrthonormalize_Private(PetscInt *num, Vec vectors[])
{
  PetscReal   before, after;
  PetscScalar dot;

  PetscFunctionBeginUser;
  PetscCall(VecNorm(vectors[*num], NORM_2, &before));
  for (PetscInt j = 0; j < *num; j++) {
    PetscCall(VecDot(vectors[*num], vectors[j], &dot));
    PetscCall(VecAXPY(vectors[*num], -dot, vectors[j]));
  }
  PetscCall(VecNorm(vectors[*num], NORM_2, &after));
  if (after > DEPENDENT_MODE * before && before > 0) {
    PetscCall(VecScale(vectors[*num], 1 / after));
    (*num)++;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NearNullSpaceAttach(VI vi)
{
  const PetscInt dim = vi->level->dim, per_body = dim * (dim + 1) / 2, max = vi->scene->num_bodies * per_body;
  PetscInt       num = 0;
  Vec            u, *vectors;
  PetscScalar   *ya;
  MatNullSpace   space;

  PetscFunctionBeginUser;
  if (!vi->basis) PetscFunctionReturn(PETSC_SUCCESS); // an inequality from a matrix has no bodies
  PetscCall(LogStageBegin(STAGE_CONDENSE));
  PetscCall(VecDuplicate(vi->f, &u));
  PetscCall(VecDuplicateVecs(vi->upper, max, &vectors));
  for (PetscInt b = 0; b < vi->scene->num_bodies; b++) {
    for (PetscInt mode = 0; mode < per_body; mode++) {
      PetscCall(NearNullSpaceSetMotion_Private(vi->level, b, mode, u));
      PetscCall(VIApplyInverseBasis(vi, u, vectors[num]));
      PetscCall(VecGetArray(vectors[num], &ya));
      for (PetscInt i = 0; i < vi->num_fixed; i++) ya[vi->fixed_local[i]] = 0;
      PetscCall(VecRestoreArray(vectors[num], &ya));
      PetscCall(NearNullSpaceOrthonormalize_Private(&num, vectors));
    }
  }
  PetscCall(MatNullSpaceCreate(vi->level->comm, PETSC_FALSE, num, vectors, &space));
  PetscCall(MatSetNearNullSpace(vi->A, space));
  PetscCall(MatNullSpaceDestroy(&space));
  PetscCall(VecDestroyVecs(max, &vectors));
  PetscCall(VecDestroy(&u));
  PetscCall(LogStageEnd(STAGE_CONDENSE));
  PetscFunctionReturn(PETSC_SUCCESS);
}
