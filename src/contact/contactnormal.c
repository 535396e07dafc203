/* contactnormal.c -- the direction of contact at nodes of the nonmortar side.

   To first order, the distance of a point from a surface changes along that surface's normal, not along that
   of the point's own body. Rows along the own normals of a round body would resist its motion along the
   partner. So the direction is between the normals of both bodies, by their curvatures. */
#include "kernel/closest.h"
#include "base/compat.h"
#include "kernel/frame.h"
#include "contact/obstacle.h"
#include "contact/contactnormal.h"
#include "contact/nodalnormals.h"
#include "kernel/vector.h"
#include "level/ghosted.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* Largest cosine between the normals of a node and of a facet that gives it a direction. It is larger than
   FACING, so that directions do not change abruptly within a facet that is covered in part. */
static const PetscReal BESIDE = 0.5;
/* Factor of the part of a squared distance that is beyond the ends of a facet. */
static const PetscReal ASIDE = 100;
/* Parallel surfaces are taken up to this share of the way to a centre of curvature. */
static const PetscReal LEAST_SCALE = 0.1;
/* Points of a reference cell that differ by less are the same. */
static const PetscReal SAME_REFERENCE_PLACE = 1e-13;

/* Mortar facets that are nearly as near as the nearest one, to this part of a facet of the nonmortar side,
   meet a convex edge as well. */
static const PetscReal ALSO_NEAR = 0.1;
/* They are of another patch if their normals differ by 44 degrees; cosine. */
static const PetscReal OTHER_PATCH = 0.7193398003386512;
/* A direction between the normals of facets is as near to their mean as one of them; roundoff of cosines. */
static const PetscReal BETWEEN = 1e-6;

/* Cubes around a point grow by this factor. */
static const PetscReal CUBE_GROWTH = 4;

/* Largest number of steps along interpolated normals. Each reduces the error by the distance over the radius,
   down to roundoff of eta. */
enum { FOLLOW_STEPS = 40 };

/* Squared distance of a point from a facet's box. */
static PetscReal ContactNormalBoxDistance_Private(PetscInt dim, ElementType type, const PetscReal X[],
                                                  const PetscReal x[])
{
  PetscReal box[6], square = 0;

  ContactFacetBox(dim, type, X, box);
  for (PetscInt k = 0; k < dim; k++) square += PetscSqr(PetscMax(0, PetscMax(box[k] - x[k], x[k] - box[dim + k])));
  return square;
}

/* Normal and curvature of a mortar facet at a point of its reference cell. */
static void ContactNormalMortarShape_Private(const MortarSurface *mortar, PetscInt dim, PetscInt f,
                                             const PetscReal eta[], SurfacePoint *at)
{
  const PetscInt num = ElementNumNodes(mortar->type[f]);
  PetscReal      phi[ELEMENT_MAX_NODES], S[9];

  ElementShape(mortar->type[f], eta, phi, NULL);
  *at = (SurfacePoint){.normal = {0}};
  for (PetscInt i = 0; i < num * dim; i++) at->normal[i % dim] += phi[i / dim] * mortar->normals[f * F * dim + i];
  FrameNormalize(dim, at->normal);
  for (PetscInt i = 0; i < num; i++) {
    const PetscInt corner = f * F + i;

    DirectionTransportCurvature(dim, &mortar->curvature[corner * dim * dim], &mortar->normals[corner * dim], at->normal,
                                S);
    for (PetscInt k = 0; k < dim * dim; k++) at->curvature[k] += phi[i] * S[k];
  }
}

/* The point of a facet whose interpolated normal passes through x. On circles and balls the line from there
   to x passes through the centre, for facets of any length. Returns the squared distance, enlarged where the
   facet ends before that point.
   [in,out] eta - begins at the nearest point */
