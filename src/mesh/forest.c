/* forest.c -- the cells of a body under bisection, or under splitting. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "level/leveltables.h"
#include "mesh/forest.h"
#include "mesh/hungnodes.h"
#include "mesh/meshforest.h"
#include "mesh/tree.h"
#include "mesh/treearcs.h"

/* Largest number of bisections of a tangled cell. Each halving of a curved edge leaves a quarter of its rise;
   long thin cells along a circle need more than three. */
enum { UNTANGLE_TIMES = 12 };

/* The facet that belongs to a vertex: opposite to it in a simplex, of the same number in other cells. */
static PetscInt FacetOfVertex_Private(ElementType linear, PetscInt vertex)
{
  if (ElementNumNodes(linear) > ElementDim(linear) + 1) return vertex < ElementNumFacets(linear) ? vertex : -1;
  for (PetscInt f = 0; f < ElementNumFacets(linear); f++) {
    const PetscInt *nodes = ElementFacetNodes(linear, f);
    PetscBool       has   = PETSC_FALSE;

    for (PetscInt i = 0; i < ElementNumNodes(ElementFacetType(linear)); i++)
      has = (PetscBool)(has || nodes[i] == vertex);
    if (!has) return f;
  }
  return -1;
}

/* Numbers the facets that have sides.
   [out] facets - number of the facet of each vertex, -1 without a side [num_cells][num] */
