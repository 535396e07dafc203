/* estimate.c -- recovery of stresses, and what contact adds to it.

   The recovered stress is one order nearer to the exact one than that of the displacement: their difference is the error's, nearly
   (Zienkiewicz & Zhu 1992). Nothing of it sees that two sides do not fit each other: a stiff nonmortar body has no stress to speak of
   while its coarse side lets the partner through. What the sides' tractions and gaps leave is taken as a half space takes a wave of the
   facet's size: it resists a displacement of wave number k with E' k / 2, k = pi / h. */
#include "base/compat.h"
#include "contact/pairpoints.h"
#include "kernel/dense.h"
#include "kernel/frame.h"
#include "kernel/vector.h"
#include "problem/elasticity.h"
#include "result/cellstress.h"
#include "result/estimate.h"

enum { MAX_STRAINS = 6, F = ELEMENT_MAX_FACET_NODES };

/* The Cholesky factor of C of a material at a point. Not collective. [out] L - of DenseCholesky() [num_strains][num_strains] */
static PetscErrorCode EstimateFactorHooke_Private(Scene scene, PetscInt material, const PetscReal x[], PetscReal L[])
{
  PetscReal poisson;

  PetscFunctionBeginUser;
  PetscCall(ElasticityHooke(scene, material, x, L, &poisson));
  (void)DenseCholesky(MaterialNumStrains(scene->model), L); // C was found positive definite
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* s : C^-1 : s. [in] L - of EstimateFactorHooke_Private(); [in] stress - the components of the model */
static PetscReal EstimateGetCompliance_Private(PetscInt num, const PetscReal L[], const PetscReal stress[])
{
  PetscReal strain[MAX_STRAINS], sum = 0;

  for (PetscInt k = 0; k < num; k++) strain[k] = stress[k];
  DenseCholeskySolve(num, L, strain);
  for (PetscInt k = 0; k < num; k++) sum += strain[k] * stress[k];
  return sum;
}

/* Rules of the difference of stresses: of twice the order of the displacements. [out] rules - [ELEMENT_COUNT]; PetscFree() it */
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

/* int_T (s* - s) : C^-1 : (s* - s). [in] cell - its displacements; [in] recovered - s* */
static PetscErrorCode EstimateOfCell_Private(const Level *level, PetscInt c, const CellStress *cell,
                                             const ElementRule *rule, const NodalStressArrays *recovered,
                                             PetscReal *squared, PetscReal *volume)
{
  const Scene     scene = level->scene;
  const PetscInt  dim = level->dim, n = ElementNumNodes(rule->type), num = MaterialNumStrains(scene->model);
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]];
  PetscReal       stress[CELL_STRESSES], difference[MAX_STRAINS], L[MAX_STRAINS * MAX_STRAINS], det;

  PetscFunctionBeginUser;
  *squared = *volume = 0;
  for (PetscInt q = 0; q < rule->num; q++) {
    const PetscReal *phi  = &rule->phi[q * n];
    PetscReal        x[3] = {0, 0, 0};

    PetscCall(CellStressAtPoint(scene, cell, rule, q, stress, &det));
    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt k = 0; k < dim; k++) x[k] += phi[i] * cell->X[i * dim + k];
      for (PetscInt k = 0; k < CELL_STRESSES; k++)
        stress[k] -= phi[i] * PetscRealPart(NodalStressAt(recovered, nodes[i], cell->material)[k]);
    }
    PetscCall(EstimateFactorHooke_Private(scene, cell->material, x, L));
    MaterialPickStrains(scene->model, stress, difference);
    det *= rule->weight[q] * SceneMeasure(scene, x);
    *volume += det;
    *squared += det * EstimateGetCompliance_Private(num, L, difference);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode EstimateAddCells_Private(Fields fields, Estimate estimate)
{
  const Level       *level = fields->vi->level;
  Vec                local;
  const PetscScalar *u;
  NodalStressArrays  recovered;
  ElementRule       *rules, *stiffness;
  CellStress         cell;
  PetscReal          squared;

  PetscFunctionBeginUser;
  PetscCall(EstimateRulesCreate_Private(level, &rules));
  PetscCall(ElasticityRulesCreate(level->scene, &stiffness));
  PetscCall(VecGhostGetLocalForm(fields->u, &local));
  PetscCall(VecGetArrayRead(local, &u));
  PetscCall(NodalStressGetArrays(&fields->stress, &recovered));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt type = level->cell_type[c];

    PetscCall(CellStressSet(level->scene, level, c, &stiffness[type], u, &cell));
    PetscCall(EstimateOfCell_Private(level, c, &cell, &rules[type], &recovered, &squared, &estimate->volume[c]));
    estimate->cell[c] += squared;
  }
  PetscCall(NodalStressRestoreArrays(&fields->stress, &recovered));
  PetscCall(VecRestoreArrayRead(local, &u));
  PetscCall(VecGhostRestoreLocalForm(fields->u, &local));
  PetscCall(PetscFree(stiffness));
  PetscCall(PetscFree(rules));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One side's values at nodes: displacements and recovered stresses. */
