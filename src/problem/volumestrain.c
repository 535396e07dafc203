/* volumestrain.c -- mean dilatation of the cells of a body (eq. 9.1).

   The method is chosen cell by cell. So a varying Poisson's ratio adds no work where it is low, and triangles
   and quadrilaterals of one mesh differ. Nothing is stored: results compute Pi again. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "problem/volumestrain.h"

/* In axisymmetric cells the integrand has 1 / r and is no polynomial: the degree of the measure is added
   twice. */
static PetscInt VolumeStrainStiffnessDegree_Private(Scene scene, ElementType type)
{
  return ElementStiffnessDegree(type) + 2 * SceneMeasureDegree(scene, ElementOrder(type));
}

PetscErrorCode ElasticityRulesCreate(Scene scene, ElementRule **rules)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(ELEMENT_COUNT, rules));
  for (PetscInt t = 0; t < ELEMENT_COUNT; t++)
    ElementRuleSet((ElementType)t, VolumeStrainStiffnessDegree_Private(scene, (ElementType)t), &(*rules)[t]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

void VolumeStrainCoordinates(const Level *level, PetscInt c, PetscReal X[])
{
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]];
  const PetscInt  n     = level->cell_start[c + 1] - level->cell_start[c];

  VectorGather(level->dim, n, nodes, level->coords, X);
}

PetscErrorCode ElasticityDilatationKind(Scene scene, const Level *level, PetscInt c, const ElementRule *rule,
                                        DilatationKind *kind, PetscReal *poisson)
{
  const Expression ratio = SceneGetMaterial(scene, level->cell_material[c])->poisson;
  PetscReal        X[DILATATION_MAX_DOFS], x[3] = {0, 0, 0}, nu;

  PetscFunctionBeginUser;
  *kind    = DILATATION_POINTWISE;
  *poisson = NAN;
  if (!ratio || scene->model == MODEL_PLANE_STRESS) PetscFunctionReturn(PETSC_SUCCESS);
  if (ExpressionIsConstant(ratio)) {
    PetscCall(ExpressionEvaluate(ratio, scene->dim, x, poisson));
  } else {
    VolumeStrainCoordinates(level, c, X);
    for (PetscInt q = 0; q < rule->num; q++) {
      ElementRuleMap(rule, q, X, x, NULL);
      PetscCall(ExpressionEvaluate(ratio, scene->dim, x, &nu));
      if (!(nu <= *poisson)) *poisson = nu;
    }
  }
  *kind = DilatationChoose(rule->type, *poisson);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A radial displacement phi_i adds the hoop strain phi_i / r to its derivative. */
void VolumeStrainDilatation(Scene scene, DilatationKind kind, const ElementRule *rule, const PetscReal x[],
                            const PetscReal w[], PetscReal grad[], Dilatation *dilatation)
{
  const PetscInt dim = scene->dim, nn = ElementNumNodes(rule->type);

  for (PetscInt q = 0; q < rule->num && scene->model == MODEL_AXISYMMETRIC; q++) {
    for (PetscInt i = 0; i < nn; i++) grad[(q * nn + i) * dim] += rule->phi[q * nn + i] / x[q * dim];
  }
  DilatationSet(kind, rule, x, w, grad, dilatation);
}

PetscErrorCode ElasticityDilatation(Scene scene, const Level *level, PetscInt c, const ElementRule *rule,
                                    Dilatation *dilatation)
{
  const PetscInt dim = scene->dim, n = ElementNumNodes(rule->type) * dim;
  PetscReal      X[DILATATION_MAX_DOFS], x[ELEMENT_MAX_POINTS * 3], w[ELEMENT_MAX_POINTS], poisson;
  PetscReal      grad[ELEMENT_MAX_POINTS * DILATATION_MAX_DOFS];
  DilatationKind kind;

  PetscFunctionBeginUser;
  dilatation->num = 0;
  PetscCall(ElasticityDilatationKind(scene, level, c, rule, &kind, &poisson));
  if (kind == DILATATION_POINTWISE) PetscFunctionReturn(PETSC_SUCCESS);
  VolumeStrainCoordinates(level, c, X);
  for (PetscInt q = 0; q < rule->num; q++) {
    w[q] = rule->weight[q] * ElementRuleMap(rule, q, X, &x[q * dim], &grad[q * n]);
    w[q] *= SceneMeasure(scene, &x[q * dim]);
  }
  VolumeStrainDilatation(scene, kind, rule, x, w, grad, dilatation);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ElasticityDilatationCount(Scene scene, const Level *level, DilatationCount counts[])
{
  ElementRule *rules;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(counts, scene->num_bodies));
  PetscCall(ElasticityRulesCreate(scene, &rules));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    DilatationCount *count = &counts[level->cell_body[c]];
    DilatationKind   kind;
    PetscReal        poisson;

    PetscCall(ElasticityDilatationKind(scene, level, c, &rules[level->cell_type[c]], &kind, &poisson));
    count->cells[kind]++;
    if (kind) count->poisson = PetscMax(count->poisson, poisson);
  }
  PetscCall(PetscFree(rules));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, counts[b].cells, DILATATION_LOCKS, MPIU_INT, MPI_SUM, level->comm));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &counts[b].poisson, 1, MPIU_REAL, MPI_MAX, level->comm));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ElasticityGetOrders(Scene scene, const Level *level, PetscInt order[])
{
  DilatationCount *counts;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(scene->num_bodies, &counts));
  PetscCall(ElasticityDilatationCount(scene, level, counts));
  for (PetscInt b = 0; b < scene->num_bodies; b++)
    order[b] = counts[b].cells[DILATATION_MEAN] ? 1 : scene->bodies[b].order;
  PetscCall(PetscFree(counts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void VolumeStrainLockingText(Scene scene, PetscInt material, ElementType type, PetscReal poisson, char sentence[],
                             size_t len)
{
  const Expression  ratio     = SceneGetMaterial(scene, material)->poisson;
  const char *const name      = scene->bodies[SceneMaterialBody(scene, material)].name;
  const PetscBool   plane     = (PetscBool)(scene->dim == 2);
  const PetscInt    order     = ElementOrder(type);
  const PetscBool   higher    = (PetscBool)(DilatationChoose(ElementOfOrder(type, 2), poisson) != DILATATION_LOCKS);
  const char *const boxes     = plane ? "quadrilaterals" : "hexahedra";
  const char *const kept      = scene->adapt.on && !scene->adapt.kept ? " and -adapt_cells kept" : "";
  const char *const simplices = plane ? "triangles" : "tetrahedra";

  snprintf(
      sentence, len,
      "%s %s: %s of order %d lock above %g, since they can hardly move without changing their volume; use %s%s%s%s%s",
      ExpressionOption(ratio), ExpressionText(ratio), simplices, (int)order, (double)DilatationThreshold(type), boxes,
      kept, higher ? ", or -" : "", higher ? name : "", higher ? "_order 2" : "");
}
