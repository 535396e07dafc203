/* simplices.c -- quads and hexahedra as triangles and tetrahedra.

   Faces of neighbouring hexahedra must be cut equally: each at the diagonal from its vertex of the lowest
   number. All tetrahedra of a hexahedron contain its lowest vertex; opposite to it are the triangles of the
   three faces without this vertex. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/simplices.h"
#include "kernel/bisect.h"

enum { MAX_PARTS = 6 };

static PetscReal NodesDistance2_Private(const BodyList *list, PetscInt a, PetscInt b)
{
  PetscReal sum = 0;

  for (PetscInt d = 0; d < list->dim; d++)
    sum += PetscSqr(list->coords[a * list->dim + d] - list->coords[b * list->dim + d]);
  return sum;
}

/* Two triangles at the shorter diagonal after the map; if both are equal, at that of the lowest vertex.
   [out] parts - indices of vertices in the cell */
static PetscInt QuadCut_Private(const BodyList *list, const PetscInt nodes[], PetscInt parts[][BISECT_MAX_VERTICES])
{
  static const PetscReal ALIKE  = 1e-10;
  const PetscReal        first  = NodesDistance2_Private(list, nodes[0], nodes[2]);
  const PetscReal        second = NodesDistance2_Private(list, nodes[1], nodes[3]);
  const PetscBool        lowest = (PetscBool)(PetscMin(nodes[0], nodes[2]) < PetscMin(nodes[1], nodes[3]));
  const PetscInt         shift  = first < (1 - ALIKE) * second || (lowest && first < (1 + ALIKE) * second) ? 0 : 1;

  for (PetscInt i = 0; i < 3; i++) {
    parts[0][i] = (shift + i) % 4;
    parts[1][i] = (shift + i + (i > 0 ? 1 : 0)) % 4;
  }
  return 2;
}

/* Six tetrahedra around the lowest vertex. */
static PetscInt HexCut_Private(const PetscInt nodes[], PetscInt parts[][BISECT_MAX_VERTICES])
{
  PetscInt apex = 0, num = 0;

  for (PetscInt i = 1; i < 8; i++) apex = nodes[i] < nodes[apex] ? i : apex;
  for (PetscInt f = 0; f < ElementNumFacets(ELEMENT_HEX8); f++) {
    const PetscInt *face = ElementFacetNodes(ELEMENT_HEX8, f);
    PetscInt        low  = 0;
    PetscBool       has  = PETSC_FALSE;

    for (PetscInt i = 0; i < 4; i++) {
      low = nodes[face[i]] < nodes[face[low]] ? i : low;
      has = (PetscBool)(has || face[i] == apex);
    }
    for (PetscInt t = 1; t < 3 && !has; t++, num++) {
      parts[num][0] = apex;
      parts[num][1] = face[low];
      parts[num][2] = face[(low + t) % 4];
      parts[num][3] = face[(low + t + 1) % 4];
    }
  }
  return num;
}

static PetscInt CellCut_Private(const BodyList *list, PetscInt cell, PetscInt parts[][BISECT_MAX_VERTICES])
{
  const ElementType linear = ElementLinear((ElementType)list->cell_type[cell]);
  const PetscInt   *nodes  = &list->cell_nodes[cell * ELEMENT_MAX_NODES];

  if (linear == ELEMENT_QUAD4) return QuadCut_Private(list, nodes, parts);
  if (linear == ELEMENT_HEX8) return HexCut_Private(nodes, parts);
  for (PetscInt i = 0; i <= list->dim; i++) parts[0][i] = i;
  return 1;
}

/* The cell's node where a part has one: the middles of edges, diagonals of faces and of the cell are all
   nodes of order 2. */
static PetscInt SimplexFindNode_Private(ElementType type, const PetscInt part[], ElementType simplex, PetscInt node)
{
  const ElementType linear = ElementLinear(simplex);
  PetscReal         phi[ELEMENT_MAX_NODES], at[3] = {0, 0, 0};

  ElementShape(linear, ElementNode(simplex, node), phi, NULL);
  for (PetscInt i = 0; i < ElementNumNodes(linear); i++) {
    for (PetscInt d = 0; d < ElementDim(type); d++) at[d] += phi[i] * ElementNode(type, part[i])[d];
  }
  for (PetscInt k = 0; k < ElementNumNodes(type); k++) {
    PetscBool same = PETSC_TRUE;

    for (PetscInt d = 0; d < ElementDim(type); d++) same = (PetscBool)(same && ElementNode(type, k)[d] == at[d]);
    if (same) return k;
  }
  return -1;
}

