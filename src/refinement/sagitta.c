/* sagitta.c -- distances of curves from straight facets and from parabolas. */
#include "refinement/sagitta.h"
#include "base/compat.h"
#include "kernel/arc.h"
#include "kernel/vector.h"
#include "refinement/levelrefine.h"
#include "side/sideshape.h"

enum { F = ELEMENT_MAX_FACET_NODES, CURVE_DEGREE = 6 };

/* Below this part of a facet's size a height is roundoff. */
static const PetscReal NO_HEIGHT = 1e-12;
/* A parabola through three points of a circle misses it by c x^2 (1 - x^2), |x| <= 1: the mean over the value
   at x = 1/2. */
static const PetscReal MEAN_OF_QUARTER = 32. / 45;

/* Appends the facets whose heights are not zero. [in] more - with their heights; taken over */
static PetscErrorCode SagittasAppend_Private(const Level *level, Facets *more, PetscReal height[], Sagittas *sagittas)
{
  Sagittas all = {.facets = {.num = sagittas->facets.num}};
  PetscInt n   = all.facets.num;

  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < more->num; f++) {
    const PetscReal size = PetscPowReal(FacetGetMeasure(level, more, f, NULL), 1. / (level->dim - 1));

    if (PetscAbsReal(height[f]) <= NO_HEIGHT * size) height[f] = 0;
    all.facets.num += height[f] != 0;
  }
  PetscCall(PetscMalloc1(all.facets.num, &all.height));
  PetscCall(FacetsAllocate(all.facets.num, &all.facets));
  PetscCall(PetscArraycpy(all.height, sagittas->height, n));
  PetscCall(PetscArraycpy(all.facets.type, sagittas->facets.type, n));
  PetscCall(PetscArraycpy(all.facets.cell, sagittas->facets.cell, n));
  PetscCall(PetscArraycpy(all.facets.nodes, sagittas->facets.nodes, n * F));
  for (PetscInt f = 0; f < more->num; f++) {
    if (height[f] == 0) continue;
    all.height[n]      = height[f];
    all.facets.type[n] = more->type[f];
    all.facets.cell[n] = more->cell[f];
    PetscCall(PetscArraycpy(&all.facets.nodes[n++ * F], &more->nodes[f * F], F));
  }
  PetscCall(FacetsDestroy(more));
  PetscCall(PetscFree(height));
  PetscCall(SagittasDestroy(sagittas));
  *sagittas = all;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Values of a table at the nodes of a facet.
   [in] table - [num_nodes][dim]; [out] X - [nodes of the facet][dim] */
static void FacetGather_Private(const Level *level, const Facets *facets, PetscInt f, const PetscReal table[],
                                PetscReal X[])
{
  VectorGather(level->dim, ElementNumNodes(facets->type[f]), &facets->nodes[f * F], table, X);
}

/* The mean distance of a map's surface from a facet, along its normals. [in] X, before - nodes after and
   before the map */
static PetscErrorCode HeightOfMap_Private(PetscInt dim, ElementType type, const PetscReal X[], const PetscReal before[],
                                          Expression map, PetscReal *height)
{
  PetscReal      xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES], area = 0;
  const PetscInt num = QuadratureRule(type, CURVE_DEGREE, xi, w);

  PetscFunctionBeginUser;
  *height = 0;
  for (PetscInt q = 0; q < num; q++) {
    PetscReal       x[3], n[3], box[3] = {0, 0, 0}, on[3];
    const PetscReal part = w[q] * ElementSurface(type, X, &xi[q * (dim - 1)], x, phi, n);

    for (PetscInt i = 0; i < ElementNumNodes(type) * dim; i++) box[i % dim] += phi[i / dim] * before[i];
    PetscCall(ExpressionEvaluate(map, dim, box, on));
    for (PetscInt k = 0; k < dim; k++) *height += part * n[k] * (on[k] - x[k]);
    area += part;
  }
  *height /= area;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Facets of a body with a map. [in] before - positions before it [num_nodes][dim]. Collective. */
static PetscErrorCode SagittasAddMap_Private(Level *level, PetscInt body, const PetscReal before[], Sagittas *sagittas)
{
  Facets     facets;
  PetscReal *height, X[3 * F], box[3 * F];

  PetscFunctionBeginUser;
  PetscCall(LevelGetBoundary(level, body, &facets));
  PetscCall(PetscMalloc1(facets.num, &height));
  for (PetscInt f = 0; f < facets.num; f++) {
    FacetGather_Private(level, &facets, f, level->coords, X);
    FacetGather_Private(level, &facets, f, before, box);
    PetscCall(HeightOfMap_Private(level->dim, facets.type[f], X, box, level->scene->bodies[body].map, &height[f]));
  }
  PetscCall(ExpressionCheck(level->comm, level->scene->bodies[body].map));
  PetscCall(SagittasAppend_Private(level, &facets, height, sagittas));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The mean height of the arcs over a facet of first order. [in] N - unit normals at nodes */
static PetscReal HeightOfArcs_Private(PetscInt dim, ElementType type, const PetscReal X[], const PetscReal N[])
{
  PetscReal      xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES], area = 0, height = 0;
  PetscReal      bulge[3 * F];
  const PetscInt num = QuadratureRule(type, 2 * 2, xi, w);

  if (!ArcBulge(type, X, N, NULL, bulge)) return 0;
  for (PetscInt q = 0; q < num; q++) {
    PetscReal       n[3];
    const PetscReal part = w[q] * ElementSurface(type, X, &xi[q * (dim - 1)], NULL, phi, n);

    height += part * ArcHeight(type, bulge, &xi[q * (dim - 1)], n);
    area += part;
  }
  return height / area;
}

