/* xdmf.h -- cells as XDMF wants them (floor 7, private to this room). */
#ifndef MORTISE_XDMF_H
#define MORTISE_XDMF_H

#include "picture.h"

/* One type of cell: [rows = cells][columns = nodes]. Several: one list of type number and nodes, cell after cell, columns = 1. */
typedef struct {
  const char *name; /* TopologyType */
  PetscInt    rows, columns;
  int        *values;
} Topology;

/* Not collective. [out] topology - owned by the caller */
PetscErrorCode TopologyCreate(const Picture *picture, Topology *topology);
PetscErrorCode TopologyDestroy(Topology *topology);

#endif
