/* loads.c -- body forces, tractions and pressures as nodal loads, and strains without stress.

   Plain numbers are integrated exactly. Expressions have LoadGetDegree_Private(): the error of a load is of
   higher order than that of the discretisation. Where they have jumps or kinks they are integrated anew
   (loadrefine.c). Each rank sums over its own facets and cells; then the sums are shared. */
#include "base/compat.h"
#include "base/warning.h"
#include <string.h>
#include "kernel/vector.h"
#include "problem/loads.h"
#include "problem/eigenstrain.h"
#include "problem/loadterm.h"

/* The degree of a constant body force: shape functions of order p times det J of degree dim p - 1 in each
   coordinate. */
static PetscInt LoadGetConstantDegree_Private(PetscInt dim, PetscInt order)
{
  return (dim + 1) * order - 1;
}

/* The degree for formulas: the error in the work of a smooth load is of order h^6 for order 1, h^8 for order
   2. */
static PetscInt LoadGetDegree_Private(PetscInt order)
{
  return 2 * order + 3;
}

/* On a facet, exact to degree 6 on flat ones. The measure of a curved one is not a polynomial, so that even
   constants are exact only to within (the angle it turns by)^12. */
PetscInt LoadElementFacetDegree(PetscInt order)
{
  return 4 * order + 3;
}

void LoadElementSet(const LoadTerm *term, PetscInt e, LoadElement *element)
{
  element->term      = term;
  element->type      = term->type[e];
  element->nodes     = term->nodes[e];
  element->num_nodes = ElementNumNodes(element->type);
  VectorGather(term->dim, element->num_nodes, element->nodes, term->level->coords, element->X);
}

/* t = traction + spin x (x - centre) */
static void LoadElementTotal_Private(const LoadTerm *term, const PetscReal x[], PetscReal t[])
{
  PetscReal arm[3] = {0, 0, 0}, turn[3];

  for (PetscInt k = 0; k < term->dim; k++) arm[k] = x[k] - term->centre[k];
  VectorCross(term->spin, arm, turn);
  for (PetscInt k = 0; k < term->dim; k++) t[k] = term->traction[k] + turn[k];
}