/* The same over one of second order: the distance of arcs over the halves of its edges from its own
   parabolas. */
static PetscReal HeightOfHalves_Private(PetscInt dim, ElementType type, const PetscReal X[], const PetscReal N[])
{
  const PetscInt num = ElementNumNodes(ElementLinear(type));
  PetscReal      sum = 0;

  for (PetscInt e = 0; e < ElementNumEdges(type); e++) {
    const PetscInt middle = num + e;

    for (PetscInt i = 0; i < 2; i++) {
      const PetscInt end = ElementEdgeNodes(type, e)[i], other = ElementEdgeNodes(type, e)[1 - i];
      PetscReal      offset[3], n[3];

      ArcOffset(dim, &X[end * dim], &N[end * dim], &X[middle * dim], &N[middle * dim], PETSC_FALSE, offset);
      for (PetscInt k = 0; k < dim; k++) {
        const PetscReal a = X[end * dim + k], m = X[middle * dim + k], b = X[other * dim + k];

        offset[k] += (a + m) / 2 - (3 * a + 6 * m - b) / 8; // the parabola at a quarter of the way
        n[k] = N[end * dim + k] + N[middle * dim + k];
      }
      sum += VectorDot(dim, offset, n) / PetscSqrtReal(VectorDot(dim, n, n));
    }
  }
  return MEAN_OF_QUARTER * sum / (2 * ElementNumEdges(type));
}

/* Facets with the curves of their nodal normals. Collective. [in,out] facets - taken over */
static PetscErrorCode SagittasAddArcs_Private(Level *level, Facets *facets, Sagittas *sagittas)
{
  const PetscInt dim = level->dim;
  SideShape      shape;
  PetscReal     *height, X[3 * F];

  PetscFunctionBeginUser;
  PetscCall(SideShapeCreate(level, facets, NULL, &shape));
  PetscCall(PetscMalloc1(facets->num, &height));
  for (PetscInt f = 0; f < facets->num; f++) {
    const ElementType type = facets->type[f];
    const PetscReal  *N    = &shape.normal[f * F * dim];

    FacetGather_Private(level, facets, f, level->coords, X);
    height[f] =
        ElementOrder(type) == 1 ? HeightOfArcs_Private(dim, type, X, N) : HeightOfHalves_Private(dim, type, X, N);
  }
  PetscCall(SideShapeDestroy(&shape));
  PetscCall(SagittasAppend_Private(level, facets, height, sagittas));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The facets of a body from a file whose curves are those of nodal normals. Collective.
   [out] any - whether the body has such facets */
static PetscErrorCode BodyGetArcs_Private(Level *level, PetscInt body, Facets *facets, PetscBool *any)
{
  const SceneBody *own = &level->scene->bodies[body];
  char            *round, *flat;

  PetscFunctionBeginUser;
  *any = (PetscBool)(!own->polygonal && (own->arcs || (own->straightened && own->order == 1)));
  if (!*any) PetscFunctionReturn(PETSC_SUCCESS);
  if (own->straightened) {
    PetscCall(LevelGetBoundary(level, body, facets));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(ArcSideNames(level->scene, body, &round, &flat));
  PetscCall(LevelGetFacets(level, level->scene, body, round, facets));
  PetscCall(PetscFree(round));
  PetscCall(PetscFree(flat));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SagittasCreate(Level *level, Sagittas *sagittas)
{
  const Scene      scene = level->scene;
  const PetscReal *kept  = level->unmapped;
  PetscBool        arcs;
  Facets           facets;

  PetscFunctionBeginUser;
  *sagittas = (Sagittas){.height = NULL};
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    PetscCall(BodyGetArcs_Private(level, b, &facets, &arcs));
    if (arcs) {
      PetscCall(SagittasAddArcs_Private(level, &facets, sagittas));
    } else if (scene->bodies[b].map) {
      PetscCall(LevelKeepUnmapped(level));
      PetscCall(SagittasAddMap_Private(level, b, level->unmapped, sagittas));
    }
  }
  if (!kept) PetscCall(PetscFree(level->unmapped)); // on finer levels it would count as curves of a file
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SagittasDestroy(Sagittas *sagittas)
{
  PetscFunctionBeginUser;
  PetscCall(FacetsDestroy(&sagittas->facets));
  PetscCall(PetscFree(sagittas->height));
  PetscFunctionReturn(PETSC_SUCCESS);
}
