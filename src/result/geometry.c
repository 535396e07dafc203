/* geometry.c -- the derivative of the potential with respect to the shape of the bodies.

   A polygon in place of a circle is another body, and its own stress does not show that. Where the
   surface moves outward by s, a free surface gains the energy density there, and a pressure pushes over
   another area. */
#include "result/geometry.h"
#include "base/compat.h"
#include "contact/pairpoints.h"
#include "refinement/sagitta.h"

enum { F = ELEMENT_MAX_FACET_NODES, DENSITY_DEGREE = 2 };

/* The cells and the values at their nodes. */
typedef struct {
  const Level      *level;
  Compliance       *compliance;
  Sagittas          sagittas;
  NodalStressArrays stress;
  PetscReal        *change; /* int_e W s [sagittas.facets.num] */
} Surface;

/* W at a point of a facet without what is pushed there, and along the facet the trace of the strain. [in]
   phi, n - at the point */
static PetscErrorCode SurfaceEvaluate_Private(const Surface *surface, PetscInt f, const PetscReal phi[],
                                              const PetscReal x[], const PetscReal n[], PetscReal *density,
                                              PetscReal *trace)
{
  const PetscInt  *nodes = &surface->sagittas.facets.nodes[f * F], dim = surface->level->dim;
  const PetscInt   material            = surface->level->cell_material[surface->sagittas.facets.cell[f]];
  const PetscReal  unit[CELL_STRESSES] = {1, 1, 1};
  PetscReal        s[CELL_STRESSES] = {0}, dyad[CELL_STRESSES], along, normal = 0;
  const PetscReal *L;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < ElementNumNodes(surface->sagittas.facets.type[f]); i++) {
    for (PetscInt k = 0; k < CELL_STRESSES; k++)
      s[k] += phi[i] * PetscRealPart(NodalStressAt(&surface->stress, nodes[i], material)[k]);
  }
  PetscCall(ComplianceGet(surface->compliance, material, x, &L));
  ComplianceDyad(dim, n, dyad);
  for (PetscInt k = 0; k < CELL_STRESSES; k++) normal += (k < 3 ? 1 : 2) * dyad[k] * s[k];
  along    = ComplianceProduct(surface->compliance, L, s, dyad);
  *density = ComplianceEnergy(surface->compliance, L, s) / 2 - normal * along;
  *trace   = ComplianceProduct(surface->compliance, L, s, unit) - along;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds int_e W s of a facet, or of a pressure the part with q. [in] pressure - [1], or NULL */
static PetscErrorCode SurfaceAddFacet_Private(const Surface *surface, PetscInt f, Expression pressure)
{
  const Level      *level = surface->level;
  const ElementType type  = surface->sagittas.facets.type[f];
  PetscReal         xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES], X[3 * F];
  const PetscInt    num = QuadratureRule(type, DENSITY_DEGREE, xi, w), dim = level->dim;

  PetscFunctionBeginUser;
  ContactFacetCoordinates(level, &surface->sagittas.facets, f, X);
  for (PetscInt q = 0; q < num; q++) {
    PetscReal x[3], n[3], density = 0, trace = 0, part, given;

    part = w[q] * ElementSurface(type, X, &xi[q * (dim - 1)], x, phi, n) * surface->sagittas.height[f];
    PetscCall(SurfaceEvaluate_Private(surface, f, phi, x, n, &density, &trace));
    if (pressure) {
      PetscCall(ExpressionEvaluate(pressure, dim, x, &given));
      density = given * trace;
    }
    surface->change[f] += part * density * SceneMeasure(level->scene, x);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The part of a pressure on a side. Collective. [in] first, next - chains of facets of cells [num_cells],
   [facets.num] */
static PetscErrorCode SurfaceAddPressure_Private(const Surface *surface, PetscInt body, const SceneBoundary *boundary,
                                                 const PetscInt first[], const PetscInt next[])
{
  Level   *level = (Level *)surface->level;
  Facets   given;
  PetscInt num = 0;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, level->scene, body, boundary->side, &given));
  for (PetscInt g = 0; g < given.num; g++) {
    num = ElementNumNodes(given.type[g]);
    for (PetscInt f = first[given.cell[g]]; f >= 0; f = next[f]) {
      PetscInt i = 0;

      while (i < num && surface->sagittas.facets.nodes[f * F + i] == given.nodes[g * F + i]) i++;
      if (i == num) PetscCall(SurfaceAddFacet_Private(surface, f, boundary->value));
    }
  }
  PetscCall(FacetsDestroy(&given));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All pressures. Collective. */
static PetscErrorCode SurfaceAddPressures_Private(const Surface *surface)
{
  const Scene scene = surface->level->scene;
  PetscInt   *first, *next;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(surface->level->num_cells, &first, surface->sagittas.facets.num, &next));
  for (PetscInt c = 0; c < surface->level->num_cells; c++) first[c] = -1;
  for (PetscInt f = 0; f < surface->sagittas.facets.num; f++) {
    next[f]                                 = first[surface->sagittas.facets.cell[f]];
    first[surface->sagittas.facets.cell[f]] = f;
  }
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    for (PetscInt i = 0; i < scene->bodies[b].num_boundaries; i++) {
      if (scene->bodies[b].boundaries[i].kind == BOUNDARY_PRESSURE)
        PetscCall(SurfaceAddPressure_Private(surface, b, &scene->bodies[b].boundaries[i], first, next));
    }
  }
  PetscCall(PetscFree2(first, next));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GeometryAdd(Fields fields, Compliance *compliance, PetscReal cell[], PetscReal *total, PetscReal *signs)
{
  Surface  surface = {.level = fields->vi->level, .compliance = compliance};
  PetscInt num;

  PetscFunctionBeginUser;
  *total = 0;
  PetscCall(SagittasCreate(fields->vi->level, &surface.sagittas));
  num = surface.sagittas.facets.num;
  PetscCall(PetscCalloc1(num, &surface.change));
  PetscCall(NodalStressGetArrays(&fields->stress, &surface.stress));
  for (PetscInt f = 0; f < num; f++) PetscCall(SurfaceAddFacet_Private(&surface, f, NULL));
  PetscCall(SurfaceAddPressures_Private(&surface));
  PetscCall(NodalStressRestoreArrays(&fields->stress, &surface.stress));
  for (PetscInt f = 0; f < num; f++) {
    const PetscReal squared = 2 * PetscAbsReal(surface.change[f]);

    cell[surface.sagittas.facets.cell[f]] += squared;
    *total += squared;
    *signs -= 2 * surface.change[f];
  }
  PetscCall(PetscFree(surface.change));
  PetscCall(SagittasDestroy(&surface.sagittas));
  PetscFunctionReturn(PETSC_SUCCESS);
}
