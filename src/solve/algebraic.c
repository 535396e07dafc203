/* algebraic.c -- levels where there is no coarser mesh: what aggregates of nodes can do as a whole.

   They are made of the stiffness K of the bodies alone, in displacements u, where bodies do not couple and rigid motions cost nothing: whatever
   touches, the levels stay as they are. With P_0 from unknowns of aggregates to u,
       P = T^-1 P_0,   P'A P = P_0'K P_0,
   as on levels of a mesh; what is held, by supports, by ties or by contact, is truncated on top of that (rung.c), but for those held
   displacements that aggregates need not move to begin with. */
#include "algebraic.h"
#include "strip.h"

/* Couplings weaker than this part of the stiffness of both nodes do not hold an aggregate together. */
static const PetscReal STRONGER = 0.02;

/* Rigid motions at one node: translations, then rotations about the origin of x. [in] x - [dim]; [out] motion - [dim][num] */
static void SetMotions_Private(PetscInt dim, PetscInt num, const PetscReal x[], PetscReal motion[])
{
  for (PetscInt k = 0; k < dim * num; k++) motion[k] = 0;
  for (PetscInt k = 0; k < dim; k++) motion[k * num + k] = 1;
  for (PetscInt r = dim; r < num; r++) { // about the axis across the plane (j, k)
    const PetscInt j = dim == 2 ? 0 : (r - dim + 1) % 3, k = dim == 2 ? 1 : (r - dim + 2) % 3;

    motion[j * num + r] = -x[k];
    motion[k * num + r] = x[j];
  }
}

/* Middle and size of the box around all nodes. Collective. [out] middle - [dim] */
static PetscErrorCode Extent_Private(const Level *level, PetscReal middle[], PetscReal *size)
{
  const PetscInt dim      = level->dim;
  PetscReal      range[6] = {PETSC_MAX_REAL, PETSC_MAX_REAL, PETSC_MAX_REAL, PETSC_MAX_REAL,
                             PETSC_MAX_REAL, PETSC_MAX_REAL}; // smallest coordinates, and largest with the sign turned

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < level->num_owned * dim; i++) {
    range[i % dim]     = PetscMin(range[i % dim], level->coords[i]);
    range[3 + i % dim] = PetscMin(range[3 + i % dim], -level->coords[i]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, range, 6, MPIU_REAL, MPIU_MIN, level->comm));
  *size = 0;
  for (PetscInt k = 0; k < dim; k++) {
    middle[k] = (range[k] - range[3 + k]) / 2;
    *size     = PetscMax(*size, (-range[3 + k] - range[k]) / 2);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode AlgebraicBegin(VI vi, Fabric *fabric)
{
  const Level   *level = vi->level;
  const PetscInt dim = level->dim, n = level->num_owned, num = dim * (dim + 1) / 2;
  PetscReal      middle[3], size;

  PetscFunctionBeginUser;
  *fabric = (Fabric){.A = vi->K, .bs = dim, .num = num, .stronger = STRONGER};
  PetscCall(PetscMalloc1(dim * n * num, &fabric->motion));
  PetscCall(PetscCalloc1(dim * n, &fabric->held));
  PetscCall(VIMarkHeld(vi, fabric->held));
  PetscCall(Extent_Private(level, middle, &size));
  for (PetscInt i = 0; i < n; i++) {
    PetscReal x[3];

    for (PetscInt k = 0; k < dim; k++) x[k] = (level->coords[i * dim + k] - middle[k]) / size;
    SetMotions_Private(dim, num, x, &fabric->motion[i * dim * num]);
  }
  for (PetscInt i = 0; i < dim * n; i++) {
    for (PetscInt k = 0; fabric->held[i] && k < num; k++) fabric->motion[i * num + k] = 0;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* P := T^-1 P, emptied where unknowns are eliminated, and what that changes in P'A P. [in,out] P, Ac */
static PetscErrorCode Truncate_Private(VI vi, const PetscBool held[], Mat *P, Mat Ac)
{
  Mat          product, strip;
  Vec          was, is;
  PetscScalar *a;
  PetscInt     n;

  PetscFunctionBeginUser;
  PetscCall(VIMultiplyInverse(vi, P));
  PetscCall(VICreateOpen(vi, &is));
  PetscCall(VecDuplicate(is, &was));
  PetscCall(VecGetLocalSize(was, &n));
  PetscCall(VecGetArray(was, &a));
  for (PetscInt i = 0; i < n; i++) a[i] = held[i] ? 0 : 1;
  PetscCall(VecRestoreArray(was, &a));
  PetscCall(StripCreate(vi, NULL, NULL, was, is, NULL, &strip));
  PetscCall(StripRestrict(strip, *P, &product));
  PetscCall(MatAXPY(Ac, 1, product, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDiagonalScale(*P, is, NULL));
  PetscCall(MatDestroy(&product));
  PetscCall(MatDestroy(&strip));
  PetscCall(VecDestroy(&was));
  PetscCall(VecDestroy(&is));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* 1 on the diagonal of unknowns that do nothing. */
static PetscErrorCode SetIdle_Private(Mat A, PetscInt num, const PetscInt idle[])
{
  PetscInt begin;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(A, &begin, NULL));
  for (PetscInt i = 0; i < num; i++) PetscCall(MatSetValue(A, begin + idle[i], begin + idle[i], 1, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode AlgebraicCoarsen(VI fine, Fabric *fabric, PetscReal largest, Mat *P, VI *coarse)
{
  Fabric   next;
  Mat      Ac;
  PetscInt n, num = 0, *idle;

  PetscFunctionBeginUser;
  PetscCall(FabricCoarsen(fabric, largest, P, &next));
  PetscCall(MatPtAP(fabric->A, *P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &Ac));
  PetscCall(MatProductClear(Ac)); // it would keep its factors
  PetscCall(MatScale(Ac, 1 / fine->stiffness));
  if (fine->level) PetscCall(Truncate_Private(fine, fabric->held, P, Ac));
  PetscCall(MatGetLocalSize(Ac, &n, NULL));
  PetscCall(PetscMalloc1(n, &idle));
  for (PetscInt i = 0; i < n; i++)
    if (next.held[i]) idle[num++] = i;
  PetscCall(SetIdle_Private(Ac, num, idle));
  PetscCall(VICreateOfMatrix(Ac, num, idle, coarse));
  PetscCall(MatDestroy(&Ac));
  PetscCall(FabricDestroy(fabric));
  *fabric   = next;
  fabric->A = (*coarse)->K;
  PetscFunctionReturn(PETSC_SUCCESS);
}
