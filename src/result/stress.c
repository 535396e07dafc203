/* stress.c -- stresses at nodes, recovered from the points of highest accuracy.

   Derivatives of a finite element solution are one order more accurate at certain points of a cell than
   elsewhere. These are its middle for order 1, the 2 x 2 Gauss points of quads of order 2, nearly also three
   points within a triangle (Barlow 1976; Zienkiewicz & Zhu 1992). Stresses are evaluated there and
   extrapolated to the cell's nodes by the polynomial through these points: constant for order 1, linear or
   bilinear for order 2. At a node they are averaged over its cells, with their volumes as weights. Nodes
   belong to one body, and cells of two materials at a node have a stress each, so nothing is averaged across
   an interface. Linear stresses are reproduced exactly on cells of order 2 with straight sides.

   Along a curve, components of the stress turn. Linear functions of a curved cell lose the quadratic part of
   that, which the displacement has: averages of them are further from the exact stress than that of the
   displacement. What they lose is known once slopes of the averages are. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "level/ghosted.h"
#include "problem/elasticity.h"
#include "result/cellstress.h"
#include "result/stress.h"
#include "result/stressquadratic.h"

enum { STRESSES = CELL_STRESSES, MAX_DIM = CELL_MAX_DIM };

/* Where the stress of one type of cell is taken, and how it is continued to its nodes. */
typedef struct {
  const ElementRule *stiffness; /* borrowed */

  ElementRule rule;
  PetscReal   spread[ELEMENT_MAX_NODES * ELEMENT_MAX_NODES]; /* [num_nodes][rule.num] */
} Recovery;

/* The points are the vertices, drawn towards the middle until they lie on the Gauss points of degree 2 (3 in
   quads). The functions of the linear cell, drawn in likewise, are 1 at one of them and 0 at the others. */
static void StressSetRecovery_Private(ElementType type, const ElementRule *stiffness, Recovery *recovery)
{
  const ElementType linear = ElementLinear(type);
  const PetscInt    dim = ElementDim(type), nn = ElementNumNodes(type), nv = ElementNumNodes(linear);
  const PetscReal   shrink = 1 / PetscSqrtReal(nv == dim + 1 ? dim + 2. : 3.);
  ElementRule      *rule   = &recovery->rule;
  PetscReal         middle[MAX_DIM], xi[MAX_DIM], measure;

  QuadratureRule(linear, 1, middle, &measure);
  recovery->stiffness = stiffness;
  rule->type          = type;
  rule->num           = ElementOrder(type) == 1 ? 1 : nv;
  for (PetscInt q = 0; q < rule->num; q++) {
    for (PetscInt k = 0; k < dim; k++)
      xi[k] = rule->num == 1 ? middle[k] : middle[k] + shrink * (ElementNode(linear, q)[k] - middle[k]);
    rule->weight[q] = measure / rule->num;
    ElementShape(type, xi, &rule->phi[q * nn], &rule->dphi[q * nn * dim]);
  }
  for (PetscInt i = 0; i < nn; i++) {
    for (PetscInt k = 0; k < dim; k++) xi[k] = middle[k] + (ElementNode(type, i)[k] - middle[k]) / shrink;
    if (rule->num == 1)
      recovery->spread[i] = 1;
    else
      ElementShape(linear, xi, &recovery->spread[i * nv], NULL);
  }
}

/* Sums at the nodes of this rank, for each of the materials that meet there. */
typedef struct {
  const NodeMaterials *at;
  PetscScalar        **stress; /* times volume [at->most][num_nodes][STRESSES] */
  PetscScalar        **volume; /* [at->most][num_nodes] */
  PetscReal           *cell;   /* volumes of cells [num_cells] */
} Sums;

