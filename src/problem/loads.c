/* loads.c -- body forces, tractions and pressures as nodal loads.

   Plain numbers are integrated exactly with few points; expressions with LOAD_DEGREE, so that the error of a load is of
   higher order than that of the discretisation. Sums over facets and cells are taken where they are held, then shared. */
#include <mortise/compat.h>
#include "loads.h"

enum {
  CONSTANT_DEGREE = 2, /* shape functions times the Jacobian of a bilinear cell */
  LOAD_DEGREE     = 5, /* leaves an error of order h^6 in the work of a smooth load */
  FACET_POINTS    = 4
};

/* Adds a body's force per volume on this rank's cells. [in,out] fa - [num_nodes][dim] */
static PetscErrorCode AddBodyForce_Private(Scene scene, Level *level, PetscInt body, PetscScalar fa[])
{
  const Expression force  = scene->bodies[body].body_force;
  const PetscInt   dim    = level->dim;
  const PetscInt   degree = ExpressionIsConstant(force) ? CONSTANT_DEGREE : LOAD_DEGREE;
  PetscReal X[3 * ELEMENT_MAX_NODES], xi[3 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES], x[3],
      b[3];

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementType type  = (ElementType)level->cell_type[c];
    const PetscInt   *nodes = &level->cell_nodes[level->cell_start[c]], nn = ElementNumNodes(type);
    PetscInt          nq;
    if (level->cell_body[c] != body) continue;
    nq = ElementQuadrature(type, degree, xi, w);
    for (PetscInt i = 0; i < nn; i++) PetscCall(PetscArraycpy(&X[i * dim], &level->coords[nodes[i] * dim], dim));
    for (PetscInt q = 0; q < nq; q++) {
      const PetscReal wq = w[q] * ElementMap(type, X, &xi[q * dim], x, phi, NULL) * scene->thickness;
      PetscCall(ExpressionEvaluate(force, dim, x, b));
      for (PetscInt i = 0; i < nn; i++) {
        for (PetscInt k = 0; k < dim; k++) fa[nodes[i] * dim + k] += wq * phi[i] * b[k];
      }
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

/* Adds a traction or pressure on one side: line facets in 2D. [in,out] fa - [num_nodes][dim] */
static PetscErrorCode AddSideLoad_Private(Scene scene, Level *level, PetscInt body, const SceneBoundary *boundary,
                                          PetscScalar fa[])
{
  const PetscInt dim = level->dim;
  PetscReal      xi[ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES], x[3], nu[3] = {0, 0, 0}, t[3];
  Facets         facets;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, scene, body, boundary->side, &facets));
  GaussLine(FACET_POINTS, xi, w);
  for (PetscInt f = 0; f < facets.num; f++) {
    const PetscInt  *nodes = &facets.nodes[f * ELEMENT_MAX_FACET_NODES], nn = ElementNumNodes(facets.type[f]);
    const PetscReal *a = &level->coords[nodes[0] * dim], *b = &level->coords[nodes[1] * dim];
    const PetscReal  dx = b[0] - a[0], dy = b[1] - a[1], length = PetscSqrtReal(dx * dx + dy * dy);
    nu[0] = dy / length;
    nu[1] = -dx / length;
    for (PetscInt q = 0; q < FACET_POINTS; q++) {
      const PetscReal wq = w[q] * length * scene->thickness;
      ElementShape(facets.type[f], &xi[q], phi, NULL);
      for (PetscInt k = 0; k < dim; k++) x[k] = (1 - xi[q]) * a[k] + xi[q] * b[k];
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
