/* meshimpl.h -- declarations that the files of this module share.

   A body begins as plain lists on the first rank, from a box or from a file. All lists are merged into one
   DMPlex. Levels are its tables. Functions are not collective unless they say so. */
#ifndef MORTISE_MESHIMPL_H
#define MORTISE_MESHIMPL_H

#include "mesh/mesh.h"
#include "gmsh/gmsh.h"
#include "level/facets.h"
#include "level/leveltables.h"
#include "level/plexpoints.h"
#include "refinement/levelrefine.h"

enum { MESH_SENTENCE = 1024 }; /* length of the sentence of a user error */

/* Connected sets of cells that touch and are not joined. */
typedef struct {
  PetscInt  num_pieces; /* components of the body: connected sets of cells; 0 for a box, which is not searched */
  PetscInt  num_nodes, num_facets; /* that coincide with a node, that lie on a facet of another component */
  PetscReal at[3];                 /* the first of them, before the map */
} UnjoinedPieces;

/* Cells, positions and the facets of the sides that the scene uses. Nodes are the vertices, then the middle
   nodes of cells of order 2. */
typedef struct {
  PetscInt       dim, num_cells, num_vertices, num_nodes, num_facets;
  PetscInt      *cell_type;       /* ElementType [num_cells] */
  PetscInt      *cell_nodes;      /* [num_cells][ELEMENT_MAX_NODES] */
  PetscInt      *cell_material;   /* index of SceneGetMaterial(); NULL for a body without regions [num_cells] */
  PetscReal     *coords;          /* before the map [num_nodes][dim] */
  PetscInt      *facet_cell;      /* [num_facets] */
  PetscInt      *facet;           /* number of the facet in its cell [num_facets] */
  PetscInt      *facet_side;      /* index into the SideNames [num_facets] */
  PetscBool      curved_file;     /* the file is of second order */
  PetscBool      straightened;    /* it is, and the body of order 1 */
  PetscInt       num_nonmanifold; /* vertices that alone connect some cells */
  PetscReal      nonmanifold[3];  /* the first of them, before the map */
  UnjoinedPieces unjoined;
} BodyList;

/* Allocates lists whose nodes are all vertices. */
PetscErrorCode BodyListAllocate(PetscInt dim, PetscInt num_cells, PetscInt num_nodes, PetscInt max_facets,
                                BodyList *list);
PetscErrorCode BodyListDestroy(BodyList *list);
/* Puts straight cells of order 2 in the place of those of order 1. Not collective. */
PetscErrorCode BodyListRaise(BodyList *list);

/* All sides of a body that the scene's boundaries and pairs name. */
PetscErrorCode SideNamesOfBody(Scene scene, PetscInt body, SideNames *names);

/* Area or volume of a cell at X, negative where it is inside out. The same for a cell of a list, with nodes
   up to an order. [in] X - [nodes][dim] */
PetscReal CellGetMeasure(ElementType type, PetscInt dim, const PetscReal X[]);
PetscReal BodyListGetMeasure(const BodyList *list, PetscInt cell, PetscInt order);
/* Sets the nodes from num on, in the middle of facets and of the cell, which are not in the file. */
void CellSetMiddles(PetscInt cell, PetscInt num, BodyList *list);
/* The same positions of nodes that are there. */
void CellPlaceMiddles(PetscInt cell, PetscInt num, BodyList *list);
/* The bricks of a box that a rank makes, by their numbers in the box, x first. */
typedef struct {
  PetscInt  num_bricks, num_nodes;
  PetscInt *brick, *node; /* ascending [num_bricks], [num_nodes] */
} BoxPart;

/* A box of quads or triangles, of hexahedra or tetrahedra, or a part of it. [in] part - or NULL; [out]
   sentence - [MESH_SENTENCE], "" unless the scene is wrong */
PetscErrorCode BodyListCreateBox(const SceneBody *body, PetscInt dim, const SideNames *names, const BoxPart *part,
                                 BodyList *list, char sentence[]);

/* Warns of components that touch and are not joined; for the first rank. Not collective. */
PetscErrorCode UnjoinedPiecesWarn(const SceneBody *body, const BodyList *list);

/* Warns of bodies that overlap away from the sides of a pair between them; tied bodies may overlap.
   Collective. */
PetscErrorCode BodyOverlapWarn(Level *level);

/* Number of coarser levels of boxes: how often the cells of all bodies can be twice as large, if solvers use
   levels.
   [in] num_ranks - that share the coarsest mesh */
PetscInt SceneCountCoarser(Scene scene, PetscMPIInt num_ranks);
/* Doubles the edges of the cells of a box `times` times. */
void BodyCoarsen(SceneBody *body, PetscInt dim, PetscInt times);

