/* fieldwriter.h -- fields for viewers, written one quantity at a time; every rank writes its own part.

   FieldWriterOpen(); FieldWriterMesh(); FieldWriterPoints() and FieldWriterCells() for each quantity, points
   first; FieldWriterClose(). All are collective. The first error of a file is noted in `files`; after it
   nothing is written. */
#ifndef MORTISE_FIELDWRITER_H
#define MORTISE_FIELDWRITER_H

#include "result/fields.h"
#include "checks/setupcheck.h"
#include "output/fileset.h"

/* Description of a quantity. */
typedef struct {
  const char *name;
  PetscInt    components;
  PetscBool   integer; /* to be stored as whole numbers */
} Quantity;

enum { FIELD_WRITER_MAX_POINT_QUANTITIES = 8, FIELD_WRITER_MAX_CELL_QUANTITIES = 3 };

/* Rows of this rank among those of all, block by block. Points are one block; cells are one for each type,
   since readers of mixed meshes keep cells of a type together. In a block the rows of a rank stand behind
   those of the ranks before it. */
typedef struct {
  PetscInt total, num_mine, num; /* rows of all ranks, of this one; blocks */
  struct {
    ElementType type;             /* of cells */
    PetscInt    all, mine, begin; /* rows of all ranks, of this one; the first of these among all rows */
  } block[ELEMENT_COUNT];         /* [num] */
} FieldRows;

/* Cells of this rank, block by block. */
typedef struct {
  PetscInt *start; /* [rows.num_mine + 1] */
  PetscInt *nodes; /* numbers of points in VTK's order [start[rows.num_mine]] */
} SortedCells;

/* The points and cells of one time. */
typedef struct {
  PetscInt    step;                  /* of the group that has them; -1 for the root */
  PetscInt    num_points, num_cells; /* on the first rank, like the rest; of all ranks */
  PetscInt    rows, columns;         /* of the list of cells */
  const char *topology;              /* its TopologyType in XDMF; static */
} FieldGrid;

/* Fields at several times: the times in the file. */
typedef struct {
  PetscInt         num, capacity;
  PetscReal       *t;        /* [num] */
  PetscInt         num_past; /* times before the file of -restart ended, and at its end; */
  const PetscReal *past;     /* these times, of the scene [num_past] */
  FieldGrid       *grid;     /* [num] */
  PetscBool        varies;   /* whether meshes may differ: then in the groups of their steps, else in the root */
  PetscBool        fresh;    /* whether the mesh of the last time is new */
  PetscBool        solved;   /* whether the last time is solved: a run can go on from there */
} FieldSeries;

/* A file of fields that is being written. */
typedef struct FieldWriter FieldWriter;

/* A format: its functions for each part. All are collective; arguments are the part of this rank. end() may
   write further files of the format. */
typedef struct {
  const char *suffix;
  PetscBool   grows; /* whether a file takes further times of a series; else it has the last one */
  PetscErrorCode (*begin)(FieldWriter *writer); /* numbers of points and cells are known */
  PetscErrorCode (*points)(FieldWriter *writer, const PetscReal positions[]); /* [points.num_mine][3] */
  PetscErrorCode (*cells)(FieldWriter *writer, const SortedCells *cells);
  PetscErrorCode (*point)(FieldWriter *writer, const Quantity *quantity, const PetscReal values[]);
  PetscErrorCode (*cell)(FieldWriter *writer, const Quantity *quantity, const PetscReal values[]);
  PetscErrorCode (*end)(FieldWriter *writer);
} FieldFormat;

extern const FieldFormat field_format_hdf5, field_format_vtu; /* HDF5 brings XDMF with it */

struct FieldWriter {
  MPI_Comm           comm;
  PetscMPIInt        rank;
  const FieldFormat *format;
  const char        *base;   /* of all names of files, without a suffix */
  const char        *title;  /* may be "" */
  const char        *bodies; /* names, separated by commas, in the order of the cells' `body` */
  const char        *first;  /* the quantities that a viewer is to take first, as attributes of VTK's PointData */
  FileSet           *files;
  FieldSeries       *series; /* NULL for fields at one time */
  FILE              *out;    /* NULL on other ranks, and when no file can be written */
  void              *data;   /* of the format */
  FieldRows          points, cells;
  PetscInt          *order; /* which of this rank's cells each sorted one is [cells.num_mine] */
  const PetscInt    *nodes; /* of FieldWriterMesh() */
  PetscInt           num_point_quantities, num_cell_quantities; /* so far */
  Quantity           point[FIELD_WRITER_MAX_POINT_QUANTITIES];
  Quantity           cell[FIELD_WRITER_MAX_CELL_QUANTITIES];
};

/* Collective.
   [in] writer - with base, title, bodies, first and files, which stay the caller's while it is open */
PetscErrorCode FieldWriterOpen(MPI_Comm comm, const FieldFormat *format, FieldWriter *writer);
PetscErrorCode FieldWriterClose(FieldWriter *writer);

/* This rank's part of the mesh. */
typedef struct {
  PetscInt         dim, num_points;
  const PetscInt  *nodes;  /* nodes that are points, ascending by their numbers [num_points]; NULL: all owned nodes */
  const PetscReal *coords; /* of its nodes [][dim] */
  PetscInt         num_cells;
  const PetscInt  *cell_type;  /* ElementType [num_cells] */
  const PetscInt  *cell_nodes; /* numbers of points, cell after cell, in the order of element.h */
} FieldMesh;

/* Numbers among all points of the first one of each local node. Collective.
   [in] start - points of owned nodes before each [num_owned+1]; [out] first - [num_nodes] */
PetscErrorCode FieldWriterNumberPoints(Level *level, const PetscInt start[], PetscInt first[]);
/* Points, in the order of the ranks, and cells. nodes stays the caller's while the writer is open.
   Collective. */
PetscErrorCode FieldWriterMesh(FieldWriter *writer, const FieldMesh *part);

/* A quantity of points. Collective.
   [in] mine - values of this rank's nodes [][stride]; the third component of plane vectors becomes 0 */
PetscErrorCode FieldWriterPoints(FieldWriter *writer, Quantity quantity, PetscInt stride, const PetscReal mine[]);
/* The same by points, where a node may be several. Collective.
   [in] mine - values of this rank's points [num_points][components] */
PetscErrorCode FieldWriterPointValues(FieldWriter *writer, Quantity quantity, const PetscReal mine[]);
/* A number of each cell. Collective. [in] mine - of this rank's cells [num_cells] */
PetscErrorCode FieldWriterCells(FieldWriter *writer, Quantity quantity, const PetscReal mine[]);

/* All fields of the bodies, points in the order of global nodes. Collective. */
PetscErrorCode BodyFieldsWrite(FieldWriter *writer, Fields fields);
/* The undeformed bodies, with the rigid motion that excludes a solution. Collective. */
PetscErrorCode BodyFieldsWriteMotion(FieldWriter *writer, VI vi, const SceneMotion *motion);
/* The undeformed bodies, with the sides of a check. Collective. */
PetscErrorCode BodyFieldsWriteSetup(FieldWriter *writer, VI vi, const SetupCheck *check);
/* All fields of the nonmortar side of pair p, points in the order of global nodes. Collective. */
PetscErrorCode SurfaceFieldsWrite(FieldWriter *writer, Fields fields, PetscInt p);

/* The nonmortar side of pair p as a table; collective. */
PetscErrorCode CSVWritePair(Fields fields, PetscInt p, FileSet *files, const char final[]);

#endif
