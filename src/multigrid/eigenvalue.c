/* eigenvalue.c -- eigenvalues from a few steps of CG. */
#include "base/compat.h"
#include <petscksp.h>
#include "multigrid/eigenvalue.h"
#include "multigrid/smoother.h"

/* Steps of CG for the largest eigenvalue, and the margin for its remaining error. */
enum { LANCZOS_STEPS = 10 };
static const PetscReal EIGENVALUE_MARGIN = 1.1;

PetscErrorCode EigenvalueSeed(Vec b)
{
  PetscInt     begin, end;
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(VecGetOwnershipRange(b, &begin, &end));
  PetscCall(VecGetArray(b, &a));
  for (PetscInt i = begin; i < end; i++) a[i - begin] = PetscSinReal(1 + (PetscReal)i * (PetscReal)i);
  PetscCall(VecRestoreArray(b, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EigenvalueGetRitz(KSP ksp, PetscReal *largest, PetscReal *smallest, PetscBool *seen)
{
  KSPConvergedReason reason;
  PetscInt           its;

  PetscFunctionBeginUser;
  PetscCall(KSPGetIterationNumber(ksp, &its));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  /* PETSc counts a step that broke down, reads memory that was never written, and loops forever on NaN */
  *seen = (PetscBool)(its > 0 && (reason >= 0 || reason == KSP_DIVERGED_ITS) && reason != KSP_CONVERGED_ATOL);
  if (*seen) PetscCall(KSPComputeExtremeSingularValues(ksp, largest, smallest));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EigenvalueLargest(Mat A, Mat S, Vec b, PetscReal *largest)
{
  PetscReal smallest;
  PetscInt  its;
  PetscBool seen;
  Vec       seed, x;
  KSP       ksp;
  PC        pc;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(A, &x, &seed));
  PetscCall(b ? VecCopy(b, seed) : EigenvalueSeed(seed));
  PetscCall(KSPCreate(PetscObjectComm((PetscObject)A), &ksp));
  PetscCall(KSPSetOptionsPrefix(ksp, "eigenvalue_"));
  PetscCall(KSPSetType(ksp, KSPCG));
  PetscCall(KSPSetOperators(ksp, A, S ? S : A));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(SmootherSetPC(pc, S));
  PetscCall(KSPSetComputeSingularValues(ksp, PETSC_TRUE));
  PetscCall(KSPSetTolerances(ksp, 0, 0, PETSC_DEFAULT, LANCZOS_STEPS));
  PetscCall(KSPSetNormType(ksp, KSP_NORM_NONE));
  PetscCall(KSPSolve(ksp, seed, x));
  PetscCall(EigenvalueGetRitz(ksp, largest, &smallest, &seen));
  if (!seen) { /* CG has converged; one step less gives all eigenvalues */
    PetscCall(KSPGetIterationNumber(ksp, &its));
    PetscCall(KSPSetTolerances(ksp, 0, 0, PETSC_DEFAULT, PetscMax(its - 1, 0)));
    PetscCall(KSPSolve(ksp, seed, x));
    PetscCall(EigenvalueGetRitz(ksp, largest, &smallest, &seen));
  }
  *largest = seen ? *largest * EIGENVALUE_MARGIN : 0;
  PetscCall(KSPDestroy(&ksp));
  PetscCall(VecDestroy(&seed));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(PETSC_SUCCESS);
}