static PetscErrorCode TreeNumberFacets_Private(Tree *tree, PetscInt num, PetscInt facets[])
{
  const BodyList *list = &tree->list;

  PetscFunctionBeginUser;
  tree->num_entries = list->num_facets;
  PetscCall(PetscMalloc2(list->num_facets, &tree->side, list->num_facets, &tree->another));
  for (PetscInt i = 0; i < list->num_cells * num; i++) facets[i] = -1;
  for (PetscInt e = 0; e < list->num_facets; e++) {
    const PetscInt    cell   = list->facet_cell[e];
    const ElementType linear = ElementLinear((ElementType)list->cell_type[cell]);

    for (PetscInt v = 0; v < num; v++) {
      if (FacetOfVertex_Private(linear, v) != list->facet[e]) continue;
      tree->side[e]          = list->facet_side[e];
      tree->another[e]       = facets[cell * num + v];
      facets[cell * num + v] = e;
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The index of a vertex among those of a cell. */
static PetscInt PlaceOf_Private(PetscInt num, const PetscInt vertices[], PetscInt vertex)
{
  PetscInt i = 0;

  while (i < num && vertices[i] != vertex) i++;
  return i;
}

/* Lists the facets with sides: parts of those of the first list. */
static PetscErrorCode TreeListFacets_Private(const Tree *tree, BodyList *list)
{
  const Bisection *mesh = &tree->mesh;
  PetscInt         num  = 0;

  PetscFunctionBeginUser;
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) PetscCall(PetscMalloc3(num, &list->facet_cell, num, &list->facet, num, &list->facet_side));
    num = 0;
    for (PetscInt c = 0; c < mesh->num_cells; c++) {
      for (PetscInt v = 0; v < mesh->corners; v++) {
        for (PetscInt e = mesh->facet[c][v]; e >= 0; e = tree->another[e], num++) {
          PetscInt place;

          if (!pass) continue;
          place = PlaceOf_Private(mesh->corners, &list->cell_nodes[c * ELEMENT_MAX_NODES], mesh->vertex[c][v]);
          list->facet_cell[num] = c;
          list->facet[num]      = FacetOfVertex_Private(ElementLinear((ElementType)list->cell_type[c]), place);
          list->facet_side[num] = tree->side[e];
        }
      }
    }
  }
  list->num_facets = num;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Positions after the map of the nodes of a cell, as one of the given type.
   [out] X - [nodes of type][dim]; [out] finite - whether the map is finite at all of them */
static PetscErrorCode CellMapNodes_Private(const BodyList *list, const SceneBody *body, PetscInt cell, ElementType type,
                                           PetscReal X[], PetscBool *finite)
{
  const ElementType own   = (ElementType)list->cell_type[cell];
  const PetscInt   *nodes = &list->cell_nodes[cell * ELEMENT_MAX_NODES], dim = list->dim;
  PetscReal         phi[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  *finite = PETSC_TRUE;
  for (PetscInt k = 0; k < ElementNumNodes(type) && *finite; k++) {
    PetscReal x[3] = {0, 0, 0};

    ElementShape(own, ElementNode(type, k), phi, NULL);
    for (PetscInt i = 0; i < ElementNumNodes(own); i++) {
      for (PetscInt d = 0; d < dim; d++) x[d] += phi[i] * list->coords[nodes[i] * dim + d];
    }
    if (body->map)
      PetscCall(ExpressionTry(body->map, dim, x, &X[k * dim], finite));
    else
      PetscCall(PetscArraycpy(&X[k * dim], x, dim));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A list of a tree, and its nodes that hang: none in the first list. */
typedef struct {
  const Tree      *tree;
  const BodyList  *list;
  const SceneBody *body;
  HungNodes        hung;
} MappedList;

/* Moves the nodes of a cell that hang to where they hang.
   [in,out] X - of the cell, as one of the given type [nodes of type][dim] */
static PetscErrorCode CellHangNodes_Private(const MappedList *mapped, PetscInt cell, ElementType type, PetscReal X[])
{
  const PetscInt dim = mapped->list->dim;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < ElementNumNodes(type); k++) {
    const PetscInt found = HungNodesFind(&mapped->hung, cell, k);
    PetscReal      Y[3 * ELEMENT_MAX_NODES], phi[ELEMENT_MAX_NODES];
    PetscInt       num, local[ELEMENT_MAX_NODES];
    PetscBool      finite;

    if (found < 0) continue;
    PetscCall(CellMapNodes_Private(mapped->list, mapped->body, mapped->hung.node[found].cell, type, Y, &finite));
    HungNodeShape(&mapped->hung.node[found], type, &num, local, phi);
    for (PetscInt d = 0; d < dim; d++) {
      X[k * dim + d] = 0;
      for (PetscInt i = 0; i < num; i++) X[k * dim + d] += phi[i] * Y[local[i] * dim + d];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The smallest det J of a cell. */
static PetscErrorCode CellMinJacobian_Private(const MappedList *mapped, PetscInt cell, PetscReal *jacobian)
{
  const BodyList   *list = mapped->list;
  const ElementType type = ElementOfOrder((ElementType)list->cell_type[cell], mapped->body->order);
  PetscInt          order[ELEMENT_MAX_NODES];
  PetscReal         X[3 * ELEMENT_MAX_NODES], Y[3 * ELEMENT_MAX_NODES];
  PetscBool         finite;

  PetscFunctionBeginUser;
  PetscCall(CellMapNodes_Private(list, mapped->body, cell, type, X, &finite));
  if (mapped->hung.num && finite) PetscCall(CellHangNodes_Private(mapped, cell, type, X));
  for (PetscInt k = 0; k < ElementNumNodes(type); k++) order[k] = k;
  if (mapped->tree->reversed) CellReverse(type, order);
  for (PetscInt k = 0; k < ElementNumNodes(type); k++)
    PetscCall(PetscArraycpy(&Y[k * list->dim], &X[order[k] * list->dim], list->dim));
  *jacobian = finite ? ElementMinJacobian(type, Y) : 1; // the user error is that of the level's nodes
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Finds whether the map turns most cells inside out. */
static PetscErrorCode TreeSetSense_Private(Tree *tree, const SceneBody *body)
{
  const MappedList mapped = {.tree = tree, .list = &tree->list, .body = body};
  PetscInt         num    = 0;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < tree->list.num_cells && body->map; c++) {
    PetscReal jacobian;

    PetscCall(CellMinJacobian_Private(&mapped, c, &jacobian));
    num += jacobian < 0 ? 1 : -1;
  }
  tree->reversed = (PetscBool)(num > 0);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode TreeCreate(Scene scene, PetscInt body, const SideNames *names, BodyList *list, Tree *tree)
{
  const PetscInt  num  = list->num_cells ? ElementNumNodes(ElementLinear((ElementType)list->cell_type[0])) : 0;
  const PetscBool kept = (PetscBool)(num > list->dim + 1);
  PetscInt       *cells, *facets;
  PetscReal      *coords;

  PetscFunctionBeginUser;
  *tree = (Tree){.list = *list};
  *list = (BodyList){0};
  PetscCall(PetscMalloc3(tree->list.num_cells * num, &cells, tree->list.num_cells * num, &facets,
                         tree->list.num_vertices * tree->list.dim, &coords));
  for (PetscInt c = 0; c < tree->list.num_cells; c++) {
    for (PetscInt i = 0; i < num; i++) cells[c * num + i] = tree->list.cell_nodes[c * ELEMENT_MAX_NODES + i];
  }
  PetscCall(TreeNumberFacets_Private(tree, num, facets));
  PetscCall(BodyListMapVertices(&tree->list, &scene->bodies[body], coords));
  if (kept)
    PetscCall(SplitCreate(tree->list.dim, tree->list.num_vertices, tree->list.num_cells, cells, facets, &tree->mesh));
  else
    PetscCall(BisectionCreate(tree->list.dim, tree->list.num_vertices, tree->list.num_cells, cells, facets, coords,
                              &tree->mesh));
  PetscCall(PetscFree3(cells, facets, coords));
  PetscCall(TreeArcsCreate(scene, body, names, tree));
  PetscCall(TreeSetSense_Private(tree, &scene->bodies[body]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode TreeDestroy(Tree *tree)
{
  PetscFunctionBeginUser;
  PetscCall(BisectionDestroy(&tree->mesh));
  PetscCall(BodyListDestroy(&tree->list));
  PetscCall(TreeArcsDestroy(&tree->arcs));
  PetscCall(PetscFree2(tree->side, tree->another));
  PetscCall(PetscFree(tree->before));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A cell and its parent: vertices of both in the order of their elements, and those of the parent in the
   order of the bisection. */
typedef struct {
  const Bisection *mesh;
  PetscInt         cell;
  const PetscInt  *own, *parent, *before;
} Child;

/* Reference coordinates of a node of a child in its parent. [out] xi - [dim] */
static void ChildNodePlace_Private(const Child *child, ElementType type, PetscInt node, PetscReal xi[])
{
  const Bisection  *mesh   = child->mesh;
  const ElementType linear = ElementLinear(type);
  const PetscInt    num    = mesh->corners;
  PetscReal         phi[ELEMENT_MAX_NODES];

  ElementShape(linear, ElementNode(type, node), phi, NULL);
  for (PetscInt d = 0; d < mesh->dim; d++) xi[d] = 0;
  for (PetscInt i = 0; i < num; i++) {
    const PetscReal share = phi[PlaceOf_Private(num, child->own, mesh->vertex[child->cell][i])];

    for (PetscInt j = 0; j < num; j++) {
      const PetscReal *corner = ElementNode(linear, PlaceOf_Private(num, child->parent, child->before[j]));

      for (PetscInt d = 0; d < mesh->dim; d++) xi[d] += share * BisectionGetPlace(mesh, child->cell, i)[j] * corner[d];
    }
  }
}

/* Position of a node of a child, by the shape functions of its parent. */
static void TreeSetNode_Private(const Tree *tree, const BodyList *old, PetscInt child, PetscInt node, BodyList *list)
{
  const PetscInt    parent = tree->mesh.parent[child], dim = tree->mesh.dim;
  const ElementType type  = (ElementType)old->cell_type[parent];
  const PetscInt   *nodes = &old->cell_nodes[parent * ELEMENT_MAX_NODES],
                 *own     = &list->cell_nodes[child * ELEMENT_MAX_NODES];
  PetscReal  xi[3], phi[ELEMENT_MAX_NODES];
  PetscReal *x = &list->coords[own[node] * dim];

  ChildNodePlace_Private(&(Child){&tree->mesh, child, own, nodes, tree->before[parent]}, type, node, xi);
  ElementShape(type, xi, phi, NULL);
  for (PetscInt d = 0; d < dim; d++) {
    x[d] = 0;
    for (PetscInt k = 0; k < ElementNumNodes(type); k++) x[d] += phi[k] * old->coords[nodes[k] * dim + d];
  }
}

/* Creates the list of the bisected mesh. Each cell of order 2 has middle nodes of its own; the DM joins those
   that coincide. */
static PetscErrorCode TreeList_Private(Tree *tree, const BodyList *old, BodyList *list)
{
  const Bisection *mesh = &tree->mesh;
  const PetscInt   dim  = mesh->dim;
  PetscInt         node = mesh->num_vertices;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < mesh->num_cells; c++)
    node += ElementNumNodes((ElementType)old->cell_type[mesh->parent[c]]) - mesh->corners;
  *list              = *old;
  list->num_cells    = mesh->num_cells;
  list->num_vertices = mesh->num_vertices;
  list->num_nodes    = node;
  list->facet_cell = list->facet = list->facet_side = list->cell_material = NULL;
  PetscCall(PetscMalloc3(mesh->num_cells, &list->cell_type, mesh->num_cells * ELEMENT_MAX_NODES, &list->cell_nodes,
                         node * dim, &list->coords));
  PetscCall(PetscArraycpy(list->coords, old->coords, old->num_vertices * dim));
  if (old->cell_material) PetscCall(PetscMalloc1(mesh->num_cells, &list->cell_material));
  for (PetscInt c = 0; c < mesh->num_cells && old->cell_material; c++)
    list->cell_material[c] = old->cell_material[mesh->parent[c]];
  node = mesh->num_vertices;
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    const ElementType type = (ElementType)old->cell_type[mesh->parent[c]];

    PetscInt *nodes = &list->cell_nodes[c * ELEMENT_MAX_NODES];

    list->cell_type[c] = type;
    for (PetscInt k = 0; k < ElementNumNodes(type); k++) nodes[k] = k < mesh->corners ? mesh->vertex[c][k] : node++;
    if (BisectionIsTurned(mesh, c)) { // all cells of a body have the same sense
      nodes[dim - 1] = mesh->vertex[c][dim];
      nodes[dim]     = mesh->vertex[c][dim - 1];
    }
    for (PetscInt k = 0; k < ElementNumNodes(type); k++)
      if (nodes[k] >= old->num_vertices) TreeSetNode_Private(tree, old, c, k, list);
  }
  PetscCall(TreeListFacets_Private(tree, list));
  PetscCall(TreeArcsApply(tree, list));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks new cells that are tangled. [out] marked - [num_cells]; [out] any - whether there are such cells */
static PetscErrorCode TreeMarkTangled_Private(const Tree *tree, const SceneBody *body, const BodyList *list,
                                              PetscInt marked[], PetscBool *any)
{
  const Bisection *mesh   = &tree->mesh;
  MappedList       mapped = {.tree = tree, .list = list, .body = body};

  PetscFunctionBeginUser;
  *any = PETSC_FALSE;
  PetscCall(HungNodesCreate(tree, list->cell_nodes, ELEMENT_MAX_NODES, &mapped.hung));
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    PetscBool same;
    PetscReal jacobian;

    marked[c] = 0;
    PetscCall(PetscArraycmp(mesh->vertex[c], tree->before[mesh->parent[c]], mesh->corners, &same));
    if (same) continue;
    PetscCall(CellMinJacobian_Private(&mapped, c, &jacobian));
    marked[c] = jacobian <= 0;
    *any      = (PetscBool)(*any || marked[c]);
  }
  PetscCall(HungNodesDestroy(&mapped.hung));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Refines tangled cells again: smaller cells of a curve are closer to straight ones. */
static PetscErrorCode TreeUntangle_Private(Tree *tree, const SceneBody *body, BodyList *list)
{
  PetscBool any = PETSC_TRUE;
  PetscInt *marked;

  PetscFunctionBeginUser;
  for (PetscInt times = 0; times < UNTANGLE_TIMES && any; times++) {
    PetscCall(PetscMalloc1(tree->mesh.num_cells, &marked));
    PetscCall(TreeMarkTangled_Private(tree, body, list, marked, &any));
    if (any) {
      PetscCall(BodyListDestroy(list));
      PetscCall(TreeIsKept(tree) ? SplitRefineMore(&tree->mesh, marked) : BisectionRefineMore(&tree->mesh, marked));
      PetscCall(TreeList_Private(tree, &tree->list, list));
    }
    PetscCall(PetscFree(marked));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode TreeRefine(Tree *tree, const SceneBody *body, const PetscInt marked[])
{
  BodyList list;

  PetscFunctionBeginUser;
  PetscCall(PetscFree(tree->before));
  tree->num_before = tree->mesh.num_cells;
  PetscCall(PetscMalloc1(tree->num_before, &tree->before));
  PetscCall(PetscArraycpy(tree->before, tree->mesh.vertex, tree->num_before));
  PetscCall(TreeIsKept(tree) ? SplitRefine(&tree->mesh, marked) : BisectionRefine(&tree->mesh, marked));
  PetscCall(TreeList_Private(tree, &tree->list, &list));
  if (body->map || list.curved_file || tree->arcs.any) PetscCall(TreeUntangle_Private(tree, body, &list));
  PetscCall(BodyListDestroy(&tree->list));
  tree->list = list;
  PetscFunctionReturn(PETSC_SUCCESS);
}

void TreeWeights(const Tree *tree, PetscInt child, const ForestCell *fine, const ForestCell *coarse,
                 PetscReal weights[])
{
  const ElementType type = (ElementType)fine->type, from = (ElementType)coarse->type;
  const Child       in = {&tree->mesh, child, fine->vertex, coarse->vertex, tree->before[tree->mesh.parent[child]]};

  for (PetscInt k = 0; k < ElementNumNodes(type); k++) {
    PetscReal xi[3];

    ChildNodePlace_Private(&in, type, k, xi);
    ElementShape(from, xi, &weights[k * ElementNumNodes(from)], NULL);
  }
}
