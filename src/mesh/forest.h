/* forest.h -- bodies whose cells are bisected: lists on the first rank, one more for each mesh. Private to
   this module.

   A forest holds the latest mesh as lists, in the order of its bisection; the cells and nodes of the latest
   level by their numbers there; and makes of marked cells the next lists. Trees are not collective. */
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

/* A vertex on a facet of the first list that belongs to a side taken for smooth, or to one held along its normal. */
typedef struct {
  PetscInt  facet;     /* of the first list, by its first entry */
  PetscReal normal[3]; /* of the smooth side there */
} SideCorner;

/* Smooth sides of a body whose file has straight edges (eq. 4.5). The curve between two vertices is that of
   their normals, and so is the normal in its middle: where a vertex is depends on no other refinement. */
typedef struct {
  PetscBool  any;
  PetscBool *round, *flat; /* what facets are, by their first entries [num_entries] */
  PetscReal (*plane)[3];   /* unit normals of flat ones [num_entries] */
  PetscInt    num_vertices, room;
  PetscInt   *start;  /* [num_vertices+1] */
  SideCorner *corner; /* of each vertex [start[num_vertices]; room] */
} TreeArcs;

/* One body. */
typedef struct {
  Bisection mesh;
  BodyList
      list; /* of the latest mesh; vertices and cells have the bisection's numbers, and the order in cells their sense */
  PetscInt  num_entries;
  PetscInt *side,
      *another; /* sides of facets: a facet's number is its first entry, which leads to another or to -1 [num_entries] */
  TreeArcs  arcs;
  PetscBool reversed;                      /* by the map */
  PetscInt (*before)[BISECT_MAX_VERTICES]; /* vertices of the mesh before, NULL for the first one */
  PetscInt num_before;                     /* its cells */
} Tree;

struct _n_MeshForest {
  PetscInt     num_bodies;
  Tree        *tree;            /* [num_bodies]; cells and vertices on the first rank alone */
  SideNames   *names;           /* [num_bodies] */
  PetscBool   *cut;             /* whether a body had other cells than simplices, on all ranks [num_bodies] */
  PetscInt     num_cells;       /* on the first rank, of the latest level */
  ForestCell  *cell;            /* by their number in the lists [num_cells] */
  PetscInt    *gathered;        /* the list's number of each cell, rank after rank [num_cells] */
  PetscMPIInt *counts, *begins; /* cells of every rank; NULL on others [size] */
};
typedef struct _n_MeshForest *MeshForest;

/* The lists as roots; quads and hexahedra are cut. Collective. [in,out] lists, names - taken over, empty
   afterwards [num_bodies] */
PetscErrorCode MeshForestCreate(Scene scene, BodyList lists[], SideNames names[], MeshForest *forest);
PetscErrorCode MeshForestDestroy(MeshForest *forest);
/* The DM of the latest lists, whole on the first rank. Collective. */
PetscErrorCode MeshForestMerge(Scene scene, MeshForest forest, DM *dm, Curves *curves);
/* Lets the first rank know the level of the latest lists. Collective. [in] origin - of PartitionDistribute() */
PetscErrorCode MeshForestGather(MeshForest forest, const Level *level, const PetscInt origin[]);

/* A body's tree of simplices. [in] names - of the list's sides; [in,out] list - of triangles or tetrahedra,
   taken over, empty afterwards */
PetscErrorCode TreeCreate(Scene scene, PetscInt body, const SideNames *names, BodyList *list, Tree *tree);
PetscErrorCode TreeDestroy(Tree *tree);
/* Bisects; the list becomes that of the new mesh. Cells that curves tangle are bisected again, three times at
   most. [in] body - of the tree;
   [in] marked - how often edges are halved [num_cells] */
PetscErrorCode TreeRefine(Tree *tree, const SceneBody *body, const PetscInt marked[]);
/* Sides of a tree's list that are taken for smooth; a body of order 2 gets middle nodes on them. */
PetscErrorCode TreeArcsCreate(Scene scene, PetscInt body, const SideNames *names, Tree *tree);
PetscErrorCode TreeArcsDestroy(TreeArcs *arcs);
/* Puts new vertices and the middle nodes of a new list on them. [in,out] list - of the tree's mesh, its nodes
   in place elsewhere */
PetscErrorCode TreeArcsApply(Tree *tree, BodyList *list);
/* Weights of the nodes of a parent at the nodes of one of its children. [in] child - the tree's cell; fine,
   coarse - what is known of the child and of its parent, their vertices as the tree numbers them; [out]
   weights - [nodes of fine][nodes of coarse] */
void TreeWeights(const Tree *tree, PetscInt child, const ForestCell *fine, const ForestCell *coarse,
                 PetscReal weights[]);

/* Quads and hexahedra cut into simplices: a quad at its shorter diagonal, faces of a hexahedron at their
   lowest vertex, so that neighbours match. [in,out] list; [out] cut - whether there were such cells */
PetscErrorCode BodyListCut(const SceneBody *body, BodyList *list, PetscBool *cut);
/* Vertices after the map, where they exist there. [out] coords - [num_vertices][dim] */
PetscErrorCode BodyListMapVertices(const BodyList *list, const SceneBody *body, PetscReal coords[]);

#endif
