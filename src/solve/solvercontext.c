/* solvercontext.c -- all that solving an inequality takes, laid out and cleared away. */
#include <string.h>
#include "base/compat.h"
#include "pdas/pdas.h"
#include "rigid/nearnullspace.h"
#include "solve/solvercontext.h"
#include "multigrid/multigrid.h"

/* Puts defaults into the options database where the user has put nothing, or takes them out again. */
static PetscErrorCode DefaultsApply_Private(Workbench *bench, PetscBool apply)
{
  Default *defaults = bench->defaults;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < WORKBENCH_DEFAULTS; i++) {
    char      option[128];
    PetscBool there;

    PetscCall(PetscSNPrintf(option, sizeof(option), "-%s%s", bench->prefix, defaults[i].name));
    if (!defaults[i].needed) continue; /* not even looked up: an option that nothing reads is a mistake */
    if (apply) {
      PetscCall(PetscOptionsGetString(NULL, NULL, option, defaults[i].given, sizeof(defaults[i].given), &there));
      defaults[i].set = (PetscBool)!there;
      if (defaults[i].set) PetscCall(PetscOptionsSetValue(NULL, option, defaults[i].value));
    } else if (defaults[i].set) {
      PetscCall(PetscOptionsClearValue(NULL, option));
    } else {
      PetscCall(PetscOptionsSetValue(NULL, option, defaults[i].given));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* MUMPS: spare memory, in percent; approximate minimum degree, which orders meshes in 2D in a fifth of the time of what MUMPS would
   choose, for factors of the same size. A tolerance in the unit of y, which is of order one. [in] previous - whether there is a set to
   begin with */
static void Defaults_Private(VI vi, const SolveChoice *choice, PetscBool previous, Default defaults[])
{
  const PetscBool direct = SolveFactors(choice->pc), pdas = (PetscBool)!strcmp(choice->snes, SNESPDAS);

  defaults[0] = (Default){.name = "mat_mumps_icntl_14", .value = "50", .needed = direct};
  defaults[1] = (Default){.name = "mat_mumps_icntl_7", .value = "0", .needed = direct && vi->level->dim == 2};
  defaults[2] = (Default){.name = "snes_vi_zero_tolerance", .value = "1e-12", .needed = !pdas};
  defaults[3] = (Default){.name = "snes_pdas_start", .value = "previous", .needed = pdas && previous};
}

/* A as the choice needs it: multigrid needs its products alone, AMG the motions of the bodies. */
static PetscErrorCode Prepare_Private(VI vi, const SolveChoice *choice)
{
  const PetscBool multigrid = (PetscBool)!strcmp(choice->pc, PCTRUNCATEDMG);

  PetscFunctionBeginUser;
  if (!multigrid) PetscCall(VIAssemble(vi));
  if (!multigrid && !SolveFactors(choice->pc)) PetscCall(NearNullSpaceAttach(vi));
  if (multigrid) PetscCall(VIPrepareProducts(vi));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The levels that the last solve has kept, if any: their finest one is what is solved now. */
static PetscErrorCode TakeLevels_Private(Workbench *bench, Vec W)
{
  PetscFunctionBeginUser;
  bench->levels         = bench->solver->levels;
  bench->solver->levels = NULL;
  if (!bench->levels) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MeshLevelsSetInequality(bench->levels, bench->levels->num - 1, &bench->springs.solved, W));
  bench->levels->hierarchy->work = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode WorkbenchSetLevels(Workbench *bench, SNES snes)
{
  const Springs *springs = &bench->springs;
  const Vec      W       = springs->solvability ? springs->solvability->regularization : NULL;
  Hierarchy      hierarchy;
  PetscBool      multigrid;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)bench->pc, PCTRUNCATEDMG, &multigrid));
  if (!multigrid || !springs->solved.vi->mesh) PetscFunctionReturn(PETSC_SUCCESS);
  if (!bench->levels) PetscCall(TakeLevels_Private(bench, W));
  if (!bench->levels) PetscCall(MeshLevelsCreate(&springs->solved, W, &bench->levels));
  hierarchy = bench->levels->hierarchy;
  PetscCall(MultigridSetHierarchy(bench->pc, hierarchy, hierarchy->num - 1, snes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode WorkbenchCreate(Solver solver, const SolveChoice *choice, PetscBool previous, Workbench *bench)
{
  const VI vi = solver->vi;
  KSP      ksp;

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(bench, sizeof(*bench)));
  bench->solver = solver;
  bench->prefix = choice->prefix;
  bench->keep   = choice->keep;
  PetscCall(Prepare_Private(vi, choice));
  PetscCall(SpringsBegin(vi, solver->solvability, &bench->springs));
  PetscCall(VecDuplicate(vi->b, &bench->scratch));
  Defaults_Private(vi, choice, previous, bench->defaults);
  PetscCall(DefaultsApply_Private(bench, PETSC_TRUE));
  PetscCall(SolveConfigure(&bench->springs.solved, choice, bench->scratch, &bench->norm, &bench->snes));
  PetscCall(SNESGetKSP(bench->snes, &ksp));
  PetscCall(KSPGetPC(ksp, &bench->pc));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode WorkbenchDestroy(Workbench *bench, Vec y)
{
  PetscFunctionBeginUser;
  PetscCall(DefaultsApply_Private(bench, PETSC_FALSE));
  PetscCall(SNESDestroy(&bench->snes));
  if (bench->levels && bench->keep) {
    PetscCall(MeshLevelsDestroy(&bench->solver->levels));
    bench->solver->levels = bench->levels;
    bench->levels         = NULL;
  }
  PetscCall(MeshLevelsDestroy(&bench->levels));
  PetscCall(VecDestroy(&bench->scratch));
  PetscCall(SpringsEnd(&bench->springs, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}
