/* crosscheck.c -- the same inequality solved by the other method.

   Active sets and displacements are computed independently from the start. With a factorization both share A
   and b. If the first solver used multigrid, the second does as well, on the same levels, starting from the
   coarsest. Levels affect the speed of convergence, not the limit. */
#include "base/compat.h"
#include "pdas/pdasimpl.h"
#include "solve/solverimpl.h"

/* Two solutions agree to this part of the largest displacement, force or bound. */
static const PetscReal AGREE = 1e-9;
/* Limit of agreement if the difference is roundoff or within the promised energy error: as in the
   certificate. */
static const PetscReal AGREE_ILL = 1e-6;
/* Energy norm of the difference of two solutions relative to one of them; each is within half of it of the
   exact one (eq. 14.4). */
static const PetscReal PROMISED_DIFFERENCE = 1e-8;
/* Roundoff of a row of A y, as a part of its diagonal times the largest displacement. */
static const PetscReal ROW_ROUNDOFF = 64 * PETSC_MACHINE_EPSILON;
/* Prefix of the options of the second SNES. */
static const char PREFIX[] = "cross_check_";

/* Gets values and forces b - A y of all bounded unknowns. [out] values, forces - [set->n] */
static PetscErrorCode CrossCheckGetValues_Private(VI vi, const ActiveSet *set, Vec y, PetscReal values[],
                                                  PetscReal forces[])
{
  Vec r;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(vi->b, &r));
  PetscCall(MatMult(vi->A, y, r));
  PetscCall(VecAYPX(r, -1, vi->b));
  PetscCall(ActiveSetGather(set, y, values));
  PetscCall(ActiveSetGather(set, r, forces));
  PetscCall(VecDestroy(&r));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Counts unknowns that are at the bound with a force in one solution and clearly off it in the other. A bound
   that is just touched, without force, belongs to either set. */
static PetscErrorCode CrossCheckCompareSets_Private(VI vi, Vec first, Vec second, PetscReal scale, PetscInt *difference)
{
  ActiveSet  set;
  PetscReal *y[2], *r[2], max = 0;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetCreate(vi->upper, vi->A, &set));
  PetscCall(PetscMalloc4(set.n, &y[0], set.n, &y[1], set.n, &r[0], set.n, &r[1]));
  PetscCall(CrossCheckGetValues_Private(vi, &set, first, y[0], r[0]));
  PetscCall(CrossCheckGetValues_Private(vi, &set, second, y[1], r[1]));
  for (PetscInt i = 0; i < set.n; i++) max = PetscMax(max, PetscMax(PetscAbsReal(r[0][i]), PetscAbsReal(r[1][i])));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &max, 1, MPIU_REAL, MPI_MAX, set.comm));
  *difference = 0;
  for (PetscInt i = 0; i < set.n; i++) {
    PetscBool touching[2], open[2];

    for (int s = 0; s < 2; s++) {
      open[s]     = (PetscBool)(y[s][i] < set.upper[i] - AGREE * scale);
      touching[s] = (PetscBool)(!open[s] && r[s][i] > AGREE * max);
    }
    *difference += (touching[0] && open[1]) || (touching[1] && open[0]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, difference, 1, MPIU_INT, MPI_SUM, set.comm));
  PetscCall(PetscFree4(y[0], y[1], r[0], r[1]));
  PetscCall(ActiveSetDestroy(&set));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether both satisfy the same equations up to roundoff: A (first - second), in the rows of unknowns free in
   both. A stiff body on a soft one, or a motion with little resistance, multiplies the roundoff of forces by
   the condition of A. No method in this precision determines more digits. */
static PetscErrorCode CrossCheckAgreeToRoundoff_Private(VI vi, Vec first, Vec second, PetscReal scale,
                                                        PetscBool *indistinct)
{
  ActiveSet  set;
  Vec        d, r, diagonal;
  PetscReal *y[2], *residual, worst;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(first, &d));
  PetscCall(VecDuplicate(first, &r));
  PetscCall(VecDuplicate(first, &diagonal));
  PetscCall(VecWAXPY(d, -1, second, first));
  PetscCall(MatMult(vi->A, d, r));
  PetscCall(MatGetDiagonal(vi->A, diagonal));
  PetscCall(VecPointwiseDivide(r, r, diagonal));
  PetscCall(ActiveSetCreate(vi->upper, vi->A, &set));
  PetscCall(PetscMalloc3(set.n, &y[0], set.n, &y[1], set.n, &residual));
  PetscCall(ActiveSetGather(&set, first, y[0]));
  PetscCall(ActiveSetGather(&set, second, y[1]));
  PetscCall(ActiveSetGather(&set, r, residual));
  for (PetscInt i = 0; i < set.n; i++) {
    if (PetscMax(y[0][i], y[1][i]) >= set.upper[i] - AGREE * scale) residual[i] = 0;
  }
  PetscCall(ActiveSetScatter(&set, residual, r));
  PetscCall(VecNorm(r, NORM_INFINITY, &worst));
  *indistinct = (PetscBool)(worst <= ROW_ROUNDOFF * scale);
  PetscCall(PetscInfo(vi->A, "forces on what is free differ by %g of the diagonal times the displacements\n",
                      (double)(worst / scale)));
  PetscCall(PetscFree3(y[0], y[1], residual));
  PetscCall(ActiveSetDestroy(&set));
  PetscCall(VecDestroy(&diagonal));
  PetscCall(VecDestroy(&r));
  PetscCall(VecDestroy(&d));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Norms of a vector as displacements, up to their scale: maximum and energy norm. */
