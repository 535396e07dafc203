/* mesh.h -- the one DMPlex of all bodies, its levels and their tables.

   Every body is made or read on the first rank, refined by its own -<body>_dm_refine, and merged into one DMPlex whose
   facets carry one label per named side that the scene uses; cells have a label "material" until the tables tell it. The DMPlex
   keeps box coordinates; a body's map is applied to the node table of each level, so that nodes of curved sides stay on
   them exactly. Nodes sit on points of the DMPlex: on vertices, and in bodies of order 2 also on edges, in quads and in
   hexahedra. */
#ifndef MORTISE_MESH_H
#define MORTISE_MESH_H

#include <petscdmplex.h>
#include "kernel/element.h"
#include "scene/scene.h"

/* Tables of one level on this rank. Cells are held by exactly one rank; nodes on rank boundaries by several, one of
   which owns them. Local nodes: the owned ones first, in global order, then ghosts. Global dof = dim * global node +
   component. */
typedef struct {
  MPI_Comm  comm;
  DM        dm;
  PetscInt  dim;
  PetscInt  num_cells, num_nodes, num_owned; /* local; num_nodes counts ghosts */
  PetscInt  node_begin, num_global;          /* first owned global node; global number of nodes */
  PetscInt *cell_start;                      /* [num_cells+1] into cell_nodes */
  PetscInt *cell_nodes;                      /* local nodes in the order of element.h, never inside out */
  PetscInt *cell_type;                       /* ElementType [num_cells], of the order of the cell's body */
  PetscInt *cell_body;                       /* [num_cells] */
  PetscInt *
      cell_material; /* index of SceneGetMaterial(); the same array as cell_body where no body has regions [num_cells] */
  PetscReal *coords;       /* positions after the map [num_nodes][dim] */
  PetscInt  *node_global;  /* [num_nodes] */
  PetscInt  *node_body;    /* [num_nodes] */
  Mat        prolongation; /* node values of the next coarser level to this one's (AIJ), NULL on the coarsest: its shape
                              functions at the nodes of this one */
  PetscReal *unmapped; /* positions before the map, kept where a file gives curved cells [num_nodes][dim]; else NULL */
  PetscInt   point_begin, point_end; /* points of the DM that may carry nodes: the vertices alone, or all */
  PetscInt  *point_node;             /* local node of each, -1 where there is none [point_end - point_begin] */
  Scene      scene;                  /* borrowed */
} Level;

/* The facets of one side, or of several joined with '+', that this rank holds: boundary facets belong to one cell,
   hence to one rank. */
typedef struct {
  PetscInt     num;
  ElementType *type;  /* [num] */
  PetscInt    *cell;  /* local cell [num] */
  PetscInt    *nodes; /* local nodes [num][ELEMENT_MAX_FACET_NODES], in the order of element.h with the normal of
                      ElementSurface() outward: (dy,-dx) in 2D, anticlockwise seen from outside in 3D */
} Facets;

/* Unknowns up to which a factorization is chosen where a mesh has coarser levels. Seconds of one processor, factorization and multigrid.
   In the plane: 116000 unknowns 1.3 and 1.7, 1050000 18 and 18; beyond some 200000 multigrid takes two thirds of the memory. An
   adapted mesh has the levels of the mesh before: 29000 unknowns 0.3 and 0.3, 79000 0.9 and 0.4. In space: spherical gap, order 1,
   22000 unknowns 0.9 and 1.0, 32000 1.5 and 1.3, order 2, 25000 1.6 and 2.2, 35000 2.9 and 2.7; sphere on block, 32000, 2.9 and 4.5. */
enum { MESH_LEVELS_2D = 200000, MESH_LEVELS_2D_ADAPTED = 60000, MESH_LEVELS_3D = 36000 };

/* Levels of a mesh that is adapted, at most. */
enum { MESH_MAX_ADAPTED = 128 };

