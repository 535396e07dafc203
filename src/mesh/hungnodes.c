/* hungnodes.c -- nodes of small cells on an edge or a face of a larger cell. */
#include "base/compat.h"
#include "mesh/hungnodes.h"
#include "mesh/tree.h"

enum { FACE = 4 }; /* corners of a face, and its edges */

static const PetscInt *HungNodesVertices_Private(const HungNodes *hung, PetscInt cell)
{
  return &hung->first[cell * hung->stride];
}

/* Appends a node. [in] at - [dim]; [out] number */
static PetscErrorCode HungNodesAppend_Private(HungNodes *hung, PetscInt cell, PetscInt dim, PetscInt entity,
                                              const PetscReal at[], PetscInt *number)
{
  PetscFunctionBeginUser;
  if (hung->num == hung->room) {
    hung->room = 2 * hung->room + 64;
    PetscCall(PetscRealloc((size_t)hung->room * sizeof(HungNode), &hung->node));
  }
  *number             = hung->num++;
  hung->node[*number] = (HungNode){.cell = cell, .dim = dim, .entity = entity};
  for (PetscInt k = 0; k < dim; k++) hung->node[*number].place[k] = at[k];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The nodes on an edge with a vertex in its middle. */
static PetscErrorCode HungNodesAddEdge_Private(HungNodes *hung, PetscInt cell, PetscInt e, const PetscInt ends[],
                                               PetscInt middle)
{
  PetscReal place = 0.5;
  PetscInt  number;

  PetscFunctionBeginUser;
  PetscCall(HungNodesAppend_Private(hung, cell, 1, e, &place, &hung->vertex[middle]));
  for (PetscInt i = 0; i < 2; i++) {
    place = 0.25 + 0.5 * (PetscReal)i;
    PetscCall(HungNodesAppend_Private(hung, cell, 1, e, &place, &number));
    PetscCall(EdgeTableAdd(&hung->edge, ends[i], middle, number));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The nodes inside of a face with a vertex in its middle. [in] corner, of_edge - its corners and the middles
   of its edges, around it [4] */
static PetscErrorCode HungNodesAddFace_Private(HungNodes *hung, PetscInt cell, PetscInt f, const PetscInt corner[],
                                               const PetscInt of_edge[], PetscInt middle)
{
  const PetscReal *centre = ElementNode(ELEMENT_QUAD9, ElementNumNodes(ELEMENT_QUAD9) - 1);
  PetscReal        place[2];
  PetscInt         number;

  PetscFunctionBeginUser;
  PetscCall(HungNodesAppend_Private(hung, cell, 2, f, centre, &hung->vertex[middle]));
  for (PetscInt k = 0; k < 2 * FACE; k++) { // towards a corner, or the middle of an edge
    for (PetscInt d = 0; d < 2; d++) place[d] = (centre[d] + ElementNode(ELEMENT_QUAD9, k)[d]) / 2;
    PetscCall(HungNodesAppend_Private(hung, cell, 2, f, place, &number));
    PetscCall(
        EdgeTableAdd(k < FACE ? &hung->face : &hung->edge, k < FACE ? corner[k] : of_edge[k - FACE], middle, number));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds what hangs on the edges of a cell. [in,out] seen - edges of other cells */
static PetscErrorCode HungNodesAddEdges_Private(HungNodes *hung, const EdgeTable *middles, PetscInt cell,
                                                EdgeTable *seen)
{
  const ElementType type   = SplitElement(hung->mesh);
  const PetscInt   *vertex = HungNodesVertices_Private(hung, cell);

  PetscFunctionBeginUser;
  for (PetscInt e = 0; e < ElementNumEdges(type); e++) {
    const PetscInt *local = ElementEdgeNodes(type, e), ends[2] = {vertex[local[0]], vertex[local[1]]};
    const PetscInt  middle = EdgeTableFind(middles, ends[0], ends[1]);

    if (middle < 0 || EdgeTableFind(seen, ends[0], ends[1]) >= 0) continue;
    PetscCall(EdgeTableAdd(seen, ends[0], ends[1], e));
    PetscCall(HungNodesAddEdge_Private(hung, cell, e, ends, middle));
    if (hung->mesh->dim > 2) continue;
    PetscCall(EdgeTableAdd(&hung->facet, ends[0], ends[1], e));
    for (PetscInt i = 0; i < 2; i++) PetscCall(EdgeTableAdd(&hung->facet, ends[i], middle, e));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds what hangs on the faces of a hexahedron. */
static PetscErrorCode HungNodesAddFaces_Private(HungNodes *hung, const EdgeTable *middles, PetscInt cell)
{
  const PetscInt *vertex = HungNodesVertices_Private(hung, cell);

  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < ElementNumFacets(ELEMENT_HEX8) && hung->mesh->dim == 3; f++) {
    const PetscInt *local = ElementFacetNodes(ELEMENT_HEX8, f);
    PetscInt        corner[FACE], of_edge[FACE], middle;

    for (PetscInt i = 0; i < FACE; i++) corner[i] = vertex[local[i]];
    middle = SplitFindFace(middles, corner, of_edge);
    if (middle < 0) continue;
    PetscCall(HungNodesAddFace_Private(hung, cell, f, corner, of_edge, middle));
    PetscCall(EdgeTableAdd(&hung->facet, corner[0], corner[2], f));
    for (PetscInt i = 0; i < FACE; i++) PetscCall(EdgeTableAdd(&hung->facet, corner[i], middle, f));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HungNodesCreate(const Tree *tree, const PetscInt first[], PetscInt stride, HungNodes *hung)
{
  const Bisection *mesh = &tree->mesh;
  EdgeTable        middles, seen = {.room = 0};

  PetscFunctionBeginUser;
  *hung = (HungNodes){.mesh = mesh, .first = first, .stride = stride};
  if (!TreeIsKept(tree)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(mesh->num_vertices, &hung->vertex));
  for (PetscInt v = 0; v < mesh->num_vertices; v++) hung->vertex[v] = -1;
  PetscCall(SplitGetMiddles(mesh, &middles));
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    PetscCall(HungNodesAddEdges_Private(hung, &middles, c, &seen));
    PetscCall(HungNodesAddFaces_Private(hung, &middles, c));
  }
  PetscCall(EdgeTableDestroy(&seen));
  PetscCall(EdgeTableDestroy(&middles));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HungNodesDestroy(HungNodes *hung)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(hung->node));
  PetscCall(PetscFree(hung->vertex));
  PetscCall(EdgeTableDestroy(&hung->edge));
  PetscCall(EdgeTableDestroy(&hung->face));
  PetscCall(EdgeTableDestroy(&hung->facet));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What a table has for a face, by one of its diagonals, or -1. */
static PetscInt FaceFind_Private(const EdgeTable *table, const PetscInt vertex[], PetscInt facet)
{
  const PetscInt *local = ElementFacetNodes(ELEMENT_HEX8, facet);
  const PetscInt  found = EdgeTableFind(table, vertex[local[0]], vertex[local[2]]);

  return found < 0 ? EdgeTableFind(table, vertex[local[1]], vertex[local[3]]) : found;
}

PetscInt HungNodesFind(const HungNodes *hung, PetscInt cell, PetscInt node)
{
  const ElementType type    = SplitElement(hung->mesh);
  const PetscInt    corners = hung->mesh->corners, edges = ElementNumEdges(type);
  const PetscInt   *vertex = HungNodesVertices_Private(hung, cell);

  if (!hung->num) return -1;
  if (node < corners) return hung->vertex[vertex[node]];
  if (node < corners + edges) {
    const PetscInt *ends = ElementEdgeNodes(type, node - corners);

    return EdgeTableFind(&hung->edge, vertex[ends[0]], vertex[ends[1]]);
  }
  if (type == ELEMENT_QUAD4 || node == corners + edges + ElementNumFacets(type)) return -1; // inside the cell
  return FaceFind_Private(&hung->face, vertex, node - corners - edges);
}

PetscBool HungNodesHasFacet(const HungNodes *hung, PetscInt cell, PetscInt facet)
{
  const PetscInt *vertex = HungNodesVertices_Private(hung, cell),
                 *local  = ElementFacetNodes(ELEMENT_QUAD4, facet % FACE);

  if (hung->mesh->dim == 3) return (PetscBool)(FaceFind_Private(&hung->facet, vertex, facet) >= 0);
  return (PetscBool)(EdgeTableFind(&hung->facet, vertex[local[0]], vertex[local[1]]) >= 0);
}

void HungNodeShape(const HungNode *node, ElementType type, PetscInt *num, PetscInt local[], PetscReal phi[])
{
  const ElementType line = ElementOfOrder(ELEMENT_LINE2, ElementOrder(type));
  const ElementType on   = node->dim == 1 ? line : ElementFacetType(type);

  *num = ElementNumNodes(on);
  ElementShape(on, node->place, phi, NULL); // places are dyadic: zeros are exact
  for (PetscInt i = 0; i < *num; i++) {
    if (node->dim == 2)
      local[i] = ElementFacetNodes(type, node->entity)[i];
    else
      local[i] = i < 2 ? ElementEdgeNodes(type, node->entity)[i] : ElementNumNodes(ElementLinear(type)) + node->entity;
  }
}
