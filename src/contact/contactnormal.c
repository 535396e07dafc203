/* contactnormal.c -- the direction of contact at nodes of the nonmortar side.

   To first order, the distance of a point from a surface changes along the normal of that surface, not of the point's own body. Rows
   along a round body's own normals fan out and hold it sideways, as a notch would. So the partner's normal and curvature are
   looked up at its nearest point, and the two bodies share the direction by their curvatures; then once more where this direction
   meets the partner. */
#include <mortise/closest.h>
#include <mortise/compat.h>
#include <mortise/frame.h>
#include <mortise/obstacle.h>
#include "integrals.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* Surfaces face each other when the cosine of their normals is below this. */
static const PetscReal FACING = -0.3;
/* A line that passes a facet by this share of it meets it: it may pass between two. */
static const PetscReal ON_LINE = 1e-9;

/* How often a direction is followed to the partner: a step leaves a share of the gap over the radius. */
enum { LINE_STEPS = 3 };

static PetscReal Dot_Private(PetscInt dim, const PetscReal a[], const PetscReal b[])
{
  PetscReal sum = 0;

  for (PetscInt k = 0; k < dim; k++) sum += a[k] * b[k];
  return sum;
}

/* Squared distance of a point from a facet's box. */
static PetscReal BoxDistance_Private(PetscInt dim, ElementType type, const PetscReal X[], const PetscReal x[])
{
  PetscReal box[6], square = 0;

  FacetBox(dim, type, X, box);
  for (PetscInt k = 0; k < dim; k++) square += PetscSqr(PetscMax(0, PetscMax(box[k] - x[k], x[k] - box[dim + k])));
  return square;
}

/* Normal and curvature of a mortar facet at a point of its reference cell. */
static void MortarShape_Private(const MortarSurface *mortar, PetscInt dim, PetscInt f, const PetscReal eta[],
                                SurfacePoint *at)
{
  const PetscInt num = ElementNumNodes(mortar->type[f]);
  PetscReal      phi[ELEMENT_MAX_NODES], S[9];

  ElementShape(mortar->type[f], eta, phi, NULL);
  *at = (SurfacePoint){.normal = {0}};
  for (PetscInt i = 0; i < num * dim; i++) at->normal[i % dim] += phi[i / dim] * mortar->normals[f * F * dim + i];
  FrameNormalize(dim, at->normal);
  for (PetscInt i = 0; i < num; i++) {
    const PetscInt corner = f * F + i;

    CurvatureTransport(dim, &mortar->curvature[corner * dim * dim], &mortar->normals[corner * dim], at->normal, S);
    for (PetscInt k = 0; k < dim * dim; k++) at->curvature[k] += phi[i] * S[k];
  }
}

/* The shape of the mortar side where it is nearest to a point and faces it. Not collective. [in] n - normal at the point;
   [out] found - whether it does within reach */
