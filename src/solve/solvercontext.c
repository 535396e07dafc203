/* solvercontext.c -- creation and destruction of all objects of one solve. */
#include <string.h>
#include "base/compat.h"
#include "pdas/pdas.h"
#include "pdas/pdasimpl.h"
#include "rigid/nearnullspace.h"
#include "solve/solvercontext.h"
#include "multigrid/multigrid.h"

/* Sets defaults in the options database where the user has set nothing, or all that are forced; or removes
   them. */
static PetscErrorCode SolverContextDefaultsApply_Private(SolverContext *context, PetscBool apply)
{
  Default *defaults = context->defaults;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < SOLVERCONTEXT_DEFAULTS; i++) {
    char      option[128];
    PetscBool there;

    PetscCall(PetscSNPrintf(option, sizeof(option), "-%s%s", context->prefix, defaults[i].name));
    if (!defaults[i].needed) continue; /* not looked up: an option that nothing reads is an error */
    if (apply) {
      PetscCall(PetscOptionsGetString(NULL, NULL, option, defaults[i].given, sizeof(defaults[i].given), &there));
      defaults[i].set = (PetscBool)!there;
      if (defaults[i].set || defaults[i].forced) PetscCall(PetscOptionsSetValue(NULL, option, defaults[i].value));
    } else if (defaults[i].set) {
      PetscCall(PetscOptionsClearValue(NULL, option));
    } else {
      PetscCall(PetscOptionsSetValue(NULL, option, defaults[i].given));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* MUMPS: workspace margin in percent; approximate minimum degree, which orders 2D meshes in a fifth of the
   time of MUMPS' own choice, for factors of the same size. A tolerance in the unit of y, which is of order
   one. The linear solver that replaces the user's, which failed. [in] previous - whether there is an initial
   set */
static void SolverContextDefaults_Private(VI vi, const SolverChoice *choice, PetscBool previous, Default defaults[])
{
  const PetscBool direct = SolverChoiceFactors(choice->pc), pdas = (PetscBool)!strcmp(choice->snes, SNESPDAS);

  defaults[0] = (Default){.name = "mat_mumps_icntl_14", .value = "50", .needed = direct};
  defaults[1] = (Default){.name = "mat_mumps_icntl_7", .value = "0", .needed = direct && vi->level->dim == 2};
  defaults[2] = (Default){.name = "snes_vi_zero_tolerance", .value = "1e-12", .needed = !pdas};
  defaults[3] = (Default){.name = "snes_pdas_start", .value = "previous", .needed = pdas && previous};
  defaults[4] = (Default){.name = "ksp_type", .value = KSPPREONLY, .needed = choice->replaces, .forced = PETSC_TRUE};
  defaults[5] = (Default){.name = "pc_type", .value = PCCHOLESKY, .needed = choice->replaces, .forced = PETSC_TRUE};
}

/* Prepares A for the choice: as products for multigrid, as a matrix for others; rigid body modes for AMG. */
static PetscErrorCode SolverContextPrepare_Private(VI vi, const SolverChoice *choice)
{
  const PetscBool multigrid = (PetscBool)!strcmp(choice->pc, PCTRUNCATEDMG);

  PetscFunctionBeginUser;
  if (!multigrid) PetscCall(VIAssemble(vi));
  if (!multigrid && !SolverChoiceFactors(choice->pc)) PetscCall(NearNullSpaceAttach(vi));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Work is counted for each solve. */
static void SolverContextCountAnew_Private(MeshLevels levels)
{
  levels->hierarchy->work        = 0;
  levels->hierarchy->num_systems = 0;
  levels->cost.over = levels->cost.found = PETSC_FALSE;
}

/* Takes the levels kept by the last solve, if any, and sets their finest one. */
static PetscErrorCode SolverContextTakeLevels_Private(SolverContext *context, Vec W)
{
  PetscFunctionBeginUser;
  context->levels         = context->solver->levels;
  context->solver->levels = NULL;
  if (!context->levels) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MeshLevelsSetInequality(context->levels, context->levels->num - 1, &context->proximal.solved, W));
  SolverContextCountAnew_Private(context->levels);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverContextSetLevels(SolverContext *context, SNES snes)
{
  const Proximal *proximal = &context->proximal;
  const Vec       W        = proximal->solvability ? proximal->solvability->regularization : NULL;
  Hierarchy       hierarchy;
  PetscBool       multigrid;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)context->pc, PCTRUNCATEDMG, &multigrid));
  if (!multigrid || !proximal->solved.vi->mesh) PetscFunctionReturn(PETSC_SUCCESS);
  if (!context->levels) PetscCall(SolverContextTakeLevels_Private(context, W));
  if (!context->levels) PetscCall(MeshLevelsCreate(&proximal->solved, W, &context->solver->older, &context->levels));
  hierarchy = context->levels->hierarchy;
  PetscCall(MultigridSetHierarchy(context->pc, hierarchy, hierarchy->num - 1, snes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Tells pdas the areas of rows: forces over them are pressures. Collective. */
static PetscErrorCode SolverContextSetAreas_Private(const VI vi, SNES snes)
{
  PetscScalar *a;
  PetscInt     begin;
  Vec          areas;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(vi->upper, &areas));
  PetscCall(VecZeroEntries(areas));
  PetscCall(VecGetOwnershipRange(areas, &begin, NULL));
  PetscCall(VecGetArray(areas, &a));
  for (PetscInt r = 0; r < vi->num_rows; r++) a[vi->row_dof[r] - begin] = vi->row_D[r];
  PetscCall(VecRestoreArray(areas, &a));
  PetscCall(PDASSetAreas(snes, areas));
  PetscCall(VecDestroy(&areas));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverContextCreate(Solver solver, const SolverChoice *choice, PetscBool previous,
                                   SolverContext *context)
{
  const VI vi = solver->vi;
  KSP      ksp;

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(context, sizeof(*context)));
  context->solver = solver;
  context->choice = *choice;
  context->prefix = choice->prefix;
  context->keep   = choice->keep;
  PetscCall(SolverContextPrepare_Private(vi, choice));
  PetscCall(ProximalBegin(vi, solver->solvability, &context->proximal));
  PetscCall(VecDuplicate(vi->b, &context->scratch));
  SolverContextDefaults_Private(vi, choice, previous, context->defaults);
  PetscCall(SolverContextDefaultsApply_Private(context, PETSC_TRUE));
  PetscCall(SNESSetupCreate(&context->proximal.solved, choice, context->scratch, &context->norm, &context->snes));
  if (!strcmp(choice->snes, SNESPDAS)) PetscCall(SolverContextSetAreas_Private(vi, context->snes));
  if (vi->friction) PetscCall(PDASSetFriction(context->snes, vi->friction));
  if (vi->friction) PetscCall(PDASSetFrictionYields(context->snes, choice->stalls));
  if (choice->fixed_point) PetscCall(PDASSetFrictionFixedPoint(context->snes, PETSC_TRUE));
  PetscCall(SNESGetKSP(context->snes, &ksp));
  PetscCall(KSPGetPC(ksp, &context->pc));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverContextDestroy(SolverContext *context, Vec y)
{
  PetscFunctionBeginUser;
  PetscCall(SolverContextDefaultsApply_Private(context, PETSC_FALSE));
  PetscCall(SNESDestroy(&context->snes));
  if (context->levels && context->keep) {
    PetscCall(MeshLevelsDestroy(&context->solver->levels));
    context->solver->levels = context->levels;
    context->levels         = NULL;
  }
  PetscCall(MeshLevelsDestroy(&context->levels));
  PetscCall(VecDestroy(&context->scratch));
  PetscCall(ProximalEnd(&context->proximal, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverContextForget(Solver solver)
{
  Vec y;

  PetscFunctionBeginUser;
  if (!solver->context) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecDuplicate(solver->vi->b, &y));
  PetscCall(VecZeroEntries(y));
  PetscCall(SolverContextDefaultsApply_Private(solver->context, PETSC_TRUE)); // which destroying takes back
  PetscCall(SolverContextDestroy(solver->context, y));
  PetscCall(PetscFree(solver->context));
  PetscCall(VecDestroy(&y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverContextTake(Solver solver, const SolverChoice *choice, PetscBool previous, SolverContext **context)
{
  const SolverContext *kept  = solver->context;
  const SolverChoice  *other = kept ? &kept->choice : NULL;

  PetscFunctionBeginUser;
  if (kept && !strcmp(other->snes, choice->snes) && !strcmp(other->ksp, choice->ksp) &&
      !strcmp(other->pc, choice->pc) && !strcmp(other->prefix, choice->prefix)) {
    *context        = solver->context;
    solver->context = NULL;
    PetscCall(SolverContextDefaultsApply_Private(*context, PETSC_TRUE));
    if ((*context)->levels) SolverContextCountAnew_Private((*context)->levels);
    (*context)->keep = choice->keep;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscNew(context));
  PetscCall(SolverContextCreate(solver, choice, previous, *context));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverContextReturn(SolverContext **context, PetscBool keep, Vec y)
{
  PetscFunctionBeginUser;
  if (keep) {
    const Solver solver = (*context)->solver;

    PetscCall(SolverContextForget(solver));
    PetscCall(SolverContextDefaultsApply_Private(*context, PETSC_FALSE));
    PetscCall(ProximalFinish(&(*context)->proximal, y));
    solver->context = *context;
    *context        = NULL;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(SolverContextDestroy(*context, y));
  PetscCall(PetscFree(*context));
  PetscFunctionReturn(PETSC_SUCCESS);
}
