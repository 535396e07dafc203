/* oscillation.c -- data between the points of a mesh.

   A body force with as many waves as there are cells does no work on their shape functions. The displacement
   is zero, and so is its recovered stress. The first omitted wave has the number k = pi / h. A body resists
   it with E' k^2, a half space with E' k / 2. */
#include "result/oscillation.h"
#include "base/compat.h"
#include "kernel/dense.h"
#include "kernel/vector.h"
#include "level/ghosted.h"
#include "result/cellstress.h"

enum {
  F            = ELEMENT_MAX_FACET_NODES,
  N            = ELEMENT_MAX_NODES,
  MORE_DEGREES = 5 /* of quadrature, above twice the order */
};

/* A vector at the points of a cell or facet. */
typedef struct {
  ElementType type;
  PetscInt    dim, num;
  PetscReal   xi[3 * ELEMENT_MAX_POINTS], weight[ELEMENT_MAX_POINTS], value[3 * ELEMENT_MAX_POINTS];
  PetscReal   x[3], n[3]; /* a place, and there the normal of a facet */
} Samples;

/* Values of polynomials below the order, or of all shape functions. Returns their number. */
static PetscInt SamplesGetFunctions_Private(const Samples *samples, PetscBool all, PetscInt q, PetscReal functions[])
{
  const PetscInt inner = ElementDim(samples->type);

  if (all) {
    ElementShape(samples->type, &samples->xi[q * inner], functions, NULL);
    return ElementNumNodes(samples->type);
  }
  functions[0] = 1;
  if (ElementOrder(samples->type) == 1) return 1;
  for (PetscInt k = 0; k < inner; k++) functions[k + 1] = samples->xi[q * inner + k];
  return inner + 1;
}

/* int |v - P v|^2 with the projection P onto such functions.
   [out] largest - direction of the difference where it is largest [dim] */
static PetscReal SamplesProject_Private(const Samples *samples, PetscBool all, PetscReal largest[])
{
  PetscReal mass[N * N] = {0}, part[3][N] = {{0}}, a[N], sum = 0, most = 0;
  PetscInt  n = 0;

  for (PetscInt q = 0; q < samples->num; q++) {
    n = SamplesGetFunctions_Private(samples, all, q, a);
    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt j = 0; j < n; j++) mass[i * n + j] += samples->weight[q] * a[i] * a[j];
      for (PetscInt k = 0; k < samples->dim; k++)
        part[k][i] += samples->weight[q] * a[i] * samples->value[q * samples->dim + k];
    }
  }
  if (!DenseCholesky(n, mass)) return 0;
  for (PetscInt k = 0; k < samples->dim; k++) DenseCholeskySolve(n, mass, part[k]);
  for (PetscInt q = 0; q < samples->num; q++) {
    PetscReal v[3] = {0, 0, 0}, square = 0;

    (void)SamplesGetFunctions_Private(samples, all, q, a);
    for (PetscInt k = 0; k < samples->dim; k++) {
      v[k] = samples->value[q * samples->dim + k] - VectorDot(n, part[k], a);
      square += v[k] * v[k];
    }
    sum += samples->weight[q] * square;
    if (square < most) continue;
    most = square;
    for (PetscInt k = 0; k < samples->dim; k++) largest[k] = square > 0 ? v[k] / PetscSqrtReal(square) : 0;
  }
  return sum;
}

/* int |v - P v|^2 with P onto polynomials below the order. u answers the part of it in shape functions. Of a
   load on a rod h^2/60 (order 1) or h^2/140 is left, instead of (h/pi)^2.
   [out] largest - as above */
static PetscReal SamplesGetOscillation_Private(const Samples *samples, PetscReal largest[])
{
  const PetscReal left = PetscSqr(PETSC_PI) / (ElementOrder(samples->type) == 1 ? 60 : 140);
  const PetscReal all  = SamplesProject_Private(samples, PETSC_FALSE, largest);
  PetscReal       rest[3]; // where shape functions have the whole load it is roundoff
  const PetscReal unseen = PetscMin(all, SamplesProject_Private(samples, PETSC_TRUE, rest));

  return unseen + left * (all - unseen);
}

