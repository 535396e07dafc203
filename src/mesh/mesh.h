/* mesh.h -- the one DMPlex of all bodies, its levels and their tables.

   Every body is made or read on the first rank, refined by its own -<body>_dm_refine, and merged into one
   DMPlex. Boxes and files of many cells are made in parts by all ranks (boxparts.c, fileparting.c). Facets
   have one label for each named side that the scene uses. Cells have a label "material" until the tables have
   it.

   The DMPlex keeps positions before the map of a body. The map is applied to the node table of each level, so
   that nodes of curved sides stay on them exactly. Nodes sit on points of the DMPlex: on vertices; with order
   2 also on edges, on quadrilaterals and in hexahedra. */
#ifndef MORTISE_MESH_H
#define MORTISE_MESH_H

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
  Vec        normal_errors;
  Vec        arcs; /* normals of smooth sides at nodes of bisected bodies (arcnormals.c), ghosted; NULL where none */
  PetscReal *unmapped; /* positions before the map, kept where a file gives curved cells [num_nodes][dim]; else NULL */
  PetscInt   point_begin, point_end; /* points of the DM that may carry nodes: the vertices alone, or all */
  PetscInt  *point_node;             /* local node of each, -1 where there is none [point_end - point_begin] */
  Scene      scene;                  /* borrowed */
} Level;

/* Values of level->normal_errors at a node. */
enum { LEVEL_NORMAL_ERRORS = 2 };

/* The facets of one side, or of several joined with '+', on this rank. A boundary facet belongs to one cell,
   hence to one rank. */
typedef struct {
  PetscInt     num;
  ElementType *type;  /* [num] */
  PetscInt    *cell;  /* local cell [num] */
  PetscInt    *nodes; /* local nodes [num][ELEMENT_MAX_FACET_NODES], in the order of element.h with the normal of
                      ElementSurface() outward: (dy,-dx) in 2D, anticlockwise seen from outside in 3D */
} Facets;

/* Largest number of unknowns that are factored where a mesh has coarser levels; above, multigrid is chosen.
   Measured on one processor, seconds of factorization and of multigrid:
     plane: two plates, 68000 unknowns 0.8 and 0.4, 190000 2.4 and 1.1; gears, 98000 1.5 and 0.9; hertz2d,
   50000 0.6 and 0.6, 198000 2.7 and 2.2; adaptive meshes, 29000 0.3 and 0.3, 79000 0.9 and 0.4;
     space, spherical gap: order 1, 22000 unknowns 0.9 and 1.0, 32000 1.5 and 1.3; order 2, 25000 1.6 and 2.2,
   35000 2.9
     and 2.7; sphere on block, 32000 unknowns 2.9 and 4.5. */
enum { MESH_LEVELS_2D = 60000, MESH_LEVELS_3D = 36000 };

/* Largest number of levels of an adaptive mesh. */
enum { MESH_MAX_ADAPTED = 128 };

struct _n_Mesh {
  Scene                 scene;      /* borrowed */
  PetscInt              num_levels; /* coarser ones of boxes (boxcoarsening.c), bodies as given, common refinements */
  PetscInt              own;    /* the level that is the scene's mesh with its -dm_refine; MeshRefine() adds others */
  Level                *levels; /* coarse first; the last one is the mesh that is solved on */
  struct _n_MeshForest *forest; /* private: cells that can be bisected; NULL without -adapt */
  struct _n_MeshShape  *shape;  /* private: curved edges of files under bodies of order 1; NULL if none */
};
typedef struct _n_Mesh *Mesh;

/* Creates an empty mesh for a scene, which must outlive it. Collective on the scene's comm. */
PetscErrorCode MeshCreate(Scene scene, Mesh *mesh);
/* Makes or reads all bodies, merges, partitions, refines, builds the tables. Where solvers use levels, boxes
   begin with fewer cells and more refinements than the options say; the scene's own levels differ in their
   numbering only. Chooses the nonmortar side of pairs whose options leave it open, by THEORY.md, section 7
   (writes it to the ScenePair). User errors: a file that cannot be read; a side or region that does not exist
   (names those that do); a degenerate or tangled cell (names its place); a pair whose sides share facets; two
   pairs of the same facets. Collective. */
PetscErrorCode MeshSetUp(Mesh mesh);
/* Appends one level: the finest one with every cell split. Invalidates earlier pointers into mesh->levels.
   User errors: a degenerate or tangled cell. Collective. */
PetscErrorCode MeshRefine(Mesh mesh);
/* Appends one level, with a new partition. Marked cells of the finest one are bisected dim times for each
   mark, other cells until no node hangs. With cells that are kept, marked ones are split for each mark,
   others until hanging nodes hang on nodes that do not. Cells that a map or a curve tangles are refined
   again. The mesh does not depend on the number of ranks; pointers into mesh->levels stay valid. For meshes
   of scenes with -adapt. User errors: a degenerate or tangled cell. Collective.
   [in] marked - how often the edges of this rank's cells are halved [num_cells] */
PetscErrorCode MeshAdapt(Mesh mesh, const PetscInt marked[]);
/* The same with all cells marked once. Collective. */
PetscErrorCode MeshAdaptAll(Mesh mesh);
/* Goes back to the first levels of the mesh, after MeshAdapt() or the work on its level has failed. Finer
   ones are destroyed, and MeshAdapt() is no longer possible. Collective. [in] num_levels - that remain */
PetscErrorCode MeshReturn(Mesh mesh, PetscInt num_levels);
/* Whether MeshAdapt() is possible. Not collective. */
PetscBool MeshCanAdapt(Mesh mesh);
/* Whether the quadrilaterals or hexahedra of a body were cut into simplices: only simplices can be bisected.
   Not collective. */
PetscBool MeshIsCut(Mesh mesh, PetscInt body);
/* The level that is solved on. Not collective. Borrowed from the mesh */
Level *MeshFinest(Mesh mesh);
/* Collective. */
PetscErrorCode MeshDestroy(Mesh *mesh);

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

/* Interpolation from node values of one order to those of a higher one on the same cells. The two scenes
   differ in the order of all bodies alone: then both have the same DMs and partition. Collective.
   [out] E - AIJ, owned by the caller */
PetscErrorCode LevelCreateEmbedding(const Level *low, const Level *high, Mat *E);

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
