/* unseenstress.c -- second derivatives of recovered stresses.

   Where cells are alike and stresses quadratic, linear functions through the points of highest accuracy meet
   at nodes. Then their averages differ from them by nothing, though quadratic parts are missing in all cells.
   Second derivatives tell these. They come from slopes of the recovered stress over cells, whose averages at
   vertices have slopes again. Stresses of straight cells are polynomials of the place; those of curved ones
   are not, and may be nearer. */
#include "base/compat.h"
#include "kernel/dense.h"
#include "kernel/vector.h"
#include "level/ghosted.h"
#include "problem/elasticity.h"
#include "result/calibration.h"
#include "result/cellstress.h"
#include "result/unseencubic.h"
#include "result/unseenstress.h"

enum {
  DIM       = CELL_MAX_DIM,
  STRESSES  = CELL_STRESSES,
  SLOPES    = DIM * STRESSES,
  COLUMNS   = SLOPES + 1,
  FUNCTIONS = DIM + 1
};

/* Part of its size by which nodes of a straight cell may be off: roundoff of their places. */
static const PetscReal CELL_ROUNDOFF = 1e-9;

/* Whether all nodes of a cell lie where its vertices put them. [in] X - of its nodes [num_nodes][dim] */
static PetscBool UnseenStressIsStraight_Private(ElementType type, PetscInt dim, const PetscReal X[])
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
static PetscBool UnseenStressGetSlopes_Private(PetscInt dim, PetscInt num, const PetscReal X[], PetscReal middle[],
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

/* Slopes of the recovered stress at vertices. Collective.
   [out] slopes - means of cells by their volumes, [STRESSES] for each coordinate, and the volume; ghosted,
   [most][COLUMNS] per node, owned by the caller */
static PetscErrorCode UnseenStressCreateSlopes_Private(Level *level, const NodalStressArrays *stress,
                                                       const PetscReal volume[], Vec *slopes)
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
    if (!UnseenStressGetSlopes_Private(dim, num, X, middle, slope)) continue;
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

/* A straight cell with stresses that are quadratic functions of the place. */
typedef struct {
  PetscInt  dim, material;
  PetscReal X[DIM * ELEMENT_MAX_NODES], middle[DIM];
  PetscReal slope[DIM * ELEMENT_MAX_NODES]; /* of UnseenStressGetSlopes_Private() */
  PetscReal second[DIM][DIM][STRESSES];     /* derivatives */
  PetscReal nearest[STRESSES][FUNCTIONS];   /* coefficients of linear functions */
} Quadratic;

/* [out] f - 1 and coordinates [dim + 1]; [out] q - the quadratic stresses [STRESSES] */
static void QuadraticEvaluate_Private(const Quadratic *quadratic, const PetscReal x[], PetscReal f[], PetscReal q[])
{
  const PetscInt dim = quadratic->dim;

  f[0] = 1;
  for (PetscInt k = 0; k < dim; k++) f[k + 1] = x[k] - quadratic->middle[k];
  for (PetscInt s = 0; s < STRESSES; s++) {
    q[s] = 0;
    for (PetscInt k = 0; k < dim; k++)
      for (PetscInt l = 0; l < dim; l++) q[s] += quadratic->second[k][l][s] * f[k + 1] * f[l + 1] / 2;
  }
}

/* The place of a point, and its weight in integrals over the cell. */
static PetscReal UnseenStressGetPoint_Private(const Level *level, const ElementRule *rule, PetscInt q,
                                              const PetscReal X[], PetscReal x[])
{
  const PetscReal det = ElementRuleMap(rule, q, X, x, NULL);

  return rule->weight[q] * det * SceneMeasure(level->scene, x);
}

/* Sets the linear functions that are nearest to the quadratic ones in L2. Returns PETSC_FALSE for a cell
   without volume. */
static PetscBool QuadraticSetNearest_Private(const Level *level, const ElementRule *rule, Quadratic *quadratic)
{
  const PetscInt num                         = quadratic->dim + 1;
  PetscReal      mass[FUNCTIONS * FUNCTIONS] = {0}, x[DIM], f[FUNCTIONS], q[STRESSES];

  for (PetscInt p = 0; p < rule->num; p++) {
    const PetscReal weight = UnseenStressGetPoint_Private(level, rule, p, quadratic->X, x);

    QuadraticEvaluate_Private(quadratic, x, f, q);
    for (PetscInt i = 0; i < num; i++) {
      for (PetscInt j = 0; j < num; j++) mass[i * num + j] += weight * f[i] * f[j];
      for (PetscInt s = 0; s < STRESSES; s++) quadratic->nearest[s][i] += weight * f[i] * q[s];
    }
  }
  if (!DenseCholesky(num, mass)) return PETSC_FALSE;
  for (PetscInt s = 0; s < STRESSES; s++) DenseCholeskySolve(num, mass, quadratic->nearest[s]);
  return PETSC_TRUE;
}

/* The integral over a triangle or tetrahedron. */
static PetscErrorCode UnseenStressOfSimplex_Private(const Level *level, const ElementRule *rule, Quadratic *quadratic,
                                                    Compliance *compliance, PetscReal *squared)
{
  const PetscInt   num = quadratic->dim + 1;
  PetscReal        x[DIM], f[FUNCTIONS], q[STRESSES];
  const PetscReal *L;

  PetscFunctionBeginUser;
  *squared = 0;
  if (!QuadraticSetNearest_Private(level, rule, quadratic)) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt p = 0; p < rule->num; p++) {
    const PetscReal weight = UnseenStressGetPoint_Private(level, rule, p, quadratic->X, x);

    QuadraticEvaluate_Private(quadratic, x, f, q);
    for (PetscInt s = 0; s < STRESSES; s++) q[s] -= VectorDot(num, f, quadratic->nearest[s]);
    PetscCall(ComplianceGet(compliance, quadratic->material, x, &L));
    *squared += weight * ComplianceEnergy(compliance, L, q);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The mean over quadrilateral or hexahedron c. */
static PetscErrorCode UnseenStressOfBrick_Private(const Level *level, PetscInt c, const ElementRule *rule,
                                                  const Quadratic *quadratic, Compliance *compliance, PetscReal *mean)
{
  const PetscInt dim = quadratic->dim, num = ElementNumNodes(ElementLinear(rule->type));
  UnseenCubic    cubic = {.dim = dim, .material = quadratic->material};
  DilatationKind kind;
  PetscReal      poisson;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num * dim * dim; i++) {
    const PetscInt  node = i / (dim * dim), j = i / dim % dim, k = i % dim;
    const PetscReal xi = ElementNode(rule->type, node)[j] - 0.5;

    cubic.axis[j][k] += 4 * xi * quadratic->X[node * dim + k] / (PetscReal)num;
    cubic.gradient[j][k] += xi * quadratic->slope[node * dim + k];
  }
  PetscCall(PetscArraycpy(cubic.middle, quadratic->middle, dim));
  PetscCall(PetscArraycpy(&cubic.second[0][0][0], &quadratic->second[0][0][0], DIM * DIM * STRESSES));
  PetscCall(ElasticityDilatationKind(level->scene, level, c, rule, &kind, &poisson));
  PetscCall(UnseenCubicEnergy(&cubic, (PetscBool)(kind != DILATATION_POINTWISE), compliance, mean));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Returns PETSC_FALSE for a cell that is curved or has no volume.
   [in] slopes - local, of UnseenStressCreateSlopes_Private() */
static PetscBool QuadraticSet_Private(const Level *level, PetscInt c, const NodeMaterials *at,
                                      const PetscScalar slopes[], Quadratic *quadratic)
{
  const ElementType type = (ElementType)level->cell_type[c];
  const PetscInt    dim = level->dim, num = ElementNumNodes(ElementLinear(type));
  const PetscInt   *nodes = &level->cell_nodes[level->cell_start[c]], material = level->cell_material[c];

  *quadratic = (Quadratic){.dim = dim, .material = material};
  VectorGather(dim, ElementNumNodes(type), nodes, level->coords, quadratic->X);
  if (!UnseenStressIsStraight_Private(type, dim, quadratic->X)) return PETSC_FALSE;
  if (!UnseenStressGetSlopes_Private(dim, num, quadratic->X, quadratic->middle, quadratic->slope)) return PETSC_FALSE;
  for (PetscInt i = 0; i < num; i++) {
    const PetscScalar *first = &slopes[(nodes[i] * at->most + NodeMaterialsFind(at, nodes[i], material)) * COLUMNS];

    for (PetscInt k = 0; k < dim; k++)
      for (PetscInt l = 0; l < dim; l++)
        for (PetscInt s = 0; s < STRESSES; s++)
          quadratic->second[k][l][s] += quadratic->slope[i * dim + k] * PetscRealPart(first[l * STRESSES + s]);
  }
  return PETSC_TRUE;
}

PetscErrorCode UnseenStressTake(Fields fields, const ElementRule rules[], Compliance *compliance,
                                const PetscReal volume[], PetscReal cell[])
{
  const Scene        scene = fields->vi->scene;
  Level             *level = fields->vi->level;
  PetscBool          any   = PETSC_FALSE;
  Vec                slopes;
  NodalStressArrays  stress;
  const PetscScalar *a;
  Quadratic          quadratic;
  PetscReal          standard;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; b++) any = (PetscBool)(any || scene->bodies[b].order == 2);
  if (!any) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(CalibrationGetStandard(level, &standard));
  PetscCall(NodalStressGetArrays(&fields->stress, &stress));
  PetscCall(UnseenStressCreateSlopes_Private(level, &stress, volume, &slopes));
  PetscCall(NodalStressRestoreArrays(&fields->stress, &stress));
  PetscCall(GhostedGetArrayRead(slopes, &a));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementRule *rule = &rules[level->cell_type[c]];
    PetscReal          squared;

    if (ElementOrder(rule->type) == 1 || !QuadraticSet_Private(level, c, &fields->stress.at, a, &quadratic)) continue;
    if (ElementNumNodes(ElementLinear(rule->type)) == level->dim + 1) {
      PetscCall(UnseenStressOfSimplex_Private(level, rule, &quadratic, compliance, &squared));
    } else {
      PetscCall(UnseenStressOfBrick_Private(level, c, rule, &quadratic, compliance, &squared));
      squared *= volume[c] / PetscSqr(standard); // the mean is that of the error itself
    }
    cell[c] = PetscMax(cell[c], squared);
  }
  PetscCall(GhostedRestoreArrayRead(slopes, &a));
  PetscCall(VecDestroy(&slopes));
  PetscFunctionReturn(PETSC_SUCCESS);
}