static PetscErrorCode FindMortar_Private(const FacetPartner *partner, const PetscReal x[], const PetscReal n[],
                                         SurfacePoint *at, PetscBool *found)
{
  const MortarSurface *mortar = partner->mortar;
  const PetscInt       dim    = partner->dim;
  PetscReal            query[6], nearest = PetscSqr(partner->reach);
  PetscInt             num;
  const PetscInt      *hits;

  PetscFunctionBeginUser;
  *found = PETSC_FALSE;
  for (PetscInt k = 0; k < dim; k++) {
    query[k]       = x[k] - partner->reach;
    query[dim + k] = x[k] + partner->reach;
  }
  PetscCall(BoxTreeQuery(mortar->tree, query, &num, &hits));
  for (PetscInt h = 0; h < num; h++) {
    const PetscInt   f = hits[h];
    const PetscReal *X = &mortar->coords[f * F * dim];
    PetscReal        eta[2], square;
    SurfacePoint     here;

    if (BoxDistance_Private(dim, mortar->type[f], X, x) >= nearest) continue;
    square = FacetClosest(dim, mortar->type[f], X, x, eta);
    if (square >= nearest) continue;
    MortarShape_Private(mortar, dim, f, eta, &here);
    if (Dot_Private(dim, here.normal, n) >= FACING) continue;
    nearest = square;
    *at     = here;
    *found  = PETSC_TRUE;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The same where the line through a point along n meets the mortar side, if it does: unlike the nearest point of a concave side, that is
   one point. [in,out] at - unchanged where the line misses */
static PetscErrorCode FindAlong_Private(const FacetPartner *partner, const PetscReal x[], const PetscReal n[],
                                        SurfacePoint *at)
{
  const MortarSurface *mortar = partner->mortar;
  const PetscInt       dim    = partner->dim;
  PetscReal            query[6], nearest = PETSC_MAX_REAL;
  PetscInt             num;
  const PetscInt      *hits;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < dim; k++) { // as far as the reach along the line
    query[k]       = x[k] - PetscAbsReal(n[k]) * partner->reach;
    query[dim + k] = x[k] + PetscAbsReal(n[k]) * partner->reach;
  }
  PetscCall(BoxTreeQuery(mortar->tree, query, &num, &hits));
  for (PetscInt h = 0; h < num; h++) {
    const PetscInt   f = hits[h], nodes = ElementNumNodes(mortar->type[f]);
    const PetscReal *X = &mortar->coords[f * F * dim], size = FacetSize(dim, mortar->type[f], X);
    PetscReal        across[3 * F], origin[3] = {0, 0, 0}, eta[2], phi[ELEMENT_MAX_NODES], t = 0;
    SurfacePoint     here;

    for (PetscInt i = 0; i < nodes; i++) { // as seen along the line
      const PetscReal along = Dot_Private(dim, &X[i * dim], n) - Dot_Private(dim, x, n);
      for (PetscInt k = 0; k < dim; k++) across[i * dim + k] = X[i * dim + k] - x[k] - along * n[k];
    }
    if (BoxDistance_Private(dim, mortar->type[f], across, origin) > PetscSqr(ON_LINE * size)) continue;
    if (FacetClosest(dim, mortar->type[f], across, origin, eta) > PetscSqr(ON_LINE * size)) continue;
    MortarShape_Private(mortar, dim, f, eta, &here);
    if (Dot_Private(dim, here.normal, n) >= FACING) continue;
    ElementShape(mortar->type[f], eta, phi, NULL);
    for (PetscInt i = 0; i < nodes; i++) t += phi[i] * (Dot_Private(dim, &X[i * dim], n) - Dot_Private(dim, x, n));
    if (PetscAbsReal(t) >= nearest) continue;
    nearest = PetscAbsReal(t);
    *at     = here;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The direction at one node. [in] own - normal and curvature there; [in] size - of a facet there; [out] n - [dim] */
static PetscErrorCode Direction_Private(const FacetPartner *partner, const PetscReal x[], const SurfacePoint *own,
                                        PetscReal size, PetscReal n[])
{
  const PetscInt dim = partner->dim;
  SurfacePoint   other;
  PetscBool      found;

  PetscFunctionBeginUser;
  if (partner->mortar) {
    PetscCall(FindMortar_Private(partner, x, own->normal, &other, &found));
  } else {
    PetscCall(ObstacleShape(&partner->spec->obstacle, dim, x, size, &other, &found));
    if (found) found = (PetscBool)(Dot_Private(dim, other.normal, own->normal) < FACING);
  }
  if (!found) {
    PetscCall(PetscArraycpy(n, own->normal, dim));
  } else if (partner->spec->obstacle.kind == OBSTACLE_PLANE) {
    for (PetscInt k = 0; k < dim; k++) n[k] = -other.normal[k]; // exact however far the node moves
  } else {
    ContactDirection(dim, own, &other, n);
    for (PetscInt step = 0; step < LINE_STEPS && partner->mortar; step++) {
      PetscCall(FindAlong_Private(partner, x, n, &other));
      ContactDirection(dim, own, &other, n);
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Directions at the nodes of this rank's facets, each once. [in,out] na - own normals at local nodes, then directions, zero at nodes
   of no facet here */
static PetscErrorCode SetLocal_Private(Level *level, const FacetPartner *partner, const Facets *facets,
                                       const SideShape *shape, PetscScalar na[])
{
  const PetscInt dim = level->dim;
  PetscReal      X[3 * F];
  PetscBool     *done;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(level->num_nodes, &done));
  for (PetscInt f = 0; f < facets->num; f++) {
    PetscReal size;

    FacetCoordinates(level, facets, f, X);
    size = FacetSize(dim, facets->type[f], X);
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      const PetscInt node = facets->nodes[f * F + i], corner = f * F + i;
      SurfacePoint   own = {.normal = {0}};

      if (done[node]) continue;
      done[node] = PETSC_TRUE;
      for (PetscInt k = 0; k < dim; k++) own.normal[k] = PetscRealPart(na[node * dim + k]);
      for (PetscInt k = 0; k < dim * dim && shape->ridge[corner] == 0; k++)
        own.curvature[k] = shape->curvature[corner * dim * dim + k];
      PetscCall(Direction_Private(partner, &level->coords[node * dim], &own, size, &na[node * dim]));
    }
  }
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    for (PetscInt k = 0; k < dim && !done[i]; k++) na[i * dim + k] = 0;
  }
  PetscCall(PetscFree(done));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ContactNormalsSet(Level *level, const FacetPartner *partner, const Facets *facets,
                                 const SideShape *shape, Vec normals)
{
  PetscBool    curved;
  PetscScalar *na;
  Vec          local;

  PetscFunctionBeginUser;
  PetscCall(SideShapeIsCurved(level, facets, shape, &curved));
  if (!curved && partner->spec->obstacle.kind != OBSTACLE_PLANE) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecGhostGetLocalForm(normals, &local));
  PetscCall(VecGetArray(local, &na));
  PetscCall(SetLocal_Private(level, partner, facets, shape, na));
  PetscCall(VecRestoreArray(local, &na));
  PetscCall(VecGhostRestoreLocalForm(normals, &local));
  PetscCall(NormalsShare(level, normals));
  PetscFunctionReturn(PETSC_SUCCESS);
}
