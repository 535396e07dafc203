/* cellgraph.h -- the graph of cells, with edges across facets and across contact. Nothing is collective. */
#ifndef MORTISE_CELLGRAPH_H
#define MORTISE_CELLGRAPH_H

#include "level/level.h"

/* Weighted edges of the graph of cells, each once: first those across facets. */
typedef struct {
  PetscInt        num, max, num_neighbours;
  PetscInt       *end;     /* [max][2] */
  PetscInt       *weight;  /* [max] */
  PetscInt       *contact; /* facets of nonmortar sides, by cell, or NULL; the caller's */
  const PetscInt *bricks;  /* of each cell, NULL: one; the caller's */
} CellGraph;

/* Appends an edge. */
PetscErrorCode CellGraphAddEdge(CellGraph *graph, PetscInt a, PetscInt b, PetscInt weight);
/* The weight of an edge across a facet.
   [in] distance - of the middles of its cells; most - the largest one to any neighbour of both */
PetscInt CellGraphWeight(PetscReal distance, PetscReal most);
/* Appends edges between cells whose facets may touch.
   [in] level - its dim and coords; reach - negative: a facet's own size */
PetscErrorCode CellGraphAddContact(const Level *level, const Facets *nonmortar, const Facets *mortar, PetscReal reach,
                                   PetscInt weight, CellGraph *graph);
PetscErrorCode CellGraphDestroy(CellGraph *graph);

enum {
  CONTACT_WEIGHT = 5
}; /* of an edge across contact, against 1 across a facet: coupling of D and M and of the condensed rows */

#endif
