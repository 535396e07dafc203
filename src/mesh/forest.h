/* forest.h -- bodies whose cells are bisected or split: lists of cells on the first rank. Private.

   A forest has the latest mesh as lists, in the order of its bisection, and the cells and global nodes of the
   latest level. From marked cells it makes the lists of the next mesh. Functions of a Tree are not
   collective. */
#ifndef MORTISE_FOREST_H
#define MORTISE_FOREST_H

#include "kernel/bisect.h"
#include "kernel/quadric.h"
#include "kernel/rise.h"
#include "mesh/meshimpl.h"

/* What the first rank knows of a cell of a level. */
typedef struct {
  PetscInt cell;                           /* in the lists, body after body */
  PetscInt vertex[BISECT_MAX_VERTICES];    /* in the lists of all bodies, in the order of the level */
  PetscInt type, nodes[ELEMENT_MAX_NODES]; /* global nodes of the level */
  PetscInt age;                            /* Level.cell_age */
  PetscInt inner; /* bits of its facets, in the order of the level: beside hanging nodes, in the body */
} ForestCell;

/* A vertex on a facet of the first list, where that belongs to a smooth side or to a side fixed along its
   normal. */
typedef struct {
  PetscInt  facet;        /* of the first list, by its first entry */
  PetscInt  edge;         /* of this facet, if the vertex is on one and the file is of second order; else -1 */
  PetscReal normal[3];    /* of the smooth side there */
  PetscReal curvature[9]; /* shape operator of the polynomial (4.1c); zero where there is none */
  PetscReal xi[2];        /* in the facet; in space */
} SideCorner;

/* The surface (4.5a) of a facet of the first list, of second order and not on arcs. New vertices are on
   it. */
typedef struct {
  PetscBool   any;
  ElementType type;
  PetscReal   X[3 * ELEMENT_MAX_FACET_NODES], rise[3 * RISE_TERMS];
} SidePatch;

/* The middle of an edge of the first list, on a facet of a smooth side, where a file of second order has a
   node. */
typedef struct {
  PetscInt  ends[2]; /* vertices */
  PetscBool arc;     /* whether refinement follows an arc */
  PetscReal normal[3];
} SideMiddle;

/* Smooth sides of a body from a file (eq. 4.5). The normals at two vertices determine the
   curve between them and the normal at its middle. So the position of a vertex does not depend on refinement
   elsewhere. */
typedef struct {
  PetscBool  any;
  PetscBool *round, *flat; /* what facets are, by their first entries [num_entries] */
  PetscReal (*plane)[3];   /* unit normals of flat ones [num_entries] */
  PetscInt    num_vertices, room;
  PetscInt   *start;   /* [num_vertices+1] */
  SideCorner *corner;  /* of each vertex [start[num_vertices]; room] */
  Quadric    *quadric; /* of each facet, by its first entry; NULL in the plane [num_entries] */
  SidePatch  *patch; /* of each facet, by its first entry; NULL but for a file of second order in space [num_entries] */
  SideMiddle *middle; /* of each facet's edges, by its first entry; NULL but for a file of second order
                         [num_entries][ELEMENT_MAX_FACET_NODES] */
} TreeArcs;

/* One body. */
typedef struct {
  Bisection mesh;
  BodyList  list; /* of the latest mesh: numbers of the bisection, vertices of cells in the sense of element.h */
  /* Sides of the facets of the first list. The number of a facet is its first entry; `another` is its next
     entry, or -1. */
  PetscInt  num_entries;
  PetscInt *side, *another; /* [num_entries] */
  TreeArcs  arcs;
  PetscBool reversed;                      /* whether the map turns most cells inside out */
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
  PetscBool    lost;            /* whether the lists are those of a level that MeshReturn() has destroyed */
};
typedef struct _n_MeshForest *MeshForest;

/* Takes over the lists; quadrilaterals and hexahedra are cut into simplices, unless they are kept.
   Collective.
   [in,out] lists, names - of the first rank, empty afterwards [num_bodies] */
PetscErrorCode MeshForestCreate(Scene scene, BodyList lists[], SideNames names[], MeshForest *forest);
PetscErrorCode MeshForestDestroy(MeshForest *forest);
/* The DM of the latest lists, all of it on the first rank. Collective.
   [out] dm, curves - owned by the caller */
PetscErrorCode MeshForestMerge(Scene scene, MeshForest forest, DM *dm, Curves *curves);
/* Which nodes of the latest level hang: level->conforming, level->inner. Moves them to the edges and
   faces that they hang on. Its cells are not reversed yet. Collective. */
PetscErrorCode MeshForestSetHanging(MeshForest forest, Level *level);
/* Gathers the cells and nodes of the level of the latest lists on the first rank. Collective.
   [in] origin - of PartitionDistribute() */
PetscErrorCode MeshForestGather(MeshForest forest, const Level *level, const PetscInt origin[]);

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

/* A body's tree of simplices, or of quadrilaterals or hexahedra that are kept. [in] names - of the list's
   sides; [in,out] list - taken over, empty afterwards */
PetscErrorCode TreeCreate(Scene scene, PetscInt body, const SideNames *names, BodyList *list, Tree *tree);
PetscErrorCode TreeDestroy(Tree *tree);
/* Whether its cells are split and keep their type. */
PetscBool TreeIsKept(const Tree *tree);
/* Refines; the list becomes that of the new mesh. Cells that curves tangle are refined again, UNTANGLE_TIMES
   at most.
   [in] body - of the tree; [in] marked - how often edges are halved [num_cells] */
PetscErrorCode TreeRefine(Tree *tree, const SceneBody *body, const PetscInt marked[]);
/* Finds the smooth sides of a tree's list; a body of order 2 gets middle nodes on them. */
PetscErrorCode TreeArcsCreate(Scene scene, PetscInt body, const SideNames *names, Tree *tree);
PetscErrorCode TreeArcsDestroy(TreeArcs *arcs);
/* Moves new vertices and middle nodes of a new list to the curves.
   [in,out] list - of the tree's mesh, with the positions of all other nodes */
PetscErrorCode TreeArcsApply(Tree *tree, BodyList *list);
/* Shape functions of a parent at the nodes of one of its children.
   [in] child - cell of the tree; [in] fine, coarse - the child and its parent; [out] weights - [nodes of
   fine][nodes of coarse] */
void TreeWeights(const Tree *tree, PetscInt child, const ForestCell *fine, const ForestCell *coarse,
                 PetscReal weights[]);

/* Whether a list's cells can be split: all are quadrilaterals, or all hexahedra. */
PetscBool BodyListCanSplit(const BodyList *list);
/* Cuts quadrilaterals at their shorter diagonal, and hexahedra so that each face is cut at its lowest vertex:
   then neighbours match. [in,out] list; [out] cut - whether there were such cells */
PetscErrorCode BodyListCut(const SceneBody *body, BodyList *list, PetscBool *cut);
/* Positions of vertices after the map; before it where the map is not finite.
   [out] coords - [num_vertices][dim] */
PetscErrorCode BodyListMapVertices(const BodyList *list, const SceneBody *body, PetscReal coords[]);

#endif
