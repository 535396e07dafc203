/* unjoinedpieces.c -- components of one body that touch and are not joined.

   Volumes of a CAD file that are meshed without BooleanFragments have separate nodes where they touch. Such
   components neither stick together nor keep apart, though each may be supported: the solution is that of
   another part. Components that a pair of the scene joins, by two sides of this body, are intended. A body of
   one component takes one pass over its cells. */
#include "base/compat.h"
#include "base/warning.h"
#include "bodies/bodylist.h"
#include "bodies/fileextract.h"
#include "bodies/unjoinedpieces.h"
#include "kernel/boxtree.h"
#include "kernel/closest.h"
#include "kernel/disjointsets.h"
#include "kernel/vector.h"
#include "level/facets.h"
#include "level/plexpoints.h"
#include <string.h>

/* Nodes nearer than this part of the shortest edge around them coincide: CAD programs are accurate to some
   millionths of a part. */
static const PetscReal SAME_PLACE = 1e-3;
/* Facets lie on each other if their normals are opposite to within 18 degrees, ... */
static const PetscReal OPPOSITE = 0.95;
/* ... and the middle of one is on the other. Chords of one curve may differ. If two of length h have an angle
   a, the middle of one is up to a h / 2 away from the other. */
static const PetscReal CHORDS = 0.5;
/* Boxes around facets are wider by this part: more than the difference of chords at the largest angle. */
static const PetscReal MARGIN = 0.2;

/* The boundary of a body of several pieces. */
typedef struct {
  PetscInt   dim, num;               /* facets */
  PetscInt  *piece;                  /* representative vertex of the component of each vertex [num_vertices] */
  PetscInt  *type;                   /* ElementType of order 1 [num] */
  PetscInt  *vertex;                 /* outward [num][ELEMENT_MAX_FACET_NODES] */
  PetscReal *shortest;               /* edge at each vertex of the boundary, 0 elsewhere [num_vertices] */
  PetscBool *paired;                 /* on a side that a pair joins with another side of the body [num_vertices] */
  PetscReal *middle, *normal, *size; /* of facets [num][3], [num][3], longest edge [num] */
} Boundary;

/* Components of vertices connected by cells.
   [out] piece - [num_vertices]; returns the number of components */
static PetscInt PiecesCount_Private(const BodyList *list, PetscInt piece[])
{
  PetscInt num = 0;

  DisjointSetsInitialize(list->num_vertices, piece);
  for (PetscInt c = 0; c < list->num_cells; c++) {
    const PetscInt *nodes = &list->cell_nodes[c * ELEMENT_MAX_NODES];

    for (PetscInt i = 1; i < ElementNumNodes(ElementLinear((ElementType)list->cell_type[c])); i++)
      DisjointSetsUnite(piece, nodes[0], nodes[i]);
  }
  for (PetscInt v = 0; v < list->num_vertices; v++) {
    piece[v] = DisjointSetsFind(piece, v);
    num += piece[v] == v;
  }
  return num;
}

/* One facet with its middle, normal and size; the edges at its vertices. */
static void BoundaryAddFacet_Private(const BodyList *list, PetscInt cell, PetscInt facet, Boundary *b)
{
  const ElementType type = ElementLinear((ElementType)list->cell_type[cell]), of_facet = ElementFacetType(type);
  const PetscInt    num = ElementNumNodes(of_facet), *local = ElementFacetNodes(type, facet), dim = b->dim;
  PetscInt         *vertex = &b->vertex[b->num * ELEMENT_MAX_FACET_NODES];
  PetscReal         X[ELEMENT_MAX_FACET_NODES * 3], phi[ELEMENT_MAX_FACET_NODES], xi[2] = {0.5, 0.5};

  if (of_facet == ELEMENT_TRI3) xi[0] = xi[1] = 1. / 3;
  b->type[b->num] = of_facet;
  b->size[b->num] = 0;
  for (PetscInt i = 0; i < num; i++) vertex[i] = list->cell_nodes[cell * ELEMENT_MAX_NODES + local[i]];
  VectorGather(dim, num, vertex, list->coords, X);
  for (PetscInt i = 0; i < num; i++) {
    const PetscInt j      = (i + 1) % num;
    PetscReal      square = 0, edge;

    for (PetscInt k = 0; k < dim; k++) square += PetscSqr(X[i * dim + k] - X[j * dim + k]);
    edge            = PetscSqrtReal(square);
    b->size[b->num] = PetscMax(b->size[b->num], edge);
    for (PetscInt end = 0; end < 2; end++) {
      PetscReal *shortest = &b->shortest[vertex[end ? j : i]];

      *shortest = *shortest > 0 ? PetscMin(*shortest, edge) : edge;
    }
  }
  (void)ElementSurface(of_facet, X, xi, &b->middle[b->num * 3], phi, &b->normal[b->num * 3]);
  b->num++;
}

