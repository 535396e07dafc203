/* referencecell.h -- the table of reference cells (element.h has the order of their nodes). */
#ifndef MORTISE_REFERENCECELL_H
#define MORTISE_REFERENCECELL_H

#include "kernel/element.h"
#include "kernel/shapefunction.h"

enum { REFERENCE_MAX_DIM = 3, REFERENCE_MAX_EDGES = 12, REFERENCE_MAX_FACETS = 6 };

typedef struct {
  PetscInt    dim, order, num_nodes, num_edges, num_facets;
  ElementType linear;     /* the same cell with its vertices only */
  ElementType facet_type; /* ELEMENT_COUNT where the facets are points */
  PetscBool   simplex;    /* coordinates add up to 1 at most; otherwise each is in [0,1] */
  PetscInt    stiffness_degree;
  PetscInt    lattice; /* intervals along an edge of the lattice for the smallest det J; 1: vertices suffice */
  PetscReal   nodes[ELEMENT_MAX_NODES][REFERENCE_MAX_DIM];
  PetscInt    edges[REFERENCE_MAX_EDGES][2];
  PetscInt    facets[REFERENCE_MAX_FACETS][ELEMENT_MAX_FACET_NODES];
  ShapeFn    *shape;
} Reference;

extern const Reference REFERENCE[ELEMENT_COUNT];

#endif
