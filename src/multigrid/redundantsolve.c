/* redundantsolve.c -- a matrix of few unknowns, factored by every rank for itself.

   On several ranks such a factorisation would be messages and hardly any work. PETSc's own PCREDUNDANT does the same, but does not tell the factorisation that
   the matrix is positive definite: it looks for pivots then, and finds some where one rank alone says that there are none. */
#include "base/compat.h"
#include "multigrid/redundantsolve.h"

typedef struct {
  Mat        whole;
  PC         pc; /* of it */
  VecScatter all;
  Vec        b, x; /* whole */
} Everywhere;

static PetscErrorCode Release_Private(Everywhere *everywhere)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&everywhere->whole));
  PetscCall(VecScatterDestroy(&everywhere->all));
  PetscCall(VecDestroy(&everywhere->b));
  PetscCall(VecDestroy(&everywhere->x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SetUp_Everywhere(PC pc)
{
  Everywhere    *everywhere;
  PCFailedReason failed;
  PetscMPIInt    size;
  Mat            A;
  Vec            x;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &everywhere));
  PetscCall(Release_Private(everywhere));
  PetscCall(PCGetOperators(pc, NULL, &A));
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)A), &size));
  PetscCall(MatCreateRedundantMatrix(A, size, PETSC_COMM_SELF, MAT_INITIAL_MATRIX, &everywhere->whole));
  PetscCall(MatSetOption(everywhere->whole, MAT_SPD, PETSC_TRUE));
  PetscCall(MatCreateVecs(A, &x, NULL));
  PetscCall(VecScatterCreateToAll(x, &everywhere->all, &everywhere->b));
  PetscCall(VecDuplicate(everywhere->b, &everywhere->x));
  PetscCall(VecDestroy(&x));
  PetscCall(PCSetOperators(everywhere->pc, everywhere->whole, everywhere->whole));
  PetscCall(PCSetUp(everywhere->pc));
  PetscCall(PCGetFailedReason(everywhere->pc, &failed));
  PetscCall(PCSetFailedReason(pc, failed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Apply_Everywhere(PC pc, Vec r, Vec z)
{
  Everywhere        *everywhere;
  PetscInt           begin, n;
  const PetscScalar *x;
  PetscScalar       *own;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &everywhere));
  PetscCall(VecScatterBegin(everywhere->all, r, everywhere->b, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(everywhere->all, r, everywhere->b, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(PCApply(everywhere->pc, everywhere->b, everywhere->x));
  PetscCall(VecGetOwnershipRange(z, &begin, NULL));
  PetscCall(VecGetLocalSize(z, &n));
  PetscCall(VecGetArrayRead(everywhere->x, &x));
  PetscCall(VecGetArrayWrite(z, &own));
  PetscCall(PetscArraycpy(own, &x[begin], n));
  PetscCall(VecRestoreArrayWrite(z, &own));
  PetscCall(VecRestoreArrayRead(everywhere->x, &x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_Everywhere(PC pc)
{
  Everywhere *everywhere;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &everywhere));
  PetscCall(Release_Private(everywhere));
  PetscCall(PCDestroy(&everywhere->pc));
  PetscCall(PetscFree(everywhere));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The factorisation itself. */
static PetscErrorCode SetFactor_Private(PC pc)
{
  PetscFunctionBeginUser;
  PetscCall(PCSetType(pc, PCCHOLESKY));
  PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EverywhereSetPC(PC pc)
{
  Everywhere *everywhere;
  PetscMPIInt size;
  const char *prefix;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)pc), &size));
  if (size == 1) {
    PetscCall(SetFactor_Private(pc));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscNew(&everywhere));
  PetscCall(PCCreate(PETSC_COMM_SELF, &everywhere->pc));
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(PCSetOptionsPrefix(everywhere->pc, prefix));
  PetscCall(SetFactor_Private(everywhere->pc));
  PetscCall(PCSetType(pc, PCSHELL));
  PetscCall(PCShellSetName(pc, "factors on every rank"));
  PetscCall(PCShellSetContext(pc, everywhere));
  PetscCall(PCShellSetSetUp(pc, SetUp_Everywhere));
  PetscCall(PCShellSetApply(pc, Apply_Everywhere));
  PetscCall(PCShellSetDestroy(pc, Destroy_Everywhere));
  PetscFunctionReturn(PETSC_SUCCESS);
}