/* All facets of one cell of the body alone. */
static PetscErrorCode BoundaryCollect_Private(const Extract *x, const BodyList *list, Boundary *b)
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(x->level.dm, 1, &begin, &end));
  PetscCall(PetscMalloc5(end - begin, &b->type, (end - begin) * ELEMENT_MAX_FACET_NODES, &b->vertex, 3 * (end - begin),
                         &b->middle, 3 * (end - begin), &b->normal, end - begin, &b->size));
  for (PetscInt f = begin; f < end; f++) {
    const PetscInt *support;
    PetscInt        size, num, cell = -1, chosen = 0, vertices[ELEMENT_MAX_NODES];

    PetscCall(DMPlexGetSupportSize(x->level.dm, f, &size));
    PetscCall(DMPlexGetSupport(x->level.dm, f, &support));
    for (PetscInt i = 0; i < size; i++) {
      if (x->cell_at[support[i] - x->cell_begin] < 0) continue;
      cell = x->cell_at[support[i] - x->cell_begin];
      chosen++;
    }
    if (chosen != 1) continue;
    PetscCall(PointGetVertices(x->level.dm, f, &num, vertices));
    for (PetscInt i = 0; i < num; i++) vertices[i] = x->node_at[PointGetNode(&x->level, vertices[i])];
    BoundaryAddFacet_Private(
        list, cell,
        CellFindFacet((ElementType)list->cell_type[cell], &list->cell_nodes[cell * ELEMENT_MAX_NODES], vertices), b);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Vertices of sides that a pair joins with other sides of the same body. */
static PetscErrorCode BoundaryMarkPaired_Private(Scene scene, PetscInt body, const SideNames *names,
                                                 const BodyList *list, Boundary *b)
{
  SideNames own = {0, NULL};

  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    if (scene->pairs[p].nonmortar.body != body || scene->pairs[p].mortar.body != body) continue;
    PetscCall(SideNamesAdd(&own, scene->pairs[p].nonmortar.side));
    PetscCall(SideNamesAdd(&own, scene->pairs[p].mortar.side));
  }
  for (PetscInt f = 0; f < list->num_facets && own.num; f++) {
    const ElementType type  = ElementLinear((ElementType)list->cell_type[list->facet_cell[f]]);
    const PetscInt   *local = ElementFacetNodes(type, list->facet[f]);
    PetscBool         in    = PETSC_FALSE;

    for (PetscInt s = 0; s < own.num; s++)
      in = (PetscBool)(in || !strcmp(own.name[s], names->name[list->facet_side[f]]));
    for (PetscInt i = 0; i < ElementNumNodes(ElementFacetType(type)) && in; i++)
      b->paired[list->cell_nodes[list->facet_cell[f] * ELEMENT_MAX_NODES + local[i]]] = PETSC_TRUE;
  }
  PetscCall(SideNamesDestroy(&own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Counts nodes that coincide with one of another component. */
static PetscErrorCode BoundaryCountNodes_Private(const BodyList *list, const Boundary *b, UnjoinedPieces *found)
{
  const PetscInt  dim = b->dim;
  PetscInt       *vertex, num = 0, num_hits;
  const PetscInt *hits;
  PetscReal      *boxes;
  BoxTree         tree;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(list->num_vertices, &vertex, 2 * dim * list->num_vertices, &boxes));
  for (PetscInt v = 0; v < list->num_vertices; v++) {
    if (!(b->shortest[v] > 0)) continue;
    for (PetscInt k = 0; k < dim; k++) {
      boxes[2 * dim * num + k]       = list->coords[v * dim + k] - SAME_PLACE * b->shortest[v];
      boxes[2 * dim * num + dim + k] = list->coords[v * dim + k] + SAME_PLACE * b->shortest[v];
    }
    vertex[num++] = v;
  }
  PetscCall(BoxTreeCreate(dim, num, boxes, &tree));
  for (PetscInt i = 0; i < num; i++) {
    const PetscInt v   = vertex[i];
    PetscBool      one = PETSC_FALSE;

    PetscCall(BoxTreeQuery(tree, &boxes[2 * dim * i], &num_hits, &hits));
    for (PetscInt h = 0; h < num_hits && hits[h] < i && !one; h++) { // hits ascend
      const PetscInt w      = vertex[hits[h]];
      PetscReal      square = 0;

      if (b->piece[v] == b->piece[w] || (b->paired[v] && b->paired[w])) continue;
      for (PetscInt k = 0; k < dim; k++) square += PetscSqr(list->coords[v * dim + k] - list->coords[w * dim + k]);
      one = (PetscBool)(square <= PetscSqr(SAME_PLACE * PetscMin(b->shortest[v], b->shortest[w])));
    }
    if (one && !found->num_nodes++) PetscCall(PetscArraycpy(found->at, &list->coords[v * dim], dim));
  }
  PetscCall(BoxTreeDestroy(&tree));
  PetscCall(PetscFree2(vertex, boxes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the middle of facet f lies on facet g of another piece. */
static PetscBool BoundaryLiesOn_Private(const BodyList *list, const Boundary *b, PetscInt f, PetscInt g)
{
  const PetscInt *of_f = &b->vertex[f * ELEMENT_MAX_FACET_NODES], *of_g = &b->vertex[g * ELEMENT_MAX_FACET_NODES];
  const PetscInt  dim = b->dim, num = ElementNumNodes((ElementType)b->type[g]);
  PetscReal       X[ELEMENT_MAX_FACET_NODES * 3], eta[2], dot = 0, away;

  if (b->piece[of_f[0]] == b->piece[of_g[0]] || (b->paired[of_f[0]] && b->paired[of_g[0]])) return PETSC_FALSE;
  for (PetscInt k = 0; k < dim; k++) dot += b->normal[f * 3 + k] * b->normal[g * 3 + k];
  if (dot > -OPPOSITE) return PETSC_FALSE;
  VectorGather(dim, num, of_g, list->coords, X);
  away = PetscSqrtReal(ClosestPointOnFacet(dim, (ElementType)b->type[g], X, &b->middle[f * 3], eta));
  return (PetscBool)(away <= (SAME_PLACE + CHORDS * PetscSqrtReal(PetscMax(0, 2 + 2 * dot))) *
                                 PetscMin(b->size[f], b->size[g]));
}

/* Counts facets that lie on another component, with matching nodes or not. */
static PetscErrorCode BoundaryCountFacets_Private(const BodyList *list, const Boundary *b, UnjoinedPieces *found)
{
  const PetscInt  dim = b->dim;
  PetscInt        num_hits;
  const PetscInt *hits;
  PetscReal      *boxes;
  BoxTree         tree;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * dim * b->num, &boxes));
  for (PetscInt f = 0; f < b->num; f++) {
    PetscReal *box = &boxes[2 * dim * f];

    for (PetscInt k = 0; k < dim; k++) {
      box[k]       = PETSC_MAX_REAL;
      box[dim + k] = -PETSC_MAX_REAL;
      for (PetscInt i = 0; i < ElementNumNodes((ElementType)b->type[f]); i++) {
        const PetscReal x = list->coords[b->vertex[f * ELEMENT_MAX_FACET_NODES + i] * dim + k];

        box[k]       = PetscMin(box[k], x - MARGIN * b->size[f]);
        box[dim + k] = PetscMax(box[dim + k], x + MARGIN * b->size[f]);
      }
    }
  }
  PetscCall(BoxTreeCreate(dim, b->num, boxes, &tree));
  for (PetscInt f = 0; f < b->num; f++) {
    PetscReal point[6];
    PetscBool lies = PETSC_FALSE;

    for (PetscInt k = 0; k < 2 * dim; k++) point[k] = b->middle[f * 3 + k % dim];
    PetscCall(BoxTreeQuery(tree, point, &num_hits, &hits));
    for (PetscInt h = 0; h < num_hits && !lies; h++) lies = BoundaryLiesOn_Private(list, b, f, hits[h]);
    if (lies && !found->num_facets++ && !found->num_nodes) PetscCall(PetscArraycpy(found->at, &b->middle[f * 3], dim));
  }
  PetscCall(BoxTreeDestroy(&tree));
  PetscCall(PetscFree(boxes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode UnjoinedPiecesFind(const Extract *x, Scene scene, PetscInt body, const SideNames *names, BodyList *list)
{
  Boundary b = {.dim = list->dim};

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(list->num_vertices, &b.piece));
  list->unjoined.num_pieces = PiecesCount_Private(list, b.piece);
  if (list->unjoined.num_pieces > 1) {
    PetscCall(PetscCalloc2(list->num_vertices, &b.shortest, list->num_vertices, &b.paired));
    PetscCall(BoundaryCollect_Private(x, list, &b));
    PetscCall(BoundaryMarkPaired_Private(scene, body, names, list, &b));
    PetscCall(BoundaryCountNodes_Private(list, &b, &list->unjoined));
    PetscCall(BoundaryCountFacets_Private(list, &b, &list->unjoined));
    PetscCall(PetscFree5(b.type, b.vertex, b.middle, b.normal, b.size));
    PetscCall(PetscFree2(b.shortest, b.paired));
  }
  PetscCall(PetscFree(b.piece));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode UnjoinedPiecesWarn(const SceneBody *body, const BodyList *list)
{
  const UnjoinedPieces *found    = &list->unjoined;
  Warning               touching = {.code   = "unjoined_pieces",
                                    .body   = body->name,
                                    .dim    = list->dim,
                                    .at     = {found->at[0], found->at[1], found->at[2]},
                                    .advice = "join them in Gmsh, by BooleanFragments or Coherence before meshing, or "
                                                            "make them bodies and tie them by a pair"};
  char                  z[32]    = "";

  PetscFunctionBeginUser;
  if (!found->num_nodes && !found->num_facets) PetscFunctionReturn(PETSC_SUCCESS);
  if (list->dim == 3) (void)snprintf(z, sizeof(z), ", %g", (double)found->at[2]);
  PetscCall(WarningAdd(&touching,
                       "body %s is in %d pieces that touch and are not joined: %d nodes coincide with one of another "
                       "piece, and %d facets lie on one, the first at (%g, %g%s)",
                       body->name, (int)found->num_pieces, (int)found->num_nodes, (int)found->num_facets,
                       (double)found->at[0], (double)found->at[1], z));
  PetscFunctionReturn(PETSC_SUCCESS);
}
