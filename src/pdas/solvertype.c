/* solvertype.c -- the choice of `pdas` between its two solvers. */
#include "base/compat.h"
#include "pdas/pdas.h"
#include "pdas/pdasimpl.h"
#include "multigrid/multigrid.h"

/* Whether one factorization serves all sets: by default if the KSP is a plain Cholesky solve by MUMPS. */
static PetscErrorCode SolverTypeReducible_Private(const PDAS *pdas, const ActiveSet *set, Vec y, KSP ksp,
                                                  PetscBool *reduced)
{
  PetscBool     direct, cholesky, multigrid, mumps = PETSC_FALSE;
  MatSolverType type = NULL;
  PetscInt      size;
  PC            pc;

  PetscFunctionBeginUser;
  PetscCall(VecGetSize(y, &size));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)ksp, KSPPREONLY, &direct));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCCHOLESKY, &cholesky));
  if (cholesky) PetscCall(PCFactorGetMatSolverType(pc, &type));
  if (type) PetscCall(PetscStrcmp(type, MATSOLVERMUMPS, &mumps));
  *reduced = (PetscBool)(direct && mumps && set->N <= ACTIVE_MAX_SCHUR);
  if (pdas->reduce_set) *reduced = pdas->reduce;
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCTRUNCATEDMG, &multigrid));
  if (pdas->law) *reduced = (PetscBool)!multigrid;
  /* without bounds there is one system only; with bounds alone nothing to eliminate */
  if (set->N == 0 || set->N == size) *reduced = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASChooseSolver(SNES snes, PDAS *pdas, Mat A, Vec b, Vec y)
{
  const ActiveSet *set    = &pdas->set;
  ActiveSolver    *solver = &pdas->solver;
  KSP              ksp;
  const char      *prefix;
  PetscReal        rtol;

  PetscFunctionBeginUser;
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(SNESGetTolerances(snes, NULL, &rtol, NULL, NULL, NULL));
  PetscCall(SolverTypeReducible_Private(pdas, set, y, ksp, &pdas->reduced));
  if (pdas->reduced) {
    PetscCall(KSPGetOptionsPrefix(ksp, &prefix));
    PetscCall(SchurSolverCreate(set, A, b, prefix, rtol, solver, &pdas->failure));
  } else {
    PetscCall(FullSolverCreate(set, A, b, y, ksp, rtol, solver));
    if (pdas->error_reduction > 0)
      PetscCall(ConvergenceSetErrorReduction(*solver, pdas->error_reduction, pdas->energy_decrease));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASGetSolver(SNES snes, ActiveSolver *solver)
{
  PDAS     *pdas;
  PetscBool is_pdas;

  PetscFunctionBeginUser;
  *solver = NULL;
  PetscCall(PetscObjectTypeCompare((PetscObject)snes, SNESPDAS, &is_pdas));
  if (!is_pdas) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PDASGet(snes, &pdas));
  *solver = pdas->solver;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASCreateSolver(SNES snes, const ActiveSet *set, Mat A, Vec b, PetscReal rtol, ActiveSolver *solver,
                                const char **failure)
{
  Vec       y;
  KSP       ksp;
  PDAS     *pdas;
  PetscBool is_pdas, reduced = PETSC_FALSE;

  PetscFunctionBeginUser;
  *failure = NULL;
  PetscCall(VecDuplicate(b, &y));
  PetscCall(VecZeroEntries(y));
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(PetscObjectTypeCompare((PetscObject)snes, SNESPDAS, &is_pdas));
  if (is_pdas) {
    PetscCall(PDASGet(snes, &pdas));
    PetscCall(SolverTypeReducible_Private(pdas, set, y, ksp, &reduced));
  }
  if (reduced) {
    const char *prefix;

    PetscCall(KSPGetOptionsPrefix(ksp, &prefix));
    PetscCall(SchurSolverCreate(set, A, b, prefix, rtol, solver, failure));
  } else {
    PetscCall(KSPReset(ksp)); /* a matrix of another size may have been set */
    PetscCall(FullSolverCreate(set, A, b, y, ksp, rtol, solver));
  }
  PetscCall(VecDestroy(&y));
  PetscFunctionReturn(PETSC_SUCCESS);
}
