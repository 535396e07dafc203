/* stress.c -- stresses at nodes, recovered from the points of highest accuracy.

   Derivatives of a finite element solution are one order more accurate at certain points of a cell than
   elsewhere. These are its middle for order 1, the 2 x 2 Gauss points of quads of order 2, nearly also three
   points within a triangle (Barlow 1976; Zienkiewicz & Zhu 1992). Stresses are evaluated there and
   extrapolated to the cell's nodes by the polynomial through these points: constant for order 1, linear or
   bilinear for order 2. At a node they are averaged over its cells, with their volumes as weights. Nodes
   belong to one body, and cells of two materials at a node have a stress each, so nothing is averaged across
   an interface. Linear stresses are reproduced exactly on cells of order 2 with straight sides. */
#include "base/compat.h"
#include "level/ghosted.h"
#include "problem/elasticity.h"
#include "result/cellstress.h"
#include "result/stress.h"

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

/* Adds this rank's cells to ghosted vectors. [in,out] volume - [stress->at.most] */
static PetscErrorCode StressAddCells_Private(Scene scene, const Level *level, Vec u, NodalStress *stress, Vec volume[])
{
  const PetscInt     most = stress->at.most;
  const PetscScalar *displacement;
  Sums               sums = {.at = &stress->at};
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

/* Sums over all ranks, divided by the volume where there is some. Collective.
   [in] continuous - of StressMarkContinuous_Private(), or NULL */
static PetscErrorCode StressDivide_Private(Level *level, const PetscBool continuous[], Vec stress, Vec volume)
{
  const PetscReal *volumes;
  PetscReal       *sums;

  PetscFunctionBeginUser;
  PetscCall(LevelShareVec(stress, ADD_VALUES));
  PetscCall(LevelShareVec(volume, ADD_VALUES));
  if (continuous) PetscCall(StressJoin_Private(level, continuous, STRESSES, stress));
  if (continuous) PetscCall(StressJoin_Private(level, continuous, 1, volume));
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

PetscErrorCode StressCreate(Scene scene, Level *level, Vec u, NodalStress *stress)
{
  PetscBool *continuous;
  Vec       *volume;

  PetscFunctionBeginUser;
  PetscCall(NodeMaterialsCreate(scene, level, &stress->at));
  PetscCall(StressMarkContinuous_Private(level, &stress->at, &continuous));
  PetscCall(PetscMalloc1(stress->at.most, &stress->value));
  PetscCall(PetscMalloc1(stress->at.most, &volume));
  for (PetscInt i = 0; i < stress->at.most; i++) {
    PetscCall(LevelCreateVec(level, STRESSES, &stress->value[i]));
    PetscCall(LevelCreateVec(level, 1, &volume[i]));
  }
  PetscCall(StressAddCells_Private(scene, level, u, stress, volume));
  for (PetscInt i = 0; i < stress->at.most; i++) {
    PetscCall(StressDivide_Private(level, i ? NULL : continuous, stress->value[i], volume[i])); // alone: the first
    PetscCall(VecDestroy(&volume[i]));
  }
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
