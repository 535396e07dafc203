/* picture.h -- the whole answer as plain arrays on the first rank, and the formats it is written in (floor 7, private to
   this room). */
#ifndef MORTISE_PICTURE_H
#define MORTISE_PICTURE_H

#include <mortise/fields.h>
#include "files.h"

/* One named quantity. */
typedef struct {
  const char *name;
  PetscInt    components;
  PetscBool   integer; /* to be stored as whole numbers */
  PetscReal  *values;  /* [points or cells][components] */
} PictureArray;

enum { PICTURE_POINT_ARRAYS = 6, PICTURE_CELL_ARRAYS = 1 };

/* Points in the order of global nodes; cells sorted by type, since readers of mixed meshes keep one block per type. Everything is
   empty on the other ranks. */
typedef struct {
  const char  *title;
  PetscInt     num_points, num_cells;
  PetscReal   *points;     /* [num_points][3] */
  PetscInt    *cell_start; /* [num_cells+1] */
  PetscInt    *cell_nodes; /* in VTK's order [cell_start[num_cells]] */
  PetscInt    *cell_type;  /* ElementType [num_cells] */
  PictureArray point[PICTURE_POINT_ARRAYS];
  PictureArray cell[PICTURE_CELL_ARRAYS];
} Picture;

/* Gathers everything. Collective. */
PetscErrorCode PictureCreate(Fields fields, Picture *picture);
PetscErrorCode PictureDestroy(Picture *picture);

/* All values that the ranks hold, in the order of the ranks, on the first rank; NULL elsewhere. Collective.
   [out] all - owned by the caller; [out] total - may be NULL */
PetscErrorCode GatherReals(MPI_Comm comm, PetscInt n, const PetscReal mine[], PetscInt *total, PetscReal **all);
PetscErrorCode GatherInts(MPI_Comm comm, PetscInt n, const PetscInt mine[], PetscInt *total, PetscInt **all);

/* Writers; first rank only, not collective. What goes wrong with a file is noted in files. */
PetscErrorCode PictureWriteHDF5(const Picture *picture, Files *files, const char final[]);
PetscErrorCode PictureWriteXDMF(const Picture *picture, Files *files, const char final[], const char hdf5[]);
PetscErrorCode PictureWriteVTU(const Picture *picture, Files *files, const char final[]);
/* The nonmortar side of pair p as a table; collective. */
PetscErrorCode PairWriteCSV(Fields fields, PetscInt p, Files *files, const char final[]);

#endif
