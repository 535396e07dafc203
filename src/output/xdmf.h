/* xdmf.h -- cells in XDMF's numbering. */
#ifndef MORTISE_XDMF_H
#define MORTISE_XDMF_H

#include "output/fieldwriter.h"

/* One type of cell: [rows = cells][columns = nodes]. Several: one list of type number and nodes, cell after
   cell, columns = 1. */
typedef struct {
  const char *name;          /* TopologyType */
  PetscInt    rows, columns; /* of all ranks */
  FieldRows   part;          /* of this rank */
  int        *values;        /* [part.num_mine][columns] */
} Topology;

/* Not collective. [in] rows - of cells; [out] topology - owned by the caller; its values end with
   XDMFTopologyDestroy(), the rest stays */
PetscErrorCode XDMFTopologyCreate(const FieldRows *rows, const SortedCells *cells, Topology *topology);
PetscErrorCode XDMFTopologyDestroy(Topology *topology);
/* Nodes of a cell of a list of several types, 0 for a type that is never written. Not collective. [in] number
   - its XDMF type */
PetscInt XDMFTopologyGetNumNodes(int number);

enum { XDMF_STEP_NAME = 32 };
/* "steps/0003/", the group of step i (from 0) of a series in the HDF5 file; "" without a series. Not
   collective. */
void XDMFStepName(const FieldSeries *series, PetscInt i, char name[XDMF_STEP_NAME]);
/* Writes the file that describes the HDF5 file to viewers, in the same folder. First rank only, not
   collective.
   [in] topology - values are not needed */
PetscErrorCode XDMFWrite(const FieldWriter *writer, const Topology *topology, const char hdf5[]);

#endif
