/* multigrid.c -- truncated multigrid for the systems of active sets.

   Fixed unknowns, active ones and those of the operator, are not part of a system:

       A^ = M A M + (1 - M) diag(A),   M = 0 where fixed, 1 elsewhere.

   Nothing is interpolated to fixed unknowns [1]: P^ = M P. The operator of the coarser level is P^' A P^ =
   A_c + P'(M A M - A) P with its own matrix A_c = P'A P (meshlevels.c). The second term is nonzero only near
   fixed unknowns. A coarse unknown whose prolongation is mostly fixed is fixed as well. PCMG does the cycles;
   this file provides its operators. The type is built on PCSHELL, with public headers.

   References: [1] Kornhuber, Monotone multigrid methods for elliptic variational inequalities I, 1994;
   Graeser, Kornhuber, Multigrid methods for obstacle problems, 2009. [2] Bramble, Pasciak, New convergence
   estimates for multigrid algorithms, 1987: the variable V-cycle. */
#include "base/compat.h"
#include "base/usererror.h"
#include "multigrid/redundantsolve.h"
#include "multigrid/submatrix.h"
#include "multigrid/bodysmoother.h"
#include "multigrid/multigrid.h"
#include "multigrid/mglevel.h"
#include "multigrid/patchsmoother.h"
#include "multigrid/smoother.h"

static const char CONTEXT[] = "MortiseMultigrid"; /* name under which the context is composed */

/* Smoothing steps on the two finest levels, and the lower end of the smoothed spectrum relative to its upper
   end. Each coarser level has one step more than the one above it [2]. Their cost is small, and iterations do
   not grow with the number of levels. */
enum { SMOOTHING_STEPS = 3 };
static const PetscReal SMOOTHED_FROM = 0.07;
/* The same over cells of order 1 of nearly incompressible bodies. Displacements that keep the volume of each
   cell extend beyond a patch of one cell. One square of 32 x 32 cells, nu = 0.4999: 48 iterations with three
   steps from 0.1, 26 with these, 17 with eight from 0.01. */
enum { SMOOTHING_STEPS_CELLS = 5 };
static const PetscReal SMOOTHED_FROM_CELLS = 0.02;
/* The same from this Poisson's ratio on. Iterations of one system with five and with seven steps: two plates
   of 128 x 128 cells, nu = 0.4999, 29 and 23, two blocks of 20 x 20 x 20 cells 49 and 36, in the same
   seconds; with nu = 0.49 9 and 8, in 1.2 of the work. */
static const PetscReal MORE_STEPS_FROM = 0.498;
enum { SMOOTHING_STEPS_CELLS_MORE = 7 };
static const PetscReal SMOOTHED_FROM_CELLS_MORE = 0.01;
/* The same over stars of cells of order 2 whose change of volume counts at every point. Few displacements of
   a star keep it. Two plates of 64 x 64 cells cut into triangles, nu = 0.49: 31 iterations with three steps
   from 0.07, 20 with five from 0.02, 14 with these, in 0.9 of the seconds. */
enum { SMOOTHING_STEPS_POINTWISE = 8 };
static const PetscReal SMOOTHED_FROM_POINTWISE = 0.01;
/* The same on levels of bisected cells, where edges are halved once, and more often. One step more on each
   coarser level gains nothing there. */
enum { SMOOTHING_STEPS_HALVED = 3, SMOOTHING_STEPS_QUARTERED = 6 };
static const PetscReal SMOOTHED_FROM_QUARTERED = 0.025;
/* The same on the coarsest mesh between finer meshes and levels of nodes, which interpolate linearly.
   Energies of cells of order 2 are .07 to 4.4 times those of their parts of order 1 (bricks with edges of 1
   to 10). Steps are cheap there. Iterations without and with these: `contact_shapes` refined once 30 and 21,
   in .81 of the seconds; `wheel_on_rail` refined once 23 and 19, in the same. */
enum { SMOOTHING_STEPS_ABOVE_NODES = 6 };
static const PetscReal SMOOTHED_FROM_ABOVE_NODES = 0.016;
/* Factor that shortens steps after an indefinite cycle. In one scene ten steps of CG found 2.21 for the
   largest eigenvalue 2.65. With a margin of a tenth, three Chebyshev steps amplify errors there, as they do
   beyond 1.07 times their upper end. */
