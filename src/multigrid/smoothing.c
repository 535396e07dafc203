/* smoothing.c -- the smoother of one level at work: with unknowns held, and as a PC. */
#include "base/compat.h"
#include "multigrid/bodysmoother.h"
#include "multigrid/graphcomponents.h"
#include "multigrid/smoother.h"

PetscErrorCode SmootherHold(Mat from, Mat change, PetscInt num, const PetscInt held[], Mat *S)
{
  PetscInt  begin, *rows;
  PetscBool apart;

  PetscFunctionBeginUser;
  PetscCall(MatDestroy(S));
  if (!from) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ApartIs(from, &apart));
  if (apart) {
    PetscCall(ApartHold(from, num, held));
    PetscCall(PetscObjectReference((PetscObject)from));
    *S = from;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(MatDuplicate(from, MAT_COPY_VALUES, S));
  if (change) PetscCall(MatAXPY(*S, 1, change, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatGetOwnershipRange(*S, &begin, NULL));
  PetscCall(PetscMalloc1(num, &rows));
  for (PetscInt i = 0; i < num; i++) rows[i] = begin + held[i];
  PetscCall(MatZeroRowsColumns(*S, num, rows, 1, NULL, NULL));
  PetscCall(PetscFree(rows));
  PetscCall(MatSetOption(*S, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmootherScale(Mat S, PetscReal factor)
{
  PetscBool apart;

  PetscFunctionBeginUser;
  PetscCall(ApartIs(S, &apart));
  PetscCall(MatScale(S, apart ? 1 / factor : factor));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Bundles that ranks cut are solved for by one of them. */
static PetscErrorCode DealOut_Private(PC pc, Mat S)
{
  IS rows;

  PetscFunctionBeginUser;
  PetscCall(PCSetType(pc, PCASM));
  PetscCall(PCASMSetType(pc, PC_ASM_BASIC));
  PetscCall(PCASMSetOverlap(pc, 0));
  PetscCall(ComponentsGather(S, &rows));
  PetscCall(PCASMSetLocalSubdomains(pc, 1, &rows, &rows));
  PetscCall(ISDestroy(&rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Factors of planes have dense parts, which is what CHOLMOD is fast with; those of lines are as sparse as themselves, and cost the same with
   anything. To a rank without rows CHOLMOD would say that it is an error. */
static PetscErrorCode ConfigureFactor_Private(KSP ksp)
{
  PetscInt  n;
  PetscBool available;
  Mat       S;
  PC        pc;

  PetscFunctionBeginUser;
  PetscCall(KSPGetOperators(ksp, NULL, &S));
  PetscCall(KSPSetType(ksp, KSPPREONLY));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCNONE)); // forgets the package: where there were rows there may be none now
  PetscCall(PCSetType(pc, PCCHOLESKY));
  PetscCall(MatGetFactorAvailable(S, MATSOLVERCHOLMOD, MAT_FACTOR_CHOLESKY, &available));
  PetscCall(MatGetSize(S, &n, NULL));
  available = (PetscBool)(available && n > 0);
  if (available) PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERCHOLMOD));
  PetscCall(PCFactorSetMatOrderingType(pc, available ? MATORDERINGEXTERNAL : MATORDERINGQMD));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmootherSetPC(PC pc, Mat S)
{
  PetscMPIInt size;
  PetscBool   apart = PETSC_FALSE;
  KSP        *own;

  PetscFunctionBeginUser;
  if (S) PetscCall(ApartIs(S, &apart));
  if (!S || apart) {
    PetscCall(PCSetType(pc, apart ? PCMAT : PCJACOBI));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)S), &size));
  if (size > 1) {
    PetscCall(DealOut_Private(pc, S));
    PetscCall(PCSetUp(pc));
    PetscCall(PCASMGetSubKSP(pc, NULL, NULL, &own));
  } else {
    PetscCall(PCSetType(pc, PCBJACOBI));
    PetscCall(PCSetUp(pc));
    PetscCall(PCBJacobiGetSubKSP(pc, NULL, NULL, &own));
  }
  PetscCall(ConfigureFactor_Private(own[0]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmootherRenew(PC pc)
{
  Mat       A, S;
  PetscBool dealt;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCASM, &dealt));
  if (!dealt) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PCGetOperators(pc, &A, &S));
  PetscCall(PetscObjectReference((PetscObject)A));
  PetscCall(PetscObjectReference((PetscObject)S));
  PetscCall(PCReset(pc));
  PetscCall(PCSetOperators(pc, A, S));
  PetscCall(SmootherSetPC(pc, S));
  PetscCall(MatDestroy(&A));
  PetscCall(MatDestroy(&S));
  PetscFunctionReturn(PETSC_SUCCESS);
}