typedef struct {
  const PetscScalar *u, *traction, *normal; /* local forms of the nonmortar side */
  const PetscScalar *closed;                /* with a frozen set: 1 at nodes in contact, else NULL */
  NodalStressArrays  stress;
  PetscReal *u_m, *stress_m; /* of PairPointsFetch(); where regions meet on the mortar side the stress of the first */
} PairValues;

/* What is there at a point of a pair. */
typedef struct {
  PetscReal x[3], normal[3], jump[3], traction[3], stress[2][CELL_STRESSES];
  PetscBool closed; /* with a frozen set: whether all vertices of the facet are in contact */
} PointState;

static void PointStateSet_Private(const Level *level, PairPoints points, const PairPoint *point,
                                  const PairValues *values, PointState *state)
{
  const PetscInt    dim = level->dim, *nodes = &points->facets.nodes[point->facet * F];
  const ElementType type     = points->facets.type[point->facet];
  const PetscInt    material = level->cell_material[points->facets.cell[point->facet]];
  PetscReal         phi[ELEMENT_MAX_NODES];

  *state = (PointState){.closed = PETSC_TRUE};
  for (PetscInt i = 0; values->closed && i < ElementNumNodes(ElementLinear(type)); i++)
    state->closed = (PetscBool)(state->closed && PetscRealPart(values->closed[nodes[i]]) != 0);
  ElementShape(type, point->xi, phi, NULL);
  for (PetscInt i = 0; i < ElementNumNodes(type); i++) {
    for (PetscInt k = 0; k < dim; k++) {
      state->x[k] += phi[i] * level->coords[nodes[i] * dim + k];
      state->normal[k] += phi[i] * PetscRealPart(values->normal[nodes[i] * dim + k]);
      state->jump[k] += phi[i] * PetscRealPart(values->u[nodes[i] * dim + k]);
      state->traction[k] += phi[i] * PetscRealPart(values->traction[nodes[i] * dim + k]);
    }
    for (PetscInt k = 0; k < CELL_STRESSES; k++)
      state->stress[0][k] += phi[i] * PetscRealPart(NodalStressAt(&values->stress, nodes[i], material)[k]);
  }
  FrameNormalize(dim, state->normal);
  if (point->mortar < 0) return;
  ElementShape(points->type[point->mortar], point->eta, phi, NULL);
  for (PetscInt i = 0; i < ElementNumNodes(points->type[point->mortar]); i++) {
    const PetscInt at = point->mortar * F + i;

    for (PetscInt k = 0; k < dim; k++) state->jump[k] -= phi[i] * values->u_m[at * dim + k];
    for (PetscInt k = 0; k < CELL_STRESSES; k++)
      state->stress[1][k] += phi[i] * values->stress_m[at * CELL_STRESSES + k];
  }
}

/* |s n + traction|^2. */
static PetscReal EstimateGetTractionError_Private(PetscInt dim, const PetscReal stress[CELL_STRESSES],
                                                  const PetscReal n[], const PetscReal traction[])
{
  PetscReal t[CELL_MAX_DIM], sum = 0;

  CellStressTraction(dim, stress, n, t);
  for (PetscInt i = 0; i < dim; i++) sum += PetscSqr(t[i] + traction[i]);
  return sum;
}