static PetscReal ContactNormalFollowNormal_Private(const MortarSurface *mortar, PetscInt dim, PetscInt f,
                                                   const PetscReal x[], PetscReal eta[], SurfacePoint *at)
{
  const PetscReal  *X    = &mortar->coords[f * F * dim];
  const ElementType type = mortar->type[f];
  PetscReal         phi[ELEMENT_MAX_NODES], away[3], y[3], before[2], along = 0, square = 0, change = 1;

  for (PetscInt step = 0; step <= FOLLOW_STEPS; step++) {
    ContactNormalMortarShape_Private(mortar, dim, f, eta, at);
    ElementShape(type, eta, phi, NULL);
    for (PetscInt k = 0; k < dim; k++) away[k] = -x[k];
    for (PetscInt i = 0; i < ElementNumNodes(type) * dim; i++) away[i % dim] += phi[i / dim] * X[i];
    along  = VectorDot(dim, away, at->normal);
    square = VectorDot(dim, away, away);
    if (step == FOLLOW_STEPS || change <= SAME_REFERENCE_PLACE) break;
    for (PetscInt k = 0; k < dim; k++) y[k] = x[k] + along * at->normal[k];
    for (PetscInt k = 0; k < dim - 1; k++) before[k] = eta[k];
    (void)ClosestPointOnFacet(dim, type, X, y, eta);
    change = 0;
    for (PetscInt k = 0; k < dim - 1; k++) change = PetscMax(change, PetscAbsReal(eta[k] - before[k]));
  }
  return square + ASIDE * PetscMax(0, square - along * along);
}

/* Height of x above the smooth surface through a facet's nodes, along the normal at the foot point. The
   surface is above the facet by 1/2 sum phi_i d_i.S d_i, with d_i from the foot point to the nodes. */
static PetscReal ContactNormalHeightOver_Private(const MortarSurface *mortar, PetscInt dim, PetscInt f,
                                                 const PetscReal x[], const PetscReal eta[], const SurfacePoint *at)
{
  const PetscReal *X   = &mortar->coords[f * F * dim];
  const PetscInt   num = ElementNumNodes(mortar->type[f]);
  PetscReal        phi[ELEMENT_MAX_NODES], y[3] = {0}, height = 0;

  ElementShape(mortar->type[f], eta, phi, NULL);
  for (PetscInt i = 0; i < num * dim; i++) y[i % dim] += phi[i / dim] * X[i];
  for (PetscInt k = 0; k < dim; k++) height += (x[k] - y[k]) * at->normal[k];
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt k = 0; k < dim * dim; k++)
      height -=
          0.5 * phi[i] * (X[i * dim + k / dim] - y[k / dim]) * at->curvature[k] * (X[i * dim + k % dim] - y[k % dim]);
  }
  return height;
}

/* The curvature of the parallel surface at a height: S (1 + height S)^-1 in the tangent plane. */
static void ContactNormalToParallel_Private(PetscInt dim, PetscReal height, SurfacePoint *at)
{
  PetscReal trace = 0, square = 0, product, scale;

  for (PetscInt k = 0; k < dim * dim; k++) {
    if (k / dim == k % dim) trace += at->curvature[k];
    square += at->curvature[k] * at->curvature[k % dim * dim + k / dim];
  }
  product = dim == 3 ? 0.5 * (trace * trace - square) : 0;
  scale   = 1 + height * trace + height * height * product;
  if (!(scale > LEAST_SCALE)) return; // beyond a centre of curvature, or nearly
  for (PetscInt k = 0; k < dim * dim; k++) {
    const PetscReal across = (k / dim == k % dim ? 1. : 0.) - at->normal[k / dim] * at->normal[k % dim];

    at->curvature[k] = (at->curvature[k] + height * product * across) / scale;
  }
}

/* Finds the mortar facets whose boxes meet a cube around a point. Not collective.
   [in] radius - of the cube; [out] hits - borrowed until the next query [num] */
static PetscErrorCode ContactNormalQueryCube_Private(const FacetPartner *partner, const PetscReal x[], PetscReal radius,
                                                     PetscInt *num, const PetscInt **hits)
{
  const PetscInt dim = partner->dim;
  PetscReal      cube[6];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < dim; k++) {
    cube[k]       = x[k] - radius;
    cube[dim + k] = x[k] + radius;
  }
  PetscCall(BoxTreeQuery(partner->mortar->tree, cube, num, hits));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The mortar facet next to a point, and its shape there. */
