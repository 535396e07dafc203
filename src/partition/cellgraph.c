/* cellgraph.c -- the graph of cells, with edges across facets and across contact. */
#include "base/compat.h"
#include "kernel/boxtree.h"
#include "kernel/frame.h"
#include "partition/cellgraph.h"

enum { MAX_WEIGHT = 10 }; /* of an edge across short cells: how many times longer they are at most */

PetscErrorCode CellGraphDestroy(CellGraph *graph)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(graph->end));
  PetscCall(PetscFree(graph->weight));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Edges from a cell to itself, where a body touches itself in a corner, are omitted. */
PetscErrorCode CellGraphAddEdge(CellGraph *edges, PetscInt a, PetscInt b, PetscInt weight)
{
  PetscFunctionBeginUser;
  if (a == b) PetscFunctionReturn(PETSC_SUCCESS);
  if (edges->num == edges->max) {
    edges->max = PetscMax(1024, 2 * edges->max);
    PetscCall(PetscRealloc(edges->max * 2 * sizeof(PetscInt), &edges->end));
    PetscCall(PetscRealloc(edges->max * sizeof(PetscInt), &edges->weight));
  }
  edges->end[2 * edges->num]     = a;
  edges->end[2 * edges->num + 1] = b;
  edges->weight[edges->num++]    = weight;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscInt CellGraphWeight(PetscReal distance, PetscReal most)
{
  return most >= MAX_WEIGHT * distance ? MAX_WEIGHT : (PetscInt)(most / distance);
}

/* The box around a facet; returns its longest extent.
   [out] X - its nodes [num_nodes][dim]; [out] box - [2][dim] */
static PetscReal FacetGetBox_Private(const Level *level, const Facets *facets, PetscInt f, PetscReal X[],
                                     PetscReal box[])
{
  const PetscInt num = ElementNumNodes(facets->type[f]), dim = level->dim;
  PetscReal      extent = 0;

  for (PetscInt d = 0; d < dim; d++) {
    box[d]       = PETSC_MAX_REAL;
    box[dim + d] = -PETSC_MAX_REAL;
    for (PetscInt i = 0; i < num; i++) {
      const PetscReal x = level->coords[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i] * dim + d];

      X[i * dim + d] = x;
      box[d]         = PetscMin(box[d], x);
      box[dim + d]   = PetscMax(box[dim + d], x);
    }
    extent = PetscMax(extent, box[dim + d] - box[d]);
  }
  return extent;
}

/* The range of direction . x over points, widened. [in] X - [num][dim] */
static BoxSlab SlabAround_Private(PetscInt dim, PetscInt num, const PetscReal X[], const PetscReal direction[],
                                  PetscReal widen)
{
  BoxSlab slab = {.lower = PETSC_MAX_REAL, .upper = -PETSC_MAX_REAL};

  for (PetscInt d = 0; d < dim; d++) slab.direction[d] = direction[d];
  for (PetscInt i = 0; i < num; i++) {
    PetscReal along = 0;

    for (PetscInt d = 0; d < dim; d++) along += direction[d] * X[i * dim + d];
    slab.lower = PetscMin(slab.lower, along);
    slab.upper = PetscMax(slab.upper, along);
  }
  slab.lower -= widen;
  slab.upper += widen;
  return slab;
}

/* Query for the facets that a facet may touch: within the reach along its normal, and hardly beside it. So a
   long reach does not find more of the smaller facets beside. [in] reach - negative: a facet's own size */
static PetscErrorCode FacetQuery_Private(const Level *level, const Facets *facets, PetscInt f, PetscReal reach,
                                         BoxTree tree, PetscInt *num_hits, const PetscInt *hits[])
{
  const ElementType type = facets->type[f];
  const PetscInt    dim = level->dim, num = ElementNumNodes(type), num_vertices = ElementNumNodes(ElementLinear(type));
  PetscReal         X[3 * ELEMENT_MAX_FACET_NODES], box[6], xi[2] = {0, 0}, phi[ELEMENT_MAX_NODES], normal[3], Q[9];
  const PetscReal   extent = FacetGetBox_Private(level, facets, f, X, box), widen = reach >= 0 ? reach : extent;
  BoxSlab           slabs[3];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num_vertices; i++) {
    for (PetscInt k = 0; k < dim - 1; k++) xi[k] += ElementNode(type, i)[k] / (PetscReal)num_vertices;
  }
  (void)ElementSurface(type, X, xi, NULL, phi, normal);
  FrameFromNormal(dim, normal, Q);
  for (PetscInt k = 0; k < dim; k++) {
    slabs[k] = SlabAround_Private(dim, num, X, &Q[k * dim], k == 0 ? widen : extent);
    box[k] -= PetscMax(widen, extent);
    box[dim + k] += PetscMax(widen, extent);
  }
  PetscCall(BoxTreeQuerySlabs(tree, box, dim, slabs, num_hits, hits));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CellGraphAddContact(const Level *level, const Facets *nonmortar, const Facets *mortar, PetscReal reach,
                                   PetscInt weight, CellGraph *graph)
{
  PetscReal *boxes, X[3 * ELEMENT_MAX_FACET_NODES];
  BoxTree    tree;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(mortar->num * 2 * level->dim, &boxes));
  for (PetscInt f = 0; f < mortar->num; f++) (void)FacetGetBox_Private(level, mortar, f, X, &boxes[f * 2 * level->dim]);
  PetscCall(BoxTreeCreate(level->dim, mortar->num, boxes, &tree));
  for (PetscInt f = 0; f < nonmortar->num; f++) {
    const PetscInt *hits;
    PetscInt        num_hits;

    PetscCall(FacetQuery_Private(level, nonmortar, f, reach, tree, &num_hits, &hits));
    for (PetscInt h = 0; h < num_hits; h++)
      PetscCall(CellGraphAddEdge(graph, nonmortar->cell[f], mortar->cell[hits[h]], weight));
    if (graph->contact) graph->contact[nonmortar->cell[f]]++;
  }
  PetscCall(BoxTreeDestroy(&tree));
  PetscCall(PetscFree(boxes));
  PetscFunctionReturn(PETSC_SUCCESS);
}
