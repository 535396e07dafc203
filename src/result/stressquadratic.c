/* stressquadratic.c -- stresses of a cell as quadratic functions of the place.

   Slopes of nodal stresses over cells have means at vertices. Their slopes in turn are second derivatives. */
#include "result/stressquadratic.h"
#include "base/compat.h"
#include "kernel/dense.h"
#include "kernel/vector.h"
#include "level/ghosted.h"

enum {
  DIM      = CELL_MAX_DIM,
  STRESSES = CELL_STRESSES,
  SLOPES   = DIM * STRESSES,
  COLUMNS  = SLOPES + 1 /* and the volume */
};

/* Part of its size by which nodes of a straight cell may be off: roundoff of their places. */
static const PetscReal CELL_ROUNDOFF = 1e-9;

PetscBool StressCellIsStraight(ElementType type, PetscInt dim, const PetscReal X[])
{
  const ElementType linear = ElementLinear(type);
  const PetscInt    num    = ElementNumNodes(linear);
  const PetscReal   least  = CELL_ROUNDOFF * ElementLongestEdge(type, dim, X);
  PetscReal         phi[ELEMENT_MAX_NODES];

  for (PetscInt i = num; i < ElementNumNodes(type); i++) {
    ElementShape(linear, ElementNode(type, i), phi, NULL);
    for (PetscInt k = 0; k < dim; k++) {
      PetscReal off = X[i * dim + k];

      for (PetscInt j = 0; j < num; j++) off -= phi[j] * X[j * dim + k];
      if (PetscAbsReal(off) > least) return PETSC_FALSE;
    }
  }
  return PETSC_TRUE;
}

/* Slopes of functions by their values at the vertices of a cell: sum_i slope_i value_i. Returns PETSC_FALSE
   for a cell without volume.
   [in] X - of its nodes; [out] middle - [dim]; [out] slope - [num][dim] */
static PetscBool StressGetSlopes_Private(PetscInt dim, PetscInt num, const PetscReal X[], PetscReal middle[],
                                         PetscReal slope[])
{
  PetscReal A[DIM * DIM] = {0};

  for (PetscInt k = 0; k < dim; k++) middle[k] = 0;
  for (PetscInt i = 0; i < num * dim; i++) middle[i % dim] += X[i] / num;
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt k = 0; k < dim; k++) slope[i * dim + k] = X[i * dim + k] - middle[k];
    for (PetscInt k = 0; k < dim; k++)
      for (PetscInt l = 0; l < dim; l++) A[k * dim + l] += slope[i * dim + k] * slope[i * dim + l];
  }
  if (!DenseCholesky(dim, A)) return PETSC_FALSE;
  for (PetscInt i = 0; i < num; i++) DenseCholeskySolve(dim, A, &slope[i * dim]);
  return PETSC_TRUE;
}

PetscErrorCode StressCreateSlopes(Level *level, const NodalStressArrays *stress, const PetscReal volume[], Vec *slopes)
{
  const PetscInt dim = level->dim, most = stress->at->most;
  PetscReal      X[DIM * ELEMENT_MAX_NODES], middle[DIM], slope[DIM * ELEMENT_MAX_NODES];
  PetscScalar   *a;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, most * COLUMNS, slopes));
  PetscCall(GhostedGetArray(*slopes, &a));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt  num   = ElementNumNodes(ElementLinear((ElementType)level->cell_type[c]));
    const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]], material = level->cell_material[c];
    PetscReal       sums[COLUMNS] = {0};

    VectorGather(dim, num, nodes, level->coords, X);
    if (!StressGetSlopes_Private(dim, num, X, middle, slope)) continue;
    for (PetscInt i = 0; i < num; i++) {
      const PetscScalar *at = NodalStressAt(stress, nodes[i], material);

      for (PetscInt k = 0; k < dim; k++)
        for (PetscInt s = 0; s < STRESSES; s++)
          sums[k * STRESSES + s] += volume[c] * slope[i * dim + k] * PetscRealPart(at[s]);
    }
    sums[SLOPES] = volume[c];
    for (PetscInt i = 0; i < num; i++) {
      PetscScalar *at = &a[(nodes[i] * most + NodeMaterialsFind(stress->at, nodes[i], material)) * COLUMNS];

      for (PetscInt j = 0; j < COLUMNS; j++) at[j] += sums[j];
    }
  }
  PetscCall(GhostedRestoreArray(*slopes, &a));
  PetscCall(LevelShareVec(*slopes, ADD_VALUES));
  PetscCall(VecGetArray(*slopes, &a));
  for (PetscInt i = 0; i < level->num_owned * most; i++)
    for (PetscInt j = 0; j < SLOPES && a[i * COLUMNS + SLOPES] > 0; j++) a[i * COLUMNS + j] /= a[i * COLUMNS + SLOPES];
  PetscCall(VecRestoreArray(*slopes, &a));
  PetscCall(LevelShareVec(*slopes, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscBool StressQuadraticSet(const Level *level, PetscInt c, const NodeMaterials *at, const PetscScalar slopes[],
                             StressQuadratic *quadratic)
{
  const ElementType type = (ElementType)level->cell_type[c];
  const PetscInt    dim = level->dim, num = ElementNumNodes(ElementLinear(type));
  const PetscInt   *nodes = &level->cell_nodes[level->cell_start[c]], material = level->cell_material[c];

  *quadratic = (StressQuadratic){.dim = dim, .material = material};
  VectorGather(dim, ElementNumNodes(type), nodes, level->coords, quadratic->X);
  if (!StressGetSlopes_Private(dim, num, quadratic->X, quadratic->middle, quadratic->slope)) return PETSC_FALSE;
  for (PetscInt i = 0; i < num; i++) {
    const PetscScalar *first = &slopes[(nodes[i] * at->most + NodeMaterialsFind(at, nodes[i], material)) * COLUMNS];

    for (PetscInt l = 0; l < dim; l++)
      for (PetscInt s = 0; s < STRESSES; s++) {
        quadratic->first[l][s] += PetscRealPart(first[l * STRESSES + s]) / num;
        for (PetscInt k = 0; k < dim; k++)
          quadratic->second[k][l][s] += quadratic->slope[i * dim + k] * PetscRealPart(first[l * STRESSES + s]);
      }
  }
  return PETSC_TRUE;
}

void StressQuadraticEvaluate(const StressQuadratic *quadratic, const PetscReal x[], PetscBool linear,
                             PetscReal stress[])
{
  const PetscInt dim = quadratic->dim;
  PetscReal      f[DIM];

  for (PetscInt k = 0; k < dim; k++) f[k] = x[k] - quadratic->middle[k];
  for (PetscInt s = 0; s < STRESSES; s++) {
    stress[s] = 0;
    for (PetscInt k = 0; k < dim; k++) {
      if (linear) stress[s] += quadratic->first[k][s] * f[k];
      for (PetscInt l = 0; l < dim; l++) stress[s] += quadratic->second[k][l][s] * f[k] * f[l] / 2;
    }
  }
}
