/* loads.c -- body forces, tractions and pressures as nodal loads.

   Plain numbers are integrated exactly; expressions with LoadDegree_Private(), so that the error of a load is of higher
   order than that of the discretisation. Sums over facets and cells are taken where they are held, then shared. */
#include <mortise/compat.h>
#include "cellforce.h"
#include "loads.h"

/* The degree of a constant body force: shape functions of order p times det J of degree dim p - 1 in each coordinate. */
static PetscInt ConstantDegree_Private(PetscInt dim, PetscInt order)
{
  return (dim + 1) * order - 1;
}

/* Leaves an error of order h^6 in the work of a smooth load for order 1, h^8 for order 2. */
static PetscInt LoadDegree_Private(PetscInt order)
{
  return 2 * order + 3;
}

/* On a facet, exact to degree 6 on flat ones. The measure of a curved one is not a polynomial, so that even constants are
   exact only to within (the angle it turns by)^12. */
static PetscInt FacetDegree_Private(PetscInt order)
{
  return 4 * order + 3;
}

/* Adds a body's force per volume on this rank's cells. [in,out] fa - [num_nodes][dim] */
static PetscErrorCode AddBodyForce_Private(Scene scene, Level *level, PetscInt body, PetscScalar fa[])
{
  const Expression force    = scene->bodies[body].body_force;
  const PetscInt   dim      = level->dim;
  const PetscBool  constant = ExpressionIsConstant(force);
  PetscReal        fe[3 * ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementType type  = (ElementType)level->cell_type[c];
    const PetscInt   *nodes = &level->cell_nodes[level->cell_start[c]], nn = ElementNumNodes(type),
                   order = ElementOrder(type);
    const PetscInt degree =
        (constant ? ConstantDegree_Private(dim, order) : LoadDegree_Private(order)) + SceneMeasureDegree(scene, order);
    if (level->cell_body[c] != body) continue;
    PetscCall(CellForceIntegrate(scene, level, c, degree, fe));
    for (PetscInt i = 0; i < nn; i++) {
      for (PetscInt k = 0; k < dim; k++) fa[nodes[i] * dim + k] += fe[i * dim + k];
    }
  }
  PetscCall(ExpressionCheck(level->comm, force));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Force per area of one boundary datum at x, where nu is the outward unit normal. */
static PetscErrorCode BoundaryTraction_Private(const SceneBoundary *boundary, PetscInt dim, const PetscReal x[],
                                               const PetscReal nu[], PetscReal t[])
{
  PetscFunctionBeginUser;
  PetscCall(ExpressionEvaluate(boundary->value, dim, x, t));
  if (boundary->kind == BOUNDARY_PRESSURE) {
    const PetscReal p = t[0];
    for (PetscInt k = 0; k < dim; k++) t[k] = -p * nu[k];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds a traction or pressure on one side. [in,out] fa - [num_nodes][dim] */
static PetscErrorCode AddSideLoad_Private(Scene scene, Level *level, PetscInt body, const SceneBoundary *boundary,
                                          PetscScalar fa[])
{
  const PetscInt dim = level->dim;
  PetscReal      xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_FACET_NODES], x[3], nu[3], t[3];
  PetscReal      X[3 * ELEMENT_MAX_FACET_NODES];
  Facets         facets;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, scene, body, boundary->side, &facets));
  for (PetscInt f = 0; f < facets.num; f++) {
    const ElementType type  = facets.type[f];
    const PetscInt   *nodes = &facets.nodes[f * ELEMENT_MAX_FACET_NODES], nn = ElementNumNodes(type),
                   nq = ElementQuadrature(type, FacetDegree_Private(ElementOrder(type)), xi, w);
    for (PetscInt i = 0; i < nn; i++) PetscCall(PetscArraycpy(&X[i * dim], &level->coords[nodes[i] * dim], dim));
    for (PetscInt q = 0; q < nq; q++) {
      const PetscReal size = w[q] * ElementSurface(type, X, &xi[q * (dim - 1)], x, phi, nu),
                      wq   = size * SceneMeasure(scene, x);
      PetscCall(BoundaryTraction_Private(boundary, dim, x, nu, t));
      for (PetscInt i = 0; i < nn; i++) {
        for (PetscInt k = 0; k < dim; k++) fa[nodes[i] * dim + k] += wq * phi[i] * t[k];
      }
    }
  }
  PetscCall(FacetsDestroy(&facets));
  PetscCall(ExpressionCheck(level->comm, boundary->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LoadsAssemble(Scene scene, Level *level, Vec f)
{
  PetscScalar *fa;
  Vec          local;

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(f, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, &fa));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    const SceneBody *body = &scene->bodies[b];
    if (body->body_force) PetscCall(AddBodyForce_Private(scene, level, b, fa));
    for (PetscInt i = 0; i < body->num_boundaries; i++) {
      const BoundaryKind kind = body->boundaries[i].kind;
      if (kind != BOUNDARY_TRACTION && kind != BOUNDARY_PRESSURE) continue;
      PetscCall(AddSideLoad_Private(scene, level, b, &body->boundaries[i], fa));
    }
  }
  PetscCall(VecRestoreArray(local, &fa));
  PetscCall(VecGhostRestoreLocalForm(f, &local));
  PetscCall(LevelShareVec(f, ADD_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}