/* Adds a cell's volume, and its stresses times its volume, to its nodes. [in] u - [num_nodes][dim] */
static PetscErrorCode StressAddCell_Private(Scene scene, const Level *level, PetscInt c, const Recovery *recovery,
                                            const PetscScalar u[], Sums *sums)
{
  const PetscInt  n = ElementNumNodes(recovery->rule.type), num = recovery->rule.num;
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]];
  PetscReal       stress[ELEMENT_MAX_NODES][STRESSES], volume = 0.0;
  CellStress      cell;

  PetscFunctionBeginUser;
  PetscCall(CellStressSet(scene, level, c, recovery->stiffness, u, &cell));
  for (PetscInt q = 0; q < num; q++) {
    PetscReal det;

    PetscCall(CellStressAtPoint(scene, &cell, &recovery->rule, q, stress[q], &det, NULL));
    volume += recovery->rule.weight[q] * det;
  }
  sums->cell[c] = volume;
  for (PetscInt i = 0; i < n; i++) {
    const PetscInt at  = NodeMaterialsFind(sums->at, nodes[i], level->cell_material[c]);
    PetscScalar   *sum = &sums->stress[at][nodes[i] * STRESSES];

    sums->volume[at][nodes[i]] += volume;
    for (PetscInt q = 0; q < num; q++) {
      const PetscReal share = volume * recovery->spread[i * num + q];

      for (PetscInt k = 0; k < STRESSES; k++) sum[k] += share * stress[q][k];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds this rank's cells to ghosted vectors.
   [in,out] volume - [stress->at.most]; [out] cell - their volumes */
static PetscErrorCode StressAddCells_Private(Scene scene, const Level *level, Vec u, NodalStress *stress, Vec volume[],
                                             PetscReal cell[])
{
  const PetscInt     most = stress->at.most;
  const PetscScalar *displacement;
  Sums               sums = {.at = &stress->at, .cell = cell};
  Recovery          *recoveries;
  ElementRule       *rules;

  PetscFunctionBeginUser;
  PetscCall(ElasticityRulesCreate(scene, &rules));
  PetscCall(PetscMalloc1(ELEMENT_COUNT, &recoveries));
  for (PetscInt t = 0; t < ELEMENT_COUNT; t++) StressSetRecovery_Private((ElementType)t, &rules[t], &recoveries[t]);
  PetscCall(PetscMalloc2(most, &sums.stress, most, &sums.volume));
  PetscCall(GhostedGetArrayRead(u, &displacement));
  for (PetscInt i = 0; i < most; i++) {
    PetscCall(GhostedGetArray(stress->value[i], &sums.stress[i]));
    PetscCall(GhostedGetArray(volume[i], &sums.volume[i]));
  }
  for (PetscInt c = 0; c < level->num_cells; c++)
    PetscCall(StressAddCell_Private(scene, level, c, &recoveries[level->cell_type[c]], displacement, &sums));
  for (PetscInt i = 0; i < most; i++) {
    PetscCall(GhostedRestoreArray(volume[i], &sums.volume[i]));
    PetscCall(GhostedRestoreArray(stress->value[i], &sums.stress[i]));
  }
  PetscCall(GhostedRestoreArrayRead(u, &displacement));
  PetscCall(PetscFree2(sums.stress, sums.volume));
  PetscCall(PetscFree(recoveries));
  PetscCall(PetscFree(rules));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks hanging nodes at which stresses are continuous: of one material, which their edge has as well.
   Collective. [out] continuous - owned by the caller; NULL where no node hangs [num_owned] */
static PetscErrorCode StressMarkContinuous_Private(Level *level, const NodeMaterials *at, PetscBool **continuous)
{
  const PetscScalar *edge;
  PetscScalar       *material;
  Vec                own, moved;

  PetscFunctionBeginUser;
  *continuous = NULL;
  if (!level->conforming) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(level->num_owned + 1, continuous)); // not NULL where a rank has no nodes
  PetscCall(LevelCreateVec(level, 1, &own));
  PetscCall(VecGetArray(own, &material));
  for (PetscInt a = 0; a < level->num_owned; a++) {
    const PetscInt one = at->start ? at->material[at->start[a]] : 0;

    material[a] = NodeMaterialsCount(at, a) == 1 ? (PetscReal)one : (PetscReal)NAN;
  }
  PetscCall(VecRestoreArray(own, &material));
  PetscCall(VecDuplicate(own, &moved));
  PetscCall(VecCopy(own, moved));
  PetscCall(LevelConform(level, 1, moved));
  PetscCall(VecGetArray(own, &material));
  PetscCall(VecGetArrayRead(moved, &edge));
  for (PetscInt a = 0; a < level->num_owned; a++) (*continuous)[a] = (PetscBool)(edge[a] == material[a]);
  PetscCall(VecRestoreArrayRead(moved, &edge));
  PetscCall(VecRestoreArray(own, &material));
  PetscCall(VecDestroy(&moved));
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The node in the middle of an edge of order 2 counts the small cells as well, which have a hanging node at
   its place. Collective. [in,out] v - sums of bs values */
static PetscErrorCode StressJoin_Private(const Level *level, const PetscBool continuous[], PetscInt bs, Vec v)
{
  PetscScalar *sums, *own;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->num_owned * bs, &own));
  PetscCall(VecGetArray(v, &sums));
  PetscCall(PetscArraycpy(own, sums, level->num_owned * bs));
  PetscCall(VecRestoreArray(v, &sums));
  for (PetscInt a = 0; a < level->num_owned; a++) {
    const PetscInt  node = level->node_begin + a;
    const PetscInt *columns;
    PetscInt        num;

    PetscCall(MatGetRow(level->conforming, node, &num, &columns, NULL));
    if (continuous[a] && num == 1 && columns[0] != node)
      PetscCall(VecSetValuesBlocked(v, 1, columns, &own[a * bs], ADD_VALUES));
    PetscCall(MatRestoreRow(level->conforming, node, &num, &columns, NULL));
  }
  PetscCall(VecAssemblyBegin(v));
  PetscCall(VecAssemblyEnd(v));
  PetscCall(PetscFree(own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Continuous stresses at hanging nodes are those of the edge. Collective. */
static PetscErrorCode StressConform_Private(Level *level, const PetscBool continuous[], Vec stress)
{
  const PetscScalar *edge;
  PetscScalar       *a;
  Vec                moved;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(stress, &moved));
  PetscCall(VecCopy(stress, moved));
  PetscCall(LevelConform(level, STRESSES, moved));
  PetscCall(VecGetArrayRead(moved, &edge));
  PetscCall(VecGetArray(stress, &a));
  for (PetscInt i = 0; i < level->num_owned * STRESSES; i++)
    if (continuous[i / STRESSES]) a[i] = edge[i];
  PetscCall(VecRestoreArray(stress, &a));
  PetscCall(VecRestoreArrayRead(moved, &edge));
  PetscCall(VecDestroy(&moved));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sums over all ranks. Collective. [in] continuous - of StressMarkContinuous_Private(), or NULL */
static PetscErrorCode StressSum_Private(Level *level, const PetscBool continuous[], PetscInt bs, Vec v)
{
  PetscFunctionBeginUser;
  PetscCall(LevelShareVec(v, ADD_VALUES));
  if (continuous) PetscCall(StressJoin_Private(level, continuous, bs, v));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sums over all ranks, divided by the volume where there is some. Collective.
   [in] continuous - of StressMarkContinuous_Private(), or NULL; [in] volume - of all ranks */
static PetscErrorCode StressDivide_Private(Level *level, const PetscBool continuous[], Vec stress, Vec volume)
{
  const PetscReal *volumes;
  PetscReal       *sums;

  PetscFunctionBeginUser;
  PetscCall(StressSum_Private(level, continuous, STRESSES, stress));
  PetscCall(VecGetArrayRead(volume, &volumes));
  PetscCall(VecGetArray(stress, &sums));
  for (PetscInt a = 0; a < level->num_owned; a++) {
    for (PetscInt k = 0; k < STRESSES && volumes[a] != 0; k++) sums[a * STRESSES + k] /= volumes[a];
  }
  PetscCall(VecRestoreArray(stress, &sums));
  PetscCall(VecRestoreArrayRead(volume, &volumes));
  if (continuous) PetscCall(StressConform_Private(level, continuous, stress));
  PetscCall(LevelShareVec(stress, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The curved cells of order 2 of this rank. Collective.
   [out] curved - [num_cells], owned by the caller; NULL where no rank has one */
static PetscErrorCode StressFindCurved_Private(Scene scene, const Level *level, PetscBool **curved)
{
  PetscBool any = PETSC_FALSE;
  PetscReal X[MAX_DIM * ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  *curved = NULL;
  for (PetscInt b = 0; b < scene->num_bodies; b++) any = (PetscBool)(any || scene->bodies[b].order == 2);
  if (!any) PetscFunctionReturn(PETSC_SUCCESS);
  any = PETSC_FALSE;
  PetscCall(PetscMalloc1(level->num_cells + 1, curved)); // not NULL where a rank has no cells
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementType type = (ElementType)level->cell_type[c];

    VectorGather(level->dim, ElementNumNodes(type), &level->cell_nodes[level->cell_start[c]], level->coords, X);
    (*curved)[c] = (PetscBool)(ElementOrder(type) == 2 && !StressCellIsStraight(type, level->dim, X));
    any          = (PetscBool)(any || (*curved)[c]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  if (!any) PetscCall(PetscFree(*curved));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds, to the nodes of a cell, what its linear functions lose of the quadratic stress there, times its
   volume. [in] slopes - of StressCreateSlopes() */
static void StressAddLost_Private(const Level *level, PetscInt c, const Recovery *recovery, const PetscScalar slopes[],
                                  Sums *sums)
{
  const ElementRule *rule = &recovery->rule;
  const PetscInt     dim = level->dim, n = ElementNumNodes(rule->type);
  const PetscInt    *nodes = &level->cell_nodes[level->cell_start[c]];
  PetscReal          stress[ELEMENT_MAX_NODES][STRESSES], lost[STRESSES], x[MAX_DIM];
  StressQuadratic    quadratic;

  if (!StressQuadraticSet(level, c, sums->at, slopes, &quadratic)) return;
  for (PetscInt q = 0; q < rule->num; q++) {
    (void)ElementRuleMap(rule, q, quadratic.X, x, NULL);
    StressQuadraticEvaluate(&quadratic, x, PETSC_TRUE, stress[q]);
  }
  for (PetscInt i = 0; i < n; i++) {
    const PetscInt at  = NodeMaterialsFind(sums->at, nodes[i], level->cell_material[c]);
    PetscScalar   *sum = &sums->stress[at][nodes[i] * STRESSES];

    StressQuadraticEvaluate(&quadratic, &quadratic.X[i * dim], PETSC_TRUE, lost);
    for (PetscInt k = 0; k < STRESSES; k++) {
      for (PetscInt q = 0; q < rule->num; q++) lost[k] -= recovery->spread[i * rule->num + q] * stress[q][k];
      sum[k] += sums->cell[c] * lost[k];
    }
  }
}

/* The same in all curved cells of this rank. Collective. [in,out] lost - [stress->at.most] */
static PetscErrorCode StressAddAllLost_Private(Level *level, const PetscBool curved[], const NodalStress *stress,
                                               PetscReal cell[], Vec lost[])
{
  const PetscInt     most = stress->at.most;
  Sums               sums = {.at = &stress->at, .cell = cell};
  NodalStressArrays  arrays;
  Recovery          *recoveries;
  Vec                slopes;
  const PetscScalar *slope;

  PetscFunctionBeginUser;
  PetscCall(NodalStressGetArrays(stress, &arrays));
  PetscCall(StressCreateSlopes(level, &arrays, cell, &slopes));
  PetscCall(NodalStressRestoreArrays(stress, &arrays));
  PetscCall(PetscMalloc1(ELEMENT_COUNT, &recoveries));
  for (PetscInt t = 0; t < ELEMENT_COUNT; t++) StressSetRecovery_Private((ElementType)t, NULL, &recoveries[t]);
  PetscCall(PetscMalloc1(most, &sums.stress));
  for (PetscInt i = 0; i < most; i++) PetscCall(GhostedGetArray(lost[i], &sums.stress[i]));
  PetscCall(GhostedGetArrayRead(slopes, &slope));
  for (PetscInt c = 0; c < level->num_cells; c++)
    if (curved[c]) StressAddLost_Private(level, c, &recoveries[level->cell_type[c]], slope, &sums);
  PetscCall(GhostedRestoreArrayRead(slopes, &slope));
  for (PetscInt i = 0; i < most; i++) PetscCall(GhostedRestoreArray(lost[i], &sums.stress[i]));
  PetscCall(PetscFree(sums.stress));
  PetscCall(PetscFree(recoveries));
  PetscCall(VecDestroy(&slopes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the means of what linear functions of curved cells lose. Collective.
   [in] continuous - of StressMarkContinuous_Private(); [in] volume - of all ranks [stress->at.most];
   [in] cell - volumes */
static PetscErrorCode StressMendCurved_Private(Scene scene, Level *level, const PetscBool continuous[],
                                               const Vec volume[], PetscReal cell[], NodalStress *stress)
{
  PetscBool *curved;
  Vec       *lost;

  PetscFunctionBeginUser;
  PetscCall(StressFindCurved_Private(scene, level, &curved));
  if (!curved) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(stress->at.most, &lost));
  for (PetscInt i = 0; i < stress->at.most; i++) PetscCall(LevelCreateVec(level, STRESSES, &lost[i]));
  PetscCall(StressAddAllLost_Private(level, curved, stress, cell, lost));
  for (PetscInt i = 0; i < stress->at.most; i++) {
    PetscCall(StressDivide_Private(level, i ? NULL : continuous, lost[i], volume[i]));
    PetscCall(VecAXPY(stress->value[i], 1, lost[i]));
    PetscCall(LevelShareVec(stress->value[i], INSERT_VALUES));
    PetscCall(VecDestroy(&lost[i]));
  }
  PetscCall(PetscFree(lost));
  PetscCall(PetscFree(curved));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StressCreate(Scene scene, Level *level, Vec u, NodalStress *stress)
{
  PetscBool *continuous;
  PetscReal *cell;
  Vec       *volume;

  PetscFunctionBeginUser;
  PetscCall(NodeMaterialsCreate(scene, level, &stress->at));
  PetscCall(StressMarkContinuous_Private(level, &stress->at, &continuous));
  PetscCall(PetscMalloc1(stress->at.most, &stress->value));
  PetscCall(PetscMalloc1(stress->at.most, &volume));
  PetscCall(PetscMalloc1(level->num_cells, &cell));
  for (PetscInt i = 0; i < stress->at.most; i++) {
    PetscCall(LevelCreateVec(level, STRESSES, &stress->value[i]));
    PetscCall(LevelCreateVec(level, 1, &volume[i]));
  }
  PetscCall(StressAddCells_Private(scene, level, u, stress, volume, cell));
  for (PetscInt i = 0; i < stress->at.most; i++) {
    const PetscBool *conform = i ? NULL : continuous; // alone: the first

    PetscCall(StressSum_Private(level, conform, 1, volume[i]));
    PetscCall(StressDivide_Private(level, conform, stress->value[i], volume[i]));
  }
  PetscCall(StressMendCurved_Private(scene, level, continuous, volume, cell, stress));
  for (PetscInt i = 0; i < stress->at.most; i++) PetscCall(VecDestroy(&volume[i]));
  PetscCall(PetscFree(cell));
  PetscCall(PetscFree(volume));
  PetscCall(PetscFree(continuous));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NodalStressDestroy(NodalStress *stress)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < stress->at.most && stress->value; i++) PetscCall(VecDestroy(&stress->value[i]));
  PetscCall(PetscFree(stress->value));
  PetscCall(NodeMaterialsDestroy(&stress->at));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NodalStressGetArrays(const NodalStress *stress, NodalStressArrays *arrays)
{
  PetscFunctionBeginUser;
  arrays->at = &stress->at;
  PetscCall(PetscMalloc2(stress->at.most, &arrays->local, stress->at.most, &arrays->value));
  for (PetscInt i = 0; i < stress->at.most; i++) {
    PetscCall(VecGhostGetLocalForm(stress->value[i], &arrays->local[i]));
    PetscCall(VecGetArrayRead(arrays->local[i], &arrays->value[i]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NodalStressRestoreArrays(const NodalStress *stress, NodalStressArrays *arrays)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < stress->at.most; i++) {
    PetscCall(VecRestoreArrayRead(arrays->local[i], &arrays->value[i]));
    PetscCall(VecGhostRestoreLocalForm(stress->value[i], &arrays->local[i]));
  }
  PetscCall(PetscFree2(arrays->local, arrays->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}