/* E' = 1 / (nn : C^-1 : nn) of a material at a point. */
static PetscErrorCode EstimateGetModulus_Private(Scene scene, PetscInt material, const PetscReal x[],
                                                 const PetscReal n[], PetscReal *modulus)
{
  const PetscReal nn[CELL_STRESSES] = {n[0] * n[0], n[1] * n[1], n[2] * n[2], n[1] * n[2], n[0] * n[2], n[0] * n[1]};
  const PetscInt  num               = MaterialNumStrains(scene->model);
  PetscReal       L[MAX_STRAINS * MAX_STRAINS], direction[MAX_STRAINS];

  PetscFunctionBeginUser;
  PetscCall(EstimateFactorHooke_Private(scene, material, x, L));
  MaterialPickStrains(scene->model, nn, direction);
  *modulus = 1 / EstimateGetCompliance_Private(num, L, direction);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Where the parts of pairs go. */
typedef struct {
  PetscInt              first;   /* cell of this rank, counted over all ranks */
  Vec                   squares; /* eta_T^2 of all cells */
  PetscReal             signs;   /* L of this rank */
  const EstimateFrozen *frozen;  /* or NULL */
} PairSums;

/* d^2 at a point. [in] resistance - pi E* / h */
static PetscReal EstimateGetGap_Private(const Fields fields, PetscInt p, const PairPoint *point,
                                        const PointState *state, PetscReal resistance, PairSums *sums)
{
  const PetscInt        dim      = fields->vi->level->dim;
  const Pair            pair     = fields->vi->pairs[p];
  const EstimateFrozen *frozen   = sums->frozen;
  const PetscReal       weight   = point->weight * fields->vi->scene->thickness;
  const PetscReal       pressure = VectorDot(dim, state->normal, state->traction);
  const PetscReal       motion   = frozen ? (*frozen->motion)(frozen->ctx, p, state->x) : 0;
  const PetscReal       depth    = VectorDot(dim, state->normal, state->jump) - (frozen ? motion : point->gap);
  PetscReal             squared  = 0;

  if (pair->spec->type == PAIR_TIED) {
    if (pair->arm) return 0; // an arm is a part of the jump
    for (PetscInt k = 0; k < dim; k++) squared += PetscSqr(state->jump[k] - motion * state->normal[k]);
    sums->signs -= 2 * weight * VectorDot(dim, state->jump, state->traction);
    return squared;
  }
  sums->signs -= 2 * weight * pressure * depth;
  if (frozen) return state->closed ? depth * depth : 0;
  return depth < 0 ? PetscSqr(PetscMin(-depth, PetscMax(0, pressure) / resistance)) : depth * depth;
}

/* Adds one point. [in] size - of its nonmortar facet */
static PetscErrorCode EstimateAddPoint_Private(Fields fields, PetscInt p, const PairPoint *point, PetscReal size,
                                               const PointState *state, PairSums *sums)
{
  const Level    *level  = fields->vi->level;
  const Pair      pair   = fields->vi->pairs[p];
  const PetscReal weight = point->weight * level->scene->thickness;
  PetscReal       E[2], squared;

  PetscFunctionBeginUser;
  PetscCall(EstimateGetModulus_Private(level->scene, level->cell_material[pair->points->facets.cell[point->facet]],
                                       state->x, state->normal, &E[0]));
  squared = weight * 2 / PETSC_PI * size / E[0] *
            EstimateGetTractionError_Private(level->dim, state->stress[0], state->normal, state->traction);
  if (point->mortar >= 0) {
    const PairPoints points = pair->points;

    PetscCall(
        EstimateGetModulus_Private(level->scene, points->material[point->mortar], state->x, state->normal, &E[1]));
    PetscCall(
        VecSetValue(sums->squares, points->cell[point->mortar],
                    weight * 2 / PETSC_PI * points->size[point->mortar] / E[1] *
                        EstimateGetTractionError_Private(level->dim, state->stress[1], state->normal, state->traction),
                    ADD_VALUES));
    E[0] = 1 / (1 / E[0] + 1 / E[1]);
  }
  E[0] *= PETSC_PI / size;
  squared += weight * E[0] * EstimateGetGap_Private(fields, p, point, state, E[0], sums);
  PetscCall(VecSetValue(sums->squares, sums->first + pair->points->facets.cell[point->facet], squared, ADD_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks the nodes of a pair that are in contact. Collective. [in] fields - of the solution; [out] closed - ghosted, owned by the caller */
static PetscErrorCode EstimateMarkClosed_Private(Fields fields, PetscInt p, Vec *closed)
{
  PairFields   nodal;
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(fields->vi->level, 1, closed));
  PetscCall(PairFieldsCreate(fields, p, &nodal));
  PetscCall(VecGetArray(*closed, &a));
  for (PetscInt i = 0; i < fields->vi->level->num_owned; i++) a[i] = nodal.status[i] == STATUS_CONTACT;
  PetscCall(VecRestoreArray(*closed, &a));
  PetscCall(PairFieldsDestroy(&nodal));
  PetscCall(VecGhostUpdateBegin(*closed, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(*closed, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the points of one pair. Collective. */
static PetscErrorCode EstimateAddPair_Private(Fields fields, PetscInt p, PairSums *sums)
{
  const Level        *level  = fields->vi->level;
  const PairPoints    points = fields->vi->pairs[p]->points;
  PairValues          values = {NULL};
  PointState          state;
  Vec                 v[4]     = {fields->u, NULL, points->normals, NULL}, local[4];
  const PetscScalar **array[4] = {&values.u, &values.traction, &values.normal, &values.closed};
  const PetscInt      num      = sums->frozen ? 4 : 3;
  PetscReal           X[3 * F];

  PetscFunctionBeginUser;
  PetscCall(PairTractionCreate(fields, p, &v[1]));
  if (sums->frozen) PetscCall(EstimateMarkClosed_Private(sums->frozen->solution, p, &v[3]));
  PetscCall(PairPointsFetch(points, fields->u, level->dim, &values.u_m));
  PetscCall(PairPointsFetch(points, fields->stress.value[0], CELL_STRESSES, &values.stress_m));
  PetscCall(NodalStressGetArrays(&fields->stress, &values.stress));
  for (PetscInt i = 0; i < num; i++) {
    PetscCall(VecGhostGetLocalForm(v[i], &local[i]));
    PetscCall(VecGetArrayRead(local[i], array[i]));
  }
  for (PetscInt q = 0; q < points->num; q++) {
    const PairPoint *point = &points->point[q];

    ContactFacetCoordinates(level, &points->facets, point->facet, X);
    PointStateSet_Private(level, points, point, &values, &state);
    PetscCall(EstimateAddPoint_Private(
        fields, p, point, ContactFacetSize(level->dim, points->facets.type[point->facet], X), &state, sums));
  }
  for (PetscInt i = 0; i < num; i++) {
    PetscCall(VecRestoreArrayRead(local[i], array[i]));
    PetscCall(VecGhostRestoreLocalForm(v[i], &local[i]));
  }
  PetscCall(NodalStressRestoreArrays(&fields->stress, &values.stress));
  PetscCall(PetscFree(values.stress_m));
  PetscCall(PetscFree(values.u_m));
  PetscCall(VecDestroy(&v[1]));
  PetscCall(VecDestroy(&v[3]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds all pairs. Collective. */
static PetscErrorCode EstimateAddPairs_Private(Fields fields, const EstimateFrozen *frozen, Estimate estimate)
{
  const Level       *level = fields->vi->level;
  PairSums           sums  = {.frozen = frozen};
  const PetscScalar *square;

  PetscFunctionBeginUser;
  PetscCall(VecCreateMPI(level->comm, level->num_cells, PETSC_DETERMINE, &sums.squares));
  PetscCall(VecGetOwnershipRange(sums.squares, &sums.first, NULL));
  for (PetscInt p = 0; p < fields->vi->num_pairs; p++) PetscCall(EstimateAddPair_Private(fields, p, &sums));
  PetscCall(VecAssemblyBegin(sums.squares));
  PetscCall(VecAssemblyEnd(sums.squares));
  PetscCall(VecGetArrayRead(sums.squares, &square));
  for (PetscInt c = 0; c < level->num_cells; c++) estimate->cell[c] += PetscRealPart(square[c]);
  PetscCall(VecRestoreArrayRead(sums.squares, &square));
  PetscCall(VecDestroy(&sums.squares));
  estimate->signs = sums.signs;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All but norm and potential. [in] frozen - or NULL */
static PetscErrorCode EstimateCreate_Private(Fields fields, const EstimateFrozen *frozen, Estimate *estimate)
{
  const Level   *level = fields->vi->level;
  const PetscInt num   = level->scene->num_bodies;
  Estimate       e;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&e));
  PetscCall(PetscCalloc3(level->num_cells, &e->cell, level->num_cells, &e->volume, num, &e->body));
  PetscCall(EstimateAddCells_Private(fields, e));
  PetscCall(EstimateAddPairs_Private(fields, frozen, e));
  for (PetscInt c = 0; c < level->num_cells; c++) e->body[level->cell_body[c]] += e->cell[c];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, e->body, (PetscMPIInt)num, MPIU_REAL, MPI_SUM, level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &e->signs, 1, MPIU_REAL, MPI_SUM, level->comm));
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
  PetscCall(PetscFree(energy));
  fields->estimate = *estimate;
  PetscFunctionReturn(PETSC_SUCCESS);
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
  PetscCall(PetscFree3((*estimate)->cell, (*estimate)->volume, (*estimate)->body));
  PetscCall(PetscFree(*estimate));
  PetscFunctionReturn(PETSC_SUCCESS);
}
