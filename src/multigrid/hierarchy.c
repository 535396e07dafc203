/* hierarchy.c -- smoothers, eigenvalues and column sums of the given levels, and levels of nodes below
   them. */
#include "base/compat.h"
#include "multigrid/nodelevels.h"
#include "multigrid/bodysmoother.h"
#include "multigrid/eigenvalue.h"
#include "multigrid/hierarchy.h"
#include "multigrid/patchsmoother.h"
#include "multigrid/region.h"
#include "multigrid/smoother.h"
#include "multigrid/wavesolve.h"

/* Unknowns from which the coarsest mesh gets levels below it instead of a factorization, in 2D and 3D;
   unknowns of the coarsest level. */
enum { MAX_COARSEST_2D = 20000, MAX_COARSEST_3D = 10000, COARSEST_UNKNOWNS = 2500, MAX_BELOW = 16 };
/* Coarsening stops at a level with more than this part of the finer one's unknowns. */
static const PetscReal SLOW_COARSENING = 0.7;

PetscBool HierarchyIsLarge(PetscInt dim, PetscInt unknowns)
{
  return (PetscBool)(unknowns > (dim == 3 ? MAX_COARSEST_3D : MAX_COARSEST_2D));
}

/* The smoother of given level l. [in] blocks - whether the level below has one that is not the diagonal.
   Without whole lines of long cells, blocks cost several times the rest and gain little. Bisected cells
   form no lines of strong couplings. Two plates of cells 1 to 10 times as long as wide take 1.3 times the
   iterations with the diagonal. Each costs a third to two thirds. */