typedef struct {
  PetscReal max, energy;
} Size;

static PetscErrorCode CrossCheckMeasure_Private(VI vi, Vec y, Size *size)
{
  const Mat   K = vi->K ? vi->K : vi->A;
  Vec         u, Ku;
  PetscScalar square;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(y, &u));
  PetscCall(VecDuplicate(y, &Ku));
  if (vi->T)
    PetscCall(MatMult(vi->T, y, u));
  else
    PetscCall(VecCopy(y, u));
  PetscCall(MatMult(K, u, Ku));
  PetscCall(VecDot(u, Ku, &square));
  PetscCall(VecNorm(u, NORM_INFINITY, &size->max));
  size->energy = PetscSqrtReal(PetscAbsScalar(square)); // negative by roundoff only
  PetscCall(VecDestroy(&u));
  PetscCall(VecDestroy(&Ku));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether two solutions agree within the accuracy of their solvers (eq. 11.4). [in] iterated - whether one of
   them was iterated; [out] check - displacement_difference; [out] all - of the first one */
static PetscErrorCode CrossCheckAreNear_Private(VI vi, Vec first, Vec second, PetscBool iterated, CrossCheck *check,
                                                Size *all, PetscBool *near)
{
  Vec  difference;
  Size d;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(first, &difference));
  PetscCall(VecWAXPY(difference, -1, second, first));
  PetscCall(CrossCheckMeasure_Private(vi, difference, &d));
  PetscCall(CrossCheckMeasure_Private(vi, first, all));
  PetscCall(VecDestroy(&difference));
  check->displacement_difference = all->max > 0 ? d.max / all->max : d.max;
  PetscCall(PetscInfo(vi->A, "displacements differ by %g in the energy norm, of %g\n", (double)d.energy,
                      (double)all->energy));
  *near = (PetscBool)(check->displacement_difference <= AGREE);
  if (*near || !(check->displacement_difference <= AGREE_ILL)) PetscFunctionReturn(PETSC_SUCCESS);
  *near = (PetscBool)(iterated && d.energy <= PROMISED_DIFFERENCE * all->energy);
  if (!*near) PetscCall(CrossCheckAgreeToRoundoff_Private(vi, first, second, all->max, near));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverCrossCheck(Solver solver, Vec y, const SolverReport *report, CrossCheck *check)
{
  const VI     vi = solver->vi;
  SolverChoice choice;
  Vec          second;
  Size         size;
  PetscBool    near = PETSC_FALSE, again, iterated;

  PetscFunctionBeginUser;
  PetscCall(SolverChoiceSetSecond(vi, report, PREFIX, &choice));
  choice.keep = vi->scene && vi->scene->keep;
  if (SolverChoiceFactors(choice.pc) && !choice.keep) PetscCall(MeshLevelsDestroy(&solver->levels));
  PetscCall(VecDuplicate(y, &second));
  PetscCall(SolverRun(solver, &choice, PETSC_FALSE, NULL, second, &check->other));
  PetscCall(SolverChoiceSetFallback(&check->other, &choice, &again));
  if (again) PetscCall(SolverRun(solver, &choice, PETSC_FALSE, NULL, second, &check->other));
  if (!choice.keep) PetscCall(MeshLevelsDestroy(&solver->levels));
  if (choice.fixed_point)
    PetscCall(PetscStrncpy(check->other.type, "fixed point over Tresca", sizeof(check->other.type)));
  iterated = (PetscBool)(!SolverChoiceFactors(report->pc) || !SolverChoiceFactors(check->other.pc));
  PetscCall(CrossCheckAreNear_Private(vi, y, second, iterated, check, &size, &near));
  PetscCall(CrossCheckCompareSets_Private(vi, y, second, size.max, &check->active_difference));
  check->done  = PETSC_TRUE;
  check->agree = (PetscBool)(check->other.converged && near && !check->active_difference);
  PetscCall(VecDestroy(&second));
  PetscFunctionReturn(PETSC_SUCCESS);
}