/* Numbers of the cells and vertices of lists as points of a DM. */
typedef struct {
  PetscInt   num_bodies, num_cells, num_vertices;
  PetscInt **point;        /* of every cell of every body [num_bodies][num_cells] */
  PetscInt  *first_vertex; /* point of the body's first vertex [num_bodies] */
} Numbering;

PetscErrorCode NumberingCreate(PetscInt num_bodies, const BodyList lists[], Numbering *numbering);
PetscErrorCode NumberingDestroy(Numbering *numbering);
/* Shapes of one dimension. Each has a list of vertices in PETSc's order and, after ShapesBound(), one of its
   facets. */
typedef struct {
  PetscInt  num;
  PetscInt *type;                            /* ElementType of order 1 [num] */
  PetscInt *start, *vertex;                  /* [num+1], [start[num]] */
  PetscInt *cone_start, *cone, *orientation; /* NULL before ShapesBound() [num+1], [cone_start[num]] twice */
} Shapes;

/* Allocates shapes for ShapesAdd(). */
PetscErrorCode ShapesCreate(PetscInt max_shapes, PetscInt max_vertices, Shapes *shapes);
PetscErrorCode ShapesDestroy(Shapes *shapes);
void           ShapesAdd(Shapes *shapes, ElementType type, const PetscInt vertices[]);
/* The facets of shapes, each once: those of the first shape first.
   [in] num_vertices - of vertices from 0; [out] lower - owned by the caller */
PetscErrorCode ShapesBound(Shapes *upper, PetscInt num_vertices, Shapes *lower);
/* PETSc's names of the cells of order 1 [ELEMENT_COUNT]. */
extern const DMPolytopeType PlexPolytope[];
/* Cells, edges, vertices and their positions, without labels. Collective on comm. */
PetscErrorCode PlexCreate(MPI_Comm comm, PetscInt dim, const BodyList lists[], const Numbering *numbering, DM *dm);

/* The curves of a DM, from the cells of order 2 in lists. Collective on the DM. */
PetscErrorCode CurvesCreate(DM dm, const BodyList lists[], const Numbering *numbering, Curves *curves);

/* A Gmsh file as a DM on this rank alone. [out] curves - owned by the caller; [out] reason - why it cannot be
   used, "" if it can [MESH_SENTENCE] */
PetscErrorCode GmshPlexCreate(const GmshMesh *mesh, PetscInt dim, DM *dm, Curves *curves, char reason[]);

/* Meshes read so far, one per file, so that bodies that share a file share the reading. */
typedef struct _n_MeshFile *MeshFile;
struct _n_MeshFile {
  char     *path;
  DM        dm; /* as read, before any refinement */
  Curves    curves;
  GmshNames names; /* empty for other formats */
  MeshFile  next;
};
/* The mesh of a body's file as read now or for an earlier body.
   [in,out] files - list of what was read, NULL at first;
   [out] file - borrowed from the list; [out] sentence - [MESH_SENTENCE], "" unless the file cannot be used */
PetscErrorCode MeshFileOpen(const SceneBody *body, PetscInt dim, MeshFile *files, MeshFile *file, char sentence[]);
/* The cells of a body's file, or of one of its regions, with the body's own refinements. */
PetscErrorCode BodyListCreateFile(Scene scene, PetscInt body, const SideNames *names, MeshFile *files, BodyList *list,
                                  char sentence[]);
PetscErrorCode MeshFileDestroy(MeshFile *files);

/* The one DMPlex of all bodies. Collective.
   [in] lists - complete on the first rank and empty on others, or parts that are joined later */
PetscErrorCode MeshMerge(Scene scene, const BodyList lists[], const SideNames names[], DM *dm, Curves *curves);

/* Whether each rank makes its part of the mesh: for boxes of many cells.
   [in] coarser - number of coarser levels */
PetscBool BoxPartsWanted(Scene scene, PetscInt coarser, PetscMPIInt num_ranks);
/* The mesh of all boxes, made by parts. Collective. User errors: a side that does not exist.
   [out] curves - none */
PetscErrorCode BoxPartsCreate(Scene scene, PetscInt coarser, DM *dm, Curves *curves);

/* Least number of cells of files that all ranks connect: a smaller mesh needs little memory on one rank.
   Least number that all ranks partition as well: METIS takes some 200 bytes for each cell on the first
   rank. */
typedef struct {
  PetscInt parts, parallel;
} FileLimits;

extern const FileLimits FILE_LIMITS;

/* Whether mesh files may be read and partitioned by all ranks. */
PetscBool FilePartsWanted(Scene scene, PetscMPIInt num_ranks);
/* The mesh of all files, made by parts. Collective.
   [in] refine - number of later refinements; [out] good - false without a mesh: files have few cells, errors,
   or a reason for a warning */
