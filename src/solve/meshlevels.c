/* meshlevels.c -- the inequalities of coarser meshes, and prolongation between their unknowns.

   Displacements are prolonged by the shape functions of the coarser level; what solvers see are unknowns y of u = T y, so
   P^ = T_f^-1 P T_c. Where meshes are nested, P^' A_f P^ = T_c' (P' K_f P) T_c is the coarser level's own A, and no such product is
   formed; elsewhere P' K_f P takes the place of the coarser level's K: what truncation takes from a matrix has to be in it. */
#include "base/compat.h"
#include "problem/elasticity.h"
#include "solve/meshlevels.h"

/* P (x) 1: the same for every component. */
static PetscErrorCode MeshLevelsBlocks_Private(Mat P, PetscInt dim, Mat *blocks)
{
  PetscInt     begin, end, rows, columns, first, last, *start, *column, count = 0;
  PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(P, &begin, &end));
  PetscCall(MatGetLocalSize(P, &rows, &columns));
  PetscCall(MatGetOwnershipRangeColumn(P, &first, &last));
  for (PetscInt row = begin; row < end; row++) {
    PetscInt num;

    PetscCall(MatGetRow(P, row, &num, NULL, NULL));
    count += dim * num;
    PetscCall(MatRestoreRow(P, row, &num, NULL, NULL));
  }
  PetscCall(PetscMalloc3(dim * rows + 1, &start, count, &column, count, &value));
  count    = 0;
  start[0] = 0;
  for (PetscInt row = begin; row < end; row++) {
    PetscInt           num;
    const PetscInt    *c;
    const PetscScalar *v;

    PetscCall(MatGetRow(P, row, &num, &c, &v));
    for (PetscInt k = 0; k < dim; k++) {
      for (PetscInt j = 0; j < num; j++) {
        column[count]  = dim * c[j] + k;
        value[count++] = v[j];
      }
      start[dim * (row - begin) + k + 1] = count;
    }
    PetscCall(MatRestoreRow(P, row, &num, &c, &v));
  }
  PetscCall(MatCreate(PetscObjectComm((PetscObject)P), blocks));
  PetscCall(MatSetSizes(*blocks, dim * rows, dim * columns, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetBlockSize(*blocks, dim));
  PetscCall(MatSetType(*blocks, MATAIJ));
  PetscCall(MatSeqAIJSetPreallocationCSR(*blocks, start, column, value)); // one of the two does nothing
  PetscCall(MatMPIAIJSetPreallocationCSR(*blocks, start, column, value));
  PetscCall(PetscFree3(start, column, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What fixed unknowns of the coarser level, which have their values, give to free ones of this one. [in] P - of all unknowns; [in] free -
   1 for free unknowns, fine and coarse; [out] lift - NULL where the values are 0 */
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

/* T_f^-1 (P (x) 1) T_c, emptied where unknowns are fixed. [in] op - of both levels, coarse first; [out] lift - of MeshLevelsCreateLift_Private() */
static PetscErrorCode MeshLevelsCreateProlongation_Private(VI coarse, VI fine, const Operator op[2], Mat *P, Vec *lift)
{
  Mat blocks, product;
  Vec free[2];

  PetscFunctionBeginUser;
  PetscCall(MeshLevelsBlocks_Private(fine->level->prolongation, fine->level->dim, P));
  if (coarse->T) {
    blocks = *P;
    PetscCall(MatMatMult(blocks, coarse->T, MAT_INITIAL_MATRIX, PETSC_DEFAULT, P));
    PetscCall(MatProductClear(*P)); // it would keep its factors
    PetscCall(MatDestroy(&blocks));
  }
  if (op[1].inverse) {
    PetscCall(MatMatMult(op[1].inverse, *P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
    PetscCall(MatProductClear(product));
    PetscCall(MatDestroy(P));
    *P = product;
  }
  PetscCall(OperatorCreateFree(&op[1], &free[0]));
  PetscCall(OperatorCreateFree(&op[0], &free[1]));
  PetscCall(MeshLevelsCreateLift_Private(coarse, fine, *P, free, lift));
  PetscCall(MatDiagonalScale(*P, free[0], free[1]));
  PetscCall(VecDestroy(&free[0]));
  PetscCall(VecDestroy(&free[1]));
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

/* Whether the fine level's cells are parts of the coarse one's: not along curves. */
static PetscErrorCode MeshLevelsTestParts_Private(Level *coarse, Level *fine, PetscBool *parts)
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
    PetscCall(MatMult(fine->prolongation, from, to));
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

/* The inequality of level l, the next coarser one of fine's. Its K is P'K P of the fine one, by itself or made so. [in] same - whether
   energies are the same where cells are parts of cells */
static PetscErrorCode MeshLevelsCreateCoarse_Private(VI fine, PetscInt l, PetscBool same, VI *coarse)
{
  Mat       P, K = NULL;
  PetscBool nested = same;

  PetscFunctionBeginUser;
  if (same) PetscCall(MeshLevelsTestParts_Private(&fine->mesh->levels[l], fine->level, &nested));
  if (!nested) {
    PetscCall(MeshLevelsBlocks_Private(fine->level->prolongation, fine->level->dim, &P));
    PetscCall(MatPtAP(fine->K, P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &K));
    PetscCall(MatProductClear(K)); // it would keep its factors
    PetscCall(MatDestroy(&P));
  }
  PetscCall(VICreateCoarse(fine, l, K, coarse));
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
                   .S               = vi->S,
                   .T               = vi->T,
                   .Z               = vi->Z,
                   .num_fixed       = vi->num_fixed,
                   .num_constrained = vi->num_rows,
                   .dim             = vi->level->dim,
                   .coords          = vi->level->coords};
  PetscCall(OperatorSetInequality(op, inequality->A, inequality->b, inequality->upper, W));
  PetscCall(PetscObjectReference((PetscObject)op->K));
  PetscCall(PetscObjectReference((PetscObject)op->diagonal));
  PetscCall(PetscObjectReference((PetscObject)op->S));
  PetscCall(PetscObjectReference((PetscObject)op->T));
  PetscCall(PetscObjectReference((PetscObject)op->Z));
  PetscCall(VICreateInverseBasis(vi, &op->inverse));
  PetscCall(PetscMalloc1(op->num_fixed, &op->fixed));
  PetscCall(PetscArraycpy(op->fixed, vi->fixed_local, op->num_fixed));
  PetscCall(PetscMalloc1(op->num_constrained, &op->constrained));
  for (PetscInt r = 0; r < vi->num_rows; r++) op->constrained[r] = vi->row_dof[r] - begin;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether some cell is of second order, or none is; and whether cells may be long in whole lines: tetrahedra as a mesh generator makes them are
   long here and there. */
static PetscErrorCode MeshLevelsInspectCells_Private(const Level *level, PetscInt meshes, PetscBool *higher,
                                                     PetscBool *lines)
{
  PetscBool any[2] = {PETSC_FALSE, (PetscBool)(meshes > 1)};

  PetscFunctionBeginUser;
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

/* Of cells of second order the first level of nodes has the vertices, in the middle between which other nodes move. Orders are known cell by cell. */
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

/* The inequalities of all levels; matrices as multigrid needs them. [out] below - whether there are to be levels below the coarsest */
static PetscErrorCode MeshLevelsCreateVIs_Private(MeshLevels levels, PetscBool *below)
{
  const VI  finest = levels->vi[levels->num - 1];
  PetscInt  size;
  PetscBool same;

  PetscFunctionBeginUser;
  PetscCall(MeshLevelsAreNested(finest, &same));
  if (finest->scene->model == MODEL_AXISYMMETRIC)
    same = PETSC_FALSE; // 1 / radius is integrated on each level in its own way
  for (PetscInt l = levels->num - 2; l >= 0; l--)
    PetscCall(MeshLevelsCreateCoarse_Private(levels->vi[l + 1], l, same, &levels->vi[l]));
  PetscCall(VecGetSize(levels->vi[0]->b, &size));
  *below = (PetscBool)(levels->num == 1 || HierarchyIsLarge(finest->level->dim, size));
  for (PetscInt l = 0; l < levels->num; l++)
    PetscCall(l || *below ? VIPrepareProducts(levels->vi[l]) : VIAssemble(levels->vi[l]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshLevelsCreate(const Inequality *finest, Vec W, MeshLevels *levels_out)
{
  const PetscInt num = finest->vi->mesh->num_levels;
  MeshLevels     levels;
  HierarchyInput input  = {.num = num};
  PetscBool      higher = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&levels));
  levels->num = num;
  PetscCall(PetscCalloc2(num, &levels->vi, num, &levels->lift));
  PetscCall(PetscCalloc2(num, &input.op, num, &input.P));
  levels->vi[num - 1] = finest->vi;
  PetscCall(MeshLevelsCreateVIs_Private(levels, &input.below));
  for (PetscInt l = 0; l < num; l++) {
    const VI         vi  = levels->vi[l];
    const Inequality own = {.vi = vi, .A = vi->A, .b = vi->b, .upper = vi->upper};

    PetscCall(MeshLevelsCreateOperator(l + 1 < num ? &own : finest, l + 1 < num ? NULL : W, &input.op[l]));
    if (!l) continue;
    PetscCall(
        MeshLevelsCreateProlongation_Private(levels->vi[l - 1], vi, &input.op[l - 1], &input.P[l], &levels->lift[l]));
  }
  PetscCall(MeshLevelsInspectCells_Private(levels->vi[0]->level, num, &higher, &input.lines));
  if (input.below && higher) PetscCall(MeshLevelsCreateTable_Private(levels->vi[0]->level, &input.table));
  PetscCall(HierarchyCreate(&input, &levels->hierarchy));
  PetscCall(PetscFree2(input.op, input.P));
  PetscCall(CostModelSet(&levels->cost, finest->vi, levels->hierarchy));
  *levels_out = levels;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshLevelsDestroy(MeshLevels *levels)
{
  PetscFunctionBeginUser;
  if (!*levels) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(HierarchyDestroy(&(*levels)->hierarchy));
  for (PetscInt l = 0; l < (*levels)->num; l++) {
    PetscCall(VecDestroy(&(*levels)->lift[l]));
    if (l + 1 < (*levels)->num) PetscCall(VIDestroy(&(*levels)->vi[l]));
  }
  PetscCall(PetscFree2((*levels)->vi, (*levels)->lift));
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
