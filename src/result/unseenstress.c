/* unseenstress.c -- second derivatives of recovered stresses.

   Where cells are alike and stresses quadratic, linear functions through the points of highest accuracy meet
   at nodes. Then their averages differ from them by nothing, though quadratic parts are missing in all cells.
   Second derivatives tell these. They come from slopes of the recovered stress over cells, whose averages at
   vertices have slopes again. In curved cells the recovered stress has the quadratic part already. */
#include "base/compat.h"
#include "kernel/dense.h"
#include "kernel/vector.h"
#include "level/ghosted.h"
#include "problem/elasticity.h"
#include "result/calibration.h"
#include "result/stressquadratic.h"
#include "result/unseencubic.h"
#include "result/unseenstress.h"

enum { DIM = CELL_MAX_DIM, STRESSES = CELL_STRESSES, FUNCTIONS = DIM + 1 };

/* The quadratic part of the stress of a straight cell, and what linear functions have of it. */
typedef struct {
  StressQuadratic stress;
  PetscReal       nearest[STRESSES][FUNCTIONS]; /* coefficients */
} Quadratic;

/* [out] f - 1 and coordinates [dim + 1]; [out] q - the quadratic part [STRESSES] */
static void QuadraticEvaluate_Private(const StressQuadratic *stress, const PetscReal x[], PetscReal f[], PetscReal q[])
{
  f[0] = 1;
  for (PetscInt k = 0; k < stress->dim; k++) f[k + 1] = x[k] - stress->middle[k];
  StressQuadraticEvaluate(stress, x, PETSC_FALSE, q);
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
  const PetscInt num                         = quadratic->stress.dim + 1;
  PetscReal      mass[FUNCTIONS * FUNCTIONS] = {0}, x[DIM], f[FUNCTIONS], q[STRESSES];

  for (PetscInt p = 0; p < rule->num; p++) {
    const PetscReal weight = UnseenStressGetPoint_Private(level, rule, p, quadratic->stress.X, x);

    QuadraticEvaluate_Private(&quadratic->stress, x, f, q);
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
  const PetscInt   num = quadratic->stress.dim + 1;
  PetscReal        x[DIM], f[FUNCTIONS], q[STRESSES];
  const PetscReal *L;

  PetscFunctionBeginUser;
  *squared = 0;
  if (!QuadraticSetNearest_Private(level, rule, quadratic)) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt p = 0; p < rule->num; p++) {
    const PetscReal weight = UnseenStressGetPoint_Private(level, rule, p, quadratic->stress.X, x);

    QuadraticEvaluate_Private(&quadratic->stress, x, f, q);
    for (PetscInt s = 0; s < STRESSES; s++) q[s] -= VectorDot(num, f, quadratic->nearest[s]);
    PetscCall(ComplianceGet(compliance, quadratic->stress.material, x, &L));
    *squared += weight * ComplianceEnergy(compliance, L, q);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The mean over quadrilateral or hexahedron c. */
static PetscErrorCode UnseenStressOfBrick_Private(const Level *level, PetscInt c, const ElementRule *rule,
                                                  const StressQuadratic *quadratic, Compliance *compliance,
                                                  PetscReal *mean)
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

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; b++) any = (PetscBool)(any || scene->bodies[b].order == 2);
  if (!any) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(NodalStressGetArrays(&fields->stress, &stress));
  PetscCall(StressCreateSlopes(level, &stress, volume, &slopes));
  PetscCall(NodalStressRestoreArrays(&fields->stress, &stress));
  PetscCall(GhostedGetArrayRead(slopes, &a));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementRule *rule = &rules[level->cell_type[c]];
    PetscReal          squared;

    if (ElementOrder(rule->type) == 1) continue;
    quadratic = (Quadratic){0};
    if (!StressQuadraticSet(level, c, &fields->stress.at, a, &quadratic.stress)) continue;
    if (!StressCellIsStraight(rule->type, level->dim, quadratic.stress.X)) continue;
    if (ElementNumNodes(ElementLinear(rule->type)) == level->dim + 1) {
      PetscCall(UnseenStressOfSimplex_Private(level, rule, &quadratic, compliance, &squared));
    } else {
      PetscCall(UnseenStressOfBrick_Private(level, c, rule, &quadratic.stress, compliance, &squared));
      squared *= volume[c] / PetscSqr(CalibrationOfStraight(level->dim)); // the mean is that of the error itself
    }
    cell[c] = PetscMax(cell[c], squared);
  }
  PetscCall(GhostedRestoreArrayRead(slopes, &a));
  PetscCall(VecDestroy(&slopes));
  PetscFunctionReturn(PETSC_SUCCESS);
}
