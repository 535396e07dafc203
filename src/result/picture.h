/* picture.h -- the answer as plain arrays on the first rank, and the formats it is written in (floor 7, private to
   this room). */
#ifndef MORTISE_PICTURE_H
#define MORTISE_PICTURE_H

#include <mortise/fields.h>
#include <mortise/solvability.h>
#include "files.h"
#include "gather.h"

/* One named quantity. */
typedef struct {
  const char *name;
  PetscInt    components;
  PetscBool   integer; /* to be stored as whole numbers */
  PetscReal  *values;  /* [points or cells][components] */
} PictureArray;

enum { PICTURE_MAX_POINT_ARRAYS = 7, PICTURE_MAX_CELL_ARRAYS = 2 };

/* The bodies, or one side of a pair as cells of one dimension less. Cells are sorted by type, since readers of mixed meshes
   keep one block per type. Everything is empty on the other ranks, but for the names. */
typedef struct {
  const char  *title;
  const char  *first; /* the quantities that a viewer is to take first, as attributes of VTK's PointData */
  PetscInt     num_points, num_cells;
  PetscReal   *points;     /* [num_points][3] */
  PetscInt    *cell_start; /* [num_cells+1] */
  PetscInt    *cell_nodes; /* in VTK's order [cell_start[num_cells]] */
  PetscInt    *cell_type;  /* ElementType [num_cells] */
  PetscInt     num_point_arrays, num_cell_arrays;
  PictureArray point[PICTURE_MAX_POINT_ARRAYS];
  PictureArray cell[PICTURE_MAX_CELL_ARRAYS];
} Picture;

/* Gathers all bodies, points in the order of global nodes. Collective. */
PetscErrorCode PictureCreate(Fields fields, Picture *picture);
/* Gathers all bodies where they are, with the motion for which there is no solution. Collective. */
PetscErrorCode PictureCreateMotion(VI vi, Picture *picture);
/* Gathers the nonmortar side of pair p with what happens on it, points in the order of global nodes. Collective. */
PetscErrorCode PictureCreateSurface(Fields fields, PetscInt p, Picture *picture);
PetscErrorCode PictureDestroy(Picture *picture);

/* Cells of one rank, with nodes in the order of element.h. */
typedef struct {
  PetscInt        num;
  const PetscInt *type;  /* ElementType [num] */
  const PetscInt *tag;   /* a whole number for each [num] */
  const PetscInt *nodes; /* global, cell after cell */
} PictureCells;

/* Gathers cells into a picture, sorted by type. Collective.
   [out] tags - of the picture's cells, on the first rank; owned by the caller, PetscFree() */
PetscErrorCode PictureGatherCells(MPI_Comm comm, const PictureCells *cells, Picture *picture, PetscReal **tags);

/* Writers; first rank only, not collective. What goes wrong with a file is noted in files. */
PetscErrorCode PictureWriteHDF5(const Picture *picture, Files *files, const char final[]);
PetscErrorCode PictureWriteXDMF(const Picture *picture, Files *files, const char final[], const char hdf5[]);
PetscErrorCode PictureWriteVTU(const Picture *picture, Files *files, const char final[]);
/* The nonmortar side of pair p as a table; collective. */
PetscErrorCode PairWriteCSV(Fields fields, PetscInt p, Files *files, const char final[]);

#endif
