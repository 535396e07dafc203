/* redundantsolve.c -- a small matrix, factored redundantly on every rank.

   On several ranks a distributed factorization would be messages and hardly any work. PETSc's PCREDUNDANT
   does not pass on that the matrix is positive definite: its factorization looks for pivots, and finds some
   where one rank finds none. */
#include "base/compat.h"
#include "multigrid/redundantsolve.h"

typedef struct {
  Mat        whole;
  PC         pc; /* of it */
  VecScatter all;
  Vec        b, x; /* whole */
} RedundantSolve;

static PetscErrorCode RedundantSolveRelease_Private(RedundantSolve *redundant)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&redundant->whole));
  PetscCall(VecScatterDestroy(&redundant->all));
  PetscCall(VecDestroy(&redundant->b));
  PetscCall(VecDestroy(&redundant->x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SetUp_RedundantSolve(PC pc)
{
  RedundantSolve *redundant;
  PCFailedReason  failed;
  PetscMPIInt     size;
  Mat             A;
  Vec             x;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &redundant));
  PetscCall(RedundantSolveRelease_Private(redundant));
  PetscCall(PCGetOperators(pc, NULL, &A));
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)A), &size));
  PetscCall(MatCreateRedundantMatrix(A, size, PETSC_COMM_SELF, MAT_INITIAL_MATRIX, &redundant->whole));
  PetscCall(MatSetOption(redundant->whole, MAT_SPD, PETSC_TRUE));
  PetscCall(MatCreateVecs(A, &x, NULL));
  PetscCall(VecScatterCreateToAll(x, &redundant->all, &redundant->b));
  PetscCall(VecDuplicate(redundant->b, &redundant->x));
  PetscCall(VecDestroy(&x));
  PetscCall(PCSetOperators(redundant->pc, redundant->whole, redundant->whole));
  PetscCall(PCSetUp(redundant->pc));
  PetscCall(PCGetFailedReason(redundant->pc, &failed));
  PetscCall(PCSetFailedReason(pc, failed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Apply_RedundantSolve(PC pc, Vec r, Vec z)
{
  RedundantSolve    *redundant;
  PetscInt           begin, n;
  const PetscScalar *x;
  PetscScalar       *own;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &redundant));
  PetscCall(VecScatterBegin(redundant->all, r, redundant->b, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(redundant->all, r, redundant->b, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(PCApply(redundant->pc, redundant->b, redundant->x));
  PetscCall(VecGetOwnershipRange(z, &begin, NULL));
  PetscCall(VecGetLocalSize(z, &n));
  PetscCall(VecGetArrayRead(redundant->x, &x));
  PetscCall(VecGetArrayWrite(z, &own));
  PetscCall(PetscArraycpy(own, &x[begin], n));
  PetscCall(VecRestoreArrayWrite(z, &own));
  PetscCall(VecRestoreArrayRead(redundant->x, &x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_RedundantSolve(PC pc)
{
  RedundantSolve *redundant;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &redundant));
  PetscCall(RedundantSolveRelease_Private(redundant));
  PetscCall(PCDestroy(&redundant->pc));
  PetscCall(PetscFree(redundant));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The factorization. */
static PetscErrorCode RedundantSolveSetFactor_Private(PC pc)
{
  PetscFunctionBeginUser;
  PetscCall(PCSetType(pc, PCCHOLESKY));
  PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RedundantSolveSetPC(PC pc)
{
  RedundantSolve *redundant;
  PetscMPIInt     size;
  const char     *prefix;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)pc), &size));
  if (size == 1) {
    PetscCall(RedundantSolveSetFactor_Private(pc));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscNew(&redundant));
  PetscCall(PCCreate(PETSC_COMM_SELF, &redundant->pc));
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(PCSetOptionsPrefix(redundant->pc, prefix));
  PetscCall(RedundantSolveSetFactor_Private(redundant->pc));
  PetscCall(PCSetType(pc, PCSHELL));
  PetscCall(PCShellSetName(pc, "redundant factorization"));
  PetscCall(PCShellSetContext(pc, redundant));
  PetscCall(PCShellSetSetUp(pc, SetUp_RedundantSolve));
  PetscCall(PCShellSetApply(pc, Apply_RedundantSolve));
  PetscCall(PCShellSetDestroy(pc, Destroy_RedundantSolve));
  PetscFunctionReturn(PETSC_SUCCESS);
}
