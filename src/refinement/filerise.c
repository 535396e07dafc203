/* filerise.c -- uniform refinement of files of second order in space: where edges and facets are not on arcs,
   new nodes are on the surface of (4.5a), not on the parabolas of the coarser level. */
#include "base/compat.h"
#include "kernel/rise.h"
#include "kernel/vector.h"
#include "refinement/arcsums.h"
#include "refinement/filearcs.h"
#include "refinement/refinementimpl.h"

enum { F = ELEMENT_MAX_FACET_NODES };

typedef struct {
  const Level      *coarse; /* before maps */
  Level            *fine;
  const Refinement *refinement;
  const ArcSides   *sides; /* of second order, of the coarse level */
  const SideShape  *shape;
  const PetscInt   *point; /* of each coarse node */
  PetscScalar      *sums;  /* at fine nodes, those of ArcSumsToOffset() */
} Rises;

/* The place of a part of a facet: the mean of its vertices, each a vertex, an edge's middle or the middle of
   the facet. [out] xi - in facet f */
static PetscErrorCode RisesGetPlace_Private(const Rises *rises, PetscInt f, PetscInt part, PetscReal xi[2])
{
  const ElementType type = rises->sides->round.type[f];
  PetscInt          num, vertices[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  xi[0] = xi[1] = 0;
  PetscCall(PointGetVertices(rises->fine->dm, part, &num, vertices));
  for (PetscInt v = 0; v < num; v++) {
    const PetscInt source = RefinementGetSource(rises->refinement, vertices[v], NULL);

    for (PetscInt i = 0; i < ElementNumNodes(type); i++) {
      if (rises->point[rises->sides->round.nodes[f * F + i]] != source) continue;
      for (PetscInt k = 0; k < 2; k++) xi[k] += ElementNode(type, i)[k] / (PetscReal)num;
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the rise of facet f to the middle nodes of the parts of one of its points, if that is no arc; without
   a rise, the normal of a flat facet. */
static PetscErrorCode RisesAddPoint_Private(const Rises *rises, PetscInt f, PetscInt point, const PetscReal rise[],
                                            const PetscReal normal[3])
{
  PetscInt  num, first[REFINEMENT_PRODUCTS], parts[REFINEMENT_PRODUCTS];
  PetscBool parabola;

  PetscFunctionBeginUser;
  PetscCall(PointIsParabola(rises->coarse->dm, point, &parabola));
  if (!parabola) PetscFunctionReturn(PETSC_SUCCESS);
  RefinementGetParts(rises->refinement, point, &num, first, parts);
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt part = first[i]; part < first[i] + parts[i]; part++) {
      const PetscInt node = PointGetNode(rises->fine, part);
      PetscScalar   *at   = &rises->sums[node * ARC_SUMS];
      PetscReal      xi[2], way[3];

      if (node < 0) continue;
      if (normal) ArcSumsAddPlane(3, normal, at);
      if (!rise) continue;
      PetscCall(RisesGetPlace_Private(rises, f, part, xi)); // for a vertex its own node, where the rise is zero
      RiseAt(rises->sides->round.type[f], rise, xi, way);
      ArcSumsAddOffset(3, way, at);
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the normals of flat sides at the nodes on their edges: there curves stay within these sides. */
static PetscErrorCode RisesAddPlanes_Private(const Rises *rises)
{
  const Facets *flat = &rises->sides->flat;
  PetscInt      edges[ELEMENT_MAX_NODES];
  PetscReal     normal[3];

  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < flat->num; f++) {
    (void)FacetGetMeasure(rises->coarse, flat, f, normal);
    PetscCall(FacetGetEdges(rises->coarse, rises->point, flat, f, edges));
    for (PetscInt e = 0; e < ElementNumEdges(flat->type[f]); e++)
      PetscCall(RisesAddPoint_Private(rises, f, edges[e], NULL, normal));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode RisesAddFacet_Private(const Rises *rises, PetscInt f)
{
  const ElementType type = rises->sides->round.type[f];
  PetscReal         X[3 * F], rise[3 * RISE_TERMS];
  PetscInt          edges[ELEMENT_MAX_NODES], facet;

  PetscFunctionBeginUser;
  VectorGather(3, ElementNumNodes(type), &rises->sides->round.nodes[f * F], rises->coarse->coords, X);
  SideShapeGetRise(rises->shape, f, type, X, rise);
  if (!RiseIsAny(type, rise)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FacetGetEdges(rises->coarse, rises->point, &rises->sides->round, f, edges));
  PetscCall(FacetGetPoint(rises->coarse, edges, &facet));
  for (PetscInt e = 0; e < ElementNumEdges(type); e++) PetscCall(RisesAddPoint_Private(rises, f, edges[e], rise, NULL));
  PetscCall(RisesAddPoint_Private(rises, f, facet, rise, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the rises of all facets to the positions of fine nodes. Collective. */
static PetscErrorCode RisesApply_Private(Rises *rises)
{
  PetscReal *X = rises->fine->unmapped;
  Vec        sums, local;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(rises->fine, ARC_SUMS, &sums));
  PetscCall(VecGhostGetLocalForm(sums, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, &rises->sums));
  for (PetscInt f = 0; f < rises->sides->round.num; f++) PetscCall(RisesAddFacet_Private(rises, f));
  PetscCall(RisesAddPlanes_Private(rises));
  PetscCall(VecRestoreArray(local, &rises->sums));
  PetscCall(LevelShareVec(sums, ADD_VALUES));
  PetscCall(VecGetArray(local, &rises->sums));
  for (PetscInt n = 0; n < rises->fine->num_nodes; n++) {
    PetscReal offset[3];

    if (!ArcSumsToOffset(3, &rises->sums[n * ARC_SUMS], offset)) continue;
    for (PetscInt k = 0; k < 3; k++) X[3 * n + k] += offset[k];
  }
  PetscCall(VecRestoreArray(local, &rises->sums));
  PetscCall(VecGhostRestoreLocalForm(sums, &local));
  PetscCall(VecDestroy(&sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelRiseParabolas(Level *coarse, const Refinement *refinement, Level *fine)
{
  Level     plain = LevelBeforeMap(coarse);
  ArcSides  sides;
  SideShape shape;
  PetscInt *point;

  PetscFunctionBeginUser;
  PetscCall(FileSidesCreate(coarse, &sides));
  if (sides.any) {
    PetscCall(FacetsRaise(&plain, &sides.round));
    PetscCall(FacetsRaise(&plain, &sides.flat));
    PetscCall(SideShapeCreate(&plain, &sides.round, &sides.flat, &shape));
    PetscCall(LevelGetNodePoints(&plain, &point));
    PetscCall(RisesApply_Private(&(Rises){&plain, fine, refinement, &sides, &shape, point, NULL}));
    PetscCall(PetscFree(point));
    PetscCall(SideShapeDestroy(&shape));
  }
  PetscCall(ArcSidesDestroy(&sides));
  PetscFunctionReturn(PETSC_SUCCESS);
}