/* Body forces. */
static PetscErrorCode OscillationAddCells_Private(const Level *level, Compliance *compliance, PetscReal cell[])
{
  const Scene    scene = level->scene;
  const PetscInt dim   = level->dim;
  Samples        samples;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const Expression  force = SceneGetMaterial(scene, level->cell_material[c])->body_force;
    const ElementType type  = (ElementType)level->cell_type[c];
    PetscReal         X[3 * ELEMENT_MAX_NODES], phi[ELEMENT_MAX_NODES], direction[3], modulus, squared;

    if (!force || ExpressionIsConstant(force)) continue;
    VectorGather(dim, ElementNumNodes(type), &level->cell_nodes[level->cell_start[c]], level->coords, X);
    samples.type = type;
    samples.dim  = dim;
    samples.num  = QuadratureRule(type, 2 * ElementOrder(type) + MORE_DEGREES, samples.xi, samples.weight);
    for (PetscInt q = 0; q < samples.num; q++) {
      samples.weight[q] *= ElementMap(type, X, &samples.xi[q * dim], samples.x, phi, NULL);
      samples.weight[q] *= SceneMeasure(scene, samples.x);
      PetscCall(ExpressionEvaluate(force, dim, samples.x, &samples.value[q * dim]));
    }
    squared = SamplesGetOscillation_Private(&samples, direction);
    if (squared <= 0) continue;
    PetscCall(ComplianceModulus(compliance, level->cell_material[c], samples.x, direction, &modulus));
    cell[c] += PetscSqr(ElementLongestEdge(type, dim, X) / PETSC_PI) / modulus * squared;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The solution that data are compared with. */
typedef struct {
  Level             *level;
  Compliance        *compliance;
  const PetscScalar *u;      /* local form */
  NodalStressArrays  stress; /* s* */
} Solution;

/* Data of one boundary on a facet. [out] samples - of a displacement its difference from u */
static PetscErrorCode OscillationSampleFacet_Private(const Solution *solution, const SceneBoundary *boundary,
                                                     const PetscInt nodes[], const PetscReal X[], Samples *samples)
{
  const Level   *level = solution->level;
  const PetscInt dim = level->dim, inner = dim - 1;
  PetscReal      phi[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  samples->dim = dim;
  samples->num =
      QuadratureRule(samples->type, 2 * ElementOrder(samples->type) + MORE_DEGREES, samples->xi, samples->weight);
  for (PetscInt q = 0; q < samples->num; q++) {
    PetscReal *value = &samples->value[q * dim];

    samples->weight[q] *= ElementSurface(samples->type, X, &samples->xi[q * inner], samples->x, phi, samples->n);
    samples->weight[q] *= SceneMeasure(level->scene, samples->x);
    PetscCall(ExpressionEvaluate(boundary->value, dim, samples->x, value));
    if (boundary->kind == BOUNDARY_PRESSURE) {
      const PetscReal p = value[0];

      for (PetscInt k = 0; k < dim; k++) value[k] = p * samples->n[k];
    }
    for (PetscInt k = 0; boundary->kind == BOUNDARY_DISPLACEMENT && k < dim; k++) {
      for (PetscInt i = 0; i < ElementNumNodes(samples->type); i++)
        value[k] -= phi[i] * PetscRealPart(solution->u[nodes[i] * dim + k]);
      if (ExpressionIsFree(boundary->value, k)) value[k] = 0;
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* int_e (s* n).(u_D - u). [in] samples - of u_D - u; nodes, X - of the facet */
static PetscReal OscillationGetWork_Private(const Solution *solution, const Samples *samples, PetscInt material,
                                            const PetscInt nodes[], const PetscReal X[])
{
  const PetscInt dim = samples->dim;
  PetscReal      sum = 0, phi[ELEMENT_MAX_NODES], n[3], traction[3];

  for (PetscInt q = 0; q < samples->num; q++) {
    PetscScalar stress[CELL_STRESSES] = {0};

    ElementSurface(samples->type, X, &samples->xi[q * (dim - 1)], NULL, phi, n);
    for (PetscInt i = 0; i < ElementNumNodes(samples->type); i++) {
      for (PetscInt k = 0; k < CELL_STRESSES; k++)
        stress[k] += phi[i] * NodalStressAt(&solution->stress, nodes[i], material)[k];
    }
    CellStressTraction(dim, stress, n, traction);
    sum += samples->weight[q] * VectorDot(dim, traction, &samples->value[q * dim]);
  }
  return sum;
}

/* One boundary of a body. Collective. */
static PetscErrorCode OscillationAddBoundary_Private(const Solution *solution, PetscInt body,
                                                     const SceneBoundary *boundary, PetscReal cell[],
                                                     PetscReal *supports)
{
  Level    *level = solution->level;
  Facets    facets;
  Samples   samples;
  PetscReal X[3 * F], direction[3], modulus;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, level->scene, body, boundary->side, &facets));
  for (PetscInt f = 0; f < facets.num; f++) {
    const PetscInt *nodes = &facets.nodes[f * F], c = facets.cell[f], material = level->cell_material[c];
    PetscReal       squared = 0, size;

    samples.type = facets.type[f];
    VectorGather(level->dim, ElementNumNodes(samples.type), nodes, level->coords, X);
    PetscCall(OscillationSampleFacet_Private(solution, boundary, nodes, X, &samples));
    PetscCall(ComplianceModulus(solution->compliance, material, samples.x, samples.n, &modulus));
    size = ElementLongestEdge(samples.type, level->dim, X);
    if (boundary->kind == BOUNDARY_DISPLACEMENT) {
      for (PetscInt i = 0; i < samples.num * level->dim; i++)
        squared += samples.weight[i / level->dim] * PetscSqr(samples.value[i]);
      cell[c] += PETSC_PI * modulus / size * squared;
      *supports -= 2 * OscillationGetWork_Private(solution, &samples, material, nodes, X);
    } else {
      cell[c] += 2 / PETSC_PI * size / modulus * SamplesGetOscillation_Private(&samples, direction);
    }
  }
  PetscCall(FacetsDestroy(&facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OscillationAdd(Fields fields, Compliance *compliance, PetscReal cell[], PetscReal *supports)
{
  Solution    solution = {.level = fields->vi->level, .compliance = compliance};
  const Scene scene    = solution.level->scene;

  PetscFunctionBeginUser;
  PetscCall(OscillationAddCells_Private(solution.level, compliance, cell));
  PetscCall(GhostedGetArrayRead(fields->u, &solution.u));
  PetscCall(NodalStressGetArrays(&fields->stress, &solution.stress));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    for (PetscInt i = 0; i < scene->bodies[b].num_boundaries; i++) {
      const SceneBoundary *boundary = &scene->bodies[b].boundaries[i];

      if (boundary->kind == BOUNDARY_NORMAL || boundary->kind == BOUNDARY_FORCE || boundary->kind == BOUNDARY_MOMENT)
        continue;
      if (ExpressionIsConstant(boundary->value)) continue;
      PetscCall(OscillationAddBoundary_Private(&solution, b, boundary, cell, supports));
    }
  }
  PetscCall(NodalStressRestoreArrays(&fields->stress, &solution.stress));
  PetscCall(GhostedRestoreArrayRead(fields->u, &solution.u));
  PetscFunctionReturn(PETSC_SUCCESS);
}