static const PetscReal STEP_REDUCTION = 1.25;

typedef struct {
  Hierarchy  hierarchy; /* borrowed */
  PetscInt   num;       /* levels */
  MGLevel   *level;     /* coarse first */
  Mat        outer;     /* A^ of the finest level, to iterate with */
  PC         mg;
  SNES       snes; /* borrowed, or NULL */
  IS         left; /* inactive unknowns of snes, or NULL */
  VecScatter scatter;
  Vec        r, z;    /* on all unknowns */
  PetscReal  seen[2]; /* r'z of the last two cycles since MultigridResetError() */
} Multigrid;

static PetscErrorCode MultigridGet_Private(PC pc, Multigrid **multigrid)
{
  PetscContainer container;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectQuery((PetscObject)pc, CONTEXT, (PetscObject *)&container));
  *multigrid = NULL;
  if (container) PetscCall(PetscContainerGetPointer(container, (void **)multigrid));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a level is smoothed over cells. [out] stars - or over stars where changes of volume count at every
   point, not beside bisected cells */
static PetscErrorCode MultigridHasCells_Private(const MGLevel *level, PetscBool *cells, PetscBool *stars)
{
  const Operator *op      = &level->base->op;
  PetscBool       patches = PETSC_FALSE;

  PetscFunctionBeginUser;
  *cells = PETSC_FALSE;
  if (level->S) PetscCall(PatchSmootherIs(level->S, &patches, cells));
  *stars = (PetscBool)(patches && !*cells && op->pointwise && !op->halvings);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether Poisson's ratio asks for more steps over cells. */
static PetscBool MultigridIsTighter_Private(const MGLevel *level)
{
  return (PetscBool)(level->base->op.poisson >= MORE_STEPS_FROM);
}

/* Whether a level is the coarsest mesh, with levels on both sides. */
static PetscBool MultigridIsAboveNodes_Private(const MGLevel *level)
{
  const Hierarchy h = level->hierarchy;

  return (PetscBool)(h->first > 0 && h->first < h->num - 1 && level->base == &h->level[h->first]);
}

/* The lower end of the smoothed spectrum of a level relative to its upper end. */
static PetscErrorCode MultigridGetLowerEnd_Private(const MGLevel *level, PetscReal *from)
{
  PetscBool cells, stars;

  PetscFunctionBeginUser;
  PetscCall(MultigridHasCells_Private(level, &cells, &stars));
  *from = level->base->op.halvings > 1 ? SMOOTHED_FROM_QUARTERED : SMOOTHED_FROM;
  if (MultigridIsAboveNodes_Private(level)) *from = SMOOTHED_FROM_ABOVE_NODES;
  if (stars) *from = SMOOTHED_FROM_POINTWISE;
  if (cells) *from = MultigridIsTighter_Private(level) ? SMOOTHED_FROM_CELLS_MORE : SMOOTHED_FROM_CELLS;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Smoothing steps on level l. */
static PetscErrorCode MultigridGetSteps_Private(const Multigrid *multigrid, PetscInt l, PetscInt *steps)
{
  const MGLevel *level = &multigrid->level[l];
  PetscInt       top = multigrid->num - 1, of_cells = SMOOTHING_STEPS_CELLS;
  PetscBool      cells, stars;

  PetscFunctionBeginUser;
  PetscCall(MultigridHasCells_Private(level, &cells, &stars));
  if (MultigridIsTighter_Private(level)) of_cells = SMOOTHING_STEPS_CELLS_MORE;
  while (!cells && top > l && multigrid->level[top].base->op.halvings) top--;
  if (level->base->op.halvings && !cells)
    *steps = level->base->op.halvings > 1 ? SMOOTHING_STEPS_QUARTERED : SMOOTHING_STEPS_HALVED;
  else
    *steps = (cells ? of_cells : SMOOTHING_STEPS) + PetscMax(top - 1 - l, 0);
  if (!cells && MultigridIsAboveNodes_Private(level)) *steps = SMOOTHING_STEPS_ABOVE_NODES;
  if (stars) *steps = SMOOTHING_STEPS_POINTWISE + PetscMax(top - 1 - l, 0);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Operators of a smoother. */
static PetscErrorCode MultigridSetOperators_Private(KSP ksp, const MGLevel *level)
{
  PetscReal from = SMOOTHED_FROM;

  PetscFunctionBeginUser;
  PetscCall(MultigridGetLowerEnd_Private(level, &from));
  PetscCall(KSPSetOperators(ksp, level->A, level->S ? level->S : level->A));
  PetscCall(KSPChebyshevSetEigenvalues(ksp, level->largest, from * level->largest)); // nothing for other types
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Updates all levels. [in] free - of the finest level */
static PetscErrorCode MultigridUpdate_Private(Multigrid *multigrid, Vec free, Mat more)
{
  const MGLevel *finest = &multigrid->level[multigrid->num - 1];
  PetscBool      same   = PETSC_FALSE;
  KSP            ksp;
  PC             pc;

  PetscFunctionBeginUser;
  if (finest->ready && !finest->change && !more) PetscCall(VecEqual(free, finest->free, &same));
  if (same) PetscFunctionReturn(PETSC_SUCCESS); // a prediction may end with the set of the first system
  PetscCall(MGLevelSetFree(multigrid->num, multigrid->level, free, more));
  PetscCall(MGLevelAssemble(&multigrid->level[0]));
  PetscCall(PCMGGetCoarseSolve(multigrid->mg, &ksp));
  PetscCall(KSPSetOperators(ksp, multigrid->level[0].A, multigrid->level[0].A));
  PetscCall(KSPGetPC(ksp, &pc));
  /* All messages come before the factors, which ranks compute at once. */
  PetscCall(RedundantSolveGather(pc));
  for (PetscInt l = 1; l < multigrid->num; l++) { // factors of smoothers are out of date
    PetscCall(MatAssemblyBegin(multigrid->level[l].A, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(multigrid->level[l].A, MAT_FINAL_ASSEMBLY));
    PetscCall(PCMGGetSmoother(multigrid->mg, l, &ksp));
    PetscCall(MultigridSetOperators_Private(ksp, &multigrid->level[l]));
    PetscCall(KSPGetPC(ksp, &pc));
    if (multigrid->level[l].S) PetscCall(SmootherRenew(pc));
  }
  PetscCall(PCSetUp(multigrid->mg));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridSetFree(PC pc, Vec free, Mat more)
{
  Multigrid *multigrid;

  PetscFunctionBeginUser;
  PetscCall(MultigridGet_Private(pc, &multigrid));
  if (multigrid) PetscCall(MultigridUpdate_Private(multigrid, free, more));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridSmoothsMore(PC pc, PetscBool *smooths)
{
  Multigrid *multigrid;
  PetscBool  by_body = PETSC_FALSE;
  Mat        S, blocks = NULL;

  PetscFunctionBeginUser;
  PetscCall(MultigridGet_Private(pc, &multigrid));
  S = multigrid->level[multigrid->num - 1].base->S;
  if (S) PetscCall(BodySmootherIs(S, &by_body));
  if (by_body) PetscCall(BodySmootherGetBlocks(S, &blocks));
  *smooths = (PetscBool)(!by_body || blocks);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridShortenSteps(PC pc)
{
  Multigrid *multigrid;
  KSP        ksp;

  PetscFunctionBeginUser;
  PetscCall(MultigridGet_Private(pc, &multigrid));
  for (PetscInt l = 1; l < multigrid->num; l++) {
    MGLevel *level = &multigrid->level[l];

    level->base->largest *= STEP_REDUCTION;
    level->largest *= STEP_REDUCTION;
    PetscCall(PCMGGetSmoother(multigrid->mg, l, &ksp));
    PetscCall(MultigridSetOperators_Private(ksp, level));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridAddWork(PC pc)
{
  Multigrid *multigrid;

  PetscFunctionBeginUser;
  PetscCall(MultigridGet_Private(pc, &multigrid));
  multigrid->hierarchy->work += multigrid->level[multigrid->num - 1].base->share;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridGetHierarchy(PC pc, Hierarchy *hierarchy)
{
  Multigrid *multigrid;

  PetscFunctionBeginUser;
  PetscCall(MultigridGet_Private(pc, &multigrid));
  *hierarchy = multigrid->hierarchy;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridGetForces(PC pc, Vec y, PetscReal *size, PetscReal *energy)
{
  Multigrid            *multigrid;
  const HierarchyLevel *base;
  PetscScalar           work, square;

  PetscFunctionBeginUser;
  PetscCall(MultigridGet_Private(pc, &multigrid));
  base = multigrid->level[multigrid->num - 1].base;
  PetscCall(MatMult(base->op.K, y, multigrid->r));
  PetscCall(VecScale(multigrid->r, 1 / base->op.stiffness));
  if (base->op.Z) PetscCall(MatMultAdd(base->op.Z, y, multigrid->r, multigrid->r));
  multigrid->hierarchy->work += base->share;
  PetscCall(VecDot(multigrid->r, y, &work));
  PetscCall(VecPointwiseDivide(multigrid->z, multigrid->r, base->diag));
  PetscCall(VecDot(multigrid->z, multigrid->r, &square));
  *energy = PetscMax(PetscRealPart(work), 0);
  *size   = PetscSqrtReal(PetscRealPart(square));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridResetError(PC pc)
{
  Multigrid *multigrid;

  PetscFunctionBeginUser;
  PetscCall(MultigridGet_Private(pc, &multigrid));
  multigrid->seen[0] = multigrid->seen[1] = PETSC_MAX_REAL;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridGetError(PC pc, PetscReal *square)
{
  Multigrid *multigrid;

  PetscFunctionBeginUser;
  PetscCall(MultigridGet_Private(pc, &multigrid));
  *square = multigrid->seen[1] * PetscMin(multigrid->seen[1] / multigrid->seen[0], 1);
  if (multigrid->seen[0] == PETSC_MAX_REAL) *square = multigrid->seen[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridGetOperator(PC pc, Mat *A)
{
  Multigrid *multigrid;

  PetscFunctionBeginUser;
  PetscCall(MultigridGet_Private(pc, &multigrid));
  *A = multigrid->outer;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Options of a smoother: its iteration, but not its preconditioner, whose eigenvalues are known. */
static PetscErrorCode MultigridSmootherFromOptions_Private(KSP ksp, PC pc)
{
  PCType    type;
  char      own[64];
  PetscBool same;

  PetscFunctionBeginUser;
  PetscCall(PCGetType(pc, &type));
  PetscCall(PetscStrncpy(own, type, sizeof(own)));
  PetscCall(KSPSetFromOptions(ksp));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, own, &same));
  PetscCall(PCGetType(pc, &type));
  if (!same) {
    PetscCall(UserErrorRaise(PetscObjectComm((PetscObject)ksp),
                             "-mg_levels_pc_type %s: the level determines its smoother, here %s; omit the option", type,
                             own));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Smoothers, transfers, the coarsest solver, and their options. */
static PetscErrorCode MultigridConfigure_Private(PC pc, Multigrid *multigrid)
{
  const char *prefix;
  PetscInt    steps = SMOOTHING_STEPS;
  KSP         ksp;
  Mat         R;
  PC          inner;

  PetscFunctionBeginUser;
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(PCCreate(PetscObjectComm((PetscObject)pc), &multigrid->mg));
  PetscCall(PCSetOptionsPrefix(multigrid->mg, prefix));
  PetscCall(PCSetType(multigrid->mg, PCMG));
  PetscCall(PCMGSetLevels(multigrid->mg, multigrid->num, NULL));
  for (PetscInt l = 1; l < multigrid->num; l++) {
    PetscCall(PCMGSetInterpolation(multigrid->mg, l, multigrid->level[l].P));
    PetscCall(MatCreateRestriction(multigrid->level[l].P, &R));
    PetscCall(PCMGSetRestriction(multigrid->mg, l, R));
    PetscCall(MatDestroy(&R));
    PetscCall(PCMGGetSmoother(multigrid->mg, l, &ksp));
    PetscCall(KSPSetType(ksp, KSPCHEBYSHEV));
    PetscCall(MultigridSetOperators_Private(ksp, &multigrid->level[l]));
    PetscCall(KSPSetNormType(ksp, KSP_NORM_NONE));
    PetscCall(MultigridGetSteps_Private(multigrid, l, &steps));
    PetscCall(KSPSetTolerances(ksp, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, steps));
    PetscCall(KSPGetPC(ksp, &inner));
    PetscCall(MGLevelSetPC(&multigrid->level[l], inner));
    PetscCall(MultigridSmootherFromOptions_Private(ksp, inner));
  }
  PetscCall(PCMGGetCoarseSolve(multigrid->mg, &ksp));
  PetscCall(KSPSetType(ksp, KSPPREONLY));
  PetscCall(KSPGetPC(ksp, &inner));
  PetscCall(RedundantSolveSetPC(inner));
  PetscCall(KSPSetFromOptions(ksp));
  PetscCall(
      PCSetOperators(multigrid->mg, multigrid->level[multigrid->num - 1].A, multigrid->level[multigrid->num - 1].A));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MultigridClear_Private(Multigrid *multigrid)
{
  PetscFunctionBeginUser;
  PetscCall(PCDestroy(&multigrid->mg));
  PetscCall(MatDestroy(&multigrid->outer));
  for (PetscInt l = 0; l < multigrid->num; l++) PetscCall(MGLevelDestroy(&multigrid->level[l]));
  PetscCall(PetscFree(multigrid->level));
  PetscCall(ISDestroy(&multigrid->left));
  PetscCall(VecScatterDestroy(&multigrid->scatter));
  PetscCall(VecDestroy(&multigrid->r));
  PetscCall(VecDestroy(&multigrid->z));
  multigrid->num = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The matrix whose submatrix snes uses. */
static PetscErrorCode MultigridSetJacobian_Private(Hierarchy hierarchy, const HierarchyLevel *base, SNES snes)
{
  Mat whole;

  PetscFunctionBeginUser;
  PetscCall(SubmatrixCreateWhole(base->op.A, base->share, &hierarchy->work, &whole));
  PetscCall(SNESSetJacobian(snes, whole, whole, NULL, NULL));
  PetscCall(MatDestroy(&whole));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridSetHierarchy(PC pc, Hierarchy hierarchy, PetscInt finest, SNES snes)
{
  Multigrid *multigrid;

  PetscFunctionBeginUser;
  PetscCall(MultigridGet_Private(pc, &multigrid));
  if (!multigrid) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MultigridClear_Private(multigrid));
  multigrid->hierarchy = hierarchy;
  multigrid->num       = finest + 1;
  multigrid->snes      = snes;
  PetscCall(PetscCalloc1(multigrid->num, &multigrid->level));
  for (PetscInt l = 0; l < multigrid->num; l++) PetscCall(MGLevelCreate(hierarchy, l, &multigrid->level[l]));
  PetscCall(VecDuplicate(multigrid->level[finest].diag, &multigrid->r));
  PetscCall(VecDuplicate(multigrid->r, &multigrid->z));
  PetscCall(MGLevelCreateOperator(&multigrid->level[finest], &multigrid->outer));
  PetscCall(MultigridConfigure_Private(pc, multigrid));
  if (snes) PetscCall(MultigridSetJacobian_Private(hierarchy, &hierarchy->level[finest], snes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* With `vinewtonrsls`: the matrix contains the inactive unknowns, which are the free ones. */
static PetscErrorCode SetUp_Multigrid(PC pc)
{
  Multigrid *multigrid;
  Vec        reduced;
  Mat        A;

  PetscFunctionBeginUser;
  PetscCall(MultigridGet_Private(pc, &multigrid));
  if (!multigrid->num) {
    PetscCall(UserErrorRaise(PetscObjectComm((PetscObject)pc),
                             "-pc_type %s: needs a mesh, and this inequality has none", PCTRUNCATEDMG));
  }
  if (!multigrid->snes) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ISDestroy(&multigrid->left));
  PetscCall(VecScatterDestroy(&multigrid->scatter));
  PetscCall(SNESVIGetInactiveSet(multigrid->snes, &multigrid->left));
  PetscCall(PetscObjectReference((PetscObject)multigrid->left));
  PetscCall(PCGetOperators(pc, &A, NULL));
  PetscCall(MatCreateVecs(A, &reduced, NULL));
  PetscCall(VecScatterCreate(multigrid->r, multigrid->left, reduced, NULL, &multigrid->scatter));
  PetscCall(VecZeroEntries(multigrid->r));
  PetscCall(VecSet(reduced, 1));
  PetscCall(VecScatterBegin(multigrid->scatter, reduced, multigrid->r, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(multigrid->scatter, reduced, multigrid->r, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecDestroy(&reduced));
  PetscCall(MultigridUpdate_Private(multigrid, multigrid->r, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* z = cycle of r; eliminated unknowns, which are decoupled, separately. [in,out] r - overwritten */
static PetscErrorCode MultigridCycle_Private(Multigrid *multigrid, Vec r, Vec z)
{
  const Operator *op = &multigrid->level[multigrid->num - 1].base->op;
  PetscScalar    *ra, *za, *alone;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(op->num_fixed, &alone));
  PetscCall(VecGetArray(r, &ra));
  for (PetscInt i = 0; i < op->num_fixed; i++) alone[i] = ra[op->fixed[i]];
  for (PetscInt i = 0; i < op->num_fixed; i++) ra[op->fixed[i]] = 0;
  PetscCall(VecRestoreArray(r, &ra));
  PetscCall(PCApply(multigrid->mg, r, z));
  PetscCall(VecGetArray(z, &za));
  for (PetscInt i = 0; i < op->num_fixed; i++) za[op->fixed[i]] = alone[i];
  PetscCall(VecRestoreArray(z, &za));
  PetscCall(PetscFree(alone));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Apply_Multigrid(PC pc, Vec r, Vec z)
{
  Multigrid  *multigrid;
  PetscScalar work;

  PetscFunctionBeginUser;
  PetscCall(MultigridGet_Private(pc, &multigrid));
  if (!multigrid->snes) {
    PetscCall(VecCopy(r, multigrid->r));
    PetscCall(MultigridCycle_Private(multigrid, multigrid->r, z));
    PetscCall(VecDot(r, z, &work));
    multigrid->seen[0] = multigrid->seen[1];
    multigrid->seen[1] = PetscRealPart(work);
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(VecZeroEntries(multigrid->r));
  PetscCall(VecScatterBegin(multigrid->scatter, r, multigrid->r, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(multigrid->scatter, r, multigrid->r, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(MultigridCycle_Private(multigrid, multigrid->r, multigrid->z));
  PetscCall(VecScatterBegin(multigrid->scatter, multigrid->z, z, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(multigrid->scatter, multigrid->z, z, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MultigridDestroy_Private(ContainerArgument argument)
{
  Multigrid *multigrid = ContainerArgumentGet(argument);

  PetscFunctionBeginUser;
  PetscCall(MultigridClear_Private(multigrid));
  PetscCall(PetscFree(multigrid));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode PCCreate_Multigrid(PC pc)
{
  Multigrid     *multigrid;
  PetscContainer container;

  PetscFunctionBeginUser;
  PetscCall(PCSetType(pc, PCSHELL));
  PetscCall(PCShellSetSetUp(pc, SetUp_Multigrid));
  PetscCall(PCShellSetApply(pc, Apply_Multigrid));
  PetscCall(PetscObjectChangeTypeName((PetscObject)pc, PCTRUNCATEDMG));
  PetscCall(PetscNew(&multigrid));
  PetscCall(PetscContainerCreate(PetscObjectComm((PetscObject)pc), &container));
  PetscCall(PetscContainerSetPointer(container, multigrid));
  PetscCall(PetscContainerSetCtxDestroy(container, MultigridDestroy_Private));
  PetscCall(PetscObjectCompose((PetscObject)pc, CONTEXT, (PetscObject)container));
  PetscCall(PetscContainerDestroy(&container));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridRegister(void)
{
  PetscFunctionBeginUser;
  PetscCall(PCRegister(PCTRUNCATEDMG, PCCreate_Multigrid));
  PetscFunctionReturn(PETSC_SUCCESS);
}