/* The facet of a part that lies on a facet of the cell, or -1. [in] face - the cell's vertices there [num] */
static PetscInt SimplexFindFacet_Private(ElementType simplex, const PetscInt part[], PetscInt num,
                                         const PetscInt face[])
{
  const PetscInt size = ElementNumNodes(ElementFacetType(simplex));

  for (PetscInt f = 0; f < ElementNumFacets(simplex); f++) {
    const PetscInt *nodes = ElementFacetNodes(simplex, f);
    PetscInt        on    = 0;

    for (PetscInt i = 0; i < size; i++) {
      for (PetscInt j = 0; j < num; j++) on += part[nodes[i]] == face[j];
    }
    if (on == size) return f;
  }
  return -1;
}

/* Parts of a cell behind those that are there. */
static void BodyListAddParts_Private(const BodyList *old, PetscInt cell, BodyList *list)
{
  const ElementType type    = (ElementType)old->cell_type[cell];
  const ElementType simplex = ElementOfOrder(old->dim == 2 ? ELEMENT_TRI3 : ELEMENT_TET4, ElementOrder(type));
  PetscInt          parts[MAX_PARTS][BISECT_MAX_VERTICES];
  const PetscInt    num = CellCut_Private(old, cell, parts);

  for (PetscInt p = 0; p < num; p++) {
    const PetscInt new = list->num_cells++;

    list->cell_type[new] = simplex;
    if (old->cell_material) list->cell_material[new] = old->cell_material[cell];
    for (PetscInt k = 0; k < ElementNumNodes(simplex); k++)
      list->cell_nodes[new *ELEMENT_MAX_NODES + k] =
          old->cell_nodes[cell * ELEMENT_MAX_NODES + SimplexFindNode_Private(type, parts[p], simplex, k)];
  }
}

/* Facets of parts where the old list has one. [in] first - the first part of every cell */
static void BodyListAddPartFacets_Private(const BodyList *old, const PetscInt first[], BodyList *list)
{
  for (PetscInt e = 0; e < old->num_facets; e++) {
    const PetscInt    cell   = old->facet_cell[e];
    const ElementType linear = ElementLinear((ElementType)old->cell_type[cell]);
    const PetscInt   *face   = ElementFacetNodes(linear, old->facet[e]);
    PetscInt          parts[MAX_PARTS][BISECT_MAX_VERTICES];
    const PetscInt    num = CellCut_Private(old, cell, parts);

    for (PetscInt p = 0; p < num; p++) {
      const PetscInt f = SimplexFindFacet_Private(old->dim == 2 ? ELEMENT_TRI3 : ELEMENT_TET4, parts[p],
                                                  ElementNumNodes(ElementFacetType(linear)), face);

      if (f < 0) continue;
      list->facet_cell[list->num_facets]   = first[cell] + p;
      list->facet[list->num_facets]        = f;
      list->facet_side[list->num_facets++] = old->facet_side[e];
    }
  }
}

PetscBool BodyListCanSplit(const BodyList *list)
{
  PetscBool all = PETSC_TRUE;

  for (PetscInt c = 0; c < list->num_cells; c++)
    all = (PetscBool)(all && ElementNumNodes(ElementLinear((ElementType)list->cell_type[c])) == 1 << list->dim);
  return all;
}

PetscErrorCode BodyListCut(const SceneBody *body, BodyList *list, PetscBool *cut)
{
  BodyList   old    = *list;
  PetscReal *coords = old.coords; // the file's or the box's
  PetscInt  *first, num = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(old.num_cells, &first));
  PetscCall(PetscMalloc1(old.num_vertices * old.dim, &old.coords)); // diagonals are compared after the map
  PetscCall(BodyListMapVertices(list, body, old.coords));
  for (PetscInt c = 0; c < old.num_cells; c++) {
    PetscInt parts[MAX_PARTS][BISECT_MAX_VERTICES];

    first[c] = num;
    num += CellCut_Private(&old, c, parts);
  }
  *cut = (PetscBool)(num > old.num_cells);
  if (*cut) {
    PetscCall(BodyListAllocate(old.dim, num, old.num_nodes, 2 * old.num_facets, list));
    list->num_vertices = old.num_vertices;
    list->num_cells    = 0;
    if (old.cell_material) PetscCall(PetscMalloc1(num, &list->cell_material));
    for (PetscInt c = 0; c < old.num_cells; c++) BodyListAddParts_Private(&old, c, list);
    BodyListAddPartFacets_Private(&old, first, list);
    list->curved_file     = old.curved_file;
    list->straightened    = old.straightened;
    list->num_nonmanifold = old.num_nonmanifold;
    PetscCall(PetscArraycpy(list->nonmanifold, old.nonmanifold, 3));
    PetscCall(PetscArraycpy(list->coords, coords, old.num_nodes * old.dim));
  }
  PetscCall(PetscFree(old.coords));
  old.coords = coords;
  if (*cut) PetscCall(BodyListDestroy(&old));
  PetscCall(PetscFree(first));
  PetscFunctionReturn(PETSC_SUCCESS);
}
