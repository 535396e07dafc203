/* level.h -- one level of the mesh: its tables of nodes, cells and facets.

   Nodes sit on points of the DMPlex: on vertices; with order 2 also on edges, on quadrilaterals and in
   hexahedra. The DMPlex keeps positions before the map of a body. The map is applied to the node table of
   each level, so that nodes of curved sides stay on them exactly. */
#ifndef MORTISE_LEVEL_H
#define MORTISE_LEVEL_H

#include <petscdmplex.h>
#include "kernel/element.h"
#include "scene/scene.h"

enum { NOT_BISECTED = -1 };

/* Nodes that hang, and those that they hang on. */
typedef struct {
  PetscInt  *start;  /* of each local node [num_nodes+1]; NULL where no node of the mesh hangs */
  PetscInt  *node;   /* local nodes, which do not hang [start[num_nodes]] */
  PetscReal *weight; /* values of their functions [start[num_nodes]] */
  PetscReal *rise;   /* from each local node that hangs to where it would be: a map and smooth sides have curves, while
                        edges of order 1 are straight; zero without a curve [num_nodes][dim] */
} Hanging;

/* Tables of one level on this rank. A cell is on exactly one rank; a node between ranks is on several, and
   one of them owns it. Local nodes: the owned ones first, in global order, then ghosts. Nodes on which others
   hang are ghosts, too. Global dof = dim * global node + component. */
typedef struct {
  MPI_Comm  comm;
  DM        dm;
  PetscInt  dim;
  PetscInt  num_cells, num_nodes, num_owned; /* local; num_nodes counts ghosts */
  PetscInt  node_begin, num_global;          /* first owned global node; global number of nodes */
  PetscInt  halvings;                        /* most of an edge that MeshAdapt() made for this level; 0 on others */
  PetscInt *cell_start;                      /* [num_cells+1] into cell_nodes */
  PetscInt *cell_nodes;                      /* local nodes in the order of element.h, never inside out */
  PetscInt *cell_type;                       /* ElementType [num_cells], of the order of the cell's body */
  PetscInt *cell_body;                       /* [num_cells] */
  /* Index of SceneGetMaterial() [num_cells]; the same array as cell_body where no body has regions. */
  PetscInt *cell_material;
  /* Levels since MeshAdapt() bisected what the cell is a part of: 0 on the level that it made then,
     NOT_BISECTED where it never did [num_cells]; NULL where all cells are new. */
  PetscInt  *cell_age;
  PetscBool *inner;  /* facets of the DM in a body, beside hanging nodes, with a cell on one side alone; NULL where no
                       node of the mesh hangs */
  PetscReal *coords; /* positions after the map [num_nodes][dim] */
  PetscInt  *node_global;  /* [num_nodes] */
  PetscInt  *node_body;    /* [num_nodes] */
  Mat        prolongation; /* from node values of the next coarser level (AIJ): its shape functions at the nodes of
                              this one; NULL on the coarsest */
  Mat        conforming;   /* from node values to those of a continuous function: hanging nodes, and no others, get the
                     values that their edge or face has there; AIJ; NULL where no node of the mesh hangs */
  Hanging    hanging;      /* the same for all local nodes */
  /* Of sides of files (eq. 4.1d): the error u of normals in radians, and u h with the size h of the file's
     facets; ghosted; NULL where they are known. */
  Vec normal_errors;
  Vec arcs; /* normals of smooth sides at nodes of bisected bodies, zero behind the last; ghosted; NULL where none */
  PetscReal *unmapped; /* positions before the map, kept where a file gives curved cells [num_nodes][dim]; else NULL */
  PetscInt   point_begin, point_end; /* points of the DM that may carry nodes: the vertices alone, or all */
  PetscInt  *point_node;             /* local node of each, -1 where there is none [point_end - point_begin] */
  Scene      scene;                  /* borrowed */
} Level;

