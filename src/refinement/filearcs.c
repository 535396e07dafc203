/* filearcs.c -- sides of files of second order whose curves are those of nodal normals (eq. 4.5).

   A parabola through three nodes of a circle leaves it elsewhere, and the next one begins at an angle to it.
   On finer levels contact pressures follow these angles. So where the file's middle nodes lie on the curves
   of the normals, refinement follows these curves. Elsewhere it follows the file's parabolas, which know more
   than the normals do. */
#include "side/normalerrors.h"
#include "base/compat.h"
#include "kernel/arc.h"
#include "kernel/vector.h"
#include "refinement/filearcs.h"
#include "refinement/refinementimpl.h"
#include "side/sidesums.h"

enum { F = ELEMENT_MAX_FACET_NODES };

static const char PARABOLAS[] = "parabolas";

PetscErrorCode FacetGetPoint(const Level *level, const PetscInt edges[], PetscInt *facet)
{
  const PetscInt *joined;
  PetscInt        num;

  PetscFunctionBeginUser;
  *facet = edges[0];
  if (level->dim == 2) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(DMPlexGetJoin(level->dm, 2, edges, &num, &joined));
  PetscCheck(num == 1, PETSC_COMM_SELF, PETSC_ERR_PLIB, "%" PetscInt_FMT " facets between two edges", num);
  *facet = joined[0];
  PetscCall(DMPlexRestoreJoin(level->dm, 2, edges, &num, &joined));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FacetsRaise(const Level *level, Facets *facets)
{
  PetscInt *point, edges[ELEMENT_MAX_NODES], facet;

  PetscFunctionBeginUser;
  PetscCall(LevelGetNodePoints(level, &point));
  for (PetscInt f = 0; f < facets->num; f++) {
    const ElementType linear = facets->type[f], type = ElementOfOrder(linear, 2);
    const PetscInt    num = ElementNumNodes(linear), num_edges = ElementNumEdges(linear);

    PetscCall(FacetGetEdges(level, point, facets, f, edges));
    PetscCall(FacetGetPoint(level, edges, &facet));
    for (PetscInt i = num; i < ElementNumNodes(type); i++)
      facets->nodes[f * F + i] = PointGetNode(level, i < num + num_edges ? edges[i - num] : facet);
    facets->type[f] = type;
  }
  PetscCall(PetscFree(point));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How far the middle node of an edge is from an arc with a rise along the offset. In the plane it may be
   elsewhere on the arc. [in] way - from the arc's middle */
static PetscReal MiddleDistance_Private(PetscInt dim, const PetscReal chord[], const PetscReal offset[],
                                        const PetscReal way[])
{
  const PetscReal rise = VectorNorm(dim, offset), square = VectorDot(dim, chord, chord);
  const PetscReal along = VectorDot(dim, way, chord);

  if (dim == 3 || !(rise > 0)) return VectorNorm(dim, way);
  return PetscAbsReal(VectorDot(dim, way, offset) / rise + 4 * rise * PetscSqr(along / square));
}

PetscBool FacetIsOnArcs(const Level *level, const Facets *facets, PetscInt f, const SideShape *shape, PetscBool edge[])
{
  const PetscInt    dim    = level->dim;
  const ElementType type   = facets->type[f];
  const PetscReal  *normal = &shape->normal[f * F * dim];
  PetscReal         X[3 * F], away[F], above = 0, allowed = 0;

  VectorGather(dim, ElementNumNodes(type), &facets->nodes[f * F], level->coords, X);
  for (PetscInt e = 0; e < ElementNumEdges(type); e++) {
    const PetscInt  *ends = ElementEdgeNodes(type, e), a = ends[0] * dim, b = ends[1] * dim;
    const PetscBool  smooth = (PetscBool)(shape->smooth[f * F + ends[0]] && shape->smooth[f * F + ends[1]]);
    const PetscReal *middle = &X[(ElementNumNodes(ElementLinear(type)) + e) * dim];
    PetscReal        offset[3], chord[3], way[3], turn[3], mean[3];

    ArcOffset(dim, &X[a], &normal[a], &X[b], &normal[b], smooth, offset);
    if (shape->quadric) (void)QuadricTakeArc(&shape->quadric[f], &X[a], &X[b], offset, NULL);
    for (PetscInt k = 0; k < dim; k++) {
      chord[k] = X[b + k] - X[a + k];
      way[k]   = middle[k] - (X[a + k] + X[b + k]) / 2 - offset[k];
      turn[k]  = (normal[b + k] - normal[a + k]) / 2;
      mean[k]  = (normal[b + k] + normal[a + k]) / 2;
    }
    away[e] = MiddleDistance_Private(dim, chord, offset, way);
    above   = PetscMax(above, dim == 2 ? away[e] : PetscAbsReal(VectorDot(dim, way, mean)));
    allowed = PetscMax(allowed, VectorNorm(dim, offset) * VectorDot(dim, turn, turn) / 2);
  }
  for (PetscInt e = 0; e < ElementNumEdges(type); e++)
    edge[e] = (PetscBool)(above <= allowed && away[e] <= allowed && allowed > 0);
  return (PetscBool)(above <= allowed && allowed > 0);
}

/* Finds the facets and edges on arcs. Collective.
   [out] on - facets [num]; at_node - not 0 in the middle of such edges [num][F]; any - on any rank */
static PetscErrorCode FacetsFindArcs_Private(Level *level, const ArcSides *sides, Level *mapped, PetscBool on[],
                                             PetscReal at_node[], PetscBool *any)
{
  const Facets *facets = &sides->round;
  SideShape     shape;
  SideSums      nodes;
  PetscBool     edge[F];

  PetscFunctionBeginUser;
  *any = PETSC_FALSE;
  PetscCall(SideShapeCreate(level, facets, &sides->flat, &shape));
  if (mapped) PetscCall(LevelAddNormalErrors(mapped, facets, &shape));
  for (PetscInt f = 0; f < facets->num; f++) {
    on[f] = FacetIsOnArcs(level, facets, f, &shape, edge);
    *any  = (PetscBool)(*any || on[f]);
    for (PetscInt e = 0; e < ElementNumEdges(facets->type[f]); e++)
      at_node[f * F + ElementNumNodes(ElementLinear(facets->type[f])) + e] = edge[e] ? 1 : 0;
  }
  PetscCall(SideShapeDestroy(&shape));
  PetscCall(SideSumsCreate(level, facets, &nodes));
  PetscCall(SideSumAtNodes(&nodes, 1, NULL, at_node));
  PetscCall(SideSumsDestroy(&nodes));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelMarkParabolas(Level *level, ArcSides *sides, Level *mapped, PetscBool *any)
{
  Facets    *facets = &sides->round;
  PetscInt  *point, edges[ELEMENT_MAX_NODES], facet;
  PetscBool *on;
  PetscReal *at_node;
  DMLabel    label;

  PetscFunctionBeginUser;
  PetscCall(FacetsRaise(level, facets));
  PetscCall(FacetsRaise(level, &sides->flat));
  PetscCall(PetscCalloc2(facets->num, &on, facets->num * F, &at_node));
  PetscCall(FacetsFindArcs_Private(level, sides, mapped, on, at_node, any));
  PetscCall(DMGetLabel(level->dm, PARABOLAS, &label));
  if (!label) PetscCall(DMCreateLabel(level->dm, PARABOLAS));
  PetscCall(DMGetLabel(level->dm, PARABOLAS, &label));
  PetscCall(LevelGetNodePoints(level, &point));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscReal *at_middle = &at_node[f * F + ElementNumNodes(ElementLinear(facets->type[f]))];

    PetscCall(FacetGetEdges(level, point, facets, f, edges));
    PetscCall(FacetGetPoint(level, edges, &facet));
    if (level->dim == 3 && !on[f]) PetscCall(DMLabelSetValue(label, facet, 1));
    for (PetscInt e = 0; e < ElementNumEdges(facets->type[f]); e++)
      if (at_middle[e] == 0) PetscCall(DMLabelSetValue(label, edges[e], 1));
  }
  PetscCall(PetscFree(point));
  PetscCall(PetscFree2(on, at_node));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PointIsParabola(DM dm, PetscInt point, PetscBool *parabola)
{
  DMLabel  label;
  PetscInt value = 0;

  PetscFunctionBeginUser;
  PetscCall(DMGetLabel(dm, PARABOLAS, &label));
  if (label) PetscCall(DMLabelGetValue(label, point, &value));
  *parabola = (PetscBool)(value == 1);
  PetscFunctionReturn(PETSC_SUCCESS);
}