static PetscErrorCode HierarchyCreateSmoother_Private(HierarchyInput *input, PetscInt l, PetscBool blocks,
                                                      const Operator *op, Mat *S)
{
  PetscBool diagonal = PETSC_FALSE, round = (PetscBool)(input->parts && input->round);

  PetscFunctionBeginUser;
  if (op->tight && (input->bisected || !input->lines)) {
    PetscCall(PatchSmootherCreate(op, S));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (op->halvings && !blocks) {
    PetscCall(SmootherDependsOnFinest(op, &diagonal));
    diagonal = (PetscBool)!diagonal;
  }
  if (diagonal) PetscFunctionReturn(PETSC_SUCCESS);
  if (input->lines)
    PetscCall(SmootherCreate(op, (PetscBool)(l == input->num - 1), (PetscBool)(input->num == 1), &round, S));
  else if (op->T)
    PetscCall(BodySmootherCreate(op, S));
  input->round = round;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the largest eigenvalue of a level is that of the next one, too, if cells there are parts of its
   cells. With n cells along an edge it lacks O(1/n^2) of its limit. */
static PetscBool HierarchyTellsLargest_Private(const HierarchyLevel *level)
{
  static const PetscInt MANY = 10000; /* unknowns */
  PetscInt              n;

  return (PetscBool)(!MatGetSize(level->op.K, &n, NULL) && n >= MANY && level->largest > 0 && !level->S);
}

/* Sets up one level. [in] l - given level, -1 for a level of nodes; [in] coarsest - whether it is factored */
static PetscErrorCode HierarchyBeginLevel_Private(HierarchyInput *input, PetscInt l, PetscBool coarsest,
                                                  HierarchyLevel *level)
{
  const Mat A = level->op.A;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(A, &level->diag, NULL));
  PetscCall(MatGetDiagonal(A, level->diag));
  level->nodes = (PetscBool)(l < 0);
  level->part  = 1;
  if (coarsest) PetscFunctionReturn(PETSC_SUCCESS);
  if (!level->nodes)
    PetscCall(HierarchyCreateSmoother_Private(input, l, (PetscBool)(level->op.halvings && level[-1].S), &level->op,
                                              &level->S));
  if (l > 0 && input->parts && HierarchyTellsLargest_Private(&level[-1]) && !level->S)
    level->largest = level[-1].largest;
  else
    PetscCall(EigenvalueLargest(A, level->S, NULL, &level->largest));
  if (level->op.waves) PetscCall(WaveSolveCreate(&level->op, &level->wave_solve));
  if (!level->S) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SmootherScale(level->S, level->largest)); // S >= A, also after the same change of both
  level->largest = 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds levels of nodes. [in,out] coarsest - of the given levels; before it there is room for MAX_BELOW; [out]
   num - levels added */
static PetscErrorCode HierarchyAddNodeLevels_Private(HierarchyInput *input, HierarchyLevel *coarsest, PetscInt *num)
{
  PetscBool go = input->below;
  NodeSet   points;
  PetscInt  size, coarser;

  PetscFunctionBeginUser;
  *num = 0;
  PetscCall(MatGetSize(coarsest->op.K, &size, NULL));
  PetscCall(HierarchyBeginLevel_Private(input, 0, (PetscBool)!go, coarsest));
  if (!go) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(NodeLevelsBegin(&coarsest->op, &input->table, &points));
  for (HierarchyLevel *level = coarsest; go; level--) {
    PetscCall(NodeLevelsCoarsen(&level->op, &points, &level->P, &level[-1].op));
    PetscCall(NodeLevelsSumSquares(level->P, NULL, &level->weight));
    PetscCall(MatGetSize(level[-1].op.K, &coarser, NULL));
    go = (PetscBool)(++*num < MAX_BELOW && coarser > COARSEST_UNKNOWNS && coarser < SLOW_COARSENING * size);
    PetscCall(HierarchyBeginLevel_Private(input, -1, (PetscBool)!go, &level[-1]));
    size = coarser;
  }
  PetscCall(NodeCoarseningDestroy(&points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What is smoothed on a level above the coarsest given one. Blocks and patches do not end at a region. */
static PetscErrorCode HierarchySetRegion_Private(HierarchyLevel *level)
{
  PetscFunctionBeginUser;
  if (level->op.halvings && !level->S) PetscCall(RegionCreate(level->P, level->weight, level->op.dim, &level->region));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The costs of products. */
static PetscErrorCode HierarchySetShares_Private(Hierarchy h)
{
  PetscFunctionBeginUser;
  for (PetscInt l = h->num - 1; l >= 0; l--) {
    MatInfo info;

    PetscCall(MatGetInfo(h->level[l].op.K, MAT_GLOBAL_SUM, &info));
    h->level[l].share = info.nz_used;
  }
  for (PetscInt l = 0; l < h->num; l++) h->level[l].share /= h->level[h->num - 1].share;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HierarchyCreate(HierarchyInput *input, Hierarchy *hierarchy)
{
  Hierarchy       h;
  HierarchyLevel *given; // the given levels

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&h));
  PetscCall(PetscCalloc1(MAX_BELOW + input->num, &h->level));
  given = &h->level[MAX_BELOW];
  for (PetscInt l = 0; l < input->num; l++) {
    given[l].op = input->op[l];
    given[l].P  = input->P[l];
  }
  PetscCall(HierarchyAddNodeLevels_Private(input, given, &h->first));
  for (PetscInt l = 1; l < input->num; l++) {
    PetscCall(HierarchyBeginLevel_Private(input, l, PETSC_FALSE, &given[l]));
    PetscCall(NodeLevelsSumSquares(given[l].P, NULL, &given[l].weight));
    PetscCall(HierarchySetRegion_Private(&given[l]));
  }
  for (PetscInt l = 0; l < input->num; l++)
    PetscCall(BasisRowsDestroy(&given[l].op.inverse)); // smoothers hold a reference if they need it
  h->num = h->first + input->num;
  PetscCall(PetscArraymove(h->level, given - h->first, h->num));
  h->bisected = input->bisected;
  PetscCall(HierarchySetShares_Private(h));
  *hierarchy = h;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode HierarchyLevelDestroy_Private(HierarchyLevel *level)
{
  PetscFunctionBeginUser;
  PetscCall(OperatorDestroy(&level->op));
  PetscCall(MatDestroy(&level->P));
  PetscCall(VecDestroy(&level->weight));
  PetscCall(VecDestroy(&level->diag));
  PetscCall(MatDestroy(&level->S));
  PetscCall(VecDestroy(&level->region));
  PetscCall(PCDestroy(&level->wave_solve));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Another smoother for a level that is no longer the finest one: its blocks then contain a stiff side of
   contact. */
static PetscErrorCode HierarchyRenewLevel_Private(HierarchyInput *input, HierarchyLevel *level)
{
  PetscFunctionBeginUser;
  PetscCall(VecDestroy(&level->diag));
  PetscCall(MatDestroy(&level->S));
  PetscCall(PCDestroy(&level->wave_solve));
  PetscCall(HierarchyBeginLevel_Private(input, 0, PETSC_FALSE, level));
  if (level->S) PetscCall(VecDestroy(&level->region));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HierarchyExtend(Hierarchy h, PetscBool drop, PetscBool renew, const Operator *op, Mat P)
{
  HierarchyInput  input = {.num = 2, .lines = PETSC_TRUE}; // the smoothers of level 0 are not those of a finest one
  HierarchyLevel *top   = &h->level[h->num - 1];
  PetscBool       other = PETSC_FALSE;

  PetscFunctionBeginUser;
  if (drop) {
    PetscCall(HierarchyLevelDestroy_Private(top));
    h->num--;
  } else if (h->num > 1) {
    if (top->S) PetscCall(BodySmootherIs(top->S, &other)); // for a finest level alone
    if (!other) PetscCall(SmootherDependsOnFinest(&top->op, &other));
    if (other || renew) PetscCall(HierarchyRenewLevel_Private(&input, top));
  }
  PetscCall(PetscRealloc((size_t)(h->num + 1) * sizeof(HierarchyLevel), &h->level));
  top  = &h->level[h->num++];
  *top = (HierarchyLevel){.op = *op, .P = P};
  PetscCall(HierarchyBeginLevel_Private(&input, 1, PETSC_FALSE, top));
  PetscCall(NodeLevelsSumSquares(P, NULL, &top->weight));
  PetscCall(HierarchySetRegion_Private(top));
  PetscCall(BasisRowsDestroy(&top->op.inverse));
  PetscCall(HierarchySetShares_Private(h));
  h->work        = 0;
  h->num_systems = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HierarchySetCostTest(Hierarchy hierarchy, PetscErrorCode (*is_over)(void *, PetscReal, PetscBool *),
                                    void     *ctx)
{
  hierarchy->is_over = is_over;
  hierarchy->ctx     = ctx;
  return PETSC_SUCCESS;
}

PetscErrorCode HierarchyIsOver(Hierarchy hierarchy, PetscReal left, PetscBool *over)
{
  PetscFunctionBeginUser;
  *over = PETSC_FALSE;
  if (hierarchy->is_over) PetscCall((*hierarchy->is_over)(hierarchy->ctx, left, over));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HierarchyDestroy(Hierarchy *hierarchy)
{
  PetscFunctionBeginUser;
  if (!*hierarchy) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt l = 0; l < (*hierarchy)->num; l++) PetscCall(HierarchyLevelDestroy_Private(&(*hierarchy)->level[l]));
  PetscCall(PetscFree((*hierarchy)->level));
  PetscCall(PetscFree(*hierarchy));
  PetscFunctionReturn(PETSC_SUCCESS);
}
