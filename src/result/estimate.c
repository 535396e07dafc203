/* estimate.c -- recovery of stresses.

   The recovered stress is one order nearer to the exact one than that of the displacement: their difference
   is the error's, nearly (Zienkiewicz & Zhu 1992). The terms of contact are in estimatepairs.c. */
#include "base/compat.h"
#include "problem/elasticity.h"
#include "result/calibration.h"
#include "result/compliance.h"
#include "result/estimate.h"
#include "result/estimatepairs.h"
#include "result/geometry.h"
#include "result/oscillation.h"
#include "result/unseenstress.h"

/* Rules of the difference of stresses: of twice the order of the displacements. [out] rules -
   [ELEMENT_COUNT]; PetscFree() it */
static PetscErrorCode EstimateRulesCreate_Private(const Level *level, ElementRule **rules)
{
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(ELEMENT_COUNT, rules));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementType type = (ElementType)level->cell_type[c];

    if (!(*rules)[type].num)
      ElementRuleSet(type, 2 * ElementOrder(type) + SceneMeasureDegree(level->scene, 1), &(*rules)[type]);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What all cells are compared with. */
typedef struct {
  NodalStressArrays recovered;  /* s* */
  Compliance       *compliance; /* borrowed */
} CellSources;

/* Integrals over a cell. */
typedef struct {
  PetscReal squared, volume; /* (s* - s) : C^-1 : (s* - s), 1 */
  PetscReal lost;            /* -2 (p* - p) (div u - theta): p of the cell is in Q, or nearly, and has no part in it */
} CellIntegrals;

/* [in] cell - its displacements; [out] sum - of cell c */
static PetscErrorCode EstimateOfCell_Private(const Level *level, PetscInt c, const CellStress *cell,
                                             const ElementRule *rule, const CellSources *sources, CellIntegrals *sum)
{
  const Scene        scene = level->scene;
  const PetscInt     dim = level->dim, n = ElementNumNodes(rule->type);
  const PetscInt    *nodes = &level->cell_nodes[level->cell_start[c]];
  const PetscReal   *L;
  const PetscScalar *nodal[ELEMENT_MAX_NODES];
  PetscReal          stress[CELL_STRESSES], det, change;

  PetscFunctionBeginUser;
  *sum = (CellIntegrals){0, 0, 0};
  for (PetscInt i = 0; i < n; i++) nodal[i] = NodalStressAt(&sources->recovered, nodes[i], cell->material);
  for (PetscInt q = 0; q < rule->num; q++) {
    const PetscReal *phi  = &rule->phi[q * n];
    PetscReal        x[3] = {0, 0, 0};

    PetscCall(CellStressAtPoint(scene, cell, rule, q, stress, &det, &change));
    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt k = 0; k < dim; k++) x[k] += phi[i] * cell->X[i * dim + k];
      for (PetscInt k = 0; k < CELL_STRESSES; k++) stress[k] -= phi[i] * PetscRealPart(nodal[i][k]);
    }
    PetscCall(ComplianceGet(sources->compliance, cell->material, x, &L));
    det *= rule->weight[q] * SceneMeasure(scene, x);
    sum->volume += det;
    sum->lost += 2 * det * change * (stress[0] + stress[1] + stress[2]) / 3;
    sum->squared += det * ComplianceEnergy(sources->compliance, L, stress);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode EstimateAddCells_Private(Fields fields, Compliance *compliance, Estimate estimate)
{
  const Level       *level = fields->vi->level;
  Vec                local;
  const PetscScalar *u;
  CellSources        sources = {.compliance = compliance};
  ElementRule       *rules, *stiffness;
  CellStress         cell;
  CellIntegrals      sum;

  PetscFunctionBeginUser;
  PetscCall(EstimateRulesCreate_Private(level, &rules));
  PetscCall(ElasticityRulesCreate(level->scene, &stiffness));
  PetscCall(VecGhostGetLocalForm(fields->u, &local));
  PetscCall(VecGetArrayRead(local, &u));
  PetscCall(NodalStressGetArrays(&fields->stress, &sources.recovered));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt type = level->cell_type[c];

    PetscCall(CellStressSet(level->scene, level, c, &stiffness[type], u, &cell));
    PetscCall(EstimateOfCell_Private(level, c, &cell, &rules[type], &sources, &sum));
    estimate->cell[c] += sum.squared;
    estimate->volume[c] = sum.volume;
    estimate->lost += sum.lost;
  }
  PetscCall(NodalStressRestoreArrays(&fields->stress, &sources.recovered));
  PetscCall(VecRestoreArrayRead(local, &u));
  PetscCall(VecGhostRestoreLocalForm(fields->u, &local));
  PetscCall(UnseenStressTake(fields, rules, compliance, estimate->volume, estimate->cell));
  PetscCall(PetscFree(stiffness));
  PetscCall(PetscFree(rules));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* This rank's part, and the standard of all ranks. Collective. [in] surplus - [num_cells] */
static PetscErrorCode EstimateSetAged_Private(const Level *level, const PetscReal surplus[], Estimate e)
{
  PetscReal *squared;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->num_cells, &squared));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt age = level->cell_age ? level->cell_age[c] : 0;

    squared[c] = e->cell[c] - surplus[c];
    if (age != NOT_BISECTED) e->aged[age] += squared[c];
  }
  PetscCall(CalibrationGetStandard(level, squared, &e->standard));
  PetscCall(PetscFree(squared));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All but norm and potential. [in] frozen - or NULL */
