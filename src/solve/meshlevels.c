/* meshlevels.c -- the inequalities of coarser meshes, and prolongation between their unknowns.

   Displacements are prolonged by the shape functions of the coarser level. Solvers have unknowns y of u = T
   y, so P^ = T_f^-1 P T_c. On nested meshes P^' A_f P^ = T_c' (P' K_f P) T_c is the coarser level's own A; no
   such product is formed. Elsewhere P' K_f P replaces the coarser level's K, since truncation subtracts parts
   of that product. */
#include "base/compat.h"
#include "problem/coarsestiffness.h"
#include "problem/elasticity.h"
#include "problem/condensedproduct.h"
#include "problem/stiffness.h"
#include "solve/cellprolongation.h"
#include "solve/meshlevels.h"
#include "solve/waves.h"

/* What fixed unknowns of the coarser level, which have their values, give to free ones of this one.
   [in] P - of all unknowns; [in] free - 1 for free unknowns, fine and coarse; [out] lift - NULL where the
   values are 0 */
static PetscErrorCode MeshLevelsCreateLift_Private(VI coarse, VI fine, Mat P, const Vec free[2], Vec *lift)
{
  PetscReal size;
  Vec       given;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(coarse->b, &given));
  PetscCall(VecPointwiseMult(given, coarse->b, free[1]));
  PetscCall(VecAYPX(given, -1, coarse->b));
  PetscCall(VecNorm(given, NORM_INFINITY, &size));
  if (size > 0) {
    PetscCall(VecDuplicate(fine->b, lift));
    PetscCall(MatMult(P, given, *lift));
    PetscCall(VecPointwiseMult(*lift, *lift, free[0]));
  }
  PetscCall(VecDestroy(&given));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* T_f^-1 P T_c, emptied where unknowns are fixed. [in] op - of both levels, coarse first; [in,out] P - of
   displacements; [out] lift - of MeshLevelsCreateLift_Private() */