/* Values of level->normal_errors at a node; most normals of level->arcs there, one for each patch. */
enum { LEVEL_NORMAL_ERRORS = 2, LEVEL_ARC_NORMALS = 3 };

/* The facets of one side, or of several joined with '+', on this rank. A boundary facet belongs to one cell,
   hence to one rank. */
typedef struct {
  PetscInt     num;
  ElementType *type;  /* [num] */
  PetscInt    *cell;  /* local cell [num] */
  PetscInt    *nodes; /* local nodes [num][ELEMENT_MAX_FACET_NODES], in the order of element.h with the normal of
                      ElementSurface() outward: (dy,-dx) in 2D, anticlockwise seen from outside in 3D */
} Facets;

/* Names of sides, each without '+'. */
typedef struct {
  PetscInt num;
  char   **name; /* [num] */
} SideNames;

/* Splits "a+b" and adds the parts that are not there yet. Not collective. */
PetscErrorCode SideNamesAdd(SideNames *names, const char side[]);
PetscErrorCode SideNamesDestroy(SideNames *names);

/* Facets of a body's side on a level. Collective. [out] facets - owned by the caller, FacetsDestroy() */
PetscErrorCode LevelGetFacets(Level *level, Scene scene, PetscInt body, const char side[], Facets *facets);
/* The facets of a body that no other cell has. Collective. [out] facets - owned by the caller */
PetscErrorCode LevelGetBoundary(const Level *level, PetscInt body, Facets *facets);
PetscErrorCode FacetsDestroy(Facets *facets);

/* A ghosted Vec with bs values per node: VecGhostGetLocalForm() gives them in local node order.
   Collective. */
PetscErrorCode LevelCreateVec(Level *level, PetscInt bs, Vec *v);
/* Sends the values of owners to ghosts (INSERT_VALUES). Before that it adds (ADD_VALUES) or maximises
   (MAX_VALUES) at the owner what ranks have for the same node. Collective. */
PetscErrorCode LevelShareVec(Vec v, InsertMode mode);
/* A matrix between node values as one for bs values at each node. Collective.
   [in] P - AIJ; [out] blocks - AIJ of block size bs, owned by the caller */
PetscErrorCode LevelCreateBlocks(Mat P, PetscInt bs, Mat *blocks);
/* The box around the nodes of a body, or of all bodies. Collective.
   [in] body - negative for all; [out] lower, upper - [dim] */
PetscErrorCode LevelGetBox(const Level *level, PetscInt body, PetscReal lower[], PetscReal upper[]);
/* Whether a local node hangs. Not collective. */
PetscBool LevelNodeHangs(const Level *level, PetscInt node);
/* Hanging nodes get the values of a continuous function, or the forces on them go to the nodes they hang on.
   This is the product with Level.conforming or its transpose. Without hanging nodes nothing happens.
   Collective.
   [in] bs - values at each node; [in,out] v - ghosted, owned values count */
PetscErrorCode LevelConform(Level *level, PetscInt bs, Vec v);
PetscErrorCode LevelConformForces(Level *level, PetscInt bs, Vec v);

/* Finds the cell of a body that contains a point, and the reference coordinates of the point in it. A point
   between a straight facet and its curve by the body's map belongs to the cell of the facet. It is then
   slightly outside the reference cell. Collective.
   [in] x - the same on all ranks [dim]
   [out] cell - local cell on the lowest rank that has one, -1 on all others
   [out] xi - on that rank [dim]
   [out] found - the same on all ranks */
PetscErrorCode LevelLocate(Level *level, PetscInt body, const PetscReal x[], PetscInt *cell, PetscReal xi[],
                           PetscBool *found);
/* All cells of a body that contain a point, on all ranks, so that their number makes no difference.
   Collective.
   [in,out] marked - at least 1 for these cells [num_cells], or NULL; [out] size - the largest of theirs */
PetscErrorCode LevelLocateAll(Level *level, PetscInt body, const PetscReal x[], PetscInt marked[], PetscReal *size);

#endif
