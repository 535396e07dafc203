/* cellmiddles.c -- see the header. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/cellmiddles.h"

/* Sets the node in the middle of an element to the value of serendipity shape functions. The order of the
   element is that of element.h.
   [in] local - which of the cell's nodes the element's are, NULL for the cell itself */
static void MiddleSet_Private(ElementType type, const PetscInt local[], const PetscInt nodes[], PetscInt middle,
                              BodyList *list)
{
  const PetscInt  dim = list->dim, corners = ElementNumNodes(ElementLinear(type)), edges = ElementNumEdges(type);
  const PetscReal of_edge   = 2 / PetscPowRealInt(2, (int)ElementDim(type)); // value of an edge's function there
  const PetscReal of_corner = (1 - edges * of_edge) / corners;

  for (PetscInt d = 0; d < dim; d++) {
    PetscReal x = 0;

    for (PetscInt i = 0; i < corners + edges; i++)
      x += (i < corners ? of_corner : of_edge) * list->coords[nodes[local ? local[i] : i] * dim + d];
    list->coords[middle * dim + d] = x;
  }
}

void CellPlaceMiddles(PetscInt cell, PetscInt num, BodyList *list)
{
  const ElementType type  = (ElementType)list->cell_type[cell];
  const PetscInt   *nodes = &list->cell_nodes[cell * ELEMENT_MAX_NODES];

  for (PetscInt f = 0; f < ElementNumFacets(type); f++) {
    const PetscInt *local  = ElementFacetNodes(type, f);
    const PetscInt  middle = local[ElementNumNodes(ElementFacetType(type)) - 1];

    if (middle >= num) MiddleSet_Private(ElementFacetType(type), local, nodes, nodes[middle], list);
  }
  if (num < ElementNumNodes(type)) MiddleSet_Private(type, NULL, nodes, nodes[ElementNumNodes(type) - 1], list);
}

/* Cells that share a facet compute the same position there, so each may have a node of its own. */
void CellSetMiddles(PetscInt cell, PetscInt num, BodyList *list)
{
  const ElementType type = (ElementType)list->cell_type[cell];

  for (PetscInt i = num; i < ElementNumNodes(type); i++)
    list->cell_nodes[cell * ELEMENT_MAX_NODES + i] = list->num_nodes++;
  CellPlaceMiddles(cell, num, list);
}