typedef struct {
  PetscInt     facet;   /* -1 where there is none */
  PetscBool    faces;   /* whether it faces the point */
  PetscReal    nearest; /* squared distance, enlarged */
  PetscReal    eta[2];
  SurfacePoint at;
} FacetBelow;

/* Finds the nearest facet among those whose boxes meet a cube around the point. Facets that face the point
   are preferred. Not collective. [in] n - normal at the point; [in] radius - of the cube */
static PetscErrorCode ContactNormalSearchCube_Private(const FacetPartner *partner, const PetscReal x[],
                                                      const PetscReal n[], PetscReal radius, FacetBelow *below)
{
  const MortarSurface *mortar = partner->mortar;
  const PetscInt       dim    = partner->dim;
  PetscInt             num;
  const PetscInt      *hits;

  PetscFunctionBeginUser;
  *below = (FacetBelow){.facet = -1, .nearest = PetscSqr(partner->reach)};
  PetscCall(ContactNormalQueryCube_Private(partner, x, radius, &num, &hits));
  for (PetscInt h = 0; h < num; h++) {
    const PetscInt   f       = hits[h];
    const PetscReal *X       = &mortar->coords[f * F * dim];
    const PetscReal  nearest = below->nearest;
    PetscReal        eta[2]  = {0}, square, cosine;
    SurfacePoint     here;
    PetscBool        better;

    if (below->faces && ContactNormalBoxDistance_Private(dim, mortar->type[f], X, x) >= nearest) continue;
    if (ClosestPointOnFacet(dim, mortar->type[f], X, x, eta) >= (below->faces ? nearest : PetscSqr(partner->reach)))
      continue;
    square = ContactNormalFollowNormal_Private(mortar, dim, f, x, eta, &here);
    cosine = VectorDot(dim, here.normal, n);
    better = (PetscBool)(square < nearest || below->facet < 0 || (cosine < FACING && !below->faces));
    if (cosine >= BESIDE || (cosine >= FACING && below->faces) || !better) continue;
    *below = (FacetBelow){f, (PetscBool)(cosine < FACING), square, {eta[0], eta[1]}, here};
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Finds the mortar facet next to a point. Cubes grow until they contain all nearer facets. Not collective.
   [in] n - normal at the point; [in] size - of a facet there */
static PetscErrorCode ContactNormalFindBelow_Private(const FacetPartner *partner, const PetscReal x[],
                                                     const PetscReal n[], PetscReal size, FacetBelow *below)
{
  PetscReal radius = PetscMin(size, partner->reach);

  PetscFunctionBeginUser;
  PetscCall(ContactNormalSearchCube_Private(partner, x, n, radius, below));
  while (radius < partner->reach && !(below->faces && below->nearest <= PetscSqr(radius))) {
    radius = PetscMin(CUBE_GROWTH * radius, partner->reach);
    PetscCall(ContactNormalSearchCube_Private(partner, x, n, radius, below));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether mortar facets of another patch are as near to a point as the one below it. Not collective. */
static PetscErrorCode ContactNormalAreSeveral_Private(const FacetPartner *partner, const PetscReal x[], PetscReal size,
                                                      const FacetBelow *below, PetscBool *several)
{
  const PetscInt  dim    = partner->dim;
  const PetscReal radius = PetscSqrtReal(below->nearest) + ALSO_NEAR * size;
  PetscInt        num;
  const PetscInt *hits;

  PetscFunctionBeginUser;
  *several = PETSC_FALSE;
  PetscCall(ContactNormalQueryCube_Private(partner, x, radius, &num, &hits));
  for (PetscInt h = 0; h < num && !*several; h++) {
    const ElementType type   = partner->mortar->type[hits[h]];
    PetscReal         eta[2] = {0};
    SurfacePoint      here;

    if (ClosestPointOnFacet(dim, type, &partner->mortar->coords[hits[h] * F * dim], x, eta) > PetscSqr(radius))
      continue;
    ContactNormalMortarShape_Private(partner->mortar, dim, hits[h], eta, &here);
    *several = (PetscBool)(VectorDot(dim, here.normal, below->at.normal) < OTHER_PATCH);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The shape of the mortar side next to a point, as that of the parallel surface through it. Centres of
   circles and balls stay the same. Not collective.
   [in] n - normal at the point; [in] size - of a facet there; [out] found - whether there are facets within
   reach; several - whether they are of several patches */
static PetscErrorCode ContactNormalFindMortar_Private(const FacetPartner *partner, const PetscReal x[],
                                                      const PetscReal n[], PetscReal size, SurfacePoint *at,
                                                      PetscBool *found, PetscBool *several)
{
  const PetscInt dim = partner->dim;
  FacetBelow     below;

  PetscFunctionBeginUser;
  PetscCall(ContactNormalFindBelow_Private(partner, x, n, size, &below));
  *found   = (PetscBool)(below.facet >= 0);
  *several = PETSC_FALSE;
  *at      = below.at;
  if (*found && partner->mortar->edged) PetscCall(ContactNormalAreSeveral_Private(partner, x, size, &below, several));
  if (*found)
    ContactNormalToParallel_Private(
        dim, ContactNormalHeightOver_Private(partner->mortar, dim, below.facet, x, below.eta, at), at);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A point of a convex edge touches a smooth surface along the normal of the surface, as long as that is
   between the normals at the edge. Not collective.
   [in] spread - one less the cosine of the mean normal n and the farthest normal at the edge; [in,out] n -
   mean normal, then the direction [dim] */
static PetscErrorCode ContactNormalAtEdge_Private(const FacetPartner *partner, const PetscReal x[], PetscReal size,
                                                  PetscReal spread, PetscScalar n[])
{
  const PetscInt dim     = partner->dim;
  PetscBool      several = PETSC_TRUE;
  FacetBelow     below;

  PetscFunctionBeginUser;
  PetscCall(ContactNormalFindBelow_Private(partner, x, n, size, &below));
  if (below.facet >= 0 && 1 + VectorDot(dim, below.at.normal, n) <= spread + BETWEEN)
    PetscCall(ContactNormalAreSeveral_Private(partner, x, size, &below, &several));
  for (PetscInt k = 0; k < dim && !several; k++) n[k] = -below.at.normal[k];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Kinds of nodes: at no edge, at convex edges alone, at others. */
enum { AT_NONE, AT_CONVEX, AT_OTHER };
/* What the facets around a node are, the largest of each: the same on all ranks that have the node. */
enum {
  NODE_KIND,
  NODE_SPREAD, /* one less the cosine between the normals of a facet and of the node */
  NODE_SIZE,   /* longest edge */
  NODE_COUNT
};

/* Collective. [in] own - ghosted; [out] nodes - ghosted, NODE_COUNT per node, owned by the caller */
static PetscErrorCode ContactNormalDescribeNodes_Private(Level *level, const Facets *facets, const SideShape *shape,
                                                         Vec own, Vec *nodes)
{
  const PetscInt     dim = level->dim;
  const PetscScalar *oa;
  PetscScalar       *ea;
  PetscReal          X[3 * F];

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, NODE_COUNT, nodes));
  PetscCall(GhostedGetArrayRead(own, &oa));
  PetscCall(GhostedGetArray(*nodes, &ea));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt num      = ElementNumNodes(facets->type[f]);
    PetscReal      N[3 * F] = {0}, size;

    ContactFacetCoordinates(level, facets, f, X);
    size = ElementLongestEdge(facets->type[f], dim, X);
    FrameAddFacetNormal(dim, num, X, N);
    for (PetscInt i = 0; i < num; i++) {
      const PetscInt  node  = facets->nodes[f * F + i];
      const PetscReal ridge = shape->ridge[f * F + i];
      PetscScalar    *e     = &ea[node * NODE_COUNT];

      FrameNormalize(dim, &N[i * dim]);
      e[NODE_KIND]   = PetscMax(PetscRealPart(e[NODE_KIND]), ridge == 0 ? AT_NONE : ridge > 0 ? AT_CONVEX : AT_OTHER);
      e[NODE_SPREAD] = PetscMax(PetscRealPart(e[NODE_SPREAD]), 1 - VectorDot(dim, &N[i * dim], &oa[node * dim]));
      e[NODE_SIZE]   = PetscMax(PetscRealPart(e[NODE_SIZE]), size);
    }
  }
  PetscCall(GhostedRestoreArray(*nodes, &ea));
  PetscCall(GhostedRestoreArrayRead(own, &oa));
  PetscCall(LevelShareVec(*nodes, MAX_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The direction at one node. A convex edge of the mortar side touches along the own normal: which of its two
   patches is nearer would be decided by roundoff.
   [in] own - normal and curvature there; [in] size - of a facet there; [out] n - zero where there is no
   partner [dim] */
static PetscErrorCode ContactNormalFind_Private(const FacetPartner *partner, const PetscReal x[],
                                                const SurfacePoint *own, PetscReal size, PetscReal n[])
{
  const PetscInt dim = partner->dim;
  SurfacePoint   other;
  PetscBool      found, several = PETSC_FALSE;

  PetscFunctionBeginUser;
  if (partner->mortar) {
    PetscCall(ContactNormalFindMortar_Private(partner, x, own->normal, size, &other, &found, &several));
  } else {
    PetscCall(ObstacleShape(&partner->spec->obstacle, dim, x, own, size, &other, &found));
    if (found && partner->spec->obstacle.kind != OBSTACLE_PLANE) // a plane has one normal, also for nodes beside it
      found = (PetscBool)(VectorDot(dim, other.normal, own->normal) < BESIDE);
  }
  if (!found) {
    PetscCall(PetscArrayzero(n, dim));
  } else if (several) {
    PetscCall(PetscArraycpy(n, own->normal, dim));
  } else if (partner->spec->obstacle.kind == OBSTACLE_PLANE) {
    for (PetscInt k = 0; k < dim; k++) n[k] = -other.normal[k]; // exact for any motion of the node
  } else {
    DirectionOfContact(dim, own, &other, n);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Directions at the nodes of this rank's facets, each once.
   [in] nodes - of ContactNormalDescribeNodes_Private(); [in] curved - whether nodes at no edge need a
   direction; [in,out] na - own normals at local nodes, then directions, zero at nodes of no facet here and,
   on curved sides, at those without a partner */
static PetscErrorCode ContactNormalSetLocal_Private(Level *level, const FacetPartner *partner, const Facets *facets,
                                                    const SideShape *shape, const PetscScalar nodes[], PetscBool curved,
                                                    PetscScalar na[])
{
  const PetscInt  dim  = level->dim;
  const PetscBool edge = (PetscBool)(partner->mortar && partner->spec->type == PAIR_CONTACT);
  PetscBool      *done;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(level->num_nodes, &done));
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      const PetscInt     node = facets->nodes[f * F + i], corner = f * F + i;
      const PetscScalar *at   = &nodes[node * NODE_COUNT];
      const PetscReal    size = PetscRealPart(at[NODE_SIZE]), spread = PetscRealPart(at[NODE_SPREAD]);
      SurfacePoint       own = {.normal = {0}};

      if (done[node]) continue;
      done[node] = PETSC_TRUE;
      if (edge && PetscRealPart(at[NODE_KIND]) == AT_CONVEX)
        PetscCall(ContactNormalAtEdge_Private(partner, &level->coords[node * dim], size, spread, &na[node * dim]));
      if (!curved) continue;
      for (PetscInt k = 0; k < dim; k++) own.normal[k] = PetscRealPart(na[node * dim + k]);
      for (PetscInt k = 0; k < dim * dim && shape->ridge[corner] == 0; k++)
        own.curvature[k] = shape->curvature[corner * dim * dim + k];
      PetscCall(ContactNormalFind_Private(partner, &level->coords[node * dim], &own, size, &na[node * dim]));
    }
  }
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    for (PetscInt k = 0; k < dim && !done[i]; k++) na[i * dim + k] = 0;
  }
  PetscCall(PetscFree(done));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets directions at nodes that face no partner within reach. They are means over the other nodes of their
   facets, so that directions change little within a facet; without such nodes, their own normals. Collective.
   [in] own - ghosted; [in,out] normals - directions, zero where there is none */
static PetscErrorCode ContactNormalSetBeyond_Private(Level *level, const Facets *facets, Vec own, Vec normals)
{
  const PetscInt     dim = level->dim;
  Vec                beside, local[3];
  const PetscScalar *oa;
  PetscScalar       *na, *ba;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(normals, &beside));
  PetscCall(VecGhostGetLocalForm(own, &local[0]));
  PetscCall(VecGhostGetLocalForm(normals, &local[1]));
  PetscCall(VecGhostGetLocalForm(beside, &local[2]));
  PetscCall(VecZeroEntries(local[2]));
  PetscCall(VecGetArrayRead(local[0], &oa));
  PetscCall(VecGetArray(local[1], &na));
  PetscCall(VecGetArray(local[2], &ba));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt *nodes = &facets->nodes[f * F], num = ElementNumNodes(facets->type[f]);

    for (PetscInt i = 0; i < num * num; i++) {
      for (PetscInt k = 0; k < dim; k++) ba[nodes[i / num] * dim + k] += na[nodes[i % num] * dim + k];
    }
  }
  PetscCall(VecRestoreArray(local[2], &ba));
  PetscCall(NodalNormalsShare(level, beside));
  PetscCall(VecGetArray(local[2], &ba));
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    const PetscScalar *o = &oa[i * dim], *b = &ba[i * dim];
    PetscScalar       *n = &na[i * dim];

    if (VectorDot(dim, n, n) == 0)
      PetscCall(PetscArraycpy(n, VectorDot(dim, b, b) > 0 && VectorDot(dim, b, o) > -BESIDE ? b : o, dim));
  }
  PetscCall(VecRestoreArray(local[2], &ba));
  PetscCall(VecRestoreArray(local[1], &na));
  PetscCall(VecRestoreArrayRead(local[0], &oa));
  PetscCall(VecGhostRestoreLocalForm(beside, &local[2]));
  PetscCall(VecGhostRestoreLocalForm(normals, &local[1]));
  PetscCall(VecGhostRestoreLocalForm(own, &local[0]));
  PetscCall(VecDestroy(&beside));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ContactNormalHasEdge(const Level *level, const SideShape *shape, PetscBool *edge)
{
  PetscFunctionBeginUser;
  *edge = PETSC_FALSE;
  for (PetscInt c = 0; c < shape->num * F; c++) *edge = (PetscBool)(*edge || shape->ridge[c] > 0);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, edge, 1, MPIU_BOOL, MPI_LOR, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ContactNormalSet(Level *level, const FacetPartner *partner, const Facets *facets, const SideShape *shape,
                                Vec normals)
{
  PetscBool          curved, edge = PETSC_FALSE;
  PetscScalar       *na;
  const PetscScalar *ea;
  Vec                local, own, own_local, nodes, nodes_local;

  PetscFunctionBeginUser;
  PetscCall(SideShapeIsCurved(level, facets, shape, &curved));
  curved = (PetscBool)(curved || partner->spec->obstacle.kind == OBSTACLE_PLANE);
  if (partner->mortar && partner->spec->type == PAIR_CONTACT) PetscCall(ContactNormalHasEdge(level, shape, &edge));
  if (!curved && !edge) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecDuplicate(normals, &own));
  PetscCall(VecGhostGetLocalForm(normals, &local));
  PetscCall(VecGhostGetLocalForm(own, &own_local));
  PetscCall(VecCopy(local, own_local));
  PetscCall(VecGhostRestoreLocalForm(own, &own_local));
  PetscCall(ContactNormalDescribeNodes_Private(level, facets, shape, own, &nodes));
  PetscCall(VecGhostGetLocalForm(nodes, &nodes_local));
  PetscCall(VecGetArrayRead(nodes_local, &ea));
  PetscCall(VecGetArray(local, &na));
  PetscCall(ContactNormalSetLocal_Private(level, partner, facets, shape, ea, curved, na));
  PetscCall(VecRestoreArray(local, &na));
  PetscCall(VecRestoreArrayRead(nodes_local, &ea));
  PetscCall(VecGhostRestoreLocalForm(nodes, &nodes_local));
  PetscCall(VecDestroy(&nodes));
  PetscCall(VecGhostRestoreLocalForm(normals, &local));
  PetscCall(NodalNormalsShare(level, normals));
  if (curved) PetscCall(ContactNormalSetBeyond_Private(level, facets, own, normals));
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(PETSC_SUCCESS);
}
