/* frictionlinear.c -- the linear systems of Newton steps at full size: GMRES, preconditioned by truncated
   multigrid.

   The system is that of frictionsystem.c, without elimination of other unknowns. Tangential rows of slipping
   units have two more terms: the resistance to turning, and minus coefficient times the normal row. The first
   term is added to the matrices of the cycle. A smoother by bodies does not contain it. There the cycle omits
   tangents with a large resistance, and they are solved separately. The second term makes the system
   unsymmetric. It is of the size of friction, and is not in the cycle. */
#include "multigrid/multigrid.h"
#include "pdas/fullsolver.h"
#include "pdas/frictionlinear.h"

/* A resistance to turning above this part of the stiffness is solved separately, if the smoother does not
   contain it. */
static const PetscReal STIFF_TURNING = 2;
enum { GMRES_RESTART = 30, GMRES_MAX_IT = 150 };

void FrictionUnitTurn(const FrictionUnit *unit, const PetscReal s[], PetscReal force[])
{
  PetscReal along = 0;

  for (PetscInt i = 0; i < unit->num; i++) along += unit->direction[i] * s[i];
  for (PetscInt i = 0; i < unit->num; i++) force[i] = unit->turning * (s[i] - along * unit->direction[i]);
}

/* The matrix of a step: z = A x, and z_t += turning (1 - d d') x_t - coefficient d z_n for slipping units;
   rows of fixed unknowns are diagonal. */
