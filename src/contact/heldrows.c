/* heldrows.c -- rows of a tie in directions that supports hold at its nodes.

   A tied node that a support holds in some directions has a multiplier in the others. There the displacement
   is free, as at the end of a side. In a held direction the multiplier would act on no unknown of its own
   side. Its neighbours take that row over, as at nodes held in all directions. So constant tractions are
   represented exactly. The rows go into the arm, since they are blocks that differ by direction. */
#include "base/compat.h"
#include "contact/heldrows.h"

/* The nodes whose rows are to be passed on as removed ones, those that may take them as kept ones.
   [out] split - [num_nodes]; [out] any - whether any rank has a row to pass on. Collective. */
static PetscErrorCode HeldRowsSplit_Private(const Level *level, const Support *support, const MultiplierStatus status[],
                                            MultiplierStatus split[], PetscBool *any)
{
  PetscFunctionBeginUser;
  *any = PETSC_FALSE;
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    split[i] = NODE_UNCOVERED;
    if (status[i] != NODE_KEPT) continue;
    split[i] = support->count[i] ? NODE_REMOVED : NODE_KEPT;
    *any     = (PetscBool)(*any || support->count[i]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* w_ac Pi_c. [in] W - weights of nodes; [out] WP - owned by the caller */
static PetscErrorCode HeldRowsProject_Private(const Level *level, const Support *support,
                                              const MultiplierStatus split[], Mat W, Mat *WP)
{
  const PetscInt dim = level->dim;
  Mat            blocks, P;

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(level->comm, level->num_owned * dim, level->num_owned * dim, PETSC_DETERMINE, PETSC_DETERMINE,
                         dim, NULL, 0, NULL, &P));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    const PetscInt first = dim * (level->node_begin + i);

    for (PetscInt j = 0; split[i] == NODE_REMOVED && j < support->count[i]; j++) {
      const PetscReal *d = &support->directions[(i * dim + j) * dim];

      for (PetscInt k = 0; k < dim; k++)
        for (PetscInt l = 0; l < dim; l++)
          if (d[k] * d[l] != 0) PetscCall(MatSetValue(P, first + k, first + l, d[k] * d[l], ADD_VALUES));
    }
  }
  PetscCall(MatAssemblyBegin(P, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(P, MAT_FINAL_ASSEMBLY));
  PetscCall(LevelCreateBlocks(W, dim, &blocks));
  PetscCall(MatMatMult(blocks, P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, WP));
  PetscCall(MatDestroy(&blocks));
  PetscCall(MatDestroy(&P));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* M + arm - (D + D_other) S^-1 as one matrix of blocks. [out] rows - owned by the caller */
static PetscErrorCode HeldRowsSum_Private(const Level *level, const MortarIntegrals *sums, const Pair pair, Mat *rows)
{
  Mat own, moved, scalar;

  PetscFunctionBeginUser;
  PetscCall(MatDuplicate(sums->M, MAT_COPY_VALUES, &scalar));
  PetscCall(MatCreateAIJ(level->comm, level->num_owned, level->num_owned, PETSC_DETERMINE, PETSC_DETERMINE, 1, NULL, 0,
                         NULL, &own));
  PetscCall(MatDiagonalSet(own, sums->D, INSERT_VALUES));
  if (pair->D_other) PetscCall(MatAXPY(own, 1.0, pair->D_other, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatAXPY(scalar, -1.0, own, DIFFERENT_NONZERO_PATTERN));
  if (pair->from_nodal) {
    PetscCall(MatMatMult(own, pair->from_nodal, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &moved));
    PetscCall(MatAXPY(scalar, -1.0, moved, DIFFERENT_NONZERO_PATTERN));
    PetscCall(MatDestroy(&moved));
  }
  PetscCall(MatDestroy(&own));
  PetscCall(LevelCreateBlocks(scalar, level->dim, rows));
  PetscCall(MatDestroy(&scalar));
  if (sums->arm) PetscCall(MatAXPY(*rows, 1.0, sums->arm, DIFFERENT_NONZERO_PATTERN));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HeldRowsPass(Level *level, const Support *support, const Facets *facets, const MultiplierStatus status[],
                            MortarIntegrals *sums, Pair pair)
{
  MultiplierStatus *split;
  PetscBool         any;
  Mat               W = NULL, rows, arm;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->num_nodes, &split));
  PetscCall(HeldRowsSplit_Private(level, support, status, split, &any));
  if (any) PetscCall(RedistributionWeights(level, facets, split, sums, &W));
  if (W) {
    PetscCall(HeldRowsProject_Private(level, support, split, W, &pair->passed));
    PetscCall(HeldRowsSum_Private(level, sums, pair, &rows));
    PetscCall(MatMatMult(pair->passed, rows, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &arm));
    if (sums->arm) PetscCall(MatAXPY(arm, 1.0, sums->arm, DIFFERENT_NONZERO_PATTERN));
    PetscCall(MatDestroy(&sums->arm));
    sums->arm = arm;
    PetscCall(MatDestroy(&rows));
    PetscCall(MatDestroy(&W));
  }
  PetscCall(PetscFree(split));
  PetscFunctionReturn(PETSC_SUCCESS);
}
