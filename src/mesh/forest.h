/* forest.h -- bodies whose cells are bisected: lists on the first rank, one more for each mesh. Private to this module.

   A forest holds the latest mesh as lists, in the order of its bisection; the cells and nodes of the latest level by their numbers
   there; and makes of marked cells the next lists. Trees are not collective. */
#ifndef MORTISE_FOREST_H
#define MORTISE_FOREST_H

#include "kernel/bisect.h"
#include "mesh/meshimpl.h"

enum { FOREST_MAX_NODES = 10 }; /* of a tetrahedron of order 2 */

/* What the first rank knows of a cell of a level. */
typedef struct {
  PetscInt cell;                          /* in the lists, body after body */
  PetscInt vertex[BISECT_MAX_VERTICES];   /* in the lists of all bodies, in the order of the level */
  PetscInt type, nodes[FOREST_MAX_NODES]; /* global nodes of the level */
} ForestCell;

/* One body. */
typedef struct {
  Bisection mesh;
  BodyList
      list; /* of the latest mesh; vertices and cells have the bisection's numbers, and the order in cells their sense */
  PetscInt num_entries, *side,
      *another; /* sides of facets: a facet's number is its first entry, which leads to another or to
                                             -1 [num_entries] */
  PetscInt (*before)[BISECT_MAX_VERTICES]; /* vertices of the mesh before, NULL for the first one */
  PetscInt num_before;                     /* its cells */
} Tree;

struct _n_MeshForest {
  PetscInt     num_bodies;
  Tree        *tree;            /* [num_bodies]; cells and vertices on the first rank alone */
  SideNames   *names;           /* [num_bodies] */
  PetscBool    cut;             /* whether there were other cells than simplices */
  PetscInt     num_cells;       /* on the first rank, of the latest level */
  ForestCell  *cell;            /* by their number in the lists [num_cells] */
  PetscInt    *gathered;        /* the list's number of each cell, rank after rank [num_cells] */
  PetscMPIInt *counts, *begins; /* cells of every rank; NULL on others [size] */
};
typedef struct _n_MeshForest *MeshForest;

/* The lists as roots; quads and hexahedra are cut. Collective. [in,out] lists, names - taken over, empty afterwards [num_bodies] */
PetscErrorCode MeshForestCreate(Scene scene, BodyList lists[], SideNames names[], MeshForest *forest);
PetscErrorCode MeshForestDestroy(MeshForest *forest);
/* The DM of the latest lists, whole on the first rank. Collective. */
PetscErrorCode MeshForestMerge(Scene scene, MeshForest forest, DM *dm, Curves *curves);
/* Lets the first rank know the level of the latest lists. Collective. [in] origin - of PartitionDistribute() */
PetscErrorCode MeshForestGather(MeshForest forest, const Level *level, const PetscInt origin[]);

/* A body's tree of simplices. [in] list - of triangles or tetrahedra, taken over */
PetscErrorCode TreeCreate(BodyList *list, Tree *tree);
PetscErrorCode TreeDestroy(Tree *tree);
/* Bisects; the list becomes that of the new mesh. [in] marked - [num_cells] */
PetscErrorCode TreeRefine(Tree *tree, const PetscBool marked[]);
/* Weights of the nodes of a parent at the nodes of one of its children. [in] child - the tree's cell; fine, coarse - what is known of the
   child and of its parent, their vertices as the tree numbers them; [out] weights - [nodes of fine][nodes of coarse] */
void TreeWeights(const Tree *tree, PetscInt child, const ForestCell *fine, const ForestCell *coarse,
                 PetscReal weights[]);

/* Quads and hexahedra cut into simplices: a quad at its shorter diagonal, faces of a hexahedron at their lowest vertex, so that
   neighbours match. [in,out] list; [out] cut - whether there were such cells */
PetscErrorCode BodyListCut(BodyList *list, PetscBool *cut);

#endif
