/* nodelevels.c -- levels where there is no coarser mesh: some of the nodes.

   They are made of the stiffness K of the bodies alone, in displacements u, where bodies do not couple: whatever touches, the levels stay as they
   are. With P_0 from displacements of chosen nodes to u,
       P = T^-1 P_0,   P'A P = P_0'K P_0,
   as on levels of a mesh; what is held, by supports, by ties or by contact, is truncated on top of that (rung.c), but for displacements
   that are held along axes to begin with. */
#include "kernel/element.h"
#include "multigrid/nodelevels.h"
#include "multigrid/truncationupdate.h"

/* A coarse unknown that is left with no more than this part of what it moves, in squares, is none. */
static const PetscReal NEXT_TO_NOTHING = 1e-2;

/* Of cells of second order the next coarser level has the vertices, in the middle between which other nodes move. Orders are known cell by cell. */
static PetscErrorCode TakeFromVertices_Private(const Level *level, Points *points)
{
  static const PetscReal NO_WEIGHT = 1e-12;
  const PetscInt         n         = level->num_owned;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(n, &points->count, n * POINTS_TERMS, &points->from, n * POINTS_TERMS, &points->weight));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementType type = (ElementType)level->cell_type[c], linear = ElementLinear(type);
    const PetscInt   *nodes = &level->cell_nodes[level->cell_start[c]];

    for (PetscInt i = 0; i < level->cell_start[c + 1] - level->cell_start[c]; i++) {
      const PetscInt node = nodes[i];
      PetscReal      phi[ELEMENT_MAX_NODES];

      if (node >= n || points->count[node]) continue;
      ElementShape(linear, ElementNode(type, i), phi, NULL);
      for (PetscInt v = 0; v < ElementNumNodes(linear); v++) {
        if (phi[v] <= NO_WEIGHT) continue;
        points->from[node * POINTS_TERMS + points->count[node]]     = level->node_global[nodes[v]];
        points->weight[node * POINTS_TERMS + points->count[node]++] = phi[v];
      }
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode AlgebraicBegin(VI vi, Points *points)
{
  const Level   *level  = vi->level;
  const PetscInt n      = level->dim * level->num_owned;
  PetscBool      higher = PETSC_FALSE;

  PetscFunctionBeginUser;
  *points = (Points){.A = vi->K, .dim = level->dim};
  PetscCall(PetscMalloc1(n, &points->x));
  PetscCall(PetscArraycpy(points->x, level->coords, n));
  PetscCall(PetscCalloc1(n, &points->held));
  PetscCall(VIMarkFixedDisplacements(vi, points->held));
  for (PetscInt c = 0; c < level->num_cells; c++)
    if (ElementOrder((ElementType)level->cell_type[c]) > 1) higher = PETSC_TRUE;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &higher, 1, MPIU_BOOL, MPI_LOR, level->comm));
  if (higher) PetscCall(TakeFromVertices_Private(level, points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode AlgebraicWeigh(Mat P, Vec open, Vec *weight)
{
  const PetscScalar *o = NULL;
  PetscInt           begin, end;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(P, weight, NULL));
  PetscCall(MatGetOwnershipRange(P, &begin, &end));
  if (open) PetscCall(VecGetArrayRead(open, &o));
  for (PetscInt row = begin; row < end; row++) {
    PetscInt           num;
    const PetscInt    *columns;
    const PetscScalar *values;

    if (o && o[row - begin] == 0) continue;
    PetscCall(MatGetRow(P, row, &num, &columns, &values));
    for (PetscInt j = 0; j < num; j++) PetscCall(VecSetValue(*weight, columns[j], values[j] * values[j], ADD_VALUES));
    PetscCall(MatRestoreRow(P, row, &num, &columns, &values));
  }
  if (open) PetscCall(VecRestoreArrayRead(open, &o));
  PetscCall(VecAssemblyBegin(*weight));
  PetscCall(VecAssemblyEnd(*weight));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Coarse unknowns that move nothing, or next to nothing but what is eliminated. [in] P - whole; [in] open - 0 where eliminated; [in,out] held; [out] keep -
   1 for all that are left */
static PetscErrorCode Drop_Private(Mat P, Vec open, PetscBool held[], Vec *keep)
{
  const PetscScalar *w, *left;
  PetscScalar       *k;
  PetscInt           n;
  Vec                weight[2];

  PetscFunctionBeginUser;
  PetscCall(AlgebraicWeigh(P, NULL, &weight[0]));
  PetscCall(AlgebraicWeigh(P, open, &weight[1]));
  PetscCall(VecDuplicate(weight[0], keep));
  PetscCall(VecGetLocalSize(*keep, &n));
  PetscCall(VecGetArrayRead(weight[0], &w));
  PetscCall(VecGetArrayRead(weight[1], &left));
  PetscCall(VecGetArrayWrite(*keep, &k));
  for (PetscInt i = 0; i < n; i++) {
    held[i] = (PetscBool)(held[i] || PetscRealPart(left[i]) <= NEXT_TO_NOTHING * PetscRealPart(w[i]));
    k[i]    = held[i] ? 0 : 1;
  }
  PetscCall(VecRestoreArrayWrite(*keep, &k));
  PetscCall(VecRestoreArrayRead(weight[1], &left));
  PetscCall(VecRestoreArrayRead(weight[0], &w));
  PetscCall(VecDestroy(&weight[0]));
  PetscCall(VecDestroy(&weight[1]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* P := T^-1 P, emptied where unknowns are eliminated, and what that changes in P'A P. [in] was_held - displacements that P was empty for;
   [in,out] held - coarse unknowns; [in,out] P, Ac */
static PetscErrorCode Truncate_Private(VI vi, const PetscBool was_held[], PetscBool held[], Mat *P, Mat Ac)
{
  Mat          product, strip;
  Vec          was, is, keep;
  PetscScalar *a;
  PetscInt     n;

  PetscFunctionBeginUser;
  PetscCall(VIMultiplyInverseBasis(vi, P));
  PetscCall(VICreateFreeMask(vi, &is));
  PetscCall(Drop_Private(*P, is, held, &keep));
  PetscCall(MatDiagonalScale(*P, NULL, keep));
  PetscCall(MatDiagonalScale(Ac, keep, keep));
  PetscCall(VecDuplicate(is, &was));
  PetscCall(VecGetLocalSize(was, &n));
  PetscCall(VecGetArrayWrite(was, &a));
  for (PetscInt i = 0; i < n; i++) a[i] = was_held[i] ? 0 : 1;
  PetscCall(VecRestoreArrayWrite(was, &a));
  PetscCall(StripCreate(vi, NULL, NULL, was, is, NULL, &strip));
  PetscCall(StripRestrict(strip, *P, &product));
  PetscCall(MatAXPY(Ac, 1, product, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDiagonalScale(*P, is, NULL));
  PetscCall(MatDestroy(&product));
  PetscCall(MatDestroy(&strip));
  PetscCall(VecDestroy(&was));
  PetscCall(VecDestroy(&is));
  PetscCall(VecDestroy(&keep));
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

PetscErrorCode AlgebraicCoarsen(VI fine, Points *points, Mat *P, VI *coarse)
{
  Points   next;
  Mat      Ac;
  PetscInt n, num = 0, *idle;

  PetscFunctionBeginUser;
  PetscCall(PointsCoarsen(points, P, &next));
  PetscCall(MatPtAP(points->A, *P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &Ac));
  PetscCall(MatProductClear(Ac)); // it would keep its factors
  PetscCall(MatScale(Ac, 1 / fine->stiffness));
  if (fine->level) PetscCall(Truncate_Private(fine, points->held, next.held, P, Ac));
  PetscCall(MatGetLocalSize(Ac, &n, NULL));
  PetscCall(PetscMalloc1(n, &idle));
  for (PetscInt i = 0; i < n; i++)
    if (next.held[i]) idle[num++] = i;
  PetscCall(SetIdle_Private(Ac, num, idle));
  PetscCall(VICreateOfMatrix(Ac, num, idle, coarse));
  PetscCall(MatDestroy(&Ac));
  PetscCall(PointsDestroy(points));
  *points   = next;
  points->A = (*coarse)->K;
  PetscFunctionReturn(PETSC_SUCCESS);
}