struct _n_Mesh {
  Scene                 scene;      /* borrowed */
  PetscInt              num_levels; /* those that boxes begin with by themselves, 1, common refinements */
  PetscInt              own;    /* the level that is the scene's mesh with its -dm_refine; MeshRefine() adds others */
  Level                *levels; /* coarse first; the last one is the mesh that is solved on */
  struct _n_MeshForest *forest; /* private: cells that can be bisected; NULL without -adapt */
  struct _n_MeshShape  *shape;  /* private: curved edges of files under bodies of order 1; NULL if none */
};
typedef struct _n_Mesh *Mesh;

/* Creates an empty mesh for a scene, which must outlive it. Collective on the scene's comm. */
PetscErrorCode MeshCreate(Scene scene, Mesh *mesh);
/* Whether solvers want levels for a scene of so many unknowns. Not collective. */
PetscBool MeshWantsLevels(Scene scene, PetscReal num_unknowns);
/* Makes or reads all bodies, merges, partitions, refines, builds the tables. Where solvers want levels, boxes begin with fewer
   cells and more refinements than the options say; the levels from there on are the same but for the numbering. User errors: a file that cannot be read, a
   side or region that does not exist (names those that do), a degenerate or tangled cell (names its place), a side
   in two roles. Chooses roles of pairs left open, by THEORY.md, section 7 (writes nonmortar and mortar of the ScenePair).
   Collective. */
PetscErrorCode MeshSetUp(Mesh mesh);
/* Appends one more level, the finest one with every cell split; earlier pointers into mesh->levels are void then. User errors:
   a degenerate or tangled cell. Collective. */
PetscErrorCode MeshRefine(Mesh mesh);
/* Appends one more level, and pointers into mesh->levels stay: marked cells of the finest one bisected dim times for each mark, others as often as that makes them hang. The same on any
   number of ranks; parted anew. Cells that a map or a curve tangles are bisected again, three times at most. For meshes of scenes with
   -adapt. User errors: a degenerate or tangled cell. Collective.
   [in] marked - how often the edges of this rank's cells are halved [num_cells] */
PetscErrorCode MeshAdapt(Mesh mesh, const PetscInt marked[]);
/* The same with all cells marked. */
PetscErrorCode MeshAdaptAll(Mesh mesh);
/* Whether the quads or hexahedra of a body were cut into simplices, which alone can be bisected. Not collective. */
PetscBool      MeshIsCut(Mesh mesh, PetscInt body);
Level         *MeshFinest(Mesh mesh);
PetscErrorCode MeshDestroy(Mesh *mesh);

/* Facets of a body's side on a level. Collective. [out] facets - owned by the caller, FacetsDestroy() */
PetscErrorCode LevelGetFacets(Level *level, Scene scene, PetscInt body, const char side[], Facets *facets);
PetscErrorCode FacetsDestroy(Facets *facets);

/* A ghosted Vec with bs values per node: VecGhostGetLocalForm() gives them in local node order. Collective. */
PetscErrorCode LevelCreateVec(Level *level, PetscInt bs, Vec *v);
/* Sums (ADD_VALUES) or maximises (MAX_VALUES) what every rank holds in its ghosts into the owners, and sends the
   result back. Collective. */
PetscErrorCode LevelShareVec(Vec v, InsertMode mode);
/* An AIJ matrix of block size bs for operators between nodes that share a cell, preallocated exactly from the
   tables. Collective. */
PetscErrorCode LevelCreateMat(Level *level, PetscInt bs, Mat *A);

/* Node values of one order to those of a higher one on the same mesh: two Meshes whose scenes differ in nothing but the one
   order that all bodies have are of the same DMs, cut alike. Where orders are mixed, ranks share the unknowns out in another
   way. Collective. [out] E - AIJ, owned by the caller */
PetscErrorCode LevelCreateEmbedding(const Level *low, const Level *high, Mat *E);

/* Finds the cell of a body that holds a point, and the point's reference coordinates there. A point between a
   straight facet and the curve that the body's map makes of it belongs to the facet's cell, a little outside of its
   reference cell. Collective.
   [out] cell - local cell on the one rank that answers (lowest of those that hold it), -1 elsewhere
   [out] found - on all ranks */
PetscErrorCode LevelLocate(Level *level, PetscInt body, const PetscReal x[], PetscInt *cell, PetscReal xi[],
                           PetscBool *found);

#endif
