/* mesh.h -- the one DMPlex of all bodies, and its levels.

   Every body is made or read on the first rank, refined by its own -<body>_dm_refine, and merged into one
   DMPlex. Refinements that all bodies have follow afterwards, where some body is a file. Boxes and files of
   many cells are made in parts by all ranks (boxparts.c, fileparting.c). Facets have one label for each named
   side that the scene uses. Cells have a label "material" until the tables have it. */
#ifndef MORTISE_MESH_H
#define MORTISE_MESH_H

#include "level/level.h"

/* Largest number of unknowns that are factored where a mesh has coarser levels; above, multigrid is chosen.
   Measured on one processor, seconds of factorization and of multigrid:
     plane: two plates, 68000 unknowns 0.8 and 0.4, 190000 2.4 and 1.1; gears, 98000 1.5 and 0.9; hertz2d,
   50000 0.6 and 0.6, 198000 2.7 and 2.2; adaptive meshes, 29000 0.3 and 0.3, 79000 0.9 and 0.4;
     space, spherical gap: order 1, 22000 unknowns 0.9 and 1.0, 32000 1.5 and 1.3; order 2, 25000 1.6 and 2.2,
   35000 2.9 and 2.7; sphere on block, 32000 unknowns 2.9 and 4.5. */
enum { MESH_LEVELS_2D = 60000, MESH_LEVELS_3D = 36000 };

/* Largest number of levels of an adaptive mesh. */
enum { MESH_MAX_ADAPTED = 128 };

struct _n_Mesh {
  Scene                 scene;      /* borrowed */
  PetscInt              num_levels; /* coarser ones (boxcoarsening.c), bodies as given, common refinements */
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
   [in] marked - how often the edges of this rank's cells are halved, -n in simplices for marks graded to
   vertices, as of BisectionRefine() [num_cells] */
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
/* Destroys all levels. Collective. */
PetscErrorCode MeshClear(Mesh mesh);
/* Collective. */
PetscErrorCode MeshDestroy(Mesh *mesh);

#endif