PetscErrorCode LoadElementValue(const LoadElement *element, const PetscReal xi[], PetscReal weight, PetscReal value[])
{
  const LoadTerm *term = element->term;
  const PetscInt  dim  = term->dim;
  PetscReal       phi[ELEMENT_MAX_NODES], x[3], nu[3], t[3], dx;

  PetscFunctionBeginUser;
  if (term->on_facets)
    dx = weight * ElementSurface(element->type, element->X, xi, x, phi, nu);
  else
    dx = weight * ElementMap(element->type, element->X, xi, x, phi, NULL);
  dx *= SceneMeasure(term->scene, x);
  if (term->total)
    LoadElementTotal_Private(term, x, t);
  else
    PetscCall(ExpressionEvaluate(term->value, dim, x, t));
  if (term->pressure) {
    const PetscReal p = t[0];
    for (PetscInt k = 0; k < dim; k++) t[k] = -p * nu[k];
  }
  for (PetscInt i = 0; i < element->num_nodes; i++) {
    for (PetscInt k = 0; k < dim; k++) value[i * dim + k] = dx * phi[i] * t[k];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LoadElementIntegrate(const LoadElement *element, PetscReal fe[])
{
  const LoadTerm *term = element->term;
  const PetscInt  dim = term->dim, inner = ElementDim(element->type), n = element->num_nodes * dim;
  const PetscInt  order = ElementOrder(element->type);
  PetscInt        degree, num;
  PetscReal       points[3 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], value[CUBATURE_MAX_SIZE];

  PetscFunctionBeginUser;
  if (term->on_facets)
    degree = LoadElementFacetDegree(order);
  else
    degree = (term->formula ? LoadGetDegree_Private(order) : LoadGetConstantDegree_Private(dim, order)) +
             SceneMeasureDegree(term->scene, order);
  num = QuadratureRule(element->type, degree, points, w);
  PetscCall(PetscArrayzero(fe, n));
  for (PetscInt q = 0; q < num; q++) {
    PetscCall(LoadElementValue(element, &points[q * inner], w[q], value));
    for (PetscInt i = 0; i < n; i++) fe[i] += value[i];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

void LoadElementAdd(const LoadElement *element, PetscReal scale, const PetscReal fe[], PetscScalar fa[])
{
  const PetscInt dim = element->term->dim;

  for (PetscInt i = 0; i < element->num_nodes; i++) {
    for (PetscInt k = 0; k < dim; k++) fa[element->nodes[i] * dim + k] += scale * fe[i * dim + k];
  }
}

void LoadElementSums(const LoadElement *element, const PetscReal fe[], PetscReal sums[])
{
  const PetscInt dim = element->term->dim;

  for (PetscInt i = 0; i < element->num_nodes * dim; i++) sums[i % dim] += PetscAbsReal(fe[i]);
}

PetscErrorCode LoadTermCreate(Scene scene, Level *level, PetscInt material, const SceneBoundary *boundary,
                              LoadTerm *term)
{
  const PetscInt body = SceneMaterialBody(scene, material);

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(term, sizeof(*term)));
  term->scene     = scene;
  term->level     = level;
  term->value     = boundary ? boundary->value : SceneGetMaterial(scene, material)->body_force;
  term->pressure  = (PetscBool)(boundary && boundary->kind == BOUNDARY_PRESSURE);
  term->on_facets = (PetscBool)(boundary != NULL);
  term->total     = (PetscBool)(boundary && (boundary->kind == BOUNDARY_FORCE || boundary->kind == BOUNDARY_MOMENT));
  term->formula   = (PetscBool) !(term->total || ExpressionIsConstant(term->value));
  term->body      = body;
  term->dim       = level->dim;
  if (boundary) {
    PetscCall(LevelGetFacets(level, scene, body, boundary->side, &term->facets));
    term->num = term->facets.num;
  }
  for (PetscInt c = 0; !boundary && c < level->num_cells; c++) term->num += level->cell_material[c] == material;
  PetscCall(PetscMalloc2(term->num, &term->type, term->num, &term->nodes));
  for (PetscInt f = 0; f < term->facets.num; f++) {
    term->type[f]  = term->facets.type[f];
    term->nodes[f] = &term->facets.nodes[f * ELEMENT_MAX_FACET_NODES];
  }
  for (PetscInt c = 0, e = 0; !boundary && c < level->num_cells; c++) {
    if (level->cell_material[c] != material) continue;
    term->type[e]    = (ElementType)level->cell_type[c];
    term->nodes[e++] = &level->cell_nodes[level->cell_start[c]];
  }
  if (term->formula)
    PetscCall(
        PetscCalloc3(term->num * term->dim, &term->own, term->num * term->dim, &term->miss, term->num, &term->points));
  if (term->total) PetscCall(LoadTermSpread(term, (PetscBool)(boundary->kind == BOUNDARY_MOMENT)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LoadTermDestroy(LoadTerm *term)
{
  PetscFunctionBeginUser;
  if (term->switches) PetscCall(ExpressionDestroy(&term->switches));
  PetscCall(PetscFree3(term->own, term->miss, term->points));
  PetscCall(PetscFree2(term->type, term->nodes));
  PetscCall(FacetsDestroy(&term->facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All terms of a scene. [out] terms - owned by the caller, [num] */
static PetscErrorCode LoadsCreateTerms_Private(Scene scene, Level *level, PetscInt *num, LoadTerm **terms)
{
  PetscInt room = 0;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; b++)
    room += 1 + scene->bodies[b].num_regions + scene->bodies[b].num_boundaries;
  PetscCall(PetscMalloc1(room, terms));
  *num = 0;
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    const SceneBody *body = &scene->bodies[b];

    for (PetscInt r = -1; r < body->num_regions; r++) {
      const PetscInt material = r < 0 ? b : SceneBodyFirstRegion(scene, b) + r;

      if (SceneGetMaterial(scene, material)->body_force)
        PetscCall(LoadTermCreate(scene, level, material, NULL, &(*terms)[(*num)++]));
    }
    for (PetscInt i = 0; i < body->num_boundaries; i++) {
      if (!SceneBoundaryIsLoad(&body->boundaries[i])) continue;
      PetscCall(LoadTermCreate(scene, level, b, &body->boundaries[i], &(*terms)[(*num)++]));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds a term by the rule for smooth loads. [in,out] fa - [num_nodes][dim] */
static PetscErrorCode LoadsAddTerm_Private(LoadTerm *term, PetscScalar fa[])
{
  LoadElement element;
  PetscReal   fe[CUBATURE_MAX_SIZE];

  PetscFunctionBeginUser;
  for (PetscInt e = 0; e < term->num; e++) {
    LoadElementSet(term, e, &element);
    PetscCall(LoadElementIntegrate(&element, fe));
    if (term->formula)
      PetscCall(LoadElementCheck(&element, e, fe));
    else
      LoadElementSums(&element, fe, term->sums);
    LoadElementAdd(&element, 1., fe, fa);
  }
  for (PetscInt i = 0; term->formula && i < term->num * term->dim; i++) term->sums[i % term->dim] += term->own[i];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LoadsAssemble(Scene scene, Level *level, Vec f)
{
  LoadTerm    *terms;
  PetscScalar *fa;
  PetscInt     num = 0;
  Vec          local;

  PetscFunctionBeginUser;
  PetscCall(LoadsCreateTerms_Private(scene, level, &num, &terms));
  PetscCall(VecGhostGetLocalForm(f, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, &fa));
  for (PetscInt i = 0; i < num; i++) PetscCall(LoadsAddTerm_Private(&terms[i], fa));
  PetscCall(LoadTermsRefine(level, num, terms, fa));
  PetscCall(EigenstrainAddLoads(scene, level, fa));
  PetscCall(VecRestoreArray(local, &fa));
  PetscCall(VecGhostRestoreLocalForm(f, &local));
  PetscCall(LevelShareVec(f, ADD_VALUES));
  PetscCall(LevelConformForces(level, level->dim, f));
  for (PetscInt i = 0; i < num; i++) {
    PetscCall(ExpressionCheck(level->comm, terms[i].value));
    PetscCall(LoadTermDestroy(&terms[i]));
  }
  PetscCall(PetscFree(terms));
  PetscCall(EigenstrainCheck(scene, level));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds force, and moment about the centroid, of nodal loads. Positions are those of nodes: shape functions
   reproduce x, so that the moment is that of the load. [in] fa - [num_nodes][dim] */
static PetscErrorCode LoadSumAdd_Private(const LoadTerm *term, const PetscScalar fa[], LoadSum *sum)
{
  const PetscInt dim         = term->dim;
  PetscReal      total[2][3] = {{0}};

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < term->level->num_nodes; i++) {
    PetscReal arm[3] = {0, 0, 0}, F[3] = {0, 0, 0}, moment[3];

    for (PetscInt k = 0; k < dim; k++) {
      arm[k] = term->level->coords[i * dim + k] - sum->centre[k];
      F[k]   = PetscRealPart(fa[i * dim + k]);
    }
    VectorCross(arm, F, moment);
    for (PetscInt k = 0; k < 3; k++) {
      total[0][k] += F[k];
      total[1][k] += moment[k];
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, total, 6, MPIU_REAL, MPI_SUM, term->level->comm));
  for (PetscInt k = 0; k < 3; k++) {
    sum->force[k] += total[0][k];
    sum->moment[k] += total[1][k];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LoadSumsCompute(Scene scene, Level *level, PetscInt body, const char side[], LoadSum *sum)
{
  const SceneBody *b     = &scene->bodies[body];
  PetscScalar     *fa    = NULL;
  PetscBool        first = PETSC_TRUE;
  LoadTerm         term;

  PetscFunctionBeginUser;
  *sum = (LoadSum){.area = 0};
  PetscCall(PetscMalloc1(level->num_nodes * level->dim, &fa));
  for (PetscInt i = 0; i < b->num_boundaries; i++) {
    if (!SceneBoundaryIsLoad(&b->boundaries[i]) || strcmp(b->boundaries[i].side, side) != 0) continue;
    PetscCall(LoadTermCreate(scene, level, body, &b->boundaries[i], &term));
    if (first) PetscCall(LoadTermCentroid(&term, sum->centre, &sum->area));
    first = PETSC_FALSE;
    PetscCall(PetscArrayzero(fa, level->num_nodes * level->dim));
    PetscCall(LoadsAddTerm_Private(&term, fa));
    WarningMute(); // the assembly has warned
    PetscCall(LoadTermsRefine(level, 1, &term, fa));
    WarningUnmute();
    PetscCall(LoadSumAdd_Private(&term, fa, sum));
    PetscCall(LoadTermDestroy(&term));
  }
  PetscCall(PetscFree(fa));
  PetscFunctionReturn(PETSC_SUCCESS);
}
