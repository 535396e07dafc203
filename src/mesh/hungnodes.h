/* hungnodes.h -- nodes of small cells on an edge or a face of a larger cell. */
#ifndef MORTISE_HUNGNODES_H
#define MORTISE_HUNGNODES_H

#include "mesh/tree.h"

/* A node of small cells on an edge or a face of a larger cell. */
typedef struct {
  PetscInt  cell, dim, entity; /* the larger one; 1 or 2; the number of its edge or facet */
  PetscReal place[2];          /* reference coordinates in this edge or facet */
} HungNode;

/* All of them in a tree whose cells are kept: vertices, and nodes of order 2 in the middle of small edges and
   faces. Edges are found by their ends, faces by a diagonal. */
typedef struct {
  const Bisection *mesh;
  PetscInt         num, room;
  HungNode        *node;       /* [num] */
  PetscInt        *vertex;     /* number of each vertex that hangs, else -1 [mesh->num_vertices] */
  EdgeTable        edge, face; /* numbers of nodes in the middle of small ones */
  EdgeTable        facet;      /* those with cells on one side alone: edges in the plane, faces in space */
  const PetscInt  *first;      /* vertices of the first cell */
  PetscInt         stride;     /* from cell to cell */
} HungNodes;

/* Nothing hangs in a tree of simplices. Not collective. [in] first - vertices of the first cell, in the order
   of its element; stride - from cell to cell */
PetscErrorCode HungNodesCreate(const Tree *tree, const PetscInt first[], PetscInt stride, HungNodes *hung);
PetscErrorCode HungNodesDestroy(HungNodes *hung);
/* The number of a cell's node, of order 1 or 2, or -1 if it does not hang. */
PetscInt HungNodesFind(const HungNodes *hung, PetscInt cell, PetscInt node);
/* Shape functions of the edge or facet that a node hangs on. [in] type - of the larger cell; [out] local -
   its nodes there, phi - their functions [*num] */
void HungNodeShape(const HungNode *node, ElementType type, PetscInt *num, PetscInt local[], PetscReal phi[]);
/* Whether a facet of a cell, beside hanging nodes, has a cell on one side alone. */
PetscBool HungNodesHasFacet(const HungNodes *hung, PetscInt cell, PetscInt facet);

#endif