static PetscErrorCode MeshLevelsCreateProlongation_Private(VI coarse, VI fine, const Operator op[2], Mat *P, Vec *lift)
{
  Vec free[2];

  PetscFunctionBeginUser;
  PetscCall(BasisRowsMultiply(&op[1].inverse, coarse->T, P));
  PetscCall(OperatorCreateFree(&op[1], &free[0]));
  PetscCall(OperatorCreateFree(&op[0], &free[1]));
  PetscCall(MeshLevelsCreateLift_Private(coarse, fine, *P, free, lift));
  PetscCall(MatDiagonalScale(*P, free[0], free[1]));
  PetscCall(VecDestroy(&free[0]));
  PetscCall(VecDestroy(&free[1]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adapted meshes grow slowly, and cycles do not need all of them. A level is omitted under two conditions.
   It has less than LEVEL_GROWTH times the nodes of the last used one. From there to the next level edges
   are halved no more than LEVEL_HALVINGS times. */
static const PetscReal LEVEL_GROWTH = 2;
enum { LEVEL_HALVINGS = 2 };

/* The most halvings of an edge from one level of the mesh to another, if they follow each other in one
   place. */
static PetscInt MeshLevelsGetHalvings_Private(Mesh mesh, PetscInt from, PetscInt to)
{
  PetscInt halvings = 0;

  for (PetscInt l = from + 1; l <= to; l++) halvings += mesh->levels[l].halvings;
  return halvings;
}

/* Whether a level of the mesh is used between others. [in] last - the last one below it that is */
static PetscBool MeshLevelsUses_Private(Mesh mesh, PetscInt last, PetscInt l)
{
  const PetscReal nodes = (PetscReal)mesh->levels[l].num_global, before = (PetscReal)mesh->levels[last].num_global;

  return (PetscBool)(!mesh->forest || nodes >= LEVEL_GROWTH * before ||
                     MeshLevelsGetHalvings_Private(mesh, last, l + 1) > LEVEL_HALVINGS);
}

/* Which levels of the mesh are used. */
static PetscErrorCode MeshLevelsSelect_Private(Mesh mesh, MeshLevels levels)
{
  PetscInt last = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(mesh->num_levels, &levels->of));
  for (PetscInt l = 0; l < mesh->num_levels; l++) {
    if (l && l + 1 < mesh->num_levels && !MeshLevelsUses_Private(mesh, last, l)) continue;
    levels->of[levels->num++] = last = l;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether no coarser level has cells of which the next one's are equal parts. */
static PetscBool MeshLevelsAreCut_Private(const struct _n_MeshLevels *levels, PetscInt l)
{
  const VI fine = levels->vi[l];

  return (PetscBool)(fine->mesh->forest || levels->of[l] != levels->of[l - 1] + 1);
}

/* The prolongation of displacements to level l. [in] least - whether nodes inside of cells that keep their
   volume take the place of least energy */
static PetscErrorCode MeshLevelsCreateDisplacements_Private(MeshLevels levels, PetscInt l, PetscBool least, Mat *P)
{
  const VI fine = levels->vi[l];

  PetscFunctionBeginUser;
  PetscCall(LevelCreateBlocks(levels->P[l], fine->level->dim, P));
  if (!least || MeshLevelsAreCut_Private(levels, l)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(CellProlongationApply(fine->scene, &fine->mesh->levels[levels->of[l - 1]], fine->level, fine->K, P));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether node values have the prolongation of displacements, and cells lie in coarser ones of the same rank:
   adapted meshes are dealt anew. */
static PetscBool MeshLevelsHavePlaces_Private(MeshLevels levels, PetscInt l, PetscBool least)
{
  PetscMPIInt size;

  (void)MPI_Comm_size(levels->vi[l]->level->comm, &size);
  return MeshLevelsAreCut_Private(levels, l) ? (PetscBool)(size == 1) : (PetscBool)!least;
}

/* Prolongation from one level of the mesh to another. [out] P - owned by the caller */
static PetscErrorCode MeshLevelsMultiply_Private(Mesh mesh, PetscInt from, PetscInt to, Mat *P)
{
  PetscFunctionBeginUser;
  *P = mesh->levels[from + 1].prolongation;
  PetscCall(PetscObjectReference((PetscObject)*P));
  for (PetscInt l = from + 2; l <= to; l++) {
    Mat product;

    PetscCall(MatMatMult(mesh->levels[l].prolongation, *P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
    PetscCall(MatProductClear(product)); // it would keep its factors
    PetscCall(MatDestroy(P));
    *P = product;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshLevelsAreNested(VI vi, PetscBool *nested)
{
  const Scene      scene = vi->scene;
  DilatationCount *counts;

  PetscFunctionBeginUser;
  *nested = PETSC_TRUE;
  PetscCall(PetscMalloc1(scene->num_bodies, &counts));
  PetscCall(ElasticityDilatationCount(scene, vi->level, counts));
  for (PetscInt b = 0; b < scene->num_bodies; b++) *nested = (PetscBool)(*nested && counts[b].poisson == 0);
  PetscCall(PetscFree(counts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the fine level's cells are parts of the coarse one's: not along curves. [in] P - of node values */
static PetscErrorCode MeshLevelsTestParts_Private(Level *coarse, Level *fine, Mat P, PetscBool *parts)
{
  static const PetscReal POSITION_TOLERANCE = 1e-9; /* relative to the scene */
  PetscReal              off[2]             = {0, 0};
  PetscScalar           *x;
  Vec                    from, to;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(coarse, 1, &from));
  PetscCall(LevelCreateVec(fine, 1, &to));
  for (PetscInt d = 0; d < fine->dim; d++) {
    PetscCall(VecGetArray(from, &x));
    for (PetscInt i = 0; i < coarse->num_owned; i++) x[i] = coarse->coords[i * coarse->dim + d];
    PetscCall(VecRestoreArray(from, &x));
    PetscCall(MatMult(P, from, to));
    PetscCall(VecGetArray(to, &x));
    for (PetscInt i = 0; i < fine->num_owned; i++) {
      const PetscReal own = fine->coords[i * fine->dim + d];

      off[0] = PetscMax(off[0], PetscAbsScalar(x[i] - own));
      off[1] = PetscMax(off[1], PetscAbsReal(own));
    }
    PetscCall(VecRestoreArray(to, &x));
  }
  PetscCall(VecDestroy(&from));
  PetscCall(VecDestroy(&to));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, off, 2, MPIU_REAL, MPI_MAX, fine->comm));
  *parts = (PetscBool)(off[0] <= POSITION_TOLERANCE * off[1]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The inequality of level l, unless it is known. Its K is P'K P of the next finer one, by itself or made so.
   [in] least - of MeshLevelsCreateDisplacements_Private(); [in,out] nested - whether energies are the same
   where cells are parts of cells, and K of the finer one is its own; whether it is so by itself; [out] P -
   displacements to the finer one, where it is not */
static PetscErrorCode MeshLevelsSetCoarse_Private(MeshLevels levels, PetscInt l, PetscBool least, PetscBool *nested,
                                                  Mat *P)
{
  const VI fine   = levels->vi[l + 1];
  Level   *coarse = &fine->mesh->levels[levels->of[l]];
  Mat      K      = NULL;

  PetscFunctionBeginUser;
  if (*nested) PetscCall(MeshLevelsTestParts_Private(coarse, fine->level, levels->P[l + 1], nested));
  if (!*nested) {
    PetscCall(MeshLevelsCreateDisplacements_Private(levels, l + 1, least, P));
    PetscCall(CoarseStiffnessCreate(coarse, fine->K, *P,
                                    MeshLevelsHavePlaces_Private(levels, l + 1, least) ? levels->P[l + 1] : NULL, &K));
  }
  if (!levels->vi[l])
    PetscCall(VICreateCoarse(fine, levels->of[l], K, &levels->vi[l]));
  else if (K)
    PetscCall(VIReplaceStiffness(levels->vi[l], K));
  PetscCall(MatDestroy(&K));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Poisson's ratio from which patches cost no more than smoothing node by node. Two plates, order 1,
   iterations node by node and in patches: 14 and 10 at 0.45, 24 and 8 at 0.47, 42 and 10 at 0.49; seconds
   0.14 and 0.19, 0.17 and 0.17, 0.16 and 0.18; of order 2 0.43 and 0.47, 0.49 and 0.48, 0.62 and 0.50. */
static const PetscReal TIGHT = 0.47;

/* Poisson's ratio from which waves gain. Two plates of 128 x 128 cells of order 1, iterations without and
   with them: 9 and 9 at 0.49, where they cost a fifth, 21 and 16 at 0.499, 63 and 29 at 0.4999. In space they
   gain nothing: displacements of alternating sign in one plane are independent of those in others. */
static const PetscReal WAVES_FROM = 0.498;

/* Nodes of cells with a Poisson's ratio not below TIGHT. [out] op - tight, poisson, pointwise */
static PetscErrorCode MeshLevelsMarkTight_Private(VI vi, Operator *op)
{
  const Level *level = vi->level;
  ElementRule *rules;
  PetscReal    most[2] = {0, 0}; // Poisson's ratio, and 1 for pointwise

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(level->num_owned, &op->tight));
  PetscCall(ElasticityRulesCreate(vi->scene, &rules));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    DilatationKind kind;
    PetscReal      poisson;

    PetscCall(ElasticityDilatationKind(vi->scene, level, c, &rules[level->cell_type[c]], &kind, &poisson));
    if (!isgreaterequal(poisson, TIGHT)) continue;
    most[0] = PetscMax(most[0], poisson);
    if (kind == DILATATION_POINTWISE) most[1] = 1;
    for (PetscInt k = level->cell_start[c]; k < level->cell_start[c + 1]; k++)
      if (level->cell_nodes[k] < level->num_owned) op->tight[level->cell_nodes[k]] = PETSC_TRUE;
  }
  PetscCall(PetscFree(rules));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, most, 2, MPIU_REAL, MPI_MAX, level->comm));
  if (most[0] == 0) PetscCall(PetscFree(op->tight));
  op->poisson   = most[0];
  op->pointwise = (PetscBool)(most[1] > 0);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Largest entry on the diagonal of K over the smallest one up to which cycles multiply in single precision.
   The rounding of a stiff body, 6e-8 of its entries, weighs on a softer one. Iterations in double and in
   single precision: 37 and 37 of two blocks with a range of 3e4, 114 and 125 with 3e6, 136 and 325 with 3e8;
   26 and 26 of `hertz3d` of order 2, 8e4 by its graded cells. */
static const PetscReal SINGLE_RANGE = 1e6;

/* Products of a cycle. [out] S - owned by the caller */
static PetscErrorCode MeshLevelsCreateProducts_Private(VI vi, Mat *S)
{
  PetscReal largest, smallest;
  Mat       K;

  PetscFunctionBeginUser;
  PetscCall(VecMax(vi->diagonal, NULL, &largest));
  PetscCall(VecMin(vi->diagonal, NULL, &smallest));
  if (largest <= SINGLE_RANGE * smallest)
    PetscCall(StiffnessCreateSingle(vi->K, 1 / vi->stiffness, &K));
  else
    PetscCall(StiffnessCreateScaled(vi->K, 1 / vi->stiffness, &K));
  PetscCall(CondensedProductCreate(K, vi, S));
  PetscCall(MatDestroy(&K));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshLevelsCreateOperator(const Inequality *inequality, Vec W, Operator *op)
{
  const VI       vi    = inequality->vi;
  const PetscInt begin = vi->level->dim * vi->level->node_begin;

  PetscFunctionBeginUser;
  *op = (Operator){.K               = vi->K,
                   .diagonal        = vi->diagonal,
                   .stiffness       = vi->stiffness,
                   .T               = vi->T,
                   .Z               = vi->Z,
                   .num_fixed       = vi->num_fixed,
                   .num_constrained = vi->num_rows,
                   .slips           = (PetscBool)(vi->friction != NULL),
                   .dim             = vi->level->dim,
                   .coords          = vi->level->coords};
  PetscCall(OperatorSetInequality(op, inequality->A, inequality->b, inequality->upper, W));
  PetscCall(PetscObjectReference((PetscObject)op->K));
  PetscCall(PetscObjectReference((PetscObject)op->diagonal));
  PetscCall(MeshLevelsCreateProducts_Private(vi, &op->S));
  PetscCall(PetscObjectReference((PetscObject)op->T));
  PetscCall(PetscObjectReference((PetscObject)op->Z));
  PetscCall(VICreateInverseBasis(vi, &op->inverse));
  PetscCall(MeshLevelsMarkTight_Private(vi, op));
  PetscCall(PetscMalloc1(op->num_fixed, &op->fixed));
  PetscCall(PetscArraycpy(op->fixed, vi->fixed_local, op->num_fixed));
  PetscCall(PetscMalloc1(op->num_constrained, &op->constrained));
  for (PetscInt r = 0; r < vi->num_rows; r++) op->constrained[r] = vi->row_dof[r] - begin;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether some cell is of second order, and whether cells may be long in whole lines. Tetrahedra of a mesh
   generator are long in single places only; those of boxes, and parts of hexahedra, follow maps. */
static PetscErrorCode MeshLevelsInspectCells_Private(VI coarsest, PetscInt meshes, PetscBool *higher, PetscBool *lines)
{
  const Level *level  = coarsest->level;
  const Scene  scene  = coarsest->scene;
  PetscBool    any[2] = {PETSC_FALSE, (PetscBool)(meshes > 1)};

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; b++)
    any[1] = (PetscBool)(any[1] || !scene->bodies[b].mesh_file || MeshIsCut(coarsest->mesh, b));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementType type = (ElementType)level->cell_type[c];

    any[0] = (PetscBool)(any[0] || ElementOrder(type) > 1);
    any[1] = (PetscBool)(any[1] || ElementLinear(type) != ELEMENT_TET4);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 2, MPIU_BOOL, MPI_LOR, level->comm));
  *higher = any[0];
  *lines  = any[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Of cells of second order the first level of nodes has the vertices, in the middle between which other nodes
   move. Orders are known cell by cell. */
static PetscErrorCode MeshLevelsCreateTable_Private(const Level *level, NodeTable *table)
{
  static const PetscReal SHAPE_ROUNDOFF = 1e-12;
  const PetscInt         n              = level->num_owned;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(n, &table->count, n * NODE_TERMS, &table->from, n * NODE_TERMS, &table->weight));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementType type = (ElementType)level->cell_type[c], linear = ElementLinear(type);
    const PetscInt   *nodes = &level->cell_nodes[level->cell_start[c]];

    for (PetscInt i = 0; i < level->cell_start[c + 1] - level->cell_start[c]; i++) {
      const PetscInt node = nodes[i];
      PetscReal      phi[ELEMENT_MAX_NODES];

      if (node >= n || table->count[node]) continue;
      ElementShape(linear, ElementNode(type, i), phi, NULL);
      for (PetscInt v = 0; v < ElementNumNodes(linear); v++) {
        if (phi[v] <= SHAPE_ROUNDOFF) continue;
        table->from[node * NODE_TERMS + table->count[node]]     = level->node_global[nodes[v]];
        table->weight[node * NODE_TERMS + table->count[node]++] = phi[v];
      }
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether energies are the same where cells are parts of cells. */
static PetscErrorCode MeshLevelsTestSame_Private(VI finest, PetscBool *same)
{
  PetscFunctionBeginUser;
  PetscCall(MeshLevelsAreNested(finest, same));
  if (finest->scene->model == MODEL_AXISYMMETRIC)
    *same = PETSC_FALSE; // 1 / radius is integrated on each level in its own way
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The inequalities of all levels; matrices as multigrid needs them. [out] below - whether there are to be
   levels below the coarsest; same - whether energies are, and cells are parts of cells; P - of
   MeshLevelsSetCoarse_Private() [levels->num] */
static PetscErrorCode MeshLevelsSetVIs_Private(MeshLevels levels, PetscBool *below, PetscBool *same, Mat P[])
{
  const VI  finest = levels->vi[levels->num - 1];
  PetscInt  size;
  PetscBool pointwise;

  PetscFunctionBeginUser;
  PetscCall(MeshLevelsTestSame_Private(finest, same));
  PetscCall(MeshLevelsAreNested(finest, &pointwise));
  for (PetscInt l = levels->num - 2; l >= 0; l--)
    PetscCall(MeshLevelsSetCoarse_Private(levels, l, (PetscBool)!pointwise, same, &P[l + 1]));
  PetscCall(VecGetSize(levels->vi[0]->b, &size));
  *below = (PetscBool)(levels->num == 1 || HierarchyIsLarge(finest->level->dim, size));
  if (!*below) PetscCall(VIAssemble(levels->vi[0]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a cell has the moduli of its parts. */
static PetscBool MeshLevelsKeepModuli_Private(Scene scene)
{
  PetscBool keep = PETSC_TRUE;

  for (PetscInt m = 0; m < scene->num_bodies + scene->num_regions; m++) {
    if (m < scene->num_bodies && scene->bodies[m].missing) continue; // all of its cells are in regions
    keep = (PetscBool)(keep && ElasticityHookeIsConstant(scene, m));
  }
  return keep;
}

/* Restricts products of cycles to the regions of levels. [in] from - the first level to be restricted */
static PetscErrorCode MeshLevelsRestrictProducts_Private(MeshLevels levels, PetscInt from)
{
  PetscFunctionBeginUser;
  for (PetscInt l = from; l < levels->num; l++) {
    HierarchyLevel *level = &levels->hierarchy->level[levels->hierarchy->first + l];

    if (level->region || level->part < 1) PetscCall(CondensedProductRestrict(level->op.S, level->region, &level->part));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Multigrid on inequalities that are known but for the coarser levels that NULL stands for. */
static PetscErrorCode MeshLevelsSetUp_Private(MeshLevels levels, const Inequality *finest, Vec W)
{
  const PetscInt num    = levels->num;
  HierarchyInput input  = {.num = num, .bisected = (PetscBool)(levels->vi[num - 1]->mesh->forest != NULL)};
  PetscBool      higher = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(num, &input.op, num, &input.P));
  PetscCall(MeshLevelsSetVIs_Private(levels, &input.below, &input.parts, input.P));
  input.parts = (PetscBool)(input.parts && MeshLevelsKeepModuli_Private(levels->vi[0]->scene));
  PetscCall(MeshLevelsInspectCells_Private(levels->vi[0], num, &higher, &input.lines));
  for (PetscInt l = 0; l < num; l++) {
    const VI         vi  = levels->vi[l];
    const Inequality own = {.vi = vi, .A = vi->A, .b = vi->b, .upper = vi->upper};

    PetscCall(MeshLevelsCreateOperator(l + 1 < num ? &own : finest, l + 1 < num ? NULL : W, &input.op[l]));
    if (!l) continue;
    input.op[l].halvings = MeshLevelsGetHalvings_Private(vi->mesh, levels->of[l - 1], levels->of[l]);
    if (input.op[l].poisson >= WAVES_FROM && vi->level->dim == 2 && !higher && !input.bisected)
      PetscCall(WavesCreate(&input.op[l], vi->level, levels->P, l, &input.op[l].waves));
    PetscCall(VecDestroy(&levels->lift[l]));
    if (!input.P[l]) PetscCall(MeshLevelsCreateDisplacements_Private(levels, l, PETSC_FALSE, &input.P[l]));
    PetscCall(
        MeshLevelsCreateProlongation_Private(levels->vi[l - 1], vi, &input.op[l - 1], &input.P[l], &levels->lift[l]));
  }
  if (input.below && higher) PetscCall(MeshLevelsCreateTable_Private(levels->vi[0]->level, &input.table));
  PetscCall(HierarchyCreate(&input, &levels->hierarchy));
  PetscCall(MeshLevelsRestrictProducts_Private(levels, 1));
  PetscCall(PetscFree2(input.op, input.P));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Levels of a mesh. */
static PetscErrorCode MeshLevelsBegin_Private(const Inequality *finest, Vec W, MeshLevels *levels_out)
{
  const Mesh mesh = finest->vi->mesh;
  MeshLevels levels;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&levels));
  PetscCall(MeshLevelsSelect_Private(mesh, levels));
  PetscCall(PetscCalloc1(levels->num, &levels->vi));
  PetscCall(PetscCalloc1(levels->num, &levels->lift));
  PetscCall(PetscCalloc1(levels->num, &levels->P));
  levels->vi[levels->num - 1] = finest->vi;
  for (PetscInt l = 1; l < levels->num; l++)
    PetscCall(MeshLevelsMultiply_Private(mesh, levels->of[l - 1], levels->of[l], &levels->P[l]));
  PetscCall(MeshLevelsSetUp_Private(levels, finest, W));
  *levels_out = levels;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Puts a level of the mesh on top, in the place of the finest one so far, or above it. [in] vi - of it */
static PetscErrorCode MeshLevelsPush_Private(MeshLevels levels, VI vi, PetscBool drop)
{
  const PetscInt num = drop ? levels->num : levels->num + 1;

  PetscFunctionBeginUser;
  if (drop) {
    PetscCall(VIDestroy(&levels->vi[num - 1]));
    PetscCall(VecDestroy(&levels->lift[num - 1]));
    PetscCall(MatDestroy(&levels->P[num - 1]));
  }
  PetscCall(PetscRealloc((size_t)num * sizeof(PetscInt), &levels->of));
  PetscCall(PetscRealloc((size_t)num * sizeof(VI), &levels->vi));
  PetscCall(PetscRealloc((size_t)num * sizeof(Vec), &levels->lift));
  PetscCall(PetscRealloc((size_t)num * sizeof(Mat), &levels->P));
  levels->num           = num;
  levels->of[num - 1]   = vi->mesh->num_levels - 1;
  levels->vi[num - 1]   = vi;
  levels->lift[num - 1] = NULL;
  levels->own_finest    = PETSC_FALSE;
  PetscCall(MeshLevelsMultiply_Private(vi->mesh, levels->of[num - 2], levels->of[num - 1], &levels->P[num - 1]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the new level of the mesh. Where K of coarser ones is not P'K P of it, all of it is made anew but for
   contact and supports. */
static PetscErrorCode MeshLevelsExtend_Private(MeshLevels levels, const Inequality *finest, Vec W)
{
  const Mesh      mesh = finest->vi->mesh;
  const PetscBool drop =
      (PetscBool)!MeshLevelsUses_Private(mesh, levels->of[levels->num - 2], levels->of[levels->num - 1]);
  const PetscBool renew = (PetscBool)(levels->hierarchy->level[levels->hierarchy->num - 1].op.W != NULL);
  Operator        op[2];
  PetscBool       nested;
  VI              next;
  Mat             P;

  PetscFunctionBeginUser;
  PetscCall(MeshLevelsPush_Private(levels, finest->vi, drop));
  PetscCall(MeshLevelsTestSame_Private(finest->vi, &nested));
  next = levels->vi[levels->num - 2];
  if (nested)
    PetscCall(MeshLevelsTestParts_Private(next->level, finest->vi->level, levels->P[levels->num - 1], &nested));
  if (!nested) {
    PetscCall(HierarchyDestroy(&levels->hierarchy));
    PetscCall(MeshLevelsSetUp_Private(levels, finest, W));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(MeshLevelsSetInequality(levels, levels->num - 2,
                                    &(Inequality){.vi = next, .A = next->A, .b = next->b, .upper = next->upper}, NULL));
  op[0] = levels->hierarchy->level[levels->hierarchy->first + levels->num - 2].op;
  PetscCall(MeshLevelsCreateOperator(finest, W, &op[1]));
  op[1].halvings = MeshLevelsGetHalvings_Private(mesh, levels->of[levels->num - 2], levels->of[levels->num - 1]);
  PetscCall(MeshLevelsCreateDisplacements_Private(levels, levels->num - 1, PETSC_FALSE, &P));
  PetscCall(MeshLevelsCreateProlongation_Private(next, finest->vi, op, &P, &levels->lift[levels->num - 1]));
  PetscCall(HierarchyExtend(levels->hierarchy, drop, renew, &op[1], P));
  PetscCall(MeshLevelsRestrictProducts_Private(levels, PetscMax(levels->num - 2, 1)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshLevelsCreate(const Inequality *finest, Vec W, MeshLevels *older, MeshLevels *levels)
{
  PetscFunctionBeginUser;
  *levels = NULL;
  if (older && *older && (*older)->num > 1 && (*older)->of[(*older)->num - 1] == finest->vi->mesh->num_levels - 2) {
    *levels = *older;
    *older  = NULL;
    PetscCall(MeshLevelsExtend_Private(*levels, finest, W));
  } else {
    if (older) PetscCall(MeshLevelsDestroy(older));
    PetscCall(MeshLevelsBegin_Private(finest, W, levels));
  }
  PetscCall(CostModelSet(&(*levels)->cost, finest->vi, (*levels)->hierarchy));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshLevelsDestroy(MeshLevels *levels)
{
  PetscFunctionBeginUser;
  if (!*levels) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(HierarchyDestroy(&(*levels)->hierarchy));
  for (PetscInt l = 0; l < (*levels)->num; l++) {
    PetscCall(VecDestroy(&(*levels)->lift[l]));
    PetscCall(MatDestroy(&(*levels)->P[l]));
    if (l + 1 < (*levels)->num || (*levels)->own_finest) PetscCall(VIDestroy(&(*levels)->vi[l]));
  }
  PetscCall(PetscFree((*levels)->of));
  PetscCall(PetscFree((*levels)->vi));
  PetscCall(PetscFree((*levels)->lift));
  PetscCall(PetscFree((*levels)->P));
  PetscCall(PetscFree(*levels));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshLevelsSetInequality(MeshLevels levels, PetscInt l, const Inequality *inequality, Vec W)
{
  Operator *op = &levels->hierarchy->level[levels->hierarchy->first + l].op;

  PetscFunctionBeginUser;
  PetscCall(OperatorSetInequality(op, inequality->A, inequality->b, inequality->upper, W));
  PetscFunctionReturn(PETSC_SUCCESS);
}
