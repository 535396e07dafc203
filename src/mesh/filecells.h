/* filecells.h -- mesh files of many cells, distributed from the beginning.

   A rank reads some cells of the files in their order (FileCells) and finds their neighbours. Cells are
   partitioned and sent to their ranks. The received ones become lists (BodyList), and MeshMerge() makes a DM
   of these. Nothing is reported here. In case of any mistake or doubt the first rank makes the mesh instead,
   reports mistakes and warns. Points are numbered over all files. */
#ifndef MORTISE_FILECELLS_H
#define MORTISE_FILECELLS_H

#include "gmsh/gmshpart.h"
#include "scene/scene.h"

enum { FILE_FACETS = 6 }; /* of a cell, at most */

/* The files of a scene. */
typedef struct {
  MPI_Comm    comm;
  PetscMPIInt rank, size;
  PetscInt    dim, num, num_points; /* of files, of all their points */
  GmshPart   *part;                 /* [num] */
  GmshNames  *names;                /* [num] */
  PetscInt   *first_point;          /* [num+1] */
  PetscInt   *of_body;              /* file of each body [scene->num_bodies] */
} Files;

/* Positions of some points. Collective. [in] points - [num]; [out] x - [num][3] */
PetscErrorCode FilesGetPoints(const Files *files, PetscInt num, const PetscInt points[], PetscReal x[]);

/* Cells of this rank. Facets are in the order of ElementFacetNodes(). */
typedef struct {
  PetscInt   num, first, total; /* of this rank; number of its first; of all ranks */
  PetscInt   max_nodes, order;  /* of any cell of any rank; of all cells */
  PetscInt  *body, *material;   /* [num] */
  PetscInt  *type, *file_nodes; /* ElementType; how many of its nodes the file has [num] */
  PetscInt  *nodes;             /* points [num][max_nodes] */
  PetscInt  *reversed;          /* whether a cell is inside out [num] */
  PetscInt  *neighbour;         /* cell across each facet, -1 for none [num][FILE_FACETS] */
  PetscInt  *group, *group_end; /* its physical groups, in files->part[].mesh.group [num][FILE_FACETS] */
  PetscReal *middle, *distance; /* of corners [num][3]; from the middle of the neighbour [num][FILE_FACETS] */
} FileCells;

PetscErrorCode FileCellsAllocate(PetscInt num, PetscInt max_nodes, FileCells *cells);
PetscErrorCode FileCellsDestroy(FileCells *cells);
/* The cells of all bodies. Collective.
   [in,out] good - becomes false where parts cannot be joined; the same on all ranks */
PetscErrorCode FileCellsCreate(Scene scene, const Files *files, FileCells *cells, PetscBool *good);

#endif