PetscErrorCode FilePartsCreate(Scene scene, const FileLimits *limits, PetscInt refine, DM *dm, Curves *curves,
                               PetscBool *good);

/* Curves of files of second order under bodies of order 1: mesh->shape, NULL where there are none. Create
   makes them from the coarsest level. Refine refines them, and moves the nodes of the finest level of the
   mesh to them. Collective. */
PetscErrorCode MeshShapeCreate(Mesh mesh, const Curves *curves);
PetscErrorCode MeshShapeRefine(Mesh mesh);
PetscErrorCode MeshShapeDestroy(Mesh mesh);

/* The loads that a partition balances: the work of unknowns, and that of contact. */
enum { PARTITION_MAX_WEIGHTS = 2 };
typedef struct {
  PetscInt   num, num_parts;                   /* 1, unless nonmortar sides have enough facets */
  PetscReal  bricks;                           /* mean number of bricks of a cell */
  PetscInt  *load;                             /* of every cell, nodes in twelfths [num_cells][num] */
  PetscReal *target;                           /* share of each part in the sum [num_parts][num] */
  PetscReal  tolerance[PARTITION_MAX_WEIGHTS]; /* permitted load of a part over its share */
} PartitionWeights;

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
/* Partitions the graph by METIS. Not collective.
   [in] level - its dim, num_cells, cell_type and cell_body; [in] refine - number of later refinements;
   [out] part - [level->num_cells] */
PetscErrorCode CellGraphCut(Scene scene, const Level *level, PetscInt refine, const CellGraph *graph,
                            PetscInt num_parts, PetscInt part[]);
PetscErrorCode CellGraphDestroy(CellGraph *graph);

/* The same for all. */
PetscErrorCode PartitionWeightsCreate(Scene scene, const Level *level, const CellGraph *graph, PetscInt num_parts,
                                      PartitionWeights *shares);
/* Reduces the targets of parts with many nodes between parts.
   [in] refine - number of later refinements; part - a partition similar to the final one [num_cells] */
PetscErrorCode PartitionWeightsCorrect(Scene scene, const Level *level, PetscInt refine, const CellGraph *graph,
                                       const PetscInt part[], PartitionWeights *shares);
PetscErrorCode PartitionWeightsDestroy(PartitionWeights *shares);
enum {
  CONTACT_WEIGHT = 5
}; /* of an edge across contact, against 1 across a facet: coupling of D and M and of the condensed rows */

/* The rank of each cell of a mesh that is complete on the first rank; other ranks have no cells.
   Not collective.
   [in] refine - number of later refinements;
   [in] contact_weight - of an edge across contact, relative to one across a facet; 0 for bodies that do not
   touch; [in] bricks - of each cell, NULL for one; [out] part - [level->num_cells] */
PetscErrorCode PartitionCompute(Scene scene, Level *level, PetscInt refine, PetscInt contact_weight,
                                const PetscInt bricks[], PetscInt num_parts, PetscInt part[]);
/* The same for a DM that is complete on the first rank, by its vertices. Collective.
   [out] part - owned by the caller, PetscFree() */
PetscErrorCode PartitionCreate(Scene scene, DM dm, PetscInt refine, const PetscInt bricks[], PetscInt *num_cells,
                               PetscInt **part);
/* Distributes the mesh over the ranks; the DM and its curves are replaced. Collective.
   [in] refine - number of later refinements;
   [out] origin - the point of the original DM of each point of this rank, owned by the caller, PetscFree();
   optional, may be NULL */
PetscErrorCode PartitionDistribute(Scene scene, PetscInt refine, DM *dm, Curves *curves, PetscInt **origin);

/* Pairs of bodies with the side that each prefers to be nonmortar, its end 2 p, and the other one, its end 2
   p + 1. */
typedef struct {
  PetscInt   num;
  PetscBool *fixed; /* given by the user [num] */
  PetscInt  *order; /* pairs, fixed ones first, then the ones with the strongest reasons [num] */
  PetscBool *touch; /* whether two ends have a node in common [2 num][2 num] */
} MortarChoice;

/* Exchanges the sides of pairs that are not fixed, the last ones of the order first, so that only fixed pairs
   form cycles. Not collective.
   [out] turned - [num], all false unless found; [out] found - false where there is no such choice, or a long
   search has found none */
PetscErrorCode MortarChoiceOrient(const MortarChoice *graph, PetscBool turned[], PetscBool *found);
/* Whether pairs form a cycle. Not collective. [in] turned - [num] */
PetscErrorCode MortarChoiceHasCycle(const MortarChoice *graph, const PetscBool turned[], PetscBool *cycle);

/* Chooses the nonmortar side of pairs that leave it open; logs unfavourable given ones. User errors: a pair
   whose sides share facets; two pairs of the same facets. Collective. */
PetscErrorCode MortarChoiceMake(Mesh mesh);

#endif
