/* treearcs.c -- smooth sides of bodies that are bisected, on the curves of their vertices' normals (eq. 4.5).

   Normals of the first list are those of its facets. Where an edge is halved, the new vertex is the middle of
   its arc, with the normal of the arc. In the middle of a face it is that of the arc between two opposite
   edges. On circles, spheres and cylinders both are exact for any sequence of
   bisections. Facets of a file of second order that are not on arcs have the surface of (4.5a) instead. Flat
   sides stay exactly flat. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/cellmiddles.h"
#include "bodies/curvedfile.h"
#include "bodies/plexlist.h"
#include "kernel/arc.h"
#include "kernel/frame.h"
#include "kernel/vector.h"
#include "level/leveltables.h"
#include "level/plexpoints.h"
#include "mesh/tree.h"
#include "mesh/treearcs.h"
#include "refinement/arcsums.h"
#include "refinement/filearcs.h"
#include "refinement/levelrefine.h"
#include <string.h>

enum { F = ELEMENT_MAX_FACET_NODES };

/* Marks facets of the first list that belong to some of its sides. [in] joined - names of sides, freed here;
   or NULL; [in,out] chosen - by the first entry [num_entries]; [out] any - whether there are such facets; or
   NULL */
static PetscErrorCode TreeChooseFacets_Private(const Tree *tree, const SideNames *names, char *joined,
                                               PetscBool chosen[], PetscBool *any)
{
  SideNames wanted = {0, NULL};

  PetscFunctionBeginUser;
  if (any) *any = PETSC_FALSE;
  if (joined) PetscCall(SideNamesAdd(&wanted, joined));
  PetscCall(PetscFree(joined));
  for (PetscInt c = 0; c < tree->mesh.num_cells; c++) {
    for (PetscInt v = 0; v < tree->mesh.corners; v++) {
      const PetscInt first = tree->mesh.facet[c][v];

      for (PetscInt e = first; e >= 0; e = tree->another[e]) {
        for (PetscInt i = 0; i < wanted.num; i++) {
          if (strcmp(wanted.name[i], names->name[tree->side[e]])) continue;
          chosen[first] = PETSC_TRUE;
          if (any) *any = PETSC_TRUE;
        }
      }
    }
  }
  PetscCall(SideNamesDestroy(&wanted));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The first list as a level of its own, on this rank, before any map. */
static PetscErrorCode TreeCreateLevel_Private(const Tree *tree, Scene alone, Level *level)
{
  Numbering numbering;
  Curves    curves;
  DM        dm;

  PetscFunctionBeginUser;
  PetscCall(NumberingCreate(1, &tree->list, &numbering));
  PetscCall(PlexCreate(PETSC_COMM_SELF, tree->list.dim, &tree->list, &numbering, &dm));
  PetscCall(CurvesCreate(dm, &tree->list, &numbering, &curves));
  PetscCall(LevelCreateTables(alone, dm, alone->bodies[0].order, level));
  PetscCall(LevelSetCoords(level, &curves));
  PetscCall(CurvesDestroy(&curves));
  PetscCall(NumberingDestroy(&numbering));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static ElementType TreeFacetType_Private(const Tree *tree)
{
  if (tree->mesh.dim == 2) return ELEMENT_LINE2;
  return TreeIsKept(tree) ? ELEMENT_QUAD4 : ELEMENT_TRI3;
}

/* Facets of the level of the first list, smooth ones first. [out] num_round - of these; [out] facets - owned
   by the caller; [out] entry - of each, freed by the caller */
static PetscErrorCode TreeGetFacets_Private(const Tree *tree, const Level *level, PetscInt *num_round, Facets *facets,
                                            PetscInt **entry)
{
  const TreeArcs *arcs      = &tree->arcs;
  const PetscInt  num_cells = tree->list.num_cells;

  PetscFunctionBeginUser;
  PetscCall(FacetsAllocate(tree->num_entries, facets));
  PetscCall(PetscMalloc1(tree->num_entries, entry));
  facets->num = 0;
  for (PetscInt pass = 0; pass < 2; pass++) {
    for (PetscInt c = 0; c < num_cells; c++) {
      for (PetscInt v = 0; v < tree->mesh.corners; v++) {
        const PetscInt e = tree->mesh.facet[c][v];
        PetscInt       n = facets->num * F;

        if (e < 0 || (pass ? arcs->round[e] || !arcs->flat[e] : !arcs->round[e])) continue;
        facets->cell[facets->num] = c; // points of the DM: cells of one type, then vertices
        facets->type[facets->num] = TreeFacetType_Private(tree);
        for (PetscInt i = 0; i < tree->mesh.corners; i++) {
          if (TreeIsKept(tree) ? i < ElementNumNodes(TreeFacetType_Private(tree)) : i != v) {
            const PetscInt k = TreeIsKept(tree) ? ElementFacetNodes(SplitElement(&tree->mesh), v)[i] : i;

            facets->nodes[n++] = PointGetNode(level, num_cells + tree->mesh.vertex[c][k]);
          }
        }
        (*entry)[facets->num++] = e;
      }
    }
    if (!pass) *num_round = facets->num;
  }
  FacetsTurnOut(level, facets);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Drops the smooth facets of a file of second order that stay parabolas.
   [in,out] num_round - smooth ones, which come first; facets, entry, shape - in the same order */
static PetscErrorCode TreeDropParabolas_Private(Tree *tree, const Level *level, PetscInt *num_round, Facets *facets,
                                                PetscInt entry[], SideShape *shape)
{
  PetscInt  kept = 0;
  PetscBool edge[F];

  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscBool on = (PetscBool)(f < *num_round && FacetIsOnArcs(level, facets, f, shape, edge));
    const PetscBool known =
        (PetscBool)(level->dim == 3 && f < *num_round && SideShapeIsKnown(shape, f, facets->type[f]));
    PetscBool arcs = on; // all edges are

    if (f < *num_round && !on && !known) {
      tree->arcs.round[entry[f]] = PETSC_FALSE;
      continue;
    }
    for (PetscInt e = 0; e < ElementNumEdges(TreeFacetType_Private(tree)) && on; e++) {
      tree->arcs.middle[entry[f] * F + e].arc = edge[e];
      arcs                                    = (PetscBool)(arcs && edge[e]);
    }
    if (known) tree->arcs.patch[entry[f]].any = (PetscBool)!arcs;
    facets->type[kept] = facets->type[f];
    facets->cell[kept] = facets->cell[f];
    entry[kept]        = entry[f];
    PetscCall(PetscArraymove(&facets->nodes[kept * F], &facets->nodes[f * F], F));
    if (f < *num_round) PetscCall(SideShapeMove(level->dim, f, kept, shape));
    kept++;
  }
  *num_round -= facets->num - kept;
  facets->num = kept;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The normals in the middle of edges. [in] num_round - facets that have normals, of second order
   [num_round][F][dim] */
static PetscErrorCode TreeSetMiddles_Private(Tree *tree, const Level *level, const Facets *facets,
                                             const PetscInt entry[], PetscInt num_round, const PetscReal normal[])
{
  const PetscInt dim = level->dim, first = tree->list.num_cells;
  PetscInt      *point;

  PetscFunctionBeginUser;
  PetscCall(LevelGetNodePoints(level, &point));
  for (PetscInt f = 0; f < num_round; f++) {
    const ElementType linear = TreeFacetType_Private(tree);

    for (PetscInt e = 0; e < ElementNumEdges(linear); e++) {
      SideMiddle *middle = &tree->arcs.middle[entry[f] * F + e];

      for (PetscInt i = 0; i < 2; i++)
        middle->ends[i] = point[facets->nodes[f * F + ElementEdgeNodes(linear, e)[i]]] - first;
      PetscCall(PetscArraycpy(middle->normal, &normal[(f * F + ElementNumNodes(linear) + e) * dim], dim));
    }
  }
  PetscCall(PetscFree(point));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether an edge of the file joins two vertices. */
static PetscBool SideMiddleJoins_Private(const SideMiddle *middle, PetscInt a, PetscInt b)
{
  return (PetscBool)((middle->ends[0] == a && middle->ends[1] == b) || (middle->ends[0] == b && middle->ends[1] == a));
}

static PetscBool SideCornerIsOn_Private(const SideCorner *corner, PetscInt vertex, const SideMiddle *middle,
                                        PetscInt edge)
{
  return (PetscBool)(corner->edge == edge || vertex == middle->ends[0] || vertex == middle->ends[1]);
}

/* The edge of a facet of the first list that two vertices are on, -1 if there is none. [in] from, to - their
   corners at the facet */
static PetscInt TreeArcsFindEdge_Private(const TreeArcs *arcs, PetscInt a, const SideCorner *from, PetscInt b,
                                         const SideCorner *to)
{
  for (PetscInt e = 0; e < F && arcs->middle; e++) {
    const SideMiddle *middle = &arcs->middle[from->facet * F + e];

    if (middle->ends[0] == middle->ends[1]) continue; // no edge, or of a facet that is not smooth
    if (SideCornerIsOn_Private(from, a, middle, e) && SideCornerIsOn_Private(to, b, middle, e)) return e;
  }
  return -1;
}

/* Whether some edge of facets with these normals bends. */
static PetscBool FacetsBend_Private(const Level *level, const Facets *facets, const PetscReal normal[])
{
  const PetscInt dim = level->dim;
  PetscBool      any = PETSC_FALSE;

  for (PetscInt f = 0; f < facets->num && !any; f++) {
    PetscReal X[3 * F], bulge[3 * F];

    VectorGather(dim, ElementNumNodes(facets->type[f]), &facets->nodes[f * F], level->coords, X);
    any = ArcBulge(ElementLinear(facets->type[f]), X, &normal[f * F * dim], NULL, bulge);
  }
  return any;
}

/* Corners at the vertices of the first list, in their order. [in] num_round - facets that have normals */
static PetscErrorCode TreeArcsBegin_Private(Tree *tree, const Level *level, const Facets *facets,
                                            const PetscInt entry[], PetscInt num_round, const SideShape *shape)
{
  const PetscInt dim = level->dim, first = tree->list.num_cells;
  TreeArcs      *arcs = &tree->arcs;
  PetscInt      *point;

  PetscFunctionBeginUser;
  PetscCall(LevelGetNodePoints(level, &point));
  arcs->num_vertices = tree->list.num_vertices;
  PetscCall(PetscCalloc1(arcs->num_vertices + 2, &arcs->start));
  arcs->room = facets->num * ElementNumNodes(TreeFacetType_Private(tree));
  PetscCall(PetscCalloc1(arcs->room, &arcs->corner));
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(TreeFacetType_Private(tree)); i++)
      arcs->start[point[facets->nodes[f * F + i]] - first + 2]++;
  }
  for (PetscInt v = 0; v < arcs->num_vertices; v++) arcs->start[v + 2] += arcs->start[v + 1];
  for (PetscInt f = 0; f < facets->num; f++) {
    if (arcs->flat[entry[f]]) (void)FacetGetMeasure(level, facets, f, arcs->plane[entry[f]]);
    for (PetscInt i = 0; i < ElementNumNodes(TreeFacetType_Private(tree)); i++) {
      SideCorner *corner = &arcs->corner[arcs->start[point[facets->nodes[f * F + i]] - first + 1]++];

      corner->facet = entry[f];
      corner->edge  = -1;
      if (dim == 3) PetscCall(PetscArraycpy(corner->xi, ElementNode(TreeFacetType_Private(tree), i), 2));
      if (f >= num_round) continue;
      PetscCall(PetscArraycpy(corner->normal, &shape->normal[(f * F + i) * dim], dim));
      if (dim == 3 && shape->smooth[f * F + i])
        PetscCall(PetscArraycpy(corner->curvature, &shape->curvature[(f * F + i) * 9], 9));
    }
  }
  PetscCall(PetscFree(point));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether an edge is one of the file, which has a node in its middle. */
static PetscBool TreeArcsIsOfFile_Private(const TreeArcs *arcs, PetscInt a, PetscInt b)
{
  if (!arcs->middle || PetscMax(a, b) >= arcs->num_vertices) return PETSC_FALSE;
  for (PetscInt i = arcs->start[a]; i < arcs->start[a + 1]; i++) {
    for (PetscInt e = 0; e < F; e++) {
      if (SideMiddleJoins_Private(&arcs->middle[arcs->corner[i].facet * F + e], a, b)) return PETSC_TRUE;
    }
  }
  return PETSC_FALSE;
}

static PetscBool SideCornersAreSmooth_Private(const SideCorner *from, const SideCorner *to)
{
  return (PetscBool)(VectorNorm(9, from->curvature) > 0 && VectorNorm(9, to->curvature) > 0);
}

/* The middle of two vertices on the surface of a facet, from the middle between them. [out] offset - [3] */
static void SidePatchOffset_Private(const SidePatch *patch, const PetscReal x0[3], const SideCorner *from,
                                    const PetscReal x1[3], const SideCorner *to, PetscReal offset[3])
{
  const PetscReal xi[2] = {(from->xi[0] + to->xi[0]) / 2, (from->xi[1] + to->xi[1]) / 2};
  PetscReal       x[3], phi[ELEMENT_MAX_NODES];

  RiseAt(patch->type, patch->rise, xi, offset);
  (void)ElementSurface(patch->type, patch->X, xi, x, phi, NULL);
  for (PetscInt k = 0; k < 3; k++) offset[k] += x[k] - (x0[k] + x1[k]) / 2;
}

/* The curve of an edge whose ends are on facets in common. Returns whether one of these is smooth.
   [out] offset - of its middle [dim]; zero where the curve is straight */
static PetscBool TreeArcsOffset_Private(const Tree *tree, const PetscReal coords[], PetscInt a, PetscInt b,
                                        PetscReal offset[])
{
  const TreeArcs *arcs = &tree->arcs;
  const PetscInt  dim = tree->list.dim, low = PetscMin(a, b), high = PetscMax(a, b);
  PetscScalar     sums[ARC_SUMS] = {0};
  PetscBool       round          = PETSC_FALSE;
  PetscInt        edge;

  if (high >= arcs->num_vertices) return PETSC_FALSE;
  for (PetscInt i = arcs->start[low]; i < arcs->start[low + 1]; i++) {
    const SideCorner *mine = &arcs->corner[i];

    for (PetscInt j = arcs->start[high]; j < arcs->start[high + 1]; j++) {
      const SideCorner *other = &arcs->corner[j];

      if (other->facet != mine->facet) continue;
      if (arcs->flat[mine->facet]) ArcSumsAddPlane(dim, arcs->plane[mine->facet], sums);
      if (!arcs->round[mine->facet]) continue;
      if (arcs->patch && arcs->patch[mine->facet].any) {
        SidePatchOffset_Private(&arcs->patch[mine->facet], &coords[low * dim], mine, &coords[high * dim], other,
                                offset);
      } else {
        edge = TreeArcsFindEdge_Private(arcs, low, mine, high, other);
        if (edge >= 0 && !arcs->middle[mine->facet * F + edge].arc) continue;
        ArcOffset(dim, &coords[low * dim], mine->normal, &coords[high * dim], other->normal,
                  SideCornersAreSmooth_Private(mine, other), offset);
        if (arcs->quadric)
          (void)QuadricTakeArc(&arcs->quadric[mine->facet], &coords[low * dim], &coords[high * dim], offset, NULL);
      }
      round = PETSC_TRUE;
      ArcSumsAddOffset(dim, offset, sums);
    }
  }
  if (!ArcSumsToOffset(dim, sums, offset)) (void)PetscArrayzero(offset, dim);
  return round;
}

/* Puts middle nodes of cells of order 2 on the curves of their edges. Straight ones among them are not where
   the parent's curved face has them: that is a parabola, also between two lines of a cylinder. */
static void TreeArcsSetMiddles_Private(const Tree *tree, BodyList *list)
{
  const PetscInt dim = list->dim;

  for (PetscInt c = 0; c < list->num_cells; c++) {
    const ElementType type  = (ElementType)list->cell_type[c];
    const PetscInt   *nodes = &list->cell_nodes[c * ELEMENT_MAX_NODES];
    PetscBool         any   = PETSC_FALSE;

    for (PetscInt e = 0; e < ElementNumEdges(type) && ElementOrder(type) > 1; e++) {
      const PetscInt a = nodes[ElementEdgeNodes(type, e)[0]], b = nodes[ElementEdgeNodes(type, e)[1]];
      PetscReal      offset[3];

      if (TreeArcsIsOfFile_Private(&tree->arcs, a, b) || !TreeArcsOffset_Private(tree, list->coords, a, b, offset))
        continue;
      any = PETSC_TRUE;
      for (PetscInt d = 0; d < dim; d++)
        list->coords[nodes[tree->mesh.corners + e] * dim + d] =
            (list->coords[a * dim + d] + list->coords[b * dim + d]) / 2 + offset[d];
    }
    if (any) CellPlaceMiddles(c, tree->mesh.corners + ElementNumEdges(type), list);
  }
}

/* The surfaces of facets that are not on arcs. [in] num_round - facets that may have one */
static void TreeSetPatches_Private(Tree *tree, const Level *level, const Facets *facets, const PetscInt entry[],
                                   PetscInt num_round, const SideShape *shape)
{
  for (PetscInt f = 0; f < num_round; f++) {
    SidePatch *patch = &tree->arcs.patch[entry[f]];

    if (!patch->any) continue;
    patch->type = facets->type[f];
    VectorGather(3, ElementNumNodes(patch->type), &facets->nodes[f * F], level->coords, patch->X);
    SideShapeGetRise(shape, f, patch->type, patch->X, patch->rise);
  }
}

/* Normals of the first list, if its smooth sides bend. */
static PetscErrorCode TreeArcsFind_Private(Tree *tree, Scene alone)
{
  TreeArcs *arcs = &tree->arcs;
  PetscInt *entry, num_round = 0, num;
  SideShape shape;
  Facets    facets, flat;
  Level     level;

  PetscFunctionBeginUser;
  PetscCall(TreeCreateLevel_Private(tree, alone, &level));
  PetscCall(TreeGetFacets_Private(tree, &level, &num_round, &facets, &entry));
  if (tree->list.curved_file) PetscCall(FacetsRaise(&level, &facets));
  num        = facets.num;
  facets.num = num_round;
  flat       = (Facets){.num   = num - num_round,
                        .type  = facets.type + num_round,
                        .cell  = facets.cell + num_round,
                        .nodes = facets.nodes + num_round * F};
  PetscCall(SideShapeCreate(&level, &facets, &flat, &shape));
  facets.num = num;
  if (tree->list.curved_file) {
    PetscCall(PetscCalloc1(tree->num_entries * F, &arcs->middle));
    if (level.dim == 3) PetscCall(PetscCalloc1(tree->num_entries, &arcs->patch));
    PetscCall(TreeDropParabolas_Private(tree, &level, &num_round, &facets, entry, &shape));
  }
  num        = facets.num;
  facets.num = num_round;
  arcs->any  = FacetsBend_Private(&level, &facets, shape.normal);
  facets.num = num;
  if (arcs->any) PetscCall(TreeArcsBegin_Private(tree, &level, &facets, entry, num_round, &shape));
  if (arcs->any && shape.quadric) {
    PetscCall(PetscCalloc1(tree->num_entries, &arcs->quadric));
    for (PetscInt f = 0; f < num_round; f++) arcs->quadric[entry[f]] = shape.quadric[f];
  }
  if (arcs->any && arcs->patch) TreeSetPatches_Private(tree, &level, &facets, entry, num_round, &shape);
  if (arcs->any && tree->list.curved_file)
    PetscCall(TreeSetMiddles_Private(tree, &level, &facets, entry, num_round, shape.normal));
  PetscCall(SideShapeDestroy(&shape));
  PetscCall(FacetsDestroy(&facets));
  PetscCall(PetscFree(entry));
  PetscCall(LevelDestroy(&level));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode TreeArcsCreate(Scene scene, PetscInt body, const SideNames *names, Tree *tree)
{
  const SceneBody *own   = &scene->bodies[body];
  TreeArcs        *arcs  = &tree->arcs;
  const PetscBool  high  = tree->list.curved_file;
  SceneBody        plain = {.name = own->name, .order = high ? 2 : 1, .mesh_file = own->mesh_file};
  struct _n_Scene  alone = {.comm = PETSC_COMM_SELF, .dim = scene->dim, .num_bodies = 1, .bodies = &plain};
  char            *round, *flat;
  PetscBool        any;

  PetscFunctionBeginUser;
  if (!own->mesh_file || own->polygonal || !tree->list.num_cells) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(
      PetscCalloc3(tree->num_entries, &arcs->round, tree->num_entries, &arcs->flat, tree->num_entries, &arcs->plane));
  PetscCall(ArcSideNames(scene, body, &round, &flat));
  PetscCall(TreeChooseFacets_Private(tree, names, round, arcs->round, &any));
  PetscCall(TreeChooseFacets_Private(tree, names, flat, arcs->flat, NULL));
  if (any) PetscCall(TreeArcsFind_Private(tree, &alone));
  if (!arcs->any) {
    PetscCall(TreeArcsDestroy(arcs));
  } else if (own->order > 1 && !high) {
    PetscCall(BodyListRaise(&tree->list));
    TreeArcsSetMiddles_Private(tree, &tree->list);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode TreeArcsDestroy(TreeArcs *arcs)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree3(arcs->round, arcs->flat, arcs->plane));
  PetscCall(PetscFree(arcs->start));
  PetscCall(PetscFree(arcs->middle));
  PetscCall(PetscFree(arcs->quadric));
  PetscCall(PetscFree(arcs->patch));
  PetscCall(PetscFree(arcs->corner));
  *arcs = (TreeArcs){.any = PETSC_FALSE};
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds to the normal in the middle of an edge, across it, what a cubic of the normals at both ends adds to
   their sum: a quarter of (S_0 - S_1) d. Its curvature is the mean, with that along the edge of the cubic. */
static void SideCornerTurn_Private(const PetscReal d[3], const SideCorner *from, const SideCorner *to,
                                   SideCorner *middle)
{
  const PetscReal square = VectorDot(3, d, d);
  PetscReal       turn[3], rest[3], along, twice;

  if (!SideCornersAreSmooth_Private(from, to)) return;
  for (PetscInt k = 0; k < 3; k++) {
    const PetscReal first = VectorDot(3, &from->curvature[3 * k], d), last = VectorDot(3, &to->curvature[3 * k], d);

    turn[k] = (first - last) / 4;
    rest[k] = 3 * (to->normal[k] - from->normal[k]) / 2 - 3 * (first + last) / 4;
  }
  along = VectorDot(3, turn, d) / square;
  twice = VectorDot(3, rest, d) / square;
  for (PetscInt k = 0; k < 3; k++) middle->normal[k] += turn[k] - along * d[k];
  for (PetscInt k = 0; k < 9; k++)
    middle->curvature[k] = (from->curvature[k] + to->curvature[k]) / 2 +
                           (rest[k / 3] * d[k % 3] + d[k / 3] * rest[k % 3] - twice * d[k / 3] * d[k % 3]) / square;
}

/* The normal in the middle of an edge: orthogonal to the edge on a circle, else that of a cubic with the
   normals at the ends. */
static void SideCornerBetween_Private(PetscInt dim, const PetscReal x0[], const SideCorner *from, const PetscReal x1[],
                                      const SideCorner *to, SideCorner *middle)
{
  PetscReal way[3], a = 0, b = 0, square = 0, share;

  *middle = (SideCorner){.facet = from->facet, .xi = {(from->xi[0] + to->xi[0]) / 2, (from->xi[1] + to->xi[1]) / 2}};
  for (PetscInt d = 0; d < dim; d++) {
    middle->normal[d] = from->normal[d] + to->normal[d];
    way[d]            = x1[d] - x0[d];
    a -= from->normal[d] * way[d];
    b += to->normal[d] * way[d];
    square += PetscSqr(way[d]);
  }
  share = (a * b > 0 ? 1.5 : 1) * (b - a) / square;
  for (PetscInt d = 0; d < dim; d++) middle->normal[d] -= share * way[d];
  if (dim == 3) SideCornerTurn_Private(way, from, to, middle);
  FrameNormalize(dim, middle->normal);
}

/* Corners at a new vertex: those facets that both ends of its edge are on. [in] a, b - ends; [out] corner -
   as many as num says afterwards */
static void TreeArcsAddVertex_Private(const TreeArcs *arcs, PetscInt dim, const PetscReal coords[], PetscInt a,
                                      PetscInt b, PetscInt *num, SideCorner corner[])
{
  *num = 0;
  for (PetscInt i = arcs->start[a]; i < arcs->start[a + 1]; i++) {
    for (PetscInt j = arcs->start[b]; j < arcs->start[b + 1]; j++) {
      const SideMiddle *middle;
      SideCorner       *own;
      PetscReal         offset[3];

      if (arcs->corner[i].facet != arcs->corner[j].facet) continue;
      own = &corner[(*num)++];
      SideCornerBetween_Private(dim, &coords[a * dim], &arcs->corner[i], &coords[b * dim], &arcs->corner[j], own);
      own->edge = TreeArcsFindEdge_Private(arcs, a, &arcs->corner[i], b, &arcs->corner[j]);
      if (arcs->quadric) {
        ArcOffset(dim, &coords[a * dim], arcs->corner[i].normal, &coords[b * dim], arcs->corner[j].normal, PETSC_FALSE,
                  offset);
        (void)QuadricTakeArc(&arcs->quadric[own->facet], &coords[a * dim], &coords[b * dim], offset, own->normal);
      }
      middle = own->edge < 0 ? NULL : &arcs->middle[own->facet * F + own->edge];
      if (!middle || !SideMiddleJoins_Private(middle, a, b)) continue;
      for (PetscInt d = 0; d < dim; d++) own->normal[d] = middle->normal[d];
    }
  }
}

/* The corners of a new vertex; the middle of a cell has none. */
static PetscErrorCode TreeArcsAppend_Private(TreeArcs *arcs, PetscInt dim, const PetscReal coords[],
                                             const PetscInt ends[])
{
  const PetscInt v = arcs->num_vertices++, begin = arcs->start[v];
  const PetscInt most = ends[0] < 0 ? 0
                                    : PetscMin(arcs->start[ends[0] + 1] - arcs->start[ends[0]],
                                               arcs->start[ends[1] + 1] - arcs->start[ends[1]]);
  PetscInt       num  = 0;

  PetscFunctionBeginUser;
  if (begin + most > arcs->room) {
    arcs->room = 2 * (begin + most);
    PetscCall(PetscRealloc((size_t)arcs->room * sizeof(SideCorner), &arcs->corner));
  }
  if (most) TreeArcsAddVertex_Private(arcs, dim, coords, ends[0], ends[1], &num, &arcs->corner[begin]);
  arcs->start[v + 1] = begin + num;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode TreeArcsApply(Tree *tree, BodyList *list)
{
  TreeArcs      *arcs = &tree->arcs;
  const PetscInt dim = list->dim, num = list->num_vertices;

  PetscFunctionBeginUser;
  if (!arcs->any) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscRealloc((size_t)(num + 1) * sizeof(PetscInt), &arcs->start));
  arcs->num_vertices = tree->list.num_vertices; // drops those of a list that was tangled
  for (PetscInt v = arcs->num_vertices; v < num; v++) {
    const PetscInt *ends = tree->mesh.ends[v];
    PetscReal       offset[3];

    PetscCall(TreeArcsAppend_Private(arcs, dim, list->coords, ends));
    if (ends[0] < 0 || TreeArcsIsOfFile_Private(arcs, ends[0], ends[1])) continue;
    if (!TreeArcsOffset_Private(tree, list->coords, ends[0], ends[1], offset)) {
      // the middle of a face on a side, between the middles of its edges, which may be on arcs
      if (!TreeIsKept(tree) || arcs->middle || arcs->start[v + 1] == arcs->start[v]) continue;
      PetscCall(PetscArrayzero(offset, dim));
    }
    for (PetscInt d = 0; d < dim; d++)
      list->coords[v * dim + d] = (list->coords[ends[0] * dim + d] + list->coords[ends[1] * dim + d]) / 2 + offset[d];
  }
  TreeArcsSetMiddles_Private(tree, list);
  PetscFunctionReturn(PETSC_SUCCESS);
}
