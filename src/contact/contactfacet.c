/* contactfacet.c -- one facet of a side: its nodes, a box around it, its size. */
#include "base/compat.h"
#include "contact/contactfacet.h"
#include "kernel/vector.h"

void ContactFacetCoordinates(const Level *level, const Facets *facets, PetscInt f, PetscReal X[])
{
  VectorGather(level->dim, ElementNumNodes(facets->type[f]), &facets->nodes[f * ELEMENT_MAX_FACET_NODES], level->coords,
               X);
}

/* Vertices stay. The point at the middle of an edge is 2 x - (mean of its ends). With that at the middle of a
   facet, the facet is a tensor product of three Bernstein polynomials in each direction. They are positive
   and sum to one. */
void ContactFacetHull(PetscInt dim, ElementType type, const PetscReal X[], PetscReal hull[])
{
  const PetscInt num_nodes = ElementNumNodes(type), num_vertices = ElementNumNodes(ElementLinear(type));
  const PetscInt num_edges = num_nodes > num_vertices ? ElementNumEdges(type) : 0, centre = num_vertices + num_edges;

  for (PetscInt k = 0; k < dim; k++) {
    PetscReal vertices = 0, middles = 0;
    for (PetscInt i = 0; i < num_vertices; i++) {
      hull[i * dim + k] = X[i * dim + k];
      vertices += X[i * dim + k];
    }
    for (PetscInt e = 0; e < num_edges; e++) {
      const PetscInt *ends = ElementEdgeNodes(type, e), middle = (num_vertices + e) * dim + k;
      hull[middle] = 2 * X[middle] - 0.5 * (X[ends[0] * dim + k] + X[ends[1] * dim + k]);
      middles += X[middle];
    }
    if (centre < num_nodes) hull[centre * dim + k] = 4 * X[centre * dim + k] - middles + 0.25 * vertices;
  }
}

void ContactFacetBox(PetscInt dim, ElementType type, const PetscReal X[], PetscReal box[])
{
  PetscReal hull[3 * ELEMENT_MAX_FACET_NODES];

  ContactFacetHull(dim, type, X, hull);
  for (PetscInt k = 0; k < dim; k++) {
    box[k] = box[dim + k] = hull[k];
    for (PetscInt i = 1; i < ElementNumNodes(type); i++) {
      box[k]       = PetscMin(box[k], hull[i * dim + k]);
      box[dim + k] = PetscMax(box[dim + k], hull[i * dim + k]);
    }
  }
}

PetscErrorCode ContactFacetMaxSize(const Level *level, const Facets *facets, PetscReal *size)
{
  PetscReal X[3 * ELEMENT_MAX_FACET_NODES];

  PetscFunctionBeginUser;
  *size = 0;
  for (PetscInt f = 0; f < facets->num; f++) {
    ContactFacetCoordinates(level, facets, f, X);
    *size = PetscMax(*size, ElementLongestEdge(facets->type[f], level->dim, X));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, size, 1, MPIU_REAL, MPIU_MAX, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}