static PetscErrorCode Multiply_FrictionLinear(Mat A, Vec x, Vec z)
{
  FrictionLinear    *linear;
  const PetscScalar *from;
  PetscScalar       *to;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(A, &linear));
  PetscCall(MatMult(linear->solver->A, x, z));
  PetscCall(VecGetArrayRead(x, &from));
  PetscCall(VecGetArray(z, &to));
  for (PetscInt a = 0; a < linear->units->num; a++) {
    const FrictionUnit *unit = &linear->units->unit[a];
    const PetscReal     mu   = linear->coupled && unit->closed ? unit->coefficient : 0;
    PetscReal           s[FRICTION_TANGENTS], force[FRICTION_TANGENTS];

    if (unit->status != UNIT_SLIP) continue;
    for (PetscInt i = 0; i < unit->num; i++) s[i] = PetscRealPart(from[FrictionLinearAt(linear, unit->tangent[i])]);
    FrictionUnitTurn(unit, s, force);
    for (PetscInt i = 0; i < unit->num; i++)
      to[FrictionLinearAt(linear, unit->tangent[i])] +=
          force[i] - mu * unit->direction[i] * to[FrictionLinearAt(linear, unit->normal)];
  }
  for (PetscInt i = 0; i < linear->units->n; i++) {
    const PetscInt at = FrictionLinearAt(linear, i);

    if (linear->fixed[i]) to[at] = linear->solver->set->diag[i] * from[at];
  }
  PetscCall(VecRestoreArray(z, &to));
  PetscCall(VecRestoreArrayRead(x, &from));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* x = (k + turning (1 - d d'))^-1 f of a unit, k the stiffness: along d and across it. */
static void FrictionLinearSolveUnit_Private(const FrictionUnit *unit, const PetscReal f[], PetscReal x[])
{
  PetscReal along = 0;

  for (PetscInt i = 0; i < unit->num; i++) along += unit->direction[i] * f[i];
  for (PetscInt i = 0; i < unit->num; i++)
    x[i] = along * unit->direction[i] / unit->resistance +
           (f[i] - along * unit->direction[i]) / (unit->resistance + unit->turning);
}

/* A cycle, and a separate solve for the tangents that it omits. */
static PetscErrorCode Precondition_FrictionLinear(PC pc, Vec r, Vec z)
{
  FrictionLinear    *linear;
  const PetscScalar *from;
  PetscScalar       *to;
  PetscReal          alpha;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &linear));
  PetscCall(VecCopy(r, linear->work));
  PetscCall(VecGetArray(linear->work, &to));
  for (PetscInt i = 0; i < linear->units->n; i++)
    if (linear->left[i]) to[FrictionLinearAt(linear, i)] = 0;
  PetscCall(VecRestoreArray(linear->work, &to));
  PetscCall((*linear->solver->correct)(linear->solver, linear->work, z, &alpha));
  PetscCall(VecGetArrayRead(r, &from));
  PetscCall(VecGetArray(z, &to));
  for (PetscInt a = 0; a < linear->units->num; a++) {
    const FrictionUnit *unit = &linear->units->unit[a];
    PetscReal           f[FRICTION_TANGENTS], x[FRICTION_TANGENTS];

    if (unit->status != UNIT_SLIP || !linear->left[unit->tangent[0]]) continue;
    for (PetscInt i = 0; i < unit->num; i++) f[i] = PetscRealPart(from[FrictionLinearAt(linear, unit->tangent[i])]);
    FrictionLinearSolveUnit_Private(unit, f, x);
    for (PetscInt i = 0; i < unit->num; i++) to[FrictionLinearAt(linear, unit->tangent[i])] = x[i];
  }
  PetscCall(VecRestoreArray(z, &to));
  PetscCall(VecRestoreArrayRead(r, &from));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The resistance to turning of slipping units, as a matrix. [out] T - owned by the caller */
static PetscErrorCode FrictionLinearAssembleTurning_Private(const FrictionLinear *linear, Mat *T)
{
  PetscInt     n, N, begin, num = 0, *rows, *columns;
  PetscScalar *values;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(linear->work, &n));
  PetscCall(VecGetSize(linear->work, &N));
  PetscCall(VecGetOwnershipRange(linear->work, &begin, NULL));
  PetscCall(
      PetscMalloc3(4 * linear->units->num, &rows, 4 * linear->units->num, &columns, 4 * linear->units->num, &values));
  for (PetscInt a = 0; a < linear->units->num; a++) {
    const FrictionUnit *unit = &linear->units->unit[a];

    if (unit->status != UNIT_SLIP || unit->num < 2) continue;
    for (PetscInt k = 0; k < 4; k++) {
      const PetscInt i = k / 2, j = k % 2;

      rows[num]     = begin + FrictionLinearAt(linear, unit->tangent[i]);
      columns[num]  = begin + FrictionLinearAt(linear, unit->tangent[j]);
      values[num++] = unit->turning * ((i == j ? 1 : 0) - unit->direction[i] * unit->direction[j]);
    }
  }
  PetscCall(MatCreate(PetscObjectComm((PetscObject)linear->work), T));
  PetscCall(MatSetSizes(*T, n, n, N, N));
  PetscCall(MatSetType(*T, MATAIJ));
  PetscCall(MatSetPreallocationCOO(*T, num, rows, columns));
  PetscCall(MatSetValuesCOO(*T, values, ADD_VALUES));
  PetscCall(PetscFree3(rows, columns, values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionLinearTell(FrictionLinear *linear)
{
  Mat T = NULL;

  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(linear->left, linear->fixed, linear->units->n));
  if (linear->added) PetscCall(FrictionLinearAssembleTurning_Private(linear, &T));
  for (PetscInt a = 0; a < linear->units->num && !linear->added; a++) {
    const FrictionUnit *unit = &linear->units->unit[a];

    if (unit->status != UNIT_SLIP || unit->num < 2 || !(unit->turning > STIFF_TURNING * unit->resistance)) continue;
    for (PetscInt i = 0; i < unit->num; i++) linear->left[unit->tangent[i]] = PETSC_TRUE;
  }
  PetscCall(FullSolverSetFixed(linear->solver, linear->left, T));
  PetscCall(MatDestroy(&T));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionLinearCreate(const ActiveSolver solver, const FrictionUnits *units, FrictionLinear *linear)
{
  const FullSolver *full = solver->data;
  PetscInt          n, N;
  const char       *prefix;
  PC                pc;

  PetscFunctionBeginUser;
  linear->solver = solver;
  linear->units  = units;
  PetscCall(VecDuplicate(solver->b, &linear->work));
  PetscCall(PetscCalloc2(units->n, &linear->fixed, units->n, &linear->left));
  PetscCall(MultigridSmoothsMore(full->pc, &linear->added));
  PetscCall(VecGetLocalSize(solver->b, &n));
  PetscCall(VecGetSize(solver->b, &N));
  PetscCall(MatCreateShell(units->comm, n, n, N, N, linear, &linear->A));
  PetscCall(MatShellSetOperation(linear->A, MATOP_MULT, (void (*)(void))Multiply_FrictionLinear));
  PetscCall(KSPCreate(units->comm, &linear->ksp));
  PetscCall(KSPGetOptionsPrefix(full->ksp, &prefix));
  PetscCall(KSPSetOptionsPrefix(linear->ksp, prefix));
  PetscCall(KSPSetFromOptions(linear->ksp)); // monitors and views; the types are set after it, since others do not fit
  PetscCall(KSPSetType(linear->ksp, KSPFGMRES)); // flexible GMRES keeps what cycles give: one cycle less
  PetscCall(KSPGMRESSetRestart(linear->ksp, GMRES_RESTART));
  PetscCall(KSPSetOperators(linear->ksp, linear->A, linear->A));
  PetscCall(KSPGetPC(linear->ksp, &pc));
  PetscCall(PCSetType(pc, PCSHELL));
  PetscCall(PCShellSetContext(pc, linear));
  PetscCall(PCShellSetApply(pc, Precondition_FrictionLinear));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionLinearDestroy(FrictionLinear *linear)
{
  PetscFunctionBeginUser;
  PetscCall(KSPDestroy(&linear->ksp));
  PetscCall(MatDestroy(&linear->A));
  PetscCall(VecDestroy(&linear->work));
  PetscCall(PetscFree2(linear->fixed, linear->left));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionLinearSolve(FrictionLinear *linear, PetscReal rtol, Vec f, Vec d, PetscInt *iterations)
{
  PetscInt its;

  PetscFunctionBeginUser;
  PetscCall(KSPSetTolerances(linear->ksp, rtol, PETSC_DEFAULT, PETSC_DEFAULT, GMRES_MAX_IT));
  PetscCall(KSPSolve(linear->ksp, f, d));
  PetscCall(KSPGetIterationNumber(linear->ksp, &its));
  *iterations += its;
  PetscCall(PetscInfo(linear->ksp, "system of a Newton step: reduced by %g in %" PetscInt_FMT " iterations\n",
                      (double)rtol, its));
  PetscFunctionReturn(PETSC_SUCCESS);
}
