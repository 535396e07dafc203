/* arcnodes.c -- new nodes of smooth sides, on the curves of the nodal normals (eq. 4.5).

   A curve's middle belongs to the node in the middle of its edge, on this level or on the next finer one.
   Facets give offsets to their nodes, and all ranks sum them. The middle node of a quadrilateral or
   hexahedron moves by half or a quarter of the sum of its edges' offsets (Coons): cells stay valid.
   Everything happens before maps. */
#include "kernel/vector.h"
#include "refinement/arcsums.h"
#include "refinement/refinementimpl.h"
#include "kernel/arc.h"
#include "base/compat.h"
#include "kernel/frame.h"
#include "refinement/filearcs.h"
#include "side/normalerrors.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* Nodes in the middle of edges, quadrilaterals and hexahedra of one level. */
typedef struct {
  Level    *from, *to;
  PetscInt  begin, end; /* points of from */
  PetscInt *node;       /* of to, in the middle of each point, or -1 [end - begin] */
  Vec       sums;       /* at nodes of to: those of ArcSumsToOffset() */
} Arcs;

/* Offsets of all facets, as ArcBulge() has them; returns whether there are any on this rank. [out] bulge -
   [num][F][dim] */
static PetscErrorCode BulgesCreate_Private(const Level *level, const ArcSides *sides, const SideShape *shape,
                                           PetscReal **bulge, PetscBool *any)
{
  const Facets  *facets = &sides->round;
  const PetscInt dim    = level->dim;
  PetscReal      X[3 * F];

  PetscFunctionBeginUser;
  *any = PETSC_FALSE;
  PetscCall(PetscCalloc1(facets->num * F * dim, bulge));
  for (PetscInt f = 0; f < facets->num; f++) {
    VectorGather(dim, ElementNumNodes(facets->type[f]), &facets->nodes[f * F], level->coords, X);
    if (!ArcBulge(facets->type[f], X, &shape->normal[f * F * dim], &shape->smooth[f * F], &(*bulge)[f * F * dim]))
      continue;
    *any = PETSC_TRUE;
    for (PetscInt e = 0; e < ElementNumEdges(facets->type[f]) && shape->quadric; e++) {
      const PetscInt *ends = ElementEdgeNodes(facets->type[f], e);

      (void)QuadricTakeArc(&shape->quadric[f], &X[ends[0] * dim], &X[ends[1] * dim],
                           &(*bulge)[(f * F + ElementNumNodes(facets->type[f]) + e) * dim], NULL);
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelHasArcs(Level *level, const ArcSides *sides, PetscBool *any)
{
  Level      plain = LevelBeforeMap(level);
  SideShape  shape;
  PetscReal *bulge;

  PetscFunctionBeginUser;
  PetscCall(SideShapeCreate(&plain, &sides->round, &sides->flat, &shape));
  PetscCall(BulgesCreate_Private(&plain, sides, &shape, &bulge, any));
  PetscCall(LevelAddNormalErrors(level, &sides->round, &shape));
  PetscCall(PetscFree(bulge));
  PetscCall(SideShapeDestroy(&shape));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FacetGetEdges(const Level *level, const PetscInt point[], const Facets *facets, PetscInt f,
                             PetscInt edges[])
{
  PetscFunctionBeginUser;
  for (PetscInt e = 0; e < ElementNumEdges(facets->type[f]); e++) {
    const PetscInt *local   = ElementEdgeNodes(facets->type[f], e);
    const PetscInt  ends[2] = {point[facets->nodes[f * F + local[0]]], point[facets->nodes[f * F + local[1]]]};
    const PetscInt *joined;
    PetscInt        num;

    PetscCall(DMPlexGetJoin(level->dm, 2, ends, &num, &joined));
    PetscCheck(num == 1, PETSC_COMM_SELF, PETSC_ERR_PLIB, "%" PetscInt_FMT " edges between two vertices", num);
    edges[e] = joined[0];
    PetscCall(DMPlexRestoreJoin(level->dm, 2, ends, &num, &joined));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the data of facets at the nodes on their edges.
   [in] bulge - as BulgesCreate_Private() makes it, or NULL: normals [num][F][dim] */
static PetscErrorCode ArcsAdd_Private(const Arcs *arcs, const Facets *facets, const PetscReal bulge[],
                                      PetscScalar sums[])
{
  const PetscInt dim = arcs->from->dim;
  PetscInt      *point, edges[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(LevelGetNodePoints(arcs->from, &point));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt num = ElementNumNodes(facets->type[f]);
    PetscReal      normal[3];

    PetscCall(FacetGetEdges(arcs->from, point, facets, f, edges));
    if (!bulge) (void)FacetGetMeasure(arcs->from, facets, f, normal);
    for (PetscInt e = 0; e < ElementNumEdges(facets->type[f]); e++) {
      const PetscInt node = arcs->node[edges[e] - arcs->begin];
      PetscBool      parabola;

      PetscCall(PointIsParabola(arcs->from->dm, edges[e], &parabola));
      if (node < 0 || parabola) continue;
      if (bulge)
        ArcSumsAddOffset(dim, &bulge[(f * F + num + e) * dim], &sums[node * ARC_SUMS]);
      else
        ArcSumsAddPlane(dim, normal, &sums[node * ARC_SUMS]);
    }
  }
  PetscCall(PetscFree(point));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sums of all ranks at the nodes. Collective. */
static PetscErrorCode ArcsSum_Private(Arcs *arcs, const ArcSides *sides)
{
  SideShape    shape;
  PetscReal   *bulge;
  PetscBool    any;
  PetscScalar *sums;
  Vec          local;

  PetscFunctionBeginUser;
  PetscCall(SideShapeCreate(arcs->from, &sides->round, &sides->flat, &shape));
  PetscCall(BulgesCreate_Private(arcs->from, sides, &shape, &bulge, &any));
  PetscCall(SideShapeDestroy(&shape));
  PetscCall(LevelCreateVec(arcs->to, ARC_SUMS, &arcs->sums));
  PetscCall(VecGhostGetLocalForm(arcs->sums, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, &sums));
  PetscCall(ArcsAdd_Private(arcs, &sides->round, bulge, sums));
  PetscCall(ArcsAdd_Private(arcs, &sides->flat, NULL, sums));
  PetscCall(VecRestoreArray(local, &sums));
  PetscCall(VecGhostRestoreLocalForm(arcs->sums, &local));
  PetscCall(LevelShareVec(arcs->sums, ADD_VALUES));
  PetscCall(PetscFree(bulge));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The offset of the node of each edge from its position. [out] way - [end - begin][dim], zero where
   nothing is known */
static PetscErrorCode ArcsGetWays_Private(const Arcs *arcs, PetscReal way[])
{
  const PetscInt     dim = arcs->from->dim;
  const PetscReal   *at = arcs->to->unmapped, *X = arcs->from->coords;
  PetscInt           begin, end, num, vertices[ELEMENT_MAX_NODES];
  const PetscScalar *sums;
  Vec                local;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetDepthStratum(arcs->from->dm, 1, &begin, &end));
  PetscCall(VecGhostGetLocalForm(arcs->sums, &local));
  PetscCall(VecGetArrayRead(local, &sums));
  for (PetscInt p = begin; p < end; p++) {
    const PetscInt node = arcs->node[p - arcs->begin];
    PetscReal      offset[3];

    if (node < 0 || !ArcSumsToOffset(dim, &sums[node * ARC_SUMS], offset)) continue;
    PetscCall(PointGetVertices(arcs->from->dm, p, &num, vertices));
    for (PetscInt k = 0; k < dim; k++) {
      const PetscReal a = X[PointGetNode(arcs->from, vertices[0]) * dim + k];
      const PetscReal b = X[PointGetNode(arcs->from, vertices[1]) * dim + k];

      way[(p - arcs->begin) * dim + k] = 0.5 * (a + b) + offset[k] - at[node * dim + k];
    }
  }
  PetscCall(VecRestoreArrayRead(local, &sums));
  PetscCall(VecGhostRestoreLocalForm(arcs->sums, &local));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Moves nodes on edges by their offsets, and nodes of quadrilaterals and hexahedra by a share of the sum over
   their edges. */
static PetscErrorCode ArcsMove_Private(const Arcs *arcs)
{
  static const PetscReal share[] = {0, 1, 1. / 2, 1. / 4}; // by the dimension of the point
  const PetscInt         dim     = arcs->from->dim;
  PetscReal             *way;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((arcs->end - arcs->begin) * dim, &way));
  PetscCall(ArcsGetWays_Private(arcs, way));
  for (PetscInt depth = 1; depth <= dim; depth++) {
    PetscInt begin, end, edge_begin, edge_end;

    PetscCall(DMPlexGetDepthStratum(arcs->from->dm, 1, &edge_begin, &edge_end));
    PetscCall(DMPlexGetDepthStratum(arcs->from->dm, depth, &begin, &end));
    for (PetscInt p = begin; p < end; p++) {
      const PetscInt node = arcs->node[p - arcs->begin];
      PetscInt       num, *closure = NULL;

      if (node < 0) continue;
      PetscCall(DMPlexGetTransitiveClosure(arcs->from->dm, p, PETSC_TRUE, &num, &closure));
      for (PetscInt i = 0; i < num; i++) {
        if (closure[2 * i] < edge_begin || closure[2 * i] >= edge_end) continue;
        for (PetscInt k = 0; k < dim; k++)
          arcs->to->unmapped[node * dim + k] += share[depth] * way[(closure[2 * i] - arcs->begin) * dim + k];
      }
      PetscCall(DMPlexRestoreTransitiveClosure(arcs->from->dm, p, PETSC_TRUE, &num, &closure));
    }
  }
  PetscCall(PetscFree(way));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ArcsRun_Private(Arcs *arcs, const ArcSides *sides)
{
  Level plain = LevelBeforeMap(arcs->from);

  PetscFunctionBeginUser;
  arcs->from = &plain;
  PetscCall(ArcsSum_Private(arcs, sides));
  PetscCall(ArcsMove_Private(arcs));
  PetscCall(VecDestroy(&arcs->sums));
  PetscCall(PetscFree(arcs->node));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelArcVertices(Level *coarse, const ArcSides *sides, const Refinement *refinement, Level *fine)
{
  Arcs     arcs = {.from = coarse, .to = fine};
  PetscInt begin, end;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(coarse->dm, &arcs.begin, &arcs.end));
  PetscCall(PetscMalloc1(arcs.end - arcs.begin, &arcs.node));
  for (PetscInt p = 0; p < arcs.end - arcs.begin; p++) arcs.node[p] = -1;
  PetscCall(DMPlexGetDepthStratum(fine->dm, 0, &begin, &end));
  for (PetscInt v = begin; v < end; v++) {
    PetscBool      vertex;
    const PetscInt point = RefinementGetSource(refinement, v, &vertex);

    if (!vertex) arcs.node[point - arcs.begin] = PointGetNode(fine, v);
  }
  PetscCall(ArcsRun_Private(&arcs, sides));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelArcMiddles(Level *level, const ArcSides *sides)
{
  Arcs     arcs = {.from = level, .to = level};
  PetscInt begin, end;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(level->dm, &arcs.begin, &arcs.end));
  PetscCall(PetscMalloc1(arcs.end - arcs.begin, &arcs.node));
  PetscCall(DMPlexGetDepthStratum(level->dm, 0, &begin, &end));
  for (PetscInt p = arcs.begin; p < arcs.end; p++)
    arcs.node[p - arcs.begin] =
        (p >= begin && p < end) || p < level->point_begin || p >= level->point_end ? -1 : PointGetNode(level, p);
  PetscCall(ArcsRun_Private(&arcs, sides));
  PetscFunctionReturn(PETSC_SUCCESS);
}
