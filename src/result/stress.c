/* stress.c -- stresses at nodes, recovered from the points of highest accuracy.

   Derivatives of a finite element solution are one order more accurate at certain points of a cell than elsewhere: in its
   middle for order 1, at the 2 x 2 Gauss points of quads of order 2, nearly so at three points within a triangle (Barlow
   1976; Zienkiewicz & Zhu 1992). Stresses are taken there, continued to the cell's nodes by the polynomial through these
   points (a constant for order 1, linear or bilinear for order 2), and averaged over the cells that meet at a node, with
   their volumes as weights. Nodes belong to one body, so nothing is averaged across an interface. Linear stresses are
   reproduced exactly on cells of order 2 with straight sides. */
#include "base/compat.h"
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

/* The points are the vertices, drawn towards the middle until they lie on the Gauss points of degree 2 (3 in quads). The
   functions of the linear cell, drawn in likewise, are 1 at one of them and 0 at the others. */
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

/* Adds a cell's volume, and its stresses times its volume, to its nodes. [in] u - [num_nodes][dim];
   [in,out] sums - [num_nodes][STRESSES]; [in,out] volumes - [num_nodes] */
static PetscErrorCode StressAddCell_Private(Scene scene, const Level *level, PetscInt c, const Recovery *recovery,
                                            const PetscScalar u[], PetscReal sums[], PetscReal volumes[])
{
  const PetscInt  n = ElementNumNodes(recovery->rule.type), num = recovery->rule.num;
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]];
  PetscReal       stress[ELEMENT_MAX_NODES][STRESSES], volume = 0.0;
  CellStress      cell;

  PetscFunctionBeginUser;
  PetscCall(CellStressSet(scene, level, c, recovery->stiffness, u, &cell));
  for (PetscInt q = 0; q < num; q++) {
    PetscReal det;

    PetscCall(CellStressAtPoint(scene, &cell, &recovery->rule, q, stress[q], &det));
    volume += recovery->rule.weight[q] * det;
  }
  for (PetscInt i = 0; i < n; i++) {
    volumes[nodes[i]] += volume;
    for (PetscInt q = 0; q < num; q++) {
      const PetscReal share = volume * recovery->spread[i * num + q];

      for (PetscInt k = 0; k < STRESSES; k++) sums[nodes[i] * STRESSES + k] += share * stress[q][k];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds this rank's cells to the local forms of two ghosted vectors. */
static PetscErrorCode StressAddCells_Private(Scene scene, const Level *level, Vec u, Vec stress, Vec volume)
{
  Vec                local[3];
  const PetscScalar *displacement;
  PetscReal         *sums, *volumes;
  Recovery          *recoveries;
  ElementRule       *rules;

  PetscFunctionBeginUser;
  PetscCall(ElasticityRulesCreate(scene, &rules));
  PetscCall(PetscMalloc1(ELEMENT_COUNT, &recoveries));
  for (PetscInt t = 0; t < ELEMENT_COUNT; t++) StressSetRecovery_Private((ElementType)t, &rules[t], &recoveries[t]);
  PetscCall(VecGhostGetLocalForm(u, &local[0]));
  PetscCall(VecGhostGetLocalForm(stress, &local[1]));
  PetscCall(VecGhostGetLocalForm(volume, &local[2]));
  PetscCall(VecGetArrayRead(local[0], &displacement));
  PetscCall(VecGetArray(local[1], &sums));
  PetscCall(VecGetArray(local[2], &volumes));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    PetscCall(StressAddCell_Private(scene, level, c, &recoveries[level->cell_type[c]], displacement, sums, volumes));
  }
  PetscCall(VecRestoreArray(local[2], &volumes));
  PetscCall(VecRestoreArray(local[1], &sums));
  PetscCall(VecRestoreArrayRead(local[0], &displacement));
  PetscCall(VecGhostRestoreLocalForm(volume, &local[2]));
  PetscCall(VecGhostRestoreLocalForm(stress, &local[1]));
  PetscCall(VecGhostRestoreLocalForm(u, &local[0]));
  PetscCall(PetscFree(recoveries));
  PetscCall(PetscFree(rules));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StressCreate(Scene scene, Level *level, Vec u, Vec *stress)
{
  Vec              volume;
  const PetscReal *volumes;
  PetscReal       *sums;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, STRESSES, stress));
  PetscCall(LevelCreateVec(level, 1, &volume));
  PetscCall(StressAddCells_Private(scene, level, u, *stress, volume));
  PetscCall(LevelShareVec(*stress, ADD_VALUES));
  PetscCall(LevelShareVec(volume, ADD_VALUES));
  PetscCall(VecGetArrayRead(volume, &volumes));
  PetscCall(VecGetArray(*stress, &sums));
  for (PetscInt a = 0; a < level->num_owned; a++) {
    for (PetscInt k = 0; k < STRESSES; k++) sums[a * STRESSES + k] /= volumes[a];
  }
  PetscCall(VecRestoreArray(*stress, &sums));
  PetscCall(VecRestoreArrayRead(volume, &volumes));
  PetscCall(VecGhostUpdateBegin(*stress, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(*stress, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecDestroy(&volume));
  PetscFunctionReturn(PETSC_SUCCESS);
}