static PetscErrorCode EstimateCreate_Private(Fields fields, const EstimateFrozen *frozen, Estimate *estimate)
{
  const Level   *level   = fields->vi->level;
  const PetscInt num     = level->scene->num_bodies;
  PetscReal      sums[5] = {0}, *surplus;
  Compliance     compliance;
  Estimate       e;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&e));
  PetscCall(PetscCalloc5(level->num_cells, &e->cell, level->num_cells, &e->volume, num, &e->body, fields->vi->num_pairs,
                         &e->hidden, MESH_MAX_ADAPTED, &e->aged));
  PetscCall(PetscCalloc1(level->num_cells, &surplus));
  PetscCall(ComplianceCreate(level->scene, &compliance));
  PetscCall(EstimateAddCells_Private(fields, &compliance, e));
  PetscCall(EstimatePairsAdd(fields, frozen, &compliance, e->cell, surplus, &e->signs, e->hidden));
  PetscCall(LargestReduce(level->comm, level->dim, fields->vi->num_pairs, e->hidden));
  if (!frozen) PetscCall(OscillationAdd(fields, &compliance, e->cell, &e->supports));
  PetscCall(EstimateSetAged_Private(level, surplus, e));
  if (!frozen) PetscCall(GeometryAdd(fields, &compliance, e->cell, &e->geometry, &e->signs));
  PetscCall(ComplianceDestroy(&compliance));
  for (PetscInt c = 0; c < level->num_cells; c++) e->body[level->cell_body[c]] += e->cell[c];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, e->body, (PetscMPIInt)num, MPIU_REAL, MPI_SUM, level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, e->aged, MESH_MAX_ADAPTED, MPIU_REAL, MPI_SUM, level->comm));
  sums[0] = e->signs;
  sums[1] = e->geometry;
  sums[2] = e->lost;
  sums[3] = e->supports;
  for (PetscInt c = 0; c < level->num_cells; c++) sums[4] += surplus[c];
  PetscCall(PetscFree(surplus));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPIU_REAL, MPI_SUM, level->comm));
  e->lost     = sums[2];
  e->supports = sums[3];
  e->signs    = sums[0] + e->lost + e->supports;
  e->geometry = sums[1];
  e->squared  = -sums[4];
  for (PetscInt b = 0; b < num; b++) e->squared += e->body[b];
  *estimate = e;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EstimateCreateFrozen(Fields fields, const EstimateFrozen *frozen, Estimate *estimate)
{
  return EstimateCreate_Private(fields, frozen, estimate);
}

PetscErrorCode EstimateGet(Fields fields, Estimate *estimate)
{
  const PetscInt num = fields->vi->scene->num_bodies;
  PetscReal     *energy;

  PetscFunctionBeginUser;
  *estimate = fields->estimate;
  if (*estimate) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(EstimateCreate_Private(fields, NULL, estimate));
  PetscCall(PetscMalloc1(num, &energy));
  PetscCall(FieldsEnergy(fields, energy, &(*estimate)->potential));
  for (PetscInt b = 0; b < num; b++) (*estimate)->norm += 2 * energy[b];
  for (PetscInt p = 0; p < fields->vi->num_pairs; p++)
    (*estimate)->missed = (PetscBool)((*estimate)->missed || (*estimate)->hidden[p].value > 0);
  PetscCall(PetscFree(energy));
  fields->estimate = *estimate;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscReal EstimateGetError(const Estimate estimate, PetscReal theta)
{
  return PetscSqrtReal(PetscSqr(theta) * (estimate->squared - estimate->geometry) + estimate->geometry);
}

PetscReal EstimateGetRelative(const Estimate estimate, PetscReal theta)
{
  if (estimate->norm > 0) return EstimateGetError(estimate, theta) / PetscSqrtReal(estimate->norm);
  return estimate->missed ? 1 : 0;
}

PetscErrorCode EstimateCreateDensity(Fields fields, PetscReal **density)
{
  Level       *level = fields->vi->level;
  Estimate     estimate;
  Vec          sums, local;
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(EstimateGet(fields, &estimate));
  PetscCall(PetscMalloc1(level->num_owned, density));
  PetscCall(LevelCreateVec(level, 2, &sums));
  PetscCall(VecGhostGetLocalForm(sums, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, &a));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    for (PetscInt i = level->cell_start[c]; i < level->cell_start[c + 1]; i++) {
      a[2 * level->cell_nodes[i]] += estimate->cell[c];
      a[2 * level->cell_nodes[i] + 1] += estimate->volume[c];
    }
  }
  PetscCall(VecRestoreArray(local, &a));
  PetscCall(VecGhostRestoreLocalForm(sums, &local));
  PetscCall(LevelShareVec(sums, ADD_VALUES));
  PetscCall(VecGetArray(sums, &a));
  for (PetscInt i = 0; i < level->num_owned; i++)
    (*density)[i] = PetscSqrtReal(PetscRealPart(a[2 * i]) / PetscRealPart(a[2 * i + 1]));
  PetscCall(VecRestoreArray(sums, &a));
  PetscCall(VecDestroy(&sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EstimateDestroy(Estimate *estimate)
{
  PetscFunctionBeginUser;
  if (!*estimate) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(
      PetscFree5((*estimate)->cell, (*estimate)->volume, (*estimate)->body, (*estimate)->hidden, (*estimate)->aged));
  PetscCall(PetscFree(*estimate));
  PetscFunctionReturn(PETSC_SUCCESS);
}
